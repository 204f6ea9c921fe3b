//! The columns of the tables.

use supervisor::{Channel, Command, Commands, Outputs};

use super::Made;
use super::digest;

/// A column: its name, and what is in it.
pub type Column = (String, i64);

/// `DriveTorque` as `drive_torque`.
fn snake(name: &str) -> String {
    let mut text = String::new();
    for (at, letter) in name.char_indices() {
        if at > 0 && letter.is_uppercase() {
            text.push('_');
        }
        text.extend(letter.to_lowercase());
    }
    text
}

/// Everything that was decided: five columns for the verdict of each channel, the outputs, the status.
#[must_use]
pub fn decision(made: &Made) -> Vec<Column> {
    let mut columns = Vec::new();
    for (channel, verdict) in made.decision.verdicts.iter() {
        let channel = snake(&format!("{channel:?}"));
        digest::verdict(verdict, &mut |name, value| columns.push((format!("{channel}.{name}"), value)));
    }
    let mut put = |name: &'static str, value| columns.push((name.to_owned(), value));
    digest::outputs(&made.decision.outputs, &mut put);
    digest::status(&made.decision.status, &mut put);
    columns
}

/// How a command came: 0 absent, 1 rejected, 2 fresh, 3 held; and the rejection's code, or the age in ms.
fn coming<T>(command: &Command<T>) -> [i64; 2] {
    match command {
        Command::Absent => [0, 0],
        Command::Rejected(why) => [1, i64::from(why.code())],
        Command::Fresh(_) => [2, 0],
        Command::Held(age, _) => [3, i64::from(age.raw())],
    }
}

/// The commands as they reached the vetting: how each came, then every field; of what did not come, the neutral value.
#[must_use]
pub fn commands(of: &Commands) -> Vec<Column> {
    let (mut columns, mut asked) = (Vec::new(), Outputs::NEUTRAL);
    macro_rules! channel {
        ($($field:ident: $channel:ident;)*) => {$(
            let [how, detail] = coming(&of.$field);
            let name = snake(&format!("{:?}", Channel::$channel));
            columns.push((format!("{name}.came"), how));
            columns.push((format!("{name}.detail"), detail));
            if let Command::Fresh(value) | Command::Held(_, value) = of.$field {
                asked.$field = value;
            }
        )*};
    }
    channel! {
        drive: DriveTorque; target_speed: TargetSpeed; brake: ServiceBrake; retarder: Retarder; gear: Gear;
        epb: ParkingBrake; steering: Steering; contactors: Contactors; auxiliaries: Auxiliaries; warnings: Warnings;
        body: Body; mode: Mode;
    }
    digest::outputs(&asked, &mut |name, value| columns.push((name.to_owned(), value)));
    columns
}
