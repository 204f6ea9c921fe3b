//! What the project is made of: packages with their licences and checksums, and every `unsafe`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use cargo_metadata::{DependencyKind, Metadata, MetadataCommand, PackageId};
use serde::{Deserialize, Serialize};

use crate::error::{ToolError, form, read};

/// A package of the workspace's lock.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Package {
    /// Name.
    pub name: String,
    /// Version.
    pub version: String,
    /// Licence, as its manifest says.
    pub license: Option<String>,
    /// Of the workspace itself.
    pub ours: bool,
    /// The shipped supervisor needs it when it runs.
    pub shipped: bool,
    /// SHA-256 of the packed source, as the lock file says.
    pub checksum: Option<String>,
    /// Packages that it needs, by name and version.
    pub needs: BTreeSet<String>,
}

impl Package {
    /// Name and version.
    #[must_use]
    pub fn id(&self) -> String {
        format!("{} {}", self.name, self.version)
    }
}

/// A place that the compiler does not check.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Unsafe {
    /// The file.
    pub file: String,
    /// The line.
    pub line: usize,
    /// How it reads.
    pub text: String,
}

/// All of it.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Inventory {
    /// Packages by name.
    pub packages: Vec<Package>,
    /// Why there are none, where that is so.
    pub not_run: Option<String>,
    /// `unsafe` in our own sources.
    pub unsafe_code: Vec<Unsafe>,
    /// Folders in which the compiler forbids it.
    pub forbidden: Vec<String>,
}

#[derive(Deserialize)]
struct Lock {
    package: Vec<Locked>,
}

#[derive(Deserialize)]
struct Locked {
    name: String,
    version: String,
    checksum: Option<String>,
}

impl Inventory {
    /// Of the workspace at `root`.
    ///
    /// # Errors
    /// A source or the lock file cannot be read. That cargo does not answer is said, and is no error.
    pub fn load(root: &Path) -> Result<Self, ToolError> {
        let mut inventory = Self::default();
        match metadata(root) {
            Ok(metadata) => inventory.packages = packages(root, &metadata)?,
            Err(error) => inventory.not_run = Some(error.to_string().lines().next().unwrap_or_default().to_owned()),
        }
        (inventory.unsafe_code, inventory.forbidden) = unsafe_code(root)?;
        Ok(inventory)
    }

    /// How many packages have each licence.
    #[must_use]
    pub fn licenses(&self) -> BTreeMap<&str, Vec<&Package>> {
        let mut licenses: BTreeMap<&str, Vec<&Package>> = BTreeMap::new();
        for package in &self.packages {
            licenses.entry(package.license.as_deref().unwrap_or("none said")).or_default().push(package);
        }
        licenses
    }
}

fn metadata(root: &Path) -> Result<Metadata, cargo_metadata::Error> {
    // What is locked, and of that what this machine builds: nothing is resolved anew.
    let mut options = vec!["--locked".to_owned()];
    options.extend(host().map(|host| format!("--filter-platform={host}")));
    MetadataCommand::new().manifest_path(root.join("Cargo.toml")).other_options(options).exec()
}

/// The platform of this machine, as the compiler calls it.
fn host() -> Option<String> {
    let said = std::process::Command::new("rustc").arg("-vV").output().ok()?;
    let said = String::from_utf8_lossy(&said.stdout).into_owned();
    said.lines().find_map(|line| line.strip_prefix("host: ").map(str::to_owned))
}

