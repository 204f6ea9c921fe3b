//! Every argument that is refused, and what is left of the state after it. Also run under Miri: see the README.
#![expect(dead_code, reason = "each test file uses a part of the caller")]

mod common;
use common::*;
use supervisor::Flow;
use supervisor_capi::*;

/// Never called: keeps the expectation above fulfilled also where a file uses all of the caller.
fn _unused() {}

fn init(state: *mut SupervisorState, sealed: &[u8], cause: u8, record: u8) -> SupervisorCode {
    let (bytes, version) = (SUPERVISOR_STATE_BYTES, SUPERVISOR_ABI_VERSION);
    call!(supervisor_init(state, bytes, version, sealed.as_ptr(), sealed.len(), cause, record))
}

/// Every call that takes a state, with every other argument as it should be.
fn every_call(state: *mut SupervisorState) -> Vec<(&'static str, SupervisorCode)> {
    let (mut decision, mut frames, mut count) = (NO_DECISION, [NO_FRAME; SUPERVISOR_OUTPUT_FRAMES], 0_usize);
    let mut answer = [0; SUPERVISOR_ANSWER_BYTES];
    let (asked, mut outputs, mut verdict) = (NO_OUTPUTS, NO_OUTPUTS, NO_DECISION.verdicts[0]);
    let (frame, none) = (NO_FRAME, core::ptr::null_mut());
    let mut diagnosis = Box::new(SupervisorDiagnosis::ZERO);
    let started =
        call!(supervisor_diagnosis_init(&raw mut *diagnosis, SUPERVISOR_DIAGNOSIS_BYTES, SUPERVISOR_ABI_VERSION));
    assert_eq!(started, SupervisorCode::Ok);
    vec![
        ("receive", call!(supervisor_receive(state, 10, &raw const frame, none))),
        ("receive_actuator", call!(supervisor_receive_actuator(state, 10, &raw const frame, none))),
        (
            "step",
            call!(supervisor_step(state, 10, &raw mut decision, frames.as_mut_ptr(), frames.len(), &raw mut count)),
        ),
        ("vet", call!(supervisor_vet(state, 10, 0, &raw const asked, &raw mut outputs, &raw mut verdict))),
        ("watchdog", call!(supervisor_watchdog(state, 0, answer.as_mut_ptr()))),
        ("observe", call!(supervisor_diagnosis_observe(&raw mut *diagnosis, state, core::ptr::null()))),
    ]
}

/// The same of a diagnosis.
fn every_call_of_diagnosis(diagnosis: *mut SupervisorDiagnosis) -> Vec<(&'static str, SupervisorCode)> {
    let mut state = started();
    assert_eq!(step(&mut state, 10).code, SupervisorCode::Ok);
    let (mut count, mut frame) = (0_usize, NO_FRAME);
    let mut events = vec![NO_EVENT; SUPERVISOR_EVENTS];
    let mut troubles = vec![NO_TROUBLE; SUPERVISOR_TROUBLES];
    let (events, troubles) = (events.as_mut_slice(), troubles.as_mut_slice());
    let (all, none) = (events.len(), core::ptr::null_mut());
    vec![
        ("observe", call!(supervisor_diagnosis_observe(diagnosis, &raw mut *state, core::ptr::null()))),
        ("events", call!(supervisor_diagnosis_events(diagnosis, events.as_mut_ptr(), all, &raw mut count, none))),
        (
            "troubles",
            call!(supervisor_diagnosis_troubles(diagnosis, troubles.as_mut_ptr(), troubles.len(), &raw mut count)),
        ),
        ("dm1", call!(supervisor_diagnosis_dm1(diagnosis, 10, &raw mut frame))),
    ]
}

const NO_EVENT: SupervisorEvent =
    SupervisorEvent { time_ms: 0, value: 0, limit: 0, margin: 0, code: 0, what: 0, channel: 0, kind: 0, reason: 0 };
const NO_TROUBLE: SupervisorTrouble =
    SupervisorTrouble { spn: 0, fmi: 0, lamp: 0, system: 0, ads_code: 0, occurrences: 0, present: 0, reserved: [0; 2] };

