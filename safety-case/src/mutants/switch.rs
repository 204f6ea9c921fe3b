//! Puts every mutant of a file into it at once, each behind a switch: one build then holds them all, and a number chooses one.
//!
//! What is built is `mutant_switch` ([`CRATE`]) and the rewritten files. A mutant is left out where it cannot be switched: in a function that must
//! stay `const`, in a condition that binds a name, or where the compiler refuses it. What is put in keeps the tree of the expression, as if in
//! parentheses, also where the other operator alone would bind differently.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use proc_macro2::Span;
use quote::ToTokens;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{
    Arm, BinOp, Block, Expr, ExprBinary, ExprMatch, ExprStruct, ExprUnary, ImplItemFn, ItemFn, ItemMod, Member, Pat,
    Signature,
};

/// The crate with the switch, for the copy.
pub const CRATE: &str = include_str!("switch.in");

/// What a mutant does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Genre {
    /// Replaces the body of a function by a value.
    Body,
    /// Replaces a binary operator.
    Binary,
    /// Deletes a unary operator.
    Unary,
    /// Deletes an arm of a match.
    Arm,
    /// Replaces the guard of an arm.
    Guard,
    /// Leaves a field to the base of a struct.
    Field,
}

/// A mutant of a file.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// Chooses it.
    pub number: u32,
    /// What it does.
    pub genre: Genre,
    /// Where, in bytes.
    pub place: Range<usize>,
    /// What stands there instead.
    pub replacement: String,
}

/// A file with its mutants behind switches.
#[derive(Clone, Debug)]
pub struct Switched {
    /// The text.
    pub text: String,
    /// The numbers of those that are in it.
    pub inside: BTreeSet<u32>,
    /// The numbers of those that leave a match without an arm for every value: they do not compile.
    pub unviable: BTreeSet<u32>,
}

impl Switched {
    /// The mutant whose code is the smallest that holds this byte.
    #[must_use]
    pub fn at(&self, byte: usize) -> Option<u32> {
        let range = |number: &u32| {
            let (begin, end) = (self.text.find(&opens(*number))?, self.text.rfind(&closes(*number))?);
            (begin..end).contains(&byte).then(|| end.saturating_sub(begin))
        };
        self.inside.iter().filter_map(|number| Some((range(number)?, *number))).min().map(|(_, number)| number)
    }
}

fn opens(number: u32) -> String {
    format!("/*<{number}*/")
}

fn closes(number: u32) -> String {
    format!("/*{number}>*/")
}

/// Puts the mutants into the file. Functions whose name is in `constant` keep their `const`, and none of their mutants is put in.
///
/// # Errors
/// The file is no Rust.
pub fn switched(text: &str, mutants: &[Mutant], constant: &BTreeSet<String>) -> Result<Switched, syn::Error> {
    let file = syn::parse_file(text)?;
    let mut by_place: BTreeMap<(Genre, usize, usize), Vec<&Mutant>> = BTreeMap::new();
    for mutant in mutants {
        by_place.entry((mutant.genre, mutant.place.start, mutant.place.end)).or_default().push(mutant);
    }
    let mut writer = Writer {
        text,
        by_place,
        constant,
        edits: BTreeMap::new(),
        inside: BTreeSet::new(),
        unviable: BTreeSet::new(),
        fixed: Vec::new(),
        whole: Vec::new(),
    };
    writer.visit_file(&file);
    let text = writer.take(0..text.len());
    Ok(Switched { text, inside: writer.inside, unviable: writer.unviable })
}

struct Writer<'a> {
    text: &'a str,
    by_place: BTreeMap<(Genre, usize, usize), Vec<&'a Mutant>>,
    constant: &'a BTreeSet<String>,
    /// What stands instead of these bytes; no two overlap.
    edits: BTreeMap<usize, (usize, String)>,
    inside: BTreeSet<u32>,
    unviable: BTreeSet<u32>,
    /// Whether the matches around have an arm for everything.
    whole: Vec<bool>,
    /// Whether the functions around must stay as they are.
    fixed: Vec<bool>,
}

fn bytes(span: Span) -> Range<usize> {
    span.byte_range()
}

fn of(node: &impl ToTokens) -> Range<usize> {
    bytes(node.span())
}

