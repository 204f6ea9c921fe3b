//! What came of a drive: interventions, refused misdeeds, and whether the bus stayed safe.

use supervisor::{
    Channel, ContactorRequest, EpbRequest, EpbState, GearRequest, Level, Occupancy, Percent, Reason, Verdict, Verdicts,
};

use crate::drive::{Answer, Cycle};
use crate::misdeed::Misdeed;
use crate::number::kmh;
use crate::plant::Truth;

/// Spec §9: a controller that is short for no more than this many cycles was not intervened against.
///
/// The supervisor decides on the inputs of the very cycle; a controller that reads the same frames answers in the
/// next one at the earliest. It is allowed that cycle and two more for its own timing.
pub const GRACE_CYCLES: usize = 3;

/// The link starts: until the second frame of a message nothing shows that its counter runs, and every command is
/// refused. A stretch from the very first cycle on may last as long as the longest time-out, 500 ms.
pub const START_CYCLES: usize = 50;

/// A stretch of cycles in which one channel was not passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stretch {
    /// The channel.
    pub channel: Channel,
    /// When it began, in ms.
    pub from_ms: u32,
    /// How many cycles it lasted.
    pub cycles: usize,
    /// Its first verdict.
    pub first: Verdict,
}

/// Every stretch of cycles without a pass, in order of their beginning.
#[must_use]
pub fn stretches(cycles: &[Cycle]) -> Vec<Stretch> {
    let mut found = Vec::new();
    for channel in Channel::ALL.iter().copied() {
        let mut open: Option<Stretch> = None;
        for cycle in cycles {
            let verdict = cycle.answer.verdicts.of(channel);
            if verdict.passed() {
                found.extend(open.take());
            } else {
                let stretch = open.get_or_insert(Stretch { channel, from_ms: cycle.now_ms, cycles: 0, first: verdict });
                stretch.cycles += 1;
            }
        }
        found.extend(open);
    }
    found.sort_by_key(|stretch| (stretch.from_ms, stretch.channel));
    found
}

/// Spec §9: the stretches in which the controller was *still* short after [`GRACE_CYCLES`] cycles.
///
/// Every verdict but a pass counts, not only a substitution: a limit or a block, too, is an intervention when the
/// controller keeps asking for it. A stretch counts once, however long it is and whatever its reasons.
#[must_use]
pub fn interventions(cycles: &[Cycle]) -> Vec<Stretch> {
    let first_ms = cycles.first().map_or(0, |cycle| cycle.now_ms);
    let allowed = |from_ms: u32| if from_ms == first_ms { START_CYCLES } else { GRACE_CYCLES };
    stretches(cycles).into_iter().filter(|stretch| stretch.cycles > allowed(stretch.from_ms)).collect()
}

/// [`interventions`] of a run that is too long to keep: cycle by cycle.
#[derive(Clone, Debug, Default)]
pub struct Counter {
    open: [Option<Stretch>; 12],
    found: Vec<Stretch>,
    last: Option<Verdicts>,
}

impl Counter {
    /// One cycle.
    pub fn see(&mut self, cycle: &Cycle) {
        self.last = Some(cycle.answer.verdicts);
        for (open, (channel, verdict)) in self.open.iter_mut().zip(cycle.answer.verdicts.iter()) {
            if verdict.passed() {
                self.found.extend(open.take().filter(|stretch| stretch.cycles > GRACE_CYCLES));
            } else {
                let stretch = open.get_or_insert(Stretch { channel, from_ms: cycle.now_ms, cycles: 0, first: verdict });
                stretch.cycles += 1;
            }
        }
    }

    /// Those that begin to count with the last cycle, each with the reason that it then has: the first one may be
    /// another, that of a frame after a pause say.
    pub fn new_ones(&self) -> impl Iterator<Item = (Stretch, Reason)> {
        let new = self.open.iter().flatten().filter(|stretch| stretch.cycles == GRACE_CYCLES + 1);
        new.map(|stretch| (*stretch, self.last.map_or(stretch.first, |last| last.of(stretch.channel)).reason))
    }

