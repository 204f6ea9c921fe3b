//! Slice 2: collision mitigation, warnings and brake.

use std::error::Error;

use supervisor_core::{
    AngleDeciDeg, ClosingCmS, Config, Count, DecelMs2Q11, DistanceCm, EpbState, Millis, OffsetCm, Outputs, Pedal250,
    Record, ResetCause, Sealed, ServiceBrake, Signal, SpeedKmhQ8,
};
use supervisor_perceive::{CameraObject, Class, PixelBox, RadarObject, Scene};

use crate::checks;
use crate::model::{Exploration, Promise, Start, TICK, Vector};
use crate::plant::Plant;
use crate::report::Slice;
use crate::vectors::{Alphabet, Edit, SCALED, known, product, speed};

/// A radar object in the lane that was seen often enough: at 10 m/s, a metre is a tenth of a second.
fn ahead(vector: &mut Vector, distance: u16, closing: i16) {
    vector.scene = Scene::clear();
    let object = RadarObject {
        distance: DistanceCm::new(distance),
        offset: OffsetCm::ZERO,
        closing: ClosingCmS::new(closing),
        age: Millis::ZERO,
        updates: Count::new(3),
    };
    // One object fits every list.
    let _ = vector.scene.radar.push(object);
}

/// A pedestrian, matched: the box of 50 by 170 cm at 30 m, as the camera of the default calibration sees it.
fn pedestrian(vector: &mut Vector) {
    ahead(vector, 3000, 1000);
    let pixels = PixelBox { left: 630, top: 360, width: 20, height: 67 };
    let (distance, closing) = (DistanceCm::new(3000), ClosingCmS::new(1000));
    let _ = vector.scene.camera.push(CameraObject {
        pixels,
        class: Class::Pedestrian,
        distance,
        closing,
        age: Millis::ZERO,
    });
}

/// Level 1 straight ahead.
pub fn level_1(vector: &mut Vector) {
    ahead(vector, 4399, 1000);
}

const CLEAR: Edit = ("clear", |_| {});
const LEVEL_1: Edit = ("level 1", level_1);
const LEVEL_2: Edit = ("level 2", |vector| ahead(vector, 3600, 1000));
const LEVEL_3: Edit = ("level 3", |vector| ahead(vector, 2700, 1000));
const LOST: Edit = ("radar lost", |vector| vector.scene.radar_known = false);
/// Just beside each threshold, and what warns only.
const ROADS: &[Edit] = &[
    ("ahead, closing, no level", |vector| ahead(vector, 4400, 1000)),
    ("ahead, not closing", |vector| ahead(vector, 4399, 0)),
    ("just no level 2", |vector| ahead(vector, 3601, 1000)),
    ("just no level 3", |vector| ahead(vector, 2701, 1000)),
    ("pedestrian", pedestrian),
];

fn angle(vector: &mut Vector, raw: i16) {
    vector.inputs.steering_angle = known(AngleDeciDeg::new(raw));
}

const ANGLES: &[Edit] = &[
    ("69.9 degrees", |vector| angle(vector, 699)),
    ("-79.9 degrees", |vector| angle(vector, -799)),
    ("80 degrees", |vector| angle(vector, 800)),
    ("-90 degrees", |vector| angle(vector, -900)),
    ("60 degrees", |vector| angle(vector, 600)),
    ("-70 degrees", |vector| angle(vector, -700)),
    ("80.1 degrees", |vector| angle(vector, 801)),
    ("-90.1 degrees", |vector| angle(vector, -901)),
    ("angle unknown", |vector| vector.inputs.steering_angle = Signal::NEVER),
];

const ROLLS: Edit = ("2 km/h", |vector| speed(vector, 512));

/// The main controller asks for full braking all the time: the cap is what lets it through.
fn brakes(vector: &mut Vector) {
    let brake = ServiceBrake { total: DecelMs2Q11::new(20480), ..ServiceBrake::NEUTRAL };
    vector.commands = Outputs { brake, ..Outputs::NEUTRAL }.as_commands();
}

fn exploration(name: &'static str, plant: Option<Plant>, vectors: Vec<Vector>) -> Result<Exploration, Box<dyn Error>> {
    let ends = Promise {
        name: "every level ends in its time of continuous standstill",
        most: u16::try_from(SCALED.level_standstill.raw() / TICK.raw())? + 1,
        waits: |cycle| {
            let stands = [cycle.inputs.wheel_speed, cycle.inputs.motor_speed]
                .into_iter()
                .all(|speed| speed.known().is_some_and(|speed| speed < cycle.config.standstill_speed));
            stands && cycle.new.mitigation.running()
        },
    };
    Ok(Exploration {
        name,
        sealed: Sealed::new(SCALED)?,
        config: SCALED,
        starts: vec![Start { cause: ResetCause::PowerOn, record: Some(Record::None), plant }],
        vectors,
        fine: 1,
        promises: vec![ends],
        checks: checks::every(),
    })
}

