//! Slice 3: torque, the driver's override, the automated mode, automatic steering.

use std::error::Error;

use supervisor_core::{
    AdsState, AngleDeciDeg, BarTorque50mNm, Channel, Channels, Command, DecelMs2Q11, DriveTorque, DrivingMode,
    EpsState, Gear, Millis, Origin, Outputs, Pedal250, Percent, RateDeciDegS, Record, ResetCause, Sealed, Seat,
    ServiceBrake, Signal, Steering, TorqueNmQ10,
};

use crate::checks;
use crate::model::{Exploration, Start, Vector};
use crate::report::Slice;
use crate::vectors::{Alphabet, Edit, SCALED, known, product, seat, speed};

/// Just below 20 km/h, from where on the brakes are compared: a slice of its own.
const ROLLING: u16 = 5119;

fn asks(vector: &mut Vector, origin: Origin, torque: u8, mode: DrivingMode) {
    let drive = DriveTorque { torque: Percent::new(torque), active: true, origin };
    vector.commands = Outputs { drive, mode, ..Outputs::NEUTRAL }.as_commands();
}

const ASSISTS: Edit = ("ADAS asks 40 %", |vector| asks(vector, Origin::Adas, 40, DrivingMode::Automated));
const COASTS: Edit = ("ADAS asks 0 %", |vector| asks(vector, Origin::Adas, 0, DrivingMode::Automated));
const MANUAL: Edit = ("driver asks 100 %", |vector| asks(vector, Origin::Driver, 100, DrivingMode::Manual));
const EPBI: Edit = ("EPBi asks 40 %", |vector| asks(vector, Origin::Epbi, 40, DrivingMode::Automated));

const ROLLS: Edit = ("", |vector| speed(vector, ROLLING));
/// What the drive executes is another exploration's.
const UNSEEN: Edit = ("", |vector| vector.inputs.executed_torque = Signal::NEVER);
const SET: Edit = ("set", |vector| vector.inputs.driver_set = known(true));
const NOT_SET: Edit = ("", |_| {});

fn pedal(vector: &mut Vector, raw: u8) {
    vector.inputs.accelerator = [known(Pedal250::new(raw)); 2];
}

/// Around every threshold: pressed at 4 %, override at 8 %, 40 % and 40 % + 10 %.
const PEDALS: &[Edit] = &[
    ("pedal 4 %", |vector| pedal(vector, 10)),
    ("pedal 8 %", |vector| pedal(vector, 20)),
    ("pedal 8.4 %", |vector| pedal(vector, 21)),
    ("pedal 39.6 %", |vector| pedal(vector, 99)),
    ("pedal 40 %", |vector| pedal(vector, 100)),
    ("pedal 50 %", |vector| pedal(vector, 125)),
    ("pedal 50.4 %", |vector| pedal(vector, 126)),
    ("pedal unknown", |vector| vector.inputs.accelerator = [known(Pedal250::ZERO), Signal::NEVER]),
];

/// What ends the mode, and is over as soon as it is gone: one difference each.
const ENDS: &[Edit] = &[
    ("brake pedal", |vector| vector.inputs.brake_switch = known(true)),
    ("brake pedal unknown", |vector| vector.inputs.brake_switch = Signal::NEVER),
    ("cruise off", |vector| vector.inputs.cruise_switch = known(false)),
    ("cruise unknown", |vector| vector.inputs.cruise_switch = Signal::NEVER),
    ("ADS failed", |vector| vector.inputs.ads = known(AdsState::Failed)),
    ("speed unknown", |vector| vector.inputs.motor_speed = Signal::NEVER),
    ("radar lost", |vector| vector.scene.radar_known = false),
    ("brake command lost", |vector| vector.commands.brake = Command::Absent),
    ("mode command lost", |vector| vector.commands.mode = Command::Absent),
    ("slips", |vector| vector.inputs.asr = known(true)),
    ("neutral", |vector| vector.inputs.gear = known(Gear::Neutral)),
    ("drive limit 10 %", |vector| vector.inputs.drive_limit = known(Percent::new(10))),
];

/// What ends the mode and lasts.
const LASTING: &[Edit] = &[
    ("hands take over", |vector| vector.inputs.driver_torque = known(TorqueNmQ10::new(6145))),
    ("somebody else brakes", |vector| vector.inputs.foreign = Channels::NONE.with(Channel::ServiceBrake)),
    ("51 ms", |vector| vector.elapsed = Millis::new(51)),
    ("level 1 ahead", crate::collision::level_1),
    ("vacant", |vector| seat(vector, [Some(Seat::Vacant); 2])),
];

fn exploration(name: &'static str, vectors: Vec<Vector>) -> Result<Exploration, Box<dyn Error>> {
    Ok(Exploration {
        name,
        sealed: Sealed::new(SCALED)?,
        config: SCALED,
        starts: vec![Start { cause: ResetCause::PowerOn, record: Some(Record::None), plant: None }],
        vectors,
        fine: 1,
        promises: Vec::new(),
        checks: checks::every(),
    })
}

