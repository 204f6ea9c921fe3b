//! Frames in, the step, frames out, the watchdog.
#![expect(unsafe_code, reason = "C calls these functions by their names and with pointers")]

use supervisor::wire::Frame;
use supervisor::{Decision, Flow, Millis};

use super::code;
use crate::codes::SupervisorCode;
use crate::memory::{Input, Output, Place, Span, disjoint};
use crate::state::{Last, State};
use crate::types::{
    SUPERVISOR_ANSWER_BYTES, SUPERVISOR_OUTPUT_FRAMES, SupervisorDecision, SupervisorFrame, SupervisorReceipt,
    SupervisorState,
};

/// Takes in a frame of the sensors or of the main controller, as it was read from the bus, of whatever identifier.
///
/// `now_ms` is the time at which it was read. `receipt` may be null. `SUPERVISOR_CODE_FRAME_REFUSED` is nothing to
/// react to: the vetting knows that the frame failed.
///
/// # Safety
/// Each pointer leads to one value of its type; nothing else touches them during the call.
#[must_use]
// SAFETY: no other function of the program has this name; it begins with that of the library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn supervisor_receive(
    state: *mut SupervisorState,
    now_ms: u32,
    frame: *const SupervisorFrame,
    receipt: *mut SupervisorReceipt,
) -> SupervisorCode {
    // SAFETY: promised by the caller.
    unsafe {
        take(state, frame, receipt, |state, frame| match state.receiver.accept(Millis::new(now_ms), &frame) {
            Ok(accepted) => (SupervisorCode::Ok, SupervisorReceipt::accepted(accepted)),
            Err(refusal) => (SupervisorCode::FrameRefused, SupervisorReceipt::refused(refusal)),
        })
    }
}

/// Takes in a frame that the supervisor's node reads from the bus of the actuators, its own echoes among them
/// (SELF-10): a command that is not ours is found, reported, and answered by the next step.
///
/// Feedback that comes by this bus goes to `supervisor_receive`, too. `receipt` may be null.
///
/// # Safety
/// As for `supervisor_receive`.
#[must_use]
// SAFETY: no other function of the program has this name; it begins with that of the library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn supervisor_receive_actuator(
    state: *mut SupervisorState,
    now_ms: u32,
    frame: *const SupervisorFrame,
    receipt: *mut SupervisorReceipt,
) -> SupervisorCode {
    // SAFETY: promised by the caller.
    unsafe {
        take(state, frame, receipt, |State { receiver, sender, .. }, frame| {
            match receiver.accept_actuator(Millis::new(now_ms), &frame, sender) {
                Ok(()) => (SupervisorCode::Ok, SupervisorReceipt::NOTHING),
                Err(refusal) => (SupervisorCode::FrameRefused, SupervisorReceipt::refused(refusal)),
            }
        })
    }
}

/// # Safety
/// As for `supervisor_receive`.
unsafe fn take(
    state: *mut SupervisorState,
    frame: *const SupervisorFrame,
    receipt: *mut SupervisorReceipt,
    accept: impl FnOnce(&mut State, Frame) -> (SupervisorCode, SupervisorReceipt),
) -> SupervisorCode {
    code(|| {
        // SAFETY: promised by the caller.
        let place = unsafe { Place::<State>::new(state) }?;
        // SAFETY: promised by the caller.
        let frame = unsafe { Input::new(frame, 1) }?;
        // SAFETY: promised by the caller.
        let receipt = unsafe { Output::optional(receipt) }?;
        disjoint(&[place.span(), frame.span(), receipt.as_ref().map_or(Span::NOTHING, Output::span)])?;
        let frame = frame.first().ok_or(SupervisorCode::Null)?.frame();
        let (result, given) = place.enter(|state| accept(state, frame))?;
        if let Some(receipt) = receipt {
            receipt.put(0, given);
        }
        Ok(result)
    })
}

