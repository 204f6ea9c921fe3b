//! Whether the actuators follow, and nobody else's commands: the monitors (RSP-1, TRQ-7, SELF-10, VLC-2f).
//!
//! They run before `decide`, so their properties look at a [`Watch`] and not at a cycle.

use supervisor_core::{
    Channels, Config, Contact, ContactorRequest, DecelMs2Q11, Deviation, EpbRequest, EpbState, EpsState, Evidence,
    Faults, Gear, GearRequest, Inputs, Millis, Monitors, Moves, Outputs, Percent, Response, Signal, SteeredAngle,
    Ticks, Timer, kernel,
};

use super::implies;
use super::reading::agreed_speeds_of;

/// One cycle of the monitors, seen from outside.
#[derive(Clone, Copy, Debug)]
pub struct Watch<'a> {
    /// What went out before, and how well it was followed.
    pub old: &'a Monitors,
    /// Inputs.
    pub inputs: &'a Inputs,
    /// Time.
    pub ticks: Ticks,
    /// Configuration.
    pub config: &'a Config,
    /// After [`advance`](Monitors::advance).
    pub new: &'a Monitors,
    /// What was found.
    pub response: &'a Response,
    /// What goes out then, ...
    pub outputs: &'a Outputs,
    /// ... service brake and retarder together, ...
    pub total: DecelMs2Q11,
    /// ... in level 3.
    pub emergency: bool,
    /// After [`record`](Monitors::record).
    pub next: &'a Monitors,
}

/// A property of a watch by its name.
pub type Named = (&'static str, fn(&Watch<'_>) -> bool);

/// Every property of a watch.
pub const ALL: &[Named] = &[
    ("rsp_1_brake_is_compared", rsp_1_brake_is_compared),
    ("rsp_1_brake_escalates_exactly", rsp_1_brake_escalates_exactly),
    ("rsp_1_abs_never_escalates", rsp_1_abs_never_escalates),
    ("rsp_1_help_stays_while_unknown", rsp_1_help_stays_while_unknown),
    ("rsp_1_overshoot", rsp_1_overshoot),
    ("rsp_1_drive", rsp_1_drive),
    ("trq_7_excess_is_found_exactly", trq_7_excess_is_found_exactly),
    ("rsp_1_gear", rsp_1_gear),
    ("rsp_1_steering", rsp_1_steering),
    ("self_10_unasked_is_a_bypass", self_10_unasked_is_a_bypass),
    ("self_10_bypass_counts_from_the_last", self_10_bypass_counts_from_the_last),
    ("self_10_loose_parking_brake", self_10_loose_parking_brake),
    ("rsp_1_nothing_else_is_reported", rsp_1_nothing_else_is_reported),
    ("rsp_1_compared_with_what_went_out", rsp_1_compared_with_what_went_out),
    ("self_10_positions_asked_for", self_10_positions_asked_for),
];

/// RSP-1f: a time of S4's tables, with dead time and the age of the feedback on top.
fn allowed(watch: &Watch<'_>, time: Millis) -> Millis {
    Millis::new(time.raw().saturating_add(watch.config.response_age.raw()))
}

/// `percent` of `value`.
fn share(value: u16, percent: Percent) -> u16 {
    kernel::share_down(value, percent.raw())
}

/// The service brake is compared: it was told enough, the bus is not known to be slow, ABS is not known at work.
fn brake_compared(watch: &Watch<'_>) -> bool {
    let slow =
        agreed_speeds_of(watch.inputs, watch.config).is_some_and(|(_, high)| high < watch.config.response_speed.raw());
    watch.old.service >= watch.config.response_decel && !slow && !watch.inputs.abs.is(true)
}

/// The measured deceleration, where it is known and plausible and the speed is known.
fn deceleration(watch: &Watch<'_>) -> Option<u16> {
    let known = watch.inputs.deceleration.known().filter(|measured| *measured <= watch.config.decel_plausible)?;
    agreed_speeds_of(watch.inputs, watch.config).map(|_| known.raw())
}

