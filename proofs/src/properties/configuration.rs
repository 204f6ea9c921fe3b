//! Which configurations are accepted (SELF-4): every value in its range, every relation kept, nothing else.

use supervisor_core::{Config, LIMITS, Sealed, Words};

use super::implies;

/// The values of a configuration as they rest, in the order of the table.
fn values(config: &Config) -> [u32; <Config as Words>::COUNT] {
    let mut values = [0; <Config as Words>::COUNT];
    let mut slots = values.iter_mut();
    config.write(&mut |word| {
        if let Some(slot) = slots.next() {
            *slot = word;
        }
    });
    values
}

/// SELF-4b: every value lies in the range that the table of limits gives for its row.
#[must_use]
pub fn self_4_in_range(config: &Config) -> bool {
    let mut values = values(config).into_iter();
    let mut inside = true;
    for limit in LIMITS {
        // A row with negative values is signed, in two's complement of 16 bits; in any other its sign bit is out of range.
        let signed = limit.least < 0;
        for value in values.by_ref().take(limit.count) {
            let value = i64::from(value);
            let value = if signed && value >= 0x8000 { value - 0x1_0000 } else { value };
            inside &= value >= limit.least && value <= limit.greatest;
        }
    }
    inside && values.next().is_none()
}

/// SELF-4c: what must hold between the values, in the words of the requirements.
#[must_use]
pub fn self_4_relations(config: &Config) -> bool {
    let rises = |row: &[u32]| row.windows(2).all(|pair| matches!(pair, [before, after] if before <= after));
    let leave = config.leave_decel.0.map(|decel| u32::from(decel.raw()));
    let level = config.level_decel.0.map(|decel| u32::from(decel.raw()));
    let pedal = config.pedal_map.0.map(|torque| u32::from(torque.raw()));
    let [first_ttc, second_ttc, third_ttc] = config.level_ttc.0;
    let [enter_one, enter_two, _] = config.level_angle.0;
    let [exit_one, exit_two] = config.level_exit_angle.0;
    let settle =
        u64::from(config.requalify.raw()) + u64::from(config.seat_confirm.raw()) + u64::from(config.timeout_200.raw());
    config.cycle_least <= config.cycle_nominal
        && config.cycle_nominal <= config.cycle_greatest
        && config.cycle_greatest < config.timeout_50
        && config.timeout_50 <= config.timeout_100
        && config.timeout_100 <= config.timeout_200
        && config.standstill_speed < config.epb_speed
        && config.epb_speed <= config.leave_hold_speed
        && config.seat_freeze < config.seat_vacant
        && u64::from(config.boot_settle.raw()) > settle
        && rises(&leave)
        && leave.iter().all(|decel| *decel <= u32::from(config.brake_cap.raw()))
        && config.leave_hold <= config.brake_cap
        && rises(&level)
        && level.iter().all(|decel| *decel <= u32::from(config.brake_cap.raw()))
        && rises(&pedal)
        && first_ttc >= second_ttc
        && second_ttc >= third_ttc
        && enter_one <= exit_one
        && enter_two <= exit_two
        && config.comfort_cap <= config.brake_cap
        && config.steering_overlay < config.takeover_torque
        && config.steering_speed_least < config.steering_speed_greatest
}

/// SELF-4b, SELF-4c, SELF-4d: a configuration is sealed exactly when every value is in its range and no relation is broken, and it is
/// sealed as it is.
#[must_use]
pub fn self_4_sealed_exactly(config: &Config) -> bool {
    let sealed = Sealed::new(*config);
    let accepted = sealed.is_ok();
    accepted == (self_4_in_range(config) && config.broken_relation().is_none())
        && implies(accepted, self_4_relations(config))
        && sealed.is_ok_and(|sealed| sealed.intact() == Some(config)) == accepted
}
