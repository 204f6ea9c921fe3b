//! S3: the driver out of the seat. Warnings, deceleration, parking brake, neutral, high voltage down and up again.

use supervisor::{
    Contact, ContactorRequest, Contactors, EpbMode, EpbRequest, EpbState, EpbSwitch, Gear, GearRequest, Inputs, Key,
    ParkingBrake,
};

use super::sources::{
    CONFIRM_MS, EPB_SPEED, LEAVE_DECEL, LEAVE_HOLD, LEAVE_MARGIN, LEAVE_MS, SHUTDOWN_MS, STOPPED_CURRENT,
};
use super::view::{Held, View};

/// The driver's way back to high voltage (S3 §2.6): key off, then start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Restart {
    #[default]
    Idle,
    OffSeen,
    Closing,
}

/// The driver, the parking brake, the gear and the contactors.
#[derive(Clone, Copy, Debug, Default)]
pub struct Leave {
    occupied: Held,
    vacant: Held,
    /// Leave runs.
    pub running: bool,
    /// Parked because of it, and not yet released.
    pub parked: bool,
    parked_for: Held,
    /// High voltage goes, or has gone, down.
    down: bool,
    restart: Restart,
    started: bool,
    last_key: Option<Key>,
    /// The accelerator's way to a release: seen released with everything else in place.
    pedal_released: bool,
    releasing: bool,
    /// After leave the selector must be seen in neutral before a driving gear counts.
    selector_stale: bool,
}

impl Leave {
    /// One cycle.
    pub fn update(&mut self, inputs: &Inputs, view: &View) {
        self.occupied.update(view.occupied);
        self.vacant.update(view.vacant);
        let powered = matches!(view.key, Some(Key::On | Key::Start)) || inputs.k1.is(Contact::Closed);
        let rolling = view.speed.is_some_and(|speed| speed >= EPB_SPEED);
        let unparked = powered && (view.epb == Some(EpbState::Released) || rolling);
        self.running = if self.running { !self.confirmed() } else { unparked && self.vacant.for_at_least(LEAVE_MS) };
        self.parked |= self.running && view.below(EPB_SPEED);
        self.selector_stale = (self.selector_stale || self.running) && !inputs.selector.is(Gear::Neutral);
        self.update_release(inputs, view);
        self.update_power(inputs, view);
    }

    /// Somebody sits for certain.
    #[must_use]
    pub fn confirmed(&self) -> bool {
        self.occupied.for_at_least(CONFIRM_MS)
    }

    /// S3 §2.4: released by the driver's switch; after leave only seated, in gear, high voltage up, pedal pressed anew.
    fn update_release(&mut self, inputs: &Inputs, view: &View) {
        let up = inputs.k1.is(Contact::Closed) && inputs.k4.is(Contact::Closed);
        let ready = self.confirmed() && up && view.in_gear();
        self.pedal_released = ready && self.parked && (self.pedal_released || !view.pressed());
        let anew = self.pedal_released && view.pressed();
        let switched = !self.parked && inputs.epb_switch.is(EpbSwitch::Release) && view.braking;
        let released = view.epb == Some(EpbState::Released);
        self.releasing = self.confirmed() && !released && (self.releasing || anew || switched);
        self.parked &= !(released && self.confirmed());
    }

    /// S3 §2.6: ten minutes parked; then K4, then K1. Up again by key off and start, seated all along.
    fn update_power(&mut self, inputs: &Inputs, view: &View) {
        let waits = self.parked && !self.confirmed() && view.epb == Some(EpbState::Applied);
        self.parked_for.update(waits);
        let (k1, k4) = (inputs.k1, inputs.k4);
        let opened = k1.is(Contact::Open) && k4.is(Contact::Open);
        self.down = (self.down || self.parked_for.for_at_least(SHUTDOWN_MS)) && !opened;
        let edge = view.key == Some(Key::Start) && self.last_key.is_some_and(|key| key != Key::Start);
        self.restart = match (self.confirmed(), view.key, self.restart) {
            (false, _, _) => Restart::Idle,
            (true, Some(Key::Off), _) => Restart::OffSeen,
            // The first time somebody sits after a clean start counts as key off seen.
            (true, _, Restart::Idle) if !self.started => Restart::OffSeen,
            (true, _, Restart::OffSeen) if edge => Restart::Closing,
            (true, _, Restart::Closing) if k1.is(Contact::Closed) && k4.is(Contact::Closed) => Restart::Idle,
            (true, _, state) => state,
        };
        self.started |= self.confirmed();
        self.last_key = view.key.or(self.last_key);
    }

