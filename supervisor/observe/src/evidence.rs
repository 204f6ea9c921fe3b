//! What the inputs of one cycle are evidence for. Unknown is evidence for nothing (rule 1).

use supervisor_terms::{
    AngleDeciDeg, Config, DecelMs2Q11, Inputs, Pedal250, Percent, Pressure5KPa, Seat, Signal, SpeedKmhQ8, kernel,
};

/// The two speeds, where they agree (rule 6).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Speed {
    /// The lower one: for obligations.
    pub low: SpeedKmhQ8,
    /// The higher one: for interlocks.
    pub high: SpeedKmhQ8,
}

/// What both seat sensors say together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeatView {
    /// Both known occupied.
    Occupied,
    /// Both known vacant.
    Vacant,
    /// One known occupied, the other not.
    HalfOccupied,
    /// At least one unknown, none occupied.
    Unknown,
}

/// The brake pedal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BrakePedal {
    /// Known pressed, this far where both tracks agree.
    Pressed(Option<Pedal250>),
    /// Known released by the switch and both tracks.
    Released,
    /// Neither.
    Unknown,
}

/// The evidence of one cycle.
#[derive(Clone, Copy, Debug)]
pub struct Evidence {
    /// Both speeds, where they agree.
    pub speed: Option<Speed>,
    /// Both seat sensors.
    pub seat: SeatView,
    /// Both tracks, where they agree: the lower one.
    pub accelerator: Option<Pedal250>,
    /// Any track says pressed.
    pub accelerator_pressed: bool,
    /// The brake pedal.
    pub brake_pedal: BrakePedal,
    /// The steering-wheel angle, where plausible.
    pub steering_angle: Option<AngleDeciDeg>,
    /// Electric deceleration that may be used: 0 where slip control is at work or unknown, the limit is unknown, or a
    /// value by which the brake system splits is not plausible (VLC-2, VLC-3).
    pub electric: DecelMs2Q11,
    /// A value by which the brake system splits is known and not plausible (VLC-3).
    pub split_implausible: bool,
    /// Known below the standstill speed (reading e).
    pub standstill: bool,
}

/// A percentage that is known and plausible.
#[must_use]
pub fn percent(signal: Signal<Percent>) -> Option<Percent> {
    signal.known().filter(|percent| *percent <= Percent::FULL)
}

/// The full travel of a pedal, 250 × 0.4 %.
const PEDAL_FULL: Pedal250 = Pedal250::new(250);

fn pedal(signal: Signal<Pedal250>) -> Option<Pedal250> {
    signal.known().filter(|travel| *travel <= PEDAL_FULL)
}

/// The deeper track that is known; 0 if none is.
fn deepest([first, second]: [Signal<Pedal250>; 2]) -> Pedal250 {
    pedal(first).max(pedal(second)).unwrap_or(Pedal250::ZERO)
}

/// E2E-1d: two tracks are known while they agree.
fn agreed([first, second]: [Signal<Pedal250>; 2], config: &Config) -> Option<Pedal250> {
    let (first, second) = (pedal(first)?, pedal(second)?);
    (first.raw().abs_diff(second.raw()) <= config.pedal_agree.raw()).then_some(first.min(second))
}

/// RULE-6c, E2E-1d: the two speeds, where they agree; otherwise unknown.
fn speed(inputs: &Inputs, config: &Config) -> Option<Speed> {
    let (wheel, motor) = (inputs.wheel_speed.known()?, inputs.motor_speed.known()?);
    let (low, high) = (wheel.min(motor), wheel.max(motor));
    let difference = high.raw().abs_diff(low.raw());
    let absolute = difference <= config.speed_agree.raw();
    let relative = kernel::within_percent(difference, config.speed_agree_percent.raw(), high.raw());
    (absolute || relative).then_some(Speed { low, high })
}

fn brake_pedal(inputs: &Inputs, config: &Config) -> BrakePedal {
    let deepest = deepest(inputs.brake_pedal);
    if inputs.brake_switch.is(true) || deepest > config.pedal_pressed {
        BrakePedal::Pressed(agreed(inputs.brake_pedal, config).and(Some(deepest)))
    } else if inputs.brake_switch.is(false) && agreed(inputs.brake_pedal, config).is_some() {
        BrakePedal::Released
    } else {
        BrakePedal::Unknown
    }
}

