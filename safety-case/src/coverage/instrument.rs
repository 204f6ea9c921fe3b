//! Puts the recorder's calls into a source. Text is only put in, so lines stay as they are and nothing else changes.
//!
//! A decision `a && !b` becomes `({let __d=Eval::new(7);let __o=__d.c(0,a) && !__d.c(1,b);__d.done(__o)})`: the operators
//! stay, so what they pass over is still passed over. A statement gets `hit(n);` in front, the body of an arm or closure
//! becomes `{hit(n);body}`. `const` goes from functions, because nothing is recorded at compile time.

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, BinOp, Block, Expr, ReturnType, Signature, Stmt, Token, UnOp};

use super::form::{has_let, inside, is_boolean, is_elsewhere, is_structured, range};
use super::insert::Insertions;
use super::plan::{Decision, Kind, Place, Plan, Point, Tree};
use super::recorder::CONDITIONS;

/// Functions whose first argument of several is a condition.
const CONDITIONAL: [&str; 5] = ["lower_if", "raise_if", "when", "run_while", "refuse"];
/// Methods of `bool` that branch.
const BRANCHING: [&str; 2] = ["then", "then_some"];
/// As much of a statement is shown.
const SHOWN: usize = 100;

/// The instrumented source; what can be covered goes into the plan, numbered on from what is in it.
///
/// With `keeps_const`, functions that are `const` stay so, because others are made of them, and are left out.
///
/// # Errors
/// It is no Rust.
pub fn instrument(file: &str, source: &str, keeps_const: bool, plan: &mut Plan) -> Result<String, syn::Error> {
    let parsed = syn::parse_file(source)?;
    let mut walk =
        Walk { file, source, keeps_const, plan, insertions: Insertions::default(), owner: None, function: None };
    walk.visit_file(&parsed);
    let misplaced = || syn::Error::new(parsed.span(), "a place outside of the file");
    walk.insertions.put_into(source).ok_or_else(misplaced)
}

pub(super) struct Walk<'a> {
    file: &'a str,
    source: &'a str,
    keeps_const: bool,
    plan: &'a mut Plan,
    insertions: Insertions,
    owner: Option<String>,
    function: Option<String>,
}

