//! One actuator that shall reach a target, and the wheel that shall reach an angle (RSP-1), each on its own: any state,
//! any target, anything measured.

use supervisor_core::{AngleDeciDeg, Follow, Millis, SteeredAngle, Timer};

/// One cycle of a [`Follow`].
#[derive(Clone, Copy, Debug)]
pub struct Pursuit {
    /// Before.
    pub old: Follow,
    /// What it was told.
    pub target: u16,
    /// What it gives, if that is known.
    pub measured: Option<u16>,
    /// The steady-state error allowed, in per cent.
    pub error: u8,
    /// Time.
    pub elapsed: Millis,
}

/// RSP-1a to RSP-1c, RSP-1g, RSP-1i: 95 % of the lowest target since it fell short is *reached*; from then on the error
/// allowed counts. Short of it the time since the command runs, and from 5 % of the way on the time since the first
/// response; reached, both stop.
#[must_use]
pub fn rsp_1_follow(Pursuit { old, target, measured, error, elapsed }: Pursuit, new: &Follow) -> bool {
    let Some(measured) = measured else { return *new == if target == 0 { Follow::INITIAL } else { old } };
    if target == 0 {
        return *new == Follow::INITIAL;
    }
    let reference = if old.reference == 0 { target } else { old.reference.min(target) };
    let needed = if old.following { 100_u32.saturating_sub(u32::from(error)) } else { 95 };
    let given = u32::from(measured) * 100;
    if given >= u32::from(reference) * needed {
        return *new == Follow { reference: target, following: true, ..Follow::INITIAL };
    }
    let begins = !old.command.is_running();
    let start = if begins { measured } else { old.start };
    // 5 % of the way from where it began; it was never above the reference.
    let first = u32::from(start) * 100 + u32::from(reference.saturating_sub(start)) * 5;
    let response = if given >= first { old.response.run(elapsed) } else { Timer::STOPPED };
    // R-af: far from it, beyond the error allowed.
    let far = given < u32::from(reference) * 100_u32.saturating_sub(u32::from(error));
    *new == Follow { reference, start, command: old.command.run(elapsed), response, following: false, far }
}

/// RSP-1a to RSP-1c, RSP-1g: it fails exactly when one of its times is reached, so never without a measured shortfall
/// in this cycle or one before that nothing measured has ended since.
#[must_use]
pub fn rsp_1_follow_fails(new: &Follow, inner: Millis, outer: Millis) -> bool {
    new.fails(inner, outer) == (new.command.reached(outer) || new.response.reached(inner))
}

/// One cycle of a [`SteeredAngle`].
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// Before.
    pub old: SteeredAngle,
    /// What it was told.
    pub target: AngleDeciDeg,
    /// What is measured, if that is known.
    pub measured: Option<AngleDeciDeg>,
    /// How far off is no fault.
    pub band: u16,
    /// Time.
    pub elapsed: Millis,
}

/// RSP-1e, RSP-1f, RSP-1i, RSP-1j: off its target by more than the band the wheel is held against the target of then:
/// more than 0.3° is a response, the target reached, or within the band of it on the way back, begins the time anew;
/// beyond the target of now, the overshoot counts.
#[must_use]
pub fn rsp_1_steered(Turn { old, target, measured, band, elapsed }: Turn, new: &SteeredAngle) -> bool {
    let Some(measured) = measured else { return *new == old };
    let apart = |one: AngleDeciDeg, other: AngleDeciDeg| (i32::from(one.raw()) - i32::from(other.raw())).unsigned_abs();
    let off = |angle| apart(measured, angle) > u32::from(band);
    if !off(target) {
        return *new == SteeredAngle::INITIAL;
    }
    let running = old.off.is_running();
    let (start, aim) = if running { (old.start, old.target) } else { (measured, target) };
    let (still, over) = if running { (old.still, old.over) } else { (Timer::STOPPED, Timer::STOPPED) };
    let since = if running { old.off } else { Timer::STOPPED };
    let left = aim >= start;
    let reached = (if left { measured >= aim } else { measured <= aim }) || !off(aim);
    if reached {
        let beyond = if left { measured > target } else { measured < target };
        return new.start == (if beyond { start } else { measured })
            && new.target == target
            && new.off == Timer::STOPPED.run(elapsed)
            && new.still == Timer::STOPPED
            && new.over == (if beyond { over.run(elapsed) } else { Timer::STOPPED });
    }
    let responds = apart(measured, start) > 3;
    new.start == start
        && new.target == aim
        && new.off == since.run(elapsed)
        && new.still == (if responds { Timer::STOPPED } else { still.run(elapsed) })
        && new.over == Timer::STOPPED
}

/// RSP-1e, RSP-1f: it fails exactly when one of its times is reached.
#[must_use]
pub fn rsp_1_steered_fails(new: &SteeredAngle, first: Millis, outer: Millis) -> bool {
    new.fails(first, outer) == (new.still.reached(first) || new.off.reached(outer))
}
