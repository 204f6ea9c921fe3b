//! The requirements, tests and packages in forms that other tools read.

mod junit;
mod needs;
mod sbom;
mod strictdoc;

pub use junit::junit;
pub use needs::needs;
pub use sbom::sbom;
pub use strictdoc::strictdoc;

/// One line: no line break, no run of spaces.
fn line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
