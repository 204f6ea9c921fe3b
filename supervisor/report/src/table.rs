//! The one table of trouble codes: every fault, what driver and ADS are told of it, and its J1939 numbers.

use supervisor_core::Faults;

use crate::body::BodyPart;
use crate::code::{Fmi, Lamp, Source, Spn, System, TroubleCode};

/// First of our own suspect parameter numbers. J1939 leaves 516096 to 524287 to the manufacturer; whoever has given
/// these away already moves all of ours by this one number.
pub const OWN_SPN: Spn = Spn::new(0x7_E100);

/// A number of ours; the first digit is the system.
const fn own(number: u32) -> Spn {
    Spn::new(OWN_SPN.raw().saturating_add(number))
}

/// A standard number, used only where J1939 names exactly this parameter.
const fn standard(number: u32) -> Spn {
    Spn::new(number)
}

macro_rules! trouble_codes {
    ($($source:ident $name:ident: $number:ident($spn:literal), $fmi:ident, $lamp:ident, $system:ident,
       $driver:literal, $why:literal;)*) => {
        /// Every fault (RPT-1c). A test fails if a fault has no row, two rows share SPN and FMI, or one lacks a text.
        ///
        /// A number that was once given is never given again: codes outlive versions.
        pub const TROUBLE_CODES: &[TroubleCode] = &[$(TroubleCode {
            source: trouble_codes!(@$source $name),
            spn: $number($spn),
            fmi: Fmi::$fmi,
            lamp: Lamp::$lamp,
            system: System::$system,
            driver: $driver,
            why: $why,
        },)*];
    };
    (@core $name:ident) => { Source::Core(Faults::$name) };
    (@body $name:ident) => { Source::Body(BodyPart::$name) };
}

/// How many codes there are.
pub(crate) const CODES: usize = TROUBLE_CODES.len();

