//! **May the parking brake be released? Must it be applied?** (S3 §2.4, SEAT-4, SEAT-5, SEAT-11, EPB-1)
//!
//! Release needs the seat *confirmed occupied*, in every state and whoever asks. After *parked by leave* it also
//! needs K1 and K4 confirmed closed and a confirmed gear other than N, and after that the accelerator pressed
//! anew (released → pressed). Nothing else releases, and a refused release becomes *none*.
//!
//! # Invariants
//! - release permitted ⇒ seat confirmed occupied in this very cycle (SEAT-5a);
//! - apply obliged ⇒ release refused (`Envelope::is_feasible`).

use crate::envelope::EpbBound;
use crate::seat::SeatState;
use supervisor_observe::Ticks;
use supervisor_observe::{Evidence, SeatView};

use supervisor_terms::word::{codes, permit, retained};
use supervisor_terms::{Config, Contact, EpbRequest, EpbState, EpbSwitch, Gear, Inputs, Outputs, Reason, Timer};

codes! {
    /// The accelerator "pressed anew" (SEAT-5).
    PedalChain {
        /// Contactors and gear are not confirmed, or the pedal has not been seen released since.
        Waiting = 0,
        /// Seen released.
        Released = 1,
        /// Pressed after that.
        PressedAnew = 2,
    }
}

retained! {
    /// The parking machine.
    Parking {
        /// *Parked by leave*: cleared only by a legal release.
        by_leave: bool = false,
        /// The accelerator's chain towards a legal release.
        pedal: PedalChain = PedalChain::Waiting,
        /// Apply is asked for and not confirmed.
        unconfirmed: Timer = Timer::STOPPED,
        /// The last known speed was below that at which the brake is applied (SELF-5, rule 1).
        slow: bool = false,
        /// Speed unknown during leave.
        speedless: Timer = Timer::STOPPED,
    }
}

impl Parking {
    pub(crate) fn advance(
        self,
        seat: &SeatState,
        evidence: &Evidence,
        inputs: &Inputs,
        ticks: Ticks,
        config: &Config,
    ) -> Self {
        let speedless = self.speedless.run_while(seat.leave && evidence.speed.is_none(), ticks.safety);
        let slow = evidence.slow(config.epb_speed, self.slow);
        let next = Self { slow, speedless, ..self };
        // SEAT-4d: leave below 1.5 km/h applies the brake and sets the latch.
        let by_leave = self.by_leave || (seat.leave && next.is_slow(evidence, config));
        // SEAT-5b, c, d: K1, K4 and gear first, then the accelerator anew.
        let ready = seat.confirmed(config)
            && inputs.k1.is(Contact::Closed)
            && inputs.k4.is(Contact::Closed)
            && inputs.gear.known().is_some_and(|gear| gear != Gear::Neutral);
        let pressed = evidence.accelerator.map(|travel| travel > config.pedal_pressed);
        let pedal = match (ready && by_leave, pressed, self.pedal) {
            (false, _, _) | (true, None, _) | (true, Some(true), PedalChain::Waiting) => PedalChain::Waiting,
            (true, Some(false), _) => PedalChain::Released,
            (true, Some(true), PedalChain::Released | PedalChain::PressedAnew) => PedalChain::PressedAnew,
        };
        let next = Self { by_leave, pedal, ..next };
        let waiting = next.must_apply(seat, evidence, inputs, config);
        Self { unconfirmed: self.unconfirmed.run_while(waiting, ticks.safety), ..next }
    }

    /// Slow enough that an apply is obliged: below 1.5 km/h, or speed unknown for 20 s of leave (SEAT-3).
    fn is_slow(&self, evidence: &Evidence, config: &Config) -> bool {
        evidence.obliged_below(config.epb_speed) || self.speedless.reached(config.epb_speedless)
    }

    /// SEAT-4a, b, SEAT-11d: apply until confirmed, and again when it comes loose.
    fn must_apply(&self, seat: &SeatState, evidence: &Evidence, inputs: &Inputs, config: &Config) -> bool {
        let kept = seat.leave || (self.by_leave && !seat.confirmed(config));
        kept && self.is_slow(evidence, config) && !inputs.epb.is(EpbState::Applied)
    }

    /// SEAT-4e, SEAT-9c: after vetting: a release that went out was a legal one, and it alone ends *parked by leave*.
    pub(crate) fn record(self, outputs: &Outputs) -> Self {
        let released = outputs.epb.request == EpbRequest::Release;
        Self { by_leave: self.by_leave && !released, ..self }
    }

    /// SEAT-4c: an apply was not confirmed in time.
    pub(crate) const fn overdue(&self, config: &Config) -> bool {
        self.unconfirmed.reached(config.epb_confirm)
    }

    /// The bound of this cycle.
    pub(crate) fn bound(
        &self,
        seat: &SeatState,
        evidence: &Evidence,
        inputs: &Inputs,
        safe_state: bool,
        forced: Option<Reason>,
        config: &Config,
    ) -> EpbBound {
        let switch = inputs.epb_switch.is(EpbSwitch::Apply);
        let obliged = if self.must_apply(seat, evidence, inputs, config) {
            Some(Reason::EpbApply)
        } else if forced.is_some() {
            forced
        } else if safe_state && self.slow {
            // SELF-5e: and release is refused below.
            Some(Reason::SafeState)
        } else {
            switch.then_some(Reason::DriverSwitch)
        };
        let slow = evidence.surely_below(config.epb_speed);
        // SEAT-5a: the seat in this very cycle; then what SEAT-5b to SEAT-5d ask for.
        let release = permit!(
            (seat.confirmed(config) && evidence.seat == SeatView::Occupied) => Reason::SeatNotOccupied,
            !safe_state => Reason::SafeState,
            (obliged != Some(Reason::EpbApply)) => Reason::EpbApply,
            forced.is_none() => Reason::EpbApply,
            !switch => Reason::DriverSwitch,
            (!self.by_leave || self.pedal == PedalChain::PressedAnew) => Reason::ParkedByLeave,
        );
        // EPB-1a, d: the driver's own switch goes first, either way.
        let driver_releases = inputs.epb_switch.is(EpbSwitch::Release) && release.is_ok();
        let apply = permit!(
            (obliged.is_some() || slow) => Reason::EpbSpeed,
            (obliged.is_some() || !driver_releases) => Reason::DriverSwitch,
        );
        EpbBound { obliged, apply, release }
    }
}
