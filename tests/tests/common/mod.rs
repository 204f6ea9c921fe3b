//! A bus on the bench: healthy inputs to change one at a time, a clock to step, and the claims that hold always.
//!
//! Every step of every test goes through [`Bus::step`], and [`always::Oracle`] judges it there.
#![expect(dead_code, reason = "each test file uses a part of the bench")]

pub mod always;
pub mod named;
pub mod random;
pub mod stages;
pub mod words;

pub use supervisor::*;
pub use words::*;

/// Never called: keeps the expectation above fulfilled also where a file uses the whole bench.
fn _unused() {}

/// Nominal cycle.
pub const CYCLE: u32 = 10;

/// A supervisor, what it reads, and what the main controller asks for.
#[derive(Clone, Debug)]
pub struct Bus {
    supervisor: Supervisor,
    /// Time of the last step.
    pub now: u32,
    /// What the supervisor reads; stays until changed.
    pub inputs: Inputs,
    /// What radar and camera see; stays until changed.
    pub scene: Scene,
    /// What the main controller asks for; a fresh frame in every cycle until changed.
    pub commands: Commands,
    /// What was decided last.
    pub last: Option<Decision>,
    /// Steering and drive do what they are told; else they stay where the test puts them.
    pub follows: bool,
    drives: bool,
    sealed: Sealed,
    oracle: always::Oracle,
}

/// Starting.
impl Bus {
    /// After a reset, nothing stepped yet: these inputs, a clear road, a correct and idle main controller.
    pub fn boot(cause: ResetCause, record: Option<Record>, inputs: Inputs) -> Self {
        Self::with_config(&Config::DEFAULT, cause, record, inputs)
    }

    /// The same with another configuration.
    pub fn with_config(config: &Config, cause: ResetCause, record: Option<Record>, inputs: Inputs) -> Self {
        let Ok(sealed) = Sealed::new(*config) else { unreachable!("the test's configuration is valid") };
        Self::with_sealed(&sealed, cause, record, inputs)
    }

    /// The same with sealed bytes.
    pub fn with_sealed(sealed: &Sealed, cause: ResetCause, record: Option<Record>, inputs: Inputs) -> Self {
        Self {
            supervisor: Supervisor::new(*sealed, cause, record),
            sealed: *sealed,
            last: None,
            now: 1_000,
            follows: true,
            drives: false,
            inputs,
            scene: Scene::clear(),
            commands: Outputs::NEUTRAL.as_commands(),
            oracle: always::Oracle::NEW,
        }
    }
}

/// Time.
impl Bus {
    /// One cycle of 10 ms.
    pub fn step(&mut self) -> Decision {
        self.step_by(CYCLE)
    }

    /// One cycle after this many milliseconds.
    pub fn step_by(&mut self, elapsed: u32) -> Decision {
        let decision = self.step_unjudged(elapsed);
        self.oracle.judge(self.now, &self.inputs, &self.commands, &decision);
        decision
    }

    /// One cycle that the oracle does not judge (it goes on from the next): for faults inside the supervisor.
    pub fn step_unjudged(&mut self, elapsed: u32) -> Decision {
        self.now = self.now.wrapping_add(elapsed);
        let decision = self.supervisor.step(Millis::new(self.now), &self.inputs, &self.scene, &self.commands);
        self.last = Some(decision);
        if self.follows {
            self.follow(&decision.outputs);
        }
        decision
    }

    /// Steering while it acts, and the drive while it drives, do as they are told.
    fn follow(&mut self, outputs: &Outputs) {
        if outputs.steering.enable && self.inputs.steering_angle.known().is_some() {
            self.inputs.steering_angle = known(outputs.steering.angle);
        }
        let drives = outputs.drive.torque > Percent::ZERO;
        if (drives || self.drives) && self.inputs.executed_torque.known().is_some() {
            self.inputs.executed_torque = known(outputs.drive.torque);
        }
        self.drives = drives;
    }

    /// Steps of 10 ms for this long; the last decision.
    pub fn run_for(&mut self, span: u32) -> Decision {
        self.run_with(span, CYCLE, |_| {})
    }

