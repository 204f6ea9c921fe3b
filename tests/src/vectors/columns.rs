//! The columns of the tables, and the digest of a cycle.

use supervisor::wire::Frame;
use supervisor::{Channel, Command, Commands, Outputs, Status};

use super::Made;

/// A column: its name, and what is in it.
pub type Column = (String, i64);

macro_rules! fields {
    ($($name:literal = $value:expr;)*) => { vec![$(($name.to_owned(), i64::from($value))),*] };
}

/// Every field of every channel, in the order of `SupervisorOutputs` in the C header.
#[must_use]
pub fn outputs(of: &Outputs) -> Vec<Column> {
    let Outputs {
        drive,
        target_speed,
        brake,
        retarder,
        gear,
        epb,
        steering,
        contactors,
        auxiliaries,
        warnings,
        body,
        mode,
    } = of;
    fields! {
        "target_speed" = target_speed.raw();
        "brake_total" = brake.total.raw();
        "brake_electric" = brake.electric.raw();
        "steering_angle" = steering.angle.raw();
        "steering_rate" = steering.rate.raw();
        "steering_overlay" = steering.overlay.raw();
        "drive_torque" = drive.torque.raw();
        "drive_active" = drive.active;
        "drive_origin" = drive.origin.code();
        "brake_mode" = brake.mode.code();
        "brake_priority" = brake.priority.code();
        "retarder_torque" = retarder.torque.raw();
        "retarder_mode" = retarder.mode.code();
        "retarder_priority" = retarder.priority.code();
        "gear" = gear.code();
        "epb_request" = epb.request.code();
        "epb_mode" = epb.mode.code();
        "steering_enable" = steering.enable;
        "steering_weight" = steering.weight.raw();
        "steering_bar_limit" = steering.bar_limit.raw();
        "k4" = contactors.k4.code();
        "k1" = contactors.k1.code();
        "air_pump" = auxiliaries.air_pump;
        "power_steering" = auxiliaries.power_steering;
        "dc_dc" = auxiliaries.dc_dc;
        "forward_collision" = warnings.forward_collision;
        "pedestrian" = warnings.pedestrian;
        "seat_leave" = warnings.seat_leave;
        "hazard_flashers" = warnings.hazard_flashers;
        "fault_lamp" = warnings.fault_lamp;
        "notice_lamp" = warnings.notice_lamp;
        "lane_departure" = warnings.lane_departure;
        "speed_limit" = warnings.speed_limit;
        "headway" = warnings.headway;
        "wipers" = body.wipers.code();
        "brake_lamps" = body.brake_lamps;
        "indicator_left" = body.indicator_left;
        "indicator_right" = body.indicator_right;
        "low_beam" = body.low_beam;
        "high_beam" = body.high_beam;
        "horn" = body.horn;
        "mode" = mode.code();
    }
}

fn status(of: &Status) -> Vec<Column> {
    fields! {
        "parked_for_ms" = of.parked_for.raw();
        "faults" = of.faults.bits();
        "occupancy" = of.occupancy.code();
        "parked_by_leave" = of.parked_by_leave;
        "stage" = of.stage.code();
        "level" = of.level.code();
        "mode_granted" = of.mode.code();
        "exit" = of.exit.code();
        "safe_state" = of.safe_state;
        "record" = of.record.code();
    }
}

/// `DriveTorque` as `drive_torque`.
fn snake(name: &str) -> String {
    let mut text = String::new();
    for (at, letter) in name.char_indices() {
        if at > 0 && letter.is_uppercase() {
            text.push('_');
        }
        text.extend(letter.to_lowercase());
    }
    text
}

/// Everything that was decided: five columns for the verdict of each channel, the outputs, the status.
#[must_use]
pub fn decision(made: &Made) -> Vec<Column> {
    let mut columns = Vec::new();
    for (channel, verdict) in made.decision.verdicts.iter() {
        let channel = snake(&format!("{channel:?}"));
        let five = fields! {
            "kind" = verdict.kind.code();
            "reason" = verdict.reason.code();
            "value" = verdict.value;
            "limit" = verdict.limit;
            "margin" = verdict.margin;
        };
        columns.extend(five.into_iter().map(|(name, value)| (format!("{channel}.{name}"), value)));
    }
    columns.extend(outputs(&made.decision.outputs));
    columns.extend(status(&made.decision.status));
    columns
}

/// How a command came: 0 absent, 1 rejected, 2 fresh, 3 held; and the rejection's code, or the age in ms.
fn coming<T>(command: &Command<T>) -> [i64; 2] {
    match command {
        Command::Absent => [0, 0],
        Command::Rejected(why) => [1, i64::from(why.code())],
        Command::Fresh(_) => [2, 0],
        Command::Held(age, _) => [3, i64::from(age.raw())],
    }
}

/// The commands as they reached the vetting: how each came, then every field; of what did not come, the neutral value.
#[must_use]
pub fn commands(of: &Commands) -> Vec<Column> {
    let (mut columns, mut asked) = (Vec::new(), Outputs::NEUTRAL);
    macro_rules! channel {
        ($($field:ident: $channel:ident;)*) => {$(
            let [how, detail] = coming(&of.$field);
            let name = snake(&format!("{:?}", Channel::$channel));
            columns.push((format!("{name}.came"), how));
            columns.push((format!("{name}.detail"), detail));
            if let Command::Fresh(value) | Command::Held(_, value) = of.$field {
                asked.$field = value;
            }
        )*};
    }
    channel! {
        drive: DriveTorque; target_speed: TargetSpeed; brake: ServiceBrake; retarder: Retarder; gear: Gear;
        epb: ParkingBrake; steering: Steering; contactors: Contactors; auxiliaries: Auxiliaries; warnings: Warnings;
        body: Body; mode: Mode;
    }
    columns.extend(outputs(&asked));
    columns
}

/// FNV-1a, 64 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }
}

impl Fnv {
    /// Takes bytes.
    pub fn put(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }
    /// The number.
    #[must_use]
    pub const fn finish(self) -> u64 {
        self.0
    }
}

/// The digest of a cycle: FNV-1a (64 bits) over every column of [`decision`] as four bytes, then over identifier (four
/// bytes) and data (eight bytes) of every frame that was sent; numbers in two's complement, least significant byte first.
#[must_use]
pub fn digest(decision: &[Column], sent: &[Frame]) -> u64 {
    let mut fnv = Fnv::default();
    for (_, value) in decision {
        // Every column is an i32 or a u32: its low four bytes are all of it.
        let [first, second, third, fourth, ..] = value.to_le_bytes();
        fnv.put(&[first, second, third, fourth]);
    }
    for frame in sent {
        fnv.put(&frame.id.to_le_bytes());
        fnv.put(&frame.data);
    }
    fnv.finish()
}
