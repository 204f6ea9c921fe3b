//! Campaign: one flipped bit at rest, at every bit of the retained state, in every mode (SELF-5a, SELF-5b).
//!
//! Each mode is stepped once as it is, which is the reference, and once for every bit with that bit flipped. The flip
//! is *detected* if that cycle is the safe state with the fault `STATE`, *harmless* if no channel is less safe than
//! the reference (`safer.rs` says what that means), and else *undetected*. Exhaustive: no bit and no mode is sampled.

mod common;
#[path = "bitflip/modes.rs"]
mod modes;
#[path = "bitflip/safer.rs"]
mod safer;

use common::*;
use modes::modes;
use safer::{Cycle, less_safe};
use std::cell::Cell;
use std::collections::BTreeSet;

/// What the main controller asks for in the cycle of the flip.
const CONTROLLERS: [(&str, Edit); 2] = [("as it was", |_| {}), ("greedy", greedy)];

/// Asks for everything that a lost latch would let through.
fn greedy(bus: &mut Bus) {
    bus.ask_torque(60);
    bus.ask_gear(GearRequest::Drive);
    bus.ask_epb(EpbRequest::Release);
    bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Open);
    bus.commands.target_speed = Command::Fresh(kmh(60));
    bus.commands.mode = Command::Fresh(DrivingMode::Automated);
    bus.commands.auxiliaries = Command::Fresh(Auxiliaries { air_pump: false, power_steering: false, dc_dc: false });
}

/// What is less than before and meant so: automatic steering fades out in the safe state (SELF-5g). Every obligation is
/// kept from the whole copy of the image (SELF-5c).
const FADES: [Channel; 1] = [Channel::Steering];

/// What came of the flips of one mode.
#[derive(Clone, Debug, Default)]
struct Tally {
    flips: u32,
    detected: u32,
    harmless: u32,
    undetected: u32,
    /// Detected, and yet a channel is less safe in that cycle: what the lost state held.
    lost: BTreeSet<u8>,
}

/// The last outputs, and the retained image, of a bus.
fn outputs_before(bus: &Bus) -> Outputs {
    bus.last.map_or(Outputs::NEUTRAL, |decision| decision.outputs)
}

/// Flips, one at a time, what `changes` names, and judges the next cycle.
fn campaign(bus: &Bus, changes: impl Iterator<Item = (String, Bus)>) -> Tally {
    let before = outputs_before(bus);
    let reference = bus.clone().step_unjudged(CYCLE);
    assert!(!reference.status.faults.contains(Faults::STATE), "the reference is intact");
    let cycle = Cycle { inputs: &bus.inputs, before: &before };
    let mut tally = Tally::default();
    for (name, mut flipped) in changes {
        let decision = flipped.step_unjudged(CYCLE);
        let worse = less_safe(cycle, &reference, &decision);
        tally.flips += 1;
        if decision.status.safe_state && decision.status.faults.contains(Faults::STATE) {
            tally.detected += 1;
            assert_eq!(decision.outputs.drive.torque, Percent::ZERO, "{name}: SELF-5c");
            assert!(flipped.step_unjudged(CYCLE).status.safe_state, "{name}: SELF-5b, latched");
            tally.lost.extend(worse.iter().map(|channel| channel.code()));
        } else if worse.is_empty() {
            tally.harmless += 1;
        } else {
            tally.undetected += 1;
        }
    }
    tally
}

/// Every bit of the image, words, complements and digest, each as a bus of its own.
fn every_bit(bus: &Bus) -> impl Iterator<Item = (String, Bus)> + '_ {
    (0..=Bus::image_words()).flat_map(move |index| {
        (0..32).map(move |bit| {
            (format!("word {index} bit {bit}"), bus.with_image(|image| image.with_flipped_bit(index, bit)))
        })
    })
}

/// SELF-5a, SELF-5b: every single flipped bit, in every mode, is detected in the next cycle, and the fault is latched.
#[test]
fn every_flipped_bit_in_every_mode_is_detected_or_harmless() {
    let (mut total, mut count) = (Tally::default(), 0);
    for (name, mode) in modes() {
        for (controller, edit) in CONTROLLERS {
            let mut bus = mode.clone();
            edit(&mut bus);
            let tally = campaign(&bus, every_bit(&bus));
            let lost: Vec<_> = tally.lost.iter().filter_map(|code| Channel::from_code(*code)).collect();
            println!("{name:<32} {controller:<10} {} of {} detected; not kept: {lost:?}", tally.detected, tally.flips);
            count += 1;
            total.flips += tally.flips;
            total.detected += tally.detected;
            total.harmless += tally.harmless;
            total.undetected += tally.undetected;
            total.lost.extend(tally.lost);
        }
    }
    println!(
        "{count} modes × {} bits = {} flips: {} detected, {} harmless, {} undetected",
        (Bus::image_words() + 1) * 32,
        total.flips,
        total.detected,
        total.harmless,
        total.undetected
    );
    assert_eq!(total.undetected, 0);
    let kept = |code: &u8| !FADES.iter().any(|channel| channel.code() == *code);
    assert_eq!(total.lost.iter().filter(|code| kept(code)).count(), 0, "{:?}", total.lost);
    assert_eq!(total.detected + total.harmless, total.flips);
    // Every bit of words and complements is watched; a flipped bit of the digest touches no value.
    assert_eq!(total.harmless, count * 32, "nothing but the digest is outside the check");
}

