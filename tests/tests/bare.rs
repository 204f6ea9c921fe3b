//! Bare frames permit nothing (E2E-1f, CMD-7d): from frames through the receiver to the decision.
//!
//! In every scenario the gearbox also sends bare ETC2, as on the recorded bus: D selected, D engaged. Bare frames that
//! lie come as the last ones of each cycle.

mod common;
use common::*;
use supervisor::wire::{Fault, Frame, Message, Receiver, Refusal, Sender};

/// What happens to a frame of a sensor; false if it is lost.
type Spoil = fn(&mut Frame) -> bool;

/// ETC2 as on the recorded bus: selected gear in byte 1, current gear in byte 4, 126 is the first forward gear.
const ETC2: Frame = Frame { id: 0x18F0_0503, length: 8, data: [126, 255, 255, 126, 255, 255, 255, 255] };

const ALL: Spoil = |_| true;
const NO_ACCELERATOR_2: Spoil = |frame| frame.id != Message::Accelerator2.id();
const NO_EEC2: Spoil = |frame| frame.id != Message::Eec2.id();
const NO_GEAR_STATUS: Spoil = |frame| frame.id != Message::GearStatus.id();
/// EEC2 says in both tracks of J1939: pressed to 20 %.
const PRESSED: Frame = Frame { id: 0x0CF0_0300, length: 8, data: [0xFD, 50, 255, 255, 50, 255, 255, 255] };
/// One bit of the protected track, or of the protected gear, is flipped.
const ACCELERATOR_2_BROKEN: Spoil = |frame| {
    frame.data[2] ^= u8::from(frame.id == Message::Accelerator2.id());
    true
};
const GEAR_STATUS_BROKEN: Spoil = |frame| {
    frame.data[2] ^= u8::from(frame.id == Message::GearStatus.id());
    true
};

/// A bus whose inputs come in frames.
struct Wired {
    bus: Bus,
    /// What the sensors measure.
    truth: Inputs,
    sensors: Sender,
    receiver: Receiver,
    spoil: Spoil,
    /// What EEC2 says at the end of each cycle, against its sensor.
    lie: Option<Frame>,
}

impl Wired {
    /// The receiver has listened for 2 s: what it gets is qualified.
    fn new(bus: Bus, spoil: Spoil) -> Self {
        let (sensors, receiver) = (Sender::new(), Receiver::new(&Config::DEFAULT));
        let (begin, truth) = (bus.now - 2_000, bus.inputs);
        let mut wired = Self { bus, truth, sensors, receiver, spoil, lie: None };
        for since in (0..=2_000).step_by(10) {
            let _ = wired.read(begin + since);
        }
        wired
    }

    fn read(&mut self, now: u32) -> Inputs {
        let Self { truth, sensors, receiver, spoil, lie, .. } = self;
        sensors.encode_inputs(Millis::new(now), truth, &Scene::clear(), &mut |mut frame| {
            if spoil(&mut frame) {
                // A broken frame shows in the sample.
                let _ = receiver.accept(Millis::new(now), &frame);
            }
        });
        if let Some(frame) = lie {
            assert!(receiver.accept(Millis::new(now), frame).is_ok(), "what is bare has no wrong content");
        }
        let etc2 = receiver.accept(Millis::new(now), &ETC2);
        assert_eq!(etc2, Err(Refusal { message: None, fault: Fault::Identifier }), "CMD-7d: ETC2 is no input");
        *receiver.sample(Millis::new(now)).inputs
    }

    fn step(&mut self) -> Decision {
        self.bus.inputs = self.read(self.bus.now + CYCLE);
        let decision = self.bus.step();
        // The drive has done what it was told.
        self.truth.executed_torque = self.bus.inputs.executed_torque;
        decision
    }

    /// Cycles of 10 ms for this long; how many of them show it.
    fn count(&mut self, span: u32, shows: impl Fn(&Decision) -> bool) -> usize {
        (0..span / CYCLE).filter(|_| shows(&self.step())).count()
    }
}

fn torque(decision: &Decision) -> bool {
    decision.outputs.drive.torque > Percent::ZERO
}

/// At 20 km/h in D, the accelerator pressed this far, and the main controller asks for torque.
fn on_the_road(per_cent: u8, spoil: Spoil) -> Wired {
    let mut bus = Bus::driving(kmh(20));
    bus.accelerator(travel(per_cent));
    bus.ask_torque(10);
    Wired::new(bus, spoil)
}

