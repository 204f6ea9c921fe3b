//! Slice 1: seat, parking brake, high voltage.

use std::error::Error;

use supervisor_core::{
    Contact, EpbRequest, EpbState, Gear, Key, Outputs, ParkingBrake, Pedal250, Percent, Seat, Sealed, Signal,
};

use crate::model::{Exploration, Start, every_check};
use crate::report::Slice;
use crate::vectors::{Alphabet, Edit, SCALED, boots, known, product, seat, speed};

const OCCUPIED: Option<Seat> = Some(Seat::Occupied);
const VACANT: Option<Seat> = Some(Seat::Vacant);

const SEATS: &[Edit] = &[
    ("occupied", |vector| seat(vector, [OCCUPIED; 2])),
    ("vacant", |vector| seat(vector, [VACANT; 2])),
    ("one sensor occupied", |vector| seat(vector, [OCCUPIED, VACANT])),
    ("seat unknown", |vector| seat(vector, [VACANT, None])),
];
const SPEEDS: &[Edit] = &[
    ("stands", |vector| speed(vector, 76)),
    ("just below 1.5 km/h", |vector| speed(vector, 383)),
    ("1.5 km/h", |vector| speed(vector, 384)),
    ("speed unknown", |vector| vector.inputs.motor_speed = Signal::NEVER),
];
const BRAKES: &[Edit] = &[
    ("released", |vector| vector.inputs.epb = known(EpbState::Released)),
    ("applied", |vector| vector.inputs.epb = known(EpbState::Applied)),
    ("brake unknown", |vector| vector.inputs.epb = Signal::NEVER),
];

fn dangerous(vector: &mut crate::model::Vector) {
    let release = ParkingBrake { request: EpbRequest::Release, ..ParkingBrake::NEUTRAL };
    vector.commands = Outputs { epb: release, ..Outputs::NEUTRAL }.as_commands();
}

fn leave() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    product(&mut alphabet, &[&[("", dangerous)], SEATS, SPEEDS, BRAKES], |_| true);
    Ok(Exploration {
        name: "leave",
        sealed: Sealed::new(SCALED)?,
        config: SCALED,
        starts: boots().into_iter().map(|(cause, record)| Start { cause, record, plant: None }).collect(),
        vectors: alphabet.done(),
        fine: 1,
        promises: Vec::new(),
        checks: every_check(),
    })
}

/// Slice 1.
#[test]
fn seat_parking_brake_high_voltage() -> Result<(), Box<dyn Error>> {
    Slice { name: "seat", explorations: vec![leave()?], covers: &["boot.pending"], unreachable: &[] }.run()
}
