//! A campaign, or a part of it, on all cores.

use supervisor::{Channel, Level, Reason, Sealed};
use supervisor_tests::disturb::Amount;
use supervisor_tests::disturb::run::{Outcome, Prepared, run};
use supervisor_tests::judge::Stretch;
use supervisor_tests::number::nearest;
use supervisor_tests::ordinary::day::{Case, Day, day};

use super::tally::{CASES, Runs, SCHEMA, Sources, Tally, Times, Wanted};
use crate::number::float;
use crate::spread::{Steps, cores, mine, spread};

/// What is wanted.
#[derive(Clone, Copy, Debug)]
pub struct Request {
    /// What the supervisor is configured with.
    pub sealed: Sealed,
    /// The seed.
    pub seed: u64,
    /// Runs.
    pub runs: u64,
    /// Ordinary driving in km.
    pub km: u64,
    /// Part K of N, from 1; none: all.
    pub shard: Option<(usize, usize)>,
    /// Threads; none: one for each core.
    pub jobs: Option<usize>,
}

/// A day has so many m.
const DAY: u64 = 5000;
/// Runs are counted together in so many at a time.
const BATCH: u64 = 20;

/// Runs it.
#[must_use]
pub fn campaign(request: &Request, sources: Sources) -> Tally {
    let (_, shards) = request.shard.unwrap_or((1, 1));
    let jobs = request.jobs.unwrap_or_else(cores);
    let days = (request.km * 1000).div_ceil(DAY);
    let numbers = |count: u64| -> Vec<u64> {
        (0..count).filter(|number| mine(request.shard, usize::try_from(*number).unwrap_or(0))).collect()
    };
    let mut whole = Tally {
        schema: SCHEMA.to_owned(),
        version: 1,
        seed: request.seed,
        shards,
        sources,
        wanted: Wanted { runs: request.runs, days, metres: DAY },
        ..Tally::default()
    };

    let prepared = Prepared::new(request.sealed);
    let batches: Vec<u64> = numbers(request.runs.div_ceil(BATCH));
    let steps = Steps::new("twenties of runs", batches.len());
    let one = |batch: &u64| {
        let mut tally = Tally::default();
        for number in batch * BATCH..((batch + 1) * BATCH).min(request.runs) {
            if let Some(outcome) = run(&prepared, Amount::TYPICAL, request.seed, number) {
                count_run(&mut tally, number, &outcome);
            }
        }
        tally
    };
    for tally in spread(&batches, jobs, &steps, one) {
        whole.add(&tally);
    }

    let mine = numbers(days);
    let steps = Steps::new("ordinary days of 5 km", mine.len());
    let one = |number: &u64| {
        let mut tally = Tally::default();
        count_day(&mut tally, *number, &day(request.sealed, request.seed, *number, float(DAY)));
        tally
    };
    for tally in spread(&mine, jobs, &steps, one) {
        whole.add(&tally);
    }
    whole
}

fn cause(stretch: &Stretch, reason: Reason) -> String {
    format!("{:?} {reason:?}", stretch.channel)
}

fn count_run(tally: &mut Tally, number: u64, outcome: &Outcome) {
    let is = |condition: bool| u64::from(condition);
    let warned = outcome.interventions.iter().any(|(stretch, _)| stretch.channel == Channel::Warnings);
    tally.add(&Tally {
        runs: [(
            outcome.kind.name().to_owned(),
            Runs {
                runs: 1,
                disturbed: is(outcome.acting().next().is_some()),
                warned: is(warned),
                false_triggers: is(outcome.false_triggers > 0),
                collisions: is(outcome.collided),
                levels: is(outcome.level > Level::None),
            },
        )]
        .into(),
        run_numbers: [("collision", outcome.collided), ("level without a cause", outcome.false_triggers > 0)]
            .into_iter()
            .filter(|(_, is)| *is)
            .map(|(what, _)| (what.to_owned(), vec![number]))
            .collect(),
        load: [outcome.busy.0 / 1000, outcome.busy.1 / 1000],
        lost: outcome.lost,
        ..Tally::default()
    });
    for (stretch, reason) in &outcome.interventions {
        let cause = cause(stretch, *reason);
        *tally.run_causes.entry(cause.clone()).or_default() += 1;
        let at = f64::from(stretch.from_ms) / 1000.0;
        let example = || format!("run {number}: {}, at {at:.2} s", outcome.kind.name());
        tally.run_examples.entry(cause).or_insert_with(example);
    }
    for reaction in &outcome.reactions {
        let all = reaction.bus + reaction.wait + reaction.supervisor;
        let note = |times: &mut Times, micros: u64| *times.entry(micros / 1000).or_default() += 1;
        note(&mut tally.reaction.bus, reaction.bus);
        note(&mut tally.reaction.wait, reaction.wait);
        note(&mut tally.reaction.supervisor, reaction.supervisor);
        note(&mut tally.reaction.all, all);
    }
}

fn told(number: u64, case: &Case) -> String {
    let at = f64::from(case.stretch.from_ms) / 1000.0;
    let ahead = case
        .ahead
        .map_or("nothing in the lane".to_owned(), |(gap, closing)| format!("gap {gap:.1} m, closing {closing:.1} m/s"));
    let speed = case.speed * 3.6;
    format!("day {number}: at {at:.1} s, {speed:.1} km/h, {ahead}, slowing {:.1} m/s²", case.deceleration)
}

fn count_day(tally: &mut Tally, number: u64, day: &Day) {
    let count = |many: usize| u64::try_from(many).unwrap_or(u64::MAX);
    tally.days = 1;
    tally.metres = u64::try_from(nearest(day.metres)).unwrap_or(0);
    tally.seconds = u64::from(day.took_ms / 1000);
    (tally.stops, tally.hard) = (count(day.stops), count(day.hard));
    (tally.collisions, tally.warnings) = (count(day.collisions), count(day.warnings));
    tally.pieces = day.pieces.iter().map(|(piece, many)| (piece.name().to_owned(), count(*many))).collect();
    tally.levels = day.levels.iter().map(|(level, many)| (level.code().to_string(), count(*many))).collect();
    for case in &day.cases {
        let (piece, cause) = (case.piece.name().to_owned(), cause(&case.stretch, case.reason));
        let cases = tally.cases.entry(format!("{piece}, {cause}")).or_default();
        if cases.len() < CASES {
            cases.push(told(number, case));
        }
        *tally.causes.entry(piece).or_default().entry(cause).or_default() += 1;
    }
}
