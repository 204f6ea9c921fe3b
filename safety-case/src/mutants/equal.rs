//! Proves with Kani that a mutant that survives changes nothing.
//!
//! The mutated function goes beside the one that it was made of, under the name with `_mutated` behind it, into a copy of the workspace; a
//! harness of the explanation compares the two. That harness, and what it leaves out, is all that is hand-written.

use std::path::Path;
use std::time::Duration;

use super::list::{Explained, every};
use super::record::{Entry, Outcome, Record};
use crate::copy::Copy;
use crate::error::{ToolError, read};
use crate::mistakes::{Change, Listed};
use crate::prove::{Harness, Options, Solver, Verdict, sha256, shipped, verify};

/// Longest time for one proof.
const WITHIN: Duration = Duration::from_secs(600);
/// The name of each harness.
const HARNESS: &str = "changes_nothing";
/// Its module, in the file of the mutant.
const MODULE: &str = "equal";

/// The file with the mutated function beside the other one, and the harness.
///
/// # Errors
/// In words: the mutant stands in no function, or the result is no Rust.
fn beside(listed: &Listed, text: &str, proof: &str) -> Result<Change, String> {
    let none = || format!("{}: it stands in no function", listed.name);
    let function = listed.extent(text).ok_or_else(none)?;
    let place = listed.place(text).ok_or_else(none)?;
    let name = listed.function().rsplit("::").next().unwrap_or_default();
    let part = |from, to| text.get(from..to).ok_or_else(none);
    let head = part(function.start, place.start)?;
    let head = head.replacen(&format!("fn {name}"), &format!("fn {name}_mutated"), 1);
    let mutated = format!("{head}{}{}", listed.replacement(), part(place.end, function.end)?);
    let module = format!("#[cfg(kani)]\nmod {MODULE} {{\n    use super::*;\n{proof}}}\n");
    let whole = format!(
        "{}\n    #[allow(missing_docs)]\n    {mutated}\n{}\n{module}",
        part(0, function.end)?,
        part(function.end, text.len())?
    );
    Change::new(&listed.file, text, text, &whole)
}

/// The module path of a source file in its crate.
fn module(file: &str) -> String {
    let inside = file.split_once("/src/").map_or(file, |(_, inside)| inside);
    inside.trim_end_matches(".rs").trim_end_matches("/mod").replace('/', "::")
}

/// Proves every survivor whose explanation has a proof, and keeps it in the record.
///
/// # Errors
/// The record is stale; a file or a tool fails.
pub fn prove(root: &Path, say: &mut dyn FnMut(&str)) -> Result<(), ToolError> {
    let (mut record, explained) = (Record::load(root)?, Explained::all(root)?);
    if record.sources != shipped(root)? {
        return Err(ToolError::Arguments(
            "the record of the mutants is stale: run `supervise mutants` first".to_owned(),
        ));
    }
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |folder| root.join(folder));
    let copy = Copy::new(root, &target.join("mutants/equal"))?;
    for (_, listed) in every(root)? {
        let mut own = explained.iter().filter(|one| one.speaks_of(&listed.name));
        let Some(proof) = own.find_map(|one| one.proof.as_ref()) else { continue };
        let digest = sha256(proof.as_bytes());
        let survives = record.survivors().any(|name| name == listed.name);
        if !survives && !record.equals().any(|(name, with)| name == listed.name && with != digest) {
            continue;
        }
        let change = beside(&listed, &read(&root.join(&listed.file))?, proof).map_err(ToolError::Arguments)?;
        copy.plant(&change)?;
        let harness = Harness::apart(HARNESS, &format!("{}::{MODULE}", module(&listed.file)), Solver::Kissat);
        let options = Options { timeout: Some(WITHIN), package: Some(listed.package.clone()), ..Options::default() };
        let done = verify(copy.root(), &copy.target().join("kani"), &harness, &options)?;
        say(&format!("{}: {} in {} s", listed.name, done.verdict, done.seconds));
        let proved = done.verdict == Verdict::Proved;
        let outcome = if proved { Outcome::Equal { proof: digest, by: done.tools.kani } } else { Outcome::Survived };
        record.put(Entry { name: listed.name, outcome });
        record.save(root)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{beside, module};
    use crate::mistakes::Listed;

    #[test]
    fn the_mutated_function_stands_beside_the_other() {
        let text = "/// Less.\nfn less(a: u8, b: u8) -> bool {\n    a < b\n}\nfn more() {}\n";
        let json = r#"{"name": "supervisor/core/src/f.rs:3:7: replace < with <= in less", "file": "supervisor/core/src/f.rs", "replacement": "<=",
            "genre": "BinaryOperator", "package": "p",
            "function": {"function_name": "less", "span": {"start": {"line": 2, "column": 1}, "end": {"line": 4, "column": 2}}},
            "span": {"start": {"line": 3, "column": 7}, "end": {"line": 3, "column": 8}}}"#;
        let Ok(listed) = serde_json::from_str::<Listed>(json) else { unreachable!("it is one") };
        let Ok(change) = beside(&listed, text, "    fn changes_nothing() {}\n") else { unreachable!("it fits") };
        assert!(
            change.text.contains("fn less_mutated(a: u8, b: u8) -> bool {\n    a <= b\n}\n\nfn more() {}"),
            "{}",
            change.text
        );
        assert!(
            change.text.starts_with("/// Less.\nfn less(a: u8, b: u8) -> bool {\n    a < b\n}\n"),
            "{}",
            change.text
        );
    }

    #[test]
    fn a_file_is_a_module() {
        assert_eq!(module("supervisor/wire/src/sender/simulate.rs"), "sender::simulate");
        assert_eq!(module("supervisor/core/src/vet.rs"), "vet");
    }
}
