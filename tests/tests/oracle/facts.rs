//! What has been true in the past, by past-time formulas over inputs, commands and outputs. Two readings where the
//! specification or a rounding leaves one open: `must` holds in every reading, `may` in at least one.

use super::past::{Clock, Series};
use super::read::*;
use super::trace::{Cycle, Trace};
use crate::common::*;

/// A formula in its strictest and in its widest reading.
#[derive(Clone, Debug)]
pub struct Both {
    pub must: Series,
    pub may: Series,
}

/// Every formula that the claims share.
#[derive(Debug)]
pub struct Facts<'a> {
    pub trace: &'a Trace,
    /// Time of the timers of obligations: a step outside 1 to 50 ms counts 10 ms (SELF-3e).
    pub safety: Clock,
    /// Time of the timers of permissions and of the 10 min: such a step counts nothing (SELF-3d).
    pub permission: Clock,
    /// A step outside 1 to 50 ms.
    pub fault: Series,
    /// Three in a row have been: the safe state may be latched (SELF-3h).
    pub safe: Series,
    /// SEAT-0a.
    pub confirmed: Series,
    /// SEAT-1a, e, f, g, h.
    pub leave: Both,
    /// Since leave began, the parking brake has been known applied.
    pub leave_applied: Series,
    /// SEAT-4d, e.
    pub parked: Both,
    /// SEAT-11: milliseconds of the 10 min, at least and at most.
    pub waited: [Vec<i64>; 2],
    /// The shutdown after leave has been committed: K4 was commanded open, though nobody asked (SEAT-7k).
    pub committed: Both,
    /// MIT-1 to MIT-4.
    pub latches: [Both; 3],
    /// The mode may have been granted by driver evidence and not have ended (TRQ-2b, TRQ-3c, MODE-1).
    pub granted: Series,
    /// Nothing may oblige, no actuator may have deviated, nobody else commands: what is asked for is to pass.
    pub calm: Series,
    /// The road is clear in every reading: perception known, no emergency, no level 3, and what was one is gone (PHB-1a, R-aa).
    pub clear: Series,
    /// Neither gear nor contactor nor parking brake has changed for a while: none can have moved past us (SELF-10).
    pub still: Series,
}

impl<'a> Facts<'a> {
    /// Evaluates every formula in every cycle.
    pub fn of(trace: &'a Trace) -> Self {
        let cycles = &trace.cycles;
        let count = cycles.len();
        let step = |at: usize| if at == 0 { 0 } else { cycles[at].now.wrapping_sub(cycles[at - 1].now) };
        let legal = |at: usize| at == 0 || (1..=50).contains(&step(at));
        let span = |at: usize, instead: i64| if legal(at) { i64::from(step(at)) } else { instead };
        let safety = Clock::adding((0..count).map(|at| span(at, 10)));
        let permission = Clock::adding((0..count).map(|at| span(at, 0)));
        let fault = Series::of(count, |at| !legal(at));
        let safe = Series::of(count, |at| at >= 2 && (at - 2..=at).all(|at| fault.at(at))).once();
        let seat = |seat: Seat| Series::of(count, |at| cycles[at].inputs.seat == [known(seat); 2]);
        let confirmed = seat(Seat::Occupied).held_for(&permission, 1_000);
        let leave = leave(trace, &safety, &confirmed);
        let applied = Series::of(count, |at| cycles[at].inputs.epb.is(EpbState::Applied));
        let leave_applied = leave.may.since(&applied.and(&leave.may)).and(&leave.may);
        let parked = parked(trace, &confirmed, &leave);
        let waited = waited(trace, &permission, &confirmed, &parked);
        let committed = committed(trace, &waited);
        let latches = [0, 1, 2].map(|level| latch(trace, [&safety, &permission], level));
        let still = still(trace, &permission);
        let mut facts = Self {
            trace,
            still,
            safety,
            permission,
            fault,
            safe,
            confirmed,
            leave,
            leave_applied,
            parked,
            waited,
            committed,
            latches,
            granted: Series::of(count, |_| false),
            calm: Series::of(count, |_| false),
            clear: Series::of(count, |_| false),
        };
        facts.granted = granted(&facts);
        facts.calm = calm(&facts);
        facts.clear = clear(&facts);
        facts
    }
    /// A cycle.
    pub fn cycle(&self, at: usize) -> &Cycle {
        &self.trace.cycles[at]
    }
    /// What was sent in the cycle before.
    pub fn before(&self, at: usize) -> Outputs {
        if at == 0 { Outputs::NEUTRAL } else { self.trace.cycles[at - 1].outputs }
    }
    /// A formula of the cycle alone.
    pub fn series(&self, holds: impl Fn(&Cycle) -> bool) -> Series {
        Series::of(self.trace.cycles.len(), |at| holds(self.cycle(at)))
    }
    /// The speeds of a cycle.
    pub fn speed(&self, at: usize) -> Speed {
        Speed::of(&self.cycle(at).inputs)
    }
    /// A level must run in this cycle.
    pub fn mitigates(&self, at: usize) -> bool {
        self.latches.iter().any(|latch| latch.must.at(at))
    }
}

