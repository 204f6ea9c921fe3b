//! When are two retained states the same? When nothing that can ever be seen differs.
//!
//! Two things of a retained state grow without end and mean nothing: the absolute time (only differences count, END-1),
//! and how far a timer is beyond the last span that it is compared with. The *key* of a state leaves out both, and
//! nothing else. The explorer steps the state as it was reached, never the key; for one cycle in sixteen it
//! steps the key too, and a difference in anything that goes out is a finding.

use supervisor_core::{
    Boot, Brake, Clock, Config, Drive, Follow, HighVoltage, Latches, Millis, Mitigation, Monitors, Parking,
    STATE_WORDS, SeatState, Stage, State, SteeredAngle, SteeringState, Timer, Words,
};

/// The words of a state without what means nothing.
pub type Key = [u32; STATE_WORDS];

/// A timer of the state and the spans that it is compared with, the least first.
pub struct Watch<'a> {
    /// Its name.
    pub name: &'static str,
    /// The timer.
    pub timer: &'a mut Timer,
    /// What it is compared with.
    pub spans: [Millis; 2],
}

/// The sum of two spans.
fn plus(first: Millis, second: Millis) -> Millis {
    Millis::new(first.raw().saturating_add(second.raw()))
}

/// Every timer of the state. No field is left out unnamed: a new one does not compile until it stands here.
#[expect(clippy::too_many_lines, reason = "one list of every field, so that none is left out")]
pub fn watches<'a>(state: &'a mut State, config: &Config) -> [Watch<'a>; 30] {
    let watch = |name, timer, spans| Watch { name, timer, spans };
    let one = |span: Millis| [span, span];
    let State {
        clock: Clock { started: _, last: _, faults: _ },
        boot: Boot { pending: _, wait: boot },
        seat: SeatState { occupied, vacant, unknown, leave: _ },
        parking: Parking { by_leave: _, pedal: _, unconfirmed, slow: _, speedless: parking_speedless },
        high_voltage: HighVoltage { stage, parked, wait, restart: _, key: _ },
        mitigation:
            Mitigation {
                one: _,
                two: _,
                three: _,
                gone,
                standstill,
                speedless: level_speedless,
                hold: _,
                permitted: _,
                forward: _,
                pedestrian: _,
            },
        drive: Drive { mode: _, exit: _, notice, torque: _, automated: _, rest: _, armed: _, release_needed: _, hill },
        brake: Brake { total: _, retarder: _, lost, retarder_lost, slow: _, leave: _, lamps: _ },
        gear: _,
        steering:
            SteeringState {
                weight: _,
                angle: _,
                angle_rest: _,
                fade_rest: _,
                overlay: _,
                takeover,
                barred: _,
                astray: _,
                lost: _,
            },
        body: _,
        monitors:
            Monitors {
                brake:
                    Follow {
                        reference: _,
                        start: _,
                        command: brake_command,
                        response: brake_response,
                        following: _,
                        far: _,
                    },
                short,
                helps: _,
                brake_over,
                drive:
                    Follow {
                        reference: _,
                        start: _,
                        command: drive_command,
                        response: drive_response,
                        following: _,
                        far: _,
                    },
                excess,
                told: _,
                disobeys: _,
                steering: SteeredAngle { start: _, target: _, off, still, over },
                steers,
                gear,
                gearbox: _,
                epb: _,
                loose: _,
                k4: _,
                k1: _,
                bypass,
                service: _,
                total: _,
                emergency: _,
                torque: _,
                angle: _,
                weight: _,
            },
        latches: Latches { faults: _, quiet, off_seen: _ },
        flow: _,
    } = state;
    let age = config.response_age;
    let [brake_inner, brake_emergency, brake_outer] = config.response_brake.0;
    let [steering_first, steering_outer] = config.response_steering.0;
    let drive_outer = plus(config.response_drive, age);
    // In *down* nothing is waited for.
    let contactors = match stage {
        Stage::Up | Stage::Down => one(Millis::ZERO),
        Stage::OpeningK4 => one(config.k4_deadline),
        Stage::OpeningK1 => one(config.k1_deadline),
    };
    let inner = plus(brake_inner.min(brake_emergency), age);
    let brake_spans = [inner, plus(brake_outer.max(brake_inner), age)];
    [
        watch("boot.wait", boot, one(config.boot_settle)),
        watch("seat.occupied", occupied, one(config.seat_confirm)),
        watch("seat.vacant", vacant, one(config.seat_vacant)),
        watch("seat.unknown", unknown, one(config.seat_freeze)),
        watch("parking.unconfirmed", unconfirmed, one(config.epb_confirm)),
        watch("parking.speedless", parking_speedless, one(config.epb_speedless)),
        watch("high_voltage.parked", parked, one(config.shutdown_after)),
        watch("high_voltage.wait", wait, contactors),
        watch("mitigation.gone", gone, one(config.level_gone)),
        watch("mitigation.standstill", standstill, one(config.level_standstill)),
        watch("mitigation.speedless", level_speedless, one(config.level_speedless)),
        watch("drive.notice", notice, one(config.notice_time)),
        watch("drive.hill", hill, one(config.hill_hold)),
        watch("brake.lost", lost, one(config.brake_hold)),
        watch("brake.retarder_lost", retarder_lost, one(config.brake_hold)),
        watch("steering.takeover", takeover, one(config.takeover_time)),
        watch("monitors.brake.command", brake_command, brake_spans),
        watch("monitors.brake.response", brake_response, brake_spans),
        watch("monitors.short", short, one(config.response_retarder)),
        watch("monitors.brake_over", brake_over, one(config.response_overshoot)),
        watch("monitors.drive.command", drive_command, one(drive_outer)),
        watch("monitors.drive.response", drive_response, one(drive_outer)),
        watch("monitors.excess", excess, [drive_outer, plus(drive_outer, config.response_drive)]),
        watch("monitors.steering.off", off, one(plus(steering_outer, age))),
        watch("monitors.steering.still", still, one(plus(steering_first, age))),
        watch("monitors.steering.over", over, one(config.response_overshoot)),
        watch("monitors.steers", steers, one(plus(steering_outer, age))),
        watch("monitors.gear", gear, one(plus(config.response_gear, age))),
        watch("monitors.bypass", bypass, one(config.bypass_hold)),
        watch("latches.quiet", quiet, one(config.fault_free)),
    ]
}