    /// Steps of 50 ms, the longest legal cycle: for minutes.
    pub fn run_coarse(&mut self, span: u32) -> Decision {
        self.run_with(span, 50, |_| {})
    }

    /// Steps of `cycle` for `span`, and looks at each decision.
    pub fn run_with(&mut self, span: u32, cycle: u32, mut look: impl FnMut(&Decision)) -> Decision {
        assert!(span >= cycle, "at least one step");
        let mut decision = self.step_by(cycle);
        look(&decision);
        for _ in 1..(span / cycle) {
            decision = self.step_by(cycle);
            look(&decision);
        }
        decision
    }

    /// Steps of `cycle` until `reached`: milliseconds since the first of these steps; `None` after `limit`.
    pub fn time_until(&mut self, cycle: u32, limit: u32, reached: impl Fn(&Decision) -> bool) -> Option<u32> {
        (0..=limit / cycle).map(|count| count * cycle).find(|_| reached(&self.step_by(cycle)))
    }

    /// What it remembers, decoded.
    pub fn state(&self) -> Option<State> {
        self.supervisor.image().decode()
    }

    /// Its configuration.
    pub const fn sealed(&self) -> &Sealed {
        &self.sealed
    }

    /// The retained words, for fault injection.
    pub fn with_image(&self, change: impl Fn(StateImage) -> StateImage) -> Self {
        let image = change(*self.supervisor.image());
        Self { supervisor: self.supervisor.clone().with_image(image), oracle: self.oracle.anew(), ..self.clone() }
    }

    /// A reset between two cycles: the record is what the last decision asked to persist, the clock starts anew.
    pub fn reset(&self, cause: ResetCause) -> Self {
        let record = self.last.map(|decision| decision.status.record);
        self.reset_with(cause, record)
    }

    /// The same with another record; `None` fails its CRC.
    pub fn reset_with(&self, cause: ResetCause, record: Option<Record>) -> Self {
        Self {
            supervisor: Supervisor::new(self.sealed, cause, record),
            now: 0,
            last: None,
            oracle: always::Oracle::NEW,
            ..self.clone()
        }
    }

    /// The retained state changed in place, through its words.
    pub fn with_state(&self, change: impl Fn(State) -> State) -> Self {
        self.with_image(|image| match image.decode() {
            Some(state) => StateImage::encode(&change(state)),
            None => image,
        })
    }

    /// How many words of fault injection the image offers: words and complements.
    pub const fn image_words() -> usize {
        STATE_WORDS * 2
    }

    /// The last output vector, vetted again, changes nothing (SELF-2c).
    pub fn assert_idempotent(decision: &Decision) {
        let (again, verdicts) = vet(&decision.envelope, &decision.outputs.as_commands());
        assert_eq!(again, decision.outputs, "SELF-2c: vetting an output changes nothing");
        for (channel, verdict) in verdicts.iter() {
            assert!(verdict.passed(), "SELF-2b: inside the envelope it passes: {channel:?} {verdict:?}");
        }
    }
}

/// Setting inputs.
impl Bus {
    /// Both speeds.
    pub fn speed(&mut self, speed: SpeedKmhQ8) {
        self.inputs.wheel_speed = known(speed);
        self.inputs.motor_speed = known(speed);
    }

    /// The lower and the higher of the two speeds.
    pub fn speeds(&mut self, low: SpeedKmhQ8, high: SpeedKmhQ8) {
        self.inputs.wheel_speed = known(high);
        self.inputs.motor_speed = known(low);
    }

    /// Speed unknown: one of the two is stale.
    pub fn speed_unknown(&mut self) {
        self.inputs.motor_speed = STALE;
    }

    /// Both seat sensors.
    pub fn seat(&mut self, first: Signal<Seat>, second: Signal<Seat>) {
        self.inputs.seat = [first, second];
    }

    /// Both sensors known vacant.
    pub fn vacant(&mut self) {
        self.seat(known(Seat::Vacant), known(Seat::Vacant));
    }

    /// Both sensors known occupied.
    pub fn occupied(&mut self) {
        self.seat(known(Seat::Occupied), known(Seat::Occupied));
    }