trouble_codes! {
    core CLOCK: own(0x00), UpdateRate, AmberWarning, Supervisor,
        "The automated mode is off.", "The supervisor was not called in time.";
    core STATE: own(0x01), BadDevice, RedStop, Supervisor,
        "No drive; the bus brakes as asked. Stop safely.", "The supervisor's memory was damaged.";
    core CLOCK_LATCHED: own(0x02), UpdateRate, RedStop, Supervisor,
        "No drive; the bus brakes as asked. Stop safely.", "The supervisor was not called in time, three times in a row.";
    core CONFIGURATION: own(0x03), Calibration, RedStop, Supervisor,
        "No drive; the bus brakes as asked. Stop safely.", "The supervisor's configuration changed while it ran.";
    core SEAT_DISAGREE: own(0x10), Erratic, AmberWarning, Seat,
        "The parking brake will not release.", "The seat sensors disagree.";
    core SEAT_UNKNOWN: own(0x10), NetworkData, AmberWarning, Seat,
        "The parking brake will not release.", "A seat sensor is silent or not plausible.";
    core SPEED_UNKNOWN: standard(84), Erratic, AmberWarning, Speed,
        "No gear change, no automated mode.", "The speed is silent, or wheels and motor disagree.";
    core EPB_UNCONFIRMED: own(0x20), NotResponding, RedStop, ParkingBrake,
        "The parking brake did not apply: hold the bus.", "The parking brake has not confirmed in time.";
    core K4_OVERDUE: own(0x30), NotResponding, AmberWarning, HighVoltage,
        "High voltage is not off.", "Contactor K4 has not confirmed in time that it is open.";
    core K1_OVERDUE: own(0x31), NotResponding, AmberWarning, HighVoltage,
        "High voltage is not off.", "The loads have not stopped, or contactor K1 has not opened, in time.";
    core PERCEPTION_UNKNOWN: own(0x40), NetworkData, AmberWarning, Perception,
        "No collision warning, no automated mode.", "Radar or camera is silent.";
    core TTC_DISAGREEMENT: own(0x41), Erratic, None, Perception,
        "The distance ahead is uncertain.", "Two ways to judge the danger of a collision disagree.";
    core DRIVE_COMMAND_LOST: own(0x50), UpdateRate, AmberWarning, Drive,
        "No drive.", "The main controller's drive command is missing or damaged.";
    core BRAKE_COMMAND_LOST: own(0x60), UpdateRate, AmberWarning, Brake,
        "No automated braking: use the pedal.", "The main controller's brake command is missing or damaged.";
    core STEERING_COMMAND_LOST: own(0x70), UpdateRate, AmberWarning, Steering,
        "Automatic steering ends: steer.", "The main controller's steering command is missing or damaged.";
    core ACCELERATOR_UNKNOWN: standard(91), Erratic, AmberWarning, Drive,
        "The accelerator has no effect; no automated mode.", "The accelerator's two tracks disagree, or one is silent.";
    core BRAKE_PEDAL_UNKNOWN: standard(521), Erratic, AmberWarning, Brake,
        "No drive, no automated mode.", "The brake pedal's position is uncertain.";
    core EBS_RED: standard(1439), ConditionExists, RedStop, Brake,
        "Brake failure. Stop safely.", "The brake system gives its red warning.";
    core TAKEOVER: own(0x71), ConditionExists, None, Steering,
        "You steer.", "The driver has taken over the steering.";
    core DRIVE_RESPONSE: own(0x51), NotResponding, AmberWarning, Drive,
        "The drive is weak or late.", "The drive does not reach the torque that it was told.";
    core BRAKE_RESPONSE: own(0x61), NotResponding, RedStop, Brake,
        "The brakes are weak: press the pedal, stop safely.", "The brakes do not give, or cannot give, the deceleration that they were told.";
    core GEAR_RESPONSE: own(0x80), NotResponding, AmberWarning, Gear,
        "The gear does not engage.", "The gearbox does not follow in time.";
    core STEERING_RESPONSE: own(0x72), NotResponding, AmberWarning, Steering,
        "Automatic steering ends: steer.", "The steering does not follow its angle in time.";
    core EXCESS_TORQUE: own(0x52), AboveNormal, RedStop, Drive,
        "The drive pushes by itself: brake, stop safely.", "The drive gives more torque than it was told.";
    core BYPASS: own(0x04), ConditionExists, RedStop, Supervisor,
        "No drive: an actuator was moved past the supervisor.", "An actuator was commanded or moved past the supervisor.";
    core SECOND_SENDER: own(0x05), NetworkData, RedStop, Supervisor,
        "No drive: somebody else speaks for the supervisor.", "Somebody else sends under the supervisor's address.";
    core CONTACTOR: own(0x32), BadDevice, AmberWarning, HighVoltage,
        "High voltage will not switch on again.", "A contactor moved by itself or did not follow.";
    core FLOW: own(0x06), BadDevice, RedStop, Supervisor,
        "No drive; the bus brakes as asked. Stop safely.", "A stage of the supervisor's cycle was skipped, repeated or out of order.";
    core SPLIT_IMPLAUSIBLE: own(0x62), Erratic, AmberWarning, Brake,
        "No electric braking.", "Mass, brake pressure or electric braking torque is not plausible.";
    core BRAKE_OVERSHOOT: own(0x61), AboveNormalModerate, AmberWarning, Brake,
        "The brakes are harsh.", "The brakes give more than they were told.";
    core STEERING_OVERSHOOT: own(0x72), AboveNormalModerate, AmberWarning, Steering,
        "Automatic steering is restless.", "The steering goes beyond its target.";
    body Wipers: own(0x90), NotResponding, AmberWarning, Body,
        "The wipers do not obey.", "The wipers have not followed for 1 s.";
    body BrakeLamps: own(0x91), NotResponding, AmberWarning, Body,
        "The brake lamps do not obey.", "The brake lamps have not followed for 1 s.";
    body IndicatorLeft: own(0x92), NotResponding, AmberWarning, Body,
        "The left indicator does not obey.", "The left indicator has not followed for 1 s.";
    body IndicatorRight: own(0x93), NotResponding, AmberWarning, Body,
        "The right indicator does not obey.", "The right indicator has not followed for 1 s.";
    body LowBeam: own(0x94), NotResponding, AmberWarning, Body,
        "The low beam does not obey.", "The low beam has not followed for 1 s.";
    body HighBeam: own(0x95), NotResponding, AmberWarning, Body,
        "The high beam does not obey.", "The high beam has not followed for 1 s.";
    body Feedback: own(0x96), UpdateRate, AmberWarning, Body,
        "Lamps and wipers are not watched.", "Their feedback has been missing for 1 s.";
}

