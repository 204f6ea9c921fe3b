//! Digests of what a proof speaks of: its sources and its configuration. When one changes, the proof is stale.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};
use quote::ToTokens;
use sha2::{Digest, Sha256};
use supervisor::{SEALED_BYTES, Sealed};

use crate::built::SHIPPED;
use crate::error::{ToolError, file, form, read};

/// Properties and harnesses.
const PROOFS: &str = "proofs/src";

/// The digest of bytes, in hexadecimal.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    format!("{:x}", Sha256::digest(bytes))
}

/// Digest of the default configuration as it is sealed.
///
/// # Errors
/// The table of limits contradicts itself.
pub fn default_configuration() -> Result<String, ToolError> {
    let sealed = Sealed::from_default().map_err(|error| ToolError::Arguments(error.to_string()))?;
    Ok(configuration_digest(&sealed.to_bytes()))
}

/// Digest of a sealed configuration.
#[must_use]
pub fn configuration_digest(bytes: &[u8; SEALED_BYTES]) -> String {
    sha256(bytes)
}

/// What a proof speaks of: all of the shipped sources, and of `proofs/src` what its harness reaches.
///
/// Comments, doc comments and layout are no tokens, so they make no proof stale; nor does another harness, or a property
/// that a harness does not reach. What it reaches is found by name alone, whatever the module: too much rather than too little.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sources {
    /// Digest of everything.
    pub whole: String,
    /// Digest of what a harness speaks of, by its name.
    harnesses: BTreeMap<String, String>,
}

impl Sources {
    /// Reads the sources.
    ///
    /// # Errors
    /// A folder or file cannot be read, or is no Rust.
    pub fn load(root: &Path) -> Result<Self, ToolError> {
        let (shipped, mut parts) = (shipped(root)?, Vec::new());
        let mut whole = Sha256::new();
        put(&mut whole, &shipped);
        for path in files(&root.join(PROOFS))? {
            let name = path.strip_prefix(root).unwrap_or(&path).to_string_lossy().replace('\\', "/");
            let text = read(&path)?;
            put(&mut whole, &name);
            add(&mut whole, text.parse().map_err(|error| form(&path, &error))?);
            parts.extend(Part::of(&name, &syn::parse_file(&text).map_err(|error| form(&path, &error))?));
        }
        let harness = |part: &Part| part.is_harness.then(|| part.names.iter().next().cloned()).flatten();
        let digest = |name: String| (name.clone(), reached(&shipped, &parts, &name));
        let harnesses = parts.iter().filter_map(harness).map(digest).collect();
        Ok(Self { whole: format!("{:x}", whole.finalize()), harnesses })
    }

    /// Digest of what the harness of this name speaks of; of everything, if there is none of this name.
    #[must_use]
    pub fn of(&self, harness: &str) -> &str {
        self.harnesses.get(harness).unwrap_or(&self.whole)
    }

    /// Digest of what these harnesses speak of together; of everything, if there are none.
    #[must_use]
    pub fn of_all<'a>(&self, harnesses: impl Iterator<Item = &'a str>) -> String {
        let digests: BTreeSet<&str> = harnesses.map(|harness| self.of(harness)).collect();
        match digests.len() {
            0 => self.whole.clone(),
            1 => digests.into_iter().collect(),
            _ => sha256(digests.into_iter().collect::<Vec<_>>().join(" ").as_bytes()),
        }
    }

    /// The same digest for everything.
    #[cfg(test)]
    pub(crate) fn same(digest: &str) -> Self {
        Self { whole: digest.to_owned(), harnesses: BTreeMap::new() }
    }
}

/// Digest of the shipped sources.
///
/// # Errors
/// A folder or file cannot be read, or is no Rust.
pub fn shipped(root: &Path) -> Result<String, ToolError> {
    tokens(root, &SHIPPED)
}

/// Digest of all that a step runs: the shipped sources and the facade, of which no proof speaks.
///
/// # Errors
/// A folder or file cannot be read, or is no Rust.
pub fn stepped(root: &Path) -> Result<String, ToolError> {
    Ok(sha256(format!("{} {}", shipped(root)?, tokens(root, &["supervisor/src"])?).as_bytes()))
}

