//! One Rust file: its items, its comments and literals, and which item each of them belongs to.
//!
//! syn finds the items; inside a macro such as `limits!` or `proptest!`, what stands behind an attribute or doc comment
//! is an item.

use std::ops::Range;

use proc_macro2::{Delimiter, Span, TokenStream, TokenTree};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

use super::passages::{Found, passages};

/// An item: function, type, field, variant, constant, module, or a documented part of a macro's input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    /// Its path in the file, as in `Parking::bound`.
    pub name: String,
    /// Line of its name, from 1.
    pub line: usize,
    /// A `#[test]` that is not ignored.
    pub test: bool,
    /// It, or what it stands in, is only compiled for tests.
    pub for_tests: bool,
    /// A function.
    pub function: bool,
    /// A constant or static.
    pub constant: bool,
    bytes: Range<usize>,
    leaf: bool,
}

/// A comment or string literal and where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Passage {
    /// Its words, without the comment signs; the lines of a block of line comments are one passage.
    pub text: String,
    /// Its first line, from 1.
    pub line: usize,
    /// What it is.
    pub form: Form,
    /// The item it belongs to, by its place in [`File::items`]; none for the head of the file.
    pub item: Option<usize>,
}

/// What a passage is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A doc comment of an item.
    Doc,
    /// Any other comment.
    Comment,
    /// A string literal.
    Literal,
}

/// A parsed file.
#[derive(Debug, Default)]
pub struct File {
    /// Its items; what contains comes before what it contains.
    pub items: Vec<Item>,
    /// Its comments and string literals, in order.
    pub passages: Vec<Passage>,
}

/// Reads a file.
///
/// # Errors
/// It is no Rust.
pub fn read(text: &str) -> Result<File, syn::Error> {
    // syn drops it and byte ranges count from behind it.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let tokens: TokenStream = text.parse()?;
    let mut items = Items::default();
    items.visit_file(&syn::parse2(tokens.clone())?);
    let passages = passages(text, tokens).into_iter().map(|found| {
        let item = items.owner(text, &found);
        let line = line_of(text, found.bytes.start);
        Passage { text: found.words, line, form: found.form, item }
    });
    let passages = passages.collect();
    Ok(File { items: items.found, passages })
}

fn line_of(text: &str, at: usize) -> usize {
    text.get(..at).map_or(0, |before| before.matches('\n').count()) + 1
}

#[derive(Default)]
struct Items {
    found: Vec<Item>,
    path: Vec<String>,
    for_tests: bool,
}

fn marked(attributes: &[syn::Attribute], name: &str) -> bool {
    attributes.iter().any(|attribute| attribute.path().is_ident(name))
}

fn only_for_tests(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute.meta.require_list().is_ok_and(|list| list.tokens.to_string() == "test")
    })
}

impl Items {
    fn add(&mut self, name: &str, at: Span, bytes: Range<usize>, attributes: &[syn::Attribute], leaf: bool) -> bool {
        let path: Vec<&str> = self.path.iter().map(String::as_str).chain([name]).collect();
        let for_tests = self.for_tests || only_for_tests(attributes);
        self.found.push(Item {
            name: path.join("::"),
            line: at.start().line,
            test: marked(attributes, "test") && !marked(attributes, "ignore"),
            for_tests,
            function: false,
            constant: false,
            bytes,
            leaf,
        });
        for_tests
    }

    fn inside(&mut self, name: &str, for_tests: bool, visit: impl FnOnce(&mut Self)) {
        let before = std::mem::replace(&mut self.for_tests, for_tests);
        self.path.push(name.to_owned());
        visit(self);
        self.path.pop();
        self.for_tests = before;
    }

    fn function(&mut self) {
        if let Some(item) = self.found.last_mut() {
            item.function = true;
        }
    }

    /// The innermost item around a passage; a line comment in front of an item, or behind it on its line, is that item's.
    fn owner(&self, text: &str, found: &Found) -> Option<usize> {
        let inner = (self.found.iter().enumerate())
            .filter(|(_, item)| item.bytes.start <= found.bytes.start && found.bytes.end <= item.bytes.end)
            .min_by_key(|(_, item)| item.bytes.len())
            .map(|(index, _)| index);
        let container = inner.and_then(|index| self.found.get(index));
        if found.form != Form::Comment || found.sign.ends_with('!') || container.is_some_and(|item| item.leaf) {
            return inner;
        }
        let within = container.map_or(0..text.len(), |item| item.bytes.clone());
        let mut children = self.found.iter().enumerate().filter(|(index, item)| {
            Some(*index) != inner && within.start <= item.bytes.start && item.bytes.end <= within.end
        });
        let beside = |end: usize| text.get(end..found.bytes.start).is_some_and(|gap| !gap.contains('\n'));
        let neighbour = if found.trailing {
            children.rfind(|(_, item)| item.bytes.end <= found.bytes.start && beside(item.bytes.end))
        } else {
            children.find(|(_, item)| item.bytes.start >= found.bytes.end)
        };
        neighbour.map(|(index, _)| index).or(inner)
    }