/// The driver sets the mode, overrides it, ends it; ADAS, EPBi and driver ask for torque.
fn modes() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    let base: &[Edit] = &[ROLLS];
    product(&mut alphabet, &[base, &[UNSEEN], &[ASSISTS, COASTS, MANUAL, EPBI], &[NOT_SET, SET]], |_| true);
    product(&mut alphabet, &[base, &[UNSEEN], &[ASSISTS, COASTS], PEDALS], |_| false);
    product(&mut alphabet, &[base, &[UNSEEN], &[MANUAL], &PEDALS[5..]], |_| false);
    product(&mut alphabet, &[base, &[UNSEEN], &[ASSISTS], ENDS], |_| false);
    exploration("modes", alphabet.done())
}

/// What ends the mode and lasts: leave, a level, a bypass, a takeover, a lost clock.
fn endings() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    product(&mut alphabet, &[&[ROLLS], &[UNSEEN], &[ASSISTS], &[NOT_SET, SET]], |_| true);
    product(&mut alphabet, &[&[ROLLS], &[UNSEEN], &[ASSISTS], LASTING], |_| false);
    exploration("endings", alphabet.done())
}

/// Torque against the brake on a hill, both pedals, a drive that disobeys.
fn torque() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    let hill: Edit = ("driver asks 100 % against the brake", |vector| {
        asks(vector, Origin::Driver, 100, DrivingMode::Manual);
        let brake = ServiceBrake { total: DecelMs2Q11::new(2048), ..ServiceBrake::NEUTRAL };
        vector.commands.brake = Command::Fresh(brake);
    });
    let speeds: &[Edit] =
        &[("just below 2 km/h", |vector| speed(vector, 511)), ("2 km/h", |vector| speed(vector, 512))];
    let pedals: &[Edit] = &[("pedal released", |_| {}), ("pedal 100 %", |vector| pedal(vector, 250))];
    let executed: &[Edit] =
        &[("drives 0 %", |_| {}), ("drives 100 %", |vector| vector.inputs.executed_torque = known(Percent::FULL))];
    product(&mut alphabet, &[speeds, &[MANUAL, hill], pedals, executed], |_| true);
    exploration("torque", alphabet.done())
}

/// Asks for automatic steering, or for none.
fn steers(vector: &mut Vector, enable: bool) {
    asks(vector, Origin::Adas, 0, DrivingMode::Automated);
    let weight = if enable { Percent::FULL } else { Percent::ZERO };
    let bar_limit = BarTorque50mNm::new(100);
    let asked = Steering { enable, weight, rate: RateDeciDegS::new(100), bar_limit, ..Steering::NEUTRAL };
    vector.commands.steering = Command::Fresh(asked);
}

/// Automatic steering: it fades in, is taken over, goes astray, loses its command.
fn steering() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    let commands: &[Edit] = &[
        ("steers", |vector| steers(vector, true)),
        ("does not steer", |vector| steers(vector, false)),
        ("steering command lost", |vector| {
            steers(vector, true);
            vector.commands.steering = Command::Absent;
        }),
    ];
    let wheels: &[Edit] = &[
        ("", |_| {}),
        ("set", |vector| vector.inputs.driver_set = known(true)),
        ("hands take over", |vector| vector.inputs.driver_torque = known(TorqueNmQ10::new(6145))),
        ("6 Nm", |vector| vector.inputs.driver_torque = known(TorqueNmQ10::new(6144))),
        ("wheel off by 4 degrees", |vector| vector.inputs.steering_angle = known(AngleDeciDeg::new(40))),
        ("power steering derated", |vector| vector.inputs.eps = known(EpsState::Derated)),
    ];
    product(&mut alphabet, &[&[ROLLS], commands, wheels], |_| true);
    exploration("steering", alphabet.done())
}

/// The modes that this slice must reach.
pub const COVERS: &[&str] = &[
    "drive.mode",
    "drive.exit",
    "drive.armed",
    "drive.release_needed",
    "drive.hill",
    "drive.notice",
    "brake.lost",
    "monitors.disobeys",
    "monitors.excess",
    "monitors.drive.command",
    "steering.acts",
    "steering.barred",
    "steering.astray",
    "steering.lost",
    "steering.takeover",
    "monitors.steering.still",
    "monitors.steering.off",
];

/// TRQ-1a, TRQ-1c, TRQ-2a, TRQ-2b, TRQ-3a, TRQ-4a, TRQ-4b, TRQ-5a, TRQ-5b, TRQ-6a, TRQ-6b, TRQ-7a, TRQ-7b, MODE-1a to MODE-1f,
/// SPD-1a, VLC-1d, STR-2a, RSP-1e, SELF-10c: torque, override and automated mode, every mode of them and every reason for its
/// end reached.
#[test]
fn torque_override_automated_mode() -> Result<(), Box<dyn Error>> {
    Slice {
        name: "drive",
        explorations: vec![modes()?, endings()?, torque()?, steering()?],
        covers: COVERS,
        unreachable: &[],
    }
    .run()
}
