//! The shipped drives, whole: closed loop, committed log, and the log once more.

use std::error::Error;
use std::path::PathBuf;
use std::sync::LazyLock;

use supervisor::{Channel, ConfigError, EpbState, Gear, Kind, Level, Occupancy, Reason};
use supervisor_tests::catalogue::{self, s1_approach};
use supervisor_tests::drive::{Cycle, Driven, Scenario, replay, run, run_unprotected};
use supervisor_tests::judge::{Hazard, Stretch, digest, hazards, interventions, unmet};
use supervisor_tests::manifest::manifest;
use supervisor_tests::misdeed::{Deed, Misdeed};
use supervisor_tests::plant::Parameters;
use supervisor_tests::road::Obstacle;
use supervisor_tests::s1::{Approach, approach};
use supervisor_tests::{candump, number::kmh};

type Outcome = Result<(), Box<dyn Error>>;
type Driving = Result<Vec<(&'static Scenario<'static>, Driven)>, ConfigError>;

static DRIVES: LazyLock<Driving> =
    LazyLock::new(|| catalogue::ALL.iter().map(|scenario| Ok((scenario, run(scenario)?))).collect());

fn drives() -> Result<&'static [(&'static Scenario<'static>, Driven)], Box<dyn Error>> {
    DRIVES.as_deref().map_err(|error| (*error).into())
}

fn drive(name: &str) -> Result<&'static [Cycle], Box<dyn Error>> {
    let found = drives()?.iter().find(|(scenario, _)| scenario.name == name);
    Ok(found.map(|(_, driven)| driven.cycles.as_slice()).ok_or(name)?)
}

fn committed(file: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "drives", file].iter().collect()
}

/// When `what` is first true, in ms.
fn when(cycles: &[Cycle], what: impl Fn(&Cycle) -> bool) -> Result<u32, Box<dyn Error>> {
    Ok(cycles.iter().find(|cycle| what(cycle)).ok_or("it never happens")?.now_ms)
}

#[test]
fn the_drives_regenerate_to_the_committed_bytes() -> Outcome {
    let again = "is not what is committed: run `cargo run --release -p supervisor-tests --bin make-drives`";
    for (scenario, driven) in drives()? {
        let file = format!("{}.candump.gz", scenario.name);
        let same = std::fs::read(committed(&file))? == candump::packed(&driven.frames)?;
        assert!(same, "{file} {again}");
    }
    let same = std::fs::read_to_string(committed("drives.toml"))? == manifest_of_all()?;
    assert!(same, "drives.toml {again}");
    Ok(())
}

fn manifest_of_all() -> Result<String, Box<dyn Error>> {
    let drives: Vec<(&Scenario, Driven)> =
        drives()?.iter().map(|(scenario, driven)| (*scenario, driven.clone())).collect();
    Ok(manifest(&drives))
}

/// SELF-11a to SELF-11k, SELF-2b: what a correct controller asks for passes.
#[test]
fn a_correct_controller_meets_no_intervention() -> Outcome {
    for (scenario, driven) in drives()?.iter().filter(|(scenario, _)| scenario.misdeeds.is_empty()) {
        assert_eq!(interventions(&driven.cycles), [], "{}", scenario.name);
    }
    Ok(())
}

/// CMD-5b: every misdeed meets the verdicts that the catalogue names for it.
#[test]
fn every_misdeed_is_refused_for_the_named_reason() -> Outcome {
    let mut count = 0;
    for (scenario, driven) in drives()? {
        for misdeed in scenario.misdeeds {
            assert_eq!(unmet(misdeed, &driven.cycles), [], "{}: {}", scenario.name, misdeed.what);
            count += misdeed.expected.len();
        }
    }
    assert!(count > 40, "{count} verdicts are expected");
    Ok(())
}

/// SELF-2a: the worst a misdeed achieves: none of its values goes out while it lasts, but for the one cycle of a lost counter.
#[test]
fn no_misdeed_gets_through() -> Outcome {
    for (scenario, driven) in drives()? {
        // What a failing vehicle does ends with the help that it gets.
        for misdeed in scenario.misdeeds.iter().filter(|misdeed| !misdeed.deed.of_the_vehicle()) {
            // From the moment at which the refusal is due, it is complete.
            for (channel, reason) in misdeed.expected {
                let during = driven.cycles.iter().filter(|cycle| misdeed.active(cycle.now_ms));
                let due = during.skip_while(|cycle| cycle.answer.verdicts.of(*channel).reason != *reason);
                let through = due.clone().take(30).filter(|cycle| cycle.answer.verdicts.of(*channel).passed()).count();
                assert_eq!(through, 0, "{}: {} on {channel:?}", scenario.name, misdeed.what);
            }
        }
    }
    Ok(())
}

