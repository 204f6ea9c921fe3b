//! What is known in a cycle, read anew from the inputs: a property does not trust the evidence that it judges.

use supervisor_core::{AngleDeciDeg, Millis, Pedal250, Timer};

use super::Cycle;
use super::facts::runs_while;
pub(crate) use super::facts::{asked, has_run as lasted};

/// The brake pedal (E2E-1d).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BrakePedal {
    /// The switch, or a track, says pressed: this deep, where both tracks agree.
    Pressed(Option<Pedal250>),
    /// The switch and both tracks say released.
    Released,
    /// Neither.
    Unknown,
}

impl Cycle<'_> {
    /// RULE-6c: both speeds where they agree, the lower first.
    pub(crate) fn agreed_speeds(&self) -> Option<(u16, u16)> {
        self.known_speeds().map(|(low, high)| (low.raw(), high.raw()))
    }

    /// The magnitude of the steering-wheel angle, where it is known and in range.
    pub(crate) fn steering_angle(&self) -> Option<u16> {
        let angle = self.inputs.steering_angle.known().map(magnitude)?;
        (angle <= magnitude(self.config.steering_range)).then_some(angle)
    }

    /// The brake pedal by its switch and its two tracks; a track beyond its full travel says nothing.
    pub(crate) fn brake_pedal(&self) -> BrakePedal {
        let [first, second] =
            self.inputs.brake_pedal.map(|track| track.known().map(Pedal250::raw).filter(|travel| *travel <= 250));
        let depth = match (first, second) {
            (Some(first), Some(second)) if first.abs_diff(second) <= self.config.pedal_agree.raw() => {
                Some(Pedal250::new(first.max(second)))
            }
            (_, _) => None,
        };
        let beyond = |track: Option<u8>| track.is_some_and(|travel| travel > self.config.pedal_pressed.raw());
        if self.inputs.brake_switch.is(true) || beyond(first) || beyond(second) {
            BrakePedal::Pressed(depth)
        } else if self.inputs.brake_switch.is(false) && depth.is_some() {
            BrakePedal::Released
        } else {
            BrakePedal::Unknown
        }
    }

    /// What this cycle adds to a timer that ends an obligation, and to one that leads to it.
    pub(crate) fn elapsed(&self) -> (u32, u32) {
        (self.permitting().raw(), self.obliging().raw())
    }
}

/// How far from straight ahead.
pub(crate) fn magnitude(angle: AngleDeciDeg) -> u16 {
    angle.raw().unsigned_abs()
}

/// END-1a: the timer stands at 0 in the first cycle in which its condition holds, then adds what passed; it is gone in
/// the first in which the condition does not hold.
pub(crate) fn counts(old: Timer, new: Timer, holds: bool, elapsed: u32) -> bool {
    runs_while(holds, old, new, Millis::new(elapsed))
}