/// RSP-1b, RSP-1c, RSP-1g: it has not followed: in 1000 ms from the command, or 700 ms, in level 3 500 ms, from its
/// first response.
fn short(watch: &Watch<'_>) -> bool {
    let [ordinary, emergency, outer] = watch.config.response_brake.0;
    let inner = if watch.old.emergency { emergency } else { ordinary };
    let Monitors { brake, .. } = watch.new;
    brake.command.reached(allowed(watch, outer)) || brake.response.reached(allowed(watch, inner))
}

/// RSP-1b, RSP-1c, RSP-1g, RSP-1i, VLC-2f: the service brake is held against the last output; a shortfall confirmed, or
/// limits of both parts that do not reach it, call for help until the demand ends.
#[must_use]
pub fn rsp_1_brake_is_compared(watch: &Watch<'_>) -> bool {
    let (old, new, compared) = (watch.old, watch.new, brake_compared(watch));
    let target = if compared { old.service.raw() } else { 0 };
    let electric = Evidence::gather(watch.inputs, watch.config).electric.raw();
    let friction = watch.inputs.friction_limit.known();
    let unable = friction.is_some_and(|friction| u32::from(friction.raw()) + u32::from(electric) < u32::from(target));
    let error = watch.config.response_error.raw();
    new.brake == old.brake.advance(target, deceleration(watch), error, watch.ticks.safety)
        && new.short == old.short.run_while(short(watch), watch.ticks.safety)
        && new.helps == (compared && (old.helps || short(watch) || unable))
}

/// RSP-1k, RSP-1m, EPB-1b: confirmed exactly for a shortfall, the help that it called or EBS red, at once; persistent
/// exactly for a shortfall that EBS is red or level 3 runs with, or that the retarder had its time for; in level 3 only
/// beyond the error allowed (R-af).
#[must_use]
pub fn rsp_1_brake_escalates_exactly(watch: &Watch<'_>) -> bool {
    let (short, red) = (short(watch), watch.inputs.ebs_red.is(true));
    let due = red || watch.old.emergency || watch.new.short.reached(watch.config.response_retarder);
    let enough = watch.old.emergency && !watch.new.brake.far;
    let expected = match (short && due && !enough, short || watch.new.helps || red) {
        (true, _) => Deviation::Persistent,
        (false, true) => Deviation::Confirmed,
        (false, false) => Deviation::None,
    };
    let faults = watch.response.faults;
    watch.response.brake == expected
        && faults.contains(Faults::BRAKE_RESPONSE) == (short || watch.new.helps)
        && faults.contains(Faults::EBS_RED) == red
}

/// RSP-1l: while ABS is at work no shortfall is found, and nothing that was found before stays; EBS red alone still
/// helps.
#[must_use]
pub fn rsp_1_abs_never_escalates(watch: &Watch<'_>) -> bool {
    let new = watch.new;
    let red = watch.inputs.ebs_red.is(true);
    let timers = [new.brake.command, new.brake.response, new.short];
    implies(
        watch.inputs.abs.is(true),
        timers == [Timer::STOPPED; 3]
            && !new.helps
            && watch.response.brake == (if red { Deviation::Confirmed } else { Deviation::None })
            && !watch.response.faults.contains(Faults::BRAKE_RESPONSE),
    )
}

/// RULE-1d: what was found stays while the feedback is unknown and the demand goes on: nothing is taken back for want
/// of evidence, and no timer runs on without any.
#[must_use]
pub fn rsp_1_help_stays_while_unknown(watch: &Watch<'_>) -> bool {
    let (old, new) = (watch.old, watch.new);
    let demanded = brake_compared(watch) && old.service > DecelMs2Q11::ZERO;
    let blind = deceleration(watch).is_none() && demanded;
    implies(brake_compared(watch) && old.helps, new.helps && watch.response.brake != Deviation::None)
        && implies(blind, new.brake == old.brake && new.brake_over == old.brake_over)
        && implies(executed(watch).is_none(), new.disobeys == old.disobeys && new.excess == old.excess)
        && implies(watch.inputs.gear.known().is_none(), new.gear == old.gear && new.gearbox == old.gearbox)
        && implies(watch.inputs.eps.known().is_none(), new.steers == old.steers)
}

