//! What becomes of a command (CMD-1, CMD-2, CMD-3, CMD-5), against any feasible envelope.

use supervisor_core::{
    AdsState, Body, Bound, BrakeMode, Channel, Command, Commands, ContactorRequest, DecelMs2Q11, DriveTorque,
    DrivingMode, Envelope, EpbMode, EpbRequest, GearRequest, Kind, Millis, Origin, Outputs, Percent, Priority,
    Rejection, Retarder, RetarderMode, ServiceBrake, Steering, Timeouts, Wiper, vet_auxiliaries, vet_body, vet_brake,
    vet_contactors, vet_drive, vet_epb, vet_gear, vet_mode, vet_retarder, vet_steering, vet_target_speed, vet_warnings,
};

use crate::properties::command::{
    brake_instead, cmd_2_lost_is_told, cmd_2_usable_exactly, cmd_5_brake_nearest, cmd_5_drive_nearest,
    cmd_5_envelope_explains, cmd_5_steering_nearest, cmd_5_verdict_is_true,
};

/// CMD-2: any command of any channel is usable exactly when it is fresh, or held within its time-out.
#[kani::proof]
fn cmd_2_usable() {
    let (commands, timeout): (Commands, Millis) = (kani::any(), kani::any());
    assert!(cmd_2_usable_exactly(commands.drive, timeout));
    assert!(cmd_2_usable_exactly(commands.brake, timeout));
    assert!(cmd_2_usable_exactly(commands.gear, timeout));
    assert!(cmd_2_usable_exactly(commands.steering, timeout));
    assert!(cmd_2_usable_exactly(commands.contactors, timeout));
    assert!(cmd_2_usable_exactly(commands.body, timeout));
    kani::cover!(commands.drive.usable(timeout).is_ok(), "usable");
    kani::cover!(commands.drive.usable(timeout).is_err(), "not usable");
    kani::cover!(matches!(commands.gear, Command::Held(age, _) if age == timeout), "held for just its time-out");
}

/// CMD-2e: a command that was refused does what a missing one does, on every channel.
#[kani::proof]
fn cmd_2_rejected_is_absent() {
    let (envelope, why): (Envelope, Rejection) = (kani::any(), kani::any());
    let (mode, gear, braking, torque) = (kani::any(), kani::any(), kani::any(), kani::any());
    let most = kani::any();
    macro_rules! same {
        ($vet:expr) => {{
            let (refused, missing) = ($vet(Command::Rejected(why)), $vet(Command::Absent));
            assert!(refused.0 == missing.0);
        }};
    }
    same!(|command| vet_gear(&envelope, command));
    same!(|command| vet_brake(&envelope, command));
    same!(|command| vet_retarder(&envelope, most, command));
    same!(|command| vet_drive(&envelope, mode, gear, braking, command));
    same!(|command| vet_target_speed(&envelope, mode, command));
    same!(|command| vet_epb(&envelope, command));
    same!(|command| vet_steering(&envelope, command));
    same!(|command| vet_contactors(&envelope, torque, command));
    same!(|command| vet_auxiliaries(&envelope, command));
    same!(|command| vet_warnings(&envelope, command));
    same!(|command| vet_body(&envelope, braking, command));
    same!(|command| vet_mode(&envelope, command));
    kani::cover!(envelope.brake.fallback > DecelMs2Q11::ZERO, "a brake request that holds");
}

/// CMD-2e, CMD-5b: a command that is lost or refused is told as that on every channel, where what stands for it goes out. Drive torque
/// is not among them: what refuses it speaks first.
#[kani::proof]
fn cmd_2_lost_is_told_on_every_channel() {
    let (envelope, commands): (Envelope, Commands) = (kani::any(), kani::any());
    let (mode, braking, torque): (DrivingMode, DecelMs2Q11, Percent) = (kani::any(), kani::any(), kani::any());
    let most: Bound<Percent> = kani::any();
    let neutral = Outputs::NEUTRAL;
    let Timeouts { ms50, ms100, ms200 } = envelope.timeouts;
    macro_rules! told {
        ($field:ident, $timeout:ident, $instead:expr, $vetted:expr) => {{
            let (instead, vetted) = ($instead, $vetted);
            assert!(cmd_2_lost_is_told(commands.$field, $timeout, (instead, neutral.$field), vetted));
            kani::cover!(
                commands.$field.usable($timeout).is_err() && vetted.0 == instead,
                "lost, and nothing asks for more"
            );
        }};
    }
    let retarder = match envelope.brake.retarder_fallback {
        Percent::ZERO => Retarder::NEUTRAL,
        torque => Retarder { torque, mode: RetarderMode::Torque, priority: Priority::Low },
    };
    let body = Body { horn: false, brake_lamps: false, ..envelope.body_fallback };
    told!(gear, ms100, neutral.gear, vet_gear(&envelope, commands.gear));
    told!(brake, ms50, brake_instead(&envelope), vet_brake(&envelope, commands.brake));
    told!(retarder, ms100, retarder, vet_retarder(&envelope, most, commands.retarder));
    told!(target_speed, ms50, neutral.target_speed, vet_target_speed(&envelope, mode, commands.target_speed));
    told!(epb, ms200, neutral.epb, vet_epb(&envelope, commands.epb));
    told!(steering, ms50, neutral.steering, vet_steering(&envelope, commands.steering));
    told!(auxiliaries, ms200, neutral.auxiliaries, vet_auxiliaries(&envelope, commands.auxiliaries));
    told!(warnings, ms200, neutral.warnings, vet_warnings(&envelope, commands.warnings));
    told!(body, ms200, body, vet_body(&envelope, braking, commands.body));
    told!(mode, ms200, neutral.mode, vet_mode(&envelope, commands.mode));
    told!(contactors, ms100, neutral.contactors, vet_contactors(&envelope, torque, commands.contactors));
}