/// One cycle, every 10 ms: reads what came, decides, vets every channel, and gives the frames to send, in order.
///
/// `now_ms` is the time of the cycle; it may wrap. `frames` has room for `capacity` frames, at least
/// `SUPERVISOR_OUTPUT_FRAMES`, or nothing is done; `count` says how many were written. Send them as they are.
/// Whatever came in or did not come, the step gives its frames; a step that is refused gives none.
///
/// # Safety
/// `frames` leads to room for `capacity` frames, each other pointer to one value of its type; nothing else touches
/// them during the call.
#[must_use]
// SAFETY: no other function of the program has this name; it begins with that of the library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn supervisor_step(
    state: *mut SupervisorState,
    now_ms: u32,
    decision: *mut SupervisorDecision,
    frames: *mut SupervisorFrame,
    capacity: usize,
    count: *mut usize,
) -> SupervisorCode {
    code(|| {
        // SAFETY: promised by the caller.
        let count = unsafe { Output::new(count, 1) }?;
        // SAFETY: promised by the caller.
        let place = unsafe { Place::<State>::new(state) }?;
        // Not into the state, whatever else is wrong.
        disjoint(&[place.span(), count.span()])?;
        count.put(0, 0);
        // SAFETY: promised by the caller.
        let decision = unsafe { Output::new(decision, 1) }?;
        // SAFETY: promised by the caller.
        let frames = unsafe { Output::new(frames, capacity) }?;
        disjoint(&[place.span(), count.span(), decision.span(), frames.span()])?;
        if capacity < SUPERVISOR_OUTPUT_FRAMES {
            return Err(SupervisorCode::Capacity);
        }
        let mut sent = 0_usize;
        let mut emit = |frame| {
            frames.put(sent, SupervisorFrame::of(frame));
            sent = sent.saturating_add(1);
        };
        let decided = place.enter(|state| cycle(state, Millis::new(now_ms), &mut emit))?;
        decision.put(0, SupervisorDecision::of(&decided));
        count.put(0, sent);
        Ok(SupervisorCode::Ok)
    })
}

/// As the Rust interface has it: sample, step, send.
fn cycle(state: &mut State, now: Millis, emit: &mut impl FnMut(Frame)) -> Decision {
    let State { supervisor, receiver, sender, last } = state;
    let sample = receiver.sample(now);
    let decision = supervisor.step(now, sample.inputs, sample.scene, sample.commands);
    sender.encode_outputs(now, &decision.outputs, emit);
    sender.encode_status(now, &decision.status, emit);
    *last = Some(Last { now, decision, flow: decision.flow });
    decision
}

/// The four bytes for the watchdog's question (its low four bits), in the order in which they are sent (SELF-6).
///
/// Right only after a step that ran whole and in order, and once for each step: the second answer, and the one before
/// the first step, are wrong, and the code says so. If the call is refused for another reason, the answer is four
/// zeros, which is wrong for every question.
///
/// # Safety
/// `answer` leads to room for `SUPERVISOR_ANSWER_BYTES` bytes, `state` to a state; nothing else touches them during the
/// call.
#[must_use]
// SAFETY: no other function of the program has this name; it begins with that of the library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn supervisor_watchdog(
    state: *mut SupervisorState,
    question: u8,
    answer: *mut u8,
) -> SupervisorCode {
    code(|| {
        // SAFETY: promised by the caller.
        let answer = unsafe { Output::new(answer, SUPERVISOR_ANSWER_BYTES) }?;
        let say = |bytes: [u8; SUPERVISOR_ANSWER_BYTES]| {
            bytes.into_iter().enumerate().for_each(|(at, byte)| answer.put(at, byte));
        };
        let refuse = |code| {
            say([0; SUPERVISOR_ANSWER_BYTES]);
            code
        };
        // SAFETY: promised by the caller.
        let place = unsafe { Place::<State>::new(state) }.map_err(refuse)?;
        // Not into the state, whatever else is wrong.
        disjoint(&[place.span(), answer.span()])?;
        let flow = |state: &mut State| {
            state.last.as_mut().map_or(Flow::START, |last| core::mem::replace(&mut last.flow, Flow::START))
        };
        let flow = place.enter(flow).map_err(refuse)?;
        say(flow.answer(question));
        Ok(if flow == Flow::START { SupervisorCode::NotStepped } else { SupervisorCode::Ok })
    })
}
