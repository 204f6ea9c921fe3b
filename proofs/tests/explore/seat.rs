//! Slice 1: seat, parking brake, high voltage.

use std::error::Error;

use supervisor_core::{
    Contact, ContactorRequest, Contactors, EpbRequest, EpbState, Gear, GearRequest, Key, Millis, Outputs, ParkingBrake,
    Pedal250, Record, ResetCause, Sealed, Seat, Signal, SpeedKmhQ8, Stage,
};
use supervisor_proofs::properties::Cycle;

use crate::checks;
use crate::model::{Exploration, Promise, Start, TICK, Vector};
use crate::plant::Plant;
use crate::report::Slice;
use crate::vectors::{Alphabet, Edit, SCALED, known, product, seat, speed};

const OCCUPIED: Option<Seat> = Some(Seat::Occupied);
const VACANT: Option<Seat> = Some(Seat::Vacant);

const SITS: Edit = ("occupied", |vector| seat(vector, [OCCUPIED; 2]));
const EMPTY: Edit = ("vacant", |vector| seat(vector, [VACANT; 2]));
const HALF: Edit = ("one sensor occupied", |vector| seat(vector, [OCCUPIED, VACANT]));
const NOT_KNOWN: Edit = ("seat unknown", |vector| seat(vector, [VACANT, None]));

/// What a bad main controller asks for all the time: release, drive, K1 open.
fn bad(vector: &mut Vector) {
    vector.commands = Outputs {
        epb: ParkingBrake { request: EpbRequest::Release, ..ParkingBrake::NEUTRAL },
        gear: GearRequest::Drive,
        contactors: Contactors { k4: ContactorRequest::Close, k1: ContactorRequest::Open },
        ..Outputs::NEUTRAL
    }
    .as_commands();
}

/// A main controller that wants high voltage back.
fn eager(vector: &mut Vector) {
    vector.commands = Outputs {
        epb: ParkingBrake { request: EpbRequest::Release, ..ParkingBrake::NEUTRAL },
        gear: GearRequest::Drive,
        contactors: Contactors { k4: ContactorRequest::Close, k1: ContactorRequest::Close },
        ..Outputs::NEUTRAL
    }
    .as_commands();
}

fn ticks(span: Millis) -> u16 {
    u16::try_from(span.raw().div_ceil(TICK.raw())).unwrap_or(u16::MAX)
}

fn exploration(name: &'static str, starts: Vec<Start>, vectors: Vec<Vector>) -> Result<Exploration, Box<dyn Error>> {
    let sealed = Sealed::new(SCALED)?;
    let checks = checks::every();
    Ok(Exploration { name, sealed, config: SCALED, starts, vectors, fine: 1, promises: Vec::new(), checks })
}

fn start(cause: ResetCause, record: Option<Record>, plant: Option<Plant>) -> Start {
    Start { cause, record, plant }
}

/// Just below 1.5 km/h.
fn slow_of(vector: &Vector) -> bool {
    vector.inputs.motor_speed.is(SpeedKmhQ8::new(383))
}

/// Sensors and brake as they please: who sits, how fast, whether the brake holds, in every combination and order.
fn leaving() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    let slow: Edit = ("just below 1.5 km/h", |vector| speed(vector, 383));
    let rolls: Edit = ("1.5 km/h", |vector| speed(vector, 384));
    let unmeasured: Edit = ("speed unknown", |vector| vector.inputs.motor_speed = Signal::NEVER);
    let applied: Edit = ("brake applied", |vector| vector.inputs.epb = known(EpbState::Applied));
    let released: Edit = ("brake released", |vector| vector.inputs.epb = known(EpbState::Released));
    let moving: Edit = ("brake unknown", |vector| vector.inputs.epb = Signal::NEVER);
    let always: &[Edit] = &[("", bad)];
    product(
        &mut alphabet,
        &[always, &[SITS, EMPTY, NOT_KNOWN], &[slow, rolls, unmeasured], &[released, applied]],
        |vector| {
            let applied = vector.inputs.epb.is(EpbState::Applied);
            let long = if applied { slow_of(vector) } else { vector.inputs.motor_speed.known().is_none() };
            vector.inputs.seat == [known(Seat::Vacant); 2] && long
        },
    );
    product(&mut alphabet, &[always, &[HALF], &[rolls], &[released]], |_| false);
    product(&mut alphabet, &[always, &[NOT_KNOWN], &[slow], &[moving]], |_| true);
    let starts = vec![
        start(ResetCause::PowerOn, Some(Record::None), None),
        start(ResetCause::Other, None, None),
        start(ResetCause::Watchdog, Some(Record::Leave), None),
    ];
    exploration("leaving", starts, alphabet.done())
}