/// Two flips that hide each other: the same bit of a word and of its complement. Beyond the claim, which is of one bit.
fn every_pair(bus: &Bus) -> impl Iterator<Item = (String, Bus)> + '_ {
    (0..STATE_WORDS).flat_map(move |index| {
        (0..32).map(move |bit| {
            let change =
                move |image: StateImage| image.with_flipped_bit(index, bit).with_flipped_bit(index + STATE_WORDS, bit);
            (format!("pair of word {index} bit {bit}"), bus.with_image(change))
        })
    })
}

/// SELF-5a: the campaign can fail: flips that the image cannot see are found to be less safe in every obligation.
#[test]
fn the_campaign_finds_what_the_image_cannot_see() {
    let mut undetected = 0;
    for (name, mut bus) in modes() {
        greedy(&mut bus);
        let tally = campaign(&bus, every_pair(&bus));
        assert_eq!(tally.detected + tally.harmless + tally.undetected, tally.flips);
        let obliged = ["leave, rolling", "level 1", "level 3, object gone", "parked by leave, driver back"];
        assert!(tally.undetected > 0 || !obliged.contains(&name), "{name}: {tally:?}");
        undetected += tally.undetected;
    }
    println!("of two flips that hide each other, {undetected} are less safe and not detected");
}

/// Makes outputs worse.
type Worsen = fn(&mut Outputs);

/// SELF-5a: *less safe* is seen on every channel, and equal outputs are not.
#[test]
fn less_safe_is_seen_on_every_channel() {
    let mut bus = Bus::driving(kmh(50));
    bus.ask_brake(ms2(100));
    let reference = bus.step();
    let cycle = Cycle { inputs: &bus.inputs, before: &reference.outputs };
    assert_eq!(less_safe(cycle, &reference, &reference), vec![]);
    let worse: [(Channel, Worsen); 15] = [
        (Channel::DriveTorque, |out| out.drive.torque = percent(1)),
        (Channel::TargetSpeed, |out| out.target_speed = kmh_q8(1)),
        (Channel::ServiceBrake, |out| out.brake.total = ms2(99)),
        (Channel::ServiceBrake, |out| out.brake.mode = BrakeMode::Off),
        (Channel::ServiceBrake, |out| out.brake.total = ms2(601)),
        (Channel::Gear, |out| out.gear = GearRequest::Reverse),
        (Channel::ParkingBrake, |out| out.epb.request = EpbRequest::Release),
        (Channel::ParkingBrake, |out| out.epb.request = EpbRequest::Apply),
        (Channel::Steering, |out| out.steering.weight = percent(1)),
        (Channel::Contactors, |out| out.contactors.k1 = ContactorRequest::Open),
        (Channel::Contactors, |out| out.contactors.k4 = ContactorRequest::Close),
        (Channel::Auxiliaries, |out| out.auxiliaries.power_steering = false),
        (Channel::Body, |out| out.body.brake_lamps = false),
        (Channel::Mode, |out| out.mode = DrivingMode::Automated),
        (Channel::Warnings, |_| {}),
    ];
    for (channel, worsen) in worse {
        let mut run = reference;
        worsen(&mut run.outputs);
        let mut reference = reference;
        if channel == Channel::Warnings {
            reference.outputs.warnings.seat_leave = true;
        }
        assert!(less_safe(cycle, &reference, &run).contains(&channel), "{channel:?}");
    }
    let (mut without, mut with) = (reference, reference);
    with.outputs.retarder.torque = percent(10);
    without.outputs.retarder.torque = percent(9);
    assert!(less_safe(cycle, &with, &without).contains(&Channel::Retarder));
    assert!(!less_safe(cycle, &without, &with).contains(&Channel::Retarder), "more braking is not less safe");
}

/// The retained image of a bus.
fn image_of(bus: &Bus) -> StateImage {
    let seen = Cell::new(None);
    let _same = bus.with_image(|image| {
        seen.set(Some(image));
        image
    });
    match seen.get() {
        Some(image) => image,
        None => unreachable!("the bench hands its image out"),
    }
}

/// SELF-4e, SELF-5b: every flipped bit of every configured value, and of the digest, in every mode, is the safe state
/// in the next cycle, latched over the return of the right configuration.
#[test]
fn every_flipped_bit_of_the_configuration_is_detected_in_every_mode() {
    let Ok(sealed) = Sealed::from_default() else { unreachable!("the table is valid") };
    let values = (0..<Config as Words>::COUNT)
        .flat_map(|index| (0..32).filter_map(move |bit| sealed.with_flipped_bit(index, bit)));
    let changed: Vec<Sealed> = values.chain((0..32).map(|bit| sealed.with_flipped_digest(bit))).collect();
    let (mut flips, all) = (0, modes());
    for (name, mut bus) in all.iter().cloned() {
        greedy(&mut bus);
        let threat = perceive(&bus.scene, &Config::DEFAULT);
        for changed in &changed {
            let mut image = image_of(&bus);
            let mut next = |sealed: &Sealed, after: u32| {
                let now = Millis::new(bus.now.wrapping_add(after));
                step(&mut image, sealed, Flow::PERCEIVED, now, &bus.inputs, &threat, &bus.commands)
            };
            let decision = next(changed, 10);
            let seen = decision.status.safe_state && decision.status.faults.contains(Faults::CONFIGURATION);
            assert!(seen, "{name}: {changed:?}");
            assert_eq!(decision.outputs.drive.torque, Percent::ZERO, "{name}");
            assert!(next(&sealed, 20).status.safe_state, "{name}: latched");
            flips += 1;
        }
    }
    println!("{} modes × {} bits of the configuration = {flips} flips: all detected", all.len(), changed.len());
    assert!(changed.len() > <Config as Words>::COUNT * 8, "every value has at least 8 bits at rest");
}