fn all_are(expected: SupervisorCode, calls: Vec<(&'static str, SupervisorCode)>) {
    for (call, code) in calls {
        assert_eq!(code, expected, "{call}");
    }
}

/// SELF-1a: null, for every pointer that may not be.
#[test]
fn null_is_refused() {
    let (none, one) = (core::ptr::null_mut(), core::ptr::null_mut());
    all_are(SupervisorCode::Null, every_call(none));
    all_are(SupervisorCode::Null, every_call_of_diagnosis(one));
    let mut state = started();
    let state = &raw mut *state;
    let (mut decision, mut frames, mut count) = (NO_DECISION, [NO_FRAME; SUPERVISOR_OUTPUT_FRAMES], 7_usize);
    let (asked, mut outputs, mut verdict) = (NO_OUTPUTS, NO_OUTPUTS, NO_DECISION.verdicts[0]);
    let (room, null) = (frames.len(), core::ptr::null_mut());
    let sealed = core::ptr::null();
    for code in [
        init(none, &common::sealed(), POWER_ON, NO_RECORD),
        call!(supervisor_init(state, SUPERVISOR_STATE_BYTES, SUPERVISOR_ABI_VERSION, sealed, 0, POWER_ON, NO_RECORD)),
        call!(supervisor_diagnosis_init(one, SUPERVISOR_DIAGNOSIS_BYTES, SUPERVISOR_ABI_VERSION)),
    ] {
        assert_eq!(code, SupervisorCode::Null);
    }
    let mut state = started();
    let state = &raw mut *state;
    for code in [
        call!(supervisor_receive(state, 10, core::ptr::null(), core::ptr::null_mut())),
        call!(supervisor_receive_actuator(state, 10, core::ptr::null(), core::ptr::null_mut())),
        call!(supervisor_step(state, 10, core::ptr::null_mut(), frames.as_mut_ptr(), room, &raw mut count)),
        call!(supervisor_step(state, 10, &raw mut decision, core::ptr::null_mut(), room, &raw mut count)),
        call!(supervisor_step(state, 10, &raw mut decision, frames.as_mut_ptr(), room, core::ptr::null_mut())),
        call!(supervisor_vet(state, 10, 0, core::ptr::null(), &raw mut outputs, &raw mut verdict)),
        call!(supervisor_vet(state, 10, 0, &raw const asked, core::ptr::null_mut(), &raw mut verdict)),
        call!(supervisor_vet(state, 10, 0, &raw const asked, &raw mut outputs, core::ptr::null_mut())),
        call!(supervisor_watchdog(state, 0, null)),
    ] {
        assert_eq!(code, SupervisorCode::Null);
    }
    assert_eq!(count, 0, "the count of a refused step");
    assert_eq!(decision, NO_DECISION, "a refused step decides nothing");
}

/// SELF-1a: a pointer that does not have the alignment of its type.
#[test]
fn misaligned_is_refused() {
    let mut room = [0_u64; SUPERVISOR_STATE_WORDS + 1];
    let base = room.as_mut_ptr();
    let odd = base.wrapping_byte_add(4);
    all_are(SupervisorCode::Misaligned, every_call(odd.cast()));
    all_are(SupervisorCode::Misaligned, every_call_of_diagnosis(odd.cast()));
    assert_eq!(init(odd.cast(), &sealed(), POWER_ON, NO_RECORD), SupervisorCode::Misaligned);
    let odd = base.wrapping_byte_add(1);
    let mut state = started();
    let (state, mut count) = (&raw mut *state, 0_usize);
    let (mut decision, mut frames) = (NO_DECISION, [NO_FRAME; SUPERVISOR_OUTPUT_FRAMES]);
    let room = frames.len();
    for code in [
        call!(supervisor_receive(state, 10, odd.cast(), core::ptr::null_mut())),
        call!(supervisor_step(state, 10, odd.cast(), frames.as_mut_ptr(), room, &raw mut count)),
        call!(supervisor_step(state, 10, &raw mut decision, odd.cast(), room, &raw mut count)),
        call!(supervisor_step(state, 10, &raw mut decision, frames.as_mut_ptr(), room, odd.cast())),
    ] {
        assert_eq!(code, SupervisorCode::Misaligned);
    }
    // Bytes have no alignment to miss.
    let mut bytes = [0; SUPERVISOR_SEALED_BYTES + 1];
    for (to, from) in bytes.iter_mut().skip(1).zip(sealed()) {
        *to = from;
    }
    let mut state = zeroed();
    assert_eq!(init(&raw mut *state, &bytes[1..], POWER_ON, NO_RECORD), SupervisorCode::Ok);
}

/// SELF-1a: memory that is too small, or ends beyond the address space; another version of the header.
#[test]
fn too_small_and_another_version_are_refused() {
    let mut state = started();
    let (state, sealed) = (&raw mut *state, sealed());
    let start = |bytes, version, length| {
        call!(supervisor_init(state, bytes, version, sealed.as_ptr(), length, POWER_ON, NO_RECORD))
    };
    assert_eq!(start(SUPERVISOR_STATE_BYTES - 1, SUPERVISOR_ABI_VERSION, sealed.len()), SupervisorCode::Size);
    for version in [0, SUPERVISOR_ABI_VERSION + 1, u32::MAX] {
        assert_eq!(start(SUPERVISOR_STATE_BYTES, version, sealed.len()), SupervisorCode::Version);
    }
    assert_eq!(start(SUPERVISOR_STATE_BYTES, SUPERVISOR_ABI_VERSION, usize::MAX), SupervisorCode::Size);
    let mut diagnosis = Box::new(SupervisorDiagnosis::ZERO);
    let diagnosis = &raw mut *diagnosis;
    for (bytes, version, expected) in [
        (SUPERVISOR_DIAGNOSIS_BYTES - 1, SUPERVISOR_ABI_VERSION, SupervisorCode::Size),
        (SUPERVISOR_DIAGNOSIS_BYTES, SUPERVISOR_ABI_VERSION + 1, SupervisorCode::Version),
    ] {
        assert_eq!(call!(supervisor_diagnosis_init(diagnosis, bytes, version)), expected);
    }
    // A list of frames longer than the address space; one that is too short for a whole cycle.
    let mut state = started();
    let (mut decision, mut frames, mut count) = (NO_DECISION, [NO_FRAME; SUPERVISOR_OUTPUT_FRAMES], 7_usize);
    let mut stepped = |room| {
        call!(supervisor_step(&raw mut *state, 10, &raw mut decision, frames.as_mut_ptr(), room, &raw mut count))
    };
    assert_eq!(stepped(usize::MAX), SupervisorCode::Size);
    assert_eq!(stepped(usize::MAX / 16), SupervisorCode::Size);
    assert_eq!(stepped(SUPERVISOR_OUTPUT_FRAMES - 1), SupervisorCode::Capacity);
    assert_eq!(count, 0, "nothing is sent of a cycle that has no room");
    assert_eq!(decision, NO_DECISION, "nor decided");
}

/// SELF-4d: nothing works before the start, and after one that was refused.
#[test]
fn uninitialised_is_refused() {
    all_are(SupervisorCode::Uninitialised, every_call(&raw mut *zeroed()));
    all_are(SupervisorCode::Uninitialised, every_call_of_diagnosis(&raw mut *Box::new(SupervisorDiagnosis::ZERO)));
    // A start that is refused ends what was there.
    let mut state = started();
    assert_eq!(step(&mut state, 10).code, SupervisorCode::Ok);
    assert_eq!(init(&raw mut *state, &[0; SUPERVISOR_SEALED_BYTES], POWER_ON, NO_RECORD), SupervisorCode::ConfigHeader);
    all_are(SupervisorCode::Uninitialised, every_call(&raw mut *state));
    // The magic word alone is not enough, nor is its complement; a state is no diagnosis.
    for word in [0, 1] {
        let mut state = started();
        let words = (&raw mut *state).cast::<u32>();
        let flipped = call!(words.add(word).read()) ^ 1;
        call!(words.add(word).write(flipped));
        all_are(SupervisorCode::Uninitialised, every_call(&raw mut *state));
    }
    all_are(SupervisorCode::Uninitialised, every_call_of_diagnosis((&raw mut *started()).cast()));
}

/// SELF-1a: a call in another context, or one that never ended, shuts the state.
#[test]
fn a_running_call_is_refused() {
    let mut state = started();
    let gate = call!((&raw mut *state).cast::<u32>().add(2));
    let ready = call!(gate.read());
    for busy in [0, ready ^ 1, u32::MAX] {
        call!(gate.write(busy));
        all_are(SupervisorCode::Busy, every_call(&raw mut *state));
    }
    call!(gate.write(ready));
    assert_eq!(step(&mut state, 10).code, SupervisorCode::Ok, "nothing else was changed");
    // A start puts it right, as it must after a warm reset in the middle of a call.
    call!(gate.write(0));
    assert_eq!(init(&raw mut *state, &sealed(), POWER_ON, NO_RECORD), SupervisorCode::Ok);
    assert_eq!(step(&mut state, 10).code, SupervisorCode::Ok);
}

/// Aligned for any argument, so that what overlaps is not misaligned, too.
#[repr(align(8))]
struct Aligned<T>(T);

/// SELF-1a: two arguments that share memory, for every pair.
#[test]
fn overlapping_is_refused() {
    let mut state = started();
    let inside = (&raw mut *state).cast::<u64>().wrapping_add(20);
    let state = &raw mut *state;
    let (mut decision, mut frames) = (Aligned(NO_DECISION), Aligned([NO_FRAME; SUPERVISOR_OUTPUT_FRAMES]));
    let (mut count, room) = (7_usize, SUPERVISOR_OUTPUT_FRAMES);
    let (decision, first, count) = (&raw mut decision.0, frames.0.as_mut_ptr(), &raw mut count);
    let (mut asked, mut verdict) = (Aligned(NO_OUTPUTS), NO_DECISION.verdicts[0]);
    let (asked, verdict) = (&raw mut asked.0, &raw mut verdict);
    let mut outputs = NO_OUTPUTS;
    let (outputs, none) = (&raw mut outputs, core::ptr::null_mut());
    for (number, code) in [
        call!(supervisor_receive(state, 10, inside.cast(), none)),
        call!(supervisor_receive(state, 10, first, inside.cast())),
        call!(supervisor_receive(state, 10, first, first.cast())),
        call!(supervisor_receive_actuator(state, 10, inside.cast(), none)),
        call!(supervisor_step(state, 10, inside.cast(), first, room, count)),
        call!(supervisor_step(state, 10, decision, inside.cast(), room, count)),
        call!(supervisor_step(state, 10, decision, first, room, inside.cast())),
        call!(supervisor_step(state, 10, first.cast(), first, room, count)),
        call!(supervisor_step(state, 10, decision, first, room, first.wrapping_add(1).cast())),
        call!(supervisor_step(state, 10, decision, first, room, decision.cast())),
        call!(supervisor_vet(state, 10, 0, asked, asked, verdict)),
        call!(supervisor_vet(state, 10, 0, asked, outputs, asked.cast())),
        call!(supervisor_vet(state, 10, 0, asked, inside.cast(), verdict)),
        call!(supervisor_vet(state, 10, 0, inside.cast(), outputs, verdict)),
        call!(supervisor_watchdog(state, 0, inside.cast())),
        call!(supervisor_diagnosis_observe(state.cast(), state, core::ptr::null())),
    ]
    .into_iter()
    .enumerate()
    {
        assert_eq!(code, SupervisorCode::Overlap, "number {number}");
    }
    // The state is as it was.
    let mut fresh = started();
    // SAFETY: `state` is a live box of this test.
    let stepped = call!(step(&mut *state, 10));
    assert_eq!(stepped.decision, step(&mut fresh, 10).decision);
    assert_eq!(stepped.code, SupervisorCode::Ok);
    let overlapping_configuration = call!(supervisor_init(
        state,
        SUPERVISOR_STATE_BYTES,
        SUPERVISOR_ABI_VERSION,
        inside.cast(),
        SUPERVISOR_SEALED_BYTES,
        POWER_ON,
        NO_RECORD
    ));
    assert_eq!(overlapping_configuration, SupervisorCode::Overlap);
}

/// CRC-32 (IEEE 802.3), for bytes that are sealed by somebody else.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xEDB8_8320 } else { crc >> 1 })
    })
}