    /// The documented parts of a macro's input.
    fn tokens(&mut self, stream: TokenStream) {
        let trees: Vec<TokenTree> = stream.into_iter().collect();
        let end = trees.last().map_or(0, |tree| tree.span().byte_range().end);
        let is_attribute = |index: usize| {
            matches!(trees.get(index), Some(TokenTree::Punct(sign)) if sign.as_char() == '#')
                && matches!(trees.get(index + 1), Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Bracket)
        };
        let mut index = 0;
        while let Some(tree) = trees.get(index) {
            if !is_attribute(index) {
                if let TokenTree::Group(group) = tree {
                    self.tokens(group.stream());
                }
                index += 1;
                continue;
            }
            let start = tree.span().byte_range().start;
            let mut attributes = Vec::new();
            while is_attribute(index) {
                attributes.extend(trees.get(index + 1).map(ToString::to_string));
                index += 2;
            }
            let mut function = false;
            let name = loop {
                match trees.get(index) {
                    Some(TokenTree::Ident(ident)) if is_keyword(&ident.to_string()) => function |= ident == "fn",
                    Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis => (),
                    Some(TokenTree::Ident(ident)) => break Some(ident),
                    _ => break None,
                }
                index += 1;
            };
            let next = (index..trees.len()).find(|later| is_attribute(*later));
            let stop = next.and_then(|next| trees.get(next)).map_or(end, |tree| tree.span().byte_range().start);
            let Some(name) = name else { continue };
            if function {
                index = next.unwrap_or(trees.len());
            }
            let mark = |what: &str| attributes.iter().any(|attribute| attribute == what);
            self.add(&name.to_string(), name.span(), start..stop, &[], function);
            if let Some(item) = self.found.last_mut() {
                item.function = function;
                item.test = mark("[test]") && !mark("[ignore]");
            }
        }
    }
}

fn is_keyword(word: &str) -> bool {
    ["pub", "const", "unsafe", "async", "fn", "struct", "enum", "static", "type", "mod"].contains(&word)
}

/// Visits what has a name and attributes: adds it, then what stands inside.
macro_rules! visit {
    ($($method:ident: $type:ident, $leaf:literal, |$node:ident| $name:expr;)+) => { $(
        fn $method(&mut self, $node: &'ast syn::$type) {
            let (name, at): (String, Span) = $name;
            let for_tests = self.add(&name, at, $node.span().byte_range(), &$node.attrs, $leaf);
            // What is visited here and holds no items is a constant.
            self.found.iter_mut().last().into_iter().for_each(|item| item.constant = $leaf);
            self.inside(&name, for_tests, |items| visit::$method(items, $node));
        }
    )+ };
}

fn ident(ident: &syn::Ident) -> (String, Span) {
    (ident.to_string(), ident.span())
}

/// The name of the type that is implemented.
fn self_type(node: &syn::ItemImpl) -> (String, Span) {
    let last = if let syn::Type::Path(path) = &*node.self_ty { path.path.segments.last() } else { None };
    let name = last.map(|segment| segment.ident.to_string());
    (name.unwrap_or_else(|| "impl".to_owned()), node.self_ty.span())
}

impl<'ast> Visit<'ast> for Items {
    visit! {
        visit_item_mod: ItemMod, false, |node| ident(&node.ident);
        visit_item_impl: ItemImpl, false, |node| self_type(node);
        visit_item_trait: ItemTrait, false, |node| ident(&node.ident);
        visit_item_struct: ItemStruct, false, |node| ident(&node.ident);
        visit_item_enum: ItemEnum, false, |node| ident(&node.ident);
        visit_item_union: ItemUnion, false, |node| ident(&node.ident);
        visit_item_type: ItemType, false, |node| ident(&node.ident);
        visit_item_const: ItemConst, true, |node| ident(&node.ident);
        visit_item_static: ItemStatic, true, |node| ident(&node.ident);
        visit_impl_item_const: ImplItemConst, true, |node| ident(&node.ident);
        visit_trait_item_const: TraitItemConst, true, |node| ident(&node.ident);
        visit_variant: Variant, false, |node| ident(&node.ident);
    }

