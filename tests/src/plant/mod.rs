//! The bus: a deterministic longitudinal model, 1 ms inside, that obeys the supervisor's outputs and produces what
//! its sensors say.
//!
//! One mass on a slope; drive, electric and friction brake, retarder, parking brake; gearbox, contactors, loads;
//! a driver with hands and feet; obstacles seen by radar and camera. No noise: two runs are the same to the last
//! bit (IEEE 754 sums and products only).

mod parameters;
mod parts;
mod sense;
mod stage;
mod truth;

pub use parameters::Parameters;
pub use parts::{DeadTime, Lag, Mover, STEP_S};
pub use truth::{Ahead, Hands, Truth};

use supervisor::{
    BrakeMode, ContactorRequest, DrivingMode, EpbRequest, EpbState, Gear, GearRequest, Outputs, RetarderMode,
};

use crate::bend::{Bend, Pose, curvature};
use crate::driver::{Driver, Script};
use crate::misdeed::Deed;
use crate::number::nearest;
use crate::road::Obstacle;
use crate::sensing::Eyes;

/// Gravity, in m/s².
const GRAVITY: f64 = 9.81;
/// How fast hands turn the steering wheel, in degrees per millisecond (own: 300°/s).
const WHEEL_PER_MS: f64 = 0.3;
/// No wheel slips below this speed, in m/s (own), and the brake system reports it for this much longer, in ms (own).
const SLIP_LEAST: f64 = 1.0;
/// See [`SLIP_LEAST`].
const SLIP_HOLD_MS: u32 = 300;
/// Milliseconds of the model in one cycle of the supervisor.
pub const CYCLE_MS: u32 = 10;

/// Half-width of the corridor ahead of the bus, in m: half of its width, and a hand's breadth (own).
pub const CORRIDOR_M: f64 = 1.5;

/// The bus, its driver and its road.
#[derive(Clone, Debug)]
pub struct Plant<'a> {
    parameters: Parameters,
    now_ms: u32,
    driver: Driver<'a>,
    road: Vec<Obstacle>,
    eyes: Eyes,
    position: f64,
    speed: f64,
    acceleration: f64,
    measured_deceleration: Lag,
    drive: Lag,
    dead: DeadTime,
    friction: Lag,
    electric: Lag,
    retarder: Lag,
    /// Deceleration by all brakes.
    braked: f64,
    angle: f64,
    epb: Mover<EpbState>,
    gear: Mover<Gear>,
    k1: Mover<bool>,
    k4: Mover<bool>,
    /// Milliseconds since K4 opened.
    unpowered_ms: u32,
    current: Lag,
    steers: bool,
    automated: bool,
    bends: Vec<Bend>,
    /// So long the wheels count as slipping, in ms.
    slips_ms: u32,
    /// What fails in this cycle.
    pushes: bool,
    fades: bool,
}

impl<'a> Plant<'a> {
    /// Parked: parking brake applied, neutral, both contactors open.
    #[must_use]
    pub fn new(parameters: Parameters, script: Script<'a>, road: &[Obstacle]) -> Self {
        let dead = usize::try_from(nearest(parameters.brake_dead_s / STEP_S)).unwrap_or(0);
        Self {
            parameters,
            now_ms: 0,
            driver: Driver::new(script),
            road: road.to_vec(),
            eyes: Eyes::new(road.len()),
            position: 0.0,
            speed: 0.0,
            acceleration: 0.0,
            measured_deceleration: Lag::default(),
            drive: Lag::default(),
            dead: DeadTime::new(dead),
            friction: Lag::default(),
            electric: Lag::default(),
            retarder: Lag::default(),
            braked: 0.0,
            angle: 0.0,
            epb: Mover::new(EpbState::Applied),
            gear: Mover::new(Gear::Neutral),
            k1: Mover::new(false),
            k4: Mover::new(false),
            unpowered_ms: parameters.auxiliaries_stop_ms,
            current: Lag::default(),
            steers: false,
            automated: false,
            bends: Vec::new(),
            slips_ms: 0,
            pushes: false,
            fades: false,
        }
    }

    /// The vehicle fails in the next cycle; what only the main controller does is nothing here.
    pub fn suffer(&mut self, deed: Deed) {
        self.pushes |= deed == Deed::DrivePushes;
        self.fades |= deed == Deed::BrakesFade;
        if deed == Deed::K4DropsOut {
            self.k4.aim(false, self.parameters.contactor_open_ms);
        }
    }

