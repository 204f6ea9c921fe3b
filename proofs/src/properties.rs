//! The properties, one function each, named by the requirement. `true` means that the requirement holds.

use supervisor_core::{
    BrakeMode, Channel, Clock, Command, Commands, Config, Contact, ContactorBound, ContactorRequest, Contactors,
    DecelMs2Q11, Deviation, DriveTorque, DrivingMode, Envelope, EpbRequest, EpbState, Faults, Flow, Gear, GearRequest,
    HighVoltage, Inputs, Key, LastKey, Millis, Origin, Outputs, Parking, ParkingBrake, PedalChain, Percent, Priority,
    Reason, Record, Response, Restart, Seat, SeatState, ServiceBrake, Stage, State, Steering, Timer, Verdicts,
    Warnings,
};

/// One cycle, seen from outside.
#[derive(Clone, Copy, Debug)]
pub struct Cycle<'a> {
    /// State before.
    pub old: &'a State,
    /// State after `decide`.
    pub new: &'a State,
    /// Time given to the step.
    pub now: Millis,
    /// Inputs.
    pub inputs: &'a Inputs,
    /// Whether the actuators follow.
    pub response: &'a Response,
    /// Envelope.
    pub envelope: &'a Envelope,
    /// Outputs.
    pub outputs: &'a Outputs,
    /// Configuration.
    pub config: &'a Config,
}

/// `a` ⇒ `b`.
const fn implies(a: bool, b: bool) -> bool {
    !a || b
}

fn sits(inputs: &Inputs) -> bool {
    inputs.seat.iter().all(|sensor| sensor.is(Seat::Occupied))
}

