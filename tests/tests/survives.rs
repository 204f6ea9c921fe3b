//! The checks of what is retained are in the machine code, not only in the source (SELF-5a, SELF-4e).
//!
//! A compiler may drop a check that it can prove needless: "this enum is never out of range" is one. So the values go
//! through `black_box`, every bit is flipped, and what the *optimised* function answers is observed. Then `objdump`
//! reads that function: the comparisons stand in it as instructions.
//!
//! What this does not show: another compiler, another target, another place where the same function is inlined. The
//! release campaign (`bitflip.rs`) observes the whole step of the same build.

mod common;

use common::*;
use std::collections::BTreeSet;
use std::hint::black_box;
use std::process::Command;

/// The decoding of the state, on its own.
#[inline(never)]
fn state_at_rest(image: &StateImage) -> bool {
    black_box(image).decode::<State>().is_some()
}

/// The check of the configuration, on its own.
#[inline(never)]
fn config_at_rest(sealed: &Sealed) -> bool {
    black_box(sealed).intact().is_some()
}

fn images() -> Vec<StateImage> {
    [Bus::driving(kmh(50)), Bus::leave(kmh(50)), Bus::opening_k1(), Bus::steering(kmh(10))]
        .iter()
        .map(|bus| {
            let seen = std::cell::Cell::new(None);
            let _same = bus.with_image(|image| {
                seen.set(Some(image));
                image
            });
            seen.get().unwrap_or_else(|| StateImage::encode(&State::INITIAL))
        })
        .collect()
}

/// SELF-5a, SELF-4e: the function, as compiled, sees every single flipped bit, and passes what is intact.
#[test]
fn every_flipped_bit_is_seen_by_the_compiled_check() {
    for image in images() {
        assert!(state_at_rest(&image));
        for index in 0..Bus::image_words() {
            for bit in 0..32 {
                assert!(!state_at_rest(&image.with_flipped_bit(index, bit)), "word {index} bit {bit}");
            }
        }
    }
    let Ok(sealed) = Sealed::from_default() else { unreachable!("the table is valid") };
    assert!(config_at_rest(&sealed));
    let values = (0..<Config as Words>::COUNT).flat_map(|index| (0..32).map(move |bit| (index, bit)));
    let mut seen = 0;
    for flipped in values.filter_map(|(index, bit)| sealed.with_flipped_bit(index, bit)) {
        assert!(!config_at_rest(&flipped), "{flipped:?}");
        seen += 1;
    }
    assert!(seen > <Config as Words>::COUNT * 8);
}

/// The mnemonics of a function of this program, and of those that it calls in the supervisor's crates.
fn mnemonics(listing: &str, name: &str, depth: u8) -> Vec<String> {
    let (mut inside, mut all, mut called) = (false, Vec::new(), BTreeSet::new());
    for line in listing.lines() {
        if let Some(symbol) = line.strip_suffix(">:") {
            inside = symbol.split_once('<').is_some_and(|(_, symbol)| symbol.contains(name));
        } else if let Some((_, code)) = line.split_once('\t').filter(|_| inside) {
            all.extend(code.split_whitespace().next().map(str::to_owned));
            if let Some((_, symbol)) = code.split_once('<').filter(|(_, symbol)| symbol.contains("supervisor")) {
                called.insert(symbol.trim_end_matches('>').to_owned());
            }
        }
    }
    if depth > 0 {
        for symbol in called.iter().filter(|symbol| !symbol.contains('+')) {
            all.extend(mnemonics(listing, symbol, depth - 1));
        }
    }
    all
}

/// How many of them are among these.
fn among(mnemonics: &[String], names: &[&str]) -> usize {
    mnemonics.iter().filter(|found| names.iter().any(|name| found.starts_with(name))).count()
}

/// SELF-5a, SELF-4e: complement, comparison and branch stand in the optimised code of both checks.
///
/// In release builds on `x86_64` with `objdump`; elsewhere it says NOT RUN and shows nothing.
#[test]
fn the_comparisons_stand_in_the_optimised_code() {
    let Ok(program) = std::env::current_exe() else { unreachable!("a running test has a file") };
    let listing = Command::new("objdump").args(["-d", "--no-show-raw-insn", "-C"]).arg(program).output();
    let (true, true, Ok(listing)) = (cfg!(target_arch = "x86_64"), cfg!(not(debug_assertions)), listing) else {
        println!("NOT RUN: no optimised x86-64 code, or no objdump: the comparisons were not looked for");
        return;
    };
    let listing = String::from_utf8_lossy(&listing.stdout).into_owned();
    // The function must be used, or it is not there.
    assert!(images().iter().all(state_at_rest));

    let state = mnemonics(&listing, "survives::state_at_rest", 2);
    let complement =
        among(&state, &["not", "xor", "pxor", "pandn", "pcmpeq", "vpxor", "vpandn", "vpcmpeq", "vpternlog"]);
    let compare = among(&state, &["cmp", "test", "pcmpeq", "pmovmsk", "ptest", "vpcmp", "vptest", "vpmovmsk"]);
    let branch = among(&state, &["j", "set", "cmov"]);
    println!("state: {} instructions; {complement} complement, {compare} compare, {branch} branch", state.len());
    assert!(complement > 0 && compare > 0 && branch > 0, "the check of word and complement is gone");
    assert!(state.len() > STATE_WORDS, "the decoding is gone");

    let config = mnemonics(&listing, "survives::config_at_rest", 2);
    let (rotate, xor) = (among(&config, &["rol", "ror", "shld", "rorx"]), among(&config, &["xor"]));
    println!("configuration: {} instructions; {rotate} rotate, {xor} exclusive or", config.len());
    assert!(rotate > 0 && xor > 0, "the digest of the configuration is gone");
}
