//! Event record, trouble codes, DM1.
#![expect(unsafe_code, reason = "C calls these functions by their names and with pointers")]

use supervisor::Millis;
use supervisor::report::BodyFeedback;

use super::code;
use crate::codes::SupervisorCode;
use crate::diagnosis::Diagnosis;
use crate::memory::{Input, Output, Place, Plain, Span, disjoint};
use crate::state::State;
use crate::types::{
    SupervisorBodyFeedback, SupervisorDiagnosis, SupervisorEvent, SupervisorFrame, SupervisorState, SupervisorTrouble,
};

/// Takes over what the last step decided; once after every step. The state is only read.
///
/// `feedback` is what lamps and wipers say of themselves, or null.
///
/// # Safety
/// Each pointer leads to one value of its type; nothing else touches them during the call.
#[must_use]
// SAFETY: no other function of the program has this name; it begins with that of the library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn supervisor_diagnosis_observe(
    diagnosis: *mut SupervisorDiagnosis,
    state: *mut SupervisorState,
    feedback: *const SupervisorBodyFeedback,
) -> SupervisorCode {
    code(|| {
        // SAFETY: promised by the caller.
        let place = unsafe { Place::<Diagnosis>::new(diagnosis) }?;
        // SAFETY: promised by the caller.
        let state = unsafe { Place::<State>::new(state) }?;
        // SAFETY: promised by the caller.
        let feedback = unsafe { Input::optional(feedback) }?;
        disjoint(&[place.span(), state.span(), feedback.as_ref().map_or(Span::NOTHING, Input::span)])?;
        let feedback = feedback.and_then(|feedback| feedback.first());
        let feedback = feedback.map_or(BodyFeedback::NEVER, SupervisorBodyFeedback::feedback);
        let last = state.enter(|state| state.last)?.ok_or(SupervisorCode::NotStepped)?;
        place.enter(|diagnosis| diagnosis.observe(last.now, &last.decision, &feedback))?;
        Ok(SupervisorCode::Ok)
    })
}

/// The last changes of verdicts and status, from the oldest to the newest; of a longer record the newest `capacity`.
/// `count` says how many were written, `dropped` (or null) how many the record had no room for.
///
/// # Safety
/// `events` leads to room for `capacity` events, each other pointer to one value of its type; nothing else touches them
/// during the call.
#[must_use]
// SAFETY: no other function of the program has this name; it begins with that of the library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn supervisor_diagnosis_events(
    diagnosis: *mut SupervisorDiagnosis,
    events: *mut SupervisorEvent,
    capacity: usize,
    count: *mut usize,
    dropped: *mut u32,
) -> SupervisorCode {
    code(|| {
        // SAFETY: promised by the caller.
        let dropped = unsafe { Output::optional(dropped) }?;
        // SAFETY: promised by the caller.
        let list = unsafe {
            List::new(diagnosis, events, capacity, count, dropped.as_ref().map_or(Span::NOTHING, Output::span))
        }?;
        let gone = list.place.enter(|diagnosis| {
            // Not `count()`: its sum is checked, and the check is a panic.
            let all = diagnosis.record.iter().fold(0_usize, |all, _| all.saturating_add(1));
            let skipped = all.saturating_sub(capacity);
            list.fill(diagnosis.record.iter().skip(skipped).map(SupervisorEvent::of));
            diagnosis.record.dropped()
        })?;
        if let Some(dropped) = dropped {
            dropped.put(0, gone);
        }
        Ok(SupervisorCode::Ok)
    })
}

/// The trouble codes that are active, debounced, in the order of the table; `SUPERVISOR_TROUBLES` at most. `count` says
/// how many were written.
///
/// # Safety
/// `troubles` leads to room for `capacity` codes, each other pointer to one value of its type; nothing else touches
/// them during the call.
#[must_use]
// SAFETY: no other function of the program has this name; it begins with that of the library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn supervisor_diagnosis_troubles(
    diagnosis: *mut SupervisorDiagnosis,
    troubles: *mut SupervisorTrouble,
    capacity: usize,
    count: *mut usize,
) -> SupervisorCode {
    code(|| {
        // SAFETY: promised by the caller.
        let list = unsafe { List::new(diagnosis, troubles, capacity, count, Span::NOTHING) }?;
        list.place.enter(|diagnosis| list.fill(diagnosis.faults.active().map(SupervisorTrouble::of)))?;
        Ok(SupervisorCode::Ok)
    })
}

/// The frame of J1939 DM1 to send now; `SUPERVISOR_CODE_NOTHING` if none is due. Once in every cycle.
///
/// # Safety
/// Each pointer leads to one value of its type; nothing else touches them during the call.
#[must_use]
// SAFETY: no other function of the program has this name; it begins with that of the library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn supervisor_diagnosis_dm1(
    diagnosis: *mut SupervisorDiagnosis,
    now_ms: u32,
    frame: *mut SupervisorFrame,
) -> SupervisorCode {
    code(|| {
        // SAFETY: promised by the caller.
        let place = unsafe { Place::<Diagnosis>::new(diagnosis) }?;
        // SAFETY: promised by the caller.
        let frame = unsafe { Output::new(frame, 1) }?;
        disjoint(&[place.span(), frame.span()])?;
        let due = place.enter(|Diagnosis { dm1, faults, .. }| dm1.poll(Millis::new(now_ms), faults))?;
        let due = due.ok_or(SupervisorCode::Nothing)?;
        frame.put(0, SupervisorFrame { id: due.id, data: due.data, length: 8, reserved: [0; 3] });
        Ok(SupervisorCode::Ok)
    })
}

/// A diagnosis, and room for a list out of it.
struct List<T> {
    place: Place<Diagnosis>,
    room: Output<T>,
    count: Output<usize>,
}

impl<T: Plain> List<T> {
    /// # Safety
    /// `room` leads to room for `capacity` values, each other pointer to one value of its type; nothing else touches
    /// them while this lives.
    unsafe fn new(
        diagnosis: *mut SupervisorDiagnosis,
        room: *mut T,
        capacity: usize,
        count: *mut usize,
        beside: Span,
    ) -> Result<Self, SupervisorCode> {
        // SAFETY: promised by the caller.
        let count = unsafe { Output::new(count, 1) }?;
        // SAFETY: promised by the caller.
        let place = unsafe { Place::<Diagnosis>::new(diagnosis) }?;
        disjoint(&[place.span(), count.span()])?;
        count.put(0, 0);
        // SAFETY: promised by the caller.
        let room = unsafe { Output::new(room, capacity) }?;
        disjoint(&[place.span(), count.span(), room.span(), beside])?;
        Ok(Self { place, room, count })
    }

    /// Writes as many as there is room for, and says how many.
    fn fill(&self, values: impl Iterator<Item = T>) {
        let mut written = 0_usize;
        for value in values.take(self.room.count()) {
            self.room.put(written, value);
            written = written.saturating_add(1);
        }
        self.count.put(0, written);
    }
}
