//! The record of a discharge: what it holds, and how it follows from what the provers said.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::{collections::BTreeMap, fs, path::Path};

#[derive(Serialize, Deserialize)]
pub struct Record {
    pub version: u32,
    pub tools: Tools,
    pub command: String,
    /// SHA-256 of each source that was proved.
    pub sources: BTreeMap<String, String>,
    pub contracts: Vec<Contract>,
}

#[derive(Serialize, Deserialize)]
pub struct Tools {
    pub creusot: String,
    pub rustc: String,
    pub why3: String,
    pub z3: String,
    pub cvc5: String,
}

#[derive(Serialize, Deserialize, PartialEq, Debug)]
pub struct Contract {
    pub function: String,
    pub verdict: String,
    pub conditions: Vec<Condition>,
}

#[derive(Serialize, Deserialize, PartialEq, Debug)]
pub struct Condition {
    pub explanation: String,
    pub prover: String,
    pub answer: String,
    pub seconds: f64,
}

impl Condition {
    pub fn is_valid(&self) -> bool {
        self.answer == "Valid"
    }
}

/// Discharged only if there is something to discharge and all of it is.
pub fn verdict(conditions: &[Condition]) -> &'static str {
    if !conditions.is_empty() && conditions.iter().all(Condition::is_valid) {
        "discharged"
    } else {
        "stated, not discharged"
    }
}

/// What Why3 printed as JSON, one object for each condition.
pub fn conditions(prover: &str, said: &[u8]) -> serde_json::Result<Vec<Condition>> {
    let objects = serde_json::Deserializer::from_slice(said).into_iter::<serde_json::Value>();
    objects
        .map(|object| {
            let object = object?;
            let (result, term) = (&object["prover-result"], &object["term"]);
            let explanations = term["explanations"].as_array().into_iter().flatten().filter_map(|text| text.as_str());
            Ok(Condition {
                explanation: explanations.collect::<Vec<_>>().join("; "),
                prover: prover.to_owned(),
                answer: result["answer"].as_str().unwrap_or("none").to_owned(),
                seconds: result["time"].as_f64().unwrap_or(0.0),
            })
        })
        .collect()
}

/// SHA-256 of the sources that a proof rests on, as `sha256sum` prints them.
pub fn digests(home: &Path) -> BTreeMap<String, String> {
    let digest = |name: &str| {
        let bytes = fs::read(home.join(name)).expect("a source that is here");
        let digest = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        (name.to_owned(), digest)
    };
    ["../../supervisor/terms/src/kernel.rs", "src/consequences.rs", "src/library.rs"].map(digest).into()
}