impl Writer<'_> {
    /// The bytes with every edit in them; the edits are used up.
    fn take(&mut self, range: Range<usize>) -> String {
        let starts: Vec<usize> = self.edits.range(range.clone()).map(|(start, _)| *start).collect();
        let (mut text, mut at) = (String::new(), range.start);
        for start in starts {
            let Some((end, new)) = self.edits.remove(&start) else { continue };
            text.push_str(self.text.get(at..start).unwrap_or_default());
            text.push_str(&new);
            at = end;
        }
        text.push_str(self.text.get(at..range.end).unwrap_or_default());
        text
    }

    fn put(&mut self, range: Range<usize>, text: String) {
        self.edits.insert(range.start, (range.end, text));
    }

    /// The mutants of a place; none where the function must stay as it is.
    fn mutants(&self, genre: Genre, range: &Range<usize>) -> Vec<(u32, String)> {
        if self.fixed.last().copied().unwrap_or(true) {
            return Vec::new();
        }
        let found = self.by_place.get(&(genre, range.start, range.end));
        found.into_iter().flatten().map(|mutant| (mutant.number, mutant.replacement.clone())).collect()
    }

    /// Replaces a node, and notes that these mutants are in.
    fn wrap(&mut self, range: Range<usize>, mutants: &[(u32, String)], text: &str) {
        let mut marked = text.to_owned();
        for (number, _) in mutants {
            marked = format!("{}{marked}{}", opens(*number), closes(*number));
            self.inside.insert(*number);
        }
        self.put(range, marked);
    }

    fn function(&mut self, signature: &Signature, block: &Block, visit: impl FnOnce(&mut Self)) {
        let fixed = self.constant.contains(&signature.ident.to_string());
        self.fixed.push(fixed);
        visit(self);
        if let (Some(constant), false) = (&signature.constness, fixed) {
            self.put(bytes(constant.span), String::new());
        }
        if let (Some(first), Some(last)) = (block.stmts.first(), block.stmts.last()) {
            let range = of(first).start..of(last).end;
            let mutants = self.mutants(Genre::Body, &range);
            if !mutants.is_empty() {
                let body = self.take(range.clone());
                let mut text = String::new();
                for (number, value) in &mutants {
                    let (opens, closes) = (opens(*number), closes(*number));
                    text = format!("{text}{opens}if ::mutant_switch::on({number}) {{ return {value}; }}{closes} ");
                    self.inside.insert(*number);
                }
                self.put(range, text + &body);
            }
        }
        self.fixed.pop();
    }
}

/// Whether the expression binds a name for what comes after it, or leaves the function: it then cannot stand in a closure.
fn binds(expression: &Expr) -> bool {
    struct Look(bool);
    impl<'a> Visit<'a> for Look {
        fn visit_expr_let(&mut self, _: &'a syn::ExprLet) {
            self.0 = true;
        }
        fn visit_expr_return(&mut self, _: &'a syn::ExprReturn) {
            self.0 = true;
        }
        fn visit_expr_try(&mut self, _: &'a syn::ExprTry) {
            self.0 = true;
        }
    }
    let mut look = Look(false);
    look.visit_expr(expression);
    look.0
}