/// E2E-1f, CMD-7d: torque needs both tracks of the accelerator, the bare one and the protected one of another ECU.
#[test]
fn one_track_of_the_accelerator_gives_no_torque() {
    let mut both = on_the_road(20, ALL);
    assert!(both.count(2_000, torque) > 150, "both known and alike");
    assert_eq!(both.bus.inputs.accelerator, [known(travel(20)); 2]);
    // Lost on the road: no torque once it has timed out (125 ms), and none until it has qualified anew.
    both.spoil = NO_ACCELERATOR_2;
    assert!(both.count(200, torque) < 20);
    assert_eq!(both.count(1_000, torque), 0);
    assert_eq!(both.bus.inputs.accelerator, [known(travel(20)), unknown(Cause::Stale)]);

    for (per_cent, spoil, lie) in [
        (20, NO_ACCELERATOR_2, None),
        (20, NO_ACCELERATOR_2, Some(PRESSED)),
        (20, NO_EEC2, None),
        (20, ACCELERATOR_2_BROKEN, None),
        (0, ALL, Some(PRESSED)),
        (100, ALL, Some(PRESSED)),
    ] {
        let mut wired = on_the_road(per_cent, spoil);
        wired.lie = lie;
        assert_eq!(wired.count(2_000, torque), 0, "{:?}", wired.bus.inputs.accelerator);
        let decision = wired.step();
        assert_verdict(&decision, Channel::DriveTorque, Kind::Limit, Reason::AcceleratorUnknown);
        assert!(decision.status.faults.contains(Faults::ACCELERATOR_UNKNOWN));
    }
}

/// E2E-1f, CMD-7d: the confirmed gear in ETC2 permits no torque; that of the protected frame does.
#[test]
fn a_bare_gear_gives_no_torque() {
    for spoil in [NO_GEAR_STATUS, GEAR_STATUS_BROKEN] {
        let mut wired = on_the_road(20, spoil);
        assert_eq!(wired.count(2_000, torque), 0);
        assert_verdict(&wired.step(), Channel::DriveTorque, Kind::Limit, Reason::GearDirection);
    }
    // The gearbox is in neutral, ETC2 says D.
    let mut wired = on_the_road(20, ALL);
    wired.truth.gear = known(Gear::Neutral);
    wired.count(200, torque);
    assert_eq!(wired.count(1_000, torque), 0);
}

/// E2E-1f, CMD-7d: a selector in ETC2 permits no gear; that of the protected frame does.
#[test]
fn a_bare_selector_gives_no_gear() {
    let asks_for_drive = |selected, spoil| {
        let mut bus = Bus::parked();
        bus.inputs.selector = known(selected);
        bus.ask_gear(GearRequest::Drive);
        Wired::new(bus, spoil)
    };
    let drive = |decision: &Decision| decision.outputs.gear == GearRequest::Drive;
    assert!(asks_for_drive(Gear::Drive, ALL).count(1_000, drive) > 0);
    assert_eq!(asks_for_drive(Gear::Neutral, ALL).count(1_000, drive), 0, "ETC2 says D");
    for (spoil, cause) in [(NO_GEAR_STATUS, Cause::NeverReceived), (GEAR_STATUS_BROKEN, Cause::EndToEnd)] {
        let mut wired = asks_for_drive(Gear::Drive, spoil);
        assert_eq!(wired.count(1_000, drive), 0);
        assert_eq!((wired.bus.inputs.selector, wired.bus.inputs.gear), (unknown(cause), unknown(cause)));
        assert_verdict(&wired.step(), Channel::Gear, Kind::Block, Reason::Selector);
    }
}

/// E2E-1f, CMD-7d: after parked-by-leave no bare frame releases the parking brake: neither gear nor accelerator.
#[test]
fn bare_frames_release_no_parking_brake() {
    let pressed_anew = |to, spoil| {
        let mut bus = Bus::returned();
        bus.ask_epb(EpbRequest::Release);
        let mut wired = Wired::new(bus, spoil);
        wired.truth.accelerator = [known(to); 2];
        wired
    };
    assert!(pressed_anew(travel(20), ALL).count(1_000, released) > 0);
    assert_eq!(pressed_anew(travel(0), ALL).count(1_000, released), 0, "it takes the accelerator");
    for (to, spoil, lie) in [
        (travel(20), NO_ACCELERATOR_2, None),
        (travel(20), NO_EEC2, None),
        (travel(20), ACCELERATOR_2_BROKEN, None),
        (travel(0), ALL, Some(PRESSED)),
        (travel(20), NO_GEAR_STATUS, None),
        (travel(20), GEAR_STATUS_BROKEN, None),
    ] {
        let mut wired = pressed_anew(to, spoil);
        wired.lie = lie;
        assert_eq!(wired.count(1_000, released), 0, "{:?} {:?}", wired.bus.inputs.accelerator, wired.bus.inputs.gear);
        assert_verdict(&wired.step(), Channel::ParkingBrake, Kind::Block, Reason::ParkedByLeave);
    }
    // The gearbox is in neutral, ETC2 says D.
    let mut wired = pressed_anew(travel(20), ALL);
    wired.truth.gear = known(Gear::Neutral);
    wired.truth.accelerator = [known(travel(0)); 2];
    assert_eq!(wired.count(500, released), 0);
    wired.truth.accelerator = [known(travel(20)); 2];
    assert_eq!(wired.count(1_000, released), 0);
}
