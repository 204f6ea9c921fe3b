//! What holds in every cycle of every test, judged from inputs, commands and outputs, not from the machines.

use super::*;

/// Follows inputs and outputs from cycle to cycle.
#[derive(Clone, Debug)]
pub struct Oracle {
    last: Option<u32>,
    /// How long both seat sensors have been known occupied.
    occupied: Option<u32>,
    before: Option<Status>,
    torque: u8,
    steering: Steering,
    /// What the gradient has earned and a whole per cent has not used, in 1/1000 %.
    earned: u32,
}

/// S3 table 1: km/h and hundredths of a m/s².
pub const TABLE_1: [(i64, i64); 16] = [
    (0, 0),
    (2, 135),
    (4, 140),
    (6, 145),
    (8, 150),
    (10, 155),
    (15, 160),
    (20, 165),
    (25, 170),
    (30, 173),
    (35, 176),
    (40, 180),
    (45, 185),
    (50, 195),
    (55, 200),
    (60, 220),
];

/// Whether a deceleration reaches a₀(v), linear between the points of table 1, exactly.
pub fn reaches_table_1(decel: DecelMs2Q11, speed: SpeedKmhQ8) -> bool {
    let (raw, decel) = (i64::from(speed.raw()), i64::from(decel.raw()));
    let beyond = decel * 100 >= 220 * 2048;
    TABLE_1
        .windows(2)
        .find_map(|pair| match pair {
            [(from, low), (to, high)] if (from * 256..=to * 256).contains(&raw) => {
                let width = (to - from) * 256;
                Some(decel * 100 * width >= 2048 * (low * width + (high - low) * (raw - from * 256)))
            }
            _ => None,
        })
        .unwrap_or(beyond)
}

/// The two speeds of the inputs, lower and higher, where they agree within max(2 km/h, 5 %).
pub fn speeds(inputs: &Inputs) -> Option<(u16, u16)> {
    let (wheel, motor) = (inputs.wheel_speed.known()?.raw(), inputs.motor_speed.known()?.raw());
    let (low, high) = (wheel.min(motor), wheel.max(motor));
    let difference = u32::from(high - low);
    (difference <= 512 || difference * 20 <= u32::from(high)).then_some((low, high))
}

impl Oracle {
    /// Before the first cycle.
    pub const NEW: Self =
        Self { last: None, occupied: None, before: None, torque: 0, steering: Steering::NEUTRAL, earned: 0 };

    /// After a change of the retained state: only what went out last is still known, and fades from there.
    pub fn anew(&self) -> Self {
        Self { steering: self.steering, ..Self::NEW }
    }

    /// Judges one cycle.
    #[track_caller]
    pub fn judge(&mut self, now: u32, inputs: &Inputs, commands: &Commands, decision: &Decision) {
        let elapsed = self.last.map(|last| now.wrapping_sub(last)).filter(|elapsed| (1..=50).contains(elapsed));
        let both = inputs.seat == [known(Seat::Occupied); 2];
        self.occupied = both.then(|| self.occupied.map_or(0, |before| before + elapsed.unwrap_or(0)));
        let confirmed = self.occupied.is_some_and(|span| span >= 1000);
        let speed = speeds(inputs);
        let standstill = speed.is_some_and(|(_, high)| high <= STANDSTILL.raw());

        seat_and_parking(confirmed, self.before, decision);
        contactors(inputs, standstill, decision);
        self.earned = self.earned % 1_000 + 200 * elapsed.unwrap_or(0);
        torque(confirmed, self.torque, self.earned / 1_000, inputs, decision);
        let automated =
            decision.outputs.drive.origin != Origin::Driver && decision.outputs.drive.torque > Percent::ZERO;
        assert!(!automated || self.before.is_none_or(|before| before.mode != Mode::Manual), "TRQ-2b");
        brake(inputs, speed, decision);
        steering(&self.steering, elapsed, decision);
        rest(standstill, decision);
        split(inputs, decision);
        actuators(inputs, decision);
        parking_at_speed(inputs, commands, speed, decision);
        self.latches(inputs, elapsed, standstill, decision);
        verdicts(commands, decision);
        assert!(decision.envelope.is_feasible(), "SELF-2d, RULE-4a: {:?}", decision.envelope);

        self.last = Some(now);
        self.before = Some(decision.status);
        self.torque = decision.outputs.drive.torque.raw();
        self.steering = decision.outputs.steering;
    }
}

