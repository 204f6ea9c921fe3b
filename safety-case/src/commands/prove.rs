//! `supervise prove`.

use std::path::Path;

use super::{FINDINGS, Outcome, print};
use crate::cli::Prove;
use crate::prove::{Request, available, prove};

pub(super) fn run(arguments: &Prove) -> Outcome {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("the workspace has no folder")?;
    let kani = available();
    let check = arguments.check || !kani;
    let solver = arguments.solver;
    let options = Request { harnesses: arguments.harness.clone(), within: arguments.within, check, solver };
    let mut failure = None;
    let mut say = |line: &str| {
        if let Err(error) = print(format_args!("{line}\n")) {
            failure = Some(error);
        }
    };
    let open = prove(root, &options, &mut say)?;
    if !kani {
        say("NOT RUN HERE: cargo kani is not installed (cargo install --locked kani-verifier && cargo kani setup).");
        say("What stands above is the committed record.");
    }
    if let Some(error) = failure {
        return Err(error.into());
    }
    Ok(if open == 0 && (kani || arguments.check) { 0 } else { FINDINGS })
}
