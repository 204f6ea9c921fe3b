//! A verdict's numbers in human units.
//!
//! The core gives value, limit and margin in the bits, or the code, of the field that the reason speaks of. Here
//! they become kilometres per hour, per cent, degrees, or names.

use supervisor::{BrakeMode, Channel, ContactorRequest, DrivingMode, EpbRequest, GearRequest, Kind, Reason, Verdict};

use crate::difference::{difference, rejection};
use crate::road::snake;
use crate::runs::Detail;
use crate::words;

/// What the numbers of a verdict are.
#[derive(Clone, Copy, Debug)]
pub enum Quantity {
    /// A physical quantity: unit, bits per unit, decimals that make sense.
    Number(&'static str, f64, usize),
    /// A code with a name.
    Name(fn(i32) -> String),
    /// The verdict has no numbers.
    Nothing,
}

/// Whether the limit bounds from above or from below.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// At most the limit.
    Most,
    /// At least the limit.
    Least,
}

macro_rules! name_of {
    ($type:ident) => {
        |code| {
            u8::try_from(code).ok().and_then($type::from_code).map_or_else(|| code.to_string(), |value| snake(&value))
        }
    };
}

fn on_off(code: i32) -> String {
    if code == 0 { "off" } else { "on" }.to_owned()
}

/// What the numbers of this verdict are.
#[must_use]
pub fn quantity(channel: Channel, verdict: &Verdict) -> Quantity {
    let decel = Quantity::Number("m/s²", 2048.0, 2);
    let percent = Quantity::Number("%", 1.0, 0);
    if matches!(verdict.reason, Reason::CommandLost | Reason::CommandRejected) {
        return Quantity::Nothing;
    }
    let passed = verdict.kind == Kind::Pass;
    match channel {
        Channel::DriveTorque | Channel::Retarder => percent,
        Channel::TargetSpeed => Quantity::Number("km/h", 256.0, 1),
        Channel::ServiceBrake if verdict.reason == Reason::BrakeMode => Quantity::Name(name_of!(BrakeMode)),
        Channel::ServiceBrake => decel,
        Channel::Steering => steering(verdict),
        Channel::Gear | Channel::ParkingBrake | Channel::Contactors | Channel::Auxiliaries if passed => {
            Quantity::Nothing
        }
        Channel::Warnings | Channel::Body | Channel::Mode if passed => Quantity::Nothing,
        Channel::Gear => Quantity::Name(name_of!(GearRequest)),
        Channel::ParkingBrake => Quantity::Name(name_of!(EpbRequest)),
        Channel::Contactors => Quantity::Name(name_of!(ContactorRequest)),
        Channel::Auxiliaries | Channel::Warnings | Channel::Body => Quantity::Name(on_off),
        Channel::Mode => Quantity::Name(name_of!(DrivingMode)),
    }
}

fn steering(verdict: &Verdict) -> Quantity {
    match (verdict.kind, verdict.reason) {
        (Kind::Pass, Reason::Within) if verdict.limit == 0 => Quantity::Nothing,
        (Kind::Pass, _) | (_, Reason::SteeringAngle) => Quantity::Number("°", 10.0, 1),
        (_, Reason::SteeringRate) => Quantity::Number("°/s", 10.0, 1),
        (_, Reason::SteeringOverlay) => Quantity::Number("Nm", 1024.0, 2),
        (_, Reason::BarTorque) => Quantity::Number("Nm", 20.0, 2),
        (Kind::Limit, Reason::SteeringWeight) => Quantity::Number("%", 1.0, 0),
        _ => Quantity::Name(on_off),
    }
}

/// Which side the limit is on, as the margin tells.
#[must_use]
pub fn side(verdict: &Verdict) -> Side {
    let below = i64::from(verdict.value) - i64::from(verdict.limit);
    if i64::from(verdict.margin) == below && below != 0 { Side::Least } else { Side::Most }
}

/// A raw number in its unit, without the unit.
#[must_use]
pub fn physical(raw: i32, per_unit: f64) -> f64 {
    f64::from(raw) / per_unit
}

