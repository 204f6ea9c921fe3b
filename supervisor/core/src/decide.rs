//! Decide: from state, inputs and threat to the next state and the envelope of this cycle. Pure, loop-free.

use crate::boot;
use crate::brake::Situation;
use crate::drive::Obligations;
use crate::envelope::{Envelope, Timeouts, WarningBound};
use crate::mitigation::Steered;
use crate::parking::Parking;
use crate::state::State;
use supervisor_observe::{BrakePedal, Evidence, SeatView};

use supervisor_terms::word::permit;
use supervisor_terms::{Config, Deviation, Faults, Flow, Inputs, Millis, Reason, Response, Stage, Threat};

pub(crate) use supervisor_observe::Ticks;

/// What `decide` gives.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct Decided {
    /// The next state, before the outputs of this cycle are recorded in it.
    pub state: State,
    /// What must and may happen in this cycle.
    pub envelope: Envelope,
    /// The faults of this cycle.
    pub faults: Faults,
    pub(crate) ticks: Ticks,
}

/// Decides one cycle. Total: any state, time, inputs, threat, response; any configuration.
#[must_use]
pub fn decide(
    state: &State,
    now: Millis,
    inputs: &Inputs,
    threat: &Threat,
    response: &Response,
    config: &Config,
) -> Decided {
    let (clock, ticks) = state.clock.advance(now, config);
    let evidence = Evidence::gather(inputs, config);
    let cause = response
        .faults
        .and(Faults::CONTACTOR)
        // A changed configuration is read anew by a restart only.
        .with(state.latches.faults.and(Faults::CONFIGURATION))
        .when(clock.is_lost(), Faults::CLOCK_LATCHED)
        .when(state.flow != Flow::RECORDED, Faults::FLOW)
        .when(state.high_voltage.k4_overdue(config) || state.high_voltage.k1_overdue(config), Faults::CONTACTOR);
    let latches = state.latches.advance(cause, &evidence, inputs, ticks, config);
    let safe_state = latches.safe_state();

    // The driver: seat, boot, parking brake, high voltage.
    let seat = state.seat.advance(&evidence, inputs, ticks, config);
    let (boot, settled) = state.boot.advance(&seat, &evidence, inputs, ticks, config);
    let by_leave = state.parking.by_leave || settled == boot::Verdict::ParkedByLeave;
    let parking = Parking { by_leave, ..state.parking }.advance(&seat, &evidence, inputs, ticks, config);
    let clean = settled == boot::Verdict::OffSeen;
    let high_voltage = state.high_voltage.advance(&parking, &seat, clean, &evidence, inputs, ticks, config);

    // The road.
    let steering = state.steering.advance(response.steering && !seat.leave, &evidence, inputs, ticks, config);
    let takeover = steering.taken_over(config) || steering.barred;
    let steered = Steered { automatic: state.steering.acts(), takeover };
    let mitigation = state.mitigation.advance(threat, steered, &evidence, inputs, ticks, config);

    // The drive.
    let must = Obligations {
        mitigation: mitigation.running() || mitigation.hold,
        leave: seat.leave,
        safe_state,
        clock_fault: ticks.fault,
        shutdown: high_voltage.stage != Stage::Up,
        confirmed: seat.confirmed(config) && evidence.seat == SeatView::Occupied,
        takeover: steering.taken_over(config),
        brake_lost: state.brake.lost.reached(config.brake_hold),
        bypass: response.bypass,
        excess: response.torque != Deviation::None,
    };
    let drive = state.drive.advance(must, threat, &evidence, inputs, ticks, config);
    let brake = state.brake.advance(seat.leave, &evidence, inputs, config);
    let gear = state.gear.advance(&evidence, inputs);
    let next =
        State { clock, boot, seat, parking, high_voltage, mitigation, drive, brake, gear, steering, latches, ..*state };

    let faults = faults(&next, threat, response, &evidence, ticks, config);
    let envelope = envelope(&next, must, faults, threat, response, &evidence, inputs, ticks, config);
    Decided { state: next, envelope, faults, ticks }
}

