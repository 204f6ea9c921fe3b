//! The event record and its snapshots (RPT-1).

mod common;

use common::{Outcome, quiet};
use supervisor_core::{
    Bound, Channel, Commands, ConfigError, DecelMs2Q11, Decision, Flow, Inputs, Key, Kind, Level, Millis, Occupancy,
    Percent, Reason, Record, ResetCause, Sealed, Signal, State, StateImage, Threat, Verdict, Verdicts, step,
};
use supervisor_report::{Event, EventRecord, Snapshot, What};

fn decide(image: &mut StateImage, now: u32) -> Result<Decision, ConfigError> {
    let sealed = Sealed::from_default()?;
    Ok(step(image, &sealed, Flow::PERCEIVED, Millis::new(now), &Inputs::NEVER, &Threat::UNKNOWN, &Commands::ABSENT))
}

/// A decision that passes everything, with nothing going on.
fn passing() -> Result<Decision, ConfigError> {
    let mut decision = quiet()?;
    decision.verdicts = Verdicts::new([Verdict::PASS; 12]);
    (decision.status.occupancy, decision.status.level) = (Occupancy::Confirmed, Level::None);
    decision.status.safe_state = false;
    Ok(decision)
}

fn limited(decision: &Decision, channel: usize) -> Decision {
    let mut list = [Verdict::PASS; 12];
    if let Some(verdict) = list.get_mut(channel) {
        *verdict = Verdict::above(Kind::Limit, Reason::PedalMap, 80, 20);
    }
    Decision { verdicts: Verdicts::new(list), ..*decision }
}

/// RPT-1a: the record holds the newest changes and counts what it dropped.
#[test]
fn the_record_is_bounded_and_counts_what_it_drops() -> Outcome {
    let mut image = StateImage::encode(&State::boot(ResetCause::PowerOn, Some(Record::None)));
    let mut record = EventRecord::<4, 2>::new();
    record.observe(Millis::new(10), &decide(&mut image, 10)?, None);
    assert_eq!(record.iter().count(), 4);
    assert!(record.dropped() > 0);
    assert!(record.iter().any(|event| matches!(event.what, What::Faults(_))));
    let dropped = record.dropped();
    record.observe(Millis::new(20), &decide(&mut image, 20)?, None);
    assert!(record.dropped() <= dropped + 1, "nothing but the faults may have changed");
    Ok(())
}

/// RPT-1a: a channel that stops passing is kept once with verdict, status, bounds and inputs; not while it goes on.
#[test]
fn the_first_verdict_that_is_no_pass_keeps_its_surroundings() -> Outcome {
    let mut passing = passing()?;
    // Bounds that differ, so that none can stand for another.
    let bound = |most, reason| Bound { most: Percent::new(most), reason };
    passing.envelope.torque.driver = bound(20, Reason::PedalMap);
    passing.envelope.torque.automated = bound(0, Reason::ModeNotGranted);
    let limited = limited(&passing, 0);
    let inputs = Inputs { key: Signal::Known(Key::On), ..Inputs::NEVER };
    let mut record = EventRecord::<32, 4>::new();
    for (now, decision) in [(10, passing), (20, limited), (30, limited), (40, passing), (50, limited)] {
        record.observe(Millis::new(now), &decision, Some(&inputs));
    }
    let times: Vec<u32> = record.snapshots().map(|snapshot| snapshot.time.raw()).collect();
    assert_eq!(times, [20, 50]);
    let first = record.snapshots().next();
    let cause = What::Verdict(Channel::DriveTorque, Verdict::above(Kind::Limit, Reason::PedalMap, 80, 20));
    assert_eq!(first.map(|snapshot| (snapshot.cause, snapshot.status)), Some((cause, limited.status)));
    assert_eq!(first.and_then(|snapshot| snapshot.inputs), Some(inputs));
    let envelope = limited.envelope;
    let bounds = first.map(|snapshot| snapshot.bounds);
    assert_eq!(
        bounds.map(|bounds| (bounds.brake_floor, bounds.brake_cap)),
        Some((envelope.brake.floor, envelope.brake.cap))
    );
    assert_eq!(
        bounds.map(|bounds| (bounds.torque_driver, bounds.torque_automated, bounds.epb_release)),
        Some((envelope.torque.driver, envelope.torque.automated, envelope.epb.release))
    );
    Ok(())
}

