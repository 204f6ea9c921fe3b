//! The fault report: debounce, occurrence count, active and previously active (RPT-1c, RULE-5b).

mod common;

use common::{Outcome, observe, quiet, settled, with};
use proptest::prelude::*;
use supervisor_core::{Decision, Faults, Millis};
use supervisor_report::{BodyFaults, BodyPart, DEBOUNCE, FaultReport, HEAL, Lamps, SETTLE, Source};

/// The only code that is active, and its count; `None` unless there is exactly one.
fn only(report: &FaultReport) -> Option<(Faults, u8)> {
    let mut active = report.active();
    let trouble = active.next().filter(|_| active.next().is_none())?;
    match trouble.code.source {
        Source::Core(fault) => Some((fault, trouble.occurrences)),
        Source::Body(_) => None,
    }
}

/// RULE-5b: a fault is reported when it has lasted 500 ms, not a cycle before.
#[test]
fn a_fault_is_reported_after_the_debounce() -> Outcome {
    assert_eq!(DEBOUNCE, Millis::new(500));
    let faulty = with(&quiet()?, Faults::SEAT_UNKNOWN);
    let mut report = settled();
    observe(&mut report, &faulty, 0, 500);
    assert_eq!(report.faults(), Faults::NONE, "490 ms after the first sight");
    observe(&mut report, &faulty, 500, 510);
    assert_eq!(only(&report), Some((Faults::SEAT_UNKNOWN, 1)));
    observe(&mut report, &faulty, 510, 60_000);
    assert_eq!(only(&report), Some((Faults::SEAT_UNKNOWN, 1)), "counted once however long it lasts");
    Ok(())
}

/// RULE-5b: a fault that goes within the debounce was never one, and its time does not add up.
#[test]
fn a_flicker_is_not_reported() -> Outcome {
    let quiet = quiet()?;
    let faulty = with(&quiet, Faults::CLOCK);
    let mut report = settled();
    for round in 0..100 {
        observe(&mut report, &faulty, round * 510, round * 510 + 500);
        observe(&mut report, &quiet, round * 510 + 500, round * 510 + 510);
    }
    assert_eq!((report.active().count(), report.previously_active().count()), (0, 0));
    Ok(())
}

/// RPT-1c: a code heals after 10 s without its fault, and not before; then it is previously active.
#[test]
fn a_code_heals_after_a_fault_free_time() -> Outcome {
    assert_eq!(HEAL, Millis::new(10_000));
    let quiet = quiet()?;
    let faulty = with(&quiet, Faults::EBS_RED);
    let mut report = settled();
    observe(&mut report, &faulty, 0, 1000);
    observe(&mut report, &quiet, 1000, 11_000);
    assert_eq!(only(&report), Some((Faults::EBS_RED, 1)), "9.99 s after the first sight of its absence");
    // It is back for one cycle: the same occurrence, and the time begins anew.
    observe(&mut report, &faulty, 11_000, 11_010);
    observe(&mut report, &quiet, 11_010, 21_010);
    assert_eq!(only(&report), Some((Faults::EBS_RED, 1)));
    observe(&mut report, &quiet, 21_010, 21_020);
    assert_eq!(report.active().count(), 0);
    let previous: Vec<_> =
        report.previously_active().map(|trouble| (trouble.code.name(), trouble.occurrences)).collect();
    assert_eq!(previous, [("EBS_RED", 1)]);
    // Again: active once more, counted, and no longer previously active.
    observe(&mut report, &faulty, 21_020, 22_000);
    assert_eq!(only(&report), Some((Faults::EBS_RED, 2)));
    assert_eq!(report.previously_active().count(), 0);
    Ok(())
}

/// RPT-1c: while the links start nothing is reported; what is still there when they have started, is.
#[test]
fn nothing_is_reported_while_the_links_start() -> Outcome {
    let quiet = quiet()?;
    let faulty = with(&quiet, Faults::SPEED_UNKNOWN);
    let mut report = FaultReport::default();
    observe(&mut report, &faulty, 0, 2500);
    observe(&mut report, &quiet, 2500, 20_000);
    assert_eq!((report.active().count(), report.previously_active().count()), (0, 0));
    let mut report = FaultReport::default();
    assert_eq!(SETTLE, Millis::new(3000));
    observe(&mut report, &faulty, 0, 3500);
    assert_eq!(report.active().count(), 0);
    observe(&mut report, &faulty, 3500, 3510);
    assert_eq!(only(&report), Some((Faults::SPEED_UNKNOWN, 1)));
    Ok(())
}

/// RPT-1a: an active code says whether its fault is there or waits to heal.
#[test]
fn an_active_code_says_whether_its_fault_is_there() -> Outcome {
    let quiet = quiet()?;
    let mut report = settled();
    observe(&mut report, &with(&quiet, Faults::SPEED_UNKNOWN), 0, 1000);
    assert_eq!(report.active().map(|trouble| trouble.present).collect::<Vec<_>>(), [true]);
    observe(&mut report, &quiet, 1000, 1010);
    assert_eq!(report.active().map(|trouble| trouble.present).collect::<Vec<_>>(), [false]);
    observe(&mut report, &quiet, 1010, 12_000);
    assert_eq!(report.previously_active().map(|trouble| trouble.present).collect::<Vec<_>>(), [false]);
    Ok(())
}

