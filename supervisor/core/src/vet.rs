//! Vet: one command against the envelope. Pure; the same functions for `step` and for a gateway.
//!
//! Channels are vetted in a fixed order, because some are coupled: gear, service brake, retarder, torque, then
//! the rest. Each takes the outputs given so far. Whatever comes in, what goes out is inside the envelope
//! (SELF-2): sound, transparent, idempotent.

use crate::envelope::{Bound, ContactorBound, Envelope, Permission};

use supervisor_terms::kernel;
use supervisor_terms::{
    Auxiliaries, Body, BrakeMode, Command, Commands, ContactorRequest, Contactors, DecelMs2Q11, DriveTorque,
    DrivingMode, EpbMode, EpbRequest, Gear, GearRequest, Kind, Origin, Outputs, ParkingBrake, Percent, Priority,
    Reason, Retarder, ServiceBrake, SpeedKmhQ8, Steering, TorqueNmQ10, Verdict, Verdicts, Warnings,
};

/// SELF-2a, c, RULE-3a, c, e, CMD-3a, b: vets every channel of one cycle.
#[must_use]
pub fn vet(envelope: &Envelope, commands: &Commands) -> (Outputs, Verdicts) {
    let mut out = Outputs::NEUTRAL;
    macro_rules! channel {
        ($field:ident, $vetted:expr) => {{
            let (value, verdict) = $vetted;
            out.$field = value;
            verdict
        }};
    }
    let gear = channel!(gear, vet_gear(envelope, commands.gear));
    let brake = channel!(brake, vet_brake(envelope, commands.brake));
    let beside = envelope.brake.retarder_beside(out.brake.total);
    let retarder = channel!(retarder, vet_retarder(envelope, beside, commands.retarder));
    let braking = envelope.brake.total(&out);
    let mode = channel!(mode, vet_mode(envelope, commands.mode));
    let drive = channel!(drive, vet_drive(envelope, out.mode, out.gear, braking, commands.drive));
    let target_speed = channel!(target_speed, vet_target_speed(envelope, out.mode, commands.target_speed));
    let epb = channel!(epb, vet_epb(envelope, commands.epb));
    let steering = channel!(steering, vet_steering(envelope, commands.steering));
    let contactors = channel!(contactors, vet_contactors(envelope, out.drive.torque, commands.contactors));
    let auxiliaries = channel!(auxiliaries, vet_auxiliaries(envelope, commands.auxiliaries));
    let warnings = channel!(warnings, vet_warnings(envelope, commands.warnings));
    let body = channel!(body, vet_body(envelope, braking, commands.body));
    let list =
        [drive, target_speed, brake, retarder, gear, epb, steering, contactors, auxiliaries, warnings, body, mode];
    (out, Verdicts::new(list))
}

/// SELF-2b, CMD-2e, CMD-3c: the verdict of a channel: `Pass` exactly when a usable command goes out unchanged.
fn judge<T: PartialEq>(
    usable: Result<T, Reason>,
    out: &T,
    neutral: &T,
    pass: Verdict,
    cause: Option<Verdict>,
) -> Verdict {
    let lost = |reason| Verdict::fact(if out == neutral { Kind::Block } else { Kind::Substitute }, reason, 0, 0);
    match usable {
        Ok(value) if value == *out => pass,
        Ok(_) => cause.unwrap_or(Verdict::fact(Kind::Limit, Reason::FieldRange, 0, 0)),
        // What is obliged explains more than that the command is missing.
        Err(reason) => cause.unwrap_or_else(|| lost(reason)),
    }
}

