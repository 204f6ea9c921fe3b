//! What one cycle says by itself: speeds, pedals, seat, objects. Exact integers, no memory.

use super::trace::Cycle;
use crate::common::always::TABLE_1;
use crate::common::*;

/// The two speeds together (rule 6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    /// They agree: the lower and the higher one, 1/256 km/h.
    Known(i64, i64),
    /// They agree or not, as the 5 % are read of the lower or of the higher one.
    Open,
    /// One is unknown, or they disagree.
    Unknown,
}

impl Speed {
    /// RULE-6c.
    pub fn of(inputs: &Inputs) -> Self {
        let (Some(wheel), Some(motor)) = (inputs.wheel_speed.known(), inputs.motor_speed.known()) else {
            return Self::Unknown;
        };
        let (wheel, motor) = (i64::from(wheel.raw()), i64::from(motor.raw()));
        let (low, high) = (wheel.min(motor), wheel.max(motor));
        let apart = high - low;
        if apart <= 512 || apart * 100 <= 5 * low {
            Self::Known(low, high)
        } else if apart * 100 <= 5 * high {
            Self::Open
        } else {
            Self::Unknown
        }
    }
    /// Known, and the lower one is at least this.
    pub fn at_least(self, bound: i64) -> bool {
        matches!(self, Self::Known(low, _) if low >= bound)
    }
    /// Known, and the higher one is below this.
    pub fn below(self, bound: i64) -> bool {
        matches!(self, Self::Known(_, high) if high < bound)
    }
    /// In no reading known.
    pub fn unknown(self) -> bool {
        self == Self::Unknown
    }
    /// In every reading known.
    pub fn known(self) -> bool {
        matches!(self, Self::Known(_, _))
    }
}

/// The lower and the higher track of a pedal that is known (two tracks in range that agree within 5 %).
pub fn tracks(pedal: [Signal<Pedal250>; 2]) -> Option<(i64, i64)> {
    let [first, second] = pedal.map(|track| track.known().map(|travel| i64::from(travel.raw())));
    let (first, second) = (first?, second?);
    let (low, high) = (first.min(second), first.max(second));
    (high <= 250 && high - low <= 13).then_some((low, high))
}

/// The brake pedal is known not to be pressed, in every reading.
pub fn pedal_clear(inputs: &Inputs) -> bool {
    inputs.brake_switch.is(false) && tracks(inputs.brake_pedal).is_some_and(|(_, high)| high <= 10)
}
/// The brake pedal is pressed or unknown, in every reading.
pub fn pedal_not_clear(inputs: &Inputs) -> bool {
    !inputs.brake_switch.is(false) || tracks(inputs.brake_pedal).is_none_or(|(low, _)| low > 10)
}
/// The brake pedal is known to be pressed, in every reading.
pub fn pedal_pressed(inputs: &Inputs) -> bool {
    inputs.brake_switch.is(true) && tracks(inputs.brake_pedal).is_some_and(|(low, _)| low > 10)
}

/// Whether drive, auxiliaries and current are confirmed stopped (SEAT-7g).
pub fn loads_stopped(inputs: &Inputs) -> bool {
    let current = inputs.hv_current.known().map(|current| i64::from(current.raw()).abs());
    inputs.drive_stopped.is(true) && inputs.auxiliaries_stopped.is(true) && current.is_some_and(|current| current <= 20)
}

/// The executed torque is known to be no more than this.
pub fn executed_at_most(inputs: &Inputs, bound: i64) -> bool {
    inputs.executed_torque.known().is_some_and(|torque| i64::from(torque.raw()) <= bound)
}

/// The value of a command that may be used: fresh, or held no longer than this.
pub fn usable<T: Copy>(command: Command<T>, timeout: u32) -> Option<T> {
    match command {
        Command::Fresh(value) => Some(value),
        Command::Held(age, value) if age.raw() <= timeout => Some(value),
        Command::Held(_, _) | Command::Absent | Command::Rejected(_) => None,
    }
}
/// The value of a frame of this cycle.
pub fn fresh<T: Copy>(command: Command<T>) -> Option<T> {
    usable(command, 0).filter(|_| matches!(command, Command::Fresh(_)))
}

