//! Reading the folder; an error names file and node.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::Deserialize;
use serde_json::Value;

use super::{Argument, Module, Node};
use crate::error::{ToolError, file as failed, form, read};

/// Where it stands.
pub const FOLDER: &str = "safety-case/argument";
/// Where the argument begins.
const INDEX: &str = "index.gsn.yaml";
/// The key that is no node.
const MODULE: &str = "module";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Head {
    name: String,
    brief: String,
    #[serde(default)]
    uses: Vec<String>,
}

/// Reads every `.yaml` of the folder below `root`; a project without the folder argues nothing.
///
/// # Errors
/// A file that cannot be read, is no YAML, has an id twice, or a node with a key too many or a value of the wrong kind.
pub fn load(root: &Path) -> Result<Argument, ToolError> {
    let folder = root.join(FOLDER);
    let mut argument = Argument::default();
    if !folder.exists() {
        return Ok(argument);
    }
    let mut paths = Vec::new();
    for entry in fs::read_dir(&folder).map_err(|error| failed(&folder, error))? {
        let path = entry.map_err(|error| failed(&folder, error))?.path();
        if path.extension().is_some_and(|extension| extension == "yaml") {
            paths.push(path);
        }
    }
    paths.sort_by_key(|path| (!path.ends_with(INDEX), path.clone()));
    for path in paths {
        let text = read(&path)?;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        argument.modules.push(module(&path, &name, &text)?);
        argument.texts.push((format!("{FOLDER}/{name}"), text));
    }
    // In the order in which the index uses them.
    let uses = argument.modules.first().map(|index| index.uses.clone()).unwrap_or_default();
    let place =
        |module: &Module| uses.iter().position(|file| *file == module.file).map_or(uses.len(), |place| place + 1);
    argument.modules.sort_by_key(|module| if module.file == INDEX { 0 } else { place(module) });
    Ok(argument)
}

fn module(path: &Path, name: &str, text: &str) -> Result<Module, ToolError> {
    // First as it is, so that an error names the node and an id that stands twice is one.
    let mut values: BTreeMap<String, Value> = serde_saphyr::from_str(text).map_err(|error| form(path, &error))?;
    let head = values.remove(MODULE).ok_or_else(|| form(path, &"has no `module`"))?;
    let head: Head = serde_json::from_value(head).map_err(|error| form(path, &format!("{MODULE}: {error}")))?;
    let mut nodes = BTreeMap::new();
    for (id, value) in values {
        let node: Node = serde_json::from_value(value).map_err(|error| form(path, &format!("{id}: {error}")))?;
        nodes.insert(id, node);
    }
    Ok(Module { file: name.to_owned(), name: head.name, brief: head.brief, uses: head.uses, nodes })
}