impl Oracle {
    /// SELF-7: what clears a latched fault, and what it keeps closed.
    #[track_caller]
    fn latches(&self, inputs: &Inputs, elapsed: Option<u32>, standstill: bool, decision: &Decision) {
        let Some(before) = self.before else { return };
        let latched = [Faults::CLOCK_LATCHED, Faults::STATE, Faults::FLOW, Faults::CONFIGURATION, Faults::CONTACTOR];
        for fault in latched {
            if before.faults.contains(fault) && !decision.status.faults.contains(fault) {
                assert!(standstill && inputs.epb == known(EpbState::Applied), "SELF-7a: {fault:?}");
                assert!(elapsed.is_some(), "SELF-7b: no clearing in a cycle with a clock fault");
                assert!(matches!(inputs.key, Signal::Known(Key::On | Key::Start)), "SELF-7c: {fault:?}");
                assert_ne!(fault, Faults::CONFIGURATION, "SELF-4: a restart only");
            }
        }
        assert!(!decision.status.faults.contains(Faults::CONTACTOR) || !closes(decision), "SELF-7: nothing closes");
    }
}

/// VLC-2, VLC-3: no electric part without grip, nor beyond its limit.
#[track_caller]
fn split(inputs: &Inputs, decision: &Decision) {
    let electric = decision.outputs.brake.electric;
    if electric > DecelMs2Q11::ZERO {
        let grip = [inputs.abs, inputs.asr, inputs.stability];
        assert_eq!(grip, [known(false); 3], "VLC-2b: electric part with slip control at work or unknown");
        assert!(inputs.electric_limit.known().is_some_and(|limit| electric <= limit), "VLC-2c, VLC-2d");
        assert!(!decision.status.faults.contains(Faults::SPLIT_IMPLAUSIBLE), "VLC-3a");
    }
}

/// RSP-1, TRQ-7, SELF-6, SELF-10: what was found is reported, and no torque goes out against it.
#[track_caller]
fn actuators(inputs: &Inputs, decision: &Decision) {
    let Decision { outputs, status, .. } = decision;
    let foreign = inputs.foreign != Channels::NONE;
    assert!(!foreign || status.faults.contains(Faults::BYPASS), "SELF-10a");
    assert_eq!(inputs.second_sender, status.faults.contains(Faults::SECOND_SENDER), "SELF-10b");
    assert_eq!(inputs.ebs_red == known(true), status.faults.contains(Faults::EBS_RED), "RSP-1m");
    let past_us = status.faults.and(Faults::BYPASS.with(Faults::SECOND_SENDER)) != Faults::NONE;
    let excess = status.faults.contains(Faults::EXCESS_TORQUE);
    assert!(!(past_us || excess) || outputs.drive.torque == Percent::ZERO, "SELF-10c, TRQ-7b");
    assert!(!(past_us || excess) || status.mode == Mode::Manual, "SELF-10c, TRQ-7b: the mode ends");
    let abs = inputs.abs == known(true);
    assert!(!abs || !status.faults.contains(Faults::BRAKE_RESPONSE), "RSP-1l");
    assert!(!abs || outputs.retarder.torque == Percent::ZERO, "RET-1");
    assert_eq!(decision.flow, Flow::COMPLETE, "SELF-6a: every stage ran once and in order");
}

/// EPB-1: above 1.5 km/h the parking brake is applied for the driver's switch, or for brakes that fall short of an
/// obligation.
#[track_caller]
fn parking_at_speed(inputs: &Inputs, commands: &Commands, speed: Option<(u16, u16)>, decision: &Decision) {
    let fast = speed.is_some_and(|(low, _)| low >= 384);
    if !fast || decision.outputs.epb.request != EpbRequest::Apply {
        return;
    }
    let Status { occupancy, level, safe_state, faults, .. } = decision.status;
    let by_switch = inputs.epb_switch == known(EpbSwitch::Apply);
    let obliged = occupancy == Occupancy::Leave || level == Level::Three;
    let unbraked = obliged && !safe_state && inputs.abs == known(false) && faults.contains(Faults::BRAKE_RESPONSE);
    assert!(by_switch || unbraked, "EPB-1a, EPB-1b, EPB-1c: asked {:?}", commands.epb);
}

#[track_caller]
fn seat_and_parking(confirmed: bool, before: Option<Status>, decision: &Decision) {
    let Decision { outputs, status, .. } = decision;
    if outputs.epb.request == EpbRequest::Release {
        assert!(confirmed, "SEAT-5a: a release went out and the seat was not confirmed occupied");
    }
    assert_eq!(status.occupancy == Occupancy::Confirmed, confirmed, "SEAT-0a: confirmed occupied");
    if status.occupancy == Occupancy::Leave {
        assert!(outputs.warnings.seat_leave && outputs.warnings.hazard_flashers, "SEAT-1b, SEAT-1d");
    }
    if let Some(before) = before {
        if before.occupancy == Occupancy::Leave {
            assert!(status.occupancy == Occupancy::Leave || confirmed, "SEAT-1h: leave ends only by confirmed");
        }
        if before.parked_by_leave && !status.parked_by_leave {
            assert_eq!(outputs.epb.request, EpbRequest::Release, "SEAT-4e: only a legal release clears the latch");
        }
    }
}