/// What goes out as deceleration: service brake and retarder (31/2048 m/s² for each per cent), 1/2048 m/s².
pub fn braking_out(outputs: &Outputs) -> i64 {
    i64::from(outputs.brake.total.raw()) + 31 * i64::from(outputs.retarder.torque.raw())
}

/// Distance as of now, rounded to the nearer side (FUS-1a), in cm.
fn distance(raw: u16, closing: i64, age: u32) -> i64 {
    (i64::from(raw) * 1000 - closing * i64::from(age)).div_euclid(1000).max(0)
}

/// Radar objects: distance now, lateral offset, closing speed, updates.
fn objects(cycle: &Cycle) -> impl Iterator<Item = (i64, i64, i64, u8)> + '_ {
    cycle.radar.iter().map(|object| {
        let closing = i64::from(object.closing.raw());
        let now = distance(object.distance.raw(), closing, object.age.raw());
        (now, i64::from(object.offset.raw()).abs(), closing, object.updates.raw())
    })
}

/// Both sensors deliver, and every object is in time: perception is known in every reading.
pub fn perception_known(cycle: &Cycle) -> bool {
    cycle.sensors_known()
        && cycle.radar.iter().all(|object| object.age.raw() <= 250)
        && cycle.camera.iter().all(|object| object.age.raw() <= 250)
}

/// The three levels of S1 §3.1.2: time to collision in ms, whether that time itself belongs to the level (R-b), angle in 0.1°,
/// deceleration in 1/2048 m/s².
pub const LEVEL: [(i64, bool, i64, i64); 3] =
    [(4_400, false, 600, 2_048), (3_600, true, 700, 5_120), (2_700, true, 800, 10_240)];

/// T below the limit, or at it, by cross-multiplication (TTC-1c).
fn nearer(distance: i64, closing: i64, limit: i64, inclusive: bool) -> bool {
    closing > 0 && (distance * 1000 < limit * closing || (inclusive && distance * 1000 == limit * closing))
}

/// The measured deceleration stops the closing before the margin of 1 m: a ≥ v²/(2·(gap − 1 m)) (MIT-6c).
fn enough(deceleration: Option<i64>, distance: i64, closing: i64) -> bool {
    // a/2048 m/s² · 2 · (gap − 100)/100 m ≥ (closing/100)² m²/s².
    deceleration.is_some_and(|decel| distance > 100 && decel * 2 * (distance - 100) * 100 >= closing * closing * 2048)
}

/// The measured deceleration, if plausible (at most 10 m/s²).
fn deceleration(inputs: &Inputs) -> Option<i64> {
    inputs.deceleration.known().map(|decel| i64::from(decel.raw())).filter(|decel| *decel <= 20_480)
}

fn angle(inputs: &Inputs) -> Option<i64> {
    inputs.steering_angle.known().map(|angle| i64::from(angle.raw()).abs())
}

/// MIT-1a, 2a, 3a: the level must be entered: a radar object inside the corridor, in time, seen three times. MIT-6b spares only
/// a bus that is known to be slow: a limit for comfort needs its own evidence (rule 3).
pub fn must_enter(cycle: &Cycle, level: usize) -> bool {
    let (limit, inclusive, most, _) = LEVEL[level];
    let speed = Speed::of(&cycle.inputs);
    perception_known(cycle)
        && (speed.unknown() || speed.at_least(2_560))
        && angle(&cycle.inputs).is_some_and(|angle| angle < most)
        && objects(cycle).any(|(distance, offset, closing, updates)| {
            offset < 180
                && updates >= 3
                && nearer(distance, closing, limit, inclusive)
                && !enough(deceleration(&cycle.inputs), distance, closing)
        })
}

