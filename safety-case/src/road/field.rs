//! Every field that a mapping may fill: its name, how it is written, where it goes.

use supervisor::{Cause, Channel, Inputs, Outputs, Signal};

use super::value::{Kind, Value};

/// A field of [`Inputs`].
#[derive(Clone, Copy, Debug)]
pub struct InputField {
    /// Its name in a mapping; the second track of a pair has the suffix `[1]`.
    pub name: &'static str,
    /// How it is written.
    pub kind: fn() -> Kind,
    /// Puts a value, in bits or as a code, into the inputs.
    pub set: fn(&mut Inputs, Signal<i32>),
}

/// A field of a command.
#[derive(Clone, Copy, Debug)]
pub struct CommandField {
    /// The channel it belongs to.
    pub channel: Channel,
    /// Its name in a mapping.
    pub name: &'static str,
    /// How it is written.
    pub kind: fn() -> Kind,
    /// Puts a value, in bits or as a code, into the command; `None` if the field has no such value.
    pub set: fn(&mut Outputs, i32) -> Option<()>,
}

fn signal<T: Value>(raw: Signal<i32>) -> Signal<T> {
    match raw {
        Signal::Known(raw) => T::from_raw(raw).map_or(Signal::Unknown(Cause::OutOfRange), Signal::Known),
        Signal::Unknown(cause) => Signal::Unknown(cause),
    }
}

/// The kind of the signal in `field`, without naming its type again.
macro_rules! kind_of {
    ($whole:ident, $($place:tt)+) => {{
        fn of<T: Value>(_: fn(&$whole) -> Signal<T>) -> Kind {
            T::kind()
        }
        || of(|whole: &$whole| whole.$($place)+)
    }};
}

macro_rules! inputs {
    (@each $($name:literal => [$($place:tt)+])*) => {
        /// Every input, in the order of [`Inputs`].
        pub const INPUTS: &[InputField] = &[$(InputField {
            name: $name,
            kind: kind_of!(Inputs, $($place)+),
            set: |inputs, raw| inputs.$($place)+ = signal(raw),
        },)*];
    };
}

inputs! { @each
    "seat[0]" => [seat[0]]
    "seat[1]" => [seat[1]]
    "wheel_speed" => [wheel_speed]
    "motor_speed" => [motor_speed]
    "accelerator[0]" => [accelerator[0]]
    "accelerator[1]" => [accelerator[1]]
    "brake_pedal[0]" => [brake_pedal[0]]
    "brake_pedal[1]" => [brake_pedal[1]]
    "brake_switch" => [brake_switch]
    "steering_angle" => [steering_angle]
    "driver_torque" => [driver_torque]
    "selector" => [selector]
    "gear" => [gear]
    "epb" => [epb]
    "epb_switch" => [epb_switch]
    "epb_mode" => [epb_mode]
    "key" => [key]
    "cruise_switch" => [cruise_switch]
    "driver_set" => [driver_set]
    "k1" => [k1]
    "k4" => [k4]
    "hv_current" => [hv_current]
    "drive_stopped" => [drive_stopped]
    "auxiliaries_stopped" => [auxiliaries_stopped]
    "drive_limit" => [drive_limit]
    "executed_torque" => [executed_torque]
    "electric_limit" => [electric_limit]
    "friction_limit" => [friction_limit]
    "electric_actual" => [electric_actual]
    "mass" => [mass]
    "axle_pressure[0]" => [axle_pressure[0]]
    "axle_pressure[1]" => [axle_pressure[1]]
    "deceleration" => [deceleration]
    "abs" => [abs]
    "asr" => [asr]
    "stability" => [stability]
    "ebs_red" => [ebs_red]
    "ebs_amber" => [ebs_amber]
    "xbr_status" => [xbr_status]
    "eps" => [eps]
    "hands_off" => [hands_off]
    "ads" => [ads]
}

macro_rules! commands {
    ($($channel:ident: $($name:literal => [$($place:tt)+])+;)*) => {
        /// Every field of every command, channel by channel.
        pub const COMMANDS: &[CommandField] = &[$($(CommandField {
            channel: Channel::$channel,
            name: $name,
            kind: || {
                fn of<T: Value>(_: fn(&Outputs) -> T) -> Kind {
                    T::kind()
                }
                of(|outputs: &Outputs| outputs.$($place)+)
            },
            set: |outputs, raw| {
                outputs.$($place)+ = Value::from_raw(raw)?;
                Some(())
            },
        },)+)*];
    };
}

commands! {
    DriveTorque: "torque" => [drive.torque] "active" => [drive.active] "origin" => [drive.origin];
    TargetSpeed: "speed" => [target_speed];
    ServiceBrake: "total" => [brake.total] "electric" => [brake.electric] "mode" => [brake.mode]
        "priority" => [brake.priority];
    Retarder: "torque" => [retarder.torque] "mode" => [retarder.mode] "priority" => [retarder.priority];
    Gear: "request" => [gear];
    ParkingBrake: "request" => [epb.request] "mode" => [epb.mode];
    Steering: "enable" => [steering.enable] "angle" => [steering.angle] "rate" => [steering.rate]
        "overlay" => [steering.overlay] "weight" => [steering.weight] "bar_limit" => [steering.bar_limit];
    Contactors: "k4" => [contactors.k4] "k1" => [contactors.k1];
    Auxiliaries: "air_pump" => [auxiliaries.air_pump] "power_steering" => [auxiliaries.power_steering]
        "dc_dc" => [auxiliaries.dc_dc];
    Warnings: "forward_collision" => [warnings.forward_collision] "pedestrian" => [warnings.pedestrian]
        "seat_leave" => [warnings.seat_leave] "hazard_flashers" => [warnings.hazard_flashers]
        "fault_lamp" => [warnings.fault_lamp] "notice_lamp" => [warnings.notice_lamp]
        "lane_departure" => [warnings.lane_departure] "speed_limit" => [warnings.speed_limit]
        "headway" => [warnings.headway];
    Body: "wipers" => [body.wipers] "brake_lamps" => [body.brake_lamps] "indicator_left" => [body.indicator_left]
        "indicator_right" => [body.indicator_right] "low_beam" => [body.low_beam] "high_beam" => [body.high_beam]
        "horn" => [body.horn];
    Mode: "request" => [mode];
}

#[cfg(test)]
mod tests {
    use super::{COMMANDS, INPUTS};
    use supervisor::{Channel, Inputs, Outputs, Signal};

    #[test]
    fn every_input_fills_a_place_of_its_own() {
        for field in INPUTS {
            let mut inputs = Inputs::NEVER;
            (field.set)(&mut inputs, Signal::Known(1));
            assert_ne!(inputs, Inputs::NEVER, "{}", field.name);
        }
        let mut inputs = Inputs::NEVER;
        for field in INPUTS {
            (field.set)(&mut inputs, Signal::Known(1));
        }
        assert!(!format!("{inputs:?}").contains("Unknown"), "every field of Inputs can be mapped: {inputs:?}");
    }

    #[test]
    fn every_channel_can_be_mapped() {
        for channel in Channel::ALL {
            assert!(COMMANDS.iter().any(|field| field.channel == *channel), "{channel:?}");
        }
        let mut outputs = Outputs::NEUTRAL;
        for field in COMMANDS {
            assert_eq!((field.set)(&mut outputs, -1_000_000), None, "{}", field.name);
            assert_eq!((field.set)(&mut outputs, 0), Some(()), "{}", field.name);
        }
    }
}