    /// The interventions so far, those that still last among them, in order of their beginning.
    #[must_use]
    pub fn found(&self) -> Vec<Stretch> {
        let lasting = self.open.iter().flatten().filter(|stretch| stretch.cycles > GRACE_CYCLES);
        let mut all: Vec<Stretch> = self.found.iter().chain(lasting).copied().collect();
        all.sort_by_key(|stretch| (stretch.from_ms, stretch.channel));
        all
    }
}

/// The verdicts that a misdeed should have met and did not: none, if it was refused as expected.
#[must_use]
pub fn unmet(misdeed: &Misdeed, cycles: &[Cycle]) -> Vec<(Channel, Reason)> {
    let during = || cycles.iter().filter(|cycle| misdeed.active(cycle.now_ms));
    let met = |channel: Channel, reason: Reason| {
        during()
            .map(|cycle| cycle.answer.verdicts.of(channel))
            .any(|verdict| !verdict.passed() && verdict.reason == reason)
    };
    misdeed.expected.iter().copied().filter(|(channel, reason)| !met(*channel, *reason)).collect()
}

/// Something that must never happen, seen in the truth of the plant or in what went out to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hazard {
    /// The gap to an obstacle is used up.
    Collision,
    /// A level fell while the bus was still closing in on its obstacle.
    LevelFell,
    /// The parking brake was told to release with an empty seat, or did.
    ReleasedWithoutDriver,
    /// K1 was told to open while K4 was closed.
    K1BeforeK4,
    /// A contactor was told to open while the bus rolled.
    OpenedRolling,
    /// Drive torque during leave.
    TorqueWithoutDriver,
    /// A gear was engaged, with the bus parked by leave and nobody in the seat.
    GearWithoutDriver,
    /// Leave without sound, icon and flashers.
    SilentLeave,
}

/// Every hazard with its first time, in ms.
#[must_use]
pub fn hazards(cycles: &[Cycle]) -> Vec<(u32, Hazard)> {
    let mut found: Vec<(u32, Hazard)> = Vec::new();
    let mut note = |now_ms: u32, hazard: Hazard, happens: bool| {
        if happens && !found.iter().any(|(_, known)| *known == hazard) {
            found.push((now_ms, hazard));
        }
    };
    let pairs = std::iter::once(None).chain(cycles.iter().map(Some)).zip(cycles);
    for (before, cycle) in pairs {
        let Cycle { now_ms, truth, answer, .. } = *cycle;
        let Answer { outputs, status, .. } = answer;
        let empty = truth.seat == [false, false];
        let rolls = truth.speed.abs() > kmh(0.3);
        let [_, k4_closed] = truth.closed;
        let opens = [outputs.contactors.k1, outputs.contactors.k4].map(|request| request == ContactorRequest::Open);
        let [opens_k1, _] = opens;
        let loosens = before.is_some_and(|before| {
            before.truth.epb == Some(EpbState::Applied) && truth.epb != Some(EpbState::Applied) && empty
        });
        let falls = before.is_some_and(|before| status.level < before.answer.status.level);
        let drives = matches!(outputs.gear, GearRequest::Drive | GearRequest::Reverse | GearRequest::Park);
        let warns = outputs.warnings.seat_leave && outputs.warnings.hazard_flashers;
        let leave = status.occupancy == Occupancy::Leave;
        // What stands beside the lane is passed, not hit.
        let gap = |truth: &Truth| truth.ahead.map(|ahead| ahead.gap);
        note(now_ms, Hazard::Collision, gap(&truth).is_some_and(|gap| gap <= 0.0));
        let closes = before.is_some_and(|before| gap(&truth) < gap(&before.truth));
        note(now_ms, Hazard::LevelFell, falls && rolls && closes);
        note(now_ms, Hazard::ReleasedWithoutDriver, (empty && outputs.epb.request == EpbRequest::Release) || loosens);
        note(now_ms, Hazard::K1BeforeK4, opens_k1 && k4_closed);
        note(now_ms, Hazard::OpenedRolling, opens.contains(&true) && rolls);
        note(now_ms, Hazard::TorqueWithoutDriver, leave && outputs.drive.torque > Percent::ZERO);
        note(now_ms, Hazard::GearWithoutDriver, empty && status.parked_by_leave && drives);
        note(now_ms, Hazard::SilentLeave, leave && !warns);
    }
    found
}

