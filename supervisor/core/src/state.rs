//! Retained state, and how it rests: words beside their complement (SELF-5).

use crate::boot::Boot;
use crate::brake::Brake;
use crate::drive::Drive;
use crate::gear::GearState;
use crate::high_voltage::HighVoltage;
use crate::latch::Latches;
use crate::mitigation::Mitigation;
use crate::parking::Parking;
use crate::seat::SeatState;
use crate::steering::SteeringState;

use supervisor_observe::{Clock, Monitors};
use supervisor_terms::word::{Words, retained};
use supervisor_terms::{Body, Faults, Flow, Image, Record, ResetCause, Stage};

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
        /// RSP, SELF-10.
        monitors: Monitors = Monitors::INITIAL,
        /// SELF-7.
        latches: Latches = Latches::INITIAL,
        /// SELF-6: the stages that the last cycle ran.
        flow: Flow = Flow::RECORDED,
    }
}

impl State {
    /// SELF-9: the state after a reset. `record` is `None` when the persisted record failed its CRC.
    #[must_use]
    pub fn boot(cause: ResetCause, record: Option<Record>) -> Self {
        let down = record == Some(Record::HighVoltageDown);
        let leave = record == Some(Record::Leave);
        Self {
            boot: Boot::new(cause == ResetCause::PowerOn && record == Some(Record::None)),
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
        let fresh = Self::boot(ResetCause::Other, None);
        Self { latches: Latches::with(Faults::STATE), drive: Drive { release_needed: true, ..fresh.drive }, ..fresh }
    }

    /// SELF-5c: the state after an image that is not intact: what its whole copy says, if there is one.
    #[must_use]
    pub fn damaged(image: &StateImage) -> Self {
        image.recover().map_or_else(Self::corrupted, Self::after_damage)
    }

    /// SELF-5c: [`corrupted`](Self::corrupted), with what the recovered state still obliges; it permits nothing.
    #[must_use]
    pub fn after_damage(old: Self) -> Self {
        let fresh = Self::corrupted();
        Self {
            boot: fresh.boot,
            latches: Latches::with(old.latches.faults.with(Faults::STATE)),
            seat: SeatState { occupied: fresh.seat.occupied, ..old.seat },
            parking: Parking { pedal: fresh.parking.pedal, ..old.parking },
            high_voltage: HighVoltage {
                restart: fresh.high_voltage.restart,
                key: fresh.high_voltage.key,
                ..old.high_voltage
            },
            drive: fresh.drive,
            flow: fresh.flow,
            ..old
        }
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

    /// SELF-5b: a latched fault of the supervisor itself is the safe state.
    #[must_use]
    pub fn is_safe_state(&self) -> bool {
        self.latches.safe_state()
    }
}

/// Words of the state.
pub const STATE_WORDS: usize = <State as Words>::COUNT;

/// The state at rest: integers beside their complement. A flipped bit makes [`decode`](Image::decode) fail.
pub type StateImage = Image<STATE_WORDS>;