/// A verdict in words: "LIMIT  asked 100, at most 16 % (margin −84): rising faster than the gradient [TRQ-5]".
#[must_use]
pub fn sentence(channel: Channel, detail: &Detail) -> String {
    let verdict = &detail.worst;
    let (why, requirement) = (words::reason(verdict.reason).0, words::requirement(channel, verdict.reason));
    let facts = facts(channel, detail);
    let colon = if facts.is_empty() { "" } else { ": " };
    format!("{:<10}  {facts}{colon}{why} [{requirement}]", words::kind(verdict.kind))
}

/// What was asked for and what went out, in words; empty if the verdict says nothing of it.
#[must_use]
pub fn facts(channel: Channel, detail: &Detail) -> String {
    if detail.worst.reason == Reason::CommandRejected {
        return rejection(channel, &detail.asked).map(words::rejection).unwrap_or_default().to_owned();
    }
    let numbers = numbers(channel, &detail.worst, detail.usable);
    if numbers.is_empty() {
        return numbers;
    }
    difference(channel, &detail.asked, &detail.given).unwrap_or(numbers)
}

/// "asked 0.00, at least 5.00 m/s² (margin −5.00)", "asked release, given none", or nothing. Without a usable
/// command there is nothing that was asked.
#[must_use]
pub fn numbers(channel: Channel, verdict: &Verdict, usable: bool) -> String {
    match quantity(channel, verdict) {
        Quantity::Nothing => String::new(),
        Quantity::Name(name) if usable => format!("asked {}, given {}", name(verdict.value), name(verdict.limit)),
        Quantity::Name(name) => format!("no command, given {}", name(verdict.limit)),
        Quantity::Number(unit, per_unit, decimals) => {
            let text = |raw| number(physical(raw, per_unit), decimals);
            let side = match side(verdict) {
                Side::Most => "at most",
                Side::Least => "at least",
            };
            let (value, limit, margin) = (text(verdict.value), text(verdict.limit), text(verdict.margin));
            if usable {
                format!("asked {value}, {side} {limit} {unit} (margin {margin})")
            } else {
                format!("no command, {side} {limit} {unit}")
            }
        }
    }
}

/// With a real minus, and none before zero.
#[must_use]
pub fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|digit| matches!(digit, b'0' | b'.')) => digits.to_owned(),
        Some(digits) => format!("−{digits}"),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::{number, numbers};
    use supervisor::{Channel, Kind, Reason, Verdict};

    #[test]
    fn both_sides_read_right() {
        let floor = Verdict::below(Kind::Substitute, Reason::Mitigation, 0, 10_240);
        assert_eq!(numbers(Channel::ServiceBrake, &floor, true), "asked 0.00, at least 5.00 m/s² (margin −5.00)");
        let cap = Verdict::above(Kind::Limit, Reason::PhantomBraking, 12_288, 7168);
        assert_eq!(numbers(Channel::ServiceBrake, &cap, true), "asked 6.00, at most 3.50 m/s² (margin −2.50)");
        let torque = Verdict::above(Kind::Pass, Reason::Within, 40, 45);
        assert_eq!(numbers(Channel::DriveTorque, &torque, true), "asked 40, at most 45 % (margin 5)");
    }

    #[test]
    fn codes_have_names() {
        let release = Verdict::fact(Kind::Block, Reason::SeatNotOccupied, 2, 0);
        assert_eq!(numbers(Channel::ParkingBrake, &release, true), "asked release, given none");
        let lost = Verdict::fact(Kind::Block, Reason::CommandLost, 0, 0);
        assert_eq!(numbers(Channel::ParkingBrake, &lost, true), "");
        assert_eq!(numbers(Channel::Gear, &Verdict::PASS, true), "");
        assert_eq!(numbers(Channel::ParkingBrake, &release, false), "no command, given none");
    }

    #[test]
    fn zero_has_no_sign() {
        assert_eq!((number(-0.001, 2), number(-1.5, 1)), ("0.00".to_owned(), "−1.5".to_owned()));
    }
}