/// RSP-1j: more than 15 % and the drag beyond the last output, with the driver known not to brake, for its time.
#[must_use]
pub fn rsp_1_overshoot(watch: &Watch<'_>) -> bool {
    let (old, config) = (watch.old, watch.config);
    let total = old.total.raw();
    let most = total.saturating_add(share(total, config.response_error)).saturating_add(config.response_drag.raw());
    let expected = match deceleration(watch) {
        None => old.brake_over,
        Some(measured) if brake_compared(watch) && watch.inputs.brake_switch.is(false) && measured > most => {
            old.brake_over.run(watch.ticks.safety)
        }
        Some(_) => Timer::STOPPED,
    };
    let reported = watch.response.faults.contains(Faults::BRAKE_OVERSHOOT);
    watch.new.brake_over == expected && reported == expected.reached(config.response_overshoot)
}

/// The executed torque, where it is known and plausible.
fn executed(watch: &Watch<'_>) -> Option<u16> {
    watch.inputs.executed_torque.known().filter(|torque| *torque <= Percent::FULL).map(|torque| torque.raw().into())
}

/// RSP-1a, RSP-1f, RSP-1i: the drive is held against the last output from the idle torque on, not while slip control is
/// known at work; 500 ms from the command or from its first response, and it is reported.
#[must_use]
pub fn rsp_1_drive(watch: &Watch<'_>) -> bool {
    let (old, config) = (watch.old, watch.config);
    let compared = old.torque >= config.idle_torque && !watch.inputs.asr.is(true);
    let target = if compared { u16::from(old.torque.raw()) } else { 0 };
    let error = config.response_error.raw();
    let expected = old.drive.advance(target, executed(watch), error, watch.ticks.safety);
    let time = allowed(watch, config.response_drive);
    let late = expected.command.reached(time) || expected.response.reached(time);
    watch.new.drive == expected && watch.response.faults.contains(Faults::DRIVE_RESPONSE) == late
}

/// TRQ-7a, TRQ-7b: more torque than was told since it became too much, 15 % and the tolerance, for longer than the
/// response time: a fault, from then on against 0, until no more is executed; persistent after the same time once more.
/// Unknown changes nothing.
#[must_use]
pub fn trq_7_excess_is_found_exactly(watch: &Watch<'_>) -> bool {
    let (old, new, config) = (watch.old, watch.new, watch.config);
    let time = allowed(watch, config.response_drive);
    let twice = Millis::new(time.raw().saturating_add(config.response_drive.raw()));
    let told = if old.excess.is_running() { old.told.max(old.torque) } else { old.torque };
    let base = if old.disobeys { 0 } else { u16::from(told.raw()) };
    let most =
        base.saturating_add(share(base, config.response_error)).saturating_add(config.torque_excess.raw().into());
    let found = match executed(watch) {
        None => new.excess == old.excess && new.told == old.told && new.disobeys == old.disobeys,
        Some(measured) if measured > most => {
            let excess = old.excess.run(watch.ticks.safety);
            new.excess == excess && new.told == told && new.disobeys == (old.disobeys || excess.reached(time))
        }
        Some(_) => new.excess == Timer::STOPPED && new.told == told && !new.disobeys,
    };
    let expected = match (new.disobeys, new.excess.reached(twice)) {
        (false, _) => Deviation::None,
        (true, false) => Deviation::Confirmed,
        (true, true) => Deviation::Persistent,
    };
    found && watch.response.torque == expected && watch.response.faults.contains(Faults::EXCESS_TORQUE) == new.disobeys
}

/// RSP-1d: a gear that was asked for and is known not to be reached, for its time, is reported.
#[must_use]
pub fn rsp_1_gear(watch: &Watch<'_>) -> bool {
    let expected = match (watch.inputs.gear.known(), watch.old.gearbox.asked) {
        (None, _) => watch.old.gear,
        (Some(gear), Some(asked)) if gear != asked => watch.old.gear.run(watch.ticks.safety),
        (Some(_), _) => Timer::STOPPED,
    };
    let late = expected.reached(allowed(watch, watch.config.response_gear));
    watch.new.gear == expected && watch.response.faults.contains(Faults::GEAR_RESPONSE) == late
}

