#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| supervisor_fuzz::host::candump_log(bytes));
