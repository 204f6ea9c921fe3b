#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| supervisor_fuzz::attack::wire_bytes(bytes, &mut Default::default()));
