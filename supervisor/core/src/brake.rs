//! How much must the bus brake, and how much may it? (SEAT-3, MIT, PHB-1, TRQ-3, TRQ-4, E2E-2, RET-1, VLC-2)

use crate::envelope::{Bound, BrakeBound};
use crate::mitigation::Mitigation;
use supervisor_observe::Ticks;
use supervisor_observe::{BrakePedal, Evidence, SeatView};

use supervisor_terms::kernel;
use supervisor_terms::word::retained;
use supervisor_terms::{
    Config, DecelMs2Q11, Deviation, EpbState, Inputs, Millis, Mode, Outputs, Pedal250, Percent, Reason, Response,
    SpeedKmhQ8, Threat, Timer,
};

retained! {
    /// The brake machine.
    Brake {
        /// Last output of the service brake.
        total: DecelMs2Q11 = DecelMs2Q11::ZERO,
        /// Last output of the retarder.
        retarder: Percent = Percent::ZERO,
        /// The service-brake command is lost.
        lost: Timer = Timer::STOPPED,
        /// The retarder command is lost.
        retarder_lost: Timer = Timer::STOPPED,
        /// The last known speed was below that at which the bus is held (SELF-5, rule 1).
        slow: bool = false,
        /// Last demand of leave (SEAT-3).
        leave: DecelMs2Q11 = DecelMs2Q11::ZERO,
        /// How long the brake lamps still stay on (BODY-1).
        lamps: Millis = Millis::ZERO,
    }
}

/// What the brake bound depends on beside the inputs.
pub(crate) struct Situation<'a> {
    pub mitigation: &'a Mitigation,
    pub threat: &'a Threat,
    pub response: &'a Response,
    pub mode: Mode,
    pub safe_state: bool,
    /// The parking brake came loose and nobody is confirmed to sit (SELF-10).
    pub loose: bool,
}

/// a₀(v) of S3 table 1: linear between the points, rounded up; beyond 60 km/h its last value (reading e).
pub(crate) fn leave_table(speed: SpeedKmhQ8, config: &Config) -> DecelMs2Q11 {
    /// The points lie 2 km/h apart up to 10 km/h, then 5 km/h.
    const FINE: u16 = 512;
    const COARSE: u16 = 1280;
    const KNEE: u16 = 2560;
    let raw = speed.raw();
    let point =
        |index: usize| config.leave_decel.0.get(index).or(config.leave_decel.0.last()).map_or(0, |decel| decel.raw());
    let between = |index: u16, rest, step| {
        let index = usize::from(index);
        DecelMs2Q11::new(kernel::between_up(point(index), point(index.saturating_add(1)), rest, step))
    };
    if raw < KNEE {
        between(raw / FINE, raw % FINE, FINE)
    } else {
        let above = raw.saturating_sub(KNEE);
        between((above / COARSE).saturating_add(5), above % COARSE, COARSE)
    }
}

impl Brake {
    /// SEAT-3: the demand of leave, kept for the cycles without a speed.
    pub(crate) fn advance(self, leave: bool, evidence: &Evidence, inputs: &Inputs, config: &Config) -> Self {
        let demand = match (leave, evidence.speed) {
            (false, _) => DecelMs2Q11::ZERO,
            (true, None) => self.leave.max(config.leave_hold),
            (true, Some(speed)) => {
                let table = leave_table(speed.low, config);
                let holds = speed.low < config.leave_hold_speed && !inputs.epb.is(EpbState::Applied);
                if holds { table.max(config.leave_hold) } else { table }
            }
        };
        let slow = evidence.slow(config.leave_hold_speed, self.slow);
        Self { leave: demand, slow, ..self }
    }

    /// After vetting: what went out, and whether the commands were usable.
    pub(crate) fn record(self, outputs: &Outputs, due: bool, usable: [bool; 2], ticks: Ticks, config: &Config) -> Self {
        let [brake_usable, retarder_usable] = usable;
        Self {
            total: outputs.brake.total,
            retarder: outputs.retarder.torque,
            lost: self.lost.run_while(!brake_usable, ticks.safety),
            retarder_lost: self.retarder_lost.run_while(!retarder_usable, ticks.safety),
            lamps: if due {
                config.lamp_delay
            } else {
                Millis::new(self.lamps.raw().saturating_sub(ticks.permission.raw()))
            },
            ..self
        }
    }

    pub(crate) fn bound(
        &self,
        situation: &Situation,
        evidence: &Evidence,
        inputs: &Inputs,
        ticks: Ticks,
        config: &Config,
    ) -> BrakeBound {
        let floor = self.floor(situation, evidence, config);
        let mut retarder = Bound { most: Percent::FULL, reason: Reason::BrakeCap };
        // RET-1: off while ABS works.
        retarder.lower_if(inputs.abs.is(true), Percent::ZERO, Reason::AntiLock);
        BrakeBound {
            floor,
            cap: cap(situation, floor, evidence, config),
            fallback: self.faded(ticks, config),
            retarder_fallback: if self.retarder_lost.due(config.brake_hold, ticks.safety) {
                Percent::ZERO
            } else {
                self.retarder
            },
            // VLC-2b, c, d: friction fills up what the electric part may not give.
            electric: evidence.electric,
            // RSP-1: the brakes fall short of an obligation: the retarder helps, unless ABS is, or may be, at work.
            retarder_obliged: situation.response.brake != Deviation::None
                && floor.most > DecelMs2Q11::ZERO
                && inputs.abs.is(false),
            retarder,
            retarder_decel: config.retarder_decel,
        }
    }

