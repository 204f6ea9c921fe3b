//! Writes the configuration for which the proofs are built, `configured.rs`: none, which stands for the default one, or
//! the words of the sealed file that `SUPERVISE_CONFIG` names (`supervise prove --config FILE` sets it).

use std::error::Error;
use std::path::Path;
use std::{env, fs};

use supervisor_terms::{Config, Sealed, Words};

const NAME: &str = "SUPERVISE_CONFIG";

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo:rerun-if-env-changed={NAME}");
    println!("cargo:rerun-if-changed=build.rs");
    let words = match env::var_os(NAME) {
        None => "None".to_owned(),
        Some(file) => {
            println!("cargo:rerun-if-changed={}", Path::new(&file).display());
            let bytes = fs::read(&file).map_err(|error| format!("{}: {error}", Path::new(&file).display()))?;
            let sealed =
                Sealed::from_sealed(&bytes).map_err(|error| format!("{}: {error}", Path::new(&file).display()))?;
            let mut words = Vec::new();
            sealed.intact().ok_or("the configuration changed in memory")?.write(&mut |word| words.push(word));
            format!("Some({words:?})")
        }
    };
    let text = format!("pub(super) const WORDS: Option<[u32; {}]> = {words};\n", <Config as Words>::COUNT);
    let folder = env::var_os("OUT_DIR").ok_or("OUT_DIR is not set")?;
    fs::write(Path::new(&folder).join("configured.rs"), text)?;
    Ok(())
}
