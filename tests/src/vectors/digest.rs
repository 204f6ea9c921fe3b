//! What a cycle decided, field by field, and its digest. Needs nothing but `core`: the example firmware in Rust takes this
//! very file.

use supervisor::wire::Frame;
use supervisor::{Decision, Outputs, Status, Verdict};

macro_rules! fields {
    ($each:ident, $($name:literal = $value:expr;)*) => {{ $($each($name, i64::from($value));)* }};
}

/// Every field of every channel, in the order of `SupervisorOutputs` in the C header.
pub fn outputs(of: &Outputs, each: &mut impl FnMut(&'static str, i64)) {
    let Outputs {
        drive,
        target_speed,
        brake,
        retarder,
        gear,
        epb,
        steering,
        contactors,
        auxiliaries,
        warnings,
        body,
        mode,
    } = of;
    fields! { each,
        "target_speed" = target_speed.raw();
        "brake_total" = brake.total.raw();
        "brake_electric" = brake.electric.raw();
        "steering_angle" = steering.angle.raw();
        "steering_rate" = steering.rate.raw();
        "steering_overlay" = steering.overlay.raw();
        "drive_torque" = drive.torque.raw();
        "drive_active" = drive.active;
        "drive_origin" = drive.origin.code();
        "brake_mode" = brake.mode.code();
        "brake_priority" = brake.priority.code();
        "retarder_torque" = retarder.torque.raw();
        "retarder_mode" = retarder.mode.code();
        "retarder_priority" = retarder.priority.code();
        "gear" = gear.code();
        "epb_request" = epb.request.code();
        "epb_mode" = epb.mode.code();
        "steering_enable" = steering.enable;
        "steering_weight" = steering.weight.raw();
        "steering_bar_limit" = steering.bar_limit.raw();
        "k4" = contactors.k4.code();
        "k1" = contactors.k1.code();
        "air_pump" = auxiliaries.air_pump;
        "power_steering" = auxiliaries.power_steering;
        "dc_dc" = auxiliaries.dc_dc;
        "forward_collision" = warnings.forward_collision;
        "pedestrian" = warnings.pedestrian;
        "seat_leave" = warnings.seat_leave;
        "hazard_flashers" = warnings.hazard_flashers;
        "fault_lamp" = warnings.fault_lamp;
        "notice_lamp" = warnings.notice_lamp;
        "lane_departure" = warnings.lane_departure;
        "speed_limit" = warnings.speed_limit;
        "headway" = warnings.headway;
        "wipers" = body.wipers.code();
        "brake_lamps" = body.brake_lamps;
        "indicator_left" = body.indicator_left;
        "indicator_right" = body.indicator_right;
        "low_beam" = body.low_beam;
        "high_beam" = body.high_beam;
        "horn" = body.horn;
        "mode" = mode.code();
    }
}

/// What is reported with it, in the order of `SupervisorStatus` in the C header.
pub fn status(of: &Status, each: &mut impl FnMut(&'static str, i64)) {
    fields! { each,
        "parked_for_ms" = of.parked_for.raw();
        "faults" = of.faults.bits();
        "occupancy" = of.occupancy.code();
        "parked_by_leave" = of.parked_by_leave;
        "stage" = of.stage.code();
        "level" = of.level.code();
        "mode_granted" = of.mode.code();
        "exit" = of.exit.code();
        "safe_state" = of.safe_state;
        "record" = of.record.code();
    }
}

/// The verdict of one channel, in the order of `SupervisorVerdict` in the C header.
pub fn verdict(of: Verdict, each: &mut impl FnMut(&'static str, i64)) {
    fields! { each,
        "kind" = of.kind.code();
        "reason" = of.reason.code();
        "value" = of.value;
        "limit" = of.limit;
        "margin" = of.margin;
    }
}

/// FNV-1a (64 bits) over fields as four bytes each, identifiers of frames as four and their data as eight; numbers in two's
/// complement, least significant byte first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(u64);

impl Default for Digest {
    fn default() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }
}

impl Digest {
    /// Takes bytes.
    pub fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }
    /// Takes a field: an `i32` or a `u32`, its low four bytes are all of it.
    pub fn field(&mut self, value: i64) {
        let [first, second, third, fourth, ..] = value.to_le_bytes();
        self.bytes(&[first, second, third, fourth]);
    }
    /// Takes a frame that was sent.
    pub fn frame(&mut self, frame: &Frame) {
        self.bytes(&frame.id.to_le_bytes());
        self.bytes(&frame.data);
    }
    /// The number.
    #[must_use]
    pub const fn finish(self) -> u64 {
        self.0
    }
}

/// The digest of a cycle: the verdict of every channel, the outputs, the status, then every frame that was sent.
#[must_use]
pub fn digest(decision: &Decision, sent: &[Frame]) -> u64 {
    let mut digest = Digest::default();
    let mut put = |_: &'static str, value: i64| digest.field(value);
    for (_, of) in decision.verdicts.iter() {
        verdict(of, &mut put);
    }
    outputs(&decision.outputs, &mut put);
    status(&decision.status, &mut put);
    for frame in sent {
        digest.frame(frame);
    }
    digest.finish()
}