    /// What must be: the greatest obligation.
    fn floor(&self, situation: &Situation, evidence: &Evidence, config: &Config) -> Bound<DecelMs2Q11> {
        let mut floor = Bound { most: DecelMs2Q11::ZERO, reason: Reason::Within };
        floor.raise(situation.mitigation.demand(config), Reason::Mitigation);
        if situation.mitigation.hold {
            floor.raise(config.leave_hold, Reason::SpeedlessHold);
        }
        floor.raise(self.leave, Reason::Leave);
        // TRQ-7: told 0, and still driving: the brakes hold against it. SELF-10: a bus that nobody holds is held.
        if situation.response.torque == Deviation::Persistent {
            floor.raise(config.leave_hold, Reason::ExcessTorque);
        }
        if situation.loose && self.slow {
            floor.raise(config.leave_hold, Reason::Bypass);
        }
        if situation.safe_state {
            // SELF-5d: a₀(v) if the seat is known vacant, 1.35 m/s² below 2 km/h.
            if evidence.seat == SeatView::Vacant {
                let table = evidence.speed.map_or(config.leave_hold, |speed| leave_table(speed.low, config));
                floor.raise(table, Reason::SafeState);
            }
            if self.slow {
                floor.raise(config.leave_hold, Reason::SafeState);
            }
        }
        floor
    }

    /// E2E-2: a lost request holds for a while, then falls to nothing.
    fn faded(&self, ticks: Ticks, config: &Config) -> DecelMs2Q11 {
        if !self.lost.due(config.brake_hold, ticks.safety) {
            return self.total;
        }
        let step = kernel::fallen(config.brake_ramp.raw(), ticks.safety.raw());
        DecelMs2Q11::new(self.total.raw().saturating_sub(step))
    }
}

impl BrakeBound {
    /// BODY-1: brake lamps are due by the total deceleration or an obligation.
    pub(crate) fn lamps_due(&self, braking: DecelMs2Q11, threshold: DecelMs2Q11) -> bool {
        braking >= threshold || self.floor.most > DecelMs2Q11::ZERO
    }

    /// Service brake and retarder together (RET-1).
    #[must_use]
    pub fn total(&self, outputs: &Outputs) -> DecelMs2Q11 {
        let (service, percents) = (outputs.brake.total.raw(), outputs.retarder.torque.raw());
        DecelMs2Q11::new(kernel::together(service, self.retarder_decel.raw(), percents))
    }

    /// RET-1, PHB-1: the retarder torque that the cap leaves beside the service brake.
    #[must_use]
    pub fn retarder_beside(&self, service: DecelMs2Q11) -> Bound<Percent> {
        let room = self.cap.most.raw().saturating_sub(service.raw());
        let mut bound = self.retarder;
        bound.lower(Percent::new(kernel::fits(room, self.retarder_decel.raw())), self.cap.reason);
        bound
    }
}

/// PHB-1, MIT-6d, TRQ-3, TRQ-4, RULE-3b: what may be. Never below the floor, never below what the driver's pedal asks for.
fn cap(situation: &Situation, floor: Bound<DecelMs2Q11>, evidence: &Evidence, config: &Config) -> Bound<DecelMs2Q11> {
    let threat = situation.threat;
    let danger = situation.mitigation.permitted || situation.mitigation.three;
    let hazard = !threat.known || threat.emergency || danger || situation.safe_state;
    let mut cap = Bound { most: config.brake_cap, reason: Reason::BrakeCap };
    // PHB-1: the comfort cap needs its own evidence, a road known to be clear.
    // Whoever stands is thrown by nothing: S1's level holds for a second after standstill (R-ag).
    cap.lower_if(!hazard && !evidence.standstill, config.comfort_cap, Reason::PhantomBraking);
    // TRQ-3, TRQ-4: no comfort braking against the driver's own pedals; mitigation stays permitted.
    let mitigable = hazard || threat.mitigable || situation.mitigation.running();
    match evidence.brake_pedal {
        BrakePedal::Released => {}
        BrakePedal::Pressed(travel) => {
            cap.lower_if(!mitigable, DecelMs2Q11::ZERO, Reason::BrakePedal);
            // Pressed to an unknown depth: nothing bounds what the driver asks for.
            let asked = travel.map_or(config.brake_cap, |travel| pedal_decel(travel, config));
            cap.raise(asked, Reason::BrakePedal);
        }
        BrakePedal::Unknown => cap.lower_if(!mitigable, config.drag_decel, Reason::BrakePedal),
    }
    cap.lower_if(!mitigable && situation.mode == Mode::Suspended, DecelMs2Q11::ZERO, Reason::DriverOverride);
    cap.raise(floor.most, floor.reason);
    cap
}

/// What the driver's brake pedal asks for, with the drag that goes with no pedal at all.
fn pedal_decel(travel: Pedal250, config: &Config) -> DecelMs2Q11 {
    let share = kernel::share_up(config.pedal_decel.raw(), travel.raw(), 250);
    DecelMs2Q11::new(share.saturating_add(config.drag_decel.raw())).min(config.brake_cap)
}