fn envelope(
    next: &State,
    must: Obligations,
    faults: Faults,
    threat: &Threat,
    response: &Response,
    evidence: &Evidence,
    inputs: &Inputs,
    ticks: Ticks,
    config: &Config,
) -> Envelope {
    let State { seat, parking, high_voltage, mitigation, drive, brake, .. } = next;
    let automated = drive.permission(must, threat, evidence, inputs);
    let confirmed = seat.confirmed(config);
    let situation = Situation {
        mitigation,
        threat,
        response,
        mode: drive.mode,
        safe_state: must.safe_state,
        loose: response.parking && !confirmed,
    };
    // SELF-5f: the contactors hold in the safe state.
    let held = permit!(!must.safe_state => Reason::SafeState);
    let sound = permit!(!next.latches.contactor() => Reason::ContactorFault);
    let (k4, k1) = high_voltage.bounds(evidence, inputs, held, sound, config);
    // EPB-1b, EPB-1c: the brakes fall short of leave or level 3, and not because ABS works.
    let unbraked = response.brake == Deviation::Persistent
        && (seat.leave || mitigation.three)
        && inputs.abs.is(false)
        && !must.safe_state;
    // RSP-1k: what helps is not taken away while it is needed.
    let helps = response.brake != Deviation::None && (seat.leave || mitigation.three);
    let forced = if unbraked {
        Some(Reason::BrakeResponse)
    } else if response.parking && !confirmed && evidence.obliged_below(config.epb_speed) {
        Some(Reason::Bypass)
    } else {
        None
    };
    let steering = next.steering.bound(drive.mode, must.safe_state, evidence, inputs, ticks, config);
    Envelope {
        timeouts: Timeouts { ms50: config.timeout_50, ms100: config.timeout_100, ms200: config.timeout_200 },
        gear: next.gear.bound(parking, seat, evidence, inputs, must.safe_state, config),
        brake: brake.bound(&situation, evidence, inputs, ticks, config),
        torque: drive.bound(must, automated, threat, evidence, inputs, ticks, config),
        target_speed: drive.target_speed(must, automated, threat, config),
        epb: parking.bound(seat, evidence, inputs, must.safe_state, forced, helps, config),
        steering,
        k4,
        k1,
        auxiliaries_off: permit!(evidence.standstill => Reason::NotStandstill),
        warnings: WarningBound {
            forward_collision: mitigation.forward,
            pedestrian: mitigation.pedestrian,
            seat_leave: seat.leave,
            // SELF-5h: and in the safe state.
            hazard_flashers: seat.leave || must.safe_state,
            fault_lamp: faults.without(Faults::HINTS) != Faults::NONE,
            notice_lamp: next.steering.barred
                || next.steering.astray
                || next.steering.lost
                || (steering.enable.is_err() && next.steering.acts())
                || drive.notices(config),
        },
        lamp_decel: config.lamp_decel,
        lamps_delayed: brake.lamps > Millis::ZERO,
        body_fallback: next.body,
        automated,
    }
}

/// SEAT-10c: what is reported in this cycle, the seat sensors among it.
fn faults(
    next: &State,
    threat: &Threat,
    response: &Response,
    evidence: &Evidence,
    ticks: Ticks,
    config: &Config,
) -> Faults {
    next.latches
        .faults
        .with(response.faults)
        .when(evidence.split_implausible, Faults::SPLIT_IMPLAUSIBLE)
        .when(ticks.fault, Faults::CLOCK)
        .when(evidence.seat == SeatView::HalfOccupied, Faults::SEAT_DISAGREE)
        .when(evidence.seat == SeatView::Unknown, Faults::SEAT_UNKNOWN)
        .when(evidence.speed.is_none(), Faults::SPEED_UNKNOWN)
        .when(next.parking.overdue(config), Faults::EPB_UNCONFIRMED)
        .when(next.high_voltage.k4_overdue(config), Faults::K4_OVERDUE)
        .when(next.high_voltage.k1_overdue(config), Faults::K1_OVERDUE)
        .when(!threat.known, Faults::PERCEPTION_UNKNOWN)
        // Nothing is obliged below this speed, so nothing disagrees.
        .when(threat.disagreement && !evidence.obliged_below(config.level_least_speed), Faults::TTC_DISAGREEMENT)
        .when(evidence.accelerator.is_none(), Faults::ACCELERATOR_UNKNOWN)
        .when(evidence.brake_pedal == BrakePedal::Unknown, Faults::BRAKE_PEDAL_UNKNOWN)
        .when(next.steering.taken_over(config), Faults::TAKEOVER)
        .when(next.brake.lost.is_running(), Faults::BRAKE_COMMAND_LOST)
}
