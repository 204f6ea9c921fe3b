//! The one table of limits: value, range, unit, source, requirement.
//!
//! Nothing else in the supervisor holds a number of its own. "own" means that no source gives it: a default of
//! ours that the safety case names as an assumption.

use crate::units::{
    AngleDeciDeg, BarTorque50mNm, Count, CurrentDeciA, DecelMs2Q11, DistanceCm, Mass10Kg, Millis, OffsetCm, Pedal250,
    Percent, PercentPerS, Pixel, Pressure5KPa, RateDeciDegS, RotationQ14, SpeedKmhQ8, TorqueNmQ10,
};
use crate::word::permit;
use crate::word::{Word, Words};

/// One row of the table, for people and for documents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limit {
    /// Name of the field of [`Config`].
    pub name: &'static str,
    /// How many values the field holds.
    pub count: usize,
    /// The default of each value (the last one repeats), in `unit`.
    pub default: &'static [i64],
    /// Least admissible value.
    pub least: i64,
    /// Greatest admissible value.
    pub greatest: i64,
    /// Unit of one bit.
    pub unit: &'static str,
    /// Where the default comes from: a passage of S1 to S4, or "own".
    pub source: &'static str,
    /// The requirement it belongs to.
    pub requirement: &'static str,
}

/// A configured value or array of values.
trait Field: Words {
    /// Whether every value lies in the range.
    fn within(&self, least: i64, greatest: i64) -> bool;
}

macro_rules! field {
    ($($name:ident),*) => {$(
        impl Field for $name {
            fn within(&self, least: i64, greatest: i64) -> bool {
                (least..=greatest).contains(&i64::from(self.raw()))
            }
        }
    )*};
}
field!(AngleDeciDeg, BarTorque50mNm, CurrentDeciA, DecelMs2Q11, DistanceCm, Millis, OffsetCm);
field!(Mass10Kg, Pressure5KPa, Count, PercentPerS, Pedal250, Percent, Pixel, RateDeciDegS, RotationQ14);
field!(SpeedKmhQ8, TorqueNmQ10);

/// A row of values at fixed points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Row<T, const N: usize>(pub [T; N]);

impl<T: Word, const N: usize> Words for Row<T, N> {
    const COUNT: usize = N;
    fn write(&self, sink: &mut impl FnMut(u32)) {
        for value in self.0 {
            sink(value.to_word());
        }
    }
    fn read(source: &mut impl FnMut() -> Option<u32>) -> Option<Self> {
        let mut row: [Option<T>; N] = [None; N];
        for slot in &mut row {
            *slot = Some(T::from_word(source()?)?);
        }
        let first = row.first().copied().flatten()?;
        Some(Self(row.map(|value| value.unwrap_or(first))))
    }
}

impl<T: Word + Field, const N: usize> Field for Row<T, N> {
    fn within(&self, least: i64, greatest: i64) -> bool {
        self.0.iter().all(|value| value.within(least, greatest))
    }
}