/// The level may be entered: in no reading without such an object (seen three times, or perhaps matched by the camera).
pub fn may_enter(cycle: &Cycle, level: usize) -> bool {
    let (limit, inclusive, most, _) = LEVEL[level];
    let slow = matches!(Speed::of(&cycle.inputs), Speed::Known(_, high) if high < 2_560);
    let decel = deceleration(&cycle.inputs);
    !slow
        && angle(&cycle.inputs).is_some_and(|angle| angle < most)
        && objects(cycle).any(|(distance, offset, closing, updates)| {
            offset <= 180 && (updates >= 3 || !cycle.camera.is_empty()) && nearer(distance, closing, limit, inclusive)
        })
        && !objects(cycle).all(|(distance, _, closing, _)| closing <= 0 || enough(decel, distance, closing))
}

/// No object of any sensor closes.
pub fn nothing_closes(cycle: &Cycle) -> bool {
    singles(cycle).all(|(_, closing)| closing <= 0)
}

/// An object in the corridor certainly closes.
pub fn object_closes(cycle: &Cycle) -> bool {
    perception_known(cycle)
        && objects(cycle).any(|(_, offset, closing, updates)| offset < 180 && updates >= 3 && closing > 0)
}

/// The driver may be steering beyond this, 0.1°.
pub fn steers_beyond(inputs: &Inputs, bound: i64) -> bool {
    angle(inputs).is_some_and(|angle| angle > bound)
}

/// Objects of any single sensor: distance, closing speed. Of the camera at its raw distance too, which is never nearer.
fn singles(cycle: &Cycle) -> impl Iterator<Item = (i64, i64)> + '_ {
    let camera = cycle.camera.iter().map(|object| {
        let closing = i64::from(object.closing.raw());
        (distance(object.distance.raw(), closing, object.age.raw()), closing)
    });
    objects(cycle).map(|(distance, _, closing, _)| (distance, closing)).chain(camera)
}

/// PHB-1b may permit the full cap for an object: T ≤ 3.2 s, or v² ≥ 2·3.5·gap with the gap less its margin.
pub fn may_be_emergency(cycle: &Cycle) -> bool {
    singles(cycle).any(|(distance, closing)| {
        nearer(distance, closing, 3_200, true)
            || (closing > 0 && (distance <= 100 || closing * closing * 2048 >= 2 * 7_168 * (distance - 100) * 100))
            || distance == 0
    })
}
/// PHB-1b permits the full cap for an object: T ≤ 3.2 s, of a radar object in the corridor.
pub fn must_be_emergency(cycle: &Cycle) -> bool {
    perception_known(cycle)
        && objects(cycle).any(|(distance, offset, closing, _)| offset < 180 && nearer(distance, closing, 3_200, true))
}
/// A deceleration as a fraction of 1/2048 m/s²: numerator and denominator.
#[derive(Clone, Copy, Debug)]
pub struct Exact(i64, i64);

impl Exact {
    /// 1.35 m/s² (S3 table 1 at 2 km/h): holds the bus.
    pub const HOLD: Self = Self(135 * 2048, 100);
    /// Whether a value of an output is at least this.
    pub fn met_by(self, raw: DecelMs2Q11) -> bool {
        i64::from(raw.raw()) * self.1 >= self.0
    }
    /// The greater one.
    pub fn or_more(self, other: Self) -> Self {
        if self.0 * other.1 >= other.0 * self.1 { self } else { other }
    }
}

/// SEAT-3a, b, c: a0(v) of S3 table 1, linear between the points; the speed in 1/256 km/h.
pub fn a0(speed: i64) -> Exact {
    TABLE_1.windows(2).find(|pair| speed < pair[1].0 * 256).map_or(Exact(220 * 2048, 100), |pair| {
        let [(from, low), (to, high)] = [pair[0], pair[1]];
        let step = (to - from) * 256;
        Exact((low * step + (high - low) * (speed - from * 256)) * 2048, step * 100)
    })
}