    /// The driver sits down and is confirmed.
    pub fn driver_returns(&mut self) -> Decision {
        self.occupied();
        let decision = self.run_for(1_010);
        assert_eq!(decision.status.occupancy, Occupancy::Confirmed);
        decision
    }

    /// Accelerator, both tracks.
    pub fn accelerator(&mut self, travel: Pedal250) {
        self.inputs.accelerator = [known(travel); 2];
    }

    /// Brake pedal, both tracks and the switch.
    pub fn brake_pedal(&mut self, travel: Pedal250) {
        self.inputs.brake_pedal = [known(travel); 2];
        self.inputs.brake_switch = known(travel > Pedal250::ZERO);
    }

    /// The gearbox takes a gear that selector and main controller ask for; anything else it is found in.
    pub fn engage(&mut self, gear: Signal<Gear>) {
        let request = match gear.known() {
            Some(Gear::Drive) => GearRequest::Drive,
            Some(Gear::Reverse) => GearRequest::Reverse,
            Some(Gear::Neutral) => GearRequest::Neutral,
            Some(Gear::Park) => GearRequest::Park,
            None => GearRequest::Hold,
        };
        if gear.known().is_some() {
            self.inputs.selector = gear;
        }
        let before = self.commands.gear;
        self.ask_gear(request);
        self.step();
        self.commands.gear = before;
        self.inputs.gear = gear;
    }

    /// Drive and auxiliaries confirmed stopped, no current.
    pub fn loads_stopped(&mut self) {
        self.inputs.drive_stopped = known(true);
        self.inputs.auxiliaries_stopped = known(true);
        self.inputs.hv_current = known(CurrentDeciA::ZERO);
        self.inputs.executed_torque = known(Percent::ZERO);
    }

    /// Drive and auxiliaries not stopped.
    pub fn loads_run(&mut self) {
        self.inputs.drive_stopped = known(false);
        self.inputs.auxiliaries_stopped = known(false);
        self.inputs.hv_current = known(CurrentDeciA::new(400));
    }

    /// One radar object, instead of those before; the camera's stay.
    pub fn ahead(&mut self, object: RadarObject) {
        self.scene.radar.clear();
        assert!(self.scene.radar.push(object).is_ok());
    }

    /// One radar object and the camera object that matches it, instead of those before.
    pub fn ahead_matched(&mut self, object: RadarObject, class: Class) {
        (self.scene.radar, self.scene.camera) = Default::default();
        self.add_matched(object, class);
    }

    /// One radar object more, and the camera object that matches it if it lies in the picture.
    pub fn add_matched(&mut self, object: RadarObject, class: Class) {
        assert!(self.scene.radar.push(object).is_ok());
        if let Some(picture) = picture_of(&object, &body_of(class)) {
            assert!(self.scene.camera.push(picture).is_ok());
        }
    }

    /// An empty road, known.
    pub fn road_clear(&mut self) {
        self.scene = Scene::clear();
    }

    /// The radar is lost.
    pub fn perception_unknown(&mut self) {
        self.scene.radar_known = false;
    }
}

/// Asking, as the main controller.
impl Bus {
    /// Drive torque of the driver.
    pub fn ask_torque(&mut self, torque: u8) {
        self.commands.drive = Command::Fresh(driver_torque(torque));
    }

    /// Drive torque of the driver assistance, active flag set.
    pub fn ask_adas(&mut self, torque: u8) {
        self.commands.drive =
            Command::Fresh(DriveTorque { torque: percent(torque), active: true, origin: Origin::Adas });
    }

    /// Service brake.
    pub fn ask_brake(&mut self, total: DecelMs2Q11) {
        self.commands.brake = Command::Fresh(braking(total));
    }

    /// Gear.
    pub fn ask_gear(&mut self, gear: GearRequest) {
        self.commands.gear = Command::Fresh(gear);
    }

    /// Parking brake.
    pub fn ask_epb(&mut self, request: EpbRequest) {
        self.commands.epb = Command::Fresh(ParkingBrake { request, mode: EpbMode::Automatic });
    }

    /// Contactors.
    pub fn ask_contactors(&mut self, k4: ContactorRequest, k1: ContactorRequest) {
        self.commands.contactors = Command::Fresh(Contactors { k4, k1 });
    }
}