    /// One cycle of 10 ms under these outputs.
    pub fn advance(&mut self, outputs: &Outputs) {
        self.command(outputs);
        for _ in 0..CYCLE_MS {
            self.now_ms += 1;
            self.driver.tick(self.now_ms, self.speed);
            self.tick(outputs);
            self.forget_behind();
            let (curvature, bends) = (curvature(self.angle), self.bends.as_slice());
            let pose = Pose { front: self.position, speed: self.speed, curvature, bends };
            self.eyes.sample(self.now_ms, &self.road, &pose, &self.parameters);
        }
        (self.pushes, self.fades) = (false, false);
    }

    /// Who steps onto the road beside or behind the front of the bus is not ahead of it.
    fn forget_behind(&mut self) {
        let (now_ms, front) = (self.now_ms, self.position);
        for obstacle in self.road.iter_mut().filter(|obstacle| obstacle.from_ms == now_ms) {
            if obstacle.rear(now_ms) <= front {
                obstacle.until_ms = now_ms;
            }
        }
    }

    /// Requests that set something in motion.
    fn command(&mut self, outputs: &Outputs) {
        let p = &self.parameters;
        match outputs.epb.request {
            EpbRequest::None => {}
            EpbRequest::Apply => self.epb.aim(EpbState::Applied, p.parking_ms),
            EpbRequest::Release => self.epb.aim(EpbState::Released, p.parking_ms),
        }
        let gear = match outputs.gear {
            GearRequest::Hold => None,
            GearRequest::Drive => Some(Gear::Drive),
            GearRequest::Reverse => Some(Gear::Reverse),
            GearRequest::Neutral => Some(Gear::Neutral),
            GearRequest::Park => Some(Gear::Park),
        };
        if let Some(gear) = gear {
            self.gear.aim(gear, p.gearbox_ms);
        }
        for (contactor, request) in [(&mut self.k1, outputs.contactors.k1), (&mut self.k4, outputs.contactors.k4)] {
            match request {
                ContactorRequest::Hold => {}
                ContactorRequest::Open => contactor.aim(false, p.contactor_open_ms),
                ContactorRequest::Close => contactor.aim(true, p.contactor_close_ms),
            }
        }
        self.automated = outputs.mode == DrivingMode::Automated;
        self.steers = outputs.steering.enable && outputs.steering.weight.raw() > 0;
        if self.steers {
            let step = f64::from(outputs.steering.rate.raw()) / 10.0 * f64::from(CYCLE_MS) / 1000.0;
            let target = f64::from(outputs.steering.angle.raw()) / 10.0;
            self.angle += (target - self.angle).clamp(-step, step);
        }
    }

    /// One millisecond of physics.
    fn tick(&mut self, outputs: &Outputs) {
        let p = self.parameters;
        self.epb.tick();
        self.gear.tick();
        self.k1.tick();
        self.k4.tick();
        let powered = self.k1.position() && self.k4.position();
        self.unpowered_ms = if powered { 0 } else { self.unpowered_ms.saturating_add(1) };

        // Drive: only with high voltage, and in the direction of the gear.
        let direction = match self.gear.position() {
            Gear::Drive => 1.0,
            Gear::Reverse => -1.0,
            Gear::Neutral | Gear::Park => 0.0,
        };
        let told = f64::from(outputs.drive.torque.raw()) / 100.0;
        let given = if self.pushes { told.max(0.5) } else { told };
        let asked = if powered && direction != 0.0 { given } else { 0.0 };
        let drive_force = self.drive.follow(asked.min(self.ceiling()), p.drive_lag_s) * p.full_force_n * direction;

        if let (false, Some(goal)) = (self.steers, self.driver.wheel) {
            self.angle += (goal - self.angle).clamp(-WHEEL_PER_MS, WHEEL_PER_MS);
        }

        let braking = self.on_the_road(outputs);
        self.braked = braking;
        let traction = drive_force * self.speed - p.mass_kg * self.electric.value() * self.speed.abs();
        let auxiliaries = if powered { p.auxiliaries_w } else { 0.0 };
        let power = if powered { traction + auxiliaries } else { 0.0 };
        self.current.follow(power / p.battery_v, 0.03);

        // Longitudinal balance; what brakes never reverses.
        let weight = p.mass_kg * GRAVITY;
        let pull = drive_force - weight * p.slope;
        let inertia = p.mass_kg * p.rotating;
        // The brake system closes the loop on the deceleration: it brakes the turning masses, too.
        let resist = weight * p.rolling + p.drag * self.speed * self.speed + inertia * braking;
        let before = self.speed;
        let free = before + pull / inertia * STEP_S;
        let loss = resist / inertia * STEP_S;
        self.speed = if free.abs() <= loss { 0.0 } else { free - loss * free.signum() };
        self.acceleration = (self.speed - before) / STEP_S;
        self.position += f64::midpoint(before, self.speed) * STEP_S;
        self.measured_deceleration.follow(-self.acceleration * before.signum(), 0.03);
    }