/// VLC-3: whether a value by which the brake system splits is plausible; `None` while it is unknown.
fn plausible<T: Copy + PartialEq + PartialOrd>(signal: Signal<T>, least: T, most: T) -> Option<bool> {
    signal.known().map(|value| value >= least && value <= most)
}

/// VLC-2, VLC-3: what the brake system may give electrically, and whether a value for the split is implausible.
fn split(inputs: &Inputs, config: &Config) -> (DecelMs2Q11, bool) {
    let [lightest, heaviest] = config.mass_range.0;
    let [front, rear] = inputs.axle_pressure;
    let limit = inputs.electric_limit.known().unwrap_or(DecelMs2Q11::ZERO);
    let actual_most = DecelMs2Q11::new(limit.raw().saturating_add(config.electric_excess.raw()));
    let none = Pressure5KPa::ZERO;
    let mass = plausible(inputs.mass, lightest, heaviest);
    let front = plausible(front, none, config.axle_pressure_most);
    let rear = plausible(rear, none, config.axle_pressure_most);
    let actual = plausible(inputs.electric_actual, DecelMs2Q11::ZERO, actual_most);
    let bad = mass == Some(false)
        || front == Some(false)
        || rear == Some(false)
        || (actual == Some(false) && inputs.electric_limit.known().is_some());
    let good = mass == Some(true) && front == Some(true) && rear == Some(true) && actual == Some(true);
    // VLC-2: slip control at work or unknown: friction alone.
    let grip = inputs.abs.is(false) && inputs.asr.is(false) && inputs.stability.is(false);
    (if good && grip { limit } else { DecelMs2Q11::ZERO }, bad)
}

impl Evidence {
    /// CMD-7a, b: reads the inputs once; nothing that the main controller or a remote operator says is among them.
    #[must_use]
    pub fn gather(inputs: &Inputs, config: &Config) -> Self {
        let speed = speed(inputs, config);
        let [first, second] = inputs.seat;
        let (electric, split_implausible) = split(inputs, config);
        let seat = match (first.known(), second.known()) {
            (Some(Seat::Occupied), Some(Seat::Occupied)) => SeatView::Occupied,
            (Some(Seat::Vacant), Some(Seat::Vacant)) => SeatView::Vacant,
            (Some(Seat::Occupied), _) | (_, Some(Seat::Occupied)) => SeatView::HalfOccupied,
            (Some(Seat::Vacant) | None, None) | (None, Some(Seat::Vacant)) => SeatView::Unknown,
        };
        Self {
            speed,
            seat,
            accelerator: agreed(inputs.accelerator, config),
            accelerator_pressed: deepest(inputs.accelerator) > config.pedal_pressed,
            brake_pedal: brake_pedal(inputs, config),
            steering_angle: inputs
                .steering_angle
                .known()
                .filter(|angle| angle.raw().unsigned_abs() <= config.steering_range.raw().unsigned_abs()),
            electric,
            split_implausible,
            standstill: speed.is_some_and(|speed| speed.high < config.standstill_speed),
        }
    }

    /// RULE-6a, RULE-1b: known to be slower than `limit`, by the lower speed: evidence for an obligation.
    #[must_use]
    pub fn obliged_below(&self, limit: SpeedKmhQ8) -> bool {
        self.speed.is_some_and(|speed| speed.low < limit)
    }
    /// RULE-1d: the same, keeping what was last known while the speed is unknown: an obligation that has begun stays (rule 1).
    #[must_use]
    pub fn slow(&self, limit: SpeedKmhQ8, before: bool) -> bool {
        self.speed.map_or(before, |speed| speed.low < limit)
    }
    /// RULE-6b, RULE-1c: known to be slower than `limit`, by the higher speed: evidence for a permission.
    #[must_use]
    pub fn surely_below(&self, limit: SpeedKmhQ8) -> bool {
        self.speed.is_some_and(|speed| speed.high < limit)
    }
    /// Known to be at least as fast as `limit`, by the lower speed.
    #[must_use]
    pub fn surely_at_least(&self, limit: SpeedKmhQ8) -> bool {
        self.speed.is_some_and(|speed| speed.low >= limit)
    }
}
