//! What the table of messages is made of.

use supervisor_core::{
    Channel, ExitReason, Faults, Inputs, Level, Millis, Mode, Occupancy, Outputs, Record, Stage, Status,
};
use supervisor_perceive::{CameraObject, RadarObject};

use crate::coding::Coding;
use crate::frame::{extract, full, insert};
use crate::list::Entry;

/// The longest period S4 table 5 allows; the time-out is 2.5 times as long (E2E-1g).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControlTime {
    /// 50 ms.
    Ms50,
    /// 100 ms.
    Ms100,
    /// 200 ms.
    Ms200,
}

/// Where a message goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Destination {
    /// Into the inputs.
    Input,
    /// Into the radar's list: this part of an object.
    Radar(u8),
    /// Into the camera's list: this part of an object.
    Camera(u8),
    /// A command to this channel; with the supervisor's address, an output.
    Command(Channel),
    /// From the supervisor to whoever asks how it is (SELF-8a, RPT-1b).
    Status,
}

/// Who sends commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The main controller, which nobody trusts.
    MainController,
    /// The supervisor: actuators obey nobody else.
    Supervisor,
}

impl Source {
    /// The J1939 source address.
    #[must_use]
    pub const fn address(self) -> u8 {
        match self {
            Self::MainController => 0x2A,
            Self::Supervisor => 0x80,
        }
    }
}

/// Where a signal stands in its message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SignalLayout {
    /// Its name, as in `ebus.dbc`.
    pub name: &'static str,
    /// First bit, Intel order.
    pub start: u32,
    /// Number of bits.
    pub width: u32,
}

/// Everything that frames carry.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct Values {
    /// Inputs.
    pub inputs: Inputs,
    /// Commands, or outputs.
    pub outputs: Outputs,
    /// A part of a radar object.
    pub radar: Entry<RadarObject>,
    /// A part of a camera object.
    pub camera: Entry<CameraObject>,
    /// What the supervisor says of itself.
    pub status: Status,
    /// When the status was sent, by the clock of the supervisor.
    pub stamp: Millis,
}

impl Values {
    /// Nothing.
    pub const NONE: Self = Self {
        inputs: Inputs::NEVER,
        outputs: Outputs::NEUTRAL,
        radar: Entry::NONE,
        camera: Entry::NONE,
        status: Status {
            occupancy: Occupancy::NotConfirmed,
            parked_by_leave: false,
            parked_for: Millis::ZERO,
            stage: Stage::Up,
            level: Level::None,
            mode: Mode::Manual,
            exit: ExitReason::None,
            safe_state: false,
            faults: Faults::NONE,
            record: Record::None,
        },
        stamp: Millis::ZERO,
    };
}

/// Writes one signal.
pub(crate) fn put<C: Coding<T>, T>(payload: &mut u64, start: u32, width: u32, value: T) {
    *payload = insert(*payload, start, width, C::encode(value, full(width)));
}

/// Reads one signal; false if its raw value means nothing, or (`strict`) is not what would be written.
pub(crate) fn get<C: Coding<T>, T: Copy>(payload: u64, start: u32, width: u32, strict: bool, value: &mut T) -> bool {
    let raw = extract(payload, start, width);
    let read = C::decode(raw, full(width)).filter(|read| !strict || C::encode(*read, full(width)) == raw);
    *value = read.unwrap_or(*value);
    read.is_some()
}

macro_rules! messages {
    (($($part:ident),*) $($(#[$doc:meta])* $number:literal $message:ident(
        $name:literal, $id:literal, $period:literal, $control_time:ident, $destination:expr, $protection:ident
    ) { $($signal:ident: $coding:ident($start:literal, $width:literal) = $place:expr;)* })*) => {
        /// The messages: a closed table.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        pub enum Message { $($(#[$doc])* $message,)* }

        messages! { @get /** Its place in the table. */ number: usize; $($message => $number,)* }
        messages! { @get /** Its name, as in `ebus.dbc`. */ name: &'static str; $($message => $name,)* }
        messages! { @get /** The identifier, as its sensor or the main controller has it. */
            id: u32; $($message => $id,)* }
        messages! { @get /** How often it is sent. */ period: Millis; $($message => Millis::new($period),)* }
        messages! { @get /** The class of its time-out (E2E-1g). */
            control_time: ControlTime; $($message => ControlTime::$control_time,)* }
        messages! { @get /** Where it goes. */ destination: Destination; $($message => $destination,)* }
        messages! { @get /** How it is protected. */ protection: Protection; $($message => Protection::$protection,)* }
        messages! { @get /** Its signals, without counter and check field. */
            signals: &'static [SignalLayout];
            $($message => &[$(SignalLayout { name: stringify!($signal), start: $start, width: $width },)*],)* }

        $(const _: () = assert!(Message::$message.gives_evidence(), "bare, and nothing protected agrees with it");)*

        impl Message {
            /// Every message, in the order of the table.
            pub const ALL: &'static [Self] = &[$(Self::$message,)*];

            fn write_signals(self, payload: &mut u64, values: &Values) {
                let Values { $($part),* } = values;
                match self { $(Self::$message => { $(put::<$coding, _>(payload, $start, $width, $place);)* })* }
            }
            /// The name of the first signal that cannot be read.
            fn read_signals(self, payload: u64, strict: bool, values: &mut Values) -> Option<&'static str> {
                let Values { $($part),* } = values;
                match self {
                    $(Self::$message => { $(if !get::<$coding, _>(payload, $start, $width, strict, &mut $place) {
                        return Some(stringify!($signal));
                    })* })*
                }
                None
            }
            /// Makes every signal of it unknown; a command stays as it is.
            pub(crate) fn degrade(self, values: &mut Values, cause: Cause) {
                let Values { $($part),* } = values;
                match self { $(Self::$message => { $(<$coding as Coding<_>>::degrade(&mut $place, cause);)* })* }
            }
        }
    };
    (@get $(#[$doc:meta])* $getter:ident: $type:ty; $($message:ident => $value:expr,)*) => {
        impl Message {
            $(#[$doc])*
            #[must_use]
            pub const fn $getter(self) -> $type {
                match self { $(Self::$message => $value,)* }
            }
        }
    };
}
pub(crate) use messages;
