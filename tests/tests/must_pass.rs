//! Must-pass: healthy inputs, driver seated, no hazard: what is inside the envelope goes out unchanged (SELF-11, SELF-2b).
//!
//! Each row asks one channel for every value that it must let pass; all other channels idle, and pass too.

mod common;
use common::*;

const FAST: SpeedKmhQ8 = kmh(50);

/// Every channel passes and nothing is reported.
#[track_caller]
fn assert_transparent(decision: &Decision) {
    for (channel, verdict) in decision.verdicts.iter() {
        assert!(verdict.passed(), "{channel:?}: {verdict:?}");
    }
    assert_eq!(decision.status.faults, Faults::NONE);
    let Warnings { fault_lamp, notice_lamp, hazard_flashers, seat_leave, .. } = decision.outputs.warnings;
    assert!(!fault_lamp && !notice_lamp && !hazard_flashers && !seat_leave);
    Bus::assert_idempotent(decision);
}

/// SELF-11a to SELF-11k: an idle, correct controller passes on every channel, in every ordinary situation, for an hour.
#[test]
fn an_idle_controller_passes_on_every_channel() {
    for mut bus in
        [Bus::parked(), Bus::driving(kmh(0)), Bus::driving(FAST), Bus::driving(kmh_q8(u16::MAX)), Bus::automated(FAST)]
    {
        bus.run_with(3_600_000, 50, assert_transparent);
    }
}

/// SELF-11a: every driver torque up to the pedal map, at every speed, forward and in reverse.
#[test]
fn driver_torque_up_to_the_pedal_map_passes() {
    for gear in [Gear::Drive, Gear::Reverse] {
        for speed in [kmh(0), KMH_1_5, FAST] {
            for torque in 0..=100 {
                let mut bus = Bus::driving(kmh(0));
                bus.engage(known(gear));
                bus.speed(speed);
                bus.accelerator(Pedal250::new(
                    u8::try_from(u16::from(torque) * 5 / 2 + u16::from(torque % 2)).unwrap_or(250),
                ));
                // As a correct controller does: along the gradient.
                for step in (0..torque).step_by(2) {
                    bus.ask_torque(step);
                    bus.step();
                }
                bus.ask_torque(torque);
                assert_transparent(&bus.step());
            }
        }
    }
}

/// SELF-11a: automated torque up to its bound passes while the mode is granted.
#[test]
fn automated_torque_up_to_its_bound_passes() {
    let mut bus = Bus::automated(FAST);
    for torque in (0..=60).chain((0..60).rev()) {
        bus.ask_adas(torque);
        assert_transparent(&bus.step());
        bus.step();
    }
}

/// SELF-11b: every deceleration up to the comfort cap on a clear road, in every mode and priority.
#[test]
fn every_deceleration_up_to_the_cap_passes() {
    let mut bus = Bus::driving(FAST);
    for raw in 0..=ms2(350).raw() {
        bus.ask_brake(DecelMs2Q11::new(raw));
        let decision = bus.step();
        assert_passed(&decision, Channel::ServiceBrake);
        assert_eq!(decision.outputs.brake, braking(DecelMs2Q11::new(raw)));
    }
    for mode in BrakeMode::ALL {
        for priority in Priority::ALL {
            for electric in [0, 1, 100, 200] {
                bus.commands.brake = Command::Fresh(ServiceBrake {
                    total: ms2(300),
                    electric: ms2(electric),
                    mode: *mode,
                    priority: *priority,
                });
                assert_passed(&bus.step(), Channel::ServiceBrake);
            }
        }
    }
}

/// SELF-11b: automated comfort braking passes too.
#[test]
fn automated_comfort_braking_passes() {
    let mut bus = Bus::automated(FAST);
    for raw in (0..=ms2(350).raw()).step_by(37) {
        bus.ask_brake(DecelMs2Q11::new(raw));
        assert_passed(&bus.step(), Channel::ServiceBrake);
    }
}