impl Cycle<'_> {
    fn speeds(&self) -> Option<(u16, u16)> {
        let (wheel, motor) = (self.inputs.wheel_speed.known()?, self.inputs.motor_speed.known()?);
        Some((wheel.raw().min(motor.raw()), wheel.raw().max(motor.raw())))
    }
    /// Both speeds known below the standstill speed.
    fn standstill(&self) -> bool {
        self.speeds().is_some_and(|(_, high)| high < self.config.standstill_speed.raw())
    }
    /// Standstill, and the speeds agree.
    fn agreed_standstill(&self) -> bool {
        self.standstill()
            && self.speeds().is_some_and(|(low, high)| high.saturating_sub(low) <= self.config.speed_agree.raw())
    }
    fn loads_stopped(&self) -> bool {
        let bound = self.config.stopped_current.raw().unsigned_abs();
        self.inputs.drive_stopped.is(true)
            && self.inputs.auxiliaries_stopped.is(true)
            && self.inputs.hv_current.known().is_some_and(|current| current.raw().unsigned_abs() <= bound)
    }
    fn torque_stopped(&self) -> bool {
        self.inputs
            .executed_torque
            .known()
            .is_some_and(|torque| torque <= self.config.stopped_torque && torque <= Percent::FULL)
    }
    fn releases(&self) -> bool {
        self.outputs.epb.request == EpbRequest::Release
    }

    /// SEAT-5a: the EPB is never released while the seat is not confirmed occupied, in any state, whoever asks.
    #[must_use]
    pub fn seat_5a_no_release_without_confirmed_seat(&self) -> bool {
        implies(self.releases(), sits(self.inputs) && self.new.seat.occupied.reached(self.config.seat_confirm))
    }

    /// SEAT-0a: what *confirmed* rests on: the timer counts no more than the time that passed with both sensors known
    /// occupied in this cycle and the one before, and is lost at once on anything else.
    #[must_use]
    pub fn seat_5_confirmation_counts_real_time(&self) -> bool {
        let (old, new) = (self.old.seat.occupied, self.new.seat.occupied);
        let passed = self.now.raw().wrapping_sub(self.old.clock.last.raw());
        let counted = new.elapsed().raw().saturating_sub(old.elapsed().raw());
        implies(!sits(self.inputs), new == Timer::STOPPED)
            && implies(!old.is_running(), new.elapsed() == Millis::ZERO)
            && implies(self.old.clock.started, counted <= passed)
            && implies(!self.old.clock.started, counted == 0)
    }

    /// SEAT-5b to SEAT-5d: after parked by leave, release also needs K1 and K4 closed, a gear other than N, and the
    /// accelerator pressed after it was seen released under those conditions.
    #[must_use]
    pub fn seat_5_release_after_leave_needs_all(&self) -> bool {
        let inputs = self.inputs;
        let ready = inputs.k1.is(Contact::Closed)
            && inputs.k4.is(Contact::Closed)
            && matches!(inputs.gear.known(), Some(Gear::Drive | Gear::Reverse | Gear::Park));
        let pressed = inputs
            .accelerator
            .iter()
            .all(|track| track.known().is_some_and(|travel| travel > self.config.pedal_pressed));
        let before = self.old.parking.pedal != PedalChain::Waiting;
        implies(self.releases() && self.old.parking.by_leave, ready && pressed && before)
    }

    /// SEAT-5d: the chain says *released* only in a cycle in which the accelerator is known released.
    #[must_use]
    pub fn seat_5_pedal_chain_is_honest(&self) -> bool {
        let released = self
            .inputs
            .accelerator
            .iter()
            .any(|track| track.known().is_some_and(|travel| travel <= self.config.pedal_pressed));
        let (old, new) = (self.old.parking.pedal, self.new.parking.pedal);
        implies(new == PedalChain::Released, released)
            && implies(new == PedalChain::PressedAnew, old != PedalChain::Waiting)
    }

    /// SEAT-4a, b, d: leave below 1.5 km/h with the brake not confirmed: apply, and the latch is set.
    #[must_use]
    pub fn seat_4_apply_in_leave(&self) -> bool {
        let Some((low, high)) = self.speeds() else { return true };
        let agree = u32::from(high - low) <= u32::from(self.config.speed_agree.raw());
        let slow = low < self.config.epb_speed.raw() && agree;
        let due = self.new.seat.leave && slow;
        let applied = self.inputs.epb.is(EpbState::Applied);
        implies(due, self.new.parking.by_leave)
            && implies(due && !applied, self.outputs.epb.request == EpbRequest::Apply)
    }

    /// SEAT-4e: the latch is cleared by nothing in `decide`; only [`record`](supervisor_core::record()) of a release clears it.
    #[must_use]
    pub fn seat_4_latch_holds(&self) -> bool {
        implies(self.old.parking.by_leave, self.new.parking.by_leave)
    }

    /// SEAT-7f, g, HV-1b, HV-1c: K1 is never commanded open before K4 is confirmed open and drive and auxiliaries have stopped.
    #[must_use]
    pub fn seat_7_k1_after_k4(&self) -> bool {
        let opens = self.outputs.contactors.k1 == ContactorRequest::Open;
        implies(opens, self.inputs.k4.is(Contact::Open) && self.loads_stopped() && self.standstill())
    }

    /// SEAT-7b, d, HV-1a, HV-1c: K4 opens only at standstill with no drive torque, executed or sent.
    #[must_use]
    pub fn hv_1_k4_opens_without_load(&self) -> bool {
        let opens = self.outputs.contactors.k4 == ContactorRequest::Open;
        implies(opens, self.standstill() && self.torque_stopped() && self.outputs.drive.torque == Percent::ZERO)
    }

    /// SEAT-7a: ten minutes parked by leave with the guards kept: K4 is commanded open, whatever the controller says.
    #[must_use]
    pub fn seat_7_shutdown_happens(&self) -> bool {
        let due = self.old.high_voltage.stage == Stage::Up
            && self.new.high_voltage.parked.reached(self.config.shutdown_after)
            && !(self.inputs.k4.is(Contact::Open) && self.inputs.k1.is(Contact::Open))
            && self.agreed_standstill()
            && self.inputs.seat.iter().all(|sensor| sensor.is(Seat::Vacant))
            && self.inputs.epb.is(EpbState::Applied)
            && self.torque_stopped()
            && !self.new.is_safe_state();
        implies(due, self.outputs.contactors.k4 == ContactorRequest::Open)
    }

    /// SEAT-7e: in the second stage K1 is commanded open as soon as K4 and the loads are confirmed.
    #[must_use]
    pub fn seat_7_k1_follows(&self) -> bool {
        let due = self.new.high_voltage.stage == Stage::OpeningK1
            && self.inputs.k4.is(Contact::Open)
            && self.loads_stopped()
            && self.agreed_standstill()
            && !self.new.is_safe_state();
        implies(due, self.outputs.contactors.k1 == ContactorRequest::Open)
    }

    /// SEAT-7k: once K4 is commanded the sequence is committed: it ends in *down* only.
    #[must_use]
    pub fn seat_7_committed(&self) -> bool {
        let (old, new) = (self.old.high_voltage.stage, self.new.high_voltage.stage);
        match old {
            Stage::Up => matches!(new, Stage::Up | Stage::OpeningK4),
            Stage::OpeningK4 => matches!(new, Stage::OpeningK4 | Stage::OpeningK1),
            Stage::OpeningK1 => matches!(new, Stage::OpeningK1 | Stage::Down),
            Stage::Down => {
                matches!(new, Stage::Down | Stage::Up)
                    && implies(new == Stage::Up, self.new.high_voltage.restart == Restart::Started)
            }
        }
    }

    /// SEAT-7a, SEAT-11a to SEAT-11c: the ten minutes count no more than real time, and only with the brake known applied.
    #[must_use]
    pub fn seat_11_ten_minutes_are_real(&self) -> bool {
        let (old, new) = (self.old.high_voltage.parked, self.new.high_voltage.parked);
        let passed = self.now.raw().wrapping_sub(self.old.clock.last.raw());
        let counted = new.elapsed().raw().saturating_sub(old.elapsed().raw());
        implies(counted > 0, self.inputs.epb.is(EpbState::Applied) && counted <= passed && !sits(self.inputs))
            && implies(self.inputs.epb.is(EpbState::Released), new == Timer::STOPPED)
            && implies(!self.new.parking.by_leave, new == Timer::STOPPED)
    }

    /// SEAT-8a, c, HV-1d: a contactor closes only after the driver's restart, K1 before K4.
    #[must_use]
    pub fn seat_8_close_needs_restart(&self) -> bool {
        let closes = |request| request == ContactorRequest::Close;
        let out = self.outputs.contactors;
        let restarted = self.new.high_voltage.restart == Restart::Started && sits(self.inputs);
        implies(closes(out.k1) || closes(out.k4), restarted)
            && implies(closes(out.k4), self.inputs.k1.is(Contact::Closed))
            && implies(closes(out.k1), self.inputs.k4.is(Contact::Open))
    }

    /// SEAT-8a, b: the restart goes *idle*, *Off seen*, *started*, each step on its own evidence, and is lost with the seat.
    #[must_use]
    pub fn seat_8_restart_in_order(&self) -> bool {
        let (old, new) = (self.old.high_voltage.restart, self.new.high_voltage.restart);
        let confirmed = sits(self.inputs) && self.new.seat.occupied.reached(self.config.seat_confirm);
        let off = self.inputs.key.is(Key::Off);
        let clean = self.old.boot.pending == supervisor_core::Pending::Clean;
        let edge =
            self.inputs.key.is(Key::Start) && !matches!(self.old.high_voltage.key, LastKey::Start | LastKey::None);
        implies(new != Restart::Idle, confirmed)
            && implies(new == Restart::OffSeen && old != Restart::OffSeen, off || clean)
            && implies(new == Restart::Started && old != Restart::Started, old == Restart::OffSeen && edge)
    }

    /// SEAT-2a, MIT-5a, SELF-5c: no drive torque while leave, a mitigation latch or the safe state runs.
    #[must_use]
    pub fn no_torque_under_obligation(&self) -> bool {
        let obliged = self.new.seat.leave || self.new.mitigation.running() || self.new.is_safe_state();
        implies(obliged, self.outputs.drive.torque == Percent::ZERO)
    }

    /// SEAT-6a to SEAT-6c: parked by leave, confirmed and nobody there: neutral goes out; and no other gear ever with an empty seat
    /// at rest.
    #[must_use]
    pub fn seat_6_neutral(&self) -> bool {
        let confirmed = self.new.seat.occupied.reached(self.config.seat_confirm);
        let parked = self.new.parking.by_leave
            && self.inputs.epb.is(EpbState::Applied)
            && !confirmed
            && !self.new.is_safe_state();
        let at_rest = self.inputs.epb.is(EpbState::Applied)
            || self.speeds().is_some_and(|(low, _)| low < self.config.epb_speed.raw());
        implies(parked, self.outputs.gear == GearRequest::Neutral)
            && implies(
                at_rest && !confirmed,
                matches!(self.outputs.gear, GearRequest::Hold | GearRequest::Neutral)
                    && self.outputs.drive.torque == Percent::ZERO,
            )
    }

    /// SEAT-3a, MIT-1b, MIT-2b, MIT-3b: the service brake is never below the demand of leave and of the set latches.
    #[must_use]
    pub fn brake_never_below_obligation(&self) -> bool {
        let [one, two, three] = self.config.level_decel.0;
        let mitigation = &self.new.mitigation;
        let out = &self.outputs.brake;
        let demand = |set, decel: DecelMs2Q11| implies(set, out.total >= decel);
        let obliged = self.envelope.brake.floor.most > DecelMs2Q11::ZERO;
        demand(mitigation.one, one)
            && demand(mitigation.two, two)
            && demand(mitigation.three, three)
            && demand(self.new.seat.leave, self.new.brake.leave)
            && implies(obliged, out.mode == BrakeMode::Maximum && out.priority == Priority::Highest)
    }

    /// SELF-5c, f, h: the safe state. Torque 0, no release, apply when slow, gear and contactors hold, flashers on.
    #[must_use]
    pub fn self_5_safe_state(&self) -> bool {
        let out = self.outputs;
        implies(
            self.new.is_safe_state(),
            out.drive.torque == Percent::ZERO
                && out.epb.request != EpbRequest::Release
                && out.gear == GearRequest::Hold
                && out.contactors == Contactors::NEUTRAL
                && out.warnings.hazard_flashers
                && out.mode == DrivingMode::Manual,
        )
    }

    /// SELF-5b, SELF-7a, SELF-7b, SELF-7c: latched faults stay, or all go together: at standstill, parking brake applied, after
    /// the fault-free time, by the key seen Off before and On or Start now.
    #[must_use]
    pub fn self_7_latched(&self) -> bool {
        let (old, new) = (&self.old.latches, &self.new.latches);
        let key = self.inputs.key.is(Key::On) || self.inputs.key.is(Key::Start);
        let may_clear = self.standstill()
            && self.inputs.epb.is(EpbState::Applied)
            && new.quiet.reached(self.config.fault_free)
            && old.off_seen
            && key;
        new.faults.contains(old.faults) || (may_clear && new.faults == Faults::NONE)
    }

    /// SELF-7b: the fault-free time counts no more than real time, and only at standstill with the parking brake applied.
    #[must_use]
    pub fn self_7_quiet_counts_real_time(&self) -> bool {
        let (old, new) = (self.old.latches.quiet, self.new.latches.quiet);
        let passed = self.now.raw().wrapping_sub(self.old.clock.last.raw());
        let counted = new.elapsed().raw().saturating_sub(old.elapsed().raw());
        implies(new.is_running(), self.standstill() && self.inputs.epb.is(EpbState::Applied))
            && implies(self.old.clock.started, counted <= passed)
    }

    /// SELF-6b: a cycle that did not run whole and in order leads to the safe state.
    #[must_use]
    pub fn self_6_flow_fault_is_the_safe_state(&self) -> bool {
        implies(self.old.flow != Flow::RECORDED, self.new.is_safe_state())
    }

    /// SELF-7a: with a contactor fault latched nothing closes.
    #[must_use]
    pub fn self_7_contactor_fault_closes_nothing(&self) -> bool {
        let out = &self.outputs.contactors;
        let closes = out.k1 == ContactorRequest::Close || out.k4 == ContactorRequest::Close;
        implies(self.new.latches.faults.contains(Faults::CONTACTOR), !closes)
    }

    /// TRQ-7b: a drive that gives more than it was told is told 0; one that still drives is braked against.
    #[must_use]
    pub fn trq_7_excess_is_answered(&self) -> bool {
        let response = self.response.torque;
        implies(response != Deviation::None, self.outputs.drive.torque == Percent::ZERO)
            && implies(response == Deviation::Persistent, self.outputs.brake.total >= self.config.leave_hold)
    }

    /// SELF-10c: while somebody else commands an actuator there is no automated mode, and the drive is told 0.
    #[must_use]
    pub fn self_10_bypass_is_answered(&self) -> bool {
        implies(
            self.response.bypass,
            self.outputs.mode == DrivingMode::Manual && self.outputs.drive.torque == Percent::ZERO,
        )
    }

    /// RSP-1k, RSP-1l, RSP-1m: brakes that fall short of an obligation are helped by all that the retarder may give,
    /// unless ABS is, or may be, at work.
    #[must_use]
    pub fn rsp_1_retarder_helps(&self) -> bool {
        let bound = &self.envelope.brake;
        let due = self.response.brake != Deviation::None && bound.floor.most > DecelMs2Q11::ZERO;
        bound.retarder_obliged == (due && self.inputs.abs.is(false))
    }

    /// EPB-1b, EPB-1c: in leave or level 3, brakes that still fall short are helped by the parking brake at any speed,
    /// and by that reason never while ABS is, or may be, at work.
    #[must_use]
    pub fn epb_1_parking_brake_helps(&self) -> bool {
        let due = self.response.brake == Deviation::Persistent
            && (self.new.seat.leave || self.new.mitigation.three)
            && self.inputs.abs.is(false)
            && !self.new.is_safe_state();
        implies(due, self.outputs.epb.request == EpbRequest::Apply)
            && implies(self.envelope.epb.obliged == Some(Reason::BrakeResponse), self.inputs.abs.is(false))
    }

    /// VLC-1d: drive torque of the longitudinal mode that is not configured is none.
    #[must_use]
    pub fn vlc_1_mode_not_configured_commands_nothing(&self) -> bool {
        let drive = &self.outputs.drive;
        let by_epbi = self.config.longitudinal_mode.raw() != 0;
        implies(drive.origin == Origin::Adas && by_epbi, drive.torque == Percent::ZERO)
            && implies(drive.origin == Origin::Epbi && !by_epbi, drive.torque == Percent::ZERO)
    }
}

