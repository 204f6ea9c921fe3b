//! Places to begin at: from the parked bus to the finished shutdown.

use super::*;

impl Bus {
    /// Key on, driver seated and confirmed, parking brake applied, neutral, standing, high voltage closed.
    pub fn parked() -> Self {
        let mut bus = Self::boot(ResetCause::PowerOn, Some(Record::None), healthy());
        bus.run_for(3_000);
        bus
    }

    /// Driver seated and confirmed, gear and selector D, parking brake released, at this speed.
    pub fn driving(speed: SpeedKmhQ8) -> Self {
        Self::driving_with(&Config::DEFAULT, speed)
    }

    /// The same with another configuration.
    pub fn driving_with(config: &Config, speed: SpeedKmhQ8) -> Self {
        let inputs = Inputs {
            gear: known(Gear::Drive),
            selector: known(Gear::Drive),
            epb: known(EpbState::Released),
            ..healthy()
        };
        let mut bus = Self::with_config(config, ResetCause::PowerOn, Some(Record::None), inputs);
        bus.speed(speed);
        bus.run_for(3_000);
        bus
    }

    /// [`driving`](Self::driving) in the automated mode, granted by cruise switch and set.
    pub fn automated(speed: SpeedKmhQ8) -> Self {
        Self::automated_with(&Config::DEFAULT, speed)
    }

    /// The same on a bus whose brake system has the longitudinal control (EPBi-VLC).
    pub fn automated_by_epbi(speed: SpeedKmhQ8) -> Self {
        Self::automated_with(&Config { longitudinal_mode: Count::new(1), ..Config::DEFAULT }, speed)
    }

    fn automated_with(config: &Config, speed: SpeedKmhQ8) -> Self {
        let mut bus = Self::driving_with(config, speed);
        bus.inputs.cruise_switch = known(true);
        bus.inputs.ads = known(AdsState::Ready);
        bus.step();
        bus.inputs.driver_set = known(true);
        bus.commands.mode = Command::Fresh(DrivingMode::Automated);
        bus.step();
        bus.inputs.driver_set = known(false);
        let decision = bus.step();
        assert_eq!(decision.status.mode, Mode::Automated, "the mode is granted by driver evidence");
        bus
    }

    /// [`automated`](Self::automated), and automatic steering acts with full weight at angle 0.
    pub fn steering(speed: SpeedKmhQ8) -> Self {
        let mut bus = Self::automated(speed);
        bus.commands.steering = Command::Fresh(STEER);
        bus.run_for(2_000);
        let decision = bus.step();
        assert_eq!(decision.outputs.steering.weight, Percent::FULL, "automatic steering has faded in");
        bus
    }

    /// Driving at this speed; then both sensors have been vacant for 2 s: leave runs.
    pub fn leave(speed: SpeedKmhQ8) -> Self {
        let mut bus = Self::driving(speed);
        bus.vacant();
        bus.run_for(2_010);
        assert_eq!(bus.step().status.occupancy, Occupancy::Leave, "leave runs after 2 s");
        bus
    }

    /// Stopped in leave, parking brake confirmed applied, gearbox in neutral, seat vacant.
    pub fn parked_by_leave() -> Self {
        let mut bus = Self::leave(kmh(5));
        bus.speed(kmh(0));
        let decision = bus.step();
        assert_eq!(decision.outputs.epb.request, EpbRequest::Apply);
        assert!(decision.status.parked_by_leave);
        bus.inputs.epb = known(EpbState::Applied);
        bus.step();
        bus.inputs.gear = known(Gear::Neutral);
        bus.inputs.executed_torque = known(percent(0));
        bus.step();
        bus
    }

    /// Parked by leave until the 10 minutes are over and K4 has been commanded open; its feedback is still closed.
    pub fn opening_k4() -> Self {
        let mut bus = Self::parked_by_leave();
        bus.run_coarse(600_100);
        assert_eq!(bus.step().outputs.contactors.k4, ContactorRequest::Open, "10 min are over");
        bus
    }

    /// K4 confirmed open; drive and auxiliaries have not stopped yet.
    pub fn opening_k1() -> Self {
        let mut bus = Self::opening_k4();
        bus.loads_run();
        bus.inputs.k4 = known(Contact::Open);
        bus.step();
        bus
    }

    /// Both contactors confirmed open after leave.
    pub fn down() -> Self {
        let mut bus = Self::opening_k1();
        bus.loads_stopped();
        assert_eq!(bus.step().outputs.contactors.k1, ContactorRequest::Open);
        bus.inputs.k1 = known(Contact::Open);
        bus.run_for(100);
        bus
    }

    /// [`down`](Self::down); the main controller asks to close both contactors, all the time.
    pub fn asking_to_close() -> Self {
        let mut bus = Self::down();
        bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Close);
        bus
    }

    /// The same after a complete restart by the driver.
    pub fn restarted() -> Self {
        let mut bus = Self::asking_to_close();
        for step in [Act::Sit, Act::Off, Act::Start] {
            bus.act(step);
        }
        bus
    }

    /// One step of the driver's restart, and a cycle.
    pub fn act(&mut self, act: Act) {
        match act {
            Act::Sit => {
                self.occupied();
                self.run_for(1_010);
            }
            Act::Off => self.inputs.key = known(Key::Off),
            Act::On => self.inputs.key = known(Key::On),
            Act::Start => self.inputs.key = known(Key::Start),
        }
        self.step();
    }

    /// Parked by leave, the driver is back and confirmed, K1 and K4 closed, D confirmed, accelerator not touched since.
    pub fn returned() -> Self {
        let mut bus = Self::parked_by_leave();
        bus.driver_returns();
        bus.inputs.selector = known(Gear::Drive);
        bus.inputs.gear = known(Gear::Drive);
        bus.step();
        bus
    }

    /// The same with the accelerator pressed anew: a release is legal.
    pub fn ready_to_release() -> Self {
        let mut bus = Self::returned();
        bus.accelerator(travel(20));
        bus.step();
        bus
    }

    /// Driving at 50 km/h with this object ahead, one cycle later.
    pub fn approaching(object: RadarObject) -> (Self, Decision) {
        let mut bus = Self::driving(kmh(50));
        bus.ahead(object);
        let decision = bus.step();
        (bus, decision)
    }

    /// The same, matched by the camera as this class.
    pub fn approaching_matched(object: RadarObject, class: Class) -> (Self, Decision) {
        let mut bus = Self::driving(kmh(50));
        bus.ahead_matched(object, class);
        let decision = bus.step();
        (bus, decision)
    }

    /// Driving at 50 km/h with a begun level; its object is still there.
    pub fn mitigating(level: Level) -> Self {
        let object = match level {
            Level::None => object(10_000, 0),
            Level::One => at(4_399),
            Level::Two => at(3_600),
            Level::Three => at(2_700),
        };
        let (bus, decision) = Self::approaching(object);
        assert_eq!(decision.status.level, level);
        bus
    }
}
