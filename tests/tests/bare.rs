//! Bare frames permit nothing (E2E-1f, CMD-7d): from frames through the receiver to the decision.
//!
//! In every scenario bare EEC2 and ETC2 are on the bus too, as the last frames of each cycle: accelerator pressed, D
//! selected, D engaged.

mod common;
use common::*;
use supervisor::wire::{Fault, Frame, Message, Receiver, Refusal, Sender};

/// What happens to a frame of a sensor; false if it is lost.
type Spoil = fn(&mut Frame) -> bool;

/// EEC2: both tracks of J1939 pressed to 20 %.
const EEC2: Frame = Frame { id: 0x0CF0_0300, length: 8, data: [0xFD, 50, 255, 255, 50, 255, 255, 255] };
/// ETC2: selected gear in byte 1, current gear in byte 4; 126 is the first forward gear.
const ETC2: Frame = Frame { id: 0x18F0_0503, length: 8, data: [126, 255, 255, 126, 255, 255, 255, 255] };

const ALL: Spoil = |_| true;
const NO_ACCELERATOR: Spoil = |frame| frame.id != Message::Accelerator.id();
const NO_GEAR_STATUS: Spoil = |frame| frame.id != Message::GearStatus.id();
/// One bit is flipped.
const ACCELERATOR_BROKEN: Spoil = |frame| {
    frame.data[2] ^= u8::from(frame.id == Message::Accelerator.id());
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
}

impl Wired {
    /// The receiver has listened for 2 s: what it gets is qualified.
    fn new(bus: Bus, spoil: Spoil) -> Self {
        let (sensors, receiver) = (Sender::new(), Receiver::new(&Config::DEFAULT));
        let (begin, truth) = (bus.now - 2_000, bus.inputs);
        let mut wired = Self { bus, truth, sensors, receiver, spoil };
        for since in (0..=2_000).step_by(10) {
            let _ = wired.read(begin + since);
        }
        wired
    }

    fn read(&mut self, now: u32) -> Inputs {
        let Self { truth, sensors, receiver, spoil, .. } = self;
        sensors.encode_inputs(Millis::new(now), truth, &Scene::clear(), &mut |mut frame| {
            if spoil(&mut frame) {
                // A broken frame shows in the sample.
                let _ = receiver.accept(Millis::new(now), &frame);
            }
        });
        for bare in [EEC2, ETC2] {
            let refused = receiver.accept(Millis::new(now), &bare);
            assert_eq!(refused, Err(Refusal { message: None, fault: Fault::Identifier }), "CMD-7d: it is no input");
        }
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

/// E2E-1f, CMD-7d: the accelerator in EEC2 permits no torque; that of the protected frame does while its tracks agree.
#[test]
fn a_bare_accelerator_gives_no_torque() {
    let mut protected = on_the_road(20, ALL);
    assert!(protected.count(2_000, torque) > 150, "known and alike");
    assert_eq!(protected.bus.inputs.accelerator, [known(travel(20)); 2]);
    // Lost on the road: no torque once it has timed out (125 ms), whatever EEC2 says.
    protected.spoil = NO_ACCELERATOR;
    assert!(protected.count(200, torque) < 20);
    assert_eq!(protected.count(1_000, torque), 0);
    assert_eq!(protected.bus.inputs.accelerator, [unknown(Cause::Stale); 2]);

    let (pressed, released) = (known(travel(20)), known(travel(0)));
    for (tracks, spoil) in [
        ([pressed, pressed], NO_ACCELERATOR),
        ([pressed, pressed], ACCELERATOR_BROKEN),
        ([pressed, released], ALL),
        ([released, pressed], ALL),
        ([pressed, unknown(Cause::NotAvailable)], ALL),
        ([unknown(Cause::NotAvailable), pressed], ALL),
    ] {
        let mut wired = on_the_road(0, spoil);
        wired.truth.accelerator = tracks;
        wired.count(200, torque);
        assert_eq!(wired.count(2_000, torque), 0, "{:?}", wired.bus.inputs.accelerator);
        let decision = wired.step();
        assert_verdict(&decision, Channel::DriveTorque, Kind::Limit, Reason::AcceleratorUnknown);
        assert!(decision.status.faults.contains(Faults::ACCELERATOR_UNKNOWN));
    }
    // Released, EEC2 says pressed.
    assert_eq!(on_the_road(0, ALL).count(2_000, torque), 0);
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
    for spoil in [NO_ACCELERATOR, ACCELERATOR_BROKEN, NO_GEAR_STATUS, GEAR_STATUS_BROKEN] {
        let mut wired = pressed_anew(travel(20), spoil);
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

/// EBC1: brake switch on, pedal to the floor, neither ABS nor ASR at work.
const EBC1: Frame = Frame { id: 0x18F0_010B, length: 8, data: [0x40, 250, 255, 255, 255, 0, 255, 255] };
const NO_BRAKE_PEDAL: Spoil = |frame| frame.id != Message::BrakePedal1.id() && frame.id != Message::BrakePedal2.id();

/// E2E-1f, CMD-7d: a brake pedal pressed in EBC1 raises no cap; pressed in the protected frames it does.
#[test]
fn a_bare_brake_pedal_raises_no_cap() {
    let beyond = |decision: &Decision| decision.outputs.brake.total > Config::DEFAULT.comfort_cap;
    let braking = |spoil: Spoil, pedal: Pedal250| {
        let mut bus = Bus::driving(kmh(40));
        bus.brake_pedal(pedal);
        bus.ask_brake(ms2(600));
        Wired::new(bus, spoil)
    };
    let mut bare = braking(NO_BRAKE_PEDAL, travel(100));
    for _ in 0..100 {
        let now = Millis::new(bare.bus.now + CYCLE);
        assert!(bare.receiver.accept(now, &EBC1).is_ok(), "EBC1 is read, its pedal is not");
        assert!(!beyond(&bare.step()));
    }
    let Inputs { brake_switch, brake_pedal, .. } = bare.bus.inputs;
    assert!(brake_switch.known().is_none() && brake_pedal.iter().all(|track| track.known().is_none()));
    assert!(braking(ALL, travel(100)).count(1_000, beyond) > 90, "known, pressed");
    assert_eq!(braking(ALL, travel(0)).count(1_000, beyond), 0, "known, released");
}
