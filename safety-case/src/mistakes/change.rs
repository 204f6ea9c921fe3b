//! One change of one source file.

use std::path::Path;
use std::str::FromStr;

use proc_macro2::TokenStream;
use sha2::{Digest, Sha256};

use crate::error::ToolError;

/// A source file with a mistake in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// Where it stands, from the root of the workspace.
    pub file: String,
    /// The whole text, with the mistake.
    pub text: String,
}

impl Change {
    /// The text of a file with `find` replaced, which must occur exactly once.
    ///
    /// # Errors
    /// What is wrong with it, in words: it occurs another number of times, changes nothing but comments, or the result
    /// is no Rust.
    pub fn new(file: &str, source: &str, find: &str, replace: &str) -> Result<Self, String> {
        match source.matches(find).count() {
            1 => Self::checked(file, source, source.replacen(find, replace, 1)),
            count => Err(format!("{file}: what is to be found occurs {count} times")),
        }
    }

    /// The text of a file with what stands from `start` to `end` replaced; places in bytes.
    ///
    /// # Errors
    /// As [`new`](Self::new); no such place in the file.
    pub fn at(file: &str, source: &str, start: usize, end: usize, replace: &str) -> Result<Self, String> {
        let parts = source.get(..start).zip(source.get(end..));
        let (before, after) = parts.ok_or_else(|| format!("{file}: no such place"))?;
        Self::checked(file, source, format!("{before}{replace}{after}"))
    }

    fn checked(file: &str, source: &str, text: String) -> Result<Self, String> {
        syn::parse_file(&text).map_err(|error| format!("{file}: with the mistake it is no Rust: {error}"))?;
        if tokens(source) == tokens(&text) {
            return Err(format!("{file}: the mistake changes no code"));
        }
        Ok(Self { file: file.to_owned(), text })
    }

    /// Identifies the change: a digest of the file with the mistake.
    #[must_use]
    pub fn digest(&self) -> String {
        format!("{:x}", Sha256::new().chain_update(&self.file).chain_update(tokens(&self.text)).finalize())
    }
}

/// The code without comments and layout.
fn tokens(text: &str) -> String {
    TokenStream::from_str(text).map_or_else(|_| text.to_owned(), |tokens| tokens.to_string())
}

/// A source file of the workspace.
pub(super) fn source(root: &Path, name: &str) -> Result<String, ToolError> {
    let path = root.join(name);
    std::fs::read_to_string(&path).map_err(|error| ToolError::File { path, error })
}

#[cfg(test)]
mod tests {
    use super::Change;

    const SOURCE: &str = "/// Says a < b.\nfn less(a: u8, b: u8) -> bool {\n    // a < b\n    a < b && b > a\n}\n";

    #[test]
    fn what_is_found_once_is_replaced() {
        let Ok(change) = Change::new("f.rs", SOURCE, "a < b &&", "a <= b &&") else { unreachable!("it occurs once") };
        assert_eq!(change.text, SOURCE.replace("a < b &&", "a <= b &&"));
        let Ok(other) = Change::new("f.rs", SOURCE, "b > a", "b >= a") else { unreachable!("it occurs once") };
        assert_ne!(change.digest(), other.digest());
    }

    #[test]
    fn a_mistake_that_is_none_is_refused() {
        for (find, replace, why) in [
            ("a < b", "a <= b", "3 times"),
            ("a == b", "a <= b", "0 times"),
            ("    // a < b\n", "", "changes no code"),
            ("a < b &&", "a < b  &&", "changes no code"),
            ("-> bool {", "-> bool (", "no Rust"),
        ] {
            let result = Change::new("f.rs", SOURCE, find, replace);
            assert!(result.as_ref().is_err_and(|error| error.contains(why)), "{find}: {result:?}");
        }
    }

    #[test]
    fn a_place_in_bytes_is_replaced_and_must_be_there() {
        let start = SOURCE.find("&&").unwrap_or(0);
        let change = Change::at("f.rs", SOURCE, start, start.saturating_add(2), "||");
        assert!(change.is_ok_and(|change| change.text.contains("a < b || b > a")));
        assert!(Change::at("f.rs", SOURCE, 9_999, 10_000, "x").is_err());
    }
}