/// The default with some words replaced, under a CRC that matches.
fn resealed(words: &[(usize, u32)]) -> [u8; SUPERVISOR_SEALED_BYTES] {
    let mut bytes = sealed();
    let end = SUPERVISOR_SEALED_BYTES - 4;
    for (index, word) in words {
        bytes[index * 4..index * 4 + 4].copy_from_slice(&word.to_le_bytes());
    }
    let crc = crc32(&bytes[..end]);
    bytes[end..].copy_from_slice(&crc.to_le_bytes());
    bytes
}

/// SELF-4a, SELF-4b, SELF-4c, SELF-4d: each check of the configuration has its code, and none starts.
#[test]
fn a_bad_configuration_does_not_start() {
    let good = sealed();
    let mut flipped = good;
    flipped[100] ^= 1;
    // Words 4, 6, 7 and 10: longest cycle, time-outs of 50 and 100 ms, difference of the two speeds.
    let refused: [(&[u8], SupervisorCode); 7] = [
        (&[], SupervisorCode::ConfigLength),
        (&good[1..], SupervisorCode::ConfigLength),
        (&resealed(&[(1, 0)]), SupervisorCode::ConfigHeader),
        (&flipped, SupervisorCode::ConfigCrc),
        (&resealed(&[(10, u32::MAX)]), SupervisorCode::ConfigWord),
        (&resealed(&[(4, 60)]), SupervisorCode::ConfigRange),
        (&resealed(&[(6, 180), (7, 150)]), SupervisorCode::ConfigRelation),
    ];
    for (bytes, code) in refused {
        let mut state = zeroed();
        assert_eq!(init(&raw mut *state, bytes, POWER_ON, NO_RECORD), code);
        all_are(SupervisorCode::Uninitialised, every_call(&raw mut *state));
    }
    assert_eq!(init(&raw mut *zeroed(), &resealed(&[(4, 40)]), POWER_ON, NO_RECORD), SupervisorCode::Ok);
}