/// RPT-1a: safe state, leave and a rising level are kept when they begin, the gravest of one cycle; not when they end.
#[test]
fn what_is_grave_is_kept_when_it_begins() -> Outcome {
    let passing = passing()?;
    let status = |occupancy, level, safe_state| {
        let mut decision = passing;
        (decision.status.occupancy, decision.status.level, decision.status.safe_state) = (occupancy, level, safe_state);
        decision
    };
    let (seated, left) = (Occupancy::Confirmed, Occupancy::Leave);
    let mut record = EventRecord::<32, 8>::new();
    for (now, decision) in [
        (10, status(seated, Level::None, false)),
        (20, status(seated, Level::One, false)),
        // A channel stops in the same cycle: the graver stands for both.
        (30, limited(&status(seated, Level::Three, false), 2)),
        (40, status(seated, Level::None, false)),
        (50, status(left, Level::One, false)),
        (60, status(left, Level::One, true)),
        (70, status(left, Level::One, true)),
        (80, status(seated, Level::None, false)),
    ] {
        record.observe(Millis::new(now), &decision, None);
    }
    let kept: Vec<(u32, What)> = record.snapshots().map(|snapshot| (snapshot.time.raw(), snapshot.cause)).collect();
    let expected = [
        (20, What::Level(Level::One)),
        (30, What::Level(Level::Three)),
        (50, What::Occupancy(left)),
        (60, What::SafeState(true)),
    ];
    assert_eq!(kept, expected);
    assert!(record.snapshots().all(|snapshot| snapshot.inputs.is_none()));
    Ok(())
}

/// RPT-1a: a channel that flickers never pushes out what is grave; what is dropped is counted.
#[test]
fn flicker_does_not_push_out_what_is_grave() -> Outcome {
    let passing = passing()?;
    let mut safe = passing;
    safe.status.safe_state = true;
    let mut record = EventRecord::<8, 2>::new();
    record.observe(Millis::new(0), &safe, None);
    for round in 1..=100_u32 {
        let mut limited = limited(&passing, 3);
        limited.status.safe_state = true;
        record.observe(Millis::new(round * 20), &limited, None);
        record.observe(Millis::new(round * 20 + 10), &safe, None);
    }
    let times: Vec<u32> = record.snapshots().map(|snapshot| snapshot.time.raw()).collect();
    assert_eq!((times.as_slice(), record.snapshots_dropped()), ([0, 1980, 2000].as_slice(), 98));
    Ok(())
}

/// RPT-1a: several channels that stop in one cycle are one snapshot: their surroundings are the same.
#[test]
fn one_cycle_is_one_snapshot() -> Outcome {
    let mut image = StateImage::encode(&State::boot(ResetCause::PowerOn, Some(Record::None)));
    let mut record = EventRecord::<64, 4>::new();
    let decision = decide(&mut image, 10)?;
    assert!(decision.verdicts.iter().filter(|(_, verdict)| !verdict.passed()).count() > 1);
    record.observe(Millis::new(10), &decision, None);
    assert_eq!(record.snapshots().count(), 1);
    assert!(record.snapshots().all(|snapshot| snapshot.bounds.brake_floor.most == DecelMs2Q11::ZERO));
    Ok(())
}

/// RPT-1a: what the record costs, so that its documentation stays true.
#[test]
fn the_record_costs_what_it_says() {
    println!("Event {} B, Snapshot {} B", size_of::<Event>(), size_of::<Snapshot>());
    println!("EventRecord<64, 4> {} B", size_of::<EventRecord<64, 4>>());
    println!("FaultReport {} B", size_of::<supervisor_report::FaultReport>());
    println!("BodyMonitor {} B", size_of::<supervisor_report::BodyMonitor>());
    println!("Dm1Sender {} B", size_of::<supervisor_report::Dm1Sender>());
    assert!(size_of::<Event>() <= 24 && size_of::<Snapshot>() <= 192);
    assert!(size_of::<EventRecord<1, 1>>() <= 24 + 2 * 192 + 340);
    assert!(size_of::<EventRecord<64, 4>>() <= 64 * 24 + 2 * 4 * 192 + 340);
}
