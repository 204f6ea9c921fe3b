//! The sources as a page that works offline, with what is open in them.
use super::run::Measured;
use super::record::Record;
use std::path::Path;
/// x
pub fn page(_root: &Path, _record: &Record, _measured: &Measured) -> Result<String, minijinja::Error> {
    Ok(String::new())
}