/// Parked by leave, and everything cooperates: ten minutes, shutdown, the driver's return, restart, release.
fn shutdown() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    let keys: &[Edit] = &[
        ("key On", |vector| vector.inputs.key = known(Key::On)),
        ("key Off", |vector| vector.inputs.key = known(Key::Off)),
        ("key Start", |vector| vector.inputs.key = known(Key::Start)),
    ];
    let pedals: &[Edit] = &[
        ("pedal released", |vector| vector.inputs.accelerator = [known(Pedal250::new(10)); 2]),
        ("pedal pressed", |vector| vector.inputs.accelerator = [known(Pedal250::new(11)); 2]),
    ];
    let asks: &[Edit] = &[("asks to release, K1 open", bad), ("asks to release, to close", eager)];
    product(&mut alphabet, &[&[SITS, EMPTY, NOT_KNOWN], keys, pedals, asks], |vector| {
        let released = vector.inputs.accelerator == [known(Pedal250::new(10)); 2];
        vector.inputs.seat == [known(Seat::Vacant); 2] && vector.inputs.key.is(Key::On) && released
    });
    let parked = Plant { epb: Some(true), applies: true, ..Plant::rolling(0) };
    let starts = vec![
        start(ResetCause::PowerOn, Some(Record::None), Some(parked)),
        start(ResetCause::Watchdog, Some(Record::Leave), Some(parked)),
        start(ResetCause::Watchdog, Some(Record::HighVoltageDown), Some(parked)),
    ];
    let mut exploration = exploration("shutdown", starts, alphabet.done())?;
    exploration.promises = vec![
        Promise {
            name: "K1 and K4 are open within the deadlines from the begin of the shutdown",
            most: ticks(Millis::new(SCALED.k4_deadline.raw() + SCALED.k1_deadline.raw())),
            waits: |cycle| matches!(cycle.next.high_voltage.stage, Stage::OpeningK4 | Stage::OpeningK1),
        },
        Promise {
            name: "parked by leave and nobody confirmed: the parking brake is applied within its time",
            most: ticks(SCALED.epb_confirm),
            waits: unparked,
        },
    ];
    Ok(exploration)
}

/// Leave, or parked by leave with nobody confirmed, slow, and the brake not known to be applied.
fn unparked(cycle: &Cycle<'_>) -> bool {
    let kept = cycle.new.seat.leave || cycle.new.parking.by_leave && !cycle.new.seat.confirmed(cycle.config);
    kept && slow(cycle, cycle.config.epb_speed) && !cycle.inputs.epb.is(EpbState::Applied)
}

fn slow(cycle: &Cycle<'_>, limit: SpeedKmhQ8) -> bool {
    cycle.inputs.wheel_speed.known().is_some_and(|speed| speed < limit)
}

/// The bus rolls, the driver gets up, sits down, and everything cooperates: it comes to rest and is parked.
fn coming_to_rest() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    product(&mut alphabet, &[&[SITS, EMPTY, HALF, NOT_KNOWN], &[("", bad)]], |vector| {
        vector.inputs.seat == [known(Seat::Occupied); 2]
    });
    let rolling = |raw| start(ResetCause::PowerOn, Some(Record::None), Some(Plant::rolling(raw)));
    let mut exploration = exploration("coming to rest", vec![rolling(2560), rolling(500)], alphabet.done())?;
    exploration.promises = vec![
        Promise {
            // From 10 km/h at no less than 1.35 m/s², and the brake's time.
            name: "leave ends with the parking brake applied once the bus has come to rest",
            most: 42 + ticks(SCALED.epb_confirm),
            waits: |cycle| cycle.new.seat.leave && !cycle.inputs.epb.is(EpbState::Applied),
        },
        Promise {
            name: "leave and slow: the parking brake is applied within its time",
            most: ticks(SCALED.epb_confirm),
            waits: unparked,
        },
    ];
    Ok(exploration)
}

