//! Fault injection: the judge and the injector can fail.

use std::error::Error;

use supervisor::ConfigError;
use supervisor_tests::driver::Script;
use supervisor_tests::inject::baseline::Baseline;
use supervisor_tests::inject::campaign::{Cell, Fault, Guard, cell};
use supervisor_tests::inject::harm::{Ftti, Goal, Harm};
use supervisor_tests::inject::kind::{Kind, Own, When};
use supervisor_tests::inject::outcome::{Outcome, Reaction, verdict};
use supervisor_tests::inject::scenarios;
use supervisor_tests::inject::wheel::Wheel;
use supervisor_tests::number::kmh;
use supervisor_tests::plant::{Parameters, Plant, Truth};

type Tested = Result<(), Box<dyn Error>>;

/// Some FTTI of the size of the real ones, in ms.
fn ftti() -> Ftti {
    let ms = [1200, 2000, 1000, 300, 1600, 60_000, 100, 500, 700, 1200, 200, 1500, 200];
    (1..).map(Goal).zip(ms).collect()
}

fn baseline(name: &str) -> Result<Baseline, Box<dyn Error>> {
    let scenario = scenarios::all().into_iter().find(|scenario| scenario.name == name).ok_or("no such scenario")?;
    Ok(Baseline::drive(&scenario, &ftti())?)
}

fn fault(inject: &str, when: When, lasts_ms: Option<(u32, u32)>, goals: &[u8]) -> Result<Fault, Box<dyn Error>> {
    let goals: Vec<Goal> = goals.iter().copied().map(Goal).collect();
    let by_itself = goals.contains(&Goal::OF_THE_SUPERVISOR);
    let kind = Kind::named(inject).ok_or("no such injector")?;
    Ok(Fault { id: "FI-00".to_owned(), kind, when, lasts_ms, goals, by_itself })
}

/// Both guards on the same runs.
fn both(baseline: &Baseline, fault: &Fault) -> [Cell; 2] {
    [Guard::Supervisor, Guard::Blind].map(|guard| cell(baseline, fault, &ftti(), 7, 2, guard))
}

#[test]
fn a_supervisor_that_passes_everything_misses_what_the_real_one_averts() -> Tested {
    let cases = [
        ("stop-and-go", fault("full_torque", When::Coasting, Some((3000, 4000)), &[1])?),
        ("cruise", fault("phantom_braking", When::Clear, Some((2000, 3000)), &[4])?),
        ("cruise", fault("opens_k1_first", When::Clear, Some((300, 2000)), &[7])?),
        ("cruise", fault("steering_step", When::Clear, Some((1000, 1000)), &[9])?),
        ("cruise", fault("applies_epb", When::Driving, Some((2000, 2000)), &[11])?),
        ("cruise", fault("auxiliaries_off", When::Driving, Some((2000, 2000)), &[8])?),
        ("short-leave", fault("ignores_seat", When::BeforeLeave, None, &[1, 2, 12])?),
        ("short-leave", fault("releases_epb", When::Parked, Some((3000, 3000)), &[5])?),
        ("cruise", fault("state_bit", When::Any, Some((10, 10)), &[13])?),
    ];
    for (name, fault) in cases {
        let [seen, blind] = both(&baseline(name)?, &fault);
        let what = fault.kind.name();
        let (averted, missed) = (seen.count(Outcome::Averted), blind.count(Outcome::Missed));
        assert!(averted >= 1 && averted + seen.count(Outcome::Harmless) == 2, "{what}: {seen:?}");
        assert_eq!((missed, missed + blind.count(Outcome::Harmless)), (averted, 2), "{what}: {blind:?}");
    }
    Ok(())
}

