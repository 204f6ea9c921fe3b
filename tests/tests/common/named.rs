//! What is in inputs, commands and outputs, by name: a field that is not here breaks these functions.

use super::*;

/// Fields and what is in them, as people read them.
pub type Named = Vec<(&'static str, String)>;

macro_rules! named {
    ($name:ident, $type:ident, $($field:ident),+ $(,)?) => {
        /// Every field, in the order of the specification.
        pub fn $name(of: &$type) -> Named {
            let $type { $($field),+ } = of;
            vec![$((stringify!($field), format!("{:?}", $field))),+]
        }
    };
}

named!(
    inputs,
    Inputs,
    seat,
    wheel_speed,
    motor_speed,
    accelerator,
    brake_pedal,
    brake_switch,
    steering_angle,
    driver_torque,
    selector,
    gear,
    epb,
    epb_switch,
    epb_mode,
    key,
    cruise_switch,
    driver_set,
    k1,
    k4,
    hv_current,
    drive_stopped,
    auxiliaries_stopped,
    drive_limit,
    executed_torque,
    electric_limit,
    friction_limit,
    electric_actual,
    mass,
    axle_pressure,
    deceleration,
    abs,
    asr,
    stability,
    ebs_red,
    ebs_amber,
    xbr_status,
    eps,
    hands_off,
    ads,
    foreign,
    second_sender,
);

macro_rules! channels {
    ($($name:ident: $type:ident),+) => {
        $(named!($name, $type, drive, target_speed, brake, retarder, gear, epb, steering, contactors, auxiliaries, warnings, body, mode);)+
    };
}
channels!(commands: Commands, outputs: Outputs);
