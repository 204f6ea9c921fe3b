//! A damaged image (SELF-5): what is recovered, kept, and permitted.

use supervisor_core::{
    Body, Boot, Brake, Clock, Drive, Flow, GearState, HighVoltage, Latches, Mitigation, Monitors, Parking, SeatState,
    State, SteeringState, Words,
};

use crate::properties::recovery::{
    self_5_damage_keeps_obligations, self_5_damage_permits_nothing, self_5_flipped_bit_is_recovered,
};

/// SELF-5a: any single flipped bit of any image of four words is detected, and the words are recovered.
#[kani::proof]
#[kani::unwind(20)]
fn self_5_short_image_is_recovered() {
    let (words, index, bit): ([u32; 4], usize, u32) = (kani::any(), kani::any(), kani::any());
    kani::assume(index <= 8 && bit < 32);
    assert!(self_5_flipped_bit_is_recovered(words, index, bit));
    kani::cover!(index == 3 && bit == 31, "in the last word");
    kani::cover!(index == 7 && bit == 31, "in the last complement");
    kani::cover!(index == 8, "in the digest");
}

/// SELF-5b, SELF-5c: whatever state is recovered from a damaged image, and where none is: nothing is permitted, and what the
/// recovered one owes is kept. That any single flipped bit is recovered is `self_5_short_image_is_recovered`, of the same
/// code with fewer words, and the campaign of the tests, bit by bit.
#[kani::proof]
fn self_5_damage_permits_nothing_and_keeps_what_is_owed() {
    let old: State = kani::any();
    let after = State::after_damage(old);
    assert!(self_5_damage_permits_nothing(&after));
    assert!(self_5_damage_keeps_obligations(&old, &after));
    assert!(self_5_damage_permits_nothing(&State::corrupted()));
    kani::cover!(old.parking.by_leave && after.parking.by_leave, "parked by leave");
}

/// The words of a value, and the value again.
fn comes_back<T: Words + Copy + PartialEq + kani::Arbitrary>() {
    let value: T = kani::any();
    let (mut words, mut count) = ([0; 64], 0);
    value.write(&mut |word| {
        words[count] = word;
        count += 1;
    });
    assert!(count == T::COUNT);
    let mut next = 0;
    let back = T::read(&mut || {
        next += 1;
        Some(words[next - 1])
    });
    assert!(next == T::COUNT && back == Some(value));
    kani::cover!(back.is_some(), "it comes back");
}

/// SELF-5a: what is put to rest comes back, machine by machine: the state is their words one after the other.
#[kani::proof]
#[kani::unwind(20)]
fn self_5_machines_come_back() {
    comes_back::<Clock>();
    comes_back::<Boot>();
    comes_back::<SeatState>();
    comes_back::<Parking>();
    comes_back::<HighVoltage>();
    comes_back::<Mitigation>();
    comes_back::<GearState>();
    comes_back::<Body>();
    comes_back::<Latches>();
    comes_back::<Flow>();
}

/// SELF-5a: the same of the greater ones.
#[kani::proof]
#[kani::unwind(20)]
fn self_5_greater_machines_come_back() {
    comes_back::<Drive>();
    comes_back::<Brake>();
    comes_back::<SteeringState>();
    comes_back::<Monitors>();
}