/// RPT-1c: the count stops at 126; 127 would say "not available".
#[test]
fn the_count_saturates_at_126() -> Outcome {
    let quiet = quiet()?;
    let faulty = with(&quiet, Faults::CLOCK);
    let mut report = FaultReport::new(Millis::ZERO, Millis::new(10), Millis::new(10));
    for round in 0..300_u32 {
        observe(&mut report, &faulty, round * 40, round * 40 + 20);
        let expected = u8::try_from(round + 1).unwrap_or(u8::MAX).min(126);
        assert_eq!(only(&report), Some((Faults::CLOCK, expected)));
        observe(&mut report, &quiet, round * 40 + 20, round * 40 + 40);
        assert_eq!(report.active().count(), 0);
    }
    Ok(())
}

/// RPT-1a: red for what has to stop the bus, amber for the rest, no lamp for a hint.
#[test]
fn the_lamps_are_those_of_the_active_codes() -> Outcome {
    let quiet = quiet()?;
    let lamps = |faults: Faults| {
        let mut report = settled();
        observe(&mut report, &with(&quiet, faults), 0, 600);
        (report.faults(), report.lamps())
    };
    let none = Lamps::default();
    let (amber, red) = (Lamps { amber_warning: true, ..none }, Lamps { red_stop: true, ..none });
    let both = Lamps { amber_warning: true, red_stop: true };
    for (faults, expected) in [
        (Faults::NONE, none),
        (Faults::HINTS, none),
        (Faults::SPEED_UNKNOWN, amber),
        (Faults::STATE, red),
        (Faults::STATE.with(Faults::CLOCK), both),
    ] {
        assert_eq!(lamps(faults), (faults, expected));
    }
    Ok(())
}

/// RSP-1h: what does not follow has lasted its second already: it is reported at once, beside the core's faults.
#[test]
fn a_body_fault_is_reported_at_once_and_heals_like_any() -> Outcome {
    let quiet = quiet()?;
    let mut report = settled();
    let dark = BodyFaults::NONE.when(true, BodyPart::BrakeLamps);
    report.observe(Millis::new(0), &quiet, dark);
    let names: Vec<_> = report.active().map(|trouble| trouble.code.name()).collect();
    assert_eq!((names.as_slice(), report.faults()), (["BRAKE_LAMPS"].as_slice(), Faults::NONE));
    observe(&mut report, &quiet, 10, 10_010);
    assert_eq!(report.active().count(), 1);
    observe(&mut report, &quiet, 10_010, 10_020);
    assert_eq!((report.active().count(), report.previously_active().count()), (0, 1));
    Ok(())
}

/// END-1b: neither a wrap of the clock nor a leap ripens a report.
#[test]
fn the_clock_may_wrap_and_leap() -> Outcome {
    let faulty = with(&quiet()?, Faults::CLOCK);
    for begin in [0, u32::MAX - 500, u32::MAX - 255, u32::MAX] {
        let mut report = settled();
        for cycle in 0..=50_u32 {
            assert_eq!(report.active().count(), 0, "{begin} {cycle}");
            report.observe(Millis::new(begin.wrapping_add(cycle * 10)), &faulty, BodyFaults::NONE);
        }
        assert_eq!(only(&report), Some((Faults::CLOCK, 1)));
    }
    let mut report = settled();
    for now in [0, 5_000_000, 3, u32::MAX, 77] {
        report.observe(Millis::new(now), &faulty, BodyFaults::NONE);
    }
    assert_eq!(report.active().count(), 0, "four leaps are 40 ms");
    Ok(())
}

/// What the report must be, written as a list of moments: active from 500 ms of presence to 10 s of absence.
fn reference(present: &[bool]) -> (bool, u8) {
    let (mut active, mut count) = (false, 0);
    let mut since = 0;
    for (cycle, now) in present.iter().enumerate() {
        if *now == active {
            since = cycle + 1;
        } else if (cycle - since) * 10 >= if active { 10_000 } else { 500 } {
            (active, since) = (!active, cycle + 1);
            count += u8::from(active);
        }
    }
    (active, count)
}

fn runs() -> impl Strategy<Value = Vec<bool>> {
    let run = (any::<bool>(), prop_oneof![1..3_usize, 45..55_usize, 990..1010_usize]);
    proptest::collection::vec(run, 0..12)
        .prop_map(|runs| runs.into_iter().flat_map(|(present, cycles)| std::iter::repeat_n(present, cycles)).collect())
}

fn faulty_or_not(present: bool, quiet: &Decision) -> Decision {
    if present { with(quiet, Faults::K4_OVERDUE) } else { *quiet }
}

proptest! {
    /// RPT-1c: for any coming and going of a fault, activity and count are those of the reference; no other code moves.
    #[test]
    fn any_coming_and_going_is_reported_like_the_reference(present in runs(), begin: u32) {
        let quiet = quiet().map_err(|error| TestCaseError::fail(error.to_string()))?;
        let mut report = settled();
        for (now, present) in present.iter().zip(0_u32..).map(|(present, cycle)| (cycle * 10, *present)) {
            report.observe(Millis::new(begin.wrapping_add(now)), &faulty_or_not(present, &quiet), BodyFaults::NONE);
        }
        let (active, count) = reference(&present);
        prop_assert_eq!(report.faults(), if active { Faults::K4_OVERDUE } else { Faults::NONE });
        let told: Vec<u8> = report.active().chain(report.previously_active()).map(|each| each.occurrences).collect();
        prop_assert_eq!(told, if count > 0 { vec![count] } else { vec![] });
    }
}