impl Walk<'_> {
    fn place(&self, at: &impl Spanned) -> Place {
        let function = self.function.clone().unwrap_or_default();
        Place { file: self.file.to_owned(), line: at.span().start().line, function }
    }

    /// How it reads, on one line.
    fn text(&self, of: &impl Spanned) -> String {
        let text = self.source.get(range(of)).unwrap_or_default();
        let lines = text.lines().map(|line| line.split(" //").next().unwrap_or_default());
        let words: Vec<&str> =
            lines.filter(|line| !line.trim_start().starts_with("//")).flat_map(str::split_whitespace).collect();
        words.join(" ")
    }

    fn point(&mut self, kind: Kind, at: &impl Spanned, text: String) -> usize {
        let end = text.char_indices().nth(SHOWN).map(|(end, _)| end);
        let text = end.and_then(|end| text.get(..end)).map(|start| format!("{start}…")).unwrap_or(text);
        self.plan.points.push(Point { place: self.place(at), kind, text });
        self.plan.points.len().saturating_sub(1)
    }

    pub(super) fn left_out(&mut self, at: &impl Spanned, why: String) {
        let place = self.place(at);
        self.plan.left_out.push((place, why));
    }

    /// A boolean expression that is no part of a greater one.
    pub(super) fn decision(&mut self, whole: &Expr, branches: bool) {
        if matches!(whole, Expr::Lit(_)) {
            return;
        }
        let number = self.plan.decisions.len();
        let (place, text) = (self.place(whole), self.text(whole));
        let nothing = Tree::Leaf(0);
        self.plan.decisions.push(Decision { place, text, branches, conditions: Vec::new(), tree: nothing });
        let before = format!("({{let __d=::recorder::Eval::new({number});let __o=");
        self.insertions.wrap(&range(whole), before, ";__d.done(__o)})");
        let tree = self.tree(whole, number);
        let conditions = match self.plan.decisions.get_mut(number) {
            Some(decision) => {
                decision.tree = tree;
                decision.conditions.len()
            }
            None => 0,
        };
        if conditions > CONDITIONS {
            self.left_out(
                whole,
                format!("{conditions} conditions in one decision, where {CONDITIONS} can be recorded"),
            );
        }
    }

    fn tree(&mut self, part: &Expr, decision: usize) -> Tree {
        if let Expr::Paren(inner) = part {
            return self.tree(&inner.expr, decision);
        }
        if let Expr::Unary(not) = part
            && matches!(not.op, UnOp::Not(_))
        {
            return Tree::Not(Box::new(self.tree(&not.expr, decision)));
        }
        if let Expr::Binary(both) = part
            && matches!(both.op, BinOp::And(_) | BinOp::Or(_))
        {
            let left = Box::new(self.tree(&both.left, decision));
            let right = Box::new(self.tree(&both.right, decision));
            return if matches!(both.op, BinOp::And(_)) { Tree::All(left, right) } else { Tree::Any(left, right) };
        }
        let shown = (part.span().start().line, self.text(part));
        let conditions = self.plan.decisions.get_mut(decision).map(|decision| &mut decision.conditions);
        let number = conditions.map_or(0, |conditions| {
            conditions.push(shown);
            conditions.len().saturating_sub(1)
        });
        self.insertions.wrap(&range(part), format!("__d.c({number},"), ")");
        self.within(part);
        Tree::Leaf(number)
    }

    /// What is inside a condition, which itself is no decision.
    fn within(&mut self, condition: &Expr) {
        if let Expr::Binary(compared) = condition {
            self.visit_expr(&compared.left);
            self.visit_expr(&compared.right);
        } else if let Expr::Macro(matches) = condition
            && matches.mac.path.is_ident("matches")
        {
            self.matched(&matches.mac);
        } else {
            self.visit_expr(condition);
        }
    }

    /// `if let`, alone or in a chain: the way is a branch, and each condition beside it a decision of its own.
    fn if_let(&mut self, whole: &syn::ExprIf) {
        let text = self.text(&whole.cond);
        let on = self.point(Kind::Branch, whole, format!("if {text}: matched"));
        let past = self.point(Kind::Branch, whole, format!("if {text}: not matched"));
        self.insertions.open(inside(&whole.then_branch), format!("::recorder::hit({on});"));
        match &whole.else_branch {
            None => self.insertions.close(range(&whole.then_branch).end, format!(" else {{::recorder::hit({past});}}")),
            Some((_, other)) => {
                self.insertions.wrap(&range(other.as_ref()), format!("{{::recorder::hit({past});"), "}");
            }
        }
        self.chained(&whole.cond);
        self.visit_block(&whole.then_branch);
        if let Some((_, other)) = &whole.else_branch {
            self.visit_expr(other);
        }
    }

    fn chained(&mut self, part: &Expr) {
        if let Expr::Let(bound) = part {
            self.visit_expr(&bound.expr);
        } else if let Expr::Binary(both) = part
            && matches!(both.op, BinOp::And(_))
        {
            self.chained(&both.left);
            self.chained(&both.right);
        } else {
            self.decision(part, false);
        }
    }

    /// A function: its `const` goes, and what it gives as `bool` is a decision.
    fn body(&mut self, attributes: &[Attribute], signature: &Signature, block: &Block) {
        if attributes.iter().any(is_elsewhere) {
            return;
        }
        let name = self
            .owner
            .as_ref()
            .map_or_else(|| signature.ident.to_string(), |owner| format!("{owner}::{}", signature.ident));
        let around = self.function.replace(name);
        if let Some(constness) = &signature.constness {
            if self.keeps_const {
                self.left_out(constness, "const, and others that are const call it".to_owned());
                self.function = around;
                return;
            }
            self.insertions.wrap(&range(constness), "/*", "*/");
        }
        let gives_bool = matches!(&signature.output, ReturnType::Type(_, of) if matches!(of.as_ref(), syn::Type::Path(path) if path.path.is_ident("bool")));
        self.statements(block, gives_bool);
        self.function = around;
    }

    fn statements(&mut self, block: &Block, gives_bool: bool) {
        let last = block.stmts.len().saturating_sub(1);
        for (number, statement) in block.stmts.iter().enumerate() {
            if matches!(statement, Stmt::Item(_)) {
                continue;
            }
            let text = self.text(statement);
            let point = self.point(Kind::Statement, statement, text);
            self.insertions.open(range(statement).start, format!("::recorder::hit({point});"));
            match statement {
                Stmt::Expr(value, None) if gives_bool && number == last && !is_structured(value) => {
                    self.decision(value, false);
                }
                Stmt::Local(local) => self.local(local),
                Stmt::Macro(called) => self.called(&called.mac),
                Stmt::Expr(expression, _) => self.visit_expr(expression),
                Stmt::Item(_) => {}
            }
        }
    }

    fn local(&mut self, local: &syn::Local) {
        let Some(init) = &local.init else { return };
        let Some((_, diverges)) = &init.diverge else { return self.visit_expr(&init.expr) };
        let text = self.text(&local.pat);
        let on = self.point(Kind::Branch, local, format!("let {text}: matched"));
        let past = self.point(Kind::Branch, local, format!("let {text}: not matched"));
        self.insertions.close(range(local).end, format!("::recorder::hit({on});"));
        self.visit_expr(&init.expr);
        if let Expr::Block(diverges) = diverges.as_ref() {
            self.insertions.open(inside(&diverges.block), format!("::recorder::hit({past});"));
            self.visit_block(&diverges.block);
        }
    }
}

