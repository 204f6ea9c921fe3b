//! The packages as a `CycloneDX` bill of materials.

use cyclonedx_bom::errors::JsonWriteError;
use cyclonedx_bom::models::component::{Classification, Scope};
use cyclonedx_bom::models::dependency::{Dependencies, Dependency};
use cyclonedx_bom::models::hash::{Hash, HashAlgorithm, HashValue, Hashes};
use cyclonedx_bom::models::license::{LicenseChoice, Licenses};
use cyclonedx_bom::prelude::{Bom, Component, Components, Metadata, Purl, SpdxExpression, SpecVersion};

use crate::evidence::inventory::{Inventory, Package};

/// Version 1.5 as JSON. No serial number and no time: the same packages give the same bytes.
///
/// # Errors
/// It cannot be written.
pub fn sbom(inventory: &Inventory) -> Result<String, JsonWriteError> {
    let root = inventory.packages.iter().find(|package| package.name == "supervisor");
    let others = inventory.packages.iter().filter(|package| package.name != "supervisor");
    let dependencies = inventory.packages.iter().map(|package| Dependency {
        dependency_ref: package.id(),
        dependencies: package.needs.iter().cloned().collect(),
    });
    let bom = Bom {
        serial_number: None,
        metadata: Some(Metadata { component: root.map(component), ..Metadata::default() }),
        components: Some(Components(others.map(component).collect())),
        dependencies: Some(Dependencies(dependencies.collect())),
        spec_version: SpecVersion::V1_5,
        ..Bom::default()
    };
    let mut bytes = Vec::new();
    bom.output_as_json_v1_5(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned() + "\n")
}

fn component(package: &Package) -> Component {
    let mut component = Component::new(Classification::Library, &package.name, &package.version, Some(package.id()));
    // What the shipped supervisor does not need when it runs is a tool of its making.
    component.scope = Some(if package.shipped { Scope::Required } else { Scope::Excluded });
    component.licenses = package.license.as_ref().map(|license| {
        // Old manifests write "MIT/Apache-2.0"; what is no expression at all is a name.
        let expression = SpdxExpression::parse_lax(license.clone()).map(LicenseChoice::Expression);
        Licenses(vec![expression.unwrap_or_else(|_| LicenseChoice::license(license))])
    });
    if !package.ours {
        component.purl = Purl::new("cargo", &package.name, &package.version).ok();
    }
    component.hashes = package
        .checksum
        .as_ref()
        .map(|checksum| Hashes(vec![Hash { alg: HashAlgorithm::SHA_256, content: HashValue(checksum.clone()) }]));
    component
}
