//! Which gear may be asked for? (GEAR-1, SEAT-6)

use crate::envelope::{GearBound, Permission};
use crate::parking::Parking;
use crate::seat::SeatState;
use supervisor_observe::Evidence;

use supervisor_terms::word::{codes, permit, retained};
use supervisor_terms::{Config, EpbState, Gear, Inputs, Reason};

codes! {
    /// The direction driven in since standstill.
    Direction {
        /// Not known: no direction has been confirmed since standstill in neutral.
        None = 0,
        /// Drive.
        Forward = 1,
        /// Reverse.
        Reverse = 2,
    }
}

retained! {
    /// The gear machine: remembers the direction through neutral (GEAR-1).
    GearState {
        /// Direction of the last confirmed driving gear.
        direction: Direction = Direction::None,
    }
}

impl GearState {
    pub(crate) fn advance(self, evidence: &Evidence, inputs: &Inputs) -> Self {
        let direction = match inputs.gear.known() {
            Some(Gear::Drive) => Direction::Forward,
            Some(Gear::Reverse) => Direction::Reverse,
            Some(Gear::Neutral | Gear::Park) if evidence.standstill => Direction::None,
            Some(Gear::Neutral | Gear::Park) | None => self.direction,
        };
        Self { direction }
    }

    pub(crate) fn bound(
        self,
        parking: &Parking,
        seat: &SeatState,
        evidence: &Evidence,
        inputs: &Inputs,
        safe_state: bool,
        config: &Config,
    ) -> GearBound {
        let confirmed = seat.confirmed(config);
        let parked = inputs.epb.is(EpbState::Applied);
        // SELF-5f, SEAT-6a, c: the gear holds in the safe state; a driving gear needs the driver, unless the bus is known to roll with the brake released.
        let rolling = evidence.surely_at_least(config.epb_speed) && inputs.epb.is(EpbState::Released);
        let gear = |selected: Gear, direction: Direction| -> Permission {
            let may_change = evidence.standstill || (evidence.speed.is_some() && self.direction == direction);
            permit!(!safe_state => Reason::SafeState, (confirmed || rolling) => Reason::SeatNotOccupied, inputs.selector.is(selected) => Reason::Selector, may_change => Reason::NotStandstill)
        };
        GearBound {
            confirmed: inputs.gear.known(),
            neutral: parking.by_leave && parked && !confirmed && !safe_state,
            drive: gear(Gear::Drive, Direction::Forward),
            reverse: gear(Gear::Reverse, Direction::Reverse),
            park: permit!(!safe_state => Reason::SafeState, confirmed => Reason::SeatNotOccupied, inputs.selector.is(Gear::Park) => Reason::Selector, evidence.standstill => Reason::NotStandstill),
            // SEAT-4c: a parking brake that does not confirm leaves the gear as it is.
            to_neutral: permit!(!safe_state => Reason::SafeState, !parking.overdue(config) => Reason::EpbApply),
        }
    }
}