/// GEAR-1, SEAT-6a, SELF-11c.
#[must_use]
pub fn vet_gear(envelope: &Envelope, command: Command<GearRequest>) -> (GearRequest, Verdict) {
    let bound = &envelope.gear;
    let usable = command.usable(envelope.timeouts.ms100);
    let wanted = usable.unwrap_or(GearRequest::Hold);
    let permission: Permission = match wanted {
        GearRequest::Hold => Ok(()),
        GearRequest::Drive => bound.drive,
        GearRequest::Reverse => bound.reverse,
        GearRequest::Neutral => bound.to_neutral,
        GearRequest::Park => bound.park,
    };
    let (out, cause) = match permission {
        _ if bound.neutral => {
            let cause =
                Verdict::fact(Kind::Substitute, Reason::NeutralObliged, wanted.code(), GearRequest::Neutral.code());
            (GearRequest::Neutral, Some(cause))
        }
        Ok(()) => (wanted, None),
        Err(reason) => {
            (GearRequest::Hold, Some(Verdict::fact(Kind::Block, reason, wanted.code(), GearRequest::Hold.code())))
        }
    };
    (out, judge(usable, &out, &GearRequest::Hold, Verdict::PASS, cause))
}

/// SEAT-3, MIT-4, PHB-1, TRQ-3, VLC-2e, SELF-11b: the total, then the split, then mode and priority.
#[must_use]
pub fn vet_brake(envelope: &Envelope, command: Command<ServiceBrake>) -> (ServiceBrake, Verdict) {
    let bound = &envelope.brake;
    let usable = command.usable(envelope.timeouts.ms50);
    let held = ServiceBrake {
        total: bound.fallback,
        mode: BrakeMode::Maximum,
        priority: Priority::Medium,
        ..ServiceBrake::NEUTRAL
    };
    let holds = bound.fallback > DecelMs2Q11::ZERO;
    let wanted = usable.unwrap_or(if holds { held } else { ServiceBrake::NEUTRAL });
    let mut out = wanted;
    let mut cause = None;
    // CMD-6a, b: an obligation carries its own mode and priority: the driver's demand is the floor.
    let obliged = bound.floor.most > DecelMs2Q11::ZERO;
    if obliged && (out.mode != BrakeMode::Maximum || out.priority != Priority::Highest) {
        let mode = out.mode != BrakeMode::Maximum;
        let (value, limit) = if mode { (out.mode.code(), BrakeMode::Maximum.code()) } else { (out.priority.code(), 0) };
        cause = Some(Verdict::fact(Kind::Substitute, Reason::BrakeMode, value, limit));
        (out.mode, out.priority) = (BrakeMode::Maximum, Priority::Highest);
    }
    // VLC-2c, VLC-2e, VLC-2g: a limit of the electric part leaves the total as it is; friction takes over in the same cycle.
    out.electric = wanted.electric.min(bound.electric);
    if out.electric < wanted.electric {
        cause = Some(Verdict::above(Kind::Limit, Reason::ElectricLimit, wanted.electric.wide(), bound.electric.wide()));
    }
    if wanted.total > bound.cap.most {
        out.total = bound.cap.most;
        cause = Some(Verdict::above(Kind::Limit, bound.cap.reason, wanted.total.wide(), bound.cap.most.wide()));
    }
    if wanted.total < bound.floor.most {
        out.total = bound.floor.most;
        // VLC-1b, VLC-2a: what we ask for ourselves is split electric first; friction fills up.
        let (electric, _) = kernel::split(out.total.raw(), bound.electric.raw());
        out.electric = DecelMs2Q11::new(electric);
        cause =
            Some(Verdict::below(Kind::Substitute, bound.floor.reason, wanted.total.wide(), bound.floor.most.wide()));
    }
    if out.electric > out.total {
        cause = cause.or(Some(Verdict::above(Kind::Limit, Reason::FieldRange, out.electric.wide(), out.total.wide())));
        out.electric = out.total;
    }
    let pass = Verdict::above(Kind::Pass, Reason::Within, wanted.total.wide(), bound.cap.most.wide());
    (out, judge(usable, &out, &ServiceBrake::NEUTRAL, pass, cause))
}