    /// Deceleration by all brakes, as far as the road takes it, in m/s².
    fn on_the_road(&mut self, outputs: &Outputs) -> f64 {
        let (asked, most) = (self.braking(outputs), self.parameters.grip * GRAVITY);
        let slips = asked > most && self.speed.abs() > SLIP_LEAST;
        self.slips_ms = if slips { SLIP_HOLD_MS } else { self.slips_ms.saturating_sub(1) };
        asked.min(most)
    }

    /// Torque that the power leaves, as a share of the greatest; may be beyond 1.
    fn ceiling(&self) -> f64 {
        let p = &self.parameters;
        p.full_power_w / (p.full_force_n * self.speed.abs().max(0.1))
    }

    /// Deceleration by all brakes, in m/s².
    fn braking(&mut self, outputs: &Outputs) -> f64 {
        let p = self.parameters;
        let request = f64::from(outputs.brake.total.raw()) / 2048.0;
        let pedal = self.driver.brake * 6.0;
        // J1939 XBR: the greater of both, or the sum, or the driver alone.
        let demand = match outputs.brake.mode {
            BrakeMode::Off => pedal,
            BrakeMode::Addition => pedal + request,
            BrakeMode::Maximum => pedal.max(request),
        };
        let demand = if self.fades { demand * 0.1 } else { demand };
        let share = (f64::from(outputs.brake.electric.raw()) / 2048.0).min(self.electric_limit()).min(demand);
        let electric = self.electric.follow(share, p.electric_lag_s);
        let delayed = self.dead.pass(demand);
        // The brake system closes the loop on the total: friction supplies what the electric part does not.
        let friction = self.friction.follow((delayed - electric).clamp(0.0, p.friction_decel), p.brake_lag_s);
        let wanted =
            if outputs.retarder.mode == RetarderMode::Off { 0.0 } else { f64::from(outputs.retarder.torque.raw()) };
        let turning = if self.speed.abs() > 1.0 { wanted / 100.0 * p.retarder_decel } else { 0.0 };
        let retarder = self.retarder.follow(turning, p.retarder_lag_s);
        let parking = match (self.epb.position(), self.epb.moving()) {
            (EpbState::Applied, false) => p.parking_decel,
            (EpbState::Applied | EpbState::Released, _) => 0.0,
        };
        electric + friction + retarder + parking
    }

    /// Electric deceleration available now, in m/s²: with high voltage, in gear, fading out below 10 km/h.
    fn electric_limit(&self) -> f64 {
        let coupled = matches!(self.gear.position(), Gear::Drive | Gear::Reverse);
        if self.k1.position() && self.k4.position() && coupled {
            self.parameters.electric_decel * ((self.speed.abs() * 3.6 - 3.0) / 7.0).clamp(0.0, 1.0)
        } else {
            0.0
        }
    }

    /// The truth of this moment.
    #[must_use]
    pub fn truth(&self) -> Truth {
        let gaps = self.road.iter().filter(|obstacle| obstacle.present(self.now_ms));
        let gap = gaps.map(|obstacle| obstacle.rear(self.now_ms) - self.position).reduce(f64::min);
        Truth {
            speed: self.speed,
            acceleration: self.acceleration,
            position: self.position,
            gap,
            seat: self.driver.seat(self.now_ms),
            epb: (!self.epb.moving()).then_some(self.epb.position()),
            gear: self.gear.position(),
            closed: [self.k1.position(), self.k4.position()],
            angle: self.angle,
            torque: self.drive.value(),
            braking: self.braked,
            current: self.current.value(),
            ahead: self.ahead(),
            hands: Hands {
                accelerator: self.driver.accelerator,
                brake: self.driver.brake,
                selector: self.driver.selector,
                epb_switch: self.driver.epb_switch,
                cruise: self.driver.cruise,
                set: self.driver.set,
            },
        }
    }

    fn ahead(&self) -> Option<Ahead> {
        let present = self.road.iter().filter(|obstacle| obstacle.present(self.now_ms));
        let in_path = present.filter(|obstacle| obstacle.offset.abs() <= CORRIDOR_M + obstacle.body.width / 2.0);
        let seen = in_path.map(|obstacle| Ahead {
            gap: obstacle.rear(self.now_ms) - self.position,
            closing: self.speed - obstacle.speed,
            class: obstacle.body.class,
        });
        seen.reduce(|nearest, next| if next.gap < nearest.gap { next } else { nearest })
    }
}
