//! The inputs as the main controller uses them.

use supervisor::{EpbState, Gear, Inputs, Key, Pedal250, Seat, Signal};

use super::sources::{PRESSED, STANDSTILL};

/// What the main controller makes of one cycle's inputs.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The lower of both speeds in km/h; `None` if one is unknown.
    pub speed: Option<f64>,
    /// The higher of both speeds is known to be below standstill.
    pub stands: bool,
    /// Both seat sensors see a driver.
    pub occupied: bool,
    /// Neither sees one, and both are known.
    pub vacant: bool,
    /// Accelerator, 0 to 1; 0 if unknown.
    pub accelerator: f64,
    /// Brake pedal pressed, or not known to be released.
    pub braking: bool,
    /// Parking brake.
    pub epb: Option<EpbState>,
    /// Confirmed gear.
    pub gear: Option<Gear>,
    /// Key.
    pub key: Option<Key>,
    /// Magnitude of the steering angle in 0.1°.
    pub angle: Option<u16>,
    /// Greatest torque that the drive says it can give, in %; 0 if unknown.
    pub torque_limit: f64,
    /// Something that the bus needs is unknown: the fault lamp is due.
    pub fault: bool,
}

/// Both tracks of a pedal, the lower one first.
fn shares(signals: [Signal<Pedal250>; 2]) -> Option<(f64, f64)> {
    let [first, second] = signals.map(|signal| signal.known().map(|travel| f64::from(travel.raw()) / 250.0));
    Some((first?.min(second?), first?.max(second?)))
}

impl View {
    /// Reads the inputs.
    #[must_use]
    pub fn of(inputs: &Inputs) -> Self {
        let kmh = |signal: Signal<supervisor::SpeedKmhQ8>| signal.known().map(|speed| f64::from(speed.raw()) / 256.0);
        let speeds = kmh(inputs.wheel_speed).and_then(|wheel| Some((wheel, kmh(inputs.motor_speed)?)));
        let speed = speeds.map(|(wheel, motor)| wheel.min(motor));
        let [first, second] = inputs.seat;
        let occupied = first.is(Seat::Occupied) && second.is(Seat::Occupied);
        let vacant = first.is(Seat::Vacant) && second.is(Seat::Vacant);
        let (accelerator, brake) = (shares(inputs.accelerator), shares(inputs.brake_pedal));
        let released = inputs.brake_switch.is(false) && brake.is_some_and(|(_, travel)| travel <= PRESSED);
        Self {
            speed,
            stands: speeds.is_some_and(|(wheel, motor)| wheel.max(motor) < STANDSTILL),
            occupied,
            vacant,
            accelerator: accelerator.map_or(0.0, |(travel, _)| travel),
            braking: !released,
            epb: inputs.epb.known(),
            gear: inputs.gear.known(),
            key: inputs.key.known(),
            angle: inputs.steering_angle.known().map(|angle| angle.raw().unsigned_abs()),
            torque_limit: inputs.drive_limit.known().map_or(0.0, |limit| f64::from(limit.raw())),
            fault: (!occupied && !vacant) || speed.is_none() || accelerator.is_none() || brake.is_none(),
        }
    }
    /// Known to be slower than this, in km/h.
    #[must_use]
    pub fn below(&self, kmh: f64) -> bool {
        self.speed.is_some_and(|speed| speed < kmh)
    }
    /// The accelerator is pressed.
    #[must_use]
    pub fn pressed(&self) -> bool {
        self.accelerator > PRESSED
    }
    /// A driving gear is confirmed.
    #[must_use]
    pub const fn in_gear(&self) -> bool {
        matches!(self.gear, Some(Gear::Drive | Gear::Reverse))
    }
}

/// Time for which a condition has held: 0 at its first sample, `None` while it does not hold.
#[derive(Clone, Copy, Debug, Default)]
pub struct Held(Option<u32>);

impl Held {
    /// One cycle of 10 ms.
    pub fn update(&mut self, condition: bool) {
        self.0 = condition.then(|| self.0.map_or(0, |held| held.saturating_add(10)));
    }
    /// Whether it has held for this long.
    #[must_use]
    pub const fn for_at_least(self, ms: u32) -> bool {
        match self.0 {
            Some(held) => held >= ms,
            None => false,
        }
    }
}
