//! Program flow: SELF-6. Every wrong order of the stages up to nine long, and every question of the watchdog.

mod common;
use common::*;

/// Response bytes 3, 2, 1, 0 to the questions 0 to 15, written down apart from the code.
const TABLE: [[u8; 4]; 16] = [
    [0xFF, 0x0F, 0xF0, 0x00],
    [0xB0, 0x40, 0xBF, 0x4F],
    [0xE9, 0x19, 0xE6, 0x16],
    [0xA6, 0x56, 0xA9, 0x59],
    [0x75, 0x85, 0x7A, 0x8A],
    [0x3A, 0xCA, 0x35, 0xC5],
    [0x63, 0x93, 0x6C, 0x9C],
    [0x2C, 0xDC, 0x23, 0xD3],
    [0xD2, 0x22, 0xDD, 0x2D],
    [0x9D, 0x6D, 0x92, 0x62],
    [0xC4, 0x34, 0xCB, 0x3B],
    [0x8B, 0x7B, 0x84, 0x74],
    [0x58, 0xA8, 0x57, 0xA7],
    [0x17, 0xE7, 0x18, 0xE8],
    [0x4E, 0xBE, 0x41, 0xB1],
    [0x01, 0xF1, 0x0E, 0xFE],
];

const ORDER: [Checkpoint; 8] = [
    Checkpoint::Perceive,
    Checkpoint::Decode,
    Checkpoint::Configuration,
    Checkpoint::Observe,
    Checkpoint::Decide,
    Checkpoint::Vet,
    Checkpoint::Record,
    Checkpoint::Encode,
];

fn run(stages: &[Checkpoint]) -> Flow {
    stages.iter().fold(Flow::START, |flow, stage| flow.pass(*stage))
}

fn questions() -> impl Iterator<Item = (u8, [u8; 4])> {
    (0..16).zip(TABLE)
}

/// No question is answered rightly.
#[track_caller]
fn assert_wrong(flow: Flow, name: &str) {
    for (question, right) in questions() {
        assert_ne!(flow.answer(question), right, "SELF-6b: {name}, question {question}");
    }
}

/// SELF-6a: all stages once and in order: the right answer to each question, whatever its upper four bits are.
#[test]
fn right_answers() {
    assert_eq!(run(&ORDER), Flow::COMPLETE);
    for (question, right) in questions() {
        for upper in 0..16 {
            assert_eq!(Flow::COMPLETE.answer(question | upper << 4), right, "question {question}");
        }
    }
}

/// SELF-6a: the cycle itself answers rightly, in every cycle.
#[test]
fn the_cycle_answers() {
    let mut bus = Bus::driving(kmh(30));
    for _ in 0..100 {
        let decision = bus.step();
        for (question, right) in questions() {
            assert_eq!(decision.flow.answer(question), right);
        }
        assert!(!decision.status.faults.contains(Faults::FLOW));
    }
}

/// SELF-6b: each stage skipped, repeated, and each two swapped.
#[test]
fn one_mistake() {
    for (index, stage) in ORDER.into_iter().enumerate() {
        let mut skipped = ORDER.to_vec();
        skipped.remove(index);
        assert_wrong(run(&skipped), &format!("without {stage:?}"));
        for other in 0..ORDER.len() {
            let mut repeated = ORDER.to_vec();
            repeated.insert(other, stage);
            assert_wrong(run(&repeated), &format!("{stage:?} also at {other}"));
            if other != index {
                let mut swapped = ORDER;
                swapped.swap(index, other);
                assert_wrong(run(&swapped), &format!("{index} and {other} swapped"));
            }
        }
    }
    for count in 0..8 {
        assert_wrong(run(&ORDER[..count]), &format!("only {count} stages"));
    }
}

/// SELF-6b: a wrong signature changes the answer to every question by the same bits: none is right by what the table happens to hold.
#[test]
fn a_wrong_signature_changes_every_answer_alike() {
    for count in 0..8 {
        let flow = run(&ORDER[..count]);
        let changed =
            |(question, right): (u8, [u8; 4])| u32::from_le_bytes(flow.answer(question)) ^ u32::from_le_bytes(right);
        let all: std::collections::BTreeSet<u32> = questions().map(changed).collect();
        assert_eq!(all.len(), 1, "only {count} stages: {all:?}");
        assert!(!all.contains(&0));
    }
}

/// Every sequence of up to `left` more stages; how many there were, and how many of them have the right signature.
fn explore(flow: Flow, left: u32, visit: &mut impl FnMut(Flow)) {
    visit(flow);
    if left > 0 {
        for stage in ORDER {
            explore(flow.pass(stage), left - 1, visit);
        }
    }
}

/// SELF-6b: of all 153 391 689 sequences of up to nine stages only the right one has the right signature.
#[test]
fn every_sequence() {
    let (mut all, mut right) = (0_u32, 0_u32);
    explore(Flow::START, 9, &mut |flow| {
        all += 1;
        right += u32::from(flow == Flow::COMPLETE);
    });
    assert_eq!((all, right), (153_391_689, 1));
}

/// SELF-6b: any other signature changes the answer to all 16 questions: the 299 593 sequences of up to six stages, all
/// wrong, each with all its questions.
#[test]
fn every_question() {
    let mut all = 0_u32;
    explore(Flow::START, 6, &mut |flow| {
        all += 1;
        assert_wrong(flow, "a short sequence");
    });
    assert_eq!(all, 299_593);
}

/// SELF-6b: a cycle without its perception: wrong answer, and in the next cycle the safe state, latched.
#[test]
fn without_perception() {
    let Ok(sealed) = Sealed::from_default() else { unreachable!("the table is valid") };
    let mut image = StateImage::encode(&State::boot(ResetCause::PowerOn, Some(Record::None)));
    let mut now = 0;
    let mut cycle = |flow| {
        now += CYCLE;
        let commands = Outputs::NEUTRAL.as_commands();
        step(&mut image, &sealed, flow, Millis::new(now), &healthy(), &Threat::CLEAR, &commands)
    };
    for _ in 0..300 {
        let decision = cycle(Flow::PERCEIVED);
        assert!(decision.flow == Flow::COMPLETE && !decision.status.safe_state);
    }
    for wrong in [Flow::START, Flow::PERCEIVED.pass(Checkpoint::Perceive), Flow::COMPLETE] {
        let decision = cycle(wrong);
        assert_wrong(decision.flow, "without perception");
    }
    let decision = cycle(Flow::PERCEIVED);
    assert_eq!(decision.flow, Flow::COMPLETE, "the answer is right again");
    assert!(decision.status.safe_state && decision.status.faults.contains(Faults::FLOW));
    assert!(cycle(Flow::PERCEIVED).status.safe_state, "latched");
}

/// SELF-6b: every other signature at rest than that of a whole cycle is the safe state, in the next cycle.
#[test]
fn signature_at_rest() {
    for stages in 0..9 {
        if stages == 7 {
            continue;
        }
        let mut bus = Bus::parked().with_state(|state| State { flow: run(&ORDER[..stages]), ..state });
        let decision = bus.step_unjudged(CYCLE);
        assert!(decision.status.safe_state && decision.status.faults.contains(Faults::FLOW), "{stages} stages");
    }
}
