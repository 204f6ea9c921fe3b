//! What a matrix says of each fault, beside what was expected.

use super::list::{Effect, Expected, Fault, List};
use super::matrix::{Cell, Matrix};

/// How a fault stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Standing {
    /// As expected, and it was dangerous in some runs.
    AsExpected,
    /// As expected, but it was never dangerous: nothing was shown.
    NotShown,
    /// As expected: it does harm that is covered by an assumption of use.
    Residual,
    /// Against the expectation, and known.
    Known,
    /// Against the expectation.
    Against,
    /// It was not run.
    NotRun,
}

impl Standing {
    /// The word for it.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::AsExpected => "as expected",
            Self::NotShown => "never dangerous",
            Self::Residual => "residual",
            Self::Known => "KNOWN",
            Self::Against => "AGAINST",
            Self::NotRun => "not run",
        }
    }
}

/// A fault over all scenarios.
#[derive(Clone, Debug)]
pub struct Row<'a> {
    /// The fault.
    pub fault: &'a Fault,
    /// The sum of its cells.
    pub sum: Cell,
    /// How it stands.
    pub standing: Standing,
}

impl Row<'_> {
    /// Least, middle and greatest time to the reaction in ms.
    #[must_use]
    pub fn detection(&self) -> Option<[u32; 3]> {
        let times = &self.sum.detection_ms;
        Some([*times.first()?, *times.get(times.len() / 2)?, *times.last()?])
    }
}

/// How many runs of a cell contradict what is expected of the fault.
#[must_use]
pub const fn against(fault: &Fault, cell: &Cell) -> usize {
    let unseen = cell.late.saturating_add(cell.missed);
    match (fault.expected, fault.effect) {
        (Expected::Detected, Effect::Averted) => unseen.saturating_add(cell.reported),
        (Expected::Detected, Effect::Reported) => unseen,
        (Expected::Tolerated, _) => cell.dangerous(),
        (Expected::Residual, _) => 0,
    }
}

/// Every fault of the list.
#[must_use]
pub fn rows<'a>(list: &'a List, matrix: &Matrix) -> Vec<Row<'a>> {
    list.faults.iter().map(|fault| row(fault, matrix)).collect()
}

fn row<'a>(fault: &'a Fault, matrix: &Matrix) -> Row<'a> {
    let mut sum = Cell { fault: fault.run.id.clone(), ..Cell::default() };
    for cell in matrix.of(&fault.run.id).values() {
        sum.harmless = sum.harmless.saturating_add(cell.harmless);
        sum.averted = sum.averted.saturating_add(cell.averted);
        sum.reported = sum.reported.saturating_add(cell.reported);
        sum.late = sum.late.saturating_add(cell.late);
        sum.missed = sum.missed.saturating_add(cell.missed);
        sum.detection_ms.extend(&cell.detection_ms);
        sum.share = sum.share.max(cell.share);
        sum.examples.extend(cell.examples.iter().cloned());
    }
    sum.detection_ms.sort_unstable();
    let standing = match (against(fault, &sum), fault.expected) {
        _ if sum.runs() == 0 => Standing::NotRun,
        (1.., _) if fault.known.is_some() => Standing::Known,
        (1.., _) => Standing::Against,
        (0, Expected::Residual) if sum.dangerous() > 0 => Standing::Residual,
        (0, Expected::Detected | Expected::Residual) if sum.dangerous() == 0 => Standing::NotShown,
        (0, Expected::Detected | Expected::Tolerated | Expected::Residual) => Standing::AsExpected,
    };
    Row { fault, sum, standing }
}

/// Whether the campaign has failed: a fault stands against its expectation, or a drive without a fault was disturbed.
#[must_use]
pub fn failed(rows: &[Row<'_>], matrix: &Matrix) -> bool {
    let disturbed = matrix.drives.iter().any(|drive| drive.interventions > 0 || drive.harms > 0);
    disturbed || rows.iter().any(|row| row.standing == Standing::Against)
}
