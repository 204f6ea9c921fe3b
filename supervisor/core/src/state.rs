//! Retained state, and how it rests: words beside their complement (SELF-5).

use crate::boot::Boot;
use crate::brake::Brake;
use crate::clock::Clock;
use crate::drive::Drive;
use crate::gear::GearState;
use crate::high_voltage::HighVoltage;
use crate::mitigation::Mitigation;
use crate::parking::Parking;
use crate::seat::SeatState;
use crate::steering::SteeringState;

use supervisor_terms::word::{Words, retained};
use supervisor_terms::{Body, Faults, Record, ResetCause, Stage};

retained! {
    /// Everything the supervisor remembers from cycle to cycle.
    ///
    /// Every combination of field values is a legal state: no proof needs an invariant between machines.
    State {
        /// SELF-3.
        clock: Clock = Clock::INITIAL,
        /// SELF-9.
        boot: Boot = Boot::INITIAL,
        /// SEAT-1.
        seat: SeatState = SeatState::INITIAL,
        /// SEAT-4, SEAT-5.
        parking: Parking = Parking::INITIAL,
        /// SEAT-7, SEAT-8.
        high_voltage: HighVoltage = HighVoltage::INITIAL,
        /// MIT.
        mitigation: Mitigation = Mitigation::INITIAL,
        /// MODE, TRQ.
        drive: Drive = Drive::INITIAL,
        /// PHB, E2E-2.
        brake: Brake = Brake::INITIAL,
        /// GEAR.
        gear: GearState = GearState::INITIAL,
        /// STR.
        steering: SteeringState = SteeringState::INITIAL,
        /// E2E-2: the body keeps its last output.
        body: Body = Body::NEUTRAL,
        /// Latched faults; any of them is the safe state.
        latched: Faults = Faults::NONE,
    }
}

impl State {
    /// SELF-9: the state after a reset. `record` is `None` when the persisted record failed its CRC.
    #[must_use]
    pub fn boot(cause: ResetCause, record: Option<Record>) -> Self {
        let clean = cause == ResetCause::PowerOn && record == Some(Record::None);
        let down = record == Some(Record::HighVoltageDown);
        let leave = record == Some(Record::Leave);
        Self {
            boot: Boot::new(clean),
            seat: SeatState { leave, ..SeatState::INITIAL },
            parking: Parking { by_leave: leave || down, ..Parking::INITIAL },
            // What is already open is seen by its feedback; what is not, is still owed.
            high_voltage: HighVoltage {
                stage: if down { Stage::OpeningK4 } else { Stage::Up },
                ..HighVoltage::INITIAL
            },
            ..Self::INITIAL
        }
    }

    /// SELF-5b: the state after retained words that did not decode: any other boot, in the safe state.
    #[must_use]
    pub fn corrupted() -> Self {
        Self { latched: Faults::STATE, ..Self::boot(ResetCause::Other, None) }
    }

    /// What the integrator persists now (SELF-9).
    #[must_use]
    pub fn record(&self) -> Record {
        if self.high_voltage.stage != Stage::Up {
            Record::HighVoltageDown
        } else if self.seat.leave || self.parking.by_leave {
            Record::Leave
        } else {
            Record::None
        }
    }

    /// SELF-5b: any latched fault is the safe state.
    #[must_use]
    pub fn is_safe_state(&self) -> bool {
        self.latched != Faults::NONE
    }
}

/// Words of the state.
pub const STATE_WORDS: usize = <State as Words>::COUNT;

/// The state at rest: integers beside their complement. A flipped bit makes [`decode`](Self::decode) fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct StateImage {
    words: [u32; STATE_WORDS],
    complement: [u32; STATE_WORDS],
}

impl StateImage {
    /// Puts a state to rest.
    #[must_use]
    pub fn encode(state: &State) -> Self {
        let mut image = Self { words: [0; STATE_WORDS], complement: [u32::MAX; STATE_WORDS] };
        let mut slots = image.words.iter_mut().zip(image.complement.iter_mut());
        state.write(&mut |word| {
            if let Some((slot, complement)) = slots.next() {
                *slot = word;
                *complement = !word;
            }
        });
        image
    }

    /// SELF-5a: whether every word and its complement agree.
    #[must_use]
    pub fn intact(&self) -> bool {
        self.words.iter().zip(&self.complement).all(|(word, complement)| *word == !*complement)
    }

    /// The state, or `None` if the image is not intact, or a word decodes to no value.
    #[must_use]
    pub fn decode(&self) -> Option<State> {
        let mut words = self.words.iter().copied();
        if self.intact() { State::read(&mut || words.next()) } else { None }
    }

    /// The same image with bit `bit` of word `index` flipped; indices run over words, then complements.
    ///
    /// Fault injection in safe code: a flipped bit at rest.
    #[must_use]
    pub fn with_flipped_bit(mut self, index: usize, bit: u32) -> Self {
        let mask = 1_u32.checked_shl(bit).unwrap_or(0);
        let complement = index.checked_sub(STATE_WORDS).and_then(|index| self.complement.get_mut(index));
        if let Some(word) = self.words.get_mut(index).or(complement) {
            *word ^= mask;
        }
        self
    }
}
