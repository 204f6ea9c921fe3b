#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| supervisor_fuzz::host::dbc_map(bytes));