/// The state with its clock at zero, and every timer that is beyond its last span just beyond it.
pub fn normalised(state: &State, config: &Config) -> State {
    let mut state = *state;
    // From three on a lost clock is lost, however often.
    state.clock = Clock { last: Millis::ZERO, faults: state.clock.faults.min(3), ..state.clock };
    for Watch { timer, spans: [_, last], .. } in watches(&mut state, config) {
        if timer.reached(last) {
            *timer = Timer::STOPPED.run(Millis::ZERO).run(last);
        }
    }
    state
}

/// What two equal states have in common.
pub fn key(normalised: &State) -> Key {
    let mut key = [0; STATE_WORDS];
    let mut slots = key.iter_mut();
    normalised.write(&mut |word| {
        if let Some(slot) = slots.next() {
            *slot = word;
        }
    });
    key
}

/// A timer with a span of at least this is a long one; but for that of boot, which runs once.
const LONG: Millis = Millis::new(1000);
/// A timer with a span of at least this is a very long one: the ten minutes, and a leave without a speed.
const VERY_LONG: Millis = Millis::new(5000);

/// Where a state stands between two events of its timers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moment {
    /// Every timer stands, has just begun, is about to pass a span, or has passed all of them; or a short one is about to.
    Corner,
    /// A short timer is on its way, and nothing is about to happen.
    Midway,
    /// A long timer is on its way.
    LongMidway,
    /// A very long one is, and every short one stands or has passed its span.
    SettledMidway,
    /// A very long one is, and a short one runs.
    UnsettledMidway,
}

/// `fine` cycles before each span and as many from its begin and from each span on are worth a look of their own.
pub fn moment(state: &State, fine: u32, tick: Millis, config: &Config) -> Moment {
    let before = tick.raw().saturating_mul(fine);
    let after = tick.raw().saturating_mul(fine.saturating_sub(1));
    let mut state = *state;
    let (mut short, mut eve, mut long, mut very_long, mut settled) = (false, false, false, false, true);
    for Watch { name, timer, spans } in watches(&mut state, config) {
        let [_, last] = spans;
        let is_long = last >= LONG && name != "boot.wait";
        if !timer.is_running() || timer.reached(last) {
            continue;
        }
        settled &= is_long;
        let elapsed = timer.elapsed().raw();
        let begun = |since: u32| elapsed >= since && elapsed <= since.saturating_add(after);
        let due = |span: Millis| elapsed < span.raw() && elapsed.saturating_add(before) >= span.raw();
        if spans.into_iter().any(due) {
            eve |= !is_long;
        } else if !begun(0) && !spans.into_iter().any(|span| begun(span.raw())) {
            short |= !is_long;
            long |= is_long;
            very_long |= is_long && last >= VERY_LONG;
        }
    }
    match (very_long, long, short) {
        (true, _, _) if settled => Moment::SettledMidway,
        (true, _, _) => Moment::UnsettledMidway,
        (false, true, _) => Moment::LongMidway,
        (false, false, true) if !eve => Moment::Midway,
        (false, false, _) => Moment::Corner,
    }
}

/// The timers, and which of *stopped*, *running*, *reached* each is in, as bits 0 to 2.
pub fn timers(state: &State, config: &Config) -> impl Iterator<Item = (&'static str, u8)> {
    let mut state = *state;
    watches(&mut state, config)
        .map(|Watch { name, timer, spans: [_, last] }| {
            (name, if timer.reached(last) { 2 } else { u8::from(timer.is_running()) })
        })
        .into_iter()
}
