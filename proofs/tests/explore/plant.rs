//! The environment when everything cooperates: contactors, loads, parking brake, gearbox, drive and brakes do what they
//! are told, after a cycle or two.

use supervisor_core::{
    Contact, ContactorRequest, CurrentDeciA, DecelMs2Q11, EpbRequest, EpbState, Gear, GearRequest, Inputs, Outputs,
    Percent, Signal, SpeedKmhQ8,
};

/// Where everything stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Plant {
    /// Speed, 1/256 km/h.
    pub speed: u16,
    /// The parking brake is applied; `None` on its way.
    pub epb: Option<bool>,
    /// Where it is on its way to.
    pub applies: bool,
    /// K1 is closed.
    pub k1: bool,
    /// K4 is closed.
    pub k4: bool,
    /// Cycles until the loads have stopped.
    pub loads: u8,
    /// The gear.
    pub gear: Gear,
    /// Executed torque.
    pub torque: u8,
    /// Deceleration given.
    pub decel: u16,
}

/// Loads run down in so many cycles once K4 is open.
const RUN_DOWN: u8 = 3;

impl Plant {
    /// Rolling in D at a speed, high voltage on.
    pub const fn rolling(speed: u16) -> Self {
        Self {
            speed,
            epb: Some(false),
            applies: false,
            k1: true,
            k4: true,
            loads: RUN_DOWN,
            gear: Gear::Drive,
            torque: 0,
            decel: 0,
        }
    }

    /// What the sensors say.
    pub fn sense(&self, inputs: &mut Inputs) {
        let contact = |closed| Signal::Known(if closed { Contact::Closed } else { Contact::Open });
        inputs.wheel_speed = Signal::Known(SpeedKmhQ8::new(self.speed));
        inputs.motor_speed = inputs.wheel_speed;
        inputs.deceleration = Signal::Known(DecelMs2Q11::new(self.decel));
        inputs.epb = match self.epb {
            Some(true) => Signal::Known(EpbState::Applied),
            Some(false) => Signal::Known(EpbState::Released),
            None => Signal::NEVER,
        };
        inputs.k1 = contact(self.k1);
        inputs.k4 = contact(self.k4);
        inputs.drive_stopped = Signal::Known(self.loads == 0);
        inputs.auxiliaries_stopped = Signal::Known(self.loads == 0);
        inputs.hv_current = Signal::Known(CurrentDeciA::new(if self.loads == 0 { 0 } else { 100 }));
        inputs.executed_torque = Signal::Known(Percent::new(self.torque));
        inputs.gear = Signal::Known(self.gear);
    }

    /// One cycle of 50 ms later.
    pub fn obey(self, outputs: &Outputs) -> Self {
        let moved = |closed, request| match request {
            ContactorRequest::Hold => closed,
            ContactorRequest::Open => false,
            ContactorRequest::Close => true,
        };
        let applies = match outputs.epb.request {
            EpbRequest::None => self.applies,
            EpbRequest::Apply => true,
            EpbRequest::Release => false,
        };
        let there = self.epb == Some(applies) || self.epb.is_none() && applies == self.applies;
        let gear = match outputs.gear {
            GearRequest::Hold => self.gear,
            GearRequest::Drive => Gear::Drive,
            GearRequest::Reverse => Gear::Reverse,
            GearRequest::Neutral => Gear::Neutral,
            GearRequest::Park => Gear::Park,
        };
        let k4 = moved(self.k4, outputs.contactors.k4);
        // 1 m/s² for 50 ms is 0.18 km/h: a₀ in 1/2048 m/s² takes 9/400 of it in 1/256 km/h.
        let total = u32::from(outputs.brake.total.raw());
        let slower = u16::try_from(total.saturating_mul(9).div_euclid(400)).unwrap_or(u16::MAX);
        let speed = self.speed.saturating_sub(slower);
        Self {
            speed,
            epb: there.then_some(applies),
            applies,
            k1: moved(self.k1, outputs.contactors.k1),
            k4,
            loads: if k4 { RUN_DOWN } else { self.loads.saturating_sub(1) },
            gear,
            torque: outputs.drive.torque.raw(),
            decel: if self.speed > 0 { outputs.brake.total.raw() } else { 0 },
        }
    }
}
