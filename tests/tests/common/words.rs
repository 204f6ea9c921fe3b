//! Small words of the tests: values from the units of the specification, changes, and questions to a decision.

use super::*;
use supervisor_tests::road::{Body as Solid, Camera};

/// A known signal.
pub const fn known<T>(value: T) -> Signal<T> {
    Signal::Known(value)
}

/// A stale signal.
pub const STALE: Signal<SpeedKmhQ8> = Signal::Unknown(Cause::Stale);

/// A signal unknown for this cause.
pub const fn unknown<T>(cause: Cause) -> Signal<T> {
    Signal::Unknown(cause)
}

/// Whole km/h.
pub const fn kmh(speed: u16) -> SpeedKmhQ8 {
    SpeedKmhQ8::new(speed * 256)
}

/// 1/256 km/h.
pub const fn kmh_q8(speed: u16) -> SpeedKmhQ8 {
    SpeedKmhQ8::new(speed)
}

/// 1.5 km/h, exactly.
pub const KMH_1_5: SpeedKmhQ8 = SpeedKmhQ8::new(384);
/// The highest speed below 0.3 km/h (76.8 / 256).
pub const STANDSTILL: SpeedKmhQ8 = SpeedKmhQ8::new(76);
/// The lowest speed that is not standstill.
pub const ROLLING: SpeedKmhQ8 = SpeedKmhQ8::new(77);

/// One bit less.
pub const fn bit_below(speed: SpeedKmhQ8) -> SpeedKmhQ8 {
    SpeedKmhQ8::new(speed.raw() - 1)
}

/// Hundredths of a m/s², rounded up to the next bit.
pub const fn ms2(hundredths: u16) -> DecelMs2Q11 {
    // 2048/100 = 512/25: fits u16 up to 1.27 m/s² only, so in halves of u32.
    let raw = (u32_of(hundredths) * 2048).div_ceil(100);
    DecelMs2Q11::new(low_half(raw))
}

const fn u32_of(value: u16) -> u32 {
    let [low, high] = value.to_le_bytes();
    u32::from_le_bytes([low, high, 0, 0])
}
const fn low_half(value: u32) -> u16 {
    let [low, high, _, _] = value.to_le_bytes();
    u16::from_le_bytes([low, high])
}

/// Percent.
pub const fn percent(value: u8) -> Percent {
    Percent::new(value)
}

/// Pedal travel in per cent; even numbers are exact.
pub const fn travel(per_cent: u8) -> Pedal250 {
    Pedal250::new(per_cent / 2 * 5)
}

/// Pedal travel in bits of 0.4 %.
pub const fn travel_bits(bits: u8) -> Pedal250 {
    Pedal250::new(bits)
}

/// Steering-wheel angle, 0.1°.
pub const fn angle(deci_deg: i16) -> AngleDeciDeg {
    AngleDeciDeg::new(deci_deg)
}

/// Torque of the driver's hands, 1/1024 Nm.
pub const fn hand_torque(q10: i16) -> TorqueNmQ10 {
    TorqueNmQ10::new(q10)
}

/// A driver's request for drive torque.
pub const fn driver_torque(torque: u8) -> DriveTorque {
    DriveTorque { torque: Percent::new(torque), active: false, origin: Origin::Driver }
}

/// A request for deceleration as a correct controller makes it.
pub const fn braking(total: DecelMs2Q11) -> ServiceBrake {
    ServiceBrake { total, electric: DecelMs2Q11::ZERO, mode: BrakeMode::Maximum, priority: Priority::Medium }
}

/// A request for automatic steering at angle 0, inside every bound.
pub const STEER: Steering = Steering {
    enable: true,
    angle: AngleDeciDeg::ZERO,
    rate: RateDeciDegS::new(100),
    overlay: TorqueNmQ10::ZERO,
    weight: Percent::FULL,
    bar_limit: BarTorque50mNm::new(60),
};