/// RET-1, PHB-1, SELF-11g: at most what the cap leaves beside the service brake, [`BrakeBound::retarder_beside`].
///
/// [`BrakeBound::retarder_beside`]: crate::BrakeBound::retarder_beside
#[must_use]
pub fn vet_retarder(envelope: &Envelope, most: Bound<Percent>, command: Command<Retarder>) -> (Retarder, Verdict) {
    let bound = &envelope.brake;
    let usable = command.usable(envelope.timeouts.ms100);
    let fallback = Retarder {
        torque: bound.retarder_fallback,
        mode: supervisor_terms::RetarderMode::Torque,
        priority: Priority::Low,
    };
    let wanted = usable.unwrap_or(if bound.retarder_fallback > Percent::ZERO { fallback } else { Retarder::NEUTRAL });
    let (torque, pass, cause) = limited(wanted.torque, most);
    // RSP-1: obliged, it gives all that the cap leaves.
    let obliged =
        Retarder { torque: most.most, mode: supervisor_terms::RetarderMode::Torque, priority: Priority::Highest };
    let out = if bound.retarder_obliged { obliged } else { Retarder { torque, ..wanted } };
    let helps = Verdict::below(Kind::Substitute, Reason::BrakeResponse, wanted.torque.wide(), most.most.wide());
    let cause = cause.or((out != wanted).then_some(helps));
    (out, judge(usable, &out, &Retarder::NEUTRAL, pass, cause))
}

/// CMD-5e: the nearest value inside the bound.
fn limited(wanted: Percent, bound: Bound<Percent>) -> (Percent, Verdict, Option<Verdict>) {
    let pass = Verdict::above(Kind::Pass, Reason::Within, wanted.wide(), bound.most.wide());
    let cause =
        (wanted > bound.most).then(|| Verdict::above(Kind::Limit, bound.reason, wanted.wide(), bound.most.wide()));
    (wanted.min(bound.most), pass, cause)
}

/// TRQ-1 to TRQ-6, SELF-11a: beside the mode and the gear that go out, and the total deceleration ([`BrakeBound::total`]).
///
/// [`BrakeBound::total`]: crate::BrakeBound::total
#[must_use]
pub fn vet_drive(
    envelope: &Envelope,
    mode: DrivingMode,
    gear: GearRequest,
    braking: DecelMs2Q11,
    command: Command<DriveTorque>,
) -> (DriveTorque, Verdict) {
    let bound = &envelope.torque;
    let usable = command.usable(envelope.timeouts.ms50);
    let wanted = usable.unwrap_or(DriveTorque::NEUTRAL);
    let by_driver = wanted.origin == Origin::Driver;
    let mut most = match wanted.origin {
        Origin::Driver => bound.driver,
        Origin::Adas => bound.automated,
        Origin::Epbi => bound.epbi,
    };
    most.lower_if(!by_driver && mode == DrivingMode::Manual, Percent::ZERO, Reason::ModeNotGranted);
    most.lower_if(!by_driver && !wanted.active, Percent::ZERO, Reason::NotActive);
    // TRQ-6: not against the brake, and not while the gear changes.
    most.lower_if(braking > DecelMs2Q11::ZERO && !(bound.hill_hold && by_driver), Percent::ZERO, Reason::BrakeDemand);
    let steady = match gear {
        GearRequest::Hold => true,
        GearRequest::Drive => envelope.gear.confirmed == Some(Gear::Drive),
        GearRequest::Reverse => envelope.gear.confirmed == Some(Gear::Reverse),
        GearRequest::Neutral | GearRequest::Park => false,
    };
    most.lower_if(!steady, Percent::ZERO, Reason::GearDirection);

    most.lower_if(
        wanted.origin == Origin::Epbi && wanted.torque.min(most.most) < bound.idle,
        Percent::ZERO,
        Reason::IdleTorque,
    );
    let (torque, pass, cause) = limited(wanted.torque, most);
    // A sender that may not have torque does not keep its active flag either; no torque in a granted mode is coasting.
    let coasts = wanted.torque == Percent::ZERO && mode == DrivingMode::Automated;
    let refused = !by_driver && torque == Percent::ZERO && !coasts;
    let out = if refused { DriveTorque::NEUTRAL } else { DriveTorque { torque, ..wanted } };
    let blocked = refused.then(|| match wanted.torque {
        Percent::ZERO => Verdict::fact(Kind::Block, most.reason, u8::from(wanted.active), 0),
        torque => Verdict::above(Kind::Block, most.reason, torque.wide(), most.most.wide()),
    });
    (out, judge(usable, &out, &DriveTorque::NEUTRAL, pass, blocked.filter(|_| usable.is_ok()).or(cause)))
}