#[track_caller]
fn contactors(inputs: &Inputs, standstill: bool, decision: &Decision) {
    let Contactors { k4, k1 } = decision.outputs.contactors;
    if k1 == ContactorRequest::Open {
        assert_eq!(inputs.k4, known(Contact::Open), "SEAT-7f: K1 after K4 confirmed open");
        let current = inputs.hv_current.known().map(|current| current.raw().unsigned_abs());
        assert!(
            inputs.drive_stopped == known(true)
                && inputs.auxiliaries_stopped == known(true)
                && current.is_some_and(|current| current <= 20),
            "SEAT-7g: K1 opens only with the loads stopped"
        );
    }
    if k1 == ContactorRequest::Open || k4 == ContactorRequest::Open {
        assert!(standstill, "SEAT-7b, HV-1c: contactors open at standstill only");
    }
    if k4 == ContactorRequest::Open {
        assert_eq!(decision.outputs.drive.torque.raw(), 0, "SEAT-7d: no drive torque");
    }
    if k4 == ContactorRequest::Close {
        assert_eq!(inputs.k1, known(Contact::Closed), "SEAT-8c: K1 before K4");
    }
}

#[track_caller]
fn torque(confirmed: bool, before: u8, earned: u32, inputs: &Inputs, decision: &Decision) {
    let Decision { outputs, status, .. } = decision;
    let torque = outputs.drive.torque.raw();
    if torque == 0 {
        return;
    }
    assert_ne!(status.occupancy, Occupancy::Leave, "SEAT-2a");
    assert_eq!(status.level, Level::None, "MIT-5a");
    assert!(!status.safe_state, "SELF-5c");
    let gear = inputs.gear.known();
    assert!(matches!(gear, Some(Gear::Drive | Gear::Reverse)), "TRQ-6c: {gear:?}");
    assert!(inputs.drive_limit.known().is_some_and(|limit| torque <= limit.raw()), "TRQ-5a");
    let rise = u32::from(torque.saturating_sub(before));
    // Brake-system torque begins at the idle torque, below which it is none (TRQ-5f).
    let idle = u32::from(outputs.drive.origin == Origin::Epbi) * u32::from(Config::DEFAULT.idle_torque.raw());
    let earned = earned.max(idle.saturating_sub(u32::from(before)));
    // TRQ-5f: `EPBi` has no torque below the idle torque (6 %), so its first one is that.
    let begins = outputs.drive.origin == Origin::Epbi && torque == 6;
    assert!(rise <= earned || begins, "TRQ-5b: rise of {rise} %, the gradient allows {earned}");
    if !confirmed {
        assert!(
            speeds(inputs).is_some_and(|(low, _)| low >= 384) && inputs.epb == known(EpbState::Released),
            "SEAT-6b: torque without a confirmed driver"
        );
    }
    if outputs.brake.total > DecelMs2Q11::ZERO || outputs.retarder.torque > Percent::ZERO {
        let slow = speeds(inputs).is_some_and(|(_, high)| high < 512);
        assert!(slow && confirmed && outputs.drive.origin == Origin::Driver, "TRQ-6a: torque against the brake");
    }
    if outputs.drive.origin != Origin::Driver {
        assert!(outputs.drive.active, "TRQ-2a");
        assert!(torque <= 60, "TRQ-2e");
    }
}

#[track_caller]
fn brake(inputs: &Inputs, speed: Option<(u16, u16)>, decision: &Decision) {
    let Decision { outputs, envelope, status, .. } = decision;
    let total = outputs.brake.total;
    assert!(total >= envelope.brake.floor.most, "SELF-2a: below the obligation");
    if status.occupancy == Occupancy::Leave {
        match speed {
            None => assert!(total >= ms2(135), "SEAT-3e"),
            Some((low, _)) => {
                assert!(reaches_table_1(total, kmh_q8(low)), "SEAT-3a, b, c: {total:?} at {low}");
                let held = low >= 512 || inputs.epb == known(EpbState::Applied) || total >= ms2(135);
                assert!(held, "SEAT-3d");
            }
        }
    }
    let demand = match status.level {
        Level::None => 0,
        Level::One => 100,
        Level::Two => 250,
        Level::Three => 500,
    };
    assert!(total >= ms2(demand), "MIT-1b, MIT-2b, MIT-3b: {total:?} at {:?}", status.level);
    let retarder = u32::from(outputs.retarder.torque.raw()) * 3072 / 100;
    assert!(u32::from(total.raw()) + retarder <= 12_288, "PHB-1b: never beyond 6 m/s²");
    assert!(outputs.brake.electric <= total, "VLC-2: the electric part is a part");
    if total >= ms2(70) {
        assert!(outputs.body.brake_lamps, "BODY-1a");
    }
    if envelope.brake.floor.most > DecelMs2Q11::ZERO {
        assert!(outputs.body.brake_lamps, "BODY-1b");
        assert_eq!((outputs.brake.mode, outputs.brake.priority), (BrakeMode::Maximum, Priority::Highest), "CMD-6b");
    }
}