/// SELF-11c: every gear that the selector shows, at standstill; the same direction again and neutral while rolling.
#[test]
fn every_gear_that_selector_and_speed_permit_passes() {
    let pairs = [
        (Gear::Neutral, GearRequest::Neutral),
        (Gear::Drive, GearRequest::Drive),
        (Gear::Reverse, GearRequest::Reverse),
        (Gear::Park, GearRequest::Park),
    ];
    for from in Gear::ALL {
        for (selector, request) in pairs {
            for speed in [kmh(0), STANDSTILL] {
                let mut bus = Bus::parked();
                bus.speed(speed);
                bus.inputs.gear = known(*from);
                bus.step();
                bus.inputs.selector = known(selector);
                bus.ask_gear(request);
                assert_transparent(&bus.step());
            }
        }
    }
    for (gear, request) in [(Gear::Drive, GearRequest::Drive), (Gear::Reverse, GearRequest::Reverse)] {
        let mut bus = Bus::driving(kmh(0));
        bus.inputs.gear = known(gear);
        bus.inputs.selector = known(gear);
        bus.step();
        bus.speed(kmh(10));
        for wanted in [GearRequest::Hold, request, GearRequest::Neutral] {
            bus.ask_gear(wanted);
            assert_transparent(&bus.step());
        }
        bus.inputs.gear = known(Gear::Neutral);
        bus.step();
        bus.ask_gear(request);
        assert_transparent(&bus.step());
    }
}

/// SELF-11d: parking brake none anywhere, apply below 1.5 km/h, release with the seat confirmed.
#[test]
fn the_parking_brake_passes_where_it_may() {
    for mode in EpbMode::ALL {
        for (speed, request) in [
            (kmh(0), EpbRequest::None),
            (FAST, EpbRequest::None),
            (kmh(0), EpbRequest::Apply),
            (bit_below(KMH_1_5), EpbRequest::Apply),
            (kmh(0), EpbRequest::Release),
        ] {
            let mut bus = Bus::driving(speed);
            bus.commands.epb = Command::Fresh(ParkingBrake { request, mode: *mode });
            assert_transparent(&bus.step());
        }
    }
    let mut bus = Bus::parked();
    bus.ask_epb(EpbRequest::Release);
    assert_transparent(&bus.step());
}

/// SELF-11e: in the automated mode every steering command inside its envelope passes: angle, rate, overlay, weight, bar.
#[test]
fn every_steering_command_inside_its_envelope_passes() {
    for speed in [kmh(0), kmh(10), kmh(30), FAST] {
        let mut bus = Bus::steering(kmh(10));
        bus.speed(speed);
        let row = usize::from(speed.raw().div_ceil(2_560).saturating_sub(1)).min(4);
        let rate = Config::DEFAULT.steering_rate.0[row];
        // As fast as the rate allows to the edge of the window, and back.
        let step = i16::try_from(rate.raw() / 100).unwrap_or(0);
        let edge = 400.min(Config::DEFAULT.steering_angle.0[row].raw());
        let mut target = 0;
        for goal in [edge, -edge, 0] {
            while target != goal {
                target = if goal > target { (target + step).min(goal) } else { (target - step).max(goal) };
                bus.commands.steering = Command::Fresh(Steering { angle: angle(target), rate, ..STEER });
                assert_transparent(&bus.step());
            }
        }
        // 1 % of 5 Nm per cycle, from 0 to one bound, to the other, and back to 0.
        for overlay in (0..=5_100).chain((-5_100..5_100).rev()).chain(-5_099..=0).step_by(50) {
            bus.commands.steering = Command::Fresh(Steering { overlay: hand_torque(overlay), rate, ..STEER });
            assert_passed(&bus.step(), Channel::Steering);
        }
        for bar in 0..=100 {
            bus.commands.steering = Command::Fresh(Steering { bar_limit: BarTorque50mNm::new(bar), ..STEER });
            assert_passed(&bus.step(), Channel::Steering);
        }
    }
}

