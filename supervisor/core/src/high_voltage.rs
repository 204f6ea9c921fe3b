//! Contactors: K4 opens before K1, under no load, at standstill; they close only after a restart by the driver
//! (S3 §2.6, SEAT-7, SEAT-8, SEAT-11, HV-1).
//!
//! # Invariants (each holds in the cycle of the command, not in some earlier one)
//! - K1 may open ⇒ K4 known open, drive and auxiliaries known stopped, standstill;
//! - K4 may open ⇒ standstill, executed torque known to be none (our own torque: `vet`);
//! - K1 may close ⇒ restart complete and K4 known open; K4 may close ⇒ restart complete and K1 known closed.

use crate::envelope::{ContactorBound, Permission};
use crate::parking::Parking;
use crate::seat::SeatState;
use supervisor_observe::Ticks;
use supervisor_observe::{Evidence, SeatView, percent};

use supervisor_terms::word::{codes, permit, retained};
use supervisor_terms::{Config, Contact, EpbState, Inputs, Key, Reason, Stage, Timer};

codes! {
    /// The driver's restart: seat confirmed occupied, key Off, key Start, in that order.
    Restart {
        /// Nothing of it.
        Idle = 0,
        /// Seat confirmed and key Off seen.
        OffSeen = 1,
        /// Key Start (edge) seen after that: closing is permitted.
        Started = 2,
    }
    /// The key as last known, for the edge.
    LastKey {
        /// Never known.
        None = 0,
        /// Off.
        Off = 1,
        /// On.
        On = 2,
        /// Start.
        Start = 3,
    }
}

retained! {
    /// The high-voltage machine.
    HighVoltage {
        /// Shutdown after leave.
        stage: Stage = Stage::Up,
        /// Time parked by leave with an empty seat and the parking brake confirmed.
        parked: Timer = Timer::STOPPED,
        /// Time in the present stage.
        wait: Timer = Timer::STOPPED,
        /// The driver's restart.
        restart: Restart = Restart::Idle,
        /// The key as last known.
        key: LastKey = LastKey::None,
    }
}

impl HighVoltage {
    /// `clean` says that a clean key-on counts as Off seen in this cycle (SELF-9).
    pub(crate) fn advance(
        self,
        parking: &Parking,
        seat: &SeatState,
        clean: bool,
        evidence: &Evidence,
        inputs: &Inputs,
        ticks: Ticks,
        config: &Config,
    ) -> Self {
        let parked = if parking.by_leave {
            self.parked_for(evidence, inputs, ticks, seat.confirmed(config))
        } else {
            Timer::STOPPED
        };
        let (k4_open, k1_open) = (inputs.k4.is(Contact::Open), inputs.k1.is(Contact::Open));
        let restart = self.restart(seat, clean, evidence, inputs, config);
        // SEAT-7a to SEAT-7d: the shutdown begins with every guard kept; again, if high voltage is on that it had turned off.
        let begin = parked.reached(config.shutdown_after)
            && !(k4_open && k1_open)
            && evidence.seat == SeatView::Vacant
            && evidence.standstill
            && inputs.epb.is(EpbState::Applied)
            && torque_stopped(inputs, config);
        let stage = match self.stage {
            Stage::Up | Stage::Down if begin => Stage::OpeningK4,
            // SEAT-7k, SEAT-8a: only a complete restart leads up again, and never out of a committed sequence.
            Stage::Down if restart == Restart::Started => Stage::Up,
            Stage::OpeningK4 if k4_open => Stage::OpeningK1,
            Stage::OpeningK1 if k4_open && k1_open => Stage::Down,
            Stage::Up => Stage::Up,
            Stage::OpeningK4 => Stage::OpeningK4,
            Stage::OpeningK1 => Stage::OpeningK1,
            Stage::Down => Stage::Down,
        };
        let same = stage == self.stage;
        let wait = (if same { self.wait } else { Timer::STOPPED }).run_while(stage != Stage::Up, ticks.safety);
        let key = match inputs.key.known() {
            None => self.key,
            Some(Key::Off) => LastKey::Off,
            Some(Key::On) => LastKey::On,
            Some(Key::Start) => LastKey::Start,
        };
        Self { stage, parked, wait, restart, key }
    }

