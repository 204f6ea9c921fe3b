//! The driver: what hands and feet do, as a script of timed acts.

use supervisor::{EpbSwitch, Gear, Key};

use crate::number::kmh;

/// One thing that the driver does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Act {
    /// Sits down (`true`) or gets up (`false`): both seat sensors, the second one 20 ms later.
    Sit(bool),
    /// Moves the accelerator to this share of its travel, 0 to 1.
    Accelerator(f64),
    /// Moves the brake pedal to this share of its travel, 0 to 1.
    Brake(f64),
    /// Holds this speed in km/h with the accelerator; never brakes.
    Hold(f64),
    /// Moves the gear selector.
    Selector(Gear),
    /// Turns the key.
    Key(Key),
    /// Moves the switch of the parking brake.
    EpbSwitch(EpbSwitch),
    /// Switches the cruise control on or off.
    CruiseSwitch(bool),
    /// Presses or lets go the "set" button of the cruise control.
    Set(bool),
    /// Turns the steering wheel towards this angle in degrees, left positive; nobody turns it before.
    Wheel(f64),
}

/// An act and when it happens, in ms of the drive.
pub type Script<'a> = &'a [(u32, Act)];

/// Ten seconds from key-on to a bus that is ready to go, and what the driver does then.
macro_rules! after_start {
    ($($act:expr,)*) => {
        &[
            (5000, $crate::driver::Act::Key(supervisor::Key::Start)),
            (5500, $crate::driver::Act::Key(supervisor::Key::On)),
            (6500, $crate::driver::Act::Brake(0.4)),
            (7000, $crate::driver::Act::Selector(supervisor::Gear::Drive)),
            (8000, $crate::driver::Act::EpbSwitch(supervisor::EpbSwitch::Release)),
            (9500, $crate::driver::Act::EpbSwitch(supervisor::EpbSwitch::Idle)),
            (10_000, $crate::driver::Act::Brake(0.0)),
            $($act,)*
        ]
    };
}

pub(crate) use after_start;

/// How fast a foot moves a pedal, in shares of its travel per millisecond (own: 200 %/s).
const FOOT_PER_MS: f64 = 0.002;
/// Accelerator that holds a speed: so much per m/s of error (own) ...
const HOLD_GAIN: f64 = 0.5;
/// ... on top of so much per m/s of speed: about what keeps the bus of the model rolling (own).
const HOLD_FEED: f64 = 0.0085;
/// The second seat sensor follows the first after this time (own).
const SENSOR_SKEW_MS: u32 = 20;

/// Where the driver's hands and feet are.
#[derive(Clone, Copy, Debug)]
pub struct Driver<'a> {
    script: Script<'a>,
    sits: bool,
    sat_since: u32,
    goal: f64,
    hold: Option<f64>,
    /// Accelerator, 0 to 1.
    pub accelerator: f64,
    brake_goal: f64,
    /// Brake pedal, 0 to 1.
    pub brake: f64,
    /// Gear selector.
    pub selector: Gear,
    /// Key.
    pub key: Key,
    /// Switch of the parking brake.
    pub epb_switch: EpbSwitch,
    /// Cruise control switched on.
    pub cruise: bool,
    /// "Set" pressed.
    pub set: bool,
    /// Angle in degrees towards which the steering wheel is turned; none: nobody turns it.
    pub wheel: Option<f64>,
}

impl<'a> Driver<'a> {
    /// Seated, key on, nothing pressed.
    #[must_use]
    pub const fn new(script: Script<'a>) -> Self {
        Self {
            script,
            sits: true,
            sat_since: 0,
            goal: 0.0,
            hold: None,
            accelerator: 0.0,
            brake_goal: 0.0,
            brake: 0.0,
            selector: Gear::Neutral,
            key: Key::On,
            epb_switch: EpbSwitch::Idle,
            cruise: false,
            set: false,
            wheel: None,
        }
    }

    /// One millisecond: acts that are due, then the feet move.
    pub fn tick(&mut self, now_ms: u32, speed: f64) {
        while let Some(((at, act), rest)) = self.script.split_first() {
            if *at > now_ms {
                break;
            }
            self.act(*act, *at);
            self.script = rest;
        }
        if let Some(target) = self.hold {
            self.goal = ((target - speed) * HOLD_GAIN + target * HOLD_FEED).clamp(0.0, 1.0);
        }
        self.accelerator += (self.goal - self.accelerator).clamp(-FOOT_PER_MS, FOOT_PER_MS);
        self.brake += (self.brake_goal - self.brake).clamp(-FOOT_PER_MS, FOOT_PER_MS);
    }

    /// Does this at this time, in ms.
    pub fn act(&mut self, act: Act, at: u32) {
        match act {
            Act::Sit(sits) => (self.sits, self.sat_since) = (sits, at),
            Act::Accelerator(share) => (self.goal, self.hold) = (share, None),
            Act::Brake(share) => self.brake_goal = share,
            Act::Hold(speed) => self.hold = Some(kmh(speed)),
            Act::Selector(gear) => self.selector = gear,
            Act::Key(key) => self.key = key,
            Act::EpbSwitch(position) => self.epb_switch = position,
            Act::CruiseSwitch(on) => self.cruise = on,
            Act::Set(pressed) => self.set = pressed,
            Act::Wheel(angle) => self.wheel = Some(angle),
        }
    }

    /// What each of the two seat sensors sees.
    #[must_use]
    pub const fn seat(&self, now_ms: u32) -> [bool; 2] {
        let late = now_ms.saturating_sub(self.sat_since) < SENSOR_SKEW_MS && self.sat_since > 0;
        [self.sits, if late { !self.sits } else { self.sits }]
    }
}
