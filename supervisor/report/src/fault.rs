//! Debounced faults.

use supervisor_core::{Decision, Faults, Millis};

/// How many faults there are room for: one per bit.
const BITS: usize = 32;

/// Reports a fault once it has lasted, and counts how often it has come.
#[derive(Clone, Copy, Debug)]
pub struct FaultReport {
    debounce: Millis,
    lasted: [Millis; BITS],
    occurrences: [u8; BITS],
    active: Faults,
}

impl FaultReport {
    /// Reports what has lasted for at least `debounce`.
    #[must_use]
    pub const fn new(debounce: Millis) -> Self {
        Self { debounce, lasted: [Millis::ZERO; BITS], occurrences: [0; BITS], active: Faults::NONE }
    }

    /// RULE-5b: takes the faults of a cycle that lasted `elapsed`.
    pub fn observe(&mut self, elapsed: Millis, decision: &Decision) {
        for (index, (fault, _)) in Faults::NAMES.iter().enumerate() {
            let (Some(lasted), Some(count)) = (self.lasted.get_mut(index), self.occurrences.get_mut(index)) else {
                continue;
            };
            if decision.status.faults.contains(*fault) {
                *lasted = Millis::new(lasted.raw().saturating_add(elapsed.raw()));
            } else {
                *lasted = Millis::ZERO;
                self.active = self.active.without(*fault);
            }
            if *lasted >= self.debounce && *lasted > Millis::ZERO && !self.active.contains(*fault) {
                self.active = self.active.with(*fault);
                *count = count.saturating_add(1);
            }
        }
    }

    /// The faults that are reported now.
    #[must_use]
    pub const fn active(&self) -> Faults {
        self.active
    }

    /// How often a fault was reported, saturating.
    #[must_use]
    pub fn occurrences(&self, fault: Faults) -> u8 {
        let index = Faults::NAMES.iter().position(|(name, _)| *name == fault);
        index.and_then(|index| self.occurrences.get(index)).copied().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{EventRecord, What};
    use supervisor_core::{
        Commands, ConfigError, Flow, Inputs, Record, ResetCause, Sealed, State, StateImage, Threat, step,
    };

    fn decide(image: &mut StateImage, now: u32) -> Result<Decision, ConfigError> {
        let sealed = Sealed::from_default()?;
        Ok(step(image, &sealed, Flow::PERCEIVED, Millis::new(now), &Inputs::NEVER, &Threat::UNKNOWN, &Commands::ABSENT))
    }

    /// RULE-5b: a fault is reported only after it has lasted, and counted once.
    #[test]
    fn a_fault_is_reported_after_the_debounce_and_counted_once() -> Result<(), ConfigError> {
        let mut image = StateImage::encode(&State::boot(ResetCause::PowerOn, Some(Record::None)));
        let mut report = FaultReport::new(Millis::new(500));
        for cycle in 1..=49 {
            report.observe(Millis::new(10), &decide(&mut image, cycle * 10)?);
        }
        assert_eq!(report.active(), Faults::NONE);
        for cycle in 50..=60 {
            report.observe(Millis::new(10), &decide(&mut image, cycle * 10)?);
        }
        assert!(report.active().contains(Faults::SEAT_UNKNOWN));
        assert_eq!(report.occurrences(Faults::SEAT_UNKNOWN), 1);
        Ok(())
    }

    /// The record holds the newest events and counts what it dropped.
    #[test]
    fn the_record_is_bounded_and_counts_what_it_drops() -> Result<(), ConfigError> {
        let mut image = StateImage::encode(&State::boot(ResetCause::PowerOn, Some(Record::None)));
        let mut record = EventRecord::<4>::new();
        record.observe(Millis::new(10), &decide(&mut image, 10)?);
        assert_eq!(record.iter().count(), 4);
        assert!(record.dropped() > 0);
        assert!(record.iter().any(|event| matches!(event.what, What::Faults(_))));
        let dropped = record.dropped();
        record.observe(Millis::new(20), &decide(&mut image, 20)?);
        assert!(record.dropped() <= dropped + 1, "nothing but the faults may have changed");
        Ok(())
    }
}