/// SPD-1, SELF-11f: beside the mode that goes out.
#[must_use]
pub fn vet_target_speed(envelope: &Envelope, mode: DrivingMode, command: Command<SpeedKmhQ8>) -> (SpeedKmhQ8, Verdict) {
    let mut bound = envelope.target_speed;
    bound.lower_if(mode == DrivingMode::Manual, SpeedKmhQ8::ZERO, Reason::ModeNotGranted);
    let usable = command.usable(envelope.timeouts.ms50);
    let wanted = usable.unwrap_or(SpeedKmhQ8::ZERO);
    let out = wanted.min(bound.most);
    let pass = Verdict::above(Kind::Pass, Reason::Within, wanted.wide(), bound.most.wide());
    let cause = (wanted > out).then(|| Verdict::above(Kind::Limit, bound.reason, wanted.wide(), bound.most.wide()));
    (out, judge(usable, &out, &SpeedKmhQ8::ZERO, pass, cause))
}

/// SEAT-4a, SEAT-5e, SELF-11d: a refused release becomes *none*.
#[must_use]
pub fn vet_epb(envelope: &Envelope, command: Command<ParkingBrake>) -> (ParkingBrake, Verdict) {
    let bound = &envelope.epb;
    let usable = command.usable(envelope.timeouts.ms200);
    let wanted = usable.unwrap_or(ParkingBrake::NEUTRAL);
    let code = wanted.request.code();
    let refuse = |permission: Permission| match permission {
        Ok(()) => (wanted, None),
        Err(reason) => (ParkingBrake::NEUTRAL, Some(Verdict::fact(Kind::Block, reason, code, EpbRequest::None.code()))),
    };
    let (out, cause) = match (bound.obliged, wanted.request) {
        (Some(reason), _) => {
            let apply = ParkingBrake { request: EpbRequest::Apply, mode: EpbMode::Automatic };
            let (value, limit) = if wanted.request == EpbRequest::Apply {
                (wanted.mode.code(), EpbMode::Automatic.code())
            } else {
                (code, EpbRequest::Apply.code())
            };
            (apply, Some(Verdict::fact(Kind::Substitute, reason, value, limit)))
        }
        (None, EpbRequest::None) => (wanted, None),
        (None, EpbRequest::Apply) => refuse(bound.apply),
        (None, EpbRequest::Release) => refuse(bound.release),
    };
    (out, judge(usable, &out, &ParkingBrake::NEUTRAL, Verdict::PASS, cause))
}

