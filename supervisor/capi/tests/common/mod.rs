//! The caller, as C is one: memory of its own, and calls with pointers to it.

use supervisor::Sealed;
use supervisor_capi::*;

/// A call of the library.
macro_rules! call {
    ($call:expr) => {{
        // SAFETY: every pointer of these tests is null, or leads to memory of the test that nothing else touches. One
        // that is misaligned or overlaps is refused before it is followed: that is what is tested.
        #[expect(unsafe_code, reason = "the tests are the caller")]
        unsafe {
            $call
        }
    }};
}
pub(crate) use call;

/// "Power on".
pub const POWER_ON: u8 = 0;
/// "Nothing was persisted".
pub const NO_RECORD: u8 = 0;

/// The default configuration, sealed.
pub fn sealed() -> [u8; SUPERVISOR_SEALED_BYTES] {
    let Ok(sealed) = Sealed::from_default() else { unreachable!("the table is valid") };
    sealed.to_bytes()
}

/// A state that was never initialised.
pub fn zeroed() -> Box<SupervisorState> {
    Box::new(SupervisorState::ZERO)
}

/// A state that has started: clean key-on.
pub fn started() -> Box<SupervisorState> {
    let (mut state, sealed) = (zeroed(), sealed());
    let code = call!(supervisor_init(
        &raw mut *state,
        SUPERVISOR_STATE_BYTES,
        SUPERVISOR_ABI_VERSION,
        sealed.as_ptr(),
        sealed.len(),
        POWER_ON,
        NO_RECORD
    ));
    assert_eq!(code, SupervisorCode::Ok);
    state
}

/// What one step gives.
pub struct Stepped {
    pub code: SupervisorCode,
    pub decision: SupervisorDecision,
    pub frames: Vec<SupervisorFrame>,
}

/// No frame.
pub const NO_FRAME: SupervisorFrame = SupervisorFrame { id: 0, data: [0; 8], length: 0, reserved: [0; 3] };
const NO_VERDICT: SupervisorVerdict =
    SupervisorVerdict { value: 0, limit: 0, margin: 0, kind: 0, reason: 0, reserved: [0; 2] };
/// Nothing decided: every field 0.
pub const NO_DECISION: SupervisorDecision = SupervisorDecision {
    verdicts: [NO_VERDICT; SUPERVISOR_CHANNELS],
    status: SupervisorStatus {
        parked_for_ms: 0,
        faults: 0,
        occupancy: 0,
        parked_by_leave: 0,
        stage: 0,
        level: 0,
        mode: 0,
        exit: 0,
        safe_state: 0,
        record: 0,
    },
    outputs: NO_OUTPUTS,
};
/// Every field 0.
pub const NO_OUTPUTS: SupervisorOutputs = SupervisorOutputs {
    target_speed: 0,
    brake_total: 0,
    brake_electric: 0,
    steering_angle: 0,
    steering_rate: 0,
    steering_overlay: 0,
    drive_torque: 0,
    drive_active: 0,
    drive_origin: 0,
    brake_mode: 0,
    brake_priority: 0,
    retarder_torque: 0,
    retarder_mode: 0,
    retarder_priority: 0,
    gear: 0,
    epb_request: 0,
    epb_mode: 0,
    steering_enable: 0,
    steering_weight: 0,
    steering_bar_limit: 0,
    k4: 0,
    k1: 0,
    air_pump: 0,
    power_steering: 0,
    dc_dc: 0,
    forward_collision: 0,
    pedestrian: 0,
    seat_leave: 0,
    hazard_flashers: 0,
    fault_lamp: 0,
    notice_lamp: 0,
    lane_departure: 0,
    speed_limit: 0,
    headway: 0,
    wipers: 0,
    brake_lamps: 0,
    indicator_left: 0,
    indicator_right: 0,
    low_beam: 0,
    high_beam: 0,
    horn: 0,
    mode: 0,
};

/// One step.
pub fn step(state: &mut SupervisorState, now_ms: u32) -> Stepped {
    let (mut decision, mut frames, mut count) = (NO_DECISION, [NO_FRAME; SUPERVISOR_OUTPUT_FRAMES], usize::MAX);
    let code =
        call!(supervisor_step(state, now_ms, &raw mut decision, frames.as_mut_ptr(), frames.len(), &raw mut count));
    Stepped { code, decision, frames: frames.into_iter().take(count).collect() }
}

/// The answer of the watchdog.
pub fn watchdog(state: &mut SupervisorState, question: u8) -> (SupervisorCode, [u8; SUPERVISOR_ANSWER_BYTES]) {
    let mut answer = [0xA5; SUPERVISOR_ANSWER_BYTES];
    let code = call!(supervisor_watchdog(state, question, answer.as_mut_ptr()));
    (code, answer)
}

/// Vets the fields of one channel.
pub fn vet(
    state: &mut SupervisorState,
    now_ms: u32,
    channel: u8,
    asked: &SupervisorOutputs,
) -> (SupervisorCode, SupervisorOutputs, SupervisorVerdict) {
    let (mut outputs, mut verdict) = (NO_OUTPUTS, NO_VERDICT);
    let code = call!(supervisor_vet(state, now_ms, channel, asked, &raw mut outputs, &raw mut verdict));
    (code, outputs, verdict)
}

/// Takes a frame in.
pub fn receive(
    state: &mut SupervisorState,
    now_ms: u32,
    frame: &SupervisorFrame,
) -> (SupervisorCode, SupervisorReceipt) {
    let mut receipt = SupervisorReceipt { message: 0, fault: 0, lost: 0, reserved: 0 };
    let code = call!(supervisor_receive(state, now_ms, frame, &raw mut receipt));
    (code, receipt)
}