/// SELF-2a: the judge of hazards finds none.
#[test]
fn nothing_hazardous_happens_in_any_drive() -> Outcome {
    for (scenario, driven) in drives()? {
        assert_eq!(hazards(&driven.cycles), [], "{}", scenario.name);
    }
    Ok(())
}

/// The misdeeds are real: without the supervisor each of them alone does its harm, and the judge sees it.
#[test]
fn without_the_supervisor_the_misdeeds_do_their_harm() -> Outcome {
    let harms = [
        ("approach-misbehaving", Deed::OpensK4, Hazard::OpenedRolling),
        ("approach-misbehaving", Deed::IgnoresTheRoad, Hazard::Collision),
        ("seat-misbehaving", Deed::IgnoresTheSeat, Hazard::TorqueWithoutDriver),
        ("seat-misbehaving", Deed::IgnoresTheSeat, Hazard::SilentLeave),
        ("seat-misbehaving", Deed::ReleasesParkingBrake, Hazard::ReleasedWithoutDriver),
        ("seat-misbehaving", Deed::ShiftsToDrive, Hazard::GearWithoutDriver),
        ("seat-misbehaving", Deed::OpensK1, Hazard::K1BeforeK4),
    ];
    for (name, deed, harm) in harms {
        let scenario = catalogue::named(name).ok_or(name)?;
        let alone = scenario.misdeeds.iter().find(|misdeed| misdeed.deed == deed).ok_or("no such misdeed")?;
        let misdeeds = [*alone];
        let scenario = Scenario { misdeeds: &misdeeds, length_ms: alone.until_ms + 1000, ..*scenario };
        let found = hazards(&run_unprotected(&scenario)?.cycles);
        assert!(found.iter().any(|(_, hazard)| *hazard == harm), "{name}, {deed:?}: {harm:?} is not among {found:?}");
    }
    let correct = catalogue::named("approach-correct").ok_or("no such drive")?;
    assert_eq!(hazards(&run_unprotected(correct)?.cycles), [], "a correct controller needs no supervisor");
    Ok(())
}

/// SELF-3a: the committed log through receiver and supervisor gives the very answers of the closed loop.
#[test]
fn the_committed_logs_replay_to_the_same_answers() -> Outcome {
    for (scenario, driven) in drives()? {
        let file = std::fs::read(committed(&format!("{}.candump.gz", scenario.name)))?;
        let answers = replay(&candump::unpacked(&file)?, scenario.length_ms)?;
        assert_eq!(answers.len(), driven.cycles.len());
        let differs = driven.cycles.iter().zip(&answers).find(|(cycle, answer)| cycle.answer != **answer);
        assert_eq!(differs.map(|(cycle, _)| cycle.now_ms), None, "{}", scenario.name);
        let fingerprint = format!("digest = \"{:016x}\"", digest(answers));
        assert!(std::fs::read_to_string(committed("drives.toml"))?.contains(&fingerprint), "{}", scenario.name);
    }
    Ok(())
}

