//! The record is of these sources, and says of each contract no more than what the provers said.

mod record;

use record::{Contract, Record, conditions, digests, verdict};
use std::{fs, path::Path};

fn home() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn recorded() -> Record {
    serde_json::from_str(&fs::read_to_string(home().join("record.json")).unwrap()).unwrap()
}

/// Fails when a kernel or a contract has changed: run `examples/discharge.rs` again.
#[test]
fn the_record_is_not_stale() {
    assert_eq!(recorded().sources, digests(home()), "the record is stale: discharge the contracts again");
}

/// Every function that has a contract is recorded.
#[test]
fn no_contract_is_missing_from_the_record() {
    let recorded = recorded();
    for source in ["../../supervisor/terms/src/kernel.rs", "src/consequences.rs"] {
        let file = syn::parse_file(&fs::read_to_string(home().join(source)).unwrap()).unwrap();
        for item in file.items {
            let syn::Item::Fn(function) = item else { continue };
            let name = function.sig.ident.to_string();
            let found = recorded.contracts.iter().filter(|contract| contract.function == name).count();
            assert_eq!(found, 1, "{name}");
        }
    }
}

/// Each verdict follows from the raw answers, which are kept beside the record.
#[test]
fn the_record_says_what_the_provers_said() {
    for Contract { function, verdict: claimed, conditions: claimed_conditions } in &recorded().contracts {
        assert_eq!(claimed, verdict(claimed_conditions), "{function}");
        for (place, condition) in claimed_conditions.iter().enumerate() {
            let raw = fs::read(home().join(format!("raw/{function}.{}.json", condition.prover))).unwrap();
            assert_eq!(&conditions(&condition.prover, &raw).unwrap()[place], condition, "{function}");
        }
    }
}

/// Two answers as Why3 1.8.2 prints them: one condition that is not proved leaves a contract not discharged.
#[test]
fn a_single_open_condition_is_enough() {
    let said = br#"
        {"prover-result": {"answer": "Valid", "ce-models": [], "status": "exited with status 0", "step": 548, "time": 1e-06},
         "term": {"explanations": ["unwrap requires"], "goal_name": "vc_example", "loc": {"file-name": "example.coma"}}}
        {"prover-result": {"answer": "Timeout", "ce-models": [], "status": "exited with status 0", "step": 5570, "time": 9.5},
         "term": {"explanations": [], "goal_name": "vc_example", "loc": {"file-name": "example.coma"}}}"#;
    let conditions = conditions("z3", said).unwrap();
    assert_eq!(conditions.len(), 2);
    assert_eq!(conditions[0].explanation, "unwrap requires");
    assert_eq!(verdict(&conditions[..1]), "discharged");
    assert_eq!(verdict(&conditions), "stated, not discharged");
    assert_eq!(verdict(&[]), "stated, not discharged");
}
