//! Decide: from state, inputs and threat to the next state and the envelope of this cycle. Pure, loop-free.

use crate::boot;
use crate::brake::Situation;
use crate::drive::Obligations;
use crate::envelope::{Envelope, Timeouts, WarningBound};
use crate::evidence::{BrakePedal, Evidence, SeatView};
use crate::mitigation::Steered;
use crate::parking::Parking;
use crate::state::State;

use supervisor_terms::word::permit;
use supervisor_terms::{Config, Faults, Inputs, Millis, Reason, Stage, Threat};

pub(crate) use crate::clock::Ticks;

/// What `decide` gives.
#[derive(Clone, Copy, Debug)]
pub struct Decided {
    /// The next state, before the outputs of this cycle are recorded in it.
    pub state: State,
    /// What must and may happen in this cycle.
    pub envelope: Envelope,
    /// The faults of this cycle.
    pub faults: Faults,
    pub(crate) ticks: Ticks,
}

/// Decides one cycle. Total: any state, time, inputs, threat; any configuration.
#[must_use]
pub fn decide(state: &State, now: Millis, inputs: &Inputs, threat: &Threat, config: &Config) -> Decided {
    let (clock, ticks) = state.clock.advance(now, config);
    let latched = state.latched.when(clock.is_lost(), Faults::CLOCK_LATCHED);
    let safe_state = latched != Faults::NONE;
    let evidence = Evidence::gather(inputs, config);

    // The driver: seat, boot, parking brake, high voltage.
    let seat = state.seat.advance(&evidence, inputs, ticks, config);
    let (boot, settled) = state.boot.advance(&seat, &evidence, inputs, ticks, config);
    let by_leave = state.parking.by_leave || settled == boot::Verdict::ParkedByLeave;
    let parking = Parking { by_leave, ..state.parking }.advance(&seat, &evidence, inputs, ticks, config);
    let clean = settled == boot::Verdict::OffSeen;
    let high_voltage = state.high_voltage.advance(&parking, &seat, clean, &evidence, inputs, ticks, config);

    // The road.
    let steering = state.steering.advance(&evidence, inputs, ticks, config);
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
    };
    let drive = state.drive.advance(must, threat, &evidence, inputs, ticks, config);
    let brake = state.brake.advance(seat.leave, &evidence, inputs, config);
    let gear = state.gear.advance(&evidence, inputs);
    let next =
        State { clock, boot, seat, parking, high_voltage, mitigation, drive, brake, gear, steering, latched, ..*state };

    let faults = faults(&next, threat, &evidence, ticks, config);
    let envelope = envelope(&next, must, faults, threat, &evidence, inputs, ticks, config);
    Decided { state: next, envelope, faults, ticks }
}

fn envelope(
    next: &State,
    must: Obligations,
    faults: Faults,
    threat: &Threat,
    evidence: &Evidence,
    inputs: &Inputs,
    ticks: Ticks,
    config: &Config,
) -> Envelope {
    let State { seat, parking, high_voltage, mitigation, drive, brake, .. } = next;
    let automated = drive.permission(must, threat, evidence, inputs);
    let situation = Situation { mitigation, threat, mode: drive.mode, safe_state: must.safe_state };
    // SELF-5f: the contactors hold in the safe state.
    let held = permit!(!must.safe_state => Reason::SafeState);
    let (k4, k1) = high_voltage.bounds(evidence, inputs, held, config);
    let steering = next.steering.bound(drive.mode, must.safe_state, evidence, inputs, ticks, config);
    Envelope {
        timeouts: Timeouts { ms50: config.timeout_50, ms100: config.timeout_100, ms200: config.timeout_200 },
        gear: next.gear.bound(parking, seat, evidence, inputs, must.safe_state, config),
        brake: brake.bound(&situation, evidence, inputs, ticks, config),
        torque: drive.bound(must, automated, threat, evidence, inputs, ticks, config),
        target_speed: drive.target_speed(must, automated, threat, config),
        epb: parking.bound(seat, evidence, inputs, must.safe_state, config),
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
fn faults(next: &State, threat: &Threat, evidence: &Evidence, ticks: Ticks, config: &Config) -> Faults {
    next.latched
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