/// SELF-11e: a weight that fades as it may passes; so does a command that asks for nothing, in manual too.
#[test]
fn a_fading_weight_passes() {
    let mut bus = Bus::automated(kmh(10));
    for weight in (1..=100).chain((0..100).rev()) {
        bus.commands.steering = Command::Fresh(Steering { weight: percent(weight), enable: weight > 0, ..STEER });
        assert_transparent(&bus.step());
    }
    let mut bus = Bus::driving(FAST);
    bus.commands.steering = Command::Fresh(Steering::NEUTRAL);
    assert_transparent(&bus.step());
}

/// SELF-11f: every target speed up to the limit in the automated mode.
#[test]
fn every_target_speed_up_to_the_limit_passes() {
    let mut bus = Bus::automated(FAST);
    for raw in 0..=kmh(60).raw() {
        bus.commands.target_speed = Command::Fresh(kmh_q8(raw));
        assert_passed(&bus.step(), Channel::TargetSpeed);
    }
}

/// SELF-11g: every retarder torque inside the cap while ABS is inactive.
#[test]
fn every_retarder_torque_inside_the_cap_passes() {
    let mut bus = Bus::driving(FAST);
    for torque in 0..=100 {
        for priority in Priority::ALL {
            bus.commands.retarder =
                Command::Fresh(Retarder { torque: percent(torque), mode: RetarderMode::Torque, priority: *priority });
            assert_passed(&bus.step(), Channel::Retarder);
        }
    }
    bus.ask_brake(ms2(195));
    assert_passed(&bus.step(), Channel::Retarder);
}

/// SELF-11h: hold always; K4 then K1 open at standstill without load; K1 then K4 close after the driver's keys.
#[test]
fn an_ordered_opening_and_closing_passes() {
    let mut bus = Bus::parked();
    bus.inputs.key = known(Key::Off);
    bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Hold);
    assert_transparent(&bus.step());
    bus.inputs.k4 = known(Contact::Open);
    bus.loads_stopped();
    bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Open);
    assert_transparent(&bus.step());
    bus.inputs.k1 = known(Contact::Open);
    bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Hold);
    bus.run_with(10_000, 10, assert_transparent);
    bus.inputs.key = known(Key::Start);
    bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Close);
    assert_transparent(&bus.step());
    bus.inputs.key = known(Key::On);
    bus.step();
    bus.inputs.k1 = known(Contact::Closed);
    bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Hold);
    assert_transparent(&bus.step());
    bus.inputs.k4 = known(Contact::Closed);
    bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Hold);
    assert_transparent(&bus.step());
}

/// SELF-11h, SELF-9b: the first start of the day: key-on, driver seated, contactors open, Start.
#[test]
fn the_first_start_of_the_day_passes() {
    let mut bus = Bus::boot(
        ResetCause::PowerOn,
        Some(Record::None),
        Inputs { k1: known(Contact::Open), k4: known(Contact::Open), ..healthy() },
    );
    bus.run_for(2_000);
    bus.inputs.key = known(Key::Start);
    bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Close);
    assert_transparent(&bus.step());
    bus.inputs.k1 = known(Contact::Closed);
    bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Hold);
    assert_transparent(&bus.step());
}

/// SELF-11i: auxiliaries on always, each off at standstill.
#[test]
fn auxiliaries_pass_where_they_may() {
    for code in 0..8_u8 {
        let request = Auxiliaries { air_pump: code & 1 == 0, power_steering: code & 2 == 0, dc_dc: code & 4 == 0 };
        for mut bus in [Bus::parked(), Bus::driving(STANDSTILL)] {
            bus.commands.auxiliaries = Command::Fresh(request);
            assert_transparent(&bus.step());
        }
    }
    let mut bus = Bus::driving(FAST);
    bus.commands.auxiliaries = Command::Fresh(Auxiliaries::NEUTRAL);
    assert_transparent(&bus.step());
}