macro_rules! limits {
    ($($(#[$doc:meta])* $field:ident: $type:ident $(<$inner:ident, $count:literal>)? = [$($default:literal),+], $least:literal ..= $greatest:literal,
        $unit:literal, $source:literal, $requirement:literal;)+) => {
        /// Every limit of the supervisor. Obtained from sealed bytes only ([`Sealed`](crate::Sealed)), or the default.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        pub struct Config { $($(#[$doc])* pub $field: limits!(@type $type $(<$inner, $count>)?),)+ }

        /// The table itself, row by row in the order of [`Config`].
        pub const LIMITS: &[Limit] = &[$(Limit {
            name: stringify!($field), count: <limits!(@type $type $(<$inner, $count>)?) as Words>::COUNT, default: &[$($default),+],
            least: $least, greatest: $greatest, unit: $unit, source: $source, requirement: $requirement,
        }),+];

        impl Config {
            /// The defaults of the table.
            pub const DEFAULT: Self = Self { $($field: limits!(@value $type $(<$inner, $count>)? [$($default),+]),)+ };

            /// The name of the first value outside its range.
            #[must_use]
            pub fn out_of_range(&self) -> Option<&'static str> {
                $(if !self.$field.within($least, $greatest) { return Some(stringify!($field)); })+
                None
            }
        }

        impl Words for Config {
            const COUNT: usize = 0 $(+ <limits!(@type $type $(<$inner, $count>)?) as Words>::COUNT)+;
            fn write(&self, sink: &mut impl FnMut(u32)) {
                $(self.$field.write(sink);)+
            }
            fn read(source: &mut impl FnMut() -> Option<u32>) -> Option<Self> {
                Some(Self { $($field: Words::read(source)?,)+ })
            }
        }
    };
    (@type $type:ident) => { $type };
    (@type Row<$inner:ident, $count:literal>) => { Row<$inner, $count> };
    (@value $type:ident [$default:literal]) => { $type::new($default) };
    (@value Row<$inner:ident, $count:literal> [$($default:literal),+]) => { Row([$($inner::new($default)),+]) };
}