/// SEAT-1: (both vacant for 2 s, unknown freezing up to 500 ms) and not parked, and not confirmed since.
fn leave(trace: &Trace, safety: &Clock, confirmed: &Series) -> Both {
    let cycles = &trace.cycles;
    let of = |holds: &dyn Fn(&Inputs) -> bool| Series::of(cycles.len(), |at| holds(&cycles[at].inputs));
    let vacant = of(&|inputs| inputs.seat == [known(Seat::Vacant); 2]);
    let occupied = of(&|inputs| inputs.seat.contains(&known(Seat::Occupied)));
    let unknown = vacant.or(&occupied).not();
    // Reset in some reading, and in every reading.
    let may_reset = occupied.or(&unknown.held_about(safety, 500));
    let must_reset = occupied.or(&unknown.held_longer(safety, 500));
    // The time between two vacant samples; or to each vacant sample that is not the first.
    let least = vacant.and(&vacant.previously()).counted(&may_reset, safety);
    let most = vacant.and(&must_reset.previously().not()).counted(&must_reset, safety);
    let powered = of(&|inputs| inputs.key.is(Key::On) || inputs.key.is(Key::Start));
    // No passage says what powered on is: the key, or a contactor that may be closed. In every reading not: neither.
    let unpowered = of(&|inputs| inputs.key.is(Key::Off) && inputs.k1 == OPEN && inputs.k4 == OPEN);
    let released = of(&|inputs| inputs.epb.is(EpbState::Released));
    let moves = of(&|inputs| Speed::of(inputs).at_least(384));
    let may_move = of(&|inputs| match Speed::of(inputs) {
        Speed::Known(_, high) => high >= 384,
        Speed::Open => true,
        Speed::Unknown => false,
    });
    let rolls = powered.and(&released.or(&moves));
    let may_roll = unpowered.not().and(&released.or(&may_move));
    let begins = Series::of(cycles.len(), |at| least[at] >= 2_000 && vacant.at(at) && rolls.at(at));
    let may_begin = Series::of(cycles.len(), |at| (most[at] >= 2_000 && may_roll.at(at)) || (at == 0 && !trace.clean));
    let goes_on = confirmed.not();
    Both { must: goes_on.since(&begins), may: goes_on.since(&may_begin).and(&goes_on) }
}