fn packages(root: &Path, metadata: &Metadata) -> Result<Vec<Package>, ToolError> {
    let path = root.join("Cargo.lock");
    let lock: Lock = toml::from_str(&read(&path)?).map_err(|error| form(&path, &error))?;
    let checksum = |name: &str, version: &str| {
        let of = |locked: &&Locked| locked.name == name && locked.version == version;
        lock.package.iter().find(of).and_then(|locked| locked.checksum.clone())
    };
    let nodes = metadata.resolve.as_ref().map(|resolve| resolve.nodes.as_slice()).unwrap_or_default();
    let needs = |id: &PackageId, normal: bool| {
        let node = nodes.iter().filter(|node| node.id == *id).flat_map(|node| &node.deps);
        let wanted = node.filter(move |dependency| {
            !normal || dependency.dep_kinds.iter().any(|kind| kind.kind == DependencyKind::Normal)
        });
        wanted.map(|dependency| dependency.pkg.clone()).collect::<Vec<_>>()
    };
    // What the facade needs when it runs, and the facade itself.
    let mut shipped: BTreeSet<PackageId> = BTreeSet::new();
    let mut todo: Vec<PackageId> = metadata
        .packages
        .iter()
        .filter(|package| package.name == "supervisor")
        .map(|package| package.id.clone())
        .collect();
    while let Some(id) = todo.pop() {
        if shipped.insert(id.clone()) {
            todo.extend(needs(&id, true));
        }
    }
    let ids: BTreeMap<&PackageId, String> = metadata
        .packages
        .iter()
        .map(|package| (&package.id, format!("{} {}", package.name, package.version)))
        .collect();
    let mut packages: Vec<Package> = metadata
        .packages
        .iter()
        .map(|package| {
            let (name, version) = (package.name.to_string(), package.version.to_string());
            Package {
                license: package.license.clone(),
                ours: metadata.workspace_members.contains(&package.id),
                shipped: shipped.contains(&package.id),
                checksum: checksum(&name, &version),
                needs: needs(&package.id, false).iter().filter_map(|id| ids.get(id).cloned()).collect(),
                name,
                version,
            }
        })
        .collect();
    packages.sort();
    Ok(packages)
}

/// Every `unsafe` of our own Rust, told from words in comments and literals by its tokens; and where it is forbidden.
fn unsafe_code(root: &Path) -> Result<(Vec<Unsafe>, Vec<String>), ToolError> {
    let (mut found, mut forbidden) = (Vec::new(), Vec::new());
    for folder in ["supervisor", "proofs", "fuzz", "safety-case", "tests"] {
        let walk = walkdir::WalkDir::new(root.join(folder)).sort_by_file_name();
        let walk = walk.into_iter().filter_entry(|entry| entry.file_name() != "target");
        for entry in walk.filter_map(Result::ok).filter(|entry| entry.path().extension().is_some_and(|ext| ext == "rs"))
        {
            let name = entry.path().strip_prefix(root).unwrap_or(entry.path()).to_string_lossy().replace('\\', "/");
            let text = read(entry.path())?;
            if text.contains("#![forbid(unsafe_code)]") {
                forbidden.push(name.clone());
            }
            if !text.contains("unsafe") {
                continue;
            }
            let tokens: proc_macro2::TokenStream = text.parse().map_err(|error| form(entry.path(), &error))?;
            let mut lines = Vec::new();
            keywords(tokens, &mut lines);
            let shown = |line: usize| text.lines().nth(line.saturating_sub(1)).unwrap_or_default().trim().to_owned();
            found.extend(lines.into_iter().map(|line| Unsafe { file: name.clone(), line, text: shown(line) }));
        }
    }
    Ok((found, forbidden))
}

fn keywords(tokens: proc_macro2::TokenStream, lines: &mut Vec<usize>) {
    for token in tokens {
        match token {
            proc_macro2::TokenTree::Ident(ident) if ident == "unsafe" => lines.push(ident.span().start().line),
            proc_macro2::TokenTree::Group(group) => keywords(group.stream(), lines),
            proc_macro2::TokenTree::Ident(_)
            | proc_macro2::TokenTree::Punct(_)
            | proc_macro2::TokenTree::Literal(_) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::keywords;

    #[test]
    fn unsafe_is_a_keyword_and_no_word_of_a_text() -> Result<(), proc_macro2::LexError> {
        let mut lines = Vec::new();
        keywords(
            "#![forbid(unsafe_code)]\n// unsafe\nfn f() {\n  let x = \"unsafe\"; unsafe { g() }\n}".parse()?,
            &mut lines,
        );
        assert_eq!(lines, [4]);
        Ok(())
    }
}