limits! {
    // Time (SELF-3)
    /// Shortest cycle that is not a clock fault.
    cycle_least: Millis = [1], 1..=10, "ms", "own", "SELF-3c";
    /// Longest cycle that is not a clock fault.
    cycle_greatest: Millis = [50], 10..=50, "ms", "own", "SELF-3c";
    /// What the safety timers get in a cycle with a clock fault.
    cycle_nominal: Millis = [10], 1..=50, "ms", "S1 table 2 (10 ms period)", "SELF-3d";
    /// Time-out of what is sent every 50 ms.
    timeout_50: Millis = [125], 75..=180, "ms", "S4 table 5 × 2.5 (own)", "E2E-1g";
    /// Time-out of what is sent every 100 ms.
    timeout_100: Millis = [250], 150..=500, "ms", "S4 table 5 × 2.5 (own)", "E2E-1g";
    /// Time-out of what is sent every 200 ms.
    timeout_200: Millis = [500], 300..=680, "ms", "S4 table 5 × 2.5 (own)", "E2E-1g";
    /// How long a sender must be right again after a gap before it counts.
    requalify: Millis = [1000], 640..=5000, "ms", "own (0.64 s of wrong content seen in a real log)", "E2E-1j";

    // Speed (rule 6)
    /// Greatest difference of the two speeds, absolute.
    speed_agree: SpeedKmhQ8 = [512], 128..=1280, "1/256 km/h", "own", "RULE-6c";
    /// Greatest difference of the two speeds, relative; the greater of both counts.
    speed_agree_percent: Percent = [5], 1..=20, "%", "own", "RULE-6c";
    /// Standstill is below this.
    standstill_speed: SpeedKmhQ8 = [77], 26..=256, "1/256 km/h", "own (0.3 km/h)", "SEAT-7b";

    // Seat and parking brake (S3)
    /// Both sensors occupied for this long is *confirmed occupied*.
    seat_confirm: Millis = [1000], 200..=5000, "ms", "own", "SEAT-0a";
    /// Both sensors vacant for this long is *leave*.
    seat_vacant: Millis = [2000], 500..=5000, "ms", "S3 §2.1", "SEAT-1a";
    /// Unknown sensors freeze the vacancy this long, then reset it.
    seat_freeze: Millis = [500], 100..=580, "ms", "own", "SEAT-1f";
    /// Below this the parking brake is applied in leave, and may be applied otherwise.
    epb_speed: SpeedKmhQ8 = [384], 128..=512, "1/256 km/h", "S3 §2.4 (1.5 km/h)", "SEAT-4a";
    /// An apply that is not confirmed in this time is reported.
    epb_confirm: Millis = [2000], 500..=5000, "ms", "own", "SEAT-4c";
    /// Unknown speed for this long in leave: the parking brake is applied.
    epb_speedless: Millis = [20000], 5000..=60000, "ms", "own", "SEAT-3f";
    /// Deceleration in leave at 0, 2, 4, 6, 8, 10, 15, 20, ... 60 km/h.
    leave_decel: Row<DecelMs2Q11, 16> = [0, 2765, 2868, 2970, 3072, 3175, 3277, 3380, 3482, 3544, 3605, 3687, 3789, 3994, 4096, 4506],
        0..=12288, "1/2048 m/s²", "S3 table 1", "SEAT-3a";
    /// Deceleration that holds the bus: in leave below `leave_hold_speed`, and where speed is unknown.
    leave_hold: DecelMs2Q11 = [2765], 1024..=6144, "1/2048 m/s²", "S3 table 1 at 2 km/h (1.35 m/s²)", "SEAT-3d";
    /// Below this speed `leave_hold` holds until the parking brake is confirmed.
    leave_hold_speed: SpeedKmhQ8 = [512], 256..=1280, "1/256 km/h", "own (S3 table 1, second point)", "SEAT-3d";
    /// After boot, how long to wait for the seat to be known.
    boot_settle: Millis = [4000], 2000..=20000, "ms", "own", "SELF-9d";

    // High voltage (S3 §2.6)
    /// Parked by leave for this long: high voltage is shut down.
    shutdown_after: Millis = [600_000], 60_000..=3_600_000, "ms", "S3 §2.6 (10 min)", "SEAT-7a";
    /// K4 is confirmed open in this time, or it is reported.
    k4_deadline: Millis = [2000], 200..=5000, "ms", "own", "SEAT-7h";
    /// Loads stopped and K1 confirmed open in this time, or it is reported.
    k1_deadline: Millis = [10000], 1000..=50000, "ms", "own", "SEAT-7h";
    /// A current of no more than this is "stopped".
    stopped_current: CurrentDeciA = [20], 0..=100, "0.1 A", "own", "SEAT-7g";
    /// A torque of no more than this is "no drive torque".
    stopped_torque: Percent = [1], 0..=2, "%", "own", "SEAT-7d";

    // Collision (S1 §3.1.2)
    /// Levels 1, 2, 3 enter below (1) or at (2, 3) this time to collision.
    level_ttc: Row<Millis, 3> = [4400, 3600, 2700], 1000..=10000, "ms", "S1 §3.1.2 (3)–(5)", "MIT-1a";
    /// Levels 1, 2, 3 enter while the steering angle is below this.
    level_angle: Row<AngleDeciDeg, 3> = [600, 700, 800], 100..=1800, "0.1°", "S1 §3.1.2 (3)–(5)", "MIT-1a";
    /// Levels 1 and 2 end at once when the driver steers beyond this.
    level_exit_angle: Row<AngleDeciDeg, 2> = [800, 900], 100..=1800, "0.1°", "S1 §3.1.2 (3), (4)", "MIT-4e";
    /// Deceleration of levels 1, 2, 3.
    level_decel: Row<DecelMs2Q11, 3> = [2048, 5120, 10240], 1024..=12288, "1/2048 m/s²", "S1 §3.1.2 (3)–(5)", "MIT-1b";
    /// Levels 1 and 2 end when nothing has been closing for this long.
    level_gone: Millis = [500], 100..=2000, "ms", "own", "MIT-4d";
    /// All levels end this long after continuous standstill.
    level_standstill: Millis = [1000], 500..=5000, "ms", "S1 §3.1.2 (5)", "MIT-4h";
    /// Unknown speed for this long ends a level; `leave_hold` follows.
    level_speedless: Millis = [10000], 2000..=30000, "ms", "own", "MIT-7b";
    /// Nothing is obliged below this own speed.
    level_least_speed: SpeedKmhQ8 = [2560], 512..=5120, "1/256 km/h", "own (10 km/h)", "MIT-6b";
    /// Nothing is obliged where less deceleration than this is required. 0: the times to collision alone, as S1 says it.
    level_least_required: DecelMs2Q11 = [0], 0..=5120, "1/2048 m/s²", "own (0: S1's letter, R-ah)", "MIT-6e";
    /// Forward-collision warning: on below, off above.
    forward_ttc: Row<Millis, 2> = [4000, 4500], 1000..=10000, "ms", "S1 §3.1.2 (1)", "FCW-1a";
    /// Forward-collision warning: lateral offset.
    forward_offset: OffsetCm = [180], 100..=400, "cm", "S1 §3.1.2 (1), reading a", "FCW-1a";
    /// Pedestrian-collision warning: on below, off above.
    pedestrian_ttc: Row<Millis, 2> = [4200, 4500], 1000..=10000, "ms", "S1 §3.1.2 (2)", "PCW-1a";
    /// Pedestrian-collision warning: lateral offset.
    pedestrian_offset: OffsetCm = [200], 100..=400, "cm", "S1 §3.1.2 (2), reading a", "PCW-1a";
    /// Half-width of the corridor, for the point that the radar gives of an object.
    corridor: OffsetCm = [180], 130..=250, "cm", "own (where S1 §3.1.2 (1) warns of a car; half of 2.55 m and half a metre of a car)", "FUS-3e";
    /// A measured deceleration beyond this is not plausible.
    decel_plausible: DecelMs2Q11 = [20480], 12288..=40960, "1/2048 m/s²", "own (10 m/s²)", "MIT-6c";
    /// Gap that shall remain.
    gap_margin: DistanceCm = [100], 0..=500, "cm", "own", "MIT-6c";
    /// The same radar object in this many updates is consistent.
    consistent_updates: Count = [3], 2..=10, "updates", "own", "FUS-3c";
    /// Object data older than this are lost.
    object_age: Millis = [250], 50..=500, "ms", "own", "MIT-7a";
    /// An object nearer in time than this permits the full cap.
    emergency_ttc: Millis = [3200], 2700..=5000, "ms", "own", "PHB-1b";
    /// An object nearer in time than this permits mitigation of any level.
    mitigable_ttc: Millis = [6000], 4400..=20000, "ms", "own", "TRQ-3b";
    /// Second opinion: a deceleration needed beyond this is severe.
    severe_decel: DecelMs2Q11 = [7168], 2048..=12288, "1/2048 m/s²", "own (the comfort cap)", "MIT-8a";

    // Fusion (S1 §3.1.1): calibration of radar and camera. Radar axes: ahead, left, up; camera axes: right, down, ahead.
    /// Height of the radar above the road.
    radar_height: DistanceCm = [50], 10..=300, "cm", "own", "FUS-2a";
    /// Rotation from radar to camera axes, row by row.
    camera_rotation: Row<RotationQ14, 9> = [0, -16384, 0, 0, 0, -16384, 16384, 0, 0], -16384..=16384, "1/16384", "own (no yaw, pitch, roll)", "FUS-2a";
    /// The radar as the camera sees it: how far to the right, below and ahead of it.
    camera_translation: Row<OffsetCm, 3> = [0, 120, 50], -1000..=1000, "cm", "own (behind the windscreen)", "FUS-2a";
    /// Focal length in the columns and in the rows of the image.
    focal_length: Row<Pixel, 2> = [1200, 1200], 200..=4096, "px", "own (56° by 33°)", "FUS-2a";
    /// Where the camera's axis meets the image: column, row.
    principal_point: Row<Pixel, 2> = [640, 360], 0..=4095, "px", "own (centre)", "FUS-2a";
    /// Columns and rows of the image.
    image_size: Row<Pixel, 2> = [1280, 720], 64..=4096, "px", "own (720p)", "FUS-2a";
    /// Width and height that an object is taken to have.
    object_size: Row<DistanceCm, 2> = [200, 200], 20..=500, "cm", "own (between a car and a bus: 67 % and 49 % of union)", "FUS-2a";
    /// Width and height that a pedestrian is taken to have.
    pedestrian_size: Row<DistanceCm, 2> = [50, 170], 20..=300, "cm", "own", "FUS-2a";
    /// Beyond this depth nothing matches: a car is 14 pixels wide.
    match_range: DistanceCm = [15000], 1000..=32767, "cm", "own", "FUS-3a";
    /// Boxes match when their intersection is more than this much of their union.
    match_iou: Percent = [30], 5..=95, "%", "own (true sizes differ: a bus straight ahead has 49 %)", "FUS-3a";

    // Braking (PHB-1, TRQ-3, E2E-2, BODY-1)
    /// Greatest total deceleration without a hazard: standing passengers.
    comfort_cap: DecelMs2Q11 = [7168], 2048..=12288, "1/2048 m/s²", "own (3.5 m/s²)", "PHB-1a";
    /// Greatest total deceleration.
    brake_cap: DecelMs2Q11 = [12288], 10240..=20480, "1/2048 m/s²", "S4 table 3 (6 m/s²), reading j", "PHB-1b";
    /// Deceleration that goes with the full brake pedal.
    pedal_decel: DecelMs2Q11 = [12288], 6144..=20480, "1/2048 m/s²", "own (6 m/s²)", "PHB-1c";
    /// Deceleration that goes with no pedal at all: drag.
    drag_decel: DecelMs2Q11 = [2048], 0..=4096, "1/2048 m/s²", "own (1 m/s²)", "TRQ-3b";
    /// Deceleration of the retarder for each per cent.
    retarder_decel: DecelMs2Q11 = [31], 0..=82, "1/2048 m/s² per %", "own (1.5 m/s² at 100 %)", "RET-1a";
    /// A lost brake request holds this long.
    brake_hold: Millis = [500], 0..=1000, "ms", "own", "E2E-2c";
    /// Then it falls by this much per second.
    brake_ramp: DecelMs2Q11 = [4096], 1024..=20480, "1/2048 m/s² per s", "own (2 m/s³)", "E2E-2d";
    /// Brake lamps are on from this total deceleration.
    lamp_decel: DecelMs2Q11 = [1433], 512..=2662, "1/2048 m/s²", "own (0.7 m/s²)", "BODY-1a";
    /// Brake lamps go off after this delay.
    lamp_delay: Millis = [300], 0..=1000, "ms", "own", "BODY-1c";

    // Drive (S2)
    /// Drive torque that goes with 0, 10, ... 100 % accelerator.
    pedal_map: Row<Percent, 11> = [0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100], 0..=100, "%", "own", "TRQ-1a";
    /// Tolerance of the map.
    pedal_tolerance: Percent = [5], 0..=20, "%", "own", "TRQ-1a";
    /// Greatest difference of two pedal tracks.
    pedal_agree: Pedal250 = [13], 2..=50, "0.4 %", "own (5 %)", "TRQ-1b";
    /// A pedal beyond this is pressed.
    pedal_pressed: Pedal250 = [10], 3..=50, "0.4 %", "own (4 %)", "TRQ-1c";
    /// MinTorq: without positive ADAS torque, an accelerator beyond this overrides.
    override_least: Pedal250 = [20], 3..=100, "0.4 %", "S2 §2 2) names it, value own (8 %)", "TRQ-4a";
    /// Offset: with positive ADAS torque, an accelerator beyond torque + this overrides.
    override_offset: Percent = [10], 1..=50, "%", "S2 §2 2) names it, value own", "TRQ-4b";
    /// Greatest torque of ADAS or EPBi: our acceleration bound.
    automated_torque: Percent = [60], 10..=100, "%", "own", "TRQ-2e";
    /// Idle torque: EPBi torque below it is none.
    idle_torque: Percent = [6], 0..=20, "%", "S2 §1 names it, S4 table 2 (6 %)", "TRQ-5f";
    /// Torque may rise by this much per second.
    torque_ramp: PercentPerS = [200], 100..=1000, "% per s", "own", "TRQ-5b";
    /// Hill-hold: torque against the brake for at most this long.
    hill_hold: Millis = [1000], 0..=2000, "ms", "own", "TRQ-6b";
    /// Hill-hold: below this speed.
    hill_hold_speed: SpeedKmhQ8 = [512], 77..=1280, "1/256 km/h", "own (2 km/h)", "TRQ-6b";
    /// Greatest target speed.
    speed_limit: SpeedKmhQ8 = [15360], 2560..=25600, "1/256 km/h", "S3 §2.3 (60 km/h)", "SPD-1a";

    /// A mode that ended for a reason that the driver did not give is noticed this long.
    notice_time: Millis = [5000], 1000..=30000, "ms", "own", "MODE-1f";

    // Steering (S4 6.3)
    /// Steering-wheel angles lie within this, either way.
    steering_range: AngleDeciDeg = [7200], 7200..=7200, "0.1°", "S4 table 4 (±720°)", "STR-1a";
    /// Greatest angle up to 10, 20, 30, 40, 60, 80 km/h, and above: about 3 m/s² lateral.
    steering_angle: Row<AngleDeciDeg, 7> = [7200, 6670, 2970, 1670, 740, 410, 260], 0..=7200, "0.1°", "S4 table 4 (±720°), own", "STR-1b";
    /// Greatest rate up to the same speeds.
    steering_rate: Row<RateDeciDegS, 7> = [4000, 3200, 1600, 800, 400, 200, 130], 100..=8000, "0.1°/s", "S4 table 4 (320°/s), own", "STR-1c";
    /// Greatest deviation of the target from the measured angle.
    steering_deviation: AngleDeciDeg = [450], 100..=1800, "0.1°", "own", "STR-1d";
    /// Greatest overlay torque.
    steering_overlay: TorqueNmQ10 = [5120], 0..=6143, "1/1024 Nm", "own (5 Nm, below the takeover torque)", "STR-1e";
    /// Greatest limit of the overlaid bar torque.
    steering_bar: BarTorque50mNm = [100], 0..=119, "0.05 Nm", "own (5 Nm)", "STR-1f";
    /// A driver's torque beyond this takes over.
    takeover_torque: TorqueNmQ10 = [6144], 2048..=10240, "1/1024 Nm", "S4 6.3.4 (6 Nm)", "STR-2a";
    /// After this long.
    takeover_time: Millis = [300], 50..=580, "ms", "S4 6.3.4", "STR-2a";
    /// The steering torque fades in and out by this much per second.
    steering_fade: PercentPerS = [100], 100..=1000, "% per s", "own", "STR-2c";
    /// Automatic steering, lowest speed.
    steering_speed_least: SpeedKmhQ8 = [0], 0..=25600, "1/256 km/h", "S4 6.3.2, own", "STR-2e";
    /// Automatic steering, highest speed.
    steering_speed_greatest: SpeedKmhQ8 = [15360], 2560..=65535, "1/256 km/h", "S4 6.3.2, own (60 km/h)", "STR-2e";

    // Longitudinal mode and brake split (S2 §1, S3 §2.3)
    /// Which longitudinal mode the bus has: 0 is ADAS-VLC, 1 is EPBi-VLC.
    longitudinal_mode: Count = [0], 0..=1, "code", "S2 §1", "VLC-1d";
    /// Least and greatest plausible mass.
    mass_range: Row<Mass10Kg, 2> = [600, 2000], 100..=6000, "10 kg", "own (6 to 20 t)", "VLC-3a";
    /// Greatest plausible brake pressure of an axle.
    axle_pressure_most: Pressure5KPa = [220], 100..=250, "5 kPa", "own (1100 kPa)", "VLC-3a";
    /// The electric deceleration may exceed its own limit by this much before it is not plausible.
    electric_excess: DecelMs2Q11 = [1024], 0..=4096, "1/2048 m/s²", "own (0.5 m/s²)", "VLC-3a";

    // Response of the actuators (S4 tables 2 to 4)
    /// Drive torque: from its first response to 95 %, and from the command, dead time included.
    response_drive: Millis = [500], 200..=2000, "ms", "S4 table 2", "RSP-1a";
    /// Brake: from its first response to 95 %; in level 3; from the command, dead time included.
    response_brake: Row<Millis, 3> = [700, 500, 1000], 200..=3000, "ms", "S4 table 3, reading i", "RSP-1b";
    /// Then the retarder has this long before the parking brake follows.
    response_retarder: Millis = [500], 100..=2000, "ms", "own", "EPB-1b";
    /// Gearbox.
    response_gear: Millis = [800], 200..=2000, "ms", "S4 6.1.6", "RSP-1d";
    /// Steering: first response, and the target, from the command.
    response_steering: Row<Millis, 2> = [100, 500], 50..=2000, "ms", "S4 table 4", "RSP-1e";
    /// Dead time, and age of the feedback, that each of these is given on top.
    response_age: Millis = [100], 0..=200, "ms", "own (feedback every 50 ms, link 10 ms, two cycles, rest)", "RSP-1f";
    /// Greatest steady-state error and overshoot.
    response_error: Percent = [15], 5..=50, "%", "S4 tables 2, 3, reading i", "RSP-1i";
    /// Overshoot and excess are reported after this long.
    response_overshoot: Millis = [500], 100..=2000, "ms", "own", "RSP-1j";
    /// Brakes are compared above this speed only.
    response_speed: SpeedKmhQ8 = [1280], 512..=5120, "1/256 km/h", "own (5 km/h)", "RSP-1b";
    /// Brakes are compared from this deceleration on.
    response_decel: DecelMs2Q11 = [1024], 205..=2765, "1/2048 m/s²", "own (0.5 m/s²)", "RSP-1b";
    /// Brakes may give this much more than they were told: drag, slope.
    response_drag: DecelMs2Q11 = [2048], 0..=4096, "1/2048 m/s²", "own (1 m/s²)", "RSP-1j";
    /// The steering may be off its target by this much, and 15 %.
    response_angle: AngleDeciDeg = [20], 10..=200, "0.1°", "own (2°; S4 table 4: least command 1°)", "RSP-1i";
    /// The drive may give this much more than it was told, and 15 %.
    torque_excess: Percent = [5], 1..=20, "%", "own", "TRQ-7a";
    /// A bypass counts this long after it was last seen.
    bypass_hold: Millis = [2000], 500..=10000, "ms", "own", "SELF-10c";
    /// Latched faults clear only after this long without one.
    fault_free: Millis = [10000], 1000..=60000, "ms", "own", "SELF-7b";
}