/// STR-1, STR-2, SELF-11e.
#[must_use]
pub fn vet_steering(envelope: &Envelope, command: Command<Steering>) -> (Steering, Verdict) {
    let bound = &envelope.steering;
    let usable = command.usable(envelope.timeouts.ms50);
    let wanted = usable.unwrap_or(Steering::NEUTRAL);
    // Not permitted, not asked for, or lost: fade out from where it is.
    let refusal = match (bound.enable, wanted.enable) {
        (Err(reason), _) => Some(reason),
        (Ok(()), false) => Some(Reason::SteeringWeight),
        (Ok(()), true) => None,
    };
    if let Some(reason) = refusal {
        let out = Steering {
            enable: bound.weight_least > Percent::ZERO,
            angle: bound.angle_neutral,
            rate: supervisor_terms::RateDeciDegS::ZERO,
            overlay: bound.overlay_neutral,
            weight: bound.weight_least,
            bar_limit: bound.bar,
        };
        let idle = !out.enable && out.overlay == TorqueNmQ10::ZERO;
        // Nothing acts and nothing is asked for: the command's idle fields are of no effect and pass.
        let in_range = wanted.angle.raw().unsigned_abs() <= bound.range.raw().unsigned_abs()
            && wanted.rate <= bound.rate
            && wanted.bar_limit <= bound.bar;
        let asks_nothing = !wanted.enable && wanted.weight == Percent::ZERO && wanted.overlay == TorqueNmQ10::ZERO;
        if idle && asks_nothing && in_range {
            return (wanted, judge(usable, &wanted, &Steering::NEUTRAL, Verdict::PASS, None));
        }
        let out = if idle { Steering::NEUTRAL } else { out };
        let kind = if idle { Kind::Block } else { Kind::Substitute };
        let cause = Verdict::fact(kind, reason, u8::from(wanted.enable), u8::from(out.enable));
        return (out, judge(usable, &out, &Steering::NEUTRAL, Verdict::PASS, Some(cause)));
    }
    let out = Steering {
        enable: true,
        angle: wanted.angle.max(bound.angle_least).min(bound.angle_most),
        rate: wanted.rate.min(bound.rate),
        overlay: wanted.overlay.max(bound.overlay_least).min(bound.overlay_most),
        weight: wanted.weight.max(bound.weight_least).min(bound.weight_most),
        bar_limit: wanted.bar_limit.min(bound.bar),
    };
    let angle_limit = if wanted.angle < bound.angle_least { bound.angle_least } else { bound.angle_most };
    let limit = |reason, value: i32, limit: i32| {
        let margin = value.abs_diff(limit).cast_signed().saturating_neg();
        Some(Verdict { kind: Kind::Limit, reason, value, limit, margin })
    };
    let cause = if out.angle != wanted.angle {
        limit(Reason::SteeringAngle, wanted.angle.wide(), angle_limit.wide())
    } else if out.rate != wanted.rate {
        limit(Reason::SteeringRate, wanted.rate.wide(), bound.rate.wide())
    } else if out.overlay != wanted.overlay {
        limit(Reason::SteeringOverlay, wanted.overlay.wide(), out.overlay.wide())
    } else if out.weight != wanted.weight {
        limit(Reason::SteeringWeight, wanted.weight.wide(), out.weight.wide())
    } else {
        limit(Reason::BarTorque, wanted.bar_limit.wide(), bound.bar.wide())
    };
    let pass = Verdict::above(Kind::Pass, Reason::Within, wanted.angle.wide(), bound.angle_most.wide());
    (out, judge(usable, &out, &Steering::NEUTRAL, pass, cause))
}

/// SEAT-7f, SEAT-8c, HV-1c, SELF-11h: each contactor against its bound; K4 opens only beside a drive torque of 0.
#[must_use]
pub fn vet_contactors(envelope: &Envelope, torque: Percent, command: Command<Contactors>) -> (Contactors, Verdict) {
    let usable = command.usable(envelope.timeouts.ms100);
    let wanted = usable.unwrap_or(Contactors::NEUTRAL);
    let mut k4 = envelope.k4;
    if torque > Percent::ZERO {
        k4.obliged = false;
        k4.open = k4.open.and(Err(Reason::LoadsNotStopped));
    }
    let (k4_out, k4_cause) = contactor(k4, wanted.k4);
    let (k1_out, k1_cause) = contactor(envelope.k1, wanted.k1);
    let out = Contactors { k4: k4_out, k1: k1_out };
    // CMD-3b: the vector is blocked only if neither moves.
    let mut cause = k4_cause.or(k1_cause);
    if let Some(cause) = cause.as_mut().filter(|cause| cause.kind == Kind::Block && out != Contactors::NEUTRAL) {
        cause.kind = Kind::Limit;
    }
    (out, judge(usable, &out, &Contactors::NEUTRAL, Verdict::PASS, cause))
}

fn contactor(bound: ContactorBound, wanted: ContactorRequest) -> (ContactorRequest, Option<Verdict>) {
    let code = wanted.code();
    let permission = match wanted {
        _ if bound.obliged && wanted != ContactorRequest::Open => {
            let cause = Verdict::fact(Kind::Substitute, Reason::Shutdown, code, ContactorRequest::Open.code());
            return (ContactorRequest::Open, Some(cause));
        }
        ContactorRequest::Hold => Ok(()),
        ContactorRequest::Open => bound.open,
        ContactorRequest::Close => bound.close,
    };
    match permission {
        Ok(()) => (wanted, None),
        Err(reason) => {
            (ContactorRequest::Hold, Some(Verdict::fact(Kind::Block, reason, code, ContactorRequest::Hold.code())))
        }
    }
}