fn parked(vector: &mut Vector) {
    vector.inputs.epb = known(EpbState::Applied);
}

/// What latches and what clears: a clock that stumbles, contactors that move by themselves or do not follow.
fn latching() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    let clocks: &[Edit] = &[("", |_| {}), ("51 ms", |vector| vector.elapsed = Millis::new(51))];
    let keys: &[Edit] = &[
        ("key On", |vector| vector.inputs.key = known(Key::On)),
        ("key Off", |vector| vector.inputs.key = known(Key::Off)),
    ];
    let speeds: &[Edit] = &[("stands", |vector| speed(vector, 76)), ("just rolls", |vector| speed(vector, 77))];
    let alone: Edit = ("K4 open", |vector| vector.inputs.k4 = known(Contact::Open));
    let always: Edit = ("", |vector| {
        parked(vector);
        eager(vector);
    });
    product(&mut alphabet, &[&[always], clocks, keys, speeds], |vector| vector.elapsed == TICK);
    product(&mut alphabet, &[&[always], &[alone]], |_| true);
    exploration("latching", vec![start(ResetCause::PowerOn, Some(Record::None), None)], alphabet.done())
}

/// Contactors that do not follow: each deadline of the shutdown is missed, and reported.
fn overdue() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    let contacts: &[Edit] = &[
        ("both closed", |_| {}),
        ("K4 open", |vector| vector.inputs.k4 = known(Contact::Open)),
        ("both open", |vector| {
            vector.inputs.k4 = known(Contact::Open);
            vector.inputs.k1 = known(Contact::Open);
        }),
        ("K4 unknown", |vector| vector.inputs.k4 = Signal::NEVER),
    ];
    let gears: &[Edit] = &[
        ("neutral", |vector| vector.inputs.gear = known(Gear::Neutral)),
        ("reverse", |vector| {
            vector.inputs.gear = known(Gear::Reverse);
        }),
    ];
    product(&mut alphabet, &[&[("", parked)], &[("", bad)], &[EMPTY], contacts, gears], |vector| {
        vector.inputs.gear.is(Gear::Neutral)
            && vector.inputs.k1.is(Contact::Closed)
            && vector.inputs.k4.known().is_some()
    });
    // The vacancy may settle before the brake is known to be applied.
    let moving: Edit = ("brake unknown", |vector| vector.inputs.epb = Signal::NEVER);
    product(&mut alphabet, &[&[("", bad)], &[EMPTY], &[moving]], |_| false);
    exploration("overdue", vec![start(ResetCause::Watchdog, Some(Record::Leave), None)], alphabet.done())
}

/// The modes that this slice must reach.
pub const COVERS: &[&str] = &[
    "boot.pending",
    "parking.pedal",
    "high_voltage.stage",
    "high_voltage.restart",
    "high_voltage.key",
    "gear.direction",
    "seat.leave",
    "parking.by_leave",
    "parking.slow",
    "brake.slow",
    "monitors.loose",
    "latches.safe_state",
    "latches.contactor",
    "latches.off_seen",
    "boot.wait",
    "seat.occupied",
    "seat.vacant",
    "seat.unknown",
    "parking.unconfirmed",
    "parking.speedless",
    "high_voltage.parked",
    "high_voltage.k4_overdue",
    "high_voltage.k1_overdue",
    "monitors.bypass",
    "monitors.gear",
    "latches.quiet",
];

/// SEAT-1a, SEAT-3a, SEAT-4a to SEAT-4e, SEAT-5a to SEAT-5d, SEAT-6a to SEAT-6c, SEAT-7a to SEAT-7k, SEAT-8a to SEAT-8c, SEAT-9a,
/// SEAT-11a, HV-1a to HV-1d, SELF-7a, SELF-7b, SELF-9c: seat, parking brake and high voltage, every mode of them reached; K1 opens
/// within its deadline when everything cooperates, and leave ends with the parking brake applied.
#[test]
fn seat_parking_brake_high_voltage() -> Result<(), Box<dyn Error>> {
    Slice {
        name: "seat",
        explorations: vec![leaving()?, shutdown()?, coming_to_rest()?, latching()?, overdue()?],
        covers: COVERS,
        unreachable: &[],
    }
    .run()
}
