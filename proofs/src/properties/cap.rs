//! How much may the bus brake? (PHB-1, TRQ-3, TRQ-4, MIT-6, MIT-8)

use supervisor_core::{DecelMs2Q11, Deviation, Mode, kernel};

use super::known::BrakePedal;
use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    phb_1_cap_exactly,
    phb_1b_full_cap_in_danger,
    phb_1_never_against_obligation_or_driver,
    trq_3b_comfort_braking_ends_at_the_pedal,
    trq_4g_no_comfort_braking_against_the_accelerator,
    self_11b_nothing_else_limits
];

/// Whether the road is not known to be clear: perception unknown, an object near in time or severe by the second opinion,
/// level 3, such an object or a level not yet known to be over; and the safe state.
fn hazard(of: &Cycle<'_>) -> bool {
    !of.threat.known
        || of.threat.emergency
        || of.new.mitigation.three
        || of.new.mitigation.permitted
        || of.new.is_safe_state()
}

/// Whether mitigation of any level may be asked for.
fn mitigable(of: &Cycle<'_>) -> bool {
    let latches = &of.new.mitigation;
    hazard(of) || of.threat.mitigable || latches.one || latches.two || latches.three
}

/// The cap by the road alone; whoever is known to stand is thrown by nothing (R-ag).
fn by_road(of: &Cycle<'_>) -> DecelMs2Q11 {
    let config = of.config;
    if hazard(of) || of.stands() { config.brake_cap } else { config.brake_cap.min(config.comfort_cap) }
}

/// What the driver's pedal asks for: its share of the full pedal, and drag. At an unknown depth, anything.
fn by_pedal(depth: Option<supervisor_core::Pedal250>, of: &Cycle<'_>) -> DecelMs2Q11 {
    let config = of.config;
    depth.map_or(config.brake_cap, |travel| {
        let share = kernel::share_up(config.pedal_decel.raw(), travel.raw(), 250);
        DecelMs2Q11::new(share.saturating_add(config.drag_decel.raw())).min(config.brake_cap)
    })
}

/// PHB-1a, PHB-1b, PHB-1d, MIT-8d, RULE-3b: with the driver's feet off both pedals the cap is that of comfort exactly while
/// the road is known to be clear and the bus not known to stand (R-ag), and the full one otherwise; an obligation beyond it raises it.
#[must_use]
pub fn phb_1_cap_exactly(cycle: &Cycle<'_>) -> bool {
    let bound = &cycle.envelope.brake;
    let hands_off = cycle.brake_pedal() == BrakePedal::Released && cycle.new.drive.mode != Mode::Suspended;
    implies(hands_off, bound.cap.most == by_road(cycle).max(bound.floor.most))
}

/// PHB-1b, MIT-6d, MIT-8d: each of these alone frees the full cap, whatever the pedals say.
#[must_use]
pub fn phb_1b_full_cap_in_danger(cycle: &Cycle<'_>) -> bool {
    let danger = cycle.new.mitigation.three || cycle.threat.emergency || !cycle.threat.known;
    implies(danger, cycle.envelope.brake.cap.most >= cycle.config.brake_cap)
}

/// PHB-1c, PHB-1d, RULE-3b: the cap is never below the obligation, nor below what the driver's pedal asks for.
#[must_use]
pub fn phb_1_never_against_obligation_or_driver(cycle: &Cycle<'_>) -> bool {
    let bound = &cycle.envelope.brake;
    let driver = match cycle.brake_pedal() {
        BrakePedal::Pressed(depth) => by_pedal(depth, cycle),
        BrakePedal::Released | BrakePedal::Unknown => DecelMs2Q11::ZERO,
    };
    bound.cap.most >= bound.floor.most && bound.cap.most >= driver
}

/// TRQ-3b: outside of mitigation, the brake pedal pressed: no more than the driver asks for, or is obliged. The pedal unknown:
/// no more than the drag that it has anyway. In mitigation the pedal takes nothing away.
#[must_use]
pub fn trq_3b_comfort_braking_ends_at_the_pedal(cycle: &Cycle<'_>) -> bool {
    let (bound, road) = (&cycle.envelope.brake, by_road(cycle));
    let requested = match (cycle.brake_pedal(), mitigable(cycle)) {
        (BrakePedal::Released, _) => return true,
        (BrakePedal::Pressed(depth), true) => road.max(by_pedal(depth, cycle)),
        (BrakePedal::Pressed(depth), false) => by_pedal(depth, cycle),
        (BrakePedal::Unknown, true) => road,
        (BrakePedal::Unknown, false) => road.min(cycle.config.drag_decel),
    };
    bound.cap.most == requested.max(bound.floor.most)
}

/// TRQ-4g, TRQ-3c: while the driver overrides, which needs the brake pedal known released, comfort braking is limited to
/// nothing; mitigation is not comfort.
#[must_use]
pub fn trq_4g_no_comfort_braking_against_the_accelerator(cycle: &Cycle<'_>) -> bool {
    let bound = &cycle.envelope.brake;
    let overridden = cycle.new.drive.mode == Mode::Suspended;
    let requested = if mitigable(cycle) { by_road(cycle) } else { DecelMs2Q11::ZERO };
    implies(
        overridden,
        cycle.brake_pedal() == BrakePedal::Released && bound.cap.most == requested.max(bound.floor.most),
    )
}

/// SELF-11b, SELF-11g: with nothing obliged, the pedals untouched and every actuator following, no limit but the cap of the
/// road is left.
#[must_use]
pub fn self_11b_nothing_else_limits(cycle: &Cycle<'_>) -> bool {
    let (new, response) = (cycle.new, cycle.response);
    let latches = &new.mitigation;
    let obliged = latches.one || latches.two || latches.three || latches.hold || new.seat.leave || new.is_safe_state();
    let follows = response.torque != Deviation::Persistent && !response.parking && response.brake == Deviation::None;
    let hands_off = cycle.brake_pedal() == BrakePedal::Released && new.drive.mode != Mode::Suspended;
    let bound = &cycle.envelope.brake;
    implies(
        !obliged && follows && hands_off,
        bound.floor.most == DecelMs2Q11::ZERO && bound.cap.most == by_road(cycle) && !bound.retarder_obliged,
    )
}