/// SELF-11j: every combination of warnings and of body signals passes.
#[test]
fn every_warning_and_every_body_command_passes() {
    let mut bus = Bus::driving(FAST);
    for code in 0..512_u16 {
        let bit = |bit: u16| code & (1 << bit) != 0;
        bus.commands.warnings = Command::Fresh(Warnings {
            forward_collision: bit(0),
            pedestrian: bit(1),
            seat_leave: bit(2),
            hazard_flashers: bit(3),
            fault_lamp: bit(4),
            notice_lamp: bit(5),
            lane_departure: bit(6),
            speed_limit: bit(7),
            headway: bit(8),
        });
        assert_passed(&bus.step(), Channel::Warnings);
    }
    bus.commands.warnings = Command::Fresh(Warnings::NEUTRAL);
    for wipers in Wiper::ALL {
        for code in 0..64_u16 {
            let bit = |bit: u16| code & (1 << bit) != 0;
            bus.commands.body = Command::Fresh(Body {
                wipers: *wipers,
                brake_lamps: bit(0),
                indicator_left: bit(1),
                indicator_right: bit(2),
                low_beam: bit(3),
                high_beam: bit(4),
                horn: bit(5),
            });
            assert_transparent(&bus.step());
        }
    }
}

/// SELF-11k: a mode request with its evidence passes, goes on and ends as asked.
#[test]
fn a_mode_request_with_its_evidence_passes() {
    for ads in [AdsState::Ready, AdsState::Active] {
        let mut bus = Bus::driving(FAST);
        bus.inputs.ads = known(ads);
        bus.inputs.cruise_switch = known(true);
        bus.step();
        bus.inputs.driver_set = known(true);
        bus.commands.mode = Command::Fresh(DrivingMode::Automated);
        assert_transparent(&bus.step());
        bus.inputs.driver_set = known(false);
        bus.run_with(60_000, 10, assert_transparent);
        bus.commands.mode = Command::Fresh(DrivingMode::Manual);
        assert_transparent(&bus.step());
    }
}

/// SELF-2b, E2E-1g: frames that are held up to their time-out pass as fresh ones do.
#[test]
fn held_frames_pass_up_to_their_time_out() {
    let mut bus = Bus::automated(kmh(10));
    for age in (0..=500).step_by(5) {
        let held = |limit: u32| Millis::new(age.min(limit));
        bus.commands = Commands {
            drive: Command::Held(held(125), DriveTorque::NEUTRAL),
            target_speed: Command::Held(held(125), kmh(30)),
            brake: Command::Held(held(125), ServiceBrake::NEUTRAL),
            retarder: Command::Held(held(250), Retarder::NEUTRAL),
            gear: Command::Held(held(250), GearRequest::Hold),
            epb: Command::Held(held(500), ParkingBrake::NEUTRAL),
            steering: Command::Held(held(125), Steering::NEUTRAL),
            contactors: Command::Held(held(250), Contactors::NEUTRAL),
            auxiliaries: Command::Held(held(500), Auxiliaries::NEUTRAL),
            warnings: Command::Held(held(500), Warnings::NEUTRAL),
            body: Command::Held(held(500), Body::NEUTRAL),
            mode: Command::Held(held(500), DrivingMode::Automated),
        };
        assert_transparent(&bus.step());
    }
}

/// SELF-11b, MIT-6c: an ordinary stop behind a car, 1.0 m/s² to rest 2 m behind it, is no emergency.
#[test]
fn an_ordinary_stop_behind_a_car_is_no_emergency() {
    let mut bus = Bus::driving(kmh(50));
    bus.inputs.deceleration = known(ms2(100));
    bus.ask_brake(ms2(100));
    // v² = 2·1.0·(d − 2 m): the distance at each speed, in cm and cm/s.
    for closing in (0..=1_388_i32).rev() {
        let distance = 200 + closing * closing / 200;
        let object = object(u16::try_from(distance).unwrap_or(u16::MAX), i16::try_from(closing).unwrap_or(0));
        bus.ahead(object);
        bus.speed(kmh_q8(u16::try_from(closing * 256 * 36 / 1_000).unwrap_or(0)));
        let decision = bus.step();
        assert_eq!(decision.status.level, Level::None, "{closing} cm/s at {distance} cm");
        assert_passed(&decision, Channel::ServiceBrake);
    }
}