/// AUX-1, SELF-11i: not switched off while rolling.
#[must_use]
pub fn vet_auxiliaries(envelope: &Envelope, command: Command<Auxiliaries>) -> (Auxiliaries, Verdict) {
    let usable = command.usable(envelope.timeouts.ms200);
    let wanted = usable.unwrap_or(Auxiliaries::NEUTRAL);
    let (out, cause) = match envelope.auxiliaries_off {
        Ok(()) => (wanted, None),
        Err(reason) => (Auxiliaries::NEUTRAL, Some(Verdict::fact(Kind::Limit, reason, 0, 1))),
    };
    let cause = cause.filter(|_| out != wanted);
    (out, judge(usable, &out, &Auxiliaries::NEUTRAL, Verdict::PASS, cause))
}

/// FCW-1, PCW-1, SEAT-1, CMD-1e, SELF-11j: on is the safe direction.
#[must_use]
pub fn vet_warnings(envelope: &Envelope, command: Command<Warnings>) -> (Warnings, Verdict) {
    let bound = envelope.warnings;
    let usable = command.usable(envelope.timeouts.ms200);
    let wanted = usable.unwrap_or(Warnings::NEUTRAL);
    let out = Warnings {
        forward_collision: wanted.forward_collision || bound.forward_collision,
        pedestrian: wanted.pedestrian || bound.pedestrian,
        seat_leave: wanted.seat_leave || bound.seat_leave,
        hazard_flashers: wanted.hazard_flashers || bound.hazard_flashers,
        fault_lamp: wanted.fault_lamp || bound.fault_lamp,
        notice_lamp: wanted.notice_lamp || bound.notice_lamp,
        ..wanted
    };
    let cause = (out != wanted).then(|| Verdict::fact(Kind::Substitute, Reason::WarningObliged, 0, 1));
    (out, judge(usable, &out, &Warnings::NEUTRAL, Verdict::PASS, cause))
}

/// BODY-1, SELF-11j: beside the total deceleration.
#[must_use]
pub fn vet_body(envelope: &Envelope, braking: DecelMs2Q11, command: Command<Body>) -> (Body, Verdict) {
    let usable = command.usable(envelope.timeouts.ms200);
    // A lost command keeps what it was (E2E-2), but for the horn.
    let wanted = usable.unwrap_or(Body { horn: false, brake_lamps: false, ..envelope.body_fallback });
    let mut out = wanted;
    let mut cause = None;
    if envelope.warnings.hazard_flashers {
        (out.indicator_left, out.indicator_right) = (false, false);
        cause = (out != wanted).then(|| Verdict::fact(Kind::Limit, Reason::HazardFlashers, 1, 0));
    }
    if envelope.lamps_delayed || envelope.brake.lamps_due(braking, envelope.lamp_decel) {
        cause = if out.brake_lamps { cause } else { Some(Verdict::fact(Kind::Substitute, Reason::BrakeLamps, 0, 1)) };
        out.brake_lamps = true;
    }
    (out, judge(usable, &out, &Body::NEUTRAL, Verdict::PASS, cause))
}

/// MODE-1, SELF-11k.
#[must_use]
pub fn vet_mode(envelope: &Envelope, command: Command<DrivingMode>) -> (DrivingMode, Verdict) {
    let usable = command.usable(envelope.timeouts.ms200);
    let wanted = usable.unwrap_or(DrivingMode::Manual);
    let (out, cause) = match (wanted, envelope.automated) {
        (DrivingMode::Automated, Err(reason)) => {
            (DrivingMode::Manual, Some(Verdict::fact(Kind::Block, reason, wanted.code(), DrivingMode::Manual.code())))
        }
        (DrivingMode::Automated | DrivingMode::Manual, _) => (wanted, None),
    };
    (out, judge(usable, &out, &DrivingMode::Manual, Verdict::PASS, cause))
}
