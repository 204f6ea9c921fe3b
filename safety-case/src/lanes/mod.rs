//! Everything that has a state and is worth seeing over time: verdicts, states, requests, inputs, faults.
//!
//! A lane has one code per cycle; [`snapshot`] takes all codes at once, so that a change is found by comparing two
//! arrays. What a code means is asked only when it is shown.

mod text;

use std::borrow::Cow;
use std::sync::LazyLock;

use supervisor::{
    Channel, Command, Contact, DrivingMode, EpbState, Faults, Gear, GearRequest, Key, Kind, Seat, Signal,
};

use crate::cycle::Cycle;
use crate::words;
use text::{
    NO_REQUEST, UNKNOWN, alarm, contact, contactor, driving_mode, epb, epb_request, exit, fault_tone, gear,
    gear_request, input_tone, key, level, lost_at_zero, mode, note, number_text, occupancy, occupancy_tone, on,
    present, rising, seat, stage, state_tone, trouble_tone, troubles, verdict_text, verdict_tone, yes,
};

pub use text::{cause, verdict};

/// Which part of the picture a lane belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// The verdict of a channel.
    Verdict,
    /// Where the supervisor stands.
    State,
    /// What was asked for, what went out, what is confirmed.
    Actuator,
    /// Warnings that went out.
    Warning,
    /// What is known of an input.
    Input,
    /// A fault of the cycle.
    Fault,
}

/// How a code is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// Nothing to see: not drawn.
    Idle,
    /// As it should be.
    Good,
    /// Worth seeing.
    Note,
    /// Worth attention: limited, requalifying.
    Caution,
    /// The supervisor acts, or something is lost.
    Alarm,
    /// Refused.
    Refusal,
    /// Unknown from the start.
    Void,
}

/// A lane.
#[derive(Clone, Debug)]
pub struct Lane {
    /// Its name in JSON.
    pub key: String,
    /// For people.
    pub title: String,
    /// Where it belongs.
    pub group: Group,
    /// The channel of a verdict lane.
    pub channel: Option<Channel>,
    /// What a code means; verdicts are told by [`Lane::says`].
    text: fn(u16) -> Cow<'static, str>,
    /// How it is shown.
    pub tone: fn(u16) -> Tone,
}

fn known<T: Copy>(signal: Signal<T>, code: impl Fn(T) -> u8) -> u16 {
    match signal {
        Signal::Known(value) => u16::from(code(value)),
        Signal::Unknown(cause) => UNKNOWN + u16::from(cause.code()),
    }
}

fn asked<T: Copy>(command: Command<T>, code: impl Fn(T) -> u8) -> u16 {
    match command {
        Command::Fresh(value) | Command::Held(_, value) => u16::from(code(value)),
        Command::Absent | Command::Rejected(_) => NO_REQUEST,
    }
}

impl Lane {
    /// What a code means.
    #[must_use]
    pub fn says(&self, code: u16) -> Cow<'static, str> {
        match self.channel {
            Some(channel) => verdict_text(channel, code),
            None => (self.text)(code),
        }
    }

    /// A word or two to stand in a bar; empty for what is as it should be.
    #[must_use]
    pub fn label(&self, code: u16) -> Cow<'static, str> {
        match (self.channel, verdict(code)) {
            (Some(_), (Kind::Pass, _)) => Cow::Borrowed(""),
            (Some(_), (_, reason)) => words::reason(reason).0.into(),
            (None, _) if self.key == "dm1" => (self.text)(code),
            (None, _) if self.group == Group::Fault || self.group == Group::Warning => Cow::Borrowed(""),
            (None, _) if cause(code).is_none() && (self.tone)(code) == Tone::Good && self.group == Group::Input => {
                (self.text)(code).replace("known", "").into()
            }
            (None, _) => (self.text)(code),
        }
    }
}

