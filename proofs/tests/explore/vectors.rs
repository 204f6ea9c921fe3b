//! What the supervisor reads: a healthy bus, and what differs from it.

use supervisor_core::{
    AdsState, AngleDeciDeg, Commands, Config, Contact, CurrentDeciA, DecelMs2Q11, EpbMode, EpbState, EpbSwitch,
    EpsState, Gear, Inputs, Key, Mass10Kg, Millis, Outputs, Pedal250, Percent, PercentPerS, Pressure5KPa, RateDeciDegS,
    Row, Seat, Signal, SpeedKmhQ8, Threat, TorqueNmQ10, XbrStatus,
};
use supervisor_perceive::{Scene, perceive};

use crate::model::{TICK, Vector};

/// Known.
pub const fn known<T>(value: T) -> Signal<T> {
    Signal::Known(value)
}

/// The driver seated, the bus standing in D with high voltage on, key on; everything known.
pub const HEALTHY: Inputs = Inputs {
    seat: [known(Seat::Occupied); 2],
    wheel_speed: known(SpeedKmhQ8::ZERO),
    motor_speed: known(SpeedKmhQ8::ZERO),
    accelerator: [known(Pedal250::ZERO); 2],
    brake_pedal: [known(Pedal250::ZERO); 2],
    brake_switch: known(false),
    steering_angle: known(AngleDeciDeg::ZERO),
    driver_torque: known(TorqueNmQ10::ZERO),
    selector: known(Gear::Drive),
    gear: known(Gear::Drive),
    epb: known(EpbState::Released),
    epb_switch: known(EpbSwitch::Idle),
    epb_mode: known(EpbMode::Automatic),
    key: known(Key::On),
    cruise_switch: known(true),
    driver_set: known(false),
    k1: known(Contact::Closed),
    k4: known(Contact::Closed),
    hv_current: known(CurrentDeciA::ZERO),
    drive_stopped: known(true),
    auxiliaries_stopped: known(true),
    drive_limit: known(Percent::FULL),
    executed_torque: known(Percent::ZERO),
    electric_limit: known(DecelMs2Q11::new(6144)),
    friction_limit: known(DecelMs2Q11::new(20480)),
    electric_actual: known(DecelMs2Q11::ZERO),
    mass: known(Mass10Kg::new(1200)),
    axle_pressure: [known(Pressure5KPa::new(100)); 2],
    deceleration: known(DecelMs2Q11::ZERO),
    abs: known(false),
    asr: known(false),
    stability: known(false),
    ebs_red: known(false),
    ebs_amber: known(false),
    xbr_status: known(XbrStatus::Allowed),
    eps: known(EpsState::Ready),
    hands_off: known(false),
    ads: known(AdsState::Ready),
    ..Inputs::NEVER
};

/// The shortest time that the table allows wherever it can be shortened, ticks of 50 ms in all of them; and no remainder
/// in any ramp. Every value lies within its range: [`Sealed::new`] says so.
pub const SCALED: Config = Config {
    cycle_nominal: TICK,
    timeout_50: Millis::new(75),
    timeout_100: Millis::new(150),
    timeout_200: Millis::new(300),
    requalify: Millis::new(640),
    seat_confirm: Millis::new(200),
    seat_vacant: Millis::new(500),
    seat_freeze: Millis::new(100),
    epb_confirm: Millis::new(500),
    epb_speedless: Millis::new(5000),
    boot_settle: Millis::new(2000),
    shutdown_after: Millis::new(60_000),
    k4_deadline: Millis::new(200),
    k1_deadline: Millis::new(1000),
    level_gone: Millis::new(100),
    level_standstill: Millis::new(500),
    level_speedless: Millis::new(2000),
    level_least_speed: SpeedKmhQ8::new(512),
    brake_hold: Millis::new(50),
    brake_ramp: DecelMs2Q11::new(20480),
    lamp_delay: Millis::ZERO,
    pedal_tolerance: Percent::ZERO,
    idle_torque: Percent::new(20),
    torque_ramp: PercentPerS::new(1000),
    hill_hold: Millis::new(100),
    notice_time: Millis::new(1000),
    steering_rate: Row([
        RateDeciDegS::new(4000),
        RateDeciDegS::new(3200),
        RateDeciDegS::new(1600),
        RateDeciDegS::new(800),
        RateDeciDegS::new(400),
        RateDeciDegS::new(200),
        RateDeciDegS::new(120),
    ]),
    takeover_time: TICK,
    steering_fade: PercentPerS::new(1000),
    response_drive: Millis::new(200),
    response_brake: Row([Millis::new(200); 3]),
    response_retarder: Millis::new(100),
    response_gear: Millis::new(200),
    response_steering: Row([TICK; 2]),
    response_age: Millis::ZERO,
    response_overshoot: Millis::new(100),
    response_speed: SpeedKmhQ8::new(5120),
    bypass_hold: Millis::new(500),
    fault_free: Millis::new(1000),
    ..Config::DEFAULT
};

