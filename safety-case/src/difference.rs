//! Which fields of a command with many fields were changed: which contactor, which lamp.

use supervisor::{Auxiliaries, Body, Channel, Command, Commands, Contactors, Outputs, Rejection, Warnings};

use crate::road::snake;

/// A field: its name, what was asked for, what went out.
type Field = (&'static str, Option<String>, String);

fn value<T: Copy>(command: Command<T>) -> Option<T> {
    match command {
        Command::Fresh(value) | Command::Held(_, value) => Some(value),
        Command::Absent | Command::Rejected(_) => None,
    }
}

fn on_off(on: bool) -> String {
    if on { "on" } else { "off" }.to_owned()
}

macro_rules! compare {
    ($asked:expr, $given:expr, $neutral:expr, $text:expr, $($field:ident $name:literal)+) => {{
        let (asked, given, neutral) = (value($asked), $given, $neutral);
        let mut fields: Vec<Field> = Vec::new();
        $(if asked.unwrap_or(neutral).$field != given.$field {
            let text = $text;
            fields.push(($name, asked.map(|asked| text(asked.$field)), text(given.$field)));
        })+
        fields
    }};
}

/// Why the frame of a channel's command was refused, if it was.
#[must_use]
pub const fn rejection(channel: Channel, asked: &Commands) -> Option<Rejection> {
    const fn of<T: Copy>(command: &Command<T>) -> Option<Rejection> {
        match command {
            Command::Rejected(why) => Some(*why),
            Command::Absent | Command::Fresh(_) | Command::Held(..) => None,
        }
    }
    match channel {
        Channel::DriveTorque => of(&asked.drive),
        Channel::TargetSpeed => of(&asked.target_speed),
        Channel::ServiceBrake => of(&asked.brake),
        Channel::Retarder => of(&asked.retarder),
        Channel::Gear => of(&asked.gear),
        Channel::ParkingBrake => of(&asked.epb),
        Channel::Steering => of(&asked.steering),
        Channel::Contactors => of(&asked.contactors),
        Channel::Auxiliaries => of(&asked.auxiliaries),
        Channel::Warnings => of(&asked.warnings),
        Channel::Body => of(&asked.body),
        Channel::Mode => of(&asked.mode),
    }
}

/// What was changed, "K4: asked close, given hold", or nothing for a channel whose verdict says it all.
#[must_use]
pub fn difference(channel: Channel, asked: &Commands, given: &Outputs) -> Option<String> {
    let fields = match channel {
        Channel::Contactors => {
            compare!(asked.contactors, given.contactors, Contactors::NEUTRAL, |each| snake(&each), k4 "K4" k1 "K1")
        }
        Channel::Auxiliaries => compare!(
            asked.auxiliaries, given.auxiliaries, Auxiliaries::NEUTRAL, on_off,
            air_pump "air pump" power_steering "power steering" dc_dc "DC/DC"
        ),
        Channel::Warnings => compare!(
            asked.warnings, given.warnings, Warnings::NEUTRAL, on_off,
            forward_collision "collision warning" pedestrian "pedestrian warning" seat_leave "seat-leave warning"
            hazard_flashers "hazard flashers" fault_lamp "fault lamp" notice_lamp "notice lamp"
            lane_departure "lane departure" speed_limit "speed limit" headway "headway"
        ),
        Channel::Body => compare!(
            asked.body, given.body, Body::NEUTRAL, on_off,
            brake_lamps "brake lamps" indicator_left "left indicator" indicator_right "right indicator"
            low_beam "low beam" high_beam "high beam" horn "horn"
        ),
        Channel::DriveTorque
        | Channel::TargetSpeed
        | Channel::ServiceBrake
        | Channel::Retarder
        | Channel::Gear
        | Channel::ParkingBrake
        | Channel::Steering
        | Channel::Mode => return None,
    };
    let text = fields.into_iter().map(|(name, asked, given)| match asked {
        Some(asked) => format!("{name}: asked {asked}, given {given}"),
        None => format!("{name}: given {given}"),
    });
    let text: Vec<String> = text.collect();
    (!text.is_empty()).then(|| text.join("; "))
}

#[cfg(test)]
mod tests {
    use super::difference;
    use supervisor::{Channel, Command, Commands, ContactorRequest, Contactors, Outputs, Warnings};

    #[test]
    fn names_what_was_changed() {
        let wanted = Contactors { k4: ContactorRequest::Close, k1: ContactorRequest::Hold };
        let asked = Commands { contactors: Command::Fresh(wanted), ..Commands::ABSENT };
        let text = difference(Channel::Contactors, &asked, &Outputs::NEUTRAL);
        assert_eq!(text.as_deref(), Some("K4: asked close, given hold"));
        let warnings = Warnings { fault_lamp: true, ..Warnings::NEUTRAL };
        let given = Outputs { warnings, ..Outputs::NEUTRAL };
        assert_eq!(difference(Channel::Warnings, &Commands::ABSENT, &given).as_deref(), Some("fault lamp: given on"));
        assert_eq!(difference(Channel::Gear, &asked, &given), None);
    }
}