    /// S3 §2.3, table 1: the deceleration asked for, in m/s².
    #[must_use]
    pub fn demand(&self, view: &View) -> f64 {
        if !self.running {
            return 0.0;
        }
        let (hold, hold_speed) = LEAVE_HOLD;
        let Some(speed) = view.speed else { return hold };
        let holds = speed < hold_speed && view.epb != Some(EpbState::Applied);
        let table = table(speed);
        let demand = if holds { table.max(hold) } else { table };
        if demand > 0.0 { demand + LEAVE_MARGIN } else { 0.0 }
    }

    /// S3 §2.4; the driver's switch comes first (S4 6.2.11).
    #[must_use]
    pub fn parking_brake(&self, inputs: &Inputs, view: &View) -> ParkingBrake {
        let kept = self.running || (self.parked && !self.confirmed());
        let owed = kept && view.below(EPB_SPEED) && view.epb != Some(EpbState::Applied);
        let request = if owed || inputs.epb_switch.is(EpbSwitch::Apply) {
            EpbRequest::Apply
        } else if self.releasing {
            EpbRequest::Release
        } else {
            EpbRequest::None
        };
        ParkingBrake { request, mode: EpbMode::Automatic }
    }

    /// S3 §2.5: neutral while parked and nobody sits; then by the selector, moved anew.
    #[must_use]
    pub fn gear(&self, inputs: &Inputs, view: &View) -> GearRequest {
        if self.parked && !self.confirmed() && view.epb == Some(EpbState::Applied) {
            return GearRequest::Neutral;
        }
        let selected = inputs.selector.known().filter(|selected| Some(*selected) != view.gear);
        let may = self.confirmed() && view.stands && view.braking && !self.selector_stale;
        match selected {
            Some(Gear::Drive) if may => GearRequest::Drive,
            Some(Gear::Reverse) if may => GearRequest::Reverse,
            Some(Gear::Park) if may => GearRequest::Park,
            Some(Gear::Neutral) if self.confirmed() => GearRequest::Neutral,
            Some(_) | None => GearRequest::Hold,
        }
    }

    /// S3 §2.6: K4 first; K1 only when K4 is open and drive and auxiliaries have stopped. Closing the other way round.
    #[must_use]
    pub fn contactors(&self, inputs: &Inputs) -> Contactors {
        let still = inputs.hv_current.known().is_some_and(|current| current.raw().unsigned_abs() <= STOPPED_CURRENT);
        let stopped = inputs.drive_stopped.is(true) && inputs.auxiliaries_stopped.is(true) && still;
        if self.down {
            let k1 = inputs.k4.is(Contact::Open) && stopped;
            let k1 = if k1 { ContactorRequest::Open } else { ContactorRequest::Hold };
            return Contactors { k4: ContactorRequest::Open, k1 };
        }
        match (self.restart, inputs.k1.known(), inputs.k4.known()) {
            (Restart::Closing, Some(Contact::Open), Some(Contact::Open)) => {
                Contactors { k4: ContactorRequest::Hold, k1: ContactorRequest::Close }
            }
            (Restart::Closing, Some(Contact::Closed), Some(Contact::Open)) => {
                Contactors { k4: ContactorRequest::Close, k1: ContactorRequest::Hold }
            }
            (Restart::Idle | Restart::OffSeen | Restart::Closing, _, _) => Contactors::NEUTRAL,
        }
    }
}

/// S3 table 1, linear between its points; its last value beyond.
fn table(speed: f64) -> f64 {
    let pairs = LEAVE_DECEL.iter().zip(LEAVE_DECEL.iter().skip(1));
    for ((from, low), (to, high)) in pairs {
        if speed < *to {
            return low + (high - low) * (speed - from) / (to - from);
        }
    }
    LEAVE_DECEL.last().map_or(0.0, |(_, decel)| *decel)
}