impl<'ast> Visit<'ast> for Walk<'_> {
    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.body(&item.attrs, &item.sig, &item.block);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.body(&item.attrs, &item.sig, &item.block);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if let Some(block) = &item.default {
            self.body(&item.attrs, &item.sig, block);
        }
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        if item.attrs.iter().any(is_elsewhere) {
            return;
        }
        let around = self.owner.replace(self.text(item.self_ty.as_ref()));
        item.items.iter().for_each(|item| self.visit_impl_item(item));
        self.owner = around;
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !item.attrs.iter().any(is_elsewhere) {
            visit::visit_item_mod(self, item);
        }
    }

    // Declarations, made or evaluated at compile time.
    fn visit_item_macro(&mut self, _: &'ast syn::ItemMacro) {}
    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}

    fn visit_block(&mut self, block: &'ast Block) {
        self.statements(block, false);
    }

    fn visit_arm(&mut self, arm: &'ast syn::Arm) {
        let text = self.text(&arm.pat);
        let point = self.point(Kind::Branch, arm, format!("{text} =>"));
        if let Some((_, guard)) = &arm.guard {
            self.decision(guard, true);
        }
        self.insertions.wrap(&range(arm.body.as_ref()), format!("{{::recorder::hit({point});"), "}");
        self.visit_expr(&arm.body);
    }

    fn visit_expr(&mut self, expression: &'ast Expr) {
        if is_boolean(expression) {
            return self.decision(expression, false);
        }
        if let Expr::Closure(closure) = expression
            && !matches!(closure.body.as_ref(), Expr::Block(_))
        {
            let text = self.text(closure);
            let point = self.point(Kind::Statement, closure, text);
            self.insertions.wrap(&range(closure.body.as_ref()), format!("{{::recorder::hit({point});"), "}");
        }
        visit::visit_expr(self, expression);
    }

    fn visit_expr_if(&mut self, whole: &'ast syn::ExprIf) {
        if has_let(&whole.cond) {
            return self.if_let(whole);
        }
        self.decision(&whole.cond, true);
        self.visit_block(&whole.then_branch);
        if let Some((_, other)) = &whole.else_branch {
            self.visit_expr(other);
        }
    }

    fn visit_expr_while(&mut self, whole: &'ast syn::ExprWhile) {
        if has_let(&whole.cond) {
            self.left_out(whole, "while let".to_owned());
        } else {
            self.decision(&whole.cond, true);
        }
        self.visit_block(&whole.body);
    }

    fn visit_expr_macro(&mut self, called: &'ast syn::ExprMacro) {
        self.called(&called.mac);
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        let name = call.method.to_string();
        if BRANCHING.contains(&name.as_str()) {
            self.decision(&call.receiver, true);
        } else {
            self.visit_expr(&call.receiver);
        }
        self.arguments(&name, &call.args);
    }

    fn visit_expr_call(&mut self, call: &'ast syn::ExprCall) {
        self.visit_expr(&call.func);
        self.arguments(&self.text(&call.func), &call.args);
    }

    fn visit_expr_try(&mut self, tried: &'ast syn::ExprTry) {
        let text = self.text(tried);
        let on = self.point(Kind::Branch, tried, format!("{text}: goes on"));
        let back = self.point(Kind::Branch, tried, format!("{text}: returns"));
        self.insertions.wrap(&range(tried.expr.as_ref()), format!("::recorder::tried({on},{back},"), ")");
        self.visit_expr(&tried.expr);
    }
}

impl Walk<'_> {
    fn arguments(&mut self, name: &str, arguments: &syn::punctuated::Punctuated<Expr, Token![,]>) {
        for (number, argument) in arguments.iter().enumerate() {
            if number == 0 && arguments.len() > 1 && CONDITIONAL.contains(&name) {
                self.decision(argument, false);
            } else {
                self.visit_expr(argument);
            }
        }
    }
}