/// SELF-2a: soundness of the service brake: never below the obligation, never above the cap; the electric part within
/// its limit and within the total; an obligation carries its own mode and priority.
#[must_use]
pub fn self_2_brake_sound(envelope: &Envelope, out: &ServiceBrake) -> bool {
    let bound = &envelope.brake;
    let obliged = bound.floor.most > DecelMs2Q11::ZERO;
    out.total >= bound.floor.most
        && out.total <= bound.cap.most
        && out.electric <= out.total
        && out.electric <= bound.electric
        && implies(obliged, out.mode == BrakeMode::Maximum && out.priority == Priority::Highest)
}

/// SELF-2a: soundness of the retarder: with the service brake it stays below the cap.
#[must_use]
pub fn self_2_retarder_sound(envelope: &Envelope, outputs: &Outputs) -> bool {
    let bound = &envelope.brake;
    outputs.retarder.torque <= bound.retarder.most
        && implies(
            outputs.retarder.torque > Percent::ZERO && outputs.brake.total <= bound.cap.most,
            bound.total(outputs) <= bound.cap.most,
        )
}

/// SELF-2a: soundness of the drive torque beside a gear and a total deceleration: within its bound, not against the
/// brake but for hill-hold, and only active.
#[must_use]
pub fn self_2_drive_sound(
    envelope: &Envelope,
    mode: DrivingMode,
    gear: GearRequest,
    braking: DecelMs2Q11,
    drive: &DriveTorque,
) -> bool {
    let by_driver = drive.origin == Origin::Driver;
    let most = match drive.origin {
        Origin::Driver => envelope.torque.driver.most,
        Origin::Adas => envelope.torque.automated.most,
        Origin::Epbi => envelope.torque.epbi.most,
    };
    let flows = drive.torque > Percent::ZERO;
    drive.torque <= most
        && implies(flows && !(envelope.torque.hill_hold && by_driver), braking == DecelMs2Q11::ZERO)
        && implies(flows && !by_driver, drive.active && mode == DrivingMode::Automated)
        && implies(flows && drive.origin == Origin::Epbi, drive.torque >= envelope.torque.idle)
        && implies(flows, !matches!(gear, GearRequest::Neutral | GearRequest::Park))
}