fn rising<T: PartialOrd + Copy>(values: &[T]) -> bool {
    values.is_sorted_by(|earlier, later| earlier <= later)
}
fn falling<T: PartialOrd + Copy>(values: &[T]) -> bool {
    values.is_sorted_by(|earlier, later| earlier >= later)
}

/// 2¹⁴, the 1 of a rotation, squared; and the hundredth of it that rounding and calibration may leave.
const UNIT_SQUARE: i32 = 1 << 28;
const UNIT_TOLERANCE: i32 = UNIT_SQUARE / 100;
/// cos 45°: a camera turned further does not look ahead, or is not upright.
const HALF_TURNED: i16 = 11_585;

/// A row of a rotation matrix has length 1. Sums that saturate are far beyond the tolerance.
fn of_length_one(row: [RotationQ14; 3]) -> bool {
    let [x, y, z] = row.map(|element| element.wide().saturating_mul(element.wide()));
    x.saturating_add(y).saturating_add(z).saturating_sub(UNIT_SQUARE).saturating_abs() <= UNIT_TOLERANCE
}

impl Config {
    /// The camera looks ahead, upright and not mirrored, and no row of its rotation stretches.
    fn camera_looks_ahead(&self) -> bool {
        let [rx, ry, rz, dx, dy, dz, ax, ay, az] = self.camera_rotation.0;
        ry.raw() <= -HALF_TURNED
            && dz.raw() <= -HALF_TURNED
            && ax.raw() >= HALF_TURNED
            && of_length_one([rx, ry, rz])
            && of_length_one([dx, dy, dz])
            && of_length_one([ax, ay, az])
    }

