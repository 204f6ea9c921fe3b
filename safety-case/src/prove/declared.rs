//! The harnesses that stand in the sources, found without Kani.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use syn::visit::{self, Visit};

use crate::error::{ToolError, file, form, read};

/// The harnesses of `proofs/src`, as Kani names them. One that a macro makes is not seen; Kani's own list, which every
/// complete run reads, has it.
///
/// # Errors
/// A file cannot be read or is no Rust.
pub fn declared(root: &Path) -> Result<BTreeSet<String>, ToolError> {
    let mut found = BTreeSet::new();
    walk(&root.join("proofs/src"), &[], &mut found)?;
    Ok(found)
}

fn walk(folder: &Path, modules: &[String], found: &mut BTreeSet<String>) -> Result<(), ToolError> {
    let error = |error| file(folder, error);
    for entry in fs::read_dir(folder).map_err(error)? {
        let path = entry.map_err(error)?.path();
        let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let mut inside = modules.to_vec();
        if path.is_dir() || !matches!(name.as_str(), "lib" | "mod") {
            inside.push(name);
        }
        if path.is_dir() {
            walk(&path, &inside, found)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let parsed = syn::parse_file(&read(&path)?).map_err(|error| form(&path, &error))?;
            Harnesses { modules: inside, found }.visit_file(&parsed);
        }
    }
    Ok(())
}

struct Harnesses<'a> {
    modules: Vec<String>,
    found: &'a mut BTreeSet<String>,
}

impl<'ast> Visit<'ast> for Harnesses<'_> {
    fn visit_item_mod(&mut self, module: &'ast syn::ItemMod) {
        self.modules.push(module.ident.to_string());
        visit::visit_item_mod(self, module);
        self.modules.pop();
    }

    fn visit_item_fn(&mut self, function: &'ast syn::ItemFn) {
        let names = |attribute: &syn::Attribute| {
            attribute.path().segments.iter().map(|segment| segment.ident.to_string()).collect::<Vec<_>>()
        };
        let is_proof = |attribute| matches!(names(attribute).as_slice(), [kani, proof] if kani == "kani" && proof.starts_with("proof"));
        if function.attrs.iter().any(is_proof) {
            self.found.insert(format!("{}::{}", self.modules.join("::"), function.sig.ident));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn harnesses_are_found_by_file_and_module() -> Result<(), Box<dyn std::error::Error>> {
        let root = tempfile::tempdir()?;
        let harness = "#[kani::proof]\n#[kani::unwind(3)]\nfn NAME() {}\nfn helper() {}\n";
        for (file, text) in [
            ("lib.rs", "pub mod properties;\n".to_owned()),
            ("harness/mod.rs", harness.replace("NAME", "a")),
            (
                "harness/seat.rs",
                format!("{}mod inner {{ {} }}", harness.replace("NAME", "b"), harness.replace("NAME", "c")),
            ),
            ("harness/road/lane.rs", harness.replace("NAME", "d")),
        ] {
            let path = root.path().join("proofs/src").join(file);
            fs::create_dir_all(path.parent().ok_or("no folder")?)?;
            fs::write(path, text)?;
        }
        let found: Vec<String> = declared(root.path())?.into_iter().collect();
        assert_eq!(found, ["harness::a", "harness::road::lane::d", "harness::seat::b", "harness::seat::inner::c"]);
        Ok(())
    }
}