/// MIT-4c: (spec §9) levels never decrease while closing, rest gap > 0, for 0 to 0.7 s of brake dead time.
#[test]
fn the_approach_of_s1_for_every_brake_dead_time() -> Outcome {
    for tenths in 0_u8..=7 {
        let dead = f64::from(tenths) / 10.0;
        let driven = run(&s1_approach(Parameters::DEFAULT.with_brake_dead(dead)))?;
        assert_eq!(hazards(&driven.cycles), [], "{dead} s");
        // A brake that answers later than S4's second (RSP-1g) gets the retarder's help, and nothing else is changed.
        let late = tenths >= 6;
        let helped = |stretch: &Stretch| {
            matches!(
                (stretch.channel, stretch.first.reason),
                (Channel::Retarder, Reason::BrakeResponse) | (Channel::Warnings, Reason::WarningObliged)
            )
        };
        let vetted = interventions(&driven.cycles);
        assert!(vetted.iter().all(|stretch| late && helped(stretch)), "{dead} s: {vetted:?}");
        let Approach { levels: [one, two, three], standstill, rest_gap, .. } = approach(dead)?;
        let (one, two) = (one.ok_or("no level 1")?, two.ok_or("no level 2")?);
        // T < 4.4 s at 40 km/h is at 48.9 m, 1.0 s after the 60 m; the radar looks every 50 ms, frames come as often.
        assert!((0.95..1.15).contains(&one), "level 1 at {one} s with {dead} s");
        assert!(one < two && three.is_none_or(|three| two < three), "levels in order with {dead} s");
        assert!(standstill.is_some_and(|at| at > two) && rest_gap.is_some_and(|gap| gap > 1.0), "{dead} s");
    }
    Ok(())
}

/// Both approaches are S1's: 40 km/h when 60 m are left.
#[test]
fn the_approaches_begin_as_in_s1() -> Outcome {
    for name in ["approach-correct", "approach-misbehaving"] {
        let at_sixty = drive(name)?.iter().find(|cycle| cycle.truth.gap.is_some_and(|gap| gap <= 60.0));
        let speed = at_sixty.ok_or("no approach")?.truth.speed * 3.6;
        assert!((39.5..40.5).contains(&speed), "{name}: {speed} km/h");
    }
    Ok(())
}

/// MIT-4b: the obligation alone stops the bus as the controller would.
#[test]
fn ignoring_the_road_changes_the_rest_gap_by_less_than_a_metre() -> Outcome {
    let gap = |name: &str| -> Result<f64, Box<dyn Error>> {
        let cycles = drive(name)?;
        let rest = cycles.iter().find(|cycle| cycle.now_ms > 60_000 && cycle.truth.speed <= 0.0);
        Ok(rest.and_then(|cycle| cycle.truth.gap).ok_or("it does not stop")?)
    };
    let (correct, misbehaving) = (gap("approach-correct")?, gap("approach-misbehaving")?);
    assert!((correct - misbehaving).abs() < 1.0, "{correct} m, {misbehaving} m");
    Ok(())
}

/// A pedestrian 2.4 s ahead of S1's bus at 60 s, for a correct controller and for one that ignores the road.
fn with_pedestrian(length_ms: u32) -> Result<[Vec<Cycle>; 2], Box<dyn Error>> {
    let correct = Scenario { length_ms, ..s1_approach(Parameters::DEFAULT) };
    let pass = run(&correct)?.cycles.iter().find(|cycle| cycle.now_ms == 60_000).map(|cycle| cycle.truth.position);
    let road = [Obstacle::pedestrian(pass.ok_or("too short")? + 26.0, 60_000)];
    let ignores =
        [Misdeed { from_ms: 60_000, until_ms: u32::MAX, deed: Deed::IgnoresTheRoad, what: "", expected: &[] }];
    let correct = run(&Scenario { road: &road, ..correct })?.cycles;
    let ignoring = run(&Scenario { road: &road, misdeeds: &ignores, length_ms, ..s1_approach(Parameters::DEFAULT) })?;
    Ok([correct, ignoring.cycles])
}

/// MIT-3a, MIT-3b, MIT-4h: level 3 at once, to standstill and 1 s more, with or without the main controller.
#[test]
fn a_pedestrian_who_steps_out_meets_level_three() -> Outcome {
    let both = with_pedestrian(64_500)?;
    for cycles in &both {
        assert_eq!(hazards(cycles), []);
        let three = when(cycles, |cycle| cycle.answer.status.level == Level::Three)?;
        assert!((60_000..60_250).contains(&three), "level 3 at {three} ms");
        let stands = when(cycles, |cycle| cycle.now_ms > three && cycle.truth.speed <= 0.0)?;
        let mut kept = cycles.iter().filter(|cycle| (three..stands + 900).contains(&cycle.now_ms));
        assert!(kept.all(|cycle| cycle.answer.status.level == Level::Three));
        let over = when(cycles, |cycle| cycle.now_ms > three && cycle.answer.status.level == Level::None)?;
        assert!((stands + 900..stands + 1200).contains(&over), "stands at {stands}, ends at {over}");
    }
    // MIT-8's hint may light the fault lamp for a moment; nothing that moves the bus is touched.
    let [correct, _] = &both;
    let acting = interventions(correct).into_iter().filter(|stretch| stretch.channel != Channel::Warnings);
    assert_eq!(acting.collect::<Vec<_>>(), []);
    Ok(())
}