/// While automatic steering acts, neither its angle nor its weight jumps, whatever happens.
#[track_caller]
fn steering(before: &Steering, elapsed: Option<u32>, decision: &Decision) {
    let after = decision.outputs.steering;
    assert!(after.angle.raw().unsigned_abs() <= 7_200, "STR-1a: {after:?}");
    assert!(after.bar_limit.raw() <= 100 && after.weight <= Percent::FULL, "STR-1f, CMD-1b: {after:?}");
    assert!(after.overlay.raw().unsigned_abs() <= 5_120, "STR-1e: {after:?}");
    let faded = u32::from(after.weight.raw().abs_diff(before.weight.raw()));
    assert!(faded <= elapsed.unwrap_or(CYCLE).div_ceil(10), "STR-2c, STR-2d: {before:?} {after:?}");
    let pulled = u32::from(after.overlay.raw().abs_diff(before.overlay.raw()));
    assert!(pulled <= 52 * elapsed.unwrap_or(CYCLE).div_ceil(10), "STR-2c, STR-2d: {before:?} {after:?}");
    if before.weight > Percent::ZERO && after.weight > Percent::ZERO {
        // 400°/s is the greatest rate of all; a rest of the cycles before may add 0.1°.
        let moved = u32::from(after.angle.raw().abs_diff(before.angle.raw()));
        assert!(moved <= 4 * elapsed.unwrap_or(0) + 1, "STR-1c, STR-2f: {before:?} {after:?}");
    }
}

#[track_caller]
fn rest(standstill: bool, decision: &Decision) {
    let Decision { outputs, status, .. } = decision;
    if outputs.gear == GearRequest::Park {
        assert!(standstill, "GEAR-1a: P at standstill only");
    }
    let Auxiliaries { air_pump, power_steering, dc_dc } = outputs.auxiliaries;
    assert!(standstill || (air_pump && power_steering && dc_dc), "AUX-1: not off while rolling");
    if status.safe_state {
        assert!(outputs.warnings.hazard_flashers, "SELF-5h");
        assert_eq!((outputs.gear, outputs.contactors), (GearRequest::Hold, Contactors::NEUTRAL), "SELF-5f");
    }
    if outputs.warnings.hazard_flashers && status.occupancy == Occupancy::Leave {
        assert!(!outputs.body.indicator_left && !outputs.body.indicator_right, "BODY-1d");
    }
    assert_eq!(status.faults == Faults::NONE, status.faults.bits() == 0);
}

/// `Pass` exactly when a usable command went out unchanged, and a reason for everything else.
#[track_caller]
fn verdicts(commands: &Commands, decision: &Decision) {
    let Decision { outputs, verdicts, envelope, .. } = decision;
    let (fast, medium, slow) = (envelope.timeouts.ms50, envelope.timeouts.ms100, envelope.timeouts.ms200);
    let check = |channel: Channel, unchanged: bool| {
        let verdict = verdicts.of(channel);
        assert_eq!(verdict.passed(), unchanged, "CMD-3c, CMD-5a: {channel:?} {verdict:?}");
        assert_eq!(verdict.passed(), verdict.reason == Reason::Within, "CMD-5b: {channel:?} {verdict:?}");
        assert!(
            if verdict.passed() { verdict.margin >= 0 } else { verdict.margin <= 0 },
            "CMD-5d: {channel:?} {verdict:?}"
        );
    };
    check(Channel::DriveTorque, commands.drive.usable(fast) == Ok(outputs.drive));
    check(Channel::TargetSpeed, commands.target_speed.usable(fast) == Ok(outputs.target_speed));
    check(Channel::ServiceBrake, commands.brake.usable(fast) == Ok(outputs.brake));
    check(Channel::Retarder, commands.retarder.usable(medium) == Ok(outputs.retarder));
    check(Channel::Gear, commands.gear.usable(medium) == Ok(outputs.gear));
    check(Channel::ParkingBrake, commands.epb.usable(slow) == Ok(outputs.epb));
    check(Channel::Steering, commands.steering.usable(fast) == Ok(outputs.steering));
    check(Channel::Contactors, commands.contactors.usable(medium) == Ok(outputs.contactors));
    check(Channel::Auxiliaries, commands.auxiliaries.usable(slow) == Ok(outputs.auxiliaries));
    check(Channel::Warnings, commands.warnings.usable(slow) == Ok(outputs.warnings));
    check(Channel::Body, commands.body.usable(slow) == Ok(outputs.body));
    check(Channel::Mode, commands.mode.usable(slow) == Ok(outputs.mode));
}
