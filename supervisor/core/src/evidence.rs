//! What the inputs of one cycle are evidence for. Unknown is evidence for nothing (rule 1).

use supervisor_terms::{AngleDeciDeg, Config, Inputs, Pedal250, Percent, Seat, Signal, SpeedKmhQ8};

/// The two speeds, where they agree (rule 6).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Speed {
    /// The lower one: for obligations.
    pub low: SpeedKmhQ8,
    /// The higher one: for interlocks.
    pub high: SpeedKmhQ8,
}

/// What both seat sensors say together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SeatView {
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
pub(crate) enum BrakePedal {
    /// Known pressed, this far where both tracks agree.
    Pressed(Option<Pedal250>),
    /// Known released by the switch and both tracks.
    Released,
    /// Neither.
    Unknown,
}

/// The evidence of one cycle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Evidence {
    pub speed: Option<Speed>,
    pub seat: SeatView,
    /// Both tracks, where they agree: the lower one.
    pub accelerator: Option<Pedal250>,
    /// Any track says pressed.
    pub accelerator_pressed: bool,
    pub brake_pedal: BrakePedal,
    pub steering_angle: Option<AngleDeciDeg>,
    /// Known below the standstill speed (reading e).
    pub standstill: bool,
}

/// A percentage that is known and plausible.
pub(crate) fn percent(signal: Signal<Percent>) -> Option<Percent> {
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
    let difference = u32::from(high.raw().abs_diff(low.raw()));
    let absolute = difference <= u32::from(config.speed_agree.raw());
    let hundredfold = difference.saturating_mul(100);
    let relative = hundredfold <= u32::from(config.speed_agree_percent.raw()).saturating_mul(u32::from(high.raw()));
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

impl Evidence {
    /// CMD-7a, b: reads the inputs once; nothing that the main controller or a remote operator says is among them.
    pub(crate) fn gather(inputs: &Inputs, config: &Config) -> Self {
        let speed = speed(inputs, config);
        let [first, second] = inputs.seat;
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
            standstill: speed.is_some_and(|speed| speed.high < config.standstill_speed),
        }
    }

    /// RULE-6a, RULE-1b: known to be slower than `limit`, by the lower speed: evidence for an obligation.
    pub(crate) fn obliged_below(&self, limit: SpeedKmhQ8) -> bool {
        self.speed.is_some_and(|speed| speed.low < limit)
    }
    /// RULE-1d: the same, keeping what was last known while the speed is unknown: an obligation that has begun stays (rule 1).
    pub(crate) fn slow(&self, limit: SpeedKmhQ8, before: bool) -> bool {
        self.speed.map_or(before, |speed| speed.low < limit)
    }
    /// RULE-6b, RULE-1c: known to be slower than `limit`, by the higher speed: evidence for a permission.
    pub(crate) fn surely_below(&self, limit: SpeedKmhQ8) -> bool {
        self.speed.is_some_and(|speed| speed.high < limit)
    }
    /// Known to be at least as fast as `limit`, by the lower speed.
    pub(crate) fn surely_at_least(&self, limit: SpeedKmhQ8) -> bool {
        self.speed.is_some_and(|speed| speed.low >= limit)
    }
}