/// TRQ-2d: afterwards, too, no ADAS torque drives the bus into what stands ahead; nobody touches a pedal.
#[test]
fn a_pedestrian_is_not_pushed_after_level_three() -> Outcome {
    for cycles in with_pedestrian(90_000)? {
        assert_eq!(hazards(&cycles), []);
    }
    Ok(())
}

/// SEAT-1a, SEAT-2a, SEAT-4a, SEAT-6a, SEAT-7a, SEAT-7e, SEAT-8a, SEAT-5d: S3 §2.1 to §2.6, in order and in time, whoever is at the main controller.
#[test]
fn leaving_the_seat_runs_through_every_stage_of_s3() -> Outcome {
    for name in ["seat-correct", "seat-misbehaving"] {
        let cycles = drive(name)?;
        let empty = when(cycles, |cycle| cycle.truth.seat == [false; 2])?;
        let leave = when(cycles, |cycle| cycle.answer.status.occupancy == Occupancy::Leave)?;
        let parks = when(cycles, |cycle| cycle.now_ms > leave && cycle.truth.epb.is_none())?;
        let parked = when(cycles, |cycle| cycle.now_ms > leave && cycle.truth.epb == Some(EpbState::Applied))?;
        let neutral = when(cycles, |cycle| cycle.now_ms > leave && cycle.truth.gear == Gear::Neutral)?;
        let open =
            |cycle: &Cycle, number: usize| cycle.now_ms > leave && cycle.truth.closed.get(number) == Some(&false);
        let (k1, k4) = (when(cycles, |cycle| open(cycle, 0))?, when(cycles, |cycle| open(cycle, 1))?);
        assert!((2000..2100).contains(&(leave - empty)), "{name}: leave {} ms after the seat", leave - empty);
        let at_parking = cycles.iter().find(|cycle| cycle.now_ms == parks).map_or(9.0, |cycle| cycle.truth.speed);
        assert!(at_parking < kmh(1.5), "{name}: parks at {at_parking} m/s");
        assert!(parks < parked && parked < neutral, "{name}: parking brake, then neutral");
        assert!((600_000..600_400).contains(&(k4 - parked)), "{name}: K4 {} ms after the parking brake", k4 - parked);
        assert!((3000..3400).contains(&(k1 - k4)), "{name}: K1 {} ms after K4", k1 - k4);
        // The way back: nothing but the whole sequence releases.
        let released = when(cycles, |cycle| cycle.now_ms > k1 && cycle.truth.epb != Some(EpbState::Applied))?;
        assert!((675_000..675_300).contains(&released), "{name}: released at {released} ms, pressed at 675 s");
        let torque = cycles.iter().filter(|cycle| (leave..released).contains(&cycle.now_ms));
        assert!(torque.clone().all(|cycle| cycle.answer.outputs.drive.torque.raw() == 0), "{name}: SEAT-2");
        assert!(drives_on(cycles, released), "{name}: drives on at the end");
    }
    Ok(())
}

fn drives_on(cycles: &[Cycle], after: u32) -> bool {
    cycles.iter().any(|cycle| cycle.now_ms > after && cycle.truth.speed > kmh(20.0))
}

/// CMD-3a, E2E-2a: whoever is silent, tampers or repeats is disobeyed on every channel that matters, and nothing else happens.
#[test]
fn a_silent_controller_is_a_command_like_any_other() -> Outcome {
    let cycles = drive("approach-misbehaving")?;
    let silent = cycles.iter().filter(|cycle| (43_500..44_000).contains(&cycle.now_ms));
    for channel in [Channel::DriveTorque, Channel::ServiceBrake, Channel::Gear, Channel::ParkingBrake] {
        assert!(silent.clone().all(|cycle| cycle.answer.verdicts.of(channel).kind != Kind::Pass), "{channel:?}");
    }
    assert!(silent.clone().all(|cycle| cycle.answer.outputs.drive.torque.raw() == 0));
    Ok(())
}
