//! The second cut: what must and what may happen in this cycle, as absolute bounds and allowed sets.
//!
//! [`decide`](crate::decide) makes it, [`vet`](crate::vet()) applies it. It expires with the cycle.

use supervisor_terms::{
    AngleDeciDeg, BarTorque50mNm, Body, DecelMs2Q11, Gear, Millis, Percent, RateDeciDegS, Reason, SpeedKmhQ8,
    TorqueNmQ10,
};

/// An upper bound and why it is no higher.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Bound<T> {
    /// Greatest permitted value.
    pub most: T,
    /// Why not more.
    pub reason: Reason,
}

impl<T: PartialOrd + Copy> Bound<T> {
    /// Lowers the bound where `most` is lower.
    pub(crate) fn lower(&mut self, most: T, reason: Reason) {
        if most < self.most {
            *self = Self { most, reason };
        }
    }
    /// Raises the bound where `most` is higher.
    pub(crate) fn raise(&mut self, most: T, reason: Reason) {
        if most > self.most {
            *self = Self { most, reason };
        }
    }
    /// Lowers the bound to `most` under a condition.
    pub(crate) fn lower_if(&mut self, condition: bool, most: T, reason: Reason) {
        if condition {
            self.lower(most, reason);
        }
    }
}

/// A permission, or why it is refused.
pub type Permission = Result<(), Reason>;

macro_rules! bounds {
    ($($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $type:ty,)+ })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        pub struct $name { $($(#[$field_doc])* pub $field: $type,)+ }
    )*};
}

bounds! {
    /// When a command counts as lost.
    Timeouts {
        /// Sent every 50 ms.
        ms50: Millis,
        /// Sent every 100 ms.
        ms100: Millis,
        /// Sent every 200 ms.
        ms200: Millis,
    }
    /// Drive torque.
    TorqueBound {
        /// For the driver's pedal.
        driver: Bound<Percent>,
        /// For ADAS.
        automated: Bound<Percent>,
        /// For EPBi: its ramp begins at the idle torque.
        epbi: Bound<Percent>,
        /// EPBi torque asked for below this is none.
        idle: Percent,
        /// Driver torque against the brake is allowed (TRQ-6).
        hill_hold: bool,
    }
    /// Service brake and retarder.
    BrakeBound {
        /// Least deceleration of the service brake alone, and what obliges it.
        floor: Bound<DecelMs2Q11>,
        /// Greatest total of service brake and retarder; never below `floor`.
        cap: Bound<DecelMs2Q11>,
        /// What a lost command counts as.
        fallback: DecelMs2Q11,
        /// What a lost retarder command counts as.
        retarder_fallback: Percent,
        /// Greatest electric part.
        electric: DecelMs2Q11,
        /// Greatest retarder torque.
        retarder: Bound<Percent>,
        /// The retarder is obliged to give as much as it may (RSP-1).
        retarder_obliged: bool,
        /// Deceleration of the retarder for each per cent.
        retarder_decel: DecelMs2Q11,
    }
    /// Gear.
    GearBound {
        /// The gear confirmed by the gearbox.
        confirmed: Option<Gear>,
        /// Neutral is obliged.
        neutral: bool,
        /// Drive.
        drive: Permission,
        /// Reverse.
        reverse: Permission,
        /// Park.
        park: Permission,
        /// Neutral: refused in the safe state only, where the gear holds.
        to_neutral: Permission,
    }
    /// Parking brake.
    EpbBound {
        /// Apply is obliged, and what obliges it.
        obliged: Option<Reason>,
        /// Apply is permitted.
        apply: Permission,
        /// Release is permitted.
        release: Permission,
    }
    /// Steering.
    SteeringBound {
        /// Automatic steering may be, or stay, enabled.
        enable: Permission,
        /// Lowest angle.
        angle_least: AngleDeciDeg,
        /// Highest angle.
        angle_most: AngleDeciDeg,
        /// The angle that asks for nothing: measured, or the last one.
        angle_neutral: AngleDeciDeg,
        /// Greatest angle that the channel can express, either way.
        range: AngleDeciDeg,
        /// Greatest rate.
        rate: RateDeciDegS,
        /// Lowest overlay torque.
        overlay_least: TorqueNmQ10,
        /// Highest overlay torque.
        overlay_most: TorqueNmQ10,
        /// The overlay torque that asks for nothing: the last one, faded.
        overlay_neutral: TorqueNmQ10,
        /// Least weight: it fades out, it does not drop.
        weight_least: Percent,
        /// Greatest weight: it fades in, it does not jump.
        weight_most: Percent,
        /// Greatest bar-torque limit.
        bar: BarTorque50mNm,
    }
    /// One contactor.
    ContactorBound {
        /// Open is obliged.
        obliged: bool,
        /// Open is permitted.
        open: Permission,
        /// Close is permitted.
        close: Permission,
    }
    /// Lamps and sounds that are obliged.
    WarningBound {
        /// Forward collision.
        forward_collision: bool,
        /// Pedestrian collision.
        pedestrian: bool,
        /// Seat leave.
        seat_leave: bool,
        /// Hazard flashers.
        hazard_flashers: bool,
        /// Fault lamp.
        fault_lamp: bool,
        /// Notice lamp.
        notice_lamp: bool,
    }
    /// Everything that must and may happen in this cycle.
    Envelope {
        /// When a command counts as lost.
        timeouts: Timeouts,
        /// Gear.
        gear: GearBound,
        /// Service brake and retarder.
        brake: BrakeBound,
        /// Drive torque.
        torque: TorqueBound,
        /// Target speed.
        target_speed: Bound<SpeedKmhQ8>,
        /// Parking brake.
        epb: EpbBound,
        /// Steering.
        steering: SteeringBound,
        /// K4.
        k4: ContactorBound,
        /// K1.
        k1: ContactorBound,
        /// Auxiliaries may be switched off.
        auxiliaries_off: Permission,
        /// Warnings.
        warnings: WarningBound,
        /// Brake lamps are on from this total deceleration.
        lamp_decel: DecelMs2Q11,
        /// Brake lamps are still obliged by an earlier deceleration.
        lamps_delayed: bool,
        /// What a lost body command counts as: the last output.
        body_fallback: Body,
        /// The automated mode may begin or go on.
        automated: Permission,
    }
}

impl Envelope {
    /// SELF-2d, RULE-3d, RULE-4a: whether every channel has a legal command: no bound contradicts another.
    ///
    /// `decide` gives only feasible envelopes (proved); the proofs of `vet` assume nothing else.
    #[must_use]
    pub fn is_feasible(&self) -> bool {
        let brake = self.brake.floor.most <= self.brake.cap.most;
        let steering = self.steering.angle_least <= self.steering.angle_most
            && self.steering.angle_least <= self.steering.angle_neutral
            && self.steering.angle_neutral <= self.steering.angle_most
            && self.steering.overlay_least <= self.steering.overlay_neutral
            && self.steering.overlay_neutral <= self.steering.overlay_most
            && self.steering.weight_least <= self.steering.weight_most
            && self.steering.weight_most <= Percent::FULL;
        let epb = self.epb.obliged.is_none() || (self.epb.apply.is_ok() && self.epb.release.is_err());
        let k4 = !self.k4.obliged || (self.k4.open.is_ok() && self.k4.close.is_err());
        let k1 = !self.k1.obliged || (self.k1.open.is_ok() && self.k1.close.is_err());
        let gear = !self.gear.neutral || self.gear.to_neutral.is_ok();
        brake && steering && epb && k4 && k1 && gear
    }
}
