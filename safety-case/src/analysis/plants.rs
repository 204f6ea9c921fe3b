//! Defects of failure modes, tools, methods, limitations and risks: see `tests.rs`.

use super::tests::Plant;
use super::{Evidence, Kind, Rule};

/// Plants one defect each.
pub(super) const MORE: &[(&str, Plant)] = &[
    ("unknown goal of a failure mode", |a| {
        let failure = a.failures.first_mut()?;
        failure.goals.push("SG-99".to_owned());
        Some((Rule::UnknownId, format!("fmea.toml: {}", failure.id)))
    }),
    ("unknown requirement of a failure mode", |a| {
        let failure = a.failures.last_mut()?;
        failure.requirements.push("SEAT-99z".to_owned());
        Some((Rule::UnknownId, format!("fmea.toml: {}", failure.id)))
    }),
    ("unknown fault as evidence", |a| {
        let failure = a.failures.first_mut()?;
        failure.evidence.push(Evidence { kind: Kind::Fault, name: "FI-999".to_owned() });
        Some((Rule::UnknownId, format!("fmea.toml: {}", failure.id)))
    }),
    ("failure mode without evidence", |a| {
        let failure = a.failures.first_mut()?;
        failure.evidence.clear();
        Some((Rule::Incomplete, format!("fmea.toml: {}", failure.id)))
    }),
    ("failure mode that leaves nothing, and does not say so", |a| {
        let failure = a.failures.first_mut()?;
        failure.residual.clear();
        Some((Rule::Incomplete, format!("fmea.toml: {}", failure.id)))
    }),
    ("failure mode twice", |a| {
        let id = a.failures.first()?.id.clone();
        a.failures.last_mut()?.id.clone_from(&id);
        Some((Rule::DuplicateId, id))
    }),
    ("failure mode with another id", |a| {
        a.failures.first_mut()?.id = "FX-01".to_owned();
        Some((Rule::IdForm, "FX-01".to_owned()))
    }),
    ("tool below its level", |a| {
        let tool = a.tools.iter_mut().find(|tool| tool.tcl > 1)?;
        tool.tcl = 1;
        Some((Rule::ToolLevel, format!("tools.toml: {}", tool.id)))
    }),
    ("tool that cannot fail", |a| {
        let tool = a.tools.first_mut()?;
        tool.failure.clear();
        Some((Rule::Incomplete, format!("tools.toml: {}", tool.id)))
    }),
    ("method without a place", |a| {
        let row = a.methods.first_mut()?.row.first_mut()?;
        row.place.clear();
        Some((Rule::Incomplete, format!("methods.toml: {}", row.id)))
    }),
    ("method of another table", |a| {
        let row = a.methods.first_mut()?.row.first_mut()?;
        row.id = "MT-99a".to_owned();
        Some((Rule::IdForm, row.id.clone()))
    }),
    ("limitation without effect", |a| {
        let limitation = a.limitations.first_mut()?;
        limitation.effect.clear();
        Some((Rule::Incomplete, format!("limitations.toml: {}", limitation.id)))
    }),
    ("proposed reading that no limitation names", |a| {
        let limitation = a.limitations.iter_mut().find(|limitation| !limitation.readings.is_empty())?;
        let reading = limitation.readings.pop()?;
        Some((Rule::Unlisted, format!("limitations.toml: {reading}")))
    }),
    ("risk without assumption", |a| {
        let risk = a.risks.first_mut()?;
        risk.assumptions.clear();
        Some((Rule::Incomplete, format!("limitations.toml: {}", risk.id)))
    }),
    ("risk with an unknown fault", |a| {
        let risk = a.risks.first_mut()?;
        risk.faults.push("FI-999".to_owned());
        Some((Rule::UnknownId, format!("limitations.toml: {}", risk.id)))
    }),
];