/// SELF-9a: reset cause and record are codes of their tables; 255 is a record that fails its CRC.
#[test]
fn a_code_of_no_table_is_refused() {
    // Every code; under Miri, which takes its time, those around what is known.
    let tried = || (0..=u8::MAX).filter(|code| !cfg!(miri) || *code < 4 || *code > 253);
    for cause in tried() {
        for record in tried() {
            let known = cause < 3 && (record < 3 || record == SUPERVISOR_RECORD_BROKEN);
            let expected = if known { SupervisorCode::Ok } else { SupervisorCode::Value };
            assert_eq!(init(&raw mut *zeroed(), &sealed(), cause, record), expected, "{cause} {record}");
        }
    }
    let mut state = started();
    assert_eq!(step(&mut state, 10).code, SupervisorCode::Ok);
    for channel in (0..=u8::MAX).filter(|channel| !cfg!(miri) || (10..14).contains(channel)) {
        let expected = if channel < 12 { SupervisorCode::Ok } else { SupervisorCode::Value };
        assert_eq!(vet(&mut state, 10, channel, &NO_OUTPUTS).0, expected, "{channel}");
    }
}

/// SELF-6a, SELF-6b: the watchdog is answered right once for each step, and wrong in every other case.
#[test]
fn a_step_is_good_for_one_answer() {
    let mut state = started();
    for question in 0..=u8::MAX {
        let right = Flow::COMPLETE.answer(question);
        let (code, answer) = watchdog(&mut state, question);
        assert_eq!(code, SupervisorCode::NotStepped);
        assert_ne!(answer, right, "no step yet");
        assert_eq!(step(&mut state, 10 + u32::from(question) * 10).code, SupervisorCode::Ok);
        assert_eq!(watchdog(&mut state, question), (SupervisorCode::Ok, right));
        let (code, answer) = watchdog(&mut state, question);
        assert_eq!(code, SupervisorCode::NotStepped);
        assert_ne!(answer, right, "no step since");
        let (code, answer) = watchdog(&mut zeroed(), question);
        assert_eq!((code, answer), (SupervisorCode::Uninitialised, [0; 4]));
        assert_ne!(answer, right, "no supervisor");
        if cfg!(miri) && question == 15 {
            break;
        }
    }
}

/// SELF-3a: an envelope expires with its cycle, also across the wrap of the clock.
#[test]
fn an_envelope_expires() {
    let mut state = started();
    assert_eq!(vet(&mut state, 10, 0, &NO_OUTPUTS).0, SupervisorCode::NotStepped);
    let now = u32::MAX - 20;
    assert_eq!(step(&mut state, now).code, SupervisorCode::Ok);
    for (after, expected) in [(0, SupervisorCode::Ok), (50, SupervisorCode::Ok), (51, SupervisorCode::Expired)] {
        assert_eq!(vet(&mut state, now.wrapping_add(after), 0, &NO_OUTPUTS).0, expected, "{after} ms");
    }
    assert_eq!(vet(&mut state, now - 1, 0, &NO_OUTPUTS).0, SupervisorCode::Expired, "before the step");
}