/// SELF-2a: soundness of the steering: what acts is inside the window, the overlay and the fade.
#[must_use]
pub fn self_2_steering_sound(envelope: &Envelope, out: &Steering) -> bool {
    let bound = &envelope.steering;
    implies(
        out.enable,
        out.angle >= bound.angle_least
            && out.angle <= bound.angle_most
            && out.rate <= bound.rate
            && out.overlay >= bound.overlay_least
            && out.overlay <= bound.overlay_most
            && out.weight >= bound.weight_least
            && out.weight <= bound.weight_most
            && out.bar_limit <= bound.bar,
    ) && implies(out.enable && bound.enable.is_err(), out.weight == bound.weight_least)
        && implies(!out.enable, out.weight == Percent::ZERO)
}

/// SELF-2a: soundness of the contactors.
#[must_use]
pub fn self_2_contactors_sound(envelope: &Envelope, out: &Contactors) -> bool {
    let permitted = |request, bound: &ContactorBound| match request {
        ContactorRequest::Hold => true,
        ContactorRequest::Open => bound.open.is_ok(),
        ContactorRequest::Close => bound.close.is_ok(),
    };
    permitted(out.k4, &envelope.k4)
        && permitted(out.k1, &envelope.k1)
        && implies(envelope.k1.obliged, out.k1 == ContactorRequest::Open)
}

