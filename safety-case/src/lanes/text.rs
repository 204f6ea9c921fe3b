//! What the codes of the lanes mean, and how they are shown.

use std::borrow::Cow;

use supervisor::{
    Cause, Channel, Contact, ContactorRequest, DrivingMode, EpbRequest, EpbState, ExitReason, Gear, GearRequest, Key,
    Kind, Level, Mode, Occupancy, Reason, Seat, Stage,
};

use supervisor::report::Lamp;

use super::Tone;
use crate::troubles::{Active, lamp};
use crate::words;

/// Codes from here on are causes of "unknown".
pub(super) const UNKNOWN: u16 = 1000;
/// No request was there.
pub(super) const NO_REQUEST: u16 = 999;

/// The cause behind a code, if it is one.
#[must_use]
pub fn cause(code: u16) -> Option<Cause> {
    Cause::from_code(u8::try_from(code.checked_sub(UNKNOWN)?).ok()?)
}

/// The verdict's kind and reason behind a code.
#[must_use]
pub fn verdict(code: u16) -> (Kind, Reason) {
    let [reason, kind] = code.to_le_bytes();
    (Kind::from_code(kind).unwrap_or(Kind::Block), Reason::from_code(reason).unwrap_or(Reason::Within))
}

pub(super) fn verdict_text(channel: Channel, code: u16) -> Cow<'static, str> {
    let (kind, reason) = verdict(code);
    let (sentence, requirement) = (words::reason(reason).0, words::requirement(channel, reason));
    match kind {
        Kind::Pass => words::kind(kind).into(),
        Kind::Limit | Kind::Substitute | Kind::Block => {
            format!("{}: {sentence} [{requirement}]", words::kind(kind)).into()
        }
    }
}

pub(super) fn verdict_tone(code: u16) -> Tone {
    match verdict(code) {
        (_, Reason::CommandLost) => Tone::Void,
        (Kind::Pass, _) => Tone::Good,
        (Kind::Limit, _) => Tone::Caution,
        (Kind::Substitute, _) => Tone::Alarm,
        (Kind::Block, _) => Tone::Refusal,
    }
}

pub(super) fn input_tone(code: u16) -> Tone {
    match cause(code) {
        None => Tone::Good,
        Some(Cause::NeverReceived) => Tone::Idle,
        Some(Cause::NotAvailable) => Tone::Void,
        Some(Cause::Requalifying) => Tone::Caution,
        Some(Cause::Stale | Cause::EndToEnd | Cause::OutOfRange) => Tone::Alarm,
    }
}

/// Names of an enum's codes, of causes, and of a missing request.
fn name(code: u16, names: impl Fn(u8) -> Option<&'static str>) -> Cow<'static, str> {
    if let Some(cause) = cause(code) {
        return words::cause(cause).into();
    }
    if code == NO_REQUEST {
        return "no command".into();
    }
    match u8::try_from(code).ok().and_then(names) {
        Some(name) => name.into(),
        None => format!("code {code}").into(),
    }
}

macro_rules! texts {
    ($($name:ident: $type:ident { $($variant:ident => $text:literal,)+ })*) => {$(
        pub(super) fn $name(code: u16) -> Cow<'static, str> {
            name(code, |code| {
                $type::from_code(code).map(|value| match value { $($type::$variant => $text,)+ })
            })
        }
    )*};
}

texts! {
    occupancy: Occupancy { Confirmed => "confirmed occupied", NotConfirmed => "not confirmed occupied", Leave => "LEAVE: driver out of seat", }
    stage: Stage { Up => "up", OpeningK4 => "K4 opens", OpeningK1 => "K4 open: K1 opens", Down => "down: K1 and K4 open", }
    level: Level { None => "none", One => "level 1", Two => "level 2", Three => "level 3", }
    mode: Mode { Manual => "manual", Automated => "automated", Suspended => "automated, overridden by the driver", }
    exit: ExitReason {
        None => "not ended", Requested => "asked for", BrakePedal => "brake pedal", Takeover => "driver took over steering",
        Switch => "cruise switch", AdsState => "automated driving system not valid", CommandLost => "brake request lost",
        InputLost => "input lost", Leave => "driver left the seat", Fault => "clock fault or safe state", Mitigation => "mitigation began",
        Bypass => "an actuator was commanded past us, or did not obey",
    }
    seat: Seat { Vacant => "vacant", Occupied => "occupied", }
    gear: Gear { Neutral => "N", Drive => "D", Reverse => "R", Park => "P", }
    gear_request: GearRequest { Hold => "hold", Drive => "D", Reverse => "R", Neutral => "N", Park => "P", }
    epb: EpbState { Released => "released", Applied => "applied", }
    epb_request: EpbRequest { None => "none", Apply => "apply", Release => "release", }
    contact: Contact { Open => "open", Closed => "closed", }
    contactor: ContactorRequest { Hold => "hold", Open => "open", Close => "close", }
    key: Key { Off => "off", On => "on", Start => "start", }
    driving_mode: DrivingMode { Manual => "manual", Automated => "automated", }
}

pub(super) fn number_text(code: u16) -> Cow<'static, str> {
    cause(code).map_or("known".into(), |cause| words::cause(cause).into())
}

pub(super) fn yes(code: u16) -> Cow<'static, str> {
    name(code, |code| Some(if code == 0 { "no" } else { "yes" }))
}

pub(super) fn on(code: u16) -> Cow<'static, str> {
    name(code, |code| Some(if code == 0 { "off" } else { "on" }))
}

pub(super) fn present(code: u16) -> Cow<'static, str> {
    if code == 0 { "lost".into() } else { "known".into() }
}

/// 0 is idle, everything else is worth seeing.
pub(super) fn note(code: u16) -> Tone {
    if code == 0 || code == NO_REQUEST { Tone::Idle } else { Tone::Note }
}
/// 0 is idle, everything else is the supervisor acting.
pub(super) fn alarm(code: u16) -> Tone {
    if code == 0 { Tone::Idle } else { Tone::Alarm }
}
/// The greater, the more serious.
pub(super) fn rising(code: u16) -> Tone {
    match code {
        0 => Tone::Idle,
        1 => Tone::Caution,
        _ => Tone::Alarm,
    }
}
pub(super) fn lost_at_zero(code: u16) -> Tone {
    if code == 0 { Tone::Alarm } else { Tone::Good }
}
pub(super) fn occupancy_tone(code: u16) -> Tone {
    match code {
        0 => Tone::Good,
        1 => Tone::Caution,
        _ => Tone::Alarm,
    }
}
pub(super) fn state_tone(code: u16) -> Tone {
    if code == 0 { Tone::Note } else { input_tone(code) }
}
/// "3 active, red stop lamp".
pub(super) fn troubles(code: u16) -> Cow<'static, str> {
    let active = Active(code);
    match (active.count(), active.lamp()) {
        (0, _) => "none active".into(),
        (count, Lamp::None) => format!("{count} active, no lamp").into(),
        (count, lit) => format!("{count} active, {} lamp", lamp(lit)).into(),
    }
}
pub(super) fn trouble_tone(code: u16) -> Tone {
    match Active(code).lamp() {
        Lamp::None if code == 0 => Tone::Idle,
        Lamp::None => Tone::Note,
        Lamp::AmberWarning => Tone::Caution,
        Lamp::RedStop => Tone::Alarm,
    }
}
pub(super) fn fault_tone(code: u16) -> Tone {
    if code == 0 { Tone::Idle } else { Tone::Caution }
}
