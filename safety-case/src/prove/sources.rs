//! Digests of what a proof speaks of: its sources and its configuration. When one changes, the proof is stale.

use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};
use sha2::{Digest, Sha256};
use supervisor::{SEALED_BYTES, Sealed};

use super::error::{ProveError, file, form, read};

/// Folders whose sources a proof speaks of.
pub const SOURCES: [&str; 6] = [
    "supervisor/terms/src",
    "supervisor/observe/src",
    "supervisor/core/src",
    "supervisor/perceive/src",
    "supervisor/wire/src",
    "proofs/src",
];

/// The digest of bytes, in hexadecimal.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    format!("{:x}", Sha256::digest(bytes))
}

/// Digest of the default configuration as it is sealed.
///
/// # Errors
/// The table of limits contradicts itself.
pub fn default_configuration() -> Result<String, ProveError> {
    let sealed = Sealed::from_default().map_err(|error| ProveError::Arguments(error.to_string()))?;
    Ok(configuration_digest(&sealed.to_bytes()))
}

/// Digest of a sealed configuration.
#[must_use]
pub fn configuration_digest(bytes: &[u8; SEALED_BYTES]) -> String {
    sha256(bytes)
}

/// Digest of the token streams of the sources, their attributes for Kani included. Comments, doc comments and layout are
/// no tokens, so they make no proof stale.
///
/// # Errors
/// A folder or file cannot be read, or is no Rust.
pub fn sources_digest(root: &Path) -> Result<String, ProveError> {
    let mut files = Vec::new();
    for folder in SOURCES {
        collect(&root.join(folder), &mut files)?;
    }
    files.sort();
    let mut digest = Sha256::new();
    for path in files {
        let name = path.strip_prefix(root).unwrap_or(&path).to_string_lossy().replace('\\', "/");
        put(&mut digest, &name);
        let tokens: TokenStream = read(&path)?.parse().map_err(|error| form(&path, &error))?;
        add(&mut digest, tokens);
    }
    Ok(format!("{:x}", digest.finalize()))
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), ProveError> {
    let error = |error| file(folder, error);
    for entry in fs::read_dir(folder).map_err(error)? {
        let path = entry.map_err(error)?.path();
        if path.is_dir() {
            collect(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(())
}

/// A word, closed so that no two sequences of words run into the same bytes.
fn put(digest: &mut Sha256, word: &str) {
    digest.update(word.as_bytes());
    digest.update([0]);
}

fn add(digest: &mut Sha256, tokens: TokenStream) {
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        match token {
            TokenTree::Punct(punct) if punct.as_char() == '#' => {
                // `#[..]` and `#![..]`
                let inner = tokens.next_if(|next| matches!(next, TokenTree::Punct(bang) if bang.as_char() == '!'));
                if tokens.next_if(is_doc).is_none() {
                    put(digest, if inner.is_some() { "#!" } else { "#" });
                }
            }
            TokenTree::Punct(punct) => {
                // `&&` and `& &` differ; `=-` and `= -` do not.
                let next = match tokens.peek() {
                    Some(TokenTree::Punct(next)) if punct.spacing() == Spacing::Joint => Some(next.as_char()),
                    _ => None,
                };
                let joined = next.is_some_and(|next| is_operator(punct.as_char(), next));
                put(digest, &format!("{}{}", punct.as_char(), if joined { "+" } else { "" }));
            }
            TokenTree::Group(group) => {
                let (open, close) = match group.delimiter() {
                    Delimiter::Parenthesis => ("(", ")"),
                    Delimiter::Brace => ("{", "}"),
                    Delimiter::Bracket => ("[", "]"),
                    Delimiter::None => ("", ""),
                };
                put(digest, open);
                add(digest, group.stream());
                put(digest, close);
            }
            TokenTree::Ident(ident) => put(digest, &ident.to_string()),
            TokenTree::Literal(literal) => put(digest, &literal.to_string()),
        }
    }
}

/// `[doc = ".."]`, which a doc comment is, too.
fn is_doc(token: &TokenTree) -> bool {
    let TokenTree::Group(group) = token else { return false };
    let first = group.stream().into_iter().next();
    group.delimiter() == Delimiter::Bracket && matches!(first, Some(TokenTree::Ident(name)) if name == "doc")
}

/// Whether two signs that touch are one operator.
fn is_operator(first: char, second: char) -> bool {
    match second {
        '=' => "+-*/%^&|=!<>.".contains(first),
        '&' | '|' | '<' | ':' | '.' => first == second,
        '>' => "->=".contains(first),
        '-' => first == '<',
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<String, Box<dyn std::error::Error>> {
        let root = tempfile::tempdir()?;
        for folder in SOURCES {
            fs::create_dir_all(root.path().join(folder))?;
        }
        fs::write(root.path().join("supervisor/core/src/seat.rs"), text)?;
        Ok(sources_digest(root.path())?)
    }

    const PLAIN: &str = "pub fn at(x: u8, y: bool) -> bool { x>=-1 && *&y || a::<b> }\n";

    #[test]
    fn comments_and_layout_make_nothing_stale() -> Result<(), Box<dyn std::error::Error>> {
        let plain = of(PLAIN)?;
        for same in [
            "//! SEAT-5a.\n\npub fn at(\n    x: u8,\n    y: bool) -> bool {\n    // why\n    x >= -1 && *&y || a::<b>\n}\n",
            "#![doc = \"d\"]\n/// Docs.\n#[doc(hidden)]\npub fn at(x: u8, /* c */ y: bool) -> bool { x >= - 1 && * & y || a::< b > }",
        ] {
            assert_eq!(plain, of(same)?, "{same}");
        }
        Ok(())
    }

    #[test]
    fn a_token_makes_it_stale() -> Result<(), Box<dyn std::error::Error>> {
        let plain = of(PLAIN)?;
        for other in [
            PLAIN.replace(">=", ">"),
            PLAIN.replace("&&", "& &"),
            PLAIN.replace(">=-1", "> = -1"),
            PLAIN.replace("-1", "-2"),
            PLAIN.replace("x: u8", "z: u8"),
            PLAIN.replace("pub fn", "#[inline] pub fn"),
            PLAIN.replace("pub fn", "#[kani::unwind(3)] pub fn"),
            PLAIN.replace("pub fn", "#[kani::unwind(4)] pub fn"),
            PLAIN.replace("{ x>=-1", "{ (x>=-1)"),
        ] {
            assert_ne!(plain, of(&other)?, "{other}");
        }
        let three = of(&PLAIN.replace("pub fn", "#[kani::unwind(3)] pub fn"))?;
        assert_ne!(three, of(&PLAIN.replace("pub fn", "#[kani::unwind(4)] pub fn"))?);
        Ok(())
    }

    #[test]
    fn the_configuration_is_the_sealed_default() -> Result<(), Box<dyn std::error::Error>> {
        let bytes = Sealed::from_default()?.to_bytes();
        assert_eq!(default_configuration()?, configuration_digest(&bytes));
        let mut other = bytes;
        other.iter_mut().take(1).for_each(|byte| *byte ^= 1);
        assert_ne!(default_configuration()?, configuration_digest(&other));
        Ok(())
    }
}