/// RSP-1e, RSP-1f, RSP-1i, RSP-1j: the wheel is held against the last angle while the weight is full, else forgotten;
/// no response in 100 ms, not there in 500 ms, is what *does not follow*; beyond it for its time is an overshoot.
#[must_use]
pub fn rsp_1_steering(watch: &Watch<'_>) -> bool {
    let (old, config) = (watch.old, watch.config);
    let band = config.response_angle.raw().unsigned_abs();
    let band = band.saturating_add(share(old.angle.raw().unsigned_abs(), config.response_error));
    let expected = if old.weight < Percent::FULL {
        SteeredAngle::INITIAL
    } else {
        old.steering.advance(old.angle, watch.inputs.steering_angle.known(), band, watch.ticks.safety)
    };
    let [first, outer] = config.response_steering.0;
    let fails = expected.still.reached(allowed(watch, first)) || expected.off.reached(allowed(watch, outer));
    let faults = watch.response.faults;
    watch.new.steering == expected
        && watch.response.steering == fails
        && faults.contains(Faults::STEERING_RESPONSE) == fails
        && faults.contains(Faults::STEERING_OVERSHOOT) == expected.over.reached(config.response_overshoot)
}

/// It was known, is known, and has moved to where nothing asked it to be.
fn alone<T: Copy + PartialEq>(moves: &Moves<T>, position: Signal<T>) -> bool {
    let Some((seen, position)) = moves.seen.zip(position.known()) else { return false };
    position != seen && moves.asked != Some(position)
}

/// SELF-7a, SELF-10a: a contactor that moved unasked.
fn contactor_alone(watch: &Watch<'_>) -> bool {
    alone(&watch.old.k4, watch.inputs.k4) || alone(&watch.old.k1, watch.inputs.k1)
}

/// Whether an actuator moved, or was told, though no output told it.
fn unasked(watch: &Watch<'_>) -> bool {
    let inputs = watch.inputs;
    let drives = inputs.gear.is(Gear::Drive) || inputs.gear.is(Gear::Reverse);
    let gear = watch.old.gearbox.asked.is_none() && drives && alone(&watch.old.gearbox, inputs.gear);
    let [_, outer] = watch.config.response_steering.0;
    gear || contactor_alone(watch)
        || watch.new.loose
        || watch.new.steers.reached(allowed(watch, outer))
        || inputs.foreign != Channels::NONE
}

/// SELF-10a, SELF-10b: a gear, a contactor or the parking brake that moves unasked, a steering that acts unasked for
/// its time, a foreign actuator message are exactly what is reported as a bypass, and a second sender as that; a
/// contactor's is a contactor fault, too.
#[must_use]
pub fn self_10_unasked_is_a_bypass(watch: &Watch<'_>) -> bool {
    let (faults, inputs) = (watch.response.faults, watch.inputs);
    let steers = match inputs.eps.known() {
        None => watch.old.steers,
        Some(EpsState::Active) if watch.old.weight == Percent::ZERO => watch.old.steers.run(watch.ticks.safety),
        Some(_) => Timer::STOPPED,
    };
    watch.new.steers == steers
        && faults.contains(Faults::BYPASS) == unasked(watch)
        && faults.contains(Faults::SECOND_SENDER) == inputs.second_sender
        && faults.contains(Faults::CONTACTOR) == contactor_alone(watch)
}

/// SELF-10c: a bypass counts from when it was last seen, for its time, and no less than real time.
#[must_use]
pub fn self_10_bypass_counts_from_the_last(watch: &Watch<'_>) -> bool {
    let (old, new, hold) = (watch.old.bypass, watch.new.bypass, watch.config.bypass_hold);
    let seen = unasked(watch) || watch.inputs.second_sender;
    let counts = old.is_running() && !old.reached(hold);
    if seen {
        new.is_running() && new.elapsed() == Millis::ZERO && watch.response.bypass == (hold > Millis::ZERO)
    } else {
        watch.response.bypass == counts && new == (if counts { old.run(watch.ticks.permission) } else { old })
    }
}

/// SELF-10a, RULE-1d: a parking brake that is seen released though no output released it is loose, until it is known
/// applied.
#[must_use]
pub fn self_10_loose_parking_brake(watch: &Watch<'_>) -> bool {
    let epb = watch.inputs.epb;
    let released = epb.is(EpbState::Released) && alone(&watch.old.epb, epb);
    watch.new.loose == ((watch.old.loose || released) && !epb.is(EpbState::Applied))
        && watch.response.parking == watch.new.loose
        && implies(released, watch.response.faults.contains(Faults::BYPASS))
}

