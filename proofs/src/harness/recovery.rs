//! A damaged image (SELF-5): what is recovered, kept, and permitted.

use supervisor_core::{STATE_WORDS, State, StateImage};

use crate::properties::recovery::{
    self_5_damage_keeps_obligations, self_5_damage_permits_nothing, self_5_flipped_bit_is_recovered,
};

/// SELF-5a: any single flipped bit of any image of four words is detected, and the words are recovered.
#[kani::proof]
#[kani::unwind(5)]
fn self_5_short_image_is_recovered() {
    let (words, index, bit): ([u32; 4], usize, u32) = (kani::any(), kani::any(), kani::any());
    kani::assume(index <= 8 && bit < 32);
    assert!(self_5_flipped_bit_is_recovered(words, index, bit));
    kani::cover!(index == 3 && bit == 31, "in the last word");
    kani::cover!(index == 7 && bit == 31, "in the last complement");
    kani::cover!(index == 8, "in the digest");
}

/// SELF-5b, SELF-5c: whatever image is damaged, in any way: nothing is permitted.
#[kani::proof]
#[kani::unwind(140)]
fn self_5_damage_permits_nothing_ever() {
    let image: StateImage = kani::any();
    assert!(self_5_damage_permits_nothing(&State::damaged(&image)));
    kani::cover!(State::damaged(&image).seat.leave, "leave goes on");
}

/// SELF-5c: any state, any single flipped bit: its obligations are kept.
#[kani::proof]
#[kani::unwind(140)]
fn self_5_damage_keeps_what_is_owed() {
    let (old, index, bit): (State, usize, u32) = (kani::any(), kani::any(), kani::any());
    kani::assume(index < 2 * STATE_WORDS && bit < 32);
    let damaged = State::damaged(&StateImage::encode(&old).with_flipped_bit(index, bit));
    assert!(self_5_damage_keeps_obligations(&old, &damaged));
    kani::cover!(old.parking.by_leave && index == 0, "parked by leave");
}