#[cfg(test)]
mod tests {
    use super::*;

    /// RPT-1c: every fault of the core and of the body has exactly one row.
    #[test]
    fn every_fault_has_exactly_one_row() {
        let rows = |source: Source| TROUBLE_CODES.iter().filter(|row| row.source == source).count();
        for (fault, name) in Faults::NAMES {
            assert_eq!(rows(Source::Core(*fault)), 1, "{name} needs one row in TROUBLE_CODES");
        }
        for part in BodyPart::ALL {
            assert_eq!(rows(Source::Body(*part)), 1, "{part:?}");
        }
        assert_eq!(CODES, Faults::NAMES.len() + BodyPart::ALL.len(), "no row speaks of anything else");
    }

    /// RPT-1c: no two rows share SPN and FMI, every SPN fits 19 bits, ours lie where J1939 leaves room.
    #[test]
    fn every_code_is_unique_and_fits_j1939() {
        for (index, row) in TROUBLE_CODES.iter().enumerate() {
            let others = TROUBLE_CODES.iter().skip(index + 1);
            assert!(
                others.clone().all(|other| (other.spn, other.fmi) != (row.spn, row.fmi)),
                "{} shares its SPN and FMI",
                row.name()
            );
            assert!(others.clone().all(|other| other.ads_code() != row.ads_code()), "{} shares its code", row.name());
            assert!(row.spn <= Spn::GREATEST && row.spn.raw() > 0 && row.fmi.code() <= 31, "{}", row.name());
            let standard = [84, 91, 521, 1439].contains(&row.spn.raw());
            assert!(standard || (516_096..=524_287).contains(&row.spn.raw()), "{}", row.name());
        }
    }

    /// RPT-1a, RPT-1b: every row tells what does not work and why; a lamp is lit by every fault and by no hint.
    #[test]
    fn every_row_tells_what_and_why() {
        for row in TROUBLE_CODES {
            assert!(!row.name().is_empty());
            for text in [row.driver, row.why] {
                assert!(text.len() > 8 && text.len() <= 80 && text.is_ascii() && text.ends_with('.'), "{text}");
            }
            let hint = matches!(row.source, Source::Core(fault) if Faults::HINTS.contains(fault));
            assert_eq!(row.lamp == Lamp::None, hint, "{}", row.name());
            assert!(row.ads_code() > 0, "{}", row.name());
        }
    }

    /// RPT-1c: what leads to the safe state, and a brake that fails, lights the red stop lamp.
    #[test]
    fn what_ends_the_drive_lights_the_red_lamp() {
        for fault in [Faults::STATE, Faults::CLOCK_LATCHED, Faults::CONFIGURATION, Faults::EBS_RED] {
            let row = TROUBLE_CODES.iter().find(|row| row.source == Source::Core(fault));
            assert_eq!(row.map(|row| row.lamp), Some(Lamp::RedStop));
        }
    }

    /// RPT-1b: the numbers that are out in the field do not move.
    #[test]
    fn codes_are_stable() {
        let found = |fault: Faults| {
            let row = TROUBLE_CODES.iter().find(|row| row.source == Source::Core(fault));
            row.map(|row| (row.spn.raw(), row.fmi.code(), row.ads_code()))
        };
        assert_eq!(found(Faults::CLOCK), Some((516_352, 9, 1)));
        assert_eq!(found(Faults::SEAT_UNKNOWN), Some((516_368, 19, 6)));
        assert_eq!(found(Faults::ACCELERATOR_UNKNOWN), Some((91, 2, 16)));
        assert_eq!(found(Faults::TAKEOVER), Some((516_465, 31, 19)));
        let wipers = TROUBLE_CODES.iter().find(|row| row.source == Source::Body(BodyPart::Wipers));
        assert_eq!(wipers.map(|row| (row.spn.raw(), row.fmi.code(), row.ads_code())), Some((516_496, 7, 64)));
    }
}