/// SEAT-4d, SEAT-4e, SELF-9d.
fn parked(trace: &Trace, confirmed: &Series, leave: &Both) -> Both {
    let cycles = &trace.cycles;
    let of = |holds: &dyn Fn(&Cycle) -> bool| Series::of(cycles.len(), |at| holds(&cycles[at]));
    let released = of(&|cycle| cycle.outputs.epb.request == EpbRequest::Release).previously();
    let applies = of(&|cycle| {
        let due = Speed::of(&cycle.inputs).below(384) && !cycle.inputs.epb.is(EpbState::Applied);
        due && cycle.outputs.epb.request == EpbRequest::Apply
    });
    let settling = of(&|cycle| cycle.inputs.seat != [known(Seat::Occupied); 2]).and(&confirmed.once().not());
    let unclean = Series::of(cycles.len(), |at| at == 0 && !trace.clean);
    let may_begin = leave.may.or(&settling).or(&unclean);
    let stays = released.not();
    Both { must: stays.since(&leave.must.and(&applies)), may: stays.since(&may_begin) }
}

/// SEAT-7a, SEAT-9b, SEAT-11.
fn waited(trace: &Trace, permission: &Clock, confirmed: &Series, parked: &Both) -> [Vec<i64>; 2] {
    let cycles = &trace.cycles;
    let of = |holds: &dyn Fn(&Inputs) -> bool| Series::of(cycles.len(), |at| holds(&cycles[at].inputs));
    let applied = of(&|inputs| inputs.epb.is(EpbState::Applied));
    let released = of(&|inputs| inputs.epb.is(EpbState::Released));
    let occupied = of(&|inputs| inputs.seat.contains(&known(Seat::Occupied)));
    let counts = applied.and(&parked.must);
    let least = counts.and(&counts.previously());
    let may_reset = confirmed.or(&occupied).or(&released).or(&parked.must.not());
    let most = applied.and(&parked.may);
    let must_reset = confirmed.or(&released).or(&parked.may.not());
    [least.counted(&may_reset, permission), most.counted(&must_reset, permission)]
}

/// SEAT-7k: K4 newly commanded open, though the main controller does not ask for it, when 10 min are over (or may be).
fn committed(trace: &Trace, waited: &[Vec<i64>; 2]) -> Both {
    let cycles = &trace.cycles;
    let open = Series::of(cycles.len(), |at| cycles[at].outputs.contactors.k4 == ContactorRequest::Open);
    let newly = open.and(&open.previously().not());
    let must = Series::of(cycles.len(), |at| {
        let asked = fresh(cycles[at].commands.contactors).is_none_or(|asked| asked.k4 == ContactorRequest::Open);
        newly.at(at) && !asked && waited[1][at] >= 600_000
    });
    let may = Series::of(cycles.len(), |at| open.at(at) && waited[1][at] >= 600_000);
    Both { must: must.once(), may: may.once() }
}

/// MIT-1 to MIT-4, MIT-7: entered, and no end since.
fn latch(trace: &Trace, [safety, permission]: [&Clock; 2], level: usize) -> Both {
    let cycles = &trace.cycles;
    let count = cycles.len();
    let of = |holds: &dyn Fn(&Cycle) -> bool| Series::of(count, |at| holds(&cycles[at]));
    let speed = |cycle: &Cycle| Speed::of(&cycle.inputs);
    // Ends in some reading: standstill by one of the two speeds for 1 s, speed lost for 10 s, nothing closing for 0.5 s, steering.
    let may_stand = of(&|cycle| match speed(cycle) {
        Speed::Known(low, _) => low < 77,
        Speed::Open => true,
        Speed::Unknown => false,
    });
    let lost = of(&|cycle| !speed(cycle).known());
    let closing = of(&object_closes);
    let unseen = of(&|cycle| cycle.sensors_known() && !object_closes(cycle)).counted(&closing, safety);
    let bound = [800, 900, i64::MAX][level];
    let may_end = may_stand
        .held_about(safety, 1_000)
        .or(&lost.held_about(safety, 10_000))
        .or(&Series::of(count, |at| level < 2 && (unseen[at] >= 500 || steers_beyond(&cycles[at].inputs, bound))));
    // Ends in every reading.
    let stands = of(&|cycle| speed(cycle).below(77)).held_for(permission, 1_000);
    let clear = of(&|cycle| perception_known(cycle) && cycle.radar.is_empty() && cycle.camera.is_empty());
    let gone = clear.held_for(permission, 520);
    let must_end = if level < 2 { stands.or(&gone) } else { stands };
    let enters = of(&|cycle| must_enter(cycle, level)).and(&may_end.not());
    let may_enter = of(&|cycle| may_enter(cycle, level));
    Both { must: may_end.not().since(&enters), may: must_end.not().since(&may_enter) }
}