/// CMD-5e: what is limited goes to the nearest value inside its bound.
#[kani::proof]
fn cmd_5_limit_is_nearest() {
    let envelope: Envelope = kani::any();
    kani::assume(envelope.is_feasible());
    let brake: ServiceBrake = kani::any();
    let vetted = vet_brake(&envelope, Command::Fresh(brake));
    assert!(cmd_5_brake_nearest(&envelope, &brake, &vetted.0, kani::any()));
    let (mode, gear, braking): (DrivingMode, GearRequest, DecelMs2Q11) = (kani::any(), kani::any(), kani::any());
    let drive: DriveTorque = kani::any();
    let torque = vet_drive(&envelope, mode, gear, braking, Command::Fresh(drive));
    assert!(cmd_5_drive_nearest(&envelope, mode, gear, braking, &drive, torque, kani::any()));
    let steering: Steering = kani::any();
    let steered = vet_steering(&envelope, Command::Fresh(steering));
    assert!(cmd_5_steering_nearest(&envelope, &steering, steered, &kani::any()));
    kani::cover!(vetted.1.kind == Kind::Limit, "a brake request is limited");
    kani::cover!(torque.1.kind == Kind::Limit && torque.0.torque > Percent::ZERO, "a torque is limited");
    kani::cover!(steered.1.kind == Kind::Limit, "steering is limited");
}

/// CMD-1a, CMD-1c: a code is a value exactly when the table has it: the one channel or value that gives it back.
#[kani::proof]
fn cmd_1_closed_world() {
    let code: u8 = kani::any();
    macro_rules! closed {
        ($($name:ident < $count:literal $(but $gap:literal)?),+) => {$(
            let value = $name::from_code(code);
            assert!(value.is_some() == (code < $count $(&& code != $gap)?));
            assert!(value.is_none_or(|value| value.code() == code));
        )+};
    }
    closed!(
        Channel < 12,
        Rejection < 5,
        Origin < 3,
        BrakeMode < 3,
        Priority < 4,
        RetarderMode < 3 but 1,
        GearRequest < 5,
        EpbRequest < 3,
        EpbMode < 2,
        ContactorRequest < 3,
        Wiper < 4,
        DrivingMode < 2,
        AdsState < 4
    );
    kani::cover!(Channel::from_code(code).is_some(), "a channel");
    kani::cover!(Channel::from_code(code).is_none(), "no channel");
}

/// CMD-3b, CMD-3c, CMD-5a, CMD-5b: on every channel the verdict says what happened, with a reason for all but pass; blocked is
/// neutral.
#[kani::proof]
fn cmd_5_verdicts_are_true() {
    let (envelope, commands): (Envelope, Commands) = (kani::any(), kani::any());
    kani::assume(envelope.is_feasible() && cmd_5_envelope_explains(&envelope));
    let (mode, gear, braking): (DrivingMode, GearRequest, DecelMs2Q11) = (kani::any(), kani::any(), kani::any());
    let (torque, service): (Percent, DecelMs2Q11) = (kani::any(), kani::any());
    let neutral = Outputs::NEUTRAL;
    let Timeouts { ms50, ms100, ms200 } = envelope.timeouts;
    macro_rules! told {
        ($field:ident, $timeout:ident, $vetted:expr) => {{
            let (out, verdict) = $vetted;
            assert!(cmd_5_verdict_is_true(commands.$field, $timeout, out, neutral.$field, verdict));
            kani::cover!(!verdict.passed(), "a verdict with a reason");
        }};
    }
    told!(gear, ms100, vet_gear(&envelope, commands.gear));
    told!(brake, ms50, vet_brake(&envelope, commands.brake));
    told!(retarder, ms100, vet_retarder(&envelope, envelope.brake.retarder_beside(service), commands.retarder));
    told!(drive, ms50, vet_drive(&envelope, mode, gear, braking, commands.drive));
    told!(target_speed, ms50, vet_target_speed(&envelope, mode, commands.target_speed));
    told!(epb, ms200, vet_epb(&envelope, commands.epb));
    told!(steering, ms50, vet_steering(&envelope, commands.steering));
    told!(auxiliaries, ms200, vet_auxiliaries(&envelope, commands.auxiliaries));
    told!(warnings, ms200, vet_warnings(&envelope, commands.warnings));
    told!(body, ms200, vet_body(&envelope, braking, commands.body));
    told!(mode, ms200, vet_mode(&envelope, commands.mode));
    told!(contactors, ms100, vet_contactors(&envelope, torque, commands.contactors));
}
