//! What failing sensors say.

use supervisor::{
    AngleDeciDeg, ClosingCmS, Contact, Count, DistanceCm, EpbState, Inputs, Millis, OffsetCm, Pedal250, RadarObject,
    Scene, Seat, Signal, SpeedKmhQ8,
};

use super::kind::Misread;
use crate::number::{to_i16, to_u8, to_u16};

/// A failing sensor.
#[derive(Clone, Debug)]
pub struct Sensors {
    kind: Misread,
    /// Which of two.
    second: bool,
    /// What it said when it began.
    first: Option<(Inputs, Scene)>,
}

impl Sensors {
    /// `second`: of two sensors it is the second one.
    #[must_use]
    pub const fn new(kind: Misread, second: bool) -> Self {
        Self { kind, second, first: None }
    }

    /// What it makes of right inputs, so long after it began.
    pub fn corrupt(&mut self, inputs: &mut Inputs, scene: &mut Scene, elapsed_ms: u32) {
        let (first, first_scene) = self.first.get_or_insert_with(|| (*inputs, scene.clone()));
        let seconds = f64::from(elapsed_ms) / 1000.0;
        let (occupied, vacant) = (Signal::Known(Seat::Occupied), Signal::Known(Seat::Vacant));
        let full = Signal::Known(Pedal250::new(250));
        match self.kind {
            Misread::SeatOccupiedOne => one(&mut inputs.seat, self.second, occupied),
            Misread::SeatOccupiedBoth => inputs.seat = [occupied; 2],
            Misread::SeatVacantOne => one(&mut inputs.seat, self.second, vacant),
            Misread::SeatVacantBoth => inputs.seat = [vacant; 2],
            Misread::SeatFlickers => {
                let now = if (elapsed_ms / 100).is_multiple_of(2) { vacant } else { occupied };
                one(&mut inputs.seat, self.second, now);
            }
            Misread::PedalFullOne => one(&mut inputs.accelerator, self.second, full),
            Misread::PedalFullBoth => inputs.accelerator = [full; 2],
            Misread::PedalDrifts => {
                let [track, _] = inputs.accelerator;
                let travel = track.known().map_or(0.0, |travel| f64::from(travel.raw()));
                let drifted = Pedal250::new(to_u8((travel + 12.5 * seconds).min(250.0)));
                one(&mut inputs.accelerator, self.second, Signal::Known(drifted));
            }
            Misread::BrakeSwitch => inputs.brake_switch = Signal::Known(true),
            Misread::WheelSpeedZero => inputs.wheel_speed = Signal::Known(SpeedKmhQ8::ZERO),
            Misread::WheelSpeedStuck => inputs.wheel_speed = first.wheel_speed,
            Misread::BothSpeedsZero => {
                let zero = Signal::Known(SpeedKmhQ8::ZERO);
                (inputs.wheel_speed, inputs.motor_speed) = (zero, zero);
            }
            Misread::GhostShort | Misread::GhostLong => {
                // A list that is full has no room for a ghost.
                let _ = scene.radar.push(ghost(elapsed_ms));
            }
            Misread::RadarDrifts => {
                for object in &mut scene.radar {
                    let distance = f64::from(object.distance.raw()) + 200.0 * seconds;
                    object.distance = DistanceCm::new(to_u16(distance));
                    object.closing = ClosingCmS::new(to_i16(f64::from(object.closing.raw()) - 200.0));
                }
            }
            Misread::RadarLost => scene.radar_known = false,
            Misread::RadarFrozen => {
                scene.radar = first_scene.radar.clone();
                for object in &mut scene.radar {
                    object.age = Millis::new(object.age.raw().saturating_add(elapsed_ms));
                }
            }
            Misread::CameraBlind => scene.camera.clear(),
            Misread::CameraLost => scene.camera_known = false,
            Misread::SteeringAngle => {
                let angle = inputs.steering_angle.known().map_or(0, AngleDeciDeg::raw);
                inputs.steering_angle = Signal::Known(AngleDeciDeg::new(angle.saturating_add(600)));
            }
            Misread::K4Open => inputs.k4 = Signal::Known(Contact::Open),
            Misread::EpbApplied => inputs.epb = Signal::Known(EpbState::Applied),
        }
    }
}

fn one<T>(pair: &mut [T; 2], second: bool, value: T) {
    let [one, other] = pair;
    *(if second { other } else { one }) = value;
}

/// 15 m ahead, closing in with 6 m/s; the radar counts an update every 50 ms.
fn ghost(elapsed_ms: u32) -> RadarObject {
    let gap = (15.0 - 6.0 * f64::from(elapsed_ms) / 1000.0).max(1.0);
    RadarObject {
        distance: DistanceCm::new(to_u16(gap * 100.0)),
        offset: OffsetCm::ZERO,
        closing: ClosingCmS::new(600),
        age: Millis::ZERO,
        updates: Count::new(to_u8(f64::from(elapsed_ms / 50 + 1))),
    }
}
