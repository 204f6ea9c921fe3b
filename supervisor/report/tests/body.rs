//! Lamps and wipers follow in less than 1000 ms, or are reported (RSP-1h).

mod common;

use common::{Outcome, quiet};
use supervisor_core::{Body, Decision, Millis, Signal, Wiper};
use supervisor_report::{BodyFaults, BodyFeedback, BodyMonitor, BodyPart};

/// What is asked for, and feedback that says just that.
fn asking(body: Body) -> Result<(Decision, BodyFeedback), supervisor_core::ConfigError> {
    let mut decision = quiet()?;
    decision.outputs.body = body;
    let feedback = BodyFeedback {
        wipers: Signal::Known(body.wipers),
        brake_lamps: Signal::Known(body.brake_lamps),
        indicator_left: Signal::Known(body.indicator_left),
        indicator_right: Signal::Known(body.indicator_right),
        low_beam: Signal::Known(body.low_beam),
        high_beam: Signal::Known(body.high_beam),
    };
    Ok((decision, feedback))
}

/// The parts that do not follow.
fn late(faults: BodyFaults) -> Vec<BodyPart> {
    BodyPart::ALL.iter().copied().filter(|part| faults.contains(*part)).collect()
}

/// Runs a monitor every 10 ms and gives the first time at which this part was reported.
fn first(
    part: BodyPart,
    until: u32,
    mut cycle: impl FnMut(u32) -> Result<(Decision, BodyFeedback), supervisor_core::ConfigError>,
) -> Result<Option<u32>, supervisor_core::ConfigError> {
    let mut monitor = BodyMonitor::new();
    for now in (0..until).step_by(10) {
        let (decision, feedback) = cycle(now)?;
        if monitor.observe(Millis::new(now), &decision, &feedback).contains(part) {
            return Ok(Some(now));
        }
    }
    Ok(None)
}

/// RSP-1h: each lamp and the wipers, stuck at rest, is reported 1000 ms after the request and no other with it.
#[test]
fn each_part_that_does_not_follow_is_reported_after_a_second() -> Outcome {
    let rest = Body::NEUTRAL;
    for (part, asked) in [
        (BodyPart::Wipers, Body { wipers: Wiper::Slow, ..rest }),
        (BodyPart::BrakeLamps, Body { brake_lamps: true, ..rest }),
        (BodyPart::IndicatorLeft, Body { indicator_left: true, ..rest }),
        (BodyPart::IndicatorRight, Body { indicator_right: true, ..rest }),
        (BodyPart::LowBeam, Body { low_beam: true, ..rest }),
        (BodyPart::HighBeam, Body { high_beam: true, ..rest }),
    ] {
        let (_, stuck) = asking(rest)?;
        let (asked, _) = asking(asked)?;
        let mut monitor = BodyMonitor::new();
        for now in (0..3000).step_by(10) {
            let expected = if now < 1000 { vec![] } else { vec![part] };
            assert_eq!(late(monitor.observe(Millis::new(now), &asked, &stuck)), expected, "{now} ms");
        }
        // It follows after all: no longer reported.
        let (_, follows) = asking(asked.outputs.body)?;
        assert_eq!(late(monitor.observe(Millis::new(3000), &asked, &follows)), []);
    }
    Ok(())
}

/// RSP-1h: 990 ms is in time, in either direction of the change.
#[test]
fn what_follows_in_time_is_not_reported() -> Outcome {
    let on = Body { brake_lamps: true, low_beam: true, wipers: Wiper::Fast, ..Body::NEUTRAL };
    for (asked, before) in [(on, Body::NEUTRAL), (Body::NEUTRAL, on)] {
        let mut monitor = BodyMonitor::new();
        for now in (0..5000).step_by(10) {
            let (decision, _) = asking(asked)?;
            let (_, feedback) = asking(if now < 1000 { before } else { asked })?;
            assert_eq!(late(monitor.observe(Millis::new(now), &decision, &feedback)), [], "{now} ms");
        }
    }
    Ok(())
}

/// RSP-1h: a lamp that stays on is as wrong as one that stays dark.
#[test]
fn a_lamp_that_stays_on_is_reported() -> Outcome {
    let found = first(BodyPart::HighBeam, 3000, |_| {
        let (decision, _) = asking(Body::NEUTRAL)?;
        Ok((decision, asking(Body { high_beam: true, ..Body::NEUTRAL })?.1))
    })?;
    assert_eq!(found, Some(1000));
    Ok(())
}

/// RSP-1h: each new request has its own second.
#[test]
fn a_new_request_begins_the_time_anew() -> Outcome {
    let speeds = [Wiper::Slow, Wiper::Fast, Wiper::Interval];
    let wipers = |now: u32| speeds.get(usize::try_from(now / 900).unwrap_or(0)).copied().unwrap_or(Wiper::Slow);
    let cycle = |now: u32| {
        let (decision, _) = asking(Body { wipers: wipers(now), ..Body::NEUTRAL })?;
        Ok((decision, asking(Body::NEUTRAL)?.1))
    };
    // The last change is at 2700 ms.
    assert_eq!(first(BodyPart::Wipers, 9000, cycle)?, Some(3700));
    Ok(())
}

/// RSP-1h: an indicator that flashes follows, whether its switch or its phase is fed back; hazard flashers are both.
#[test]
fn flashing_is_following_and_hazard_flashers_are_both_indicators() -> Outcome {
    for working in [true, false] {
        for part in [BodyPart::IndicatorLeft, BodyPart::IndicatorRight] {
            let found = first(part, 10_000, |now| {
                let (mut decision, _) = asking(Body::NEUTRAL)?;
                decision.outputs.warnings.hazard_flashers = true;
                let phase = working && now / 330 % 2 == 1;
                Ok((decision, asking(Body { indicator_left: phase, indicator_right: phase, ..Body::NEUTRAL })?.1))
            })?;
            assert_eq!(found, if working { None } else { Some(1000) });
        }
    }
    Ok(())
}

/// RSP-1h: a bus without feedback is not watched; feedback that was there and is missing for 1000 ms is reported.
#[test]
fn feedback_that_is_missing_is_reported_only_if_it_was_there() -> Outcome {
    let asked = Body { brake_lamps: true, ..Body::NEUTRAL };
    for part in BodyPart::ALL {
        assert_eq!(first(*part, 10_000, |_| Ok((asking(asked)?.0, BodyFeedback::NEVER)))?, None);
    }
    let lost = |now: u32| {
        let (decision, feedback) = asking(asked)?;
        let brake_lamps = if now < 2000 { feedback.brake_lamps } else { Signal::NEVER };
        Ok((decision, BodyFeedback { brake_lamps, ..feedback }))
    };
    assert_eq!(first(BodyPart::Feedback, 10_000, lost)?, Some(3000));
    assert_eq!(first(BodyPart::BrakeLamps, 10_000, lost)?, None, "unknown is no evidence that it does not follow");
    Ok(())
}

/// RSP-1h: while the feedback is unknown the time stands still, and goes on where it stood.
#[test]
fn unknown_feedback_freezes_the_time() -> Outcome {
    let found = first(BodyPart::BrakeLamps, 10_000, |now| {
        let (decision, _) = asking(Body { brake_lamps: true, ..Body::NEUTRAL })?;
        let (_, dark) = asking(Body::NEUTRAL)?;
        let unknown = (500..900).contains(&now);
        Ok((decision, if unknown { BodyFeedback { brake_lamps: Signal::NEVER, ..dark } } else { dark }))
    })?;
    assert_eq!(found, Some(1400));
    Ok(())
}