/// Idle in every channel, in every cycle.
pub fn idle() -> Commands {
    Outputs::NEUTRAL.as_commands()
}

/// The alphabet under construction.
pub struct Alphabet {
    config: Config,
    vectors: Vec<Vector>,
}

impl Alphabet {
    /// Empty.
    pub const fn new(config: &Config) -> Self {
        Self { config: *config, vectors: Vec::new() }
    }

    /// Adds a vector; one that reads the same as an earlier one is left out.
    pub fn add(&mut self, name: &str, edit: impl FnOnce(&mut Vector)) {
        let mut vector = Vector {
            name: name.to_owned(),
            elapsed: TICK,
            inputs: HEALTHY,
            scene: Scene::clear(),
            threat: Threat::CLEAR,
            commands: idle(),
            holds: false,
        };
        edit(&mut vector);
        vector.threat = perceive(&vector.scene, &self.config);
        let same = |other: &Vector| {
            (other.elapsed, &other.inputs, &other.scene, &other.commands)
                == (vector.elapsed, &vector.inputs, &vector.scene, &vector.commands)
        };
        if let Some(other) = self.vectors.iter_mut().find(|other| same(other)) {
            other.holds |= vector.holds;
        } else {
            self.vectors.push(vector);
        }
    }

    /// The vectors.
    pub fn done(self) -> Vec<Vector> {
        self.vectors
    }
}

/// A named difference.
pub type Edit = (&'static str, fn(&mut Vector));

/// Every combination of one edit of each list.
pub fn product(alphabet: &mut Alphabet, dimensions: &[&[Edit]], holds: fn(&Vector) -> bool) {
    let mut combinations: Vec<Vec<Edit>> = vec![Vec::new()];
    for dimension in dimensions {
        let with = |before: &Vec<Edit>| {
            dimension.iter().map(|edit| before.iter().copied().chain([*edit]).collect()).collect::<Vec<Vec<Edit>>>()
        };
        combinations = combinations.iter().flat_map(with).collect();
    }
    for combination in combinations {
        let name: Vec<&str> = combination.iter().map(|(name, _)| *name).filter(|name| !name.is_empty()).collect();
        alphabet.add(&name.join(", "), |vector| {
            for (_, edit) in &combination {
                edit(vector);
            }
            vector.holds = holds(vector);
        });
    }
}

/// Both speeds.
pub fn speed(vector: &mut Vector, raw: u16) {
    vector.inputs.wheel_speed = known(SpeedKmhQ8::new(raw));
    vector.inputs.motor_speed = known(SpeedKmhQ8::new(raw));
}

/// Both seat sensors.
pub fn seat(vector: &mut Vector, [first, second]: [Option<Seat>; 2]) {
    let signal = |seat: Option<Seat>| seat.map_or(Signal::NEVER, Signal::Known);
    vector.inputs.seat = [signal(first), signal(second)];
}