/// Digest of the tokens of all Rust files of these folders: comments and layout do not count.
///
/// # Errors
/// A folder or file cannot be read, or is no Rust.
pub fn tokens(root: &Path, folders: &[&str]) -> Result<String, ToolError> {
    let mut digest = Sha256::new();
    for folder in folders {
        for path in files(&root.join(folder))? {
            put(&mut digest, &path.strip_prefix(root).unwrap_or(&path).to_string_lossy().replace('\\', "/"));
            add(&mut digest, read(&path)?.parse().map_err(|error| form(&path, &error))?);
        }
    }
    Ok(format!("{:x}", digest.finalize()))
}

/// An item of `proofs/src`, or all that stands around the items of a file: what it uses, its modules and attributes.
struct Part {
    file: String,
    /// By what it is reached; what stands around is reached with any item of its file.
    names: BTreeSet<String>,
    is_harness: bool,
    /// Every name in it.
    reaches: BTreeSet<String>,
    tokens: String,
}

impl Part {
    fn of(file: &str, parsed: &syn::File) -> Vec<Self> {
        let mut around = TokenStream::new();
        parsed.attrs.iter().for_each(|attribute| attribute.to_tokens(&mut around));
        let mut parts = Vec::new();
        for item in &parsed.items {
            let (names, is_harness) = match item {
                syn::Item::Fn(item) => (vec![item.sig.ident.to_string()], item.attrs.iter().any(is_proof)),
                syn::Item::Const(item) => (vec![item.ident.to_string()], false),
                syn::Item::Static(item) => (vec![item.ident.to_string()], false),
                syn::Item::Struct(item) => (vec![item.ident.to_string()], false),
                syn::Item::Enum(item) => (vec![item.ident.to_string()], false),
                syn::Item::Type(item) => (vec![item.ident.to_string()], false),
                syn::Item::Macro(syn::ItemMacro { ident: Some(ident), .. }) => (vec![ident.to_string()], false),
                // Its methods are reached through the type.
                syn::Item::Impl(item) => (idents(item.self_ty.to_token_stream()).into_iter().collect(), false),
                syn::Item::Mod(item) if item.attrs.iter().any(is_test) => continue,
                syn::Item::ExternCrate(_)
                | syn::Item::ForeignMod(_)
                | syn::Item::Macro(_)
                | syn::Item::Mod(_)
                | syn::Item::Trait(_)
                | syn::Item::TraitAlias(_)
                | syn::Item::Union(_)
                | syn::Item::Use(_)
                | syn::Item::Verbatim(_)
                | _ => (Vec::new(), false),
            };
            if names.is_empty() {
                item.to_tokens(&mut around);
                continue;
            }
            let tokens = item.to_token_stream();
            let (names, reaches) = (names.into_iter().collect(), idents(tokens.clone()));
            parts.push(Self { file: file.to_owned(), names, is_harness, reaches, tokens: digest(tokens) });
        }
        let (names, reaches) = (BTreeSet::new(), BTreeSet::new());
        parts.push(Self { file: file.to_owned(), names, is_harness: false, reaches, tokens: digest(around) });
        parts
    }

    fn stands_around(&self) -> bool {
        self.names.is_empty()
    }
}

/// Digest of the shipped sources and of all that a harness reaches.
fn reached(shipped: &str, parts: &[Part], harness: &str) -> String {
    let (mut names, mut within) = (BTreeSet::from([harness]), BTreeSet::new());
    loop {
        let before = within.len();
        for (place, part) in parts.iter().enumerate() {
            // Another harness calls nothing for this one.
            let other = part.is_harness && !part.names.contains(harness);
            if !other && part.names.iter().any(|name| names.contains(name.as_str())) && within.insert(place) {
                names.extend(part.reaches.iter().map(String::as_str));
            }
        }
        if within.len() == before {
            break;
        }
    }
    let files: BTreeSet<&str> = parts
        .iter()
        .enumerate()
        .filter(|(place, _)| within.contains(place))
        .map(|(_, part)| part.file.as_str())
        .collect();
    let mut digest = Sha256::new();
    put(&mut digest, shipped);
    for (place, part) in parts.iter().enumerate() {
        if within.contains(&place) || (part.stands_around() && files.contains(part.file.as_str())) {
            put(&mut digest, &part.file);
            put(&mut digest, &part.tokens);
        }
    }
    format!("{:x}", digest.finalize())
}