#[test]
fn the_same_seed_gives_the_same_runs_and_another_one_others() -> Tested {
    let (baseline, fault) = (baseline("stop-and-go")?, fault("babbling", When::Driving, Some((500, 900)), &[1])?);
    let runs = |seed| cell(&baseline, &fault, &ftti(), seed, 2, Guard::Supervisor);
    assert_eq!(runs(1), runs(1));
    let times = |cell: Cell| cell.runs.iter().map(|run| (run.from_ms, run.lasts_ms)).collect::<Vec<_>>();
    assert_ne!(times(runs(1)), times(runs(2)));
    Ok(())
}

#[test]
fn a_fault_that_finds_no_moment_does_not_apply() -> Tested {
    let (baseline, fault) = (baseline("stop-and-go")?, fault("ignores_road", When::Closing, None, &[3])?);
    assert_eq!(cell(&baseline, &fault, &ftti(), 1, 3, Guard::Supervisor), Cell::default());
    Ok(())
}

/// SELF-11a: no intervention, and no goal violated, in a correct drive without a fault.
#[test]
fn the_short_drives_are_correct() -> Result<(), ConfigError> {
    for scenario in scenarios::all().iter().filter(|scenario| scenario.length_ms < 100_000) {
        let baseline = Baseline::drive(scenario, &ftti())?;
        assert_eq!((baseline.interventions, baseline.harms), (vec![], vec![]), "{}", scenario.name);
    }
    Ok(())
}

#[test]
fn the_verdict_counts_from_the_goal_whose_time_runs_out_first() {
    let torque = Harm { goal: Goal(1), from_ms: 1000 };
    let phantom = Harm { goal: Goal(4), from_ms: 1500 };
    let at = |any_ms| Reaction { any_ms, ..Reaction::default() };
    let judged = |with: &[Harm], reaction| verdict(&[torque, phantom], with, None, reaction, &ftti());
    // SG-04's 300 ms end at 1800, SG-01's 1200 ms at 2200.
    let averted = judged(&[], at(Some(1800)));
    assert_eq!((averted.outcome, averted.goal, averted.detection_ms), (Outcome::Averted, Some(Goal(4)), Some(300)));
    assert_eq!(judged(&[], at(Some(1810))).outcome, Outcome::Late);
    assert_eq!(judged(&[], at(Some(900))).detection_ms, Some(0), "before the harm begins");
    assert_eq!(judged(&[], at(None)).outcome, Outcome::Missed);
    assert_eq!(judged(&[phantom], at(Some(1600))).outcome, Outcome::Missed, "harm, and a refusal is no report");
    let reported = Reaction { any_ms: Some(1600), report_ms: Some(1700), faults: 1 };
    assert_eq!(judged(&[phantom], reported).outcome, Outcome::Reported);
    assert_eq!(verdict(&[], &[], None, reported, &ftti()).outcome, Outcome::Harmless);
    let itself = verdict(&[], &[], Some(1000), at(Some(1010)), &ftti());
    assert_eq!((itself.outcome, itself.goal), (Outcome::Averted, Some(Goal::OF_THE_SUPERVISOR)));
}

fn at_40_kmh() -> Truth {
    let script: Script<'_> = &[];
    Truth { speed: kmh(40.0), ..Plant::new(Parameters::DEFAULT, script, &[]).truth() }
}

#[test]
fn the_wheel_runs_away_by_a_jump_and_not_within_the_bounded_rate() {
    let after = |angle: fn(f64) -> f64| {
        let mut wheel = Wheel::default();
        (0_u8..70).any(|cycle| {
            wheel.see(&Truth { angle: angle(f64::from(cycle) / 100.0), ..at_40_kmh() });
            wheel.ran_away()
        })
    };
    assert!(after(|seconds| if seconds > 0.1 { 100.0 } else { 0.0 }));
    assert!(!after(|seconds| 40.0 * seconds), "SG-09's 40°/s");
}

#[test]
fn every_name_is_of_one_injector() {
    for (own, name) in Own::NAMES {
        assert_eq!(Kind::named(name), Some(Kind::Supervisor(*own)));
    }
    assert_eq!(Kind::named("nothing"), None);
}