/// A row of the table: group, key, title, text, tone.
type Row = (Group, &'static str, &'static str, fn(u16) -> Cow<'static, str>, fn(u16) -> Tone);

macro_rules! lanes {
    ($($group:ident { $($key:literal, $title:literal, $text:ident, $tone:ident, |$cycle:ident| $code:expr;)* })*) => {
        /// How many lanes there are, without verdicts and faults.
        const PLAIN: usize = [$($($key),*),*].len();
        const ROWS: [Row; PLAIN] = [$($((Group::$group, $key, $title, $text, $tone),)*)*];
        fn plain(cycle: &Cycle<'_>) -> [u16; PLAIN] {
            [$($({ let $cycle = cycle; $code },)*)*]
        }
    };
}

lanes! {
    State {
        "occupancy", "seat", occupancy, occupancy_tone, |c| c.decision.status.occupancy.code().into();
        "parked_by_leave", "parked by leave", yes, alarm, |c| c.decision.status.parked_by_leave.into();
        "stage", "high-voltage shutdown", stage, rising, |c| c.decision.status.stage.code().into();
        "level", "mitigation level", level, rising, |c| c.decision.status.level.code().into();
        "longitudinal_mode", "mode", mode, note, |c| c.decision.status.mode.code().into();
        "exit", "mode ended by", exit, note, |c| c.decision.status.exit.code().into();
        "safe_state", "safe state", yes, alarm, |c| c.decision.status.safe_state.into();
    }
    Actuator {
        "epb_asked", "EPB asked", epb_request, note, |c| asked(c.commands.epb, |epb| epb.request.code());
        "epb_given", "EPB given", epb_request, note, |c| c.decision.outputs.epb.request.code().into();
        "epb_confirmed", "EPB confirmed", epb, state_tone, |c| known(c.inputs.epb, EpbState::code);
        "gear_asked", "gear asked", gear_request, note, |c| asked(c.commands.gear, GearRequest::code);
        "gear_given", "gear given", gear_request, note, |c| c.decision.outputs.gear.code().into();
        "gear_confirmed", "gear confirmed", gear, state_tone, |c| known(c.inputs.gear, Gear::code);
        "k4_asked", "K4 asked", contactor, note, |c| asked(c.commands.contactors, |both| both.k4.code());
        "k4_given", "K4 given", contactor, note, |c| c.decision.outputs.contactors.k4.code().into();
        "k4_confirmed", "K4 confirmed", contact, state_tone, |c| known(c.inputs.k4, Contact::code);
        "k1_asked", "K1 asked", contactor, note, |c| asked(c.commands.contactors, |both| both.k1.code());
        "k1_given", "K1 given", contactor, note, |c| c.decision.outputs.contactors.k1.code().into();
        "k1_confirmed", "K1 confirmed", contact, state_tone, |c| known(c.inputs.k1, Contact::code);
        "mode_asked", "mode asked", driving_mode, note, |c| asked(c.commands.mode, DrivingMode::code);
    }
    Warning {
        "forward_collision", "collision warning", on, rising, |c| c.decision.outputs.warnings.forward_collision.into();
        "pedestrian", "pedestrian warning", on, rising, |c| c.decision.outputs.warnings.pedestrian.into();
        "seat_leave", "seat-leave warning", on, rising, |c| c.decision.outputs.warnings.seat_leave.into();
        "hazard_flashers", "hazard flashers", on, rising, |c| c.decision.outputs.warnings.hazard_flashers.into();
        "fault_lamp", "fault lamp", on, rising, |c| c.decision.outputs.warnings.fault_lamp.into();
        "notice_lamp", "notice lamp", on, rising, |c| c.decision.outputs.warnings.notice_lamp.into();
        "brake_lamps", "brake lamps", on, note, |c| c.decision.outputs.body.brake_lamps.into();
    }
    Input {
        "seat_a", "seat sensor A", seat, state_tone, |c| known(c.inputs.seat[0], Seat::code);
        "seat_b", "seat sensor B", seat, state_tone, |c| known(c.inputs.seat[1], Seat::code);
        "wheel_speed", "wheel speed", number_text, input_tone, |c| known(c.inputs.wheel_speed, |_| 0);
        "motor_speed", "motor speed", number_text, input_tone, |c| known(c.inputs.motor_speed, |_| 0);
        "accelerator_a", "accelerator A", number_text, input_tone, |c| known(c.inputs.accelerator[0], |_| 0);
        "accelerator_b", "accelerator B", number_text, input_tone, |c| known(c.inputs.accelerator[1], |_| 0);
        "brake_pedal_a", "brake pedal A", number_text, input_tone, |c| known(c.inputs.brake_pedal[0], |_| 0);
        "brake_pedal_b", "brake pedal B", number_text, input_tone, |c| known(c.inputs.brake_pedal[1], |_| 0);
        "brake_switch", "brake switch", yes, input_tone, |c| known(c.inputs.brake_switch, u8::from);
        "steering_angle", "steering angle", number_text, input_tone, |c| known(c.inputs.steering_angle, |_| 0);
        "driver_torque", "driver's steering torque", number_text, input_tone, |c| known(c.inputs.driver_torque, |_| 0);
        "selector", "gear selector", gear, state_tone, |c| known(c.inputs.selector, Gear::code);
        "epb_switch", "EPB switch", number_text, input_tone, |c| known(c.inputs.epb_switch, |_| 0);
        "epb_mode", "EPB mode", number_text, input_tone, |c| known(c.inputs.epb_mode, |_| 0);
        "key", "key", key, state_tone, |c| known(c.inputs.key, Key::code);
        "cruise_switch", "cruise switch", yes, input_tone, |c| known(c.inputs.cruise_switch, u8::from);
        "driver_set", "cruise set", yes, input_tone, |c| known(c.inputs.driver_set, u8::from);
        "hv_current", "high-voltage current", number_text, input_tone, |c| known(c.inputs.hv_current, |_| 0);
        "drive_stopped", "drive stopped", yes, input_tone, |c| known(c.inputs.drive_stopped, u8::from);
        "auxiliaries_stopped", "auxiliaries stopped", yes, input_tone, |c| known(c.inputs.auxiliaries_stopped, u8::from);
        "drive_limit", "drive limit", number_text, input_tone, |c| known(c.inputs.drive_limit, |_| 0);
        "executed_torque", "executed torque", number_text, input_tone, |c| known(c.inputs.executed_torque, |_| 0);
        "electric_limit", "electric brake limit", number_text, input_tone, |c| known(c.inputs.electric_limit, |_| 0);
        "friction_limit", "friction brake limit", number_text, input_tone, |c| known(c.inputs.friction_limit, |_| 0);
        "electric_actual", "electric brake given", number_text, input_tone, |c| known(c.inputs.electric_actual, |_| 0);
        "mass", "mass", number_text, input_tone, |c| known(c.inputs.mass, |_| 0);
        "axle_pressure_front", "brake pressure, front axle", number_text, input_tone, |c| known(c.inputs.axle_pressure[0], |_| 0);
        "axle_pressure_rear", "brake pressure, rear axle", number_text, input_tone, |c| known(c.inputs.axle_pressure[1], |_| 0);
        "foreign", "somebody else commands", yes, fault_tone, |c| u16::from(c.inputs.foreign != supervisor::Channels::NONE);
        "second_sender", "second sender of our address", yes, fault_tone, |c| u16::from(c.inputs.second_sender);
        "deceleration", "deceleration", number_text, input_tone, |c| known(c.inputs.deceleration, |_| 0);
        "abs", "ABS", yes, input_tone, |c| known(c.inputs.abs, u8::from);
        "asr", "ASR", yes, input_tone, |c| known(c.inputs.asr, u8::from);
        "stability", "stability control", yes, input_tone, |c| known(c.inputs.stability, u8::from);
        "ebs_red", "EBS red", yes, input_tone, |c| known(c.inputs.ebs_red, u8::from);
        "ebs_amber", "EBS amber", yes, input_tone, |c| known(c.inputs.ebs_amber, u8::from);
        "xbr_status", "external brake status", number_text, input_tone, |c| known(c.inputs.xbr_status, |_| 0);
        "eps", "power steering", number_text, input_tone, |c| known(c.inputs.eps, |_| 0);
        "hands_off", "hands off", yes, input_tone, |c| known(c.inputs.hands_off, u8::from);
        "ads", "automated driving system", number_text, input_tone, |c| known(c.inputs.ads, |_| 0);
        "radar", "radar", present, lost_at_zero, |c| c.scene.radar_known.into();
        "camera", "camera", present, lost_at_zero, |c| c.scene.camera_known.into();
    }
    Fault {
        "dm1", "trouble codes (DM1)", troubles, trouble_tone, |c| c.troubles.0;
    }
}

/// How many lanes there are.
pub const COUNT: usize = CHANNELS + PLAIN + Faults::NAMES.len();
/// The verdict lanes come first, in the order of [`Channel`].
pub const CHANNELS: usize = 12;

/// Every lane: verdicts, plain ones, faults.
pub static LANES: LazyLock<Vec<Lane>> = LazyLock::new(|| {
    let verdicts = Channel::ALL.iter().map(|channel| Lane {
        key: crate::road::snake(channel),
        title: words::channel(*channel).into(),
        group: Group::Verdict,
        channel: Some(*channel),
        text: yes,
        tone: verdict_tone,
    });
    let faults = Faults::NAMES.iter().map(|(_, name)| Lane {
        key: format!("fault_{}", name.to_lowercase()),
        title: words::fault(name),
        group: Group::Fault,
        channel: None,
        text: yes,
        tone: fault_tone,
    });
    let plain = ROWS.iter().map(|(group, key, title, text, tone)| Lane {
        key: (*key).into(),
        title: (*title).into(),
        group: *group,
        channel: None,
        text: *text,
        tone: *tone,
    });
    verdicts.chain(plain).chain(faults).collect()
});

/// The channel of a verdict lane.
#[must_use]
pub fn channel(lane: usize) -> Option<Channel> {
    Channel::ALL.get(lane).copied()
}

/// The codes of every lane in one cycle, in the order of [`LANES`].
#[must_use]
pub fn snapshot(cycle: &Cycle<'_>) -> [u16; COUNT] {
    let mut codes = [0; COUNT];
    let mut slots = codes.iter_mut();
    for ((_, verdict), slot) in cycle.decision.verdicts.iter().zip(slots.by_ref()) {
        *slot = u16::from_le_bytes([verdict.reason.code(), verdict.kind.code()]);
    }
    for (code, slot) in plain(cycle).into_iter().zip(slots.by_ref()) {
        *slot = code;
    }
    let faults = cycle.decision.status.faults;
    for ((fault, _), slot) in Faults::NAMES.iter().zip(slots) {
        *slot = faults.contains(*fault).into();
    }
    codes
}

#[cfg(test)]
mod tests {
    use super::{CHANNELS, COUNT, LANES, snapshot};
    use crate::cycle::Cycle;
    use crate::troubles::Active;
    use supervisor::{Channel, Commands, Inputs, Millis, Record, ResetCause, Scene, Sealed, Supervisor, Threat};

    #[test]
    fn every_lane_has_a_name_of_its_own_and_a_text_for_every_code() -> Result<(), supervisor::ConfigError> {
        assert_eq!((LANES.len(), CHANNELS), (COUNT, Channel::ALL.len()));
        let mut keys: Vec<_> = LANES.iter().map(|lane| lane.key.as_str()).collect();
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), COUNT);
        let mut supervisor = Supervisor::new(Sealed::from_default()?, ResetCause::PowerOn, Some(Record::None));
        let scene = Scene::default();
        let decision = supervisor.step(Millis::new(0), &Inputs::NEVER, &scene, &Commands::ABSENT);
        let cycle = Cycle {
            at: 0,
            inputs: &Inputs::NEVER,
            scene: &scene,
            threat: &Threat::UNKNOWN,
            commands: &Commands::ABSENT,
            decision: &decision,
            troubles: Active::default(),
        };
        for (lane, code) in LANES.iter().zip(snapshot(&cycle)) {
            assert!(!lane.says(code).is_empty() && !lane.says(code).starts_with("code"), "{}", lane.key);
            let _ = (lane.tone)(code);
        }
        Ok(())
    }
}