/// PHB-1a, PHB-1b, MIT-6d, R-aa: perception known, no emergency in this cycle, no level 3, and since the last emergency nothing has
/// been closing for 0.5 s, known throughout.
fn clear(facts: &Facts<'_>) -> Series {
    let three = &facts.latches[2].may;
    let emergency = facts.series(may_be_emergency).or(three);
    let known = facts.series(perception_known);
    let gone = known.and(&facts.series(nothing_closes)).held_for(&facts.permission, 520);
    known.and(&gone.not().since(&emergency).not())
}

/// TRQ-2b, TRQ-3c, MODE-1, E2E-2f, SELF-3g: cruise switch on, brake pedal not pressed or unknown, brake frames not lost beyond
/// their hold of 500 ms (E2E-2 as one sentence: "last request <= 500 ms, then ramp to 0, warn, mode ends"), no obligation, no
/// clock fault, since the driver's set.
fn granted(facts: &Facts<'_>) -> Series {
    let set = facts.series(|cycle| cycle.inputs.driver_set.is(true));
    let lost = facts.series(|cycle| usable(cycle.commands.brake, 125).is_none()).held_longer(&facts.permission, 550);
    let sound = facts.series(|cycle| cycle.inputs.cruise_switch.is(true) && !pedal_not_clear(&cycle.inputs));
    let sound = sound.and(&lost.not());
    let obliged = facts.latches.iter().fold(facts.leave.must.clone(), |all, latch| all.or(&latch.must));
    let keeps = sound.and(&obliged.not()).and(&facts.fault.not()).and(&facts.safe.not());
    keeps.since(&set.and(&keeps))
}

/// In no reading an obligation, a deviation, or another sender.
fn calm(facts: &Facts<'_>) -> Series {
    let count = facts.trace.cycles.len();
    let lost = facts.series(|cycle| !Speed::of(&cycle.inputs).known()).held_for(&facts.safety, 9_000).once();
    // A power steering that steers though nobody told it to is a bypass too (SELF-10a).
    let others = facts.series(|cycle| {
        let Inputs { foreign, second_sender, eps, .. } = cycle.inputs;
        foreign != Channels::NONE || second_sender || !eps.is(EpsState::Ready)
    });
    let excess = Series::of(count, |at| {
        let told = i64::from(facts.before(at).drive.torque.raw());
        !executed_at_most(&facts.cycle(at).inputs, told + 5)
    });
    let mitigates = Series::of(count, |at| facts.latches.iter().any(|latch| latch.may.at(at)));
    let troubled = facts.leave.may.or(&mitigates).or(&facts.safe).or(&facts.fault).or(&lost);
    let deviates = excess.held_for(&facts.safety, 300).once().or(&others.within(&facts.permission, 4_000));
    troubled.or(&deviates).not()
}

/// SELF-10c: the feedback of no actuator has changed within 5 s: the time to see a bypass, and the 2 s for which it counts.
fn still(trace: &Trace, permission: &Clock) -> Series {
    let cycles = &trace.cycles;
    let of = |at: usize| {
        let Inputs { gear, k1, k4, epb, .. } = cycles[at].inputs;
        (gear, k1, k4, epb)
    };
    Series::of(cycles.len(), |at| at > 0 && of(at) != of(at - 1)).within(permission, 5_000).not()
}
