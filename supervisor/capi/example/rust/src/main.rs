//! The supervisor on a Cortex-M4F: start-up test, then every golden vector back to back with the host.
//!
//! What a firmware in a bus does is in [`Node::cycle`]: take the frames, step every 10 ms, send what is answered.
#![no_std]
#![no_main]

mod file;

use core::ffi::CStr;
use core::panic::PanicInfo;

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use supervisor::wire::{Frame, Receiver, Sender};
use supervisor::{ConfigError, Decision, EpbRequest, Millis, Record, ResetCause, SEALED_BYTES, Sealed, Supervisor};

use file::File;

/// The very file with which the host makes the digests.
#[path = "../../../../../tests/src/vectors/digest.rs"]
mod digest;

/// The frames that go out in a cycle: 16 at most.
type Sent = heapless::Vec<Frame, 16>;

/// Everything that a node keeps.
struct Node {
    supervisor: Supervisor,
    receiver: Receiver,
    sender: Sender,
}

impl Node {
    fn new(sealed: Sealed, cause: ResetCause, record: Option<Record>) -> Self {
        let supervisor = Supervisor::new(sealed, cause, record);
        let receiver = Receiver::new(supervisor.config());
        Self { supervisor, receiver, sender: Sender::new() }
    }

    /// One cycle, after [`Receiver::accept`] of everything that came: what was decided, and the frames that go out.
    fn cycle(&mut self, now: Millis) -> Result<(Decision, Sent), Failure> {
        let sample = self.receiver.sample(now);
        let decision = self.supervisor.step(now, sample.inputs, sample.scene, sample.commands);
        let (mut sent, mut lost) = (Sent::new(), false);
        let mut send = |frame| lost |= sent.push(frame).is_err();
        self.sender.encode_outputs(now, &decision.outputs, &mut send);
        self.sender.encode_status(now, &decision.status, &mut send);
        must(!lost, "more frames than there is room for")?;
        Ok((decision, sent))
    }
}

/// Why it ends badly.
type Failure = &'static str;

fn must(holds: bool, what: Failure) -> Result<(), Failure> {
    if holds { Ok(()) } else { Err(what) }
}

/// At every start: each fault is injected, and the refusal is seen. A supervisor that lets one pass may not drive.
fn start_up_test(sealed: &[u8; SEALED_BYTES]) -> Result<Sealed, Failure> {
    let mut flipped = *sealed;
    if let Some(byte) = flipped.get_mut(100) {
        *byte ^= 0x10;
    }
    must(matches!(Sealed::from_sealed(&flipped), Err(ConfigError::Crc)), "a configuration with a flipped bit")?;
    must(matches!(Sealed::from_sealed(&flipped[..99]), Err(ConfigError::Length(99))), "a configuration cut short")?;
    let sealed = Sealed::from_sealed(sealed).map_err(|_| "the configuration")?;
    let mut node = Node::new(sealed, ResetCause::PowerOn, Some(Record::None));
    must(node.receiver.accept(Millis::new(5), &Frame::new(0x0CFF_1021, 0)).is_err(), "a frame without its checksum")?;
    let (decision, _) = node.cycle(Millis::new(10))?;
    let outputs = &decision.outputs;
    must(
        outputs.drive.torque.raw() == 0 && outputs.epb.request == EpbRequest::None,
        "nothing is known and something is asked for",
    )?;
    Ok(sealed)
}

fn word(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |word, byte| word << 8 | u32::from(*byte))
}

/// One vector: cycles that agree with the host's digest, and cycles.
fn back_to_back(name: &CStr, sealed: Sealed) -> Result<(u32, u32), Failure> {
    const CUT: Failure = "a vector was broken off";
    let mut file = File::open(name).ok_or("a vector cannot be opened")?;
    let head: [u8; 16] = file.read().ok_or(CUT)?;
    must(head.starts_with(b"EBSV\x01\0\0\0"), "this is no vector")?;
    let cycles = word(&head[8..12]);
    let cause = ResetCause::from_code(head[12]).ok_or("no such reset cause")?;
    let mut node = Node::new(sealed, cause, Record::from_code(head[13]));
    let mut identical = 0;
    for _ in 0..cycles {
        let read: [u8; 16] = file.read().ok_or(CUT)?;
        for _ in 0..word(&read[4..8]) {
            let came: [u8; 20] = file.read().ok_or(CUT)?;
            let mut data = [0; 8];
            data.copy_from_slice(&came[8..16]);
            let frame = Frame { id: word(&came[4..8]), length: came[16], data };
            // A refusal shows in what is decided.
            let _ = node.receiver.accept(Millis::new(word(&came[..4])), &frame);
        }
        let (decision, sent) = node.cycle(Millis::new(word(&read[..4])))?;
        let expected = u64::from(word(&read[8..12])) | u64::from(word(&read[12..])) << 32;
        identical += u32::from(digest::digest(&decision, &sent) == expected);
    }
    file.close();
    Ok((identical, cycles))
}

fn run() -> Result<(), Failure> {
    let mut file = File::open(c"default.bin").ok_or("default.bin cannot be opened")?;
    let sealed = start_up_test(&file.read().ok_or("default.bin is too short")?)?;
    file.close();
    hprintln!("start-up test: every fault was refused");
    // The names of the vectors, one a line.
    let mut names = File::open(c"vectors.txt").ok_or("vectors.txt cannot be opened")?;
    let (mut identical, mut cycles) = (0, 0);
    let (mut name, mut length) = ([0_u8; 64], 0);
    while let Some([letter]) = names.read() {
        if letter != b'\n' {
            *name.get_mut(length).ok_or("the name of a vector is too long")? = letter;
            length += 1;
            continue;
        }
        *name.get_mut(length).ok_or("the name of a vector is too long")? = 0;
        length = 0;
        let path = CStr::from_bytes_until_nul(&name).map_err(|_| "the name of a vector")?;
        let (same, all) = back_to_back(path, sealed)?;
        hprintln!("{}: decisions identical: {} of {}", path.to_str().unwrap_or("?"), same, all);
        identical += same;
        cycles += all;
    }
    hprintln!("decisions identical: {} of {}", identical, cycles);
    must(cycles > 0 && identical == cycles, "a decision differs from the host's")
}

#[entry]
fn main() -> ! {
    if let Err(what) = run() {
        hprintln!("FAILED: {}", what);
        debug::exit(debug::EXIT_FAILURE);
    }
    debug::exit(debug::EXIT_SUCCESS);
    loop {}
}

/// The supervisor has no panic in it; this program around it may have.
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    debug::exit(debug::EXIT_FAILURE);
    loop {}
}
