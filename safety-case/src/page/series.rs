//! The curves of the page: which there are, in which row, how they are read.

use supervisor::{ClosingCmS, Command, DecelMs2Q11, Origin, Pedal250, Percent, Signal, SpeedKmhQ8};

use crate::cycle::Cycle;

/// A row of curves, from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Row {
    /// Speed.
    Speed,
    /// Distance of the deciding object.
    Distance,
    /// Its time to collision, in the same row on the right.
    Collision,
    /// Deceleration.
    Deceleration,
    /// Drive torque and pedals.
    Torque,
    /// Steering angle.
    Steering,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stroke {
    /// What went out, or was measured.
    Strong,
    /// What was asked for.
    Dashed,
    /// A bound, or a second source.
    Thin,
    /// A second source.
    Dotted,
    /// An obligation: the area below it is shaded.
    Area,
}

/// A curve.
#[derive(Clone, Copy, Debug)]
pub struct Series {
    /// The row.
    pub row: Row,
    /// For the legend and on hover.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Colour.
    pub colour: &'static str,
    /// Stroke.
    pub stroke: Stroke,
    /// The value in a cycle.
    pub read: fn(&Cycle<'_>) -> Option<f64>,
}

/// Times to collision beyond this are not drawn.
const FAR: f64 = 12.0;

fn kmh(speed: SpeedKmhQ8) -> f64 {
    f64::from(speed.raw()) / 256.0
}
fn decel(decel: DecelMs2Q11) -> f64 {
    f64::from(decel.raw()) / 2048.0
}
fn percent(percent: Percent) -> f64 {
    f64::from(percent.raw())
}
fn pedal(pedal: Pedal250) -> f64 {
    f64::from(pedal.raw()) * 0.4
}

fn asked<T>(command: Command<T>) -> Option<T> {
    match command {
        Command::Fresh(value) | Command::Held(_, value) => Some(value),
        Command::Absent | Command::Rejected(_) => None,
    }
}

/// The greater of two tracks that are known.
fn deepest([first, second]: [Signal<Pedal250>; 2]) -> Option<f64> {
    first.known().max(second.known()).map(pedal)
}

fn time_to_collision(cycle: &Cycle<'_>) -> Option<f64> {
    let object = cycle.threat.object.filter(|object| object.closing > ClosingCmS::ZERO)?;
    let time = f64::from(object.distance.raw()) / f64::from(object.closing.raw());
    (time <= FAR).then_some(time)
}

fn permitted_torque(cycle: &Cycle<'_>) -> f64 {
    let torque = &cycle.decision.envelope.torque;
    let by_driver = asked(cycle.commands.drive).is_none_or(|drive| drive.origin == Origin::Driver);
    percent(if by_driver { torque.driver.most } else { torque.automated.most })
}

const BLUE: &str = "#1d4e89";
const ORANGE: &str = "#e07a1f";
const RED: &str = "#c1293b";
const GREEN: &str = "#2e8b57";
const GREY: &str = "#8a94a3";
const TEAL: &str = "#0f8b8d";
const VIOLET: &str = "#7b5ea7";

macro_rules! series {
    ($($row:ident $name:literal $unit:literal $colour:ident $stroke:ident: |$cycle:ident| $value:expr;)*) => {
        /// Every curve, row by row.
        pub const SERIES: &[Series] = &[$(Series {
            row: Row::$row, name: $name, unit: $unit, colour: $colour, stroke: Stroke::$stroke, read: |$cycle| $value,
        },)*];
    };
}

series! {
    Speed "target speed asked" "km/h" ORANGE Dashed: |c| asked(c.commands.target_speed).map(kmh);
    Speed "target speed given" "km/h" TEAL Thin: |c| asked(c.commands.target_speed).map(|_| kmh(c.decision.outputs.target_speed));
    Speed "motor speed" "km/h" GREY Dotted: |c| c.inputs.motor_speed.known().map(kmh);
    Speed "wheel speed" "km/h" BLUE Strong: |c| c.inputs.wheel_speed.known().map(kmh);
    Distance "distance of the deciding object" "m" BLUE Strong: |c| c.threat.object.map(|object| f64::from(object.distance.raw()) / 100.0);
    Collision "time to collision" "s" VIOLET Dashed: |c| time_to_collision(c);
    Deceleration "most that is permitted" "m/s²" GREEN Thin: |c| Some(decel(c.decision.envelope.brake.cap.most));
    Deceleration "least that is obliged" "m/s²" RED Area: |c| Some(decel(c.decision.envelope.brake.floor.most));
    Deceleration "deceleration measured" "m/s²" GREY Dotted: |c| c.inputs.deceleration.known().map(decel);
    Deceleration "deceleration asked" "m/s²" ORANGE Dashed: |c| asked(c.commands.brake).map(|brake| decel(brake.total));
    Deceleration "deceleration given" "m/s²" BLUE Strong: |c| Some(decel(c.decision.outputs.brake.total));
    Torque "torque permitted" "%" GREEN Thin: |c| Some(permitted_torque(c));
    Torque "accelerator" "%" TEAL Thin: |c| deepest(c.inputs.accelerator);
    Torque "brake pedal" "%" RED Dotted: |c| deepest(c.inputs.brake_pedal);
    Torque "torque executed" "%" GREY Dotted: |c| c.inputs.executed_torque.known().map(percent);
    Torque "torque asked" "%" ORANGE Dashed: |c| asked(c.commands.drive).map(|drive| percent(drive.torque));
    Torque "torque given" "%" BLUE Strong: |c| Some(percent(c.decision.outputs.drive.torque));
    Steering "angle measured" "°" GREY Dotted: |c| c.inputs.steering_angle.known().map(|angle| f64::from(angle.raw()) / 10.0);
    Steering "angle asked" "°" ORANGE Dashed: |c| asked(c.commands.steering).filter(|steering| steering.enable).map(|steering| f64::from(steering.angle.raw()) / 10.0);
    Steering "angle given" "°" BLUE Strong: |c| Some(c.decision.outputs.steering).filter(|steering| steering.enable).map(|steering| f64::from(steering.angle.raw()) / 10.0);
}