/// SELF-2a: soundness of the parking brake: an obliged apply goes out, a release only if permitted.
#[must_use]
pub fn self_2_epb_sound(envelope: &Envelope, out: &ParkingBrake) -> bool {
    match out.request {
        EpbRequest::None => envelope.epb.obliged.is_none(),
        EpbRequest::Apply => envelope.epb.apply.is_ok(),
        EpbRequest::Release => envelope.epb.release.is_ok() && envelope.epb.obliged.is_none(),
    }
}

/// SELF-2a: soundness of the gear.
#[must_use]
pub fn self_2_gear_sound(envelope: &Envelope, out: GearRequest) -> bool {
    let bound = &envelope.gear;
    let permitted = match out {
        GearRequest::Hold => true,
        GearRequest::Neutral => bound.to_neutral.is_ok(),
        GearRequest::Drive => bound.drive.is_ok(),
        GearRequest::Reverse => bound.reverse.is_ok(),
        GearRequest::Park => bound.park.is_ok(),
    };
    permitted && implies(bound.neutral, out == GearRequest::Neutral)
}

/// SELF-2a: soundness of the warnings: what is obliged is on.
#[must_use]
pub fn self_2_warnings_sound(envelope: &Envelope, out: &Warnings) -> bool {
    let bound = &envelope.warnings;
    implies(bound.seat_leave, out.seat_leave)
        && implies(bound.hazard_flashers, out.hazard_flashers)
        && implies(bound.forward_collision, out.forward_collision)
        && implies(bound.pedestrian, out.pedestrian)
        && implies(bound.fault_lamp, out.fault_lamp)
        && implies(bound.notice_lamp, out.notice_lamp)
}

