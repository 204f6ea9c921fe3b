//! Comments and string literals of a Rust source, by their places.
//!
//! Comments are what lies between the tokens, so nothing in a string is taken for one.

use std::ops::Range;

use proc_macro2::{TokenStream, TokenTree};

use super::rust::Form;

/// Everything in the source, in order.
pub(super) fn passages(text: &str, tokens: TokenStream) -> Vec<Found> {
    let mut raw = Raw { text, past: 0, found: Vec::new() };
    raw.stream(tokens);
    raw.gap(text.len());
    raw.found
}

/// A comment or literal before it has found its item.
pub(super) struct Found {
    /// Its words.
    pub words: String,
    /// Where it stands.
    pub bytes: Range<usize>,
    /// What it is.
    pub form: Form,
    /// Code stands before it on its line.
    pub trailing: bool,
    /// How it begins: `//`, `///`, `//!`, ...
    pub sign: &'static str,
}

/// Comments and string literals by their places.
struct Raw<'a> {
    text: &'a str,
    past: usize,
    found: Vec<Found>,
}

impl Raw<'_> {
    fn stream(&mut self, stream: TokenStream) {
        for tree in stream {
            match &tree {
                TokenTree::Group(group) => {
                    let open = group.span_open().byte_range();
                    // A doc comment is `#[doc = ".."]` at the place of the comment, which has been taken with its `#`.
                    if open.start < self.past && group.span().byte_range().end <= self.past {
                        continue;
                    }
                    self.gap(open.start);
                    self.past = self.past.max(open.end);
                    self.stream(group.stream());
                    let close = group.span_close().byte_range();
                    self.gap(close.start);
                    self.past = self.past.max(close.end);
                }
                TokenTree::Ident(_) | TokenTree::Punct(_) | TokenTree::Literal(_) => self.leaf(&tree),
            }
        }
    }

    fn leaf(&mut self, tree: &TokenTree) {
        let bytes = tree.span().byte_range();
        if bytes.start < self.past {
            return;
        }
        self.gap(bytes.start);
        let source = self.text.get(bytes.clone()).unwrap_or_default();
        if source.starts_with("//") || source.starts_with("/*") {
            self.gap(bytes.end);
        } else if let TokenTree::Literal(literal) = tree
            && let syn::Lit::Str(text) = syn::Lit::new(literal.clone())
        {
            self.found.push(Found {
                words: text.value(),
                bytes: bytes.clone(),
                form: Form::Literal,
                trailing: true,
                sign: "",
            });
        }
        self.past = self.past.max(bytes.end);
    }

    /// The comments between the last token and the next one, or one doc comment.
    fn gap(&mut self, end: usize) {
        let mut at = self.past;
        while let Some(begin) = self.text.get(at..end).and_then(|gap| gap.find('/')).map(|found| at + found) {
            let rest = self.text.get(begin..end).unwrap_or_default();
            let length = if rest.starts_with("//") {
                rest.find('\n').unwrap_or(rest.len())
            } else {
                rest.find("*/").map_or(rest.len(), |found| found + 2)
            };
            self.comment(begin..begin + length.max(1));
            at = begin + length.max(1);
        }
        self.past = self.past.max(end);
    }

    fn comment(&mut self, bytes: Range<usize>) {
        let source = self.text.get(bytes.clone()).unwrap_or_default();
        let signs = ["//!", "///", "//", "/*!", "/**", "/*"];
        let sign = signs.into_iter().find(|sign| source.starts_with(sign)).unwrap_or_default();
        let words = source.trim_start_matches(['/', '!', '*']).trim_end_matches("*/").trim().to_owned();
        let line = self.text.get(..bytes.start).unwrap_or_default().rsplit('\n').next().unwrap_or_default();
        let trailing = !line.trim().is_empty();
        // Line comments of one kind, each alone on its line, one below the other, are one passage.
        let gap = |last: &Found| self.text.get(last.bytes.end..bytes.start).unwrap_or("?");
        if let Some(last) = self.found.last_mut()
            && (last.sign, last.trailing, trailing) == (sign, false, false)
            && gap(last).trim().is_empty()
            && gap(last).matches('\n').count() == 1
        {
            last.words.push('\n');
            last.words.push_str(&words);
            last.bytes.end = bytes.end;
            return;
        }
        let form = if matches!(sign, "///" | "/**") { Form::Doc } else { Form::Comment };
        self.found.push(Found { words, bytes, form, trailing, sign });
    }
}
