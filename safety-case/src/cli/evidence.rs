//! The command line of `evidence`.

use std::path::PathBuf;

use clap::Args;

pub(super) const ABOUT: &str = "\
Collects into one folder what speaks for the supervisor, and what does not: requirements and where each is implemented, \
proved and tested; every record with its figures and whether it is of the present sources; the argument drawn; failure modes, tools, \
methods, limitations, risks, assumptions of use; packages, licences, every `unsafe`; a digest of every file.

It reads records and runs no campaign. What was not run says \"not run\", what is older than the sources \"stale\". Not committed, \
so only shown when a run is at hand:
  tests          cargo test 2>&1 | tee target/tests.log     (or --log FILE)
  exploration    cargo test -p supervisor-proofs --test explore
The shipped drives are replayed and the scenarios drawn, unless --no-drives.

Files of the folder: index.html (self-contained, open items first), evidence.json, trace.html and .json, inject.html, \
requirements.sdoc (StrictDoc), needs.json and needs.toml (sphinx-needs), tests.xml (JUnit), sbom.cdx.json (CycloneDX), argument/, records/, \
drives/, manifest.sha256; and run.json, which alone differs between two runs.

--check writes nothing and fails on a finding of the analysis, the argument or the traceability; on evidence that is not there; on a part \
of the supervisor without failure mode; on a timer that is not that of the table of limits; on a figure in README.md or \
safety-case/README.md that is not that of its record; on words that claim too much; and, where the folder was made before, on a file \
whose digest is not that of its manifest. A record that is stale or was not run is shown and fails its own command's --check.

Examples:
  supervise evidence                                 target/evidence/index.html
  supervise evidence --check                         for CI
  supervise evidence --write README.md               the tables that follow from the records
  cd target/evidence && sha256sum --check manifest.sha256

Exit codes: 0 done, no findings; 1 findings; 2 something cannot be read or written.";

/// Arguments of `evidence`.
#[derive(Debug, Args)]
pub struct Evidence {
    /// The folder to write
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
    /// What `cargo test` printed; without it, target/tests.log if there is one
    #[arg(long, value_name = "FILE")]
    pub log: Option<PathBuf>,
    /// Do not replay the shipped drives, nor draw the scenarios
    #[arg(long)]
    pub no_drives: bool,
    /// Write nothing: only the findings
    #[arg(long, conflicts_with = "write")]
    pub check: bool,
    /// Write nothing but the tables of the records in this file, between their marks
    #[arg(long, value_name = "FILE")]
    pub write: Option<PathBuf>,
    /// Write nothing: print the digest of the shipped sources, as a record of another tool has to carry it in `sources`
    #[arg(long, conflicts_with_all = ["check", "write"])]
    pub digest: bool,
    /// The root of the project; without it, this project
    #[arg(long, value_name = "FOLDER")]
    pub root: Option<PathBuf>,
}