/// SELF-2a: soundness of the whole vector.
#[must_use]
pub fn self_2_sound(envelope: &Envelope, outputs: &Outputs) -> bool {
    self_2_brake_sound(envelope, &outputs.brake)
        && self_2_retarder_sound(envelope, outputs)
        && self_2_drive_sound(envelope, outputs.mode, outputs.gear, envelope.brake.total(outputs), &outputs.drive)
        && self_2_steering_sound(envelope, &outputs.steering)
        && self_2_contactors_sound(envelope, &outputs.contactors)
        && self_2_epb_sound(envelope, &outputs.epb)
        && self_2_gear_sound(envelope, outputs.gear)
        && self_2_warnings_sound(envelope, &outputs.warnings)
        && outputs.target_speed <= envelope.target_speed.most
        && implies(outputs.mode == DrivingMode::Automated, envelope.automated.is_ok())
}

/// Whether a usable command went out unchanged.
#[must_use]
pub fn went_unchanged<T: PartialEq + Copy>(command: Command<T>, timeout: Millis, out: T) -> bool {
    command.usable(timeout).is_ok_and(|value| value == out)
}

/// SELF-2b: transparency: a verdict says *pass* exactly when a usable command went out unchanged.
#[must_use]
pub fn self_2_transparent(envelope: &Envelope, commands: &Commands, outputs: &Outputs, verdicts: &Verdicts) -> bool {
    let Envelope { timeouts, .. } = envelope;
    let same = |channel, unchanged| verdicts.of(channel).passed() == unchanged;
    same(Channel::DriveTorque, went_unchanged(commands.drive, timeouts.ms50, outputs.drive))
        && same(Channel::TargetSpeed, went_unchanged(commands.target_speed, timeouts.ms50, outputs.target_speed))
        && same(Channel::ServiceBrake, went_unchanged(commands.brake, timeouts.ms50, outputs.brake))
        && same(Channel::Retarder, went_unchanged(commands.retarder, timeouts.ms100, outputs.retarder))
        && same(Channel::Gear, went_unchanged(commands.gear, timeouts.ms100, outputs.gear))
        && same(Channel::ParkingBrake, went_unchanged(commands.epb, timeouts.ms200, outputs.epb))
        && same(Channel::Steering, went_unchanged(commands.steering, timeouts.ms50, outputs.steering))
        && same(Channel::Contactors, went_unchanged(commands.contactors, timeouts.ms100, outputs.contactors))
        && same(Channel::Auxiliaries, went_unchanged(commands.auxiliaries, timeouts.ms200, outputs.auxiliaries))
        && same(Channel::Warnings, went_unchanged(commands.warnings, timeouts.ms200, outputs.warnings))
        && same(Channel::Body, went_unchanged(commands.body, timeouts.ms200, outputs.body))
        && same(Channel::Mode, went_unchanged(commands.mode, timeouts.ms200, outputs.mode))
}

/// SELF-9c, d: what boot may leave behind: nothing confirmed, no restart, and every record but *none* parks by leave.
#[must_use]
pub fn self_9_boot(state: &State, record: Option<Record>) -> bool {
    let State { seat: SeatState { occupied, .. }, parking: Parking { by_leave, pedal, .. }, .. } = *state;
    let State { high_voltage: HighVoltage { restart, parked, .. }, clock: Clock { started, .. }, .. } = *state;
    occupied == Timer::STOPPED
        && !started
        && pedal == PedalChain::Waiting
        && restart == Restart::Idle
        && parked == Timer::STOPPED
        && by_leave == matches!(record, Some(Record::Leave | Record::HighVoltageDown))
}