/// An object ahead on the path, seen often by the radar alone, just measured.
pub const fn object(distance: u16, closing: i16) -> RadarObject {
    RadarObject {
        distance: DistanceCm::new(distance),
        offset: OffsetCm::ZERO,
        closing: ClosingCmS::new(closing),
        age: Millis::ZERO,
        updates: Count::new(50),
    }
}

/// 10 m/s.
pub const TEN: i16 = 1_000;

/// An object at this time to collision, closing with 10 m/s: the distance in cm is the time in ms.
pub const fn at(milliseconds: u16) -> RadarObject {
    object(milliseconds, TEN)
}

/// A camera object whose box matches nothing.
pub fn camera_object(distance: u16, closing: i16) -> CameraObject {
    CameraObject {
        pixels: PixelBox::default(),
        class: Class::Object,
        distance: DistanceCm::new(distance),
        closing: ClosingCmS::new(closing),
        age: Millis::ZERO,
    }
}

/// What the camera sees of a radar object of this body, at the same time: its box by the bus model's own camera.
/// `None` outside the picture.
pub fn picture_of(object: &RadarObject, body: &Solid) -> Option<CameraObject> {
    let metres = |cm: f64| cm / 100.0;
    let (gap, offset) = (metres(object.distance.raw().into()), metres(object.offset.raw().into()));
    let RadarObject { distance, closing, age, .. } = *object;
    let pixels = Camera::STRAIGHT.pixels(body, gap, offset)?;
    Some(CameraObject { pixels, class: body.class, distance, closing, age })
}

/// The body whose size the supervisor assumes for a class.
pub const fn body_of(class: Class) -> Solid {
    match class {
        Class::Unclassified | Class::Object => Solid { class, ..Solid::CAR },
        Class::Pedestrian => Solid::PEDESTRIAN,
    }
}

/// Key on, driver seated, parking brake applied, neutral, standing, high voltage closed, every group healthy.
pub const fn healthy() -> Inputs {
    Inputs {
        seat: [known(Seat::Occupied); 2],
        wheel_speed: known(SpeedKmhQ8::ZERO),
        motor_speed: known(SpeedKmhQ8::ZERO),
        accelerator: [known(Pedal250::ZERO); 2],
        brake_pedal: [known(Pedal250::ZERO); 2],
        brake_switch: known(false),
        steering_angle: known(AngleDeciDeg::ZERO),
        driver_torque: known(TorqueNmQ10::ZERO),
        selector: known(Gear::Neutral),
        gear: known(Gear::Neutral),
        epb: known(EpbState::Applied),
        epb_switch: known(EpbSwitch::Idle),
        epb_mode: known(EpbMode::Automatic),
        key: known(Key::On),
        cruise_switch: known(false),
        driver_set: known(false),
        k1: known(Contact::Closed),
        k4: known(Contact::Closed),
        hv_current: known(CurrentDeciA::new(100)),
        drive_stopped: known(false),
        auxiliaries_stopped: known(false),
        drive_limit: known(Percent::FULL),
        executed_torque: known(Percent::ZERO),
        electric_limit: known(ms2(200)),
        friction_limit: known(ms2(600)),
        electric_actual: known(DecelMs2Q11::ZERO),
        mass: known(Mass10Kg::new(1_500)),
        axle_pressure: [known(Pressure5KPa::ZERO); 2],
        deceleration: known(DecelMs2Q11::ZERO),
        abs: known(false),
        asr: known(false),
        stability: known(false),
        ebs_red: known(false),
        ebs_amber: known(false),
        xbr_status: known(XbrStatus::Allowed),
        eps: known(EpsState::Ready),
        hands_off: known(false),
        ads: known(AdsState::Standby),
        foreign: Channels::NONE,
        second_sender: false,
    }
}

/// A contactor confirmed open.
pub const OPEN: Signal<Contact> = known(Contact::Open);
/// A contactor confirmed closed.
pub const CLOSED: Signal<Contact> = known(Contact::Closed);
/// A contactor without feedback.
pub const MISSING: Signal<Contact> = unknown(Cause::Stale);

