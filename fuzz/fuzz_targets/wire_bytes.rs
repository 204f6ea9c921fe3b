#![no_main]
use supervisor_fuzz::{attack, tally};
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let mut reached = attack::Reached::only_cycles();
    attack::wire_bytes(bytes, &mut reached);
    tally::add(reached.cycles);
});
