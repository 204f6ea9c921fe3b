//! What befalls the supervisor itself: its clock, its memory, its power.

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use supervisor::{Record, ResetCause, STATE_WORDS, Sealed, Status, Supervisor};

use super::kind::Own;

/// A failing supervisor.
#[derive(Clone, Debug)]
pub struct Itself {
    kind: Own,
    from_ms: u32,
    lasts_ms: u32,
    /// How far its clock leaps, in ms.
    leap_ms: u32,
    done: bool,
}

impl Itself {
    /// From this time on, for so long; `leap_ms` is how far its clock leaps.
    #[must_use]
    pub const fn new(kind: Own, from_ms: u32, lasts_ms: u32, leap_ms: u32) -> Self {
        Self { kind, from_ms, lasts_ms, leap_ms, done: false }
    }

    const fn elapsed(&self, now_ms: u32) -> Option<u32> {
        now_ms.checked_sub(self.from_ms)
    }

    fn active(&self, now_ms: u32) -> bool {
        self.elapsed(now_ms).is_some_and(|elapsed| elapsed < self.lasts_ms)
    }

    /// Whether it runs.
    #[must_use]
    pub fn runs(&self, now_ms: u32) -> bool {
        !(matches!(self.kind, Own::StepLate | Own::StepHangs | Own::BrownOut) && self.active(now_ms))
    }

    /// What its clock shows. What it has lost or gained stays.
    pub fn clock(&self, now_ms: u32, random: &mut ChaCha8Rng) -> u32 {
        let Some(elapsed) = self.elapsed(now_ms) else { return now_ms };
        let within = elapsed.min(self.lasts_ms);
        match self.kind {
            Own::ClockStops => now_ms.wrapping_sub(within),
            Own::ClockLeaps => now_ms.wrapping_add(self.leap_ms),
            Own::ClockRunsBack => now_ms.wrapping_sub(within.saturating_mul(2)),
            Own::ClockJitters if self.active(now_ms) => now_ms.wrapping_sub(4).wrapping_add(random.random_range(0..=8)),
            Own::ClockSlow => now_ms.wrapping_sub(within / 2),
            Own::ClockJitters
            | Own::StepLate
            | Own::StepHangs
            | Own::StateBit
            | Own::DigestBit
            | Own::StateBitsHidden
            | Own::ConfigurationBit
            | Own::ResetPowerOn
            | Own::ResetWatchdog
            | Own::ResetOther
            | Own::ResetRecordLost
            | Own::BrownOut => now_ms,
        }
    }

    /// Another supervisor in its place, once; `true`: it was started anew.
    pub fn replace(
        &mut self,
        now_ms: u32,
        old: &Supervisor,
        last: Option<&Status>,
        random: &mut ChaCha8Rng,
    ) -> Option<(Supervisor, bool)> {
        // A brown-out ends with a start.
        let at_ms = if self.kind == Own::BrownOut { self.from_ms.saturating_add(self.lasts_ms) } else { self.from_ms };
        if self.done || now_ms < at_ms {
            return None;
        }
        self.done = true;
        let kept = last.map(|last| last.record);
        match self.kind {
            Own::StateBit => {
                let index = random.random_range(0..2 * STATE_WORDS);
                Some((flipped(old, &[(index, random.random_range(0..32))]), false))
            }
            Own::DigestBit => Some((flipped(old, &[(2 * STATE_WORDS, random.random_range(0..32))]), false)),
            Own::StateBitsHidden => {
                let (index, bit) = (random.random_range(0..STATE_WORDS), random.random_range(0..32));
                Some((flipped(old, &[(index, bit), (index + STATE_WORDS, bit)]), false))
            }
            Own::ConfigurationBit => configured(old, random).map(|supervisor| (supervisor, false)),
            Own::ResetPowerOn => started(ResetCause::PowerOn, kept),
            Own::ResetWatchdog => started(ResetCause::Watchdog, kept),
            Own::ResetOther | Own::BrownOut => started(ResetCause::Other, kept),
            Own::ResetRecordLost => started(ResetCause::Watchdog, None),
            Own::ClockStops
            | Own::ClockLeaps
            | Own::ClockRunsBack
            | Own::ClockJitters
            | Own::ClockSlow
            | Own::StepLate
            | Own::StepHangs => None,
        }
    }
}

fn flipped(old: &Supervisor, bits: &[(usize, u32)]) -> Supervisor {
    let image = bits.iter().fold(*old.image(), |image, (index, bit)| image.with_flipped_bit(*index, *bit));
    old.clone().with_image(image)
}

/// The same state with one bit of the configuration flipped: of a value, if the flipped one is a value of its type.
fn configured(old: &Supervisor, random: &mut ChaCha8Rng) -> Option<Supervisor> {
    let sealed = Sealed::from_default().ok()?;
    let index = random.random_range(0..64);
    let value = sealed.with_flipped_bit(index, random.random_range(0..16));
    let sealed = value.unwrap_or_else(|| sealed.with_flipped_digest(random.random_range(0..32)));
    Some(Supervisor::new(sealed, ResetCause::PowerOn, None).with_image(*old.image()))
}

fn started(cause: ResetCause, record: Option<Record>) -> Option<(Supervisor, bool)> {
    Some((Supervisor::new(Sealed::from_default().ok()?, cause, record), true))
}