/// A change of a bus, by name.
pub type Change = (&'static str, Edit);
/// A change of a bus.
pub type Edit = fn(&mut Bus);
/// A place to begin at.
pub type Make = fn() -> Bus;
/// A question to a decision.
pub type Ask = fn(&Decision) -> bool;

/// Guards of K4, each lost in a way of its own (SEAT-7b, SEAT-7c, SEAT-7d), by name.
pub const K4_GUARDS: [Change; 8] = [
    ("SEAT-7b rolling", |bus| bus.speed(ROLLING)),
    ("SEAT-7b one speed rolling", |bus| bus.speeds(STANDSTILL, ROLLING)),
    ("SEAT-7b speed unknown", Bus::speed_unknown),
    ("SEAT-7c brake unknown", |bus| bus.inputs.epb = unknown(Cause::Stale)),
    ("SEAT-7c brake not available", |bus| bus.inputs.epb = unknown(Cause::NotAvailable)),
    ("SEAT-7d torque", |bus| bus.inputs.executed_torque = known(percent(3))),
    ("SEAT-7d torque unknown", |bus| bus.inputs.executed_torque = unknown(Cause::Stale)),
    ("SEAT-7d torque implausible", |bus| bus.inputs.executed_torque = known(percent(101))),
];

/// Every cause of unknown.
pub const CAUSES: &[Cause] = Cause::ALL;

/// Every level that obliges.
pub const LEVELS: [Level; 3] = [Level::One, Level::Two, Level::Three];

/// What a level demands.
pub const fn demand(level: Level) -> DecelMs2Q11 {
    match level {
        Level::None => ms2(0),
        Level::One => ms2(100),
        Level::Two => ms2(250),
        Level::Three => ms2(500),
    }
}

/// A step of the driver's restart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Act {
    /// Sit down and be confirmed.
    Sit,
    /// Key Off.
    Off,
    /// Key On.
    On,
    /// Key Start.
    Start,
}

/// Leave runs.
pub fn in_leave(decision: &Decision) -> bool {
    decision.status.occupancy == Occupancy::Leave
}

/// The parking brake is commanded to apply, in the mode in which it obeys.
pub fn applies(decision: &Decision) -> bool {
    decision.outputs.epb == ParkingBrake { request: EpbRequest::Apply, mode: EpbMode::Automatic }
}

/// The parking brake is commanded to release.
pub fn released(decision: &Decision) -> bool {
    decision.outputs.epb.request == EpbRequest::Release
}

/// K4 is commanded open.
pub fn opens_k4(decision: &Decision) -> bool {
    decision.outputs.contactors.k4 == ContactorRequest::Open
}

/// K1 is commanded open.
pub fn opens_k1(decision: &Decision) -> bool {
    decision.outputs.contactors.k1 == ContactorRequest::Open
}

/// Neither is commanded open.
pub fn opens_nothing(decision: &Decision) -> bool {
    !opens_k4(decision) && !opens_k1(decision)
}

/// Either is commanded to close.
pub fn closes(decision: &Decision) -> bool {
    let Contactors { k4, k1 } = decision.outputs.contactors;
    k4 == ContactorRequest::Close || k1 == ContactorRequest::Close
}

/// The channel's verdict is this, for this reason.
#[track_caller]
pub fn assert_verdict(decision: &Decision, channel: Channel, kind: Kind, reason: Reason) {
    let verdict = decision.verdicts.of(channel);
    assert_eq!((verdict.kind, verdict.reason), (kind, reason), "{channel:?}: {verdict:?}");
}

/// The channel's command went out unchanged.
#[track_caller]
pub fn assert_passed(decision: &Decision, channel: Channel) {
    let verdict = decision.verdicts.of(channel);
    assert!(verdict.passed(), "{channel:?}: {verdict:?}");
}

/// The channel's command did not go out unchanged.
#[track_caller]
pub fn assert_refused(decision: &Decision, channel: Channel) {
    let verdict = decision.verdicts.of(channel);
    assert!(!verdict.passed(), "{channel:?}: {verdict:?}");
}