/// RSP-1i, RSP-1j, RSP-1l: the monitors report nothing beside what stands in the other properties.
#[must_use]
pub fn rsp_1_nothing_else_is_reported(watch: &Watch<'_>) -> bool {
    let brakes = Faults::BRAKE_RESPONSE.with(Faults::EBS_RED).with(Faults::BRAKE_OVERSHOOT);
    let drive = Faults::DRIVE_RESPONSE.with(Faults::EXCESS_TORQUE).with(Faults::GEAR_RESPONSE);
    let steering = Faults::STEERING_RESPONSE.with(Faults::STEERING_OVERSHOOT);
    let others = Faults::BYPASS.with(Faults::SECOND_SENDER).with(Faults::CONTACTOR);
    brakes.with(drive).with(steering).with(others).contains(watch.response.faults)
}

/// RSP-1c, CMD-3f: what the next cycle compares with is what went out; in level 3 its shorter time begins with it, but
/// not if help was called already; what was found stays.
#[must_use]
pub fn rsp_1_compared_with_what_went_out(watch: &Watch<'_>) -> bool {
    let (new, next, out) = (watch.new, watch.next, watch.outputs);
    let steers = if out.steering.enable { out.steering.weight } else { Percent::ZERO };
    let anew = watch.emergency && !new.emergency && !new.helps;
    let timer = |timer| if anew { Timer::STOPPED } else { timer };
    let brake =
        supervisor_core::Follow { command: timer(new.brake.command), response: timer(new.brake.response), ..new.brake };
    next.service == out.brake.total
        && next.total == watch.total
        && next.emergency == watch.emergency
        && next.torque == out.drive.torque
        && next.angle == out.steering.angle
        && next.weight == steers
        && next.brake == brake
        && (next.short, next.helps, next.brake_over) == (new.short, new.helps, new.brake_over)
        && (next.drive, next.excess, next.told, next.disobeys) == (new.drive, new.excess, new.told, new.disobeys)
        && (next.steering, next.steers, next.gear, next.bypass) == (new.steering, new.steers, new.gear, new.bypass)
}

/// A position that is asked for stays so until it is reached; what is seen is the last one known.
fn kept<T: Copy + PartialEq>(
    old: &Moves<T>,
    position: Signal<T>,
    new: &Moves<T>,
    asks: Option<T>,
    next: &Moves<T>,
) -> bool {
    let reached = old.asked.is_some_and(|asked| position.is(asked));
    new.seen == position.known().or(old.seen)
        && new.asked == old.asked.filter(|_| !reached)
        && next.seen == new.seen
        && next.asked == asks.or(new.asked)
}

/// SELF-10a: gear, parking brake and contactors: what went out is asked for until it is reached; a release that went
/// out is no loose brake.
#[must_use]
pub fn self_10_positions_asked_for(watch: &Watch<'_>) -> bool {
    let (inputs, out) = (watch.inputs, watch.outputs);
    let (old, new, next) = (watch.old, watch.new, watch.next);
    let gear = match out.gear {
        GearRequest::Hold => None,
        GearRequest::Neutral => Some(Gear::Neutral),
        GearRequest::Drive => Some(Gear::Drive),
        GearRequest::Reverse => Some(Gear::Reverse),
        GearRequest::Park => Some(Gear::Park),
    };
    let epb = match out.epb.request {
        EpbRequest::None => None,
        EpbRequest::Apply => Some(EpbState::Applied),
        EpbRequest::Release => Some(EpbState::Released),
    };
    let contact = |request| match request {
        ContactorRequest::Hold => None,
        ContactorRequest::Open => Some(Contact::Open),
        ContactorRequest::Close => Some(Contact::Closed),
    };
    kept(&old.gearbox, inputs.gear, &new.gearbox, gear, &next.gearbox)
        && kept(&old.epb, inputs.epb, &new.epb, epb, &next.epb)
        && kept(&old.k4, inputs.k4, &new.k4, contact(out.contactors.k4), &next.k4)
        && kept(&old.k1, inputs.k1, &new.k1, contact(out.contactors.k1), &next.k1)
        && next.loose == (new.loose && out.epb.request != EpbRequest::Release)
}
