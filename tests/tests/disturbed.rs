//! Noise, a busy bus, and ordinary days: the same seed gives the same, and what is counted can be counted.

use std::error::Error;

use supervisor::{Channel, Level, Sealed};
use supervisor_tests::bench::Bench;
use supervisor_tests::catalogue;
use supervisor_tests::disturb::run::{Outcome, Prepared, run};
use supervisor_tests::disturb::{Amount, Disturbance};
use supervisor_tests::drive;
use supervisor_tests::judge::{Counter, Stretch, interventions};
use supervisor_tests::link::Stamped;
use supervisor_tests::ordinary::day::day;

type Tested = Result<(), Box<dyn Error>>;

/// A shipped drive on a busy bus with noise: its frames.
fn disturbed(seed: u64) -> Result<Vec<Stamped>, Box<dyn Error>> {
    let scenario = catalogue::named("approach-correct").ok_or("no such drive")?;
    let mut bench = Bench::new(scenario)?.with_log();
    let mut disturbance = Disturbance::new(Amount::TYPICAL, seed);
    for _ in 0..2000 {
        bench.step(&mut disturbance);
    }
    Ok(bench.into_log())
}

#[test]
fn the_same_seed_disturbs_the_same() -> Tested {
    let (one, again, other) = (disturbed(1)?, disturbed(1)?, disturbed(2)?);
    assert!(one == again && one != other && one.len() > 5000, "{} frames", one.len());
    assert!(one.is_sorted_by_key(|stamped| stamped.micros), "in order of time");
    Ok(())
}

/// SELF-3a: what a disturbed bench has read replays to the very answers that it gave.
#[test]
fn the_log_of_a_disturbed_drive_replays_to_the_same_answers() -> Tested {
    let scenario = catalogue::named("approach-correct").ok_or("no such drive")?;
    let mut bench = Bench::new(scenario)?.with_log();
    let mut disturbance = Disturbance::new(Amount::TYPICAL, 5);
    let cycles: Vec<_> = (0..3000).map(|_| bench.step(&mut disturbance)).collect();
    let answers = drive::replay(&bench.into_log(), 30_000)?;
    let differs = cycles.iter().zip(&answers).find(|(cycle, answer)| cycle.answer != **answer);
    assert_eq!((answers.len(), differs.map(|(cycle, _)| cycle.now_ms)), (3000, None));
    Ok(())
}

#[test]
fn the_counter_finds_what_the_judge_finds() -> Tested {
    let scenario = catalogue::named("approach-misbehaving").ok_or("no such drive")?;
    let cycles = drive::run(scenario)?.cycles;
    let mut counter = Counter::default();
    let mut new = 0;
    for cycle in &cycles {
        counter.see(cycle);
        new += counter.new_ones().count();
    }
    // The judge alone forgives the start of the link.
    let later = |all: Vec<Stretch>| all.into_iter().filter(|stretch| stretch.from_ms > 1000).collect::<Vec<_>>();
    let found = counter.found();
    assert!(found.len() > 10 && new == found.len());
    assert_eq!(later(found), later(interventions(&cycles)));
    Ok(())
}

/// SELF-11a, RXN-1a: random situations on a busy bus with noise: nothing that moves the bus is touched, and a deceleration
/// goes out in the cycle in which its object is read.
#[test]
fn a_correct_controller_is_not_disturbed_on_a_busy_bus() -> Tested {
    let prepared = Prepared::new(Sealed::from_default()?);
    let outcomes: Vec<Outcome> =
        (0..40).map(|number| run(&prepared, Amount::TYPICAL, 11, number).ok_or("no run")).collect::<Result<_, _>>()?;
    assert!(outcomes.iter().filter(|outcome| outcome.level > Level::None).count() >= 10, "something happens");
    for (number, outcome) in outcomes.iter().enumerate() {
        let acting: Vec<_> = outcome.acting().collect();
        assert!(acting.is_empty(), "{number}: {}: {acting:?}", outcome.kind.name());
        assert!(outcome.reactions.iter().all(|reaction| reaction.supervisor == 0 && reaction.wait < 80_000));
        let (busy, there) = outcome.busy;
        assert!(busy * 100 / there >= 65, "{busy} of {there} µs");
    }
    Ok(())
}

#[test]
fn a_day_is_driven_by_its_seed_and_nobody_is_hit() -> Tested {
    let sealed = Sealed::from_default()?;
    let (one, again, other) = (day(sealed, 1, 0, 1500.0), day(sealed, 1, 0, 1500.0), day(sealed, 1, 1, 1500.0));
    assert_eq!((one.took_ms, one.stops, one.cases.len()), (again.took_ms, again.stops, again.cases.len()));
    assert_ne!(one.took_ms, other.took_ms);
    for day in [&one, &other] {
        assert!(day.metres >= 1500.0 && day.stops >= 2 && day.collisions == 0, "{day:?}");
        // Whatever disturbs, it is no frame that was lost: nothing is lost here.
        assert!(day.cases.iter().all(|case| case.stretch.channel != Channel::Gear), "{:?}", day.cases);
    }
    Ok(())
}