    /// The first relation between values that does not hold.
    #[must_use]
    pub fn broken_relation(&self) -> Option<&'static str> {
        let [exit_one, exit_two] = self.level_exit_angle.0;
        let [enter_one, enter_two, _] = self.level_angle.0;
        let [_, _, decel_three] = self.level_decel.0;
        let [ordinary, emergency, outer] = self.response_brake.0;
        let ([columns, rows], [column, row]) = (self.image_size.0, self.principal_point.0);
        let leave_greatest = self.leave_decel.0.last().copied().unwrap_or(self.leave_hold);
        let broken: Result<(), &'static str> = permit!(
            (self.cycle_nominal >= self.cycle_least && self.cycle_nominal <= self.cycle_greatest) => "cycle_least <= cycle_nominal <= cycle_greatest",
            (self.timeout_50 > self.cycle_greatest) => "timeout_50 > cycle_greatest",
            (self.timeout_50 <= self.timeout_100 && self.timeout_100 <= self.timeout_200) => "timeout_50 <= timeout_100 <= timeout_200",
            (self.standstill_speed < self.epb_speed) => "standstill_speed < epb_speed",
            (self.seat_freeze < self.seat_vacant) => "seat_freeze < seat_vacant",
            (self.boot_settle.raw() > self.requalify.raw().saturating_add(self.seat_confirm.raw()).saturating_add(self.timeout_200.raw()))
                => "boot_settle > requalify + seat_confirm + timeout_200",
            (self.epb_speed <= self.leave_hold_speed) => "epb_speed <= leave_hold_speed",
            (rising(&self.leave_decel.0)) => "leave_decel rises with speed",
            (leave_greatest <= self.brake_cap && self.leave_hold <= self.brake_cap) => "leave_decel, leave_hold <= brake_cap",
            (falling(&self.level_ttc.0)) => "level_ttc falls with the level",
            (rising(&self.level_decel.0) && decel_three <= self.brake_cap) => "level_decel rises with the level, up to brake_cap",
            (enter_one <= exit_one && enter_two <= exit_two) => "level_angle <= level_exit_angle",
            (rising(&self.forward_ttc.0) && rising(&self.pedestrian_ttc.0)) => "warnings go on below and off above",
            (self.camera_looks_ahead()) => "camera_rotation looks ahead, upright, its rows of length 1",
            (column < columns && row < rows) => "principal_point inside image_size",
            (self.comfort_cap <= self.brake_cap) => "comfort_cap <= brake_cap",
            (rising(&self.pedal_map.0)) => "pedal_map rises with the pedal",
            (falling(&self.steering_angle.0) && falling(&self.steering_rate.0)) => "steering_angle, steering_rate fall with speed",
            (self.steering_overlay < self.takeover_torque) => "steering_overlay < takeover_torque",
            (self.steering_speed_least < self.steering_speed_greatest) => "steering_speed_least < steering_speed_greatest",
            (rising(&self.mass_range.0)) => "mass_range: least before greatest",
            (emergency <= ordinary && ordinary <= outer)
                => "response_brake: level 3 <= ordinary <= from the command",
            (rising(&self.response_steering.0)) => "response_steering: first response before the target",
        );
        broken.err()
    }

    /// Every value in range and every relation kept: what the proofs call *any valid configuration*.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.out_of_range().is_none() && self.broken_relation().is_none()
    }
}