fn digest(tokens: TokenStream) -> String {
    let mut digest = Sha256::new();
    add(&mut digest, tokens);
    format!("{:x}", digest.finalize())
}

fn idents(tokens: TokenStream) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for token in tokens {
        match token {
            TokenTree::Ident(ident) => drop(found.insert(ident.to_string())),
            TokenTree::Group(group) => found.extend(idents(group.stream())),
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
    found
}

/// `#[kani::proof]`
fn is_proof(attribute: &syn::Attribute) -> bool {
    attribute.path().segments.last().is_some_and(|segment| segment.ident == "proof")
}

/// `#[cfg(test)]`
fn is_test(attribute: &syn::Attribute) -> bool {
    attribute.path().is_ident("cfg") && idents(attribute.meta.to_token_stream()).contains("test")
}

/// The Rust files of a folder, in order.
fn files(folder: &Path) -> Result<Vec<PathBuf>, ToolError> {
    let mut files = Vec::new();
    collect(folder, &mut files)?;
    files.sort();
    Ok(files)
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), ToolError> {
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
        for folder in SHIPPED.into_iter().chain([PROOFS]) {
            fs::create_dir_all(root.path().join(folder))?;
        }
        fs::write(root.path().join("supervisor/core/src/seat.rs"), text)?;
        fs::write(root.path().join("proofs/src/lib.rs"), "#[kani::proof] fn h() {}")?;
        let sources = Sources::load(root.path())?;
        assert_ne!(sources.of("h"), sources.whole);
        Ok(sources.of("h").to_owned())
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
    fn only_what_a_harness_reaches_makes_it_stale() -> Result<(), Box<dyn std::error::Error>> {
        const HARNESS: &str = "use crate::properties::holds;\nmacro_rules! m { () => { holds() }; }\n\
            #[kani::proof]\nfn one() { assert!(m!()); }\n#[kani::proof]\nfn two() { assert!(Any::new().idle()); }\n\
            #[cfg(test)]\nmod tests { fn t() {} }\n";
        const PROPERTIES: &str = "pub fn holds() -> bool { deep() }\nfn deep() -> bool { true }\n\
            pub fn other() -> bool { true }\npub struct Any;\nimpl Any { fn idle(&self) -> bool { other() } }\n";
        let of = |harness: &str, properties: &str| -> Result<[String; 2], Box<dyn std::error::Error>> {
            let root = tempfile::tempdir()?;
            for folder in SHIPPED.into_iter().chain([PROOFS]) {
                fs::create_dir_all(root.path().join(folder))?;
            }
            fs::write(root.path().join("proofs/src/harness.rs"), harness)?;
            fs::write(root.path().join("proofs/src/properties.rs"), properties)?;
            let sources = Sources::load(root.path())?;
            Ok(["one", "two"].map(|name| sources.of(name).to_owned()))
        };
        let [one, two] = of(HARNESS, PROPERTIES)?;
        // What is changed, and whether `one` and `two` are stale by it.
        let cases = [
            (HARNESS.replace("idle()", "idle() || true"), PROPERTIES.to_owned(), false, true),
            (HARNESS.replace("{ holds() }", "{ !holds() }"), PROPERTIES.to_owned(), true, false),
            (HARNESS.replace("fn t()", "fn u()"), PROPERTIES.to_owned(), false, false),
            (HARNESS.replace("properties::holds", "others::holds"), PROPERTIES.to_owned(), true, true),
            (
                HARNESS.to_owned(),
                PROPERTIES.replace("deep() -> bool { true }", "deep() -> bool { false }"),
                true,
                false,
            ),
            (
                HARNESS.to_owned(),
                PROPERTIES.replace("other() -> bool { true }", "other() -> bool { false }"),
                false,
                true,
            ),
            (HARNESS.to_owned(), PROPERTIES.to_owned() + "pub fn new() -> bool { true }\n", false, true),
            (HARNESS.to_owned(), PROPERTIES.to_owned() + "pub fn unused() {}\n", false, false),
        ];
        for (harness, properties, first, second) in cases {
            let [stale_one, stale_two] = of(&harness, &properties)?;
            assert_eq!((stale_one != one, stale_two != two), (first, second), "{harness}{properties}");
        }
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
