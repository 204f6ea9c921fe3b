//! Puts the recorder's calls into a source. Text is only put in, so lines stay as they are and nothing else changes.
//!
//! A decision `a && !b` becomes `({let __d=Eval::new(7);let __o=__d.c(0,a) && !__d.c(1,b);__d.done(__o)})`: the operators
//! stay, so what they pass over is still passed over. A statement gets `hit(n);` in front, the body of an arm or closure
//! becomes `{hit(n);body}`. `const` goes from functions, because nothing is recorded at compile time.

use std::ops::Range;

use syn::parse::{ParseStream, Parser};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, BinOp, Block, Expr, ReturnType, Signature, Stmt, Token, UnOp};

use super::insert::Insertions;
use super::plan::{Decision, Kind, Place, Plan, Point, Tree};
use super::recorder::CONDITIONS;

/// Functions whose first argument is a condition.
const CONDITIONAL: [&str; 5] = ["lower_if", "raise_if", "when", "run_while", "refuse"];
/// Methods of `bool` that branch.
const BRANCHING: [&str; 2] = ["then", "then_some"];
/// Macros whose arguments are plain expressions.
const PLAIN: [&str; 1] = ["channel"];
/// As much of a statement is shown.
const SHOWN: usize = 100;

/// The instrumented source; what can be covered goes into the plan, numbered on from what is in it.
///
/// # Errors
/// It is no Rust.
pub fn instrument(file: &str, source: &str, plan: &mut Plan) -> Result<String, syn::Error> {
    let parsed = syn::parse_file(source)?;
    let mut walk = Walk {
        file,
        source,
        plan,
        insertions: Insertions::default(),
        owner: None,
        function: None,
    };
    walk.visit_file(&parsed);
    let misplaced = || syn::Error::new(parsed.span(), "a place outside of the file");
    walk.insertions.put_into(source).ok_or_else(misplaced)
}