/// Road, speed, steering and pedal as they please.
fn levels() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    let speeds: &[Edit] = &[
        ROLLS,
        ("just below 2 km/h", |vector| speed(vector, 511)),
        ("stands", |vector| speed(vector, 76)),
        ("speed unknown", |vector| vector.inputs.wheel_speed = Signal::NEVER),
    ];
    // 59.9 degrees: just below the angle of every entry.
    let base: &[Edit] = &[("", |vector| angle(vector, 599))];
    product(&mut alphabet, &[base, &[CLEAR, LEVEL_1, LEVEL_2, LEVEL_3, LOST], speeds], |vector| {
        vector.inputs.wheel_speed.known().is_none() && vector.scene.radar.is_empty()
    });
    product(&mut alphabet, &[base, ROADS, &[ROLLS]], |_| false);
    product(&mut alphabet, &[&[LEVEL_1, LEVEL_2, LEVEL_3], &[ROLLS], ANGLES], |_| false);
    let measured: &[Edit] = &[
        // 10² / (2 · (36 − 1)) m/s² stops it before the margin.
        ("brakes just not enough", |vector| vector.inputs.deceleration = known(DecelMs2Q11::new(2925))),
        ("brakes enough", |vector| vector.inputs.deceleration = known(DecelMs2Q11::new(2926))),
        ("brakes implausibly", |vector| vector.inputs.deceleration = known(DecelMs2Q11::new(20481))),
    ];
    product(&mut alphabet, &[base, &[LEVEL_2], &[ROLLS], measured], |_| false);
    let feet: &[Edit] = &[
        ("brake pressed", |vector| {
            vector.inputs.brake_switch = known(true);
            vector.inputs.brake_pedal = [known(Pedal250::new(11)); 2];
        }),
        ("brake pedal unknown", |vector| vector.inputs.brake_switch = Signal::NEVER),
        ("parking brake applied", |vector| vector.inputs.epb = known(EpbState::Applied)),
        ("asks for full braking", brakes),
    ];
    product(&mut alphabet, &[base, &[CLEAR], &[ROLLS], feet], |_| false);
    exploration("levels", None, alphabet.done())
}

/// The object stays or goes, and everything cooperates: the bus comes to rest, and the level ends.
fn braking() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    product(&mut alphabet, &[&[CLEAR, LEVEL_1, LEVEL_2, LEVEL_3]], |_| true);
    let mut exploration = exploration("braking", Some(Plant::rolling(1280)), alphabet.done())?;
    exploration.promises.push(Promise {
        // From 5 km/h at no less than 1 m/s², and the time at standstill.
        name: "every level ends: by its object, or at rest",
        most: 29 + u16::try_from(SCALED.level_standstill.raw() / TICK.raw())? + 1,
        waits: |cycle| cycle.new.mitigation.running(),
    });
    Ok(exploration)
}

/// Brakes that fall short: the retarder helps, then the parking brake.
fn falling_short() -> Result<Exploration, Box<dyn Error>> {
    let config = Config { response_speed: SpeedKmhQ8::new(512), ..SCALED };
    let mut alphabet = Alphabet::new(&config);
    let measured: &[Edit] = &[
        ("does not slow down", |_| {}),
        ("5 m/s²", |vector| vector.inputs.deceleration = known(DecelMs2Q11::new(10240))),
        ("ABS at work", |vector| vector.inputs.abs = known(true)),
        ("EBS red", |vector| vector.inputs.ebs_red = known(true)),
    ];
    product(&mut alphabet, &[&[CLEAR, LEVEL_1, LEVEL_3], &[ROLLS], measured], |_| false);
    let mut exploration = exploration("falling short", None, alphabet.done())?;
    (exploration.sealed, exploration.config) = (Sealed::new(config)?, config);
    Ok(exploration)
}

/// The modes that this slice must reach.
pub const COVERS: &[&str] = &[
    "mitigation.one",
    "mitigation.two",
    "mitigation.three",
    "mitigation.hold",
    "mitigation.permitted",
    "mitigation.forward",
    "mitigation.pedestrian",
    "monitors.helps",
    "monitors.emergency",
    "mitigation.gone",
    "mitigation.standstill",
    "mitigation.speedless",
    "monitors.short",
    "monitors.brake.command",
];

/// MIT-1a, MIT-1b, MIT-2a, MIT-2b, MIT-3a, MIT-3b, MIT-4a to MIT-4h, MIT-5a, MIT-6b, MIT-6c, MIT-7a, MIT-7b, FCW-1a, PCW-1a, PHB-1a,
/// PHB-1b, RSP-1k, EPB-1b: collision mitigation, every mode of it reached; a level ends in its time after standstill.
#[test]
fn collision_mitigation_warnings_brake() -> Result<(), Box<dyn Error>> {
    Slice {
        name: "collision",
        explorations: vec![levels()?, braking()?, falling_short()?],
        covers: COVERS,
        unreachable: &[],
    }
    .run()
}