impl<'a> Visit<'a> for Writer<'_> {
    fn visit_item_mod(&mut self, module: &'a ItemMod) {
        let tests = module.attrs.iter().any(|attribute| {
            attribute.path().is_ident("cfg") && attribute.to_token_stream().to_string().contains("test")
        });
        if !tests {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_item_fn(&mut self, function: &'a ItemFn) {
        self.function(&function.sig, &function.block, |writer| visit::visit_item_fn(writer, function));
    }

    fn visit_impl_item_fn(&mut self, function: &'a ImplItemFn) {
        self.function(&function.sig, &function.block, |writer| visit::visit_impl_item_fn(writer, function));
    }

    #[expect(clippy::wildcard_enum_match_arm, reason = "syn's operators may grow")]
    fn visit_expr_binary(&mut self, node: &'a ExprBinary) {
        visit::visit_expr_binary(self, node);
        let mutants = self.mutants(Genre::Binary, &of(&node.op));
        let lazy = matches!(node.op, BinOp::And(_) | BinOp::Or(_));
        if mutants.is_empty() || binds(&node.left) || lazy && binds(&node.right) {
            return;
        }
        let (left, right) = (self.take(of(&node.left)), self.take(of(&node.right)));
        let operator = node.op.to_token_stream().to_string();
        let first = mutants.first().map_or(0, |(number, _)| *number);
        let list =
            || mutants.iter().map(|(number, with)| format!("({number}, \"{with}\")")).collect::<Vec<_>>().join(", ");
        let text = match node.op {
            BinOp::And(_) => format!("::mutant_switch::and({first}, {left}, || {right})"),
            BinOp::Or(_) => format!("::mutant_switch::or({first}, {left}, || {right})"),
            BinOp::Eq(_) | BinOp::Ne(_) => format!("(({left} {operator} {right}) ^ ::mutant_switch::on({first}))"),
            BinOp::Lt(_) | BinOp::Gt(_) | BinOp::Le(_) | BinOp::Ge(_) => {
                format!("::mutant_switch::compare(&({left}), &({right}), \"{operator}\", &[{}])", list())
            }
            _ => mutants.iter().rev().fold(format!("({left} {operator} {right})"), |rest, (number, with)| {
                format!("(if ::mutant_switch::on({number}) {{ {left} {with} {right} }} else {{ {rest} }})")
            }),
        };
        self.wrap(of(node), &mutants, &text);
    }

    fn visit_expr_unary(&mut self, node: &'a ExprUnary) {
        visit::visit_expr_unary(self, node);
        let mutants = self.mutants(Genre::Unary, &of(&node.op));
        let Some((number, _)) = mutants.first() else { return };
        let (operator, operand) = (node.op.to_token_stream().to_string(), self.take(of(&node.expr)));
        let text = format!("(if ::mutant_switch::on({number}) {{ {operand} }} else {{ {operator}{operand} }})");
        self.wrap(of(node), &mutants, &text);
    }

    fn visit_expr_match(&mut self, node: &'a ExprMatch) {
        let takes_all = |arm: &Arm| arm.guard.is_none() && matches!(arm.pat, Pat::Wild(_) | Pat::Ident(_));
        self.whole.push(node.arms.iter().any(takes_all));
        visit::visit_expr_match(self, node);
        self.whole.pop();
    }

    fn visit_arm(&mut self, arm: &'a Arm) {
        visit::visit_arm(self, arm);
        let mut deleted = self.mutants(Genre::Arm, &of(arm));
        if !self.whole.last().copied().unwrap_or(false) {
            self.unviable.extend(deleted.drain(..).map(|(number, _)| number));
        }
        match &arm.guard {
            Some((_, guard)) if !binds(guard) => {
                let replaced = self.mutants(Genre::Guard, &of(guard));
                if replaced.is_empty() && deleted.is_empty() {
                    return;
                }
                let mut text = format!("({})", self.take(of(guard)));
                for (number, value) in &replaced {
                    text = if value == "true" {
                        format!("(::mutant_switch::on({number}) || {text})")
                    } else {
                        format!("(!::mutant_switch::on({number}) && {text})")
                    };
                }
                for (number, _) in &deleted {
                    text = format!("(!::mutant_switch::on({number}) && {text})");
                }
                self.wrap(of(guard), &[replaced, deleted].concat(), &text);
            }
            Some(_) => {}
            None => {
                if let Some((number, _)) = deleted.first() {
                    let pattern = self.take(of(&arm.pat));
                    self.wrap(of(&arm.pat), &deleted, &format!("{pattern} if !::mutant_switch::on({number})"));
                }
            }
        }
    }

    fn visit_expr_struct(&mut self, node: &'a ExprStruct) {
        visit::visit_expr_struct(self, node);
        let Some(base) = &node.rest else { return };
        for field in &node.fields {
            let Member::Named(name) = &field.member else { continue };
            let range = of(field);
            // cargo-mutants deletes the comma, too.
            let with_comma = self
                .text
                .get(range.end..)
                .and_then(|rest| rest.find(','))
                .map_or(range.end, |comma| range.end + comma + 1);
            let mutants = self.mutants(Genre::Field, &(range.start..with_comma));
            let Some((number, _)) = mutants.first() else { continue };
            let (value, base) = (self.take(of(&field.expr)), self.text.get(of(base)).unwrap_or_default());
            let text = format!("{name}: if ::mutant_switch::on({number}) {{ ({base}).{name} }} else {{ {value} }}");
            self.wrap(range, &mutants, &text);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{Genre, Mutant, switched};

    const SOURCE: &str = "impl S {\n    const fn f(a: u8, b: bool) -> bool {\n        !b && (a < 3 || b) && g(S { a: 1, ..T })\n    }\n}\n\
        fn h(a: u8) -> u8 {\n    match a {\n        1 if a != 2 => a + 1,\n        3 => 4,\n        _ => 0,\n    }\n}\n";

    fn mutant(number: u32, genre: Genre, what: &str, replacement: &str) -> Mutant {
        let start = SOURCE.find(what).unwrap_or_default();
        let skip =
            if genre == Genre::Binary { what.find(|c: char| "<&|=!+".contains(c)).unwrap_or_default() } else { 0 };
        let length = match genre {
            Genre::Binary => what.trim_end().len() - skip,
            Genre::Unary => 1,
            Genre::Body | Genre::Arm | Genre::Guard | Genre::Field => what.len(),
        };
        Mutant { number, genre, place: start + skip..start + skip + length, replacement: replacement.to_owned() }
    }

    fn text(mutants: &[Mutant], constant: &[&str]) -> (String, BTreeSet<u32>) {
        let constant = constant.iter().map(|name| (*name).to_owned()).collect();
        let Ok(switched) = switched(SOURCE, mutants, &constant) else { unreachable!("it is Rust") };
        assert!(syn::parse_file(&switched.text).is_ok(), "{}", switched.text);
        (switched.text, switched.inside)
    }

    #[test]
    fn nothing_to_put_in_changes_nothing_but_const() {
        assert_eq!(text(&[], &["f"]).0, SOURCE);
        assert_eq!(text(&[], &[]).0, SOURCE.replace("const fn", " fn"));
    }

    #[test]
    fn nested_mutants_stand_inside_each_other() {
        let all = [
            mutant(1, Genre::Unary, "!b", ""),
            mutant(2, Genre::Binary, "a < ", "<="),
            mutant(3, Genre::Binary, "a < ", "=="),
            mutant(4, Genre::Binary, "3 || ", "&&"),
            mutant(5, Genre::Field, "a: 1,", ""),
            mutant(6, Genre::Body, "!b && (a < 3 || b) && g(S { a: 1, ..T })", "true"),
        ];
        let (new, inside) = text(&all, &[]);
        assert_eq!(inside, (1..=6).collect());
        for part in [
            "if ::mutant_switch::on(6) { return true; }",
            "compare(&(a), &(3), \"<\", &[(2, \"<=\"), (3, \"==\")])",
            "::mutant_switch::or(4, /*<3*/",
            "a: if ::mutant_switch::on(5) { (T).a } else { 1 }",
            "(if ::mutant_switch::on(1) { b } else { !b })",
        ] {
            assert!(new.contains(part), "{part}\n{new}");
        }
        assert_eq!(text(&all, &["f"]).1, BTreeSet::new(), "a function that must stay constant has none");
    }

    #[test]
    fn arms_and_guards_are_switched_by_guards() {
        let all = [
            mutant(1, Genre::Guard, "a != 2", "true"),
            mutant(2, Genre::Guard, "a != 2", "false"),
            mutant(3, Genre::Arm, "3 => 4,", ""),
            mutant(4, Genre::Binary, "a + ", "*"),
        ];
        let (new, inside) = text(&all, &[]);
        assert_eq!(inside, (1..=4).collect());
        for part in [
            "(!::mutant_switch::on(2) && (::mutant_switch::on(1) || (a != 2)))",
            "3 if !::mutant_switch::on(3)",
            "(if ::mutant_switch::on(4) { a * 1 } else { (a + 1) })",
        ] {
            assert!(new.contains(part), "{part}\n{new}");
        }
    }

    #[test]
    fn a_place_in_the_new_text_names_its_mutant() {
        let all = [mutant(4, Genre::Binary, "3 || ", "&&"), mutant(2, Genre::Binary, "a < ", "<=")];
        let Ok(new) = switched(SOURCE, &all, &BTreeSet::new()) else { unreachable!("it is Rust") };
        let at = |what: &str| new.at(new.text.find(what).unwrap_or_default());
        assert_eq!((at("compare"), at("or(4"), at("impl")), (Some(2), Some(4), None));
    }
}