struct Walk<'a> {
    file: &'a str,
    source: &'a str,
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
        let words: Vec<&str> = lines.filter(|line| !line.trim_start().starts_with("//")).flat_map(str::split_whitespace).collect();
        words.join(" ")
    }

    fn point(&mut self, kind: Kind, at: &impl Spanned, text: String) -> usize {
        let text = text.char_indices().nth(SHOWN).and_then(|(end, _)| text.get(..end)).map_or(text.clone(), |start| format!("{start}…"));
        self.plan.points.push(Point { place: self.place(at), kind, text });
        self.plan.points.len().saturating_sub(1)
    }

    fn left_out(&mut self, at: &impl Spanned, why: String) {
        let place = self.place(at);
        self.plan.left_out.push((place, why));
    }

    /// A boolean expression that is no part of a greater one.
    fn decision(&mut self, whole: &Expr, branches: bool) {
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
            self.left_out(whole, format!("{conditions} conditions in one decision, where {CONDITIONS} can be recorded"));
        }
    }

    fn tree(&mut self, part: &Expr, decision: usize) -> Tree {
        match part {
            Expr::Paren(inner) => self.tree(&inner.expr, decision),
            Expr::Unary(not) if matches!(not.op, UnOp::Not(_)) => Tree::Not(Box::new(self.tree(&not.expr, decision))),
            Expr::Binary(both) if matches!(both.op, BinOp::And(_)) => {
                let left = self.tree(&both.left, decision);
                Tree::All(Box::new(left), Box::new(self.tree(&both.right, decision)))
            }
            Expr::Binary(both) if matches!(both.op, BinOp::Or(_)) => {
                let left = self.tree(&both.left, decision);
                Tree::Any(Box::new(left), Box::new(self.tree(&both.right, decision)))
            }
            condition => {
                let shown = (condition.span().start().line, self.text(condition));
                let conditions = self.plan.decisions.get_mut(decision).map(|decision| &mut decision.conditions);
                let number = conditions.map_or(0, |conditions| {
                    conditions.push(shown);
                    conditions.len().saturating_sub(1)
                });
                self.insertions.wrap(&range(condition), format!("__d.c({number},"), ")");
                self.within(condition);
                Tree::Leaf(number)
            }
        }
    }

    /// What is inside a condition, which itself is no decision.
    fn within(&mut self, condition: &Expr) {
        match condition {
            Expr::Binary(compared) => {
                self.visit_expr(&compared.left);
                self.visit_expr(&compared.right);
            }
            Expr::Macro(matches) if matches.mac.path.is_ident("matches") => self.matched(&matches.mac),
            other => self.visit_expr(other),
        }
    }

    /// The expression of `matches!`.
    fn matched(&mut self, mac: &syn::Macro) {
        let parts = |input: ParseStream| {
            let (value, _): (Expr, Token![,]) = (input.parse()?, input.parse()?);
            Ok((value, syn::Pat::parse_multi_with_leading_vert(input)?, input.is_empty() || input.peek(Token![,]), input.parse::<proc_macro2::TokenStream>()?))
        };
        match parts.parse2(mac.tokens.clone()) {
            Ok((value, _, whole, _)) => {
                self.visit_expr(&value);
                if !whole {
                    self.left_out(mac, "the guard of matches!".to_owned());
                }
            }
            Err(error) => self.left_out(mac, format!("matches!: {error}")),
        }
    }

    /// `condition => reason, ..`: each condition is a decision that branches.
    fn permit(&mut self, mac: &syn::Macro) {
        let pairs = |input: ParseStream| {
            let mut pairs: Vec<(Expr, Expr)> = Vec::new();
            while !input.is_empty() {
                let condition = input.parse()?;
                input.parse::<Token![=>]>()?;
                pairs.push((condition, input.parse()?));
                input.parse::<Option<Token![,]>>()?;
            }
            Ok(pairs)
        };
        match pairs.parse2(mac.tokens.clone()) {
            Ok(pairs) => {
                for (condition, reason) in &pairs {
                    self.decision(condition, true);
                    self.visit_expr(reason);
                }
            }
            Err(error) => self.left_out(mac, format!("permit!: {error}")),
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
        match part {
            Expr::Let(bound) => self.visit_expr(&bound.expr),
            Expr::Binary(both) if matches!(both.op, BinOp::And(_)) => {
                self.chained(&both.left);
                self.chained(&both.right);
            }
            condition => self.decision(condition, false),
        }
    }

    fn called(&mut self, mac: &syn::Macro) {
        let name = mac.path.segments.last().map(|segment| segment.ident.to_string()).unwrap_or_default();
        if name == "permit" {
            self.permit(mac);
        } else if PLAIN.contains(&name.as_str()) {
            let list = syn::punctuated::Punctuated::<Expr, Token![,]>::parse_terminated;
            match list.parse2(mac.tokens.clone()) {
                Ok(list) => list.iter().for_each(|argument| self.visit_expr(argument)),
                Err(error) => self.left_out(mac, format!("{name}!: {error}")),
            }
        } else {
            self.left_out(mac, format!("{name}!"));
        }
    }

    /// A function: its `const` goes, and what it gives as `bool` is a decision.
    fn body(&mut self, attributes: &[Attribute], signature: &Signature, block: &Block) {
        if attributes.iter().any(is_elsewhere) {
            return;
        }
        let name = self.owner.as_ref().map_or_else(|| signature.ident.to_string(), |owner| format!("{owner}::{}", signature.ident));
        let around = self.function.replace(name);
        if let Some(constness) = &signature.constness {
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
                Stmt::Expr(value, None) if gives_bool && number == last && !is_structured(value) => self.decision(value, false),
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
        match expression {
            Expr::If(whole) if has_let(&whole.cond) => self.if_let(whole),
            Expr::If(whole) => {
                self.decision(&whole.cond, true);
                self.visit_block(&whole.then_branch);
                if let Some((_, other)) = &whole.else_branch {
                    self.visit_expr(other);
                }
            }
            Expr::While(whole) if has_let(&whole.cond) => {
                self.left_out(whole, "while let".to_owned());
                self.visit_block(&whole.body);
            }
            Expr::While(whole) => {
                self.decision(&whole.cond, true);
                self.visit_block(&whole.body);
            }
            boolean if is_boolean(boolean) => self.decision(boolean, false),
            Expr::Macro(called) => self.called(&called.mac),
            Expr::MethodCall(call) => {
                let name = call.method.to_string();
                if BRANCHING.contains(&name.as_str()) {
                    self.decision(&call.receiver, true);
                } else {
                    self.visit_expr(&call.receiver);
                }
                self.arguments(&name, &call.args);
            }
            Expr::Call(call) => {
                let name = match call.func.as_ref() {
                    Expr::Path(path) => path.path.segments.last().map(|segment| segment.ident.to_string()),
                    _ => None,
                };
                self.visit_expr(&call.func);
                self.arguments(&name.unwrap_or_default(), &call.args);
            }
            Expr::Closure(closure) if !matches!(closure.body.as_ref(), Expr::Block(_)) => {
                let text = self.text(closure);
                let point = self.point(Kind::Statement, closure, text);
                self.insertions.wrap(&range(closure.body.as_ref()), format!("{{::recorder::hit({point});"), "}");
                self.visit_expr(&closure.body);
            }
            Expr::Try(tried) => {
                let text = self.text(tried);
                let on = self.point(Kind::Branch, tried, format!("{text}: goes on"));
                let back = self.point(Kind::Branch, tried, format!("{text}: returns"));
                self.insertions.wrap(&range(tried.expr.as_ref()), format!("::recorder::tried({on},{back},"), ")");
                self.visit_expr(&tried.expr);
            }
            other => visit::visit_expr(self, other),
        }
    }
}

impl Walk<'_> {
    fn arguments(&mut self, name: &str, arguments: &syn::punctuated::Punctuated<Expr, Token![,]>) {
        for (number, argument) in arguments.iter().enumerate() {
            if number == 0 && CONDITIONAL.contains(&name) {
                self.decision(argument, false);
            } else {
                self.visit_expr(argument);
            }
        }
    }
}