    fn visit_item_fn(&mut self, node: &'ast syn::ItemFn) {
        self.add(&node.sig.ident.to_string(), node.sig.ident.span(), node.span().byte_range(), &node.attrs, true);
        self.function();
    }
    fn visit_impl_item_fn(&mut self, node: &'ast syn::ImplItemFn) {
        self.add(&node.sig.ident.to_string(), node.sig.ident.span(), node.span().byte_range(), &node.attrs, true);
        self.function();
    }
    fn visit_trait_item_fn(&mut self, node: &'ast syn::TraitItemFn) {
        self.add(&node.sig.ident.to_string(), node.sig.ident.span(), node.span().byte_range(), &node.attrs, true);
        self.function();
    }
    fn visit_field(&mut self, node: &'ast syn::Field) {
        let Some(name) = &node.ident else { return };
        self.add(&name.to_string(), name.span(), node.span().byte_range(), &node.attrs, true);
    }
    fn visit_item_macro(&mut self, node: &'ast syn::ItemMacro) {
        let rules = node.ident.as_ref().map(ident);
        let name = rules.clone().or_else(|| node.mac.path.segments.last().map(|last| ident(&last.ident)));
        let Some((name, at)) = name else { return };
        let name = format!("{name}!");
        let for_tests = self.add(&name, at, node.span().byte_range(), &node.attrs, rules.is_some());
        if rules.is_none() {
            self.inside(&name, for_tests, |items| items.tokens(node.mac.tokens.clone()));
        }
    }
    fn visit_impl_item_macro(&mut self, node: &'ast syn::ImplItemMacro) {
        self.tokens(node.mac.tokens.clone());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = r##"//! Head.
/// Doc of
/// two lines.
#[derive(Debug)]
pub struct Lamp {
    /// Of a field.
    on: bool, // behind it
    off: bool,
}
// In front of the impl.
impl Lamp {
    /// Doc.
    fn lit(&self) -> bool {
        // Inside.
        let text = "// no comment"; /* block */
        text == r#"raw // "none" "# && self.on / 2 > 1
    }
    // In front of a constant.
    const MOST: u8 = 3;
}
table! {
    /// A row.
    most: u8 = [3], "BRK-1a";
    /// Another.
    #[test]
    fn runs(x in 0..1) { /* in it */ }
}
#[cfg(test)]
mod tests {
    /// Checks.
    #[test]
    fn checks() {}
    /// Sleeps.
    #[test]
    #[ignore = "slow"]
    fn sleeps() {}
}
"##;

    #[test]
    fn every_comment_belongs_to_its_item() -> Result<(), syn::Error> {
        let file = read(SOURCE)?;
        let name =
            |passage: &Passage| passage.item.and_then(|index| file.items.get(index)).map_or("", |item| &item.name);
        let found: Vec<(usize, &str, &str)> =
            file.passages.iter().map(|passage| (passage.line, passage.text.as_str(), name(passage))).collect();
        let expected = [
            (1, "Head.", ""),
            (2, "Doc of\ntwo lines.", "Lamp"),
            (6, "Of a field.", "Lamp::on"),
            (7, "behind it", "Lamp::on"),
            (10, "In front of the impl.", "Lamp"),
            (12, "Doc.", "Lamp::lit"),
            (14, "Inside.", "Lamp::lit"),
            (15, "// no comment", "Lamp::lit"),
            (15, "block", "Lamp::lit"),
            (16, "raw // \"none\" ", "Lamp::lit"),
            (18, "In front of a constant.", "Lamp::MOST"),
            (22, "A row.", "table!::most"),
            (23, "BRK-1a", "table!::most"),
            (24, "Another.", "table!::runs"),
            (26, "in it", "table!::runs"),
            (30, "Checks.", "tests::checks"),
            (33, "Sleeps.", "tests::sleeps"),
            (35, "slow", "tests::sleeps"),
        ];
        assert_eq!(found, expected);
        Ok(())
    }

    #[test]
    fn items_know_what_they_are() -> Result<(), syn::Error> {
        let file = read(SOURCE)?;
        let which = |of: fn(&Item) -> bool| -> Vec<&str> {
            file.items.iter().filter(|item| of(item)).map(|item| item.name.as_str()).collect()
        };
        assert_eq!(which(|item| item.test), ["table!::runs", "tests::checks"]);
        assert_eq!(which(|item| item.constant), ["Lamp::MOST"]);
        assert_eq!(which(|item| item.function), ["Lamp::lit", "table!::runs", "tests::checks", "tests::sleeps"]);
        assert_eq!(which(|item| item.for_tests), ["tests", "tests::checks", "tests::sleeps"]);
        assert!(read("fn {").is_err());
        Ok(())
    }
}
