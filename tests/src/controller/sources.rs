//! The numbers of the main controller, written down a second time from S1 to S3: never taken from the supervisor.

/// S1 §3.1.2 (3)–(5): time to collision in ms below which levels 1, 2, 3 begin.
pub const LEVEL_TTC_MS: [i64; 3] = [4400, 3600, 2700];
/// S1 §3.1.2 (3)–(5): steering angle in 0.1° below which levels 1, 2, 3 may begin.
pub const LEVEL_ANGLE: [u16; 3] = [600, 700, 800];
/// S1 §3.1.2 (3), (4): steering angle in 0.1° beyond which levels 1, 2 end.
pub const LEVEL_EXIT_ANGLE: [u16; 2] = [800, 900];
/// S1 §3.1.2 (3)–(5): deceleration of levels 1, 2, 3 in m/s².
pub const LEVEL_DECEL: [f64; 3] = [1.0, 2.5, 5.0];
/// S1 §3.1.2 (5): all levels end after this long at rest, in ms.
pub const LEVEL_REST_MS: u32 = 1000;
/// Spec MIT-4 (own): levels 1 and 2 end when nothing has been closing for this long, in ms.
pub const LEVEL_GONE_MS: u32 = 500;
/// Spec MIT-6 (own): no level begins below this speed, in km/h.
pub const LEVEL_LEAST_SPEED: f64 = 10.0;
/// Spec FUS-3 (own): half-width of the corridor in cm; updates that make a radar object certain.
pub const CORRIDOR_CM: u16 = 180;
/// See [`CORRIDOR_CM`].
pub const CERTAIN_UPDATES: u8 = 3;
/// S1 §3.1.2 (1): forward-collision warning on below, off above this time to collision in ms; offset in cm.
pub const FORWARD: (i64, i64, u16) = (4000, 4500, 180);
/// S1 §3.1.2 (2): the same for pedestrians.
pub const PEDESTRIAN: (i64, i64, u16) = (4200, 4500, 200);

/// S3 §2.1: both sensors vacant for this long is *leave*, in ms.
pub const LEAVE_MS: u32 = 2000;
/// Spec §5 (own): both sensors occupied for this long is *confirmed occupied*, in ms.
pub const CONFIRM_MS: u32 = 1000;
/// S3 table 1: speed in km/h and deceleration in m/s².
pub const LEAVE_DECEL: [(f64, f64); 16] = [
    (0.0, 0.0),
    (2.0, 1.35),
    (4.0, 1.40),
    (6.0, 1.45),
    (8.0, 1.50),
    (10.0, 1.55),
    (15.0, 1.60),
    (20.0, 1.65),
    (25.0, 1.70),
    (30.0, 1.73),
    (35.0, 1.76),
    (40.0, 1.80),
    (45.0, 1.85),
    (50.0, 1.95),
    (55.0, 2.00),
    (60.0, 2.20),
];
/// Added to S3's table, so that no rounding falls short of it (own), in m/s².
pub const LEAVE_MARGIN: f64 = 0.02;
/// S3 table 1 at 2 km/h: what holds the bus until the parking brake is confirmed, in m/s² and km/h.
pub const LEAVE_HOLD: (f64, f64) = (1.35, 2.0);
/// S3 §2.4: below this speed the parking brake is applied, in km/h.
pub const EPB_SPEED: f64 = 1.5;
/// S3 §2.6: parked for this long, high voltage is shut down, in ms.
pub const SHUTDOWN_MS: u32 = 600_000;
/// Current in 0.1 A below which drive and auxiliaries have stopped (own).
pub const STOPPED_CURRENT: u16 = 20;

/// Standstill is below this speed, in km/h (spec reading e).
pub const STANDSTILL: f64 = 0.3;
/// A pedal beyond this share is pressed (own): 4 %.
pub const PRESSED: f64 = 0.04;
/// Torque rises by no more than this in each frame of 50 ms, in % (own: 30 %/s).
pub const TORQUE_RISE: f64 = 1.5;
/// Greatest torque of the cruise control, in % (own).
pub const CRUISE_TORQUE: f64 = 50.0;
/// Greatest speed of cruise control and lane assistant, in km/h (S3 §2.3: the bus does no more).
pub const GREATEST_SPEED: f64 = 60.0;
/// The lane assistant fades out this far below it, in km/h (own).
pub const STEERING_MARGIN: f64 = 2.0;
/// The cruise control asks for torque and steers this long after it asked for its mode, in ms (own).
pub const CRUISE_DELAY_MS: u32 = 200;
/// S2 §2 2), `MinTorq`: without ADAS torque, an accelerator beyond this overrides, in % (value own).
pub const OVERRIDE_LEAST: f64 = 8.0;
/// S2 §2 2): the driver's accelerator beyond ADAS torque + this overrides, in % (value own).
pub const OVERRIDE_OFFSET: f64 = 10.0;
/// The electric part stays this far below its limit, in m/s² (own): the limit may fall between two frames.
pub const ELECTRIC_MARGIN: f64 = 0.1;
/// Brake lamps come on from this deceleration, in m/s² ...
pub const LAMP_DECEL: f64 = 0.7;
/// ... and go off this much later, in ms (spec BODY-1).
pub const LAMP_DELAY_MS: u32 = 400;
/// The fault lamp is tested this long after start, in ms (own; the usual bulb check).
pub const BULB_CHECK_MS: u32 = 3000;