/// Fingerprint of every verdict of every cycle: FNV-1a, 64 bits, over kind, reason, value, limit and margin.
#[must_use]
pub fn digest(answers: impl IntoIterator<Item = Answer>) -> u64 {
    const OFFSET: u64 = 0xCBF2_9CE4_8422_2325;
    const PRIME: u64 = 0x0000_0100_0000_01B3;
    let mut hash = OFFSET;
    let mut take = |byte: u8| hash = (hash ^ u64::from(byte)).wrapping_mul(PRIME);
    for answer in answers {
        for (_, verdict) in answer.verdicts.iter() {
            let Verdict { kind, reason, value, limit, margin } = verdict;
            take(kind.code());
            take(reason.code());
            [value, limit, margin].into_iter().flat_map(i32::to_le_bytes).for_each(&mut take);
        }
    }
    hash
}

/// Something worth telling of a drive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Event {
    /// When, in ms.
    pub now_ms: u32,
    /// What.
    pub what: String,
}

/// What happened, in order: levels, leave, parking brake, gear, contactors, and the first refusals of a kind.
#[must_use]
pub fn events(cycles: &[Cycle]) -> Vec<Event> {
    let mut found = Vec::new();
    for (before, now) in cycles.iter().zip(cycles.iter().skip(1)) {
        let mut tell = |happens: bool, what: String| {
            if happens {
                found.push(Event { now_ms: now.now_ms, what });
            }
        };
        let (old, new) = (&before.truth, &now.truth);
        let speed = format!("{:.1} km/h", new.speed * 3.6);
        let gap = new.gap.map_or(String::new(), |gap| format!(", gap {gap:.1} m"));
        let level = match now.answer.status.level {
            Level::None => "mitigation ends",
            Level::One => "mitigation level 1",
            Level::Two => "mitigation level 2",
            Level::Three => "mitigation level 3",
        };
        let sixty = |truth: &Truth| truth.gap.is_some_and(|gap| gap <= 60.0);
        tell(!sixty(old) && sixty(new), format!("60 m are left: time 0 of S1 §3.2 ({speed})"));
        tell(before.answer.status.level != now.answer.status.level, format!("{level} ({speed}{gap})"));
        let leave = |cycle: &Cycle| cycle.answer.status.occupancy == Occupancy::Leave;
        tell(old.seat != [false; 2] && new.seat == [false; 2], format!("the seat is empty ({speed})"));
        tell(!leave(before) && leave(now), format!("leave begins ({speed})"));
        tell(old.seat != [true; 2] && new.seat == [true; 2], "the seat is taken".to_owned());
        tell(leave(before) && !leave(now), "leave ends: confirmed occupied".to_owned());
        tell(old.speed > 0.0 && new.speed <= 0.0, format!("standstill{gap}"));
        let epb = match new.epb {
            None => "parking brake sets off",
            Some(EpbState::Applied) => "parking brake applied",
            Some(EpbState::Released) => "parking brake released",
        };
        tell(old.epb != new.epb, format!("{epb} ({speed})"));
        tell(old.gear != new.gear, format!("gear {:?}", new.gear));
        for (name, (was, is)) in ["K1", "K4"].iter().zip(old.closed.iter().zip(new.closed)) {
            tell(*was != is, format!("{name} {}", if is { "closed" } else { "open" }));
        }
        tell(before.answer.status.mode != now.answer.status.mode, format!("mode {:?}", now.answer.status.mode));
    }
    found
}