fn range(of: &impl Spanned) -> Range<usize> {
    of.span().byte_range()
}

/// Behind the brace that opens it.
fn inside(block: &Block) -> usize {
    block.brace_token.span.open().byte_range().end
}

/// Not compiled here: proofs, contracts, fuzzers, tests.
fn is_elsewhere(attribute: &Attribute) -> bool {
    let words = |list: &syn::MetaList| list.tokens.to_string();
    attribute.path().is_ident("cfg")
        && attribute.meta.require_list().is_ok_and(|list| ["kani", "creusot", "fuzzing", "test"].iter().any(|word| words(list).contains(word)))
}

/// Boolean by its form.
fn is_boolean(expression: &Expr) -> bool {
    match expression {
        Expr::Paren(inner) => is_boolean(&inner.expr),
        Expr::Unary(not) => matches!(not.op, UnOp::Not(_)),
        Expr::Binary(both) => matches!(
            both.op,
            BinOp::And(_) | BinOp::Or(_) | BinOp::Eq(_) | BinOp::Ne(_) | BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_)
        ),
        Expr::Macro(called) => called.mac.path.is_ident("matches"),
        _ => false,
    }
}

/// Has branches of its own, or returns by itself.
fn is_structured(expression: &Expr) -> bool {
    matches!(expression, Expr::If(_) | Expr::Match(_) | Expr::Block(_) | Expr::Return(_) | Expr::Macro(_))
        && !is_boolean(expression)
}

/// Binds by a pattern.
fn has_let(condition: &Expr) -> bool {
    match condition {
        Expr::Let(_) => true,
        Expr::Binary(both) => matches!(both.op, BinOp::And(_)) && (has_let(&both.left) || has_let(&both.right)),
        _ => false,
    }
}