    /// SEAT-7a, SEAT-9b, SEAT-11a, b, c, e, f: the 10 minutes.
    fn parked_for(self, evidence: &Evidence, inputs: &Inputs, ticks: Ticks, confirmed: bool) -> Timer {
        if confirmed || inputs.epb.is(EpbState::Released) {
            return Timer::STOPPED;
        }
        let continues = match evidence.seat {
            SeatView::Vacant => true,
            SeatView::Unknown => self.parked.is_running(),
            SeatView::Occupied | SeatView::HalfOccupied => false,
        };
        if continues && inputs.epb.is(EpbState::Applied) { self.parked.run(ticks.permission) } else { self.parked }
    }

    /// SEAT-8a, b: seat confirmed occupied, key Off, key Start (edge), in that order, seat not lost between.
    fn restart(self, seat: &SeatState, clean: bool, evidence: &Evidence, inputs: &Inputs, config: &Config) -> Restart {
        let sits = seat.confirmed(config) && evidence.seat == SeatView::Occupied;
        let both_closed = inputs.k1.is(Contact::Closed) && inputs.k4.is(Contact::Closed);
        let edge = self.key != LastKey::Start && self.key != LastKey::None;
        match (sits, inputs.key.known(), self.restart) {
            (false, _, _) => Restart::Idle,
            (true, Some(Key::Off), _) => Restart::OffSeen,
            (true, Some(Key::Start), Restart::OffSeen) if edge => Restart::Started,
            // Used up once both are closed: what drops out later does not re-close by itself (HV-1).
            (true, _, Restart::Started) if both_closed => Restart::Idle,
            (true, _, Restart::Started) => Restart::Started,
            (true, _, Restart::Idle) if clean => Restart::OffSeen,
            (true, _, state) => state,
        }
    }

    /// SEAT-7h: K4 was not confirmed open in time.
    pub(crate) fn k4_overdue(&self, config: &Config) -> bool {
        self.stage == Stage::OpeningK4 && self.wait.reached(config.k4_deadline)
    }
    /// SEAT-7h: the loads did not stop, or K1 was not confirmed open, in time.
    pub(crate) fn k1_overdue(&self, config: &Config) -> bool {
        self.stage == Stage::OpeningK1 && self.wait.reached(config.k1_deadline)
    }

    /// The bounds of K4 and K1 in this cycle.
    pub(crate) fn bounds(
        &self,
        evidence: &Evidence,
        inputs: &Inputs,
        held: Permission,
        sound: Permission,
        config: &Config,
    ) -> (ContactorBound, ContactorBound) {
        let standing = held.and(permit!(evidence.standstill => Reason::NotStandstill));
        let committed = matches!(self.stage, Stage::OpeningK4 | Stage::OpeningK1);
        // SEAT-7b, d, HV-1a, c: K4 opens at standstill without drive torque.
        let k4_open = standing.and(permit!(torque_stopped(inputs, config) => Reason::LoadsNotStopped));
        // SEAT-7e, f, g, HV-1b: K1 opens after K4 and the loads.
        let k1_open = standing.and(permit!(
            inputs.k4.is(Contact::Open) => Reason::K4NotOpen,
            loads_stopped(inputs, config) => Reason::LoadsNotStopped,
        ));
        // SEAT-8a, c, HV-1d: closing needs the driver's restart, and no shutdown in progress.
        let closing = held
            .and(sound)
            .and(permit!(!committed => Reason::Shutdown, (self.restart == Restart::Started) => Reason::NoRestart));
        let k1_close = closing.and(permit!(inputs.k4.is(Contact::Open) => Reason::K4NotOpen));
        let k4_close = closing.and(permit!(inputs.k1.is(Contact::Closed) => Reason::K1NotClosed));
        // RULE-4b, SEAT-7c, i, j: the guards stand inside the obligation: guard lost ⇒ it waits.
        let k4 = ContactorBound {
            obliged: committed && inputs.epb.is(EpbState::Applied) && k4_open.is_ok(),
            open: k4_open,
            close: k4_close,
        };
        let k1 = ContactorBound {
            obliged: self.stage == Stage::OpeningK1 && k1_open.is_ok(),
            open: k1_open,
            close: k1_close,
        };
        (k4, k1)
    }
}

/// No drive torque is executed.
fn torque_stopped(inputs: &Inputs, config: &Config) -> bool {
    percent(inputs.executed_torque).is_some_and(|torque| torque <= config.stopped_torque)
}

/// Drive and auxiliaries are confirmed stopped, and so says the current.
fn loads_stopped(inputs: &Inputs, config: &Config) -> bool {
    let bound = config.stopped_current.raw().unsigned_abs();
    let current = inputs.hv_current.known().is_some_and(|current| current.raw().unsigned_abs() <= bound);
    inputs.drive_stopped.is(true) && inputs.auxiliaries_stopped.is(true) && current
}
