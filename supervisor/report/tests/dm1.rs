//! DM1 on the bus, read back by a receiver that was written from the standard's side (RPT-1c).

mod common;

use common::{Outcome, observe, quiet, settled, with};
use proptest::prelude::*;
use supervisor_core::{Decision, Faults, Millis};
use supervisor_report::{BodyFaults, BodyPart, Dm1Sender, FaultReport, J1939Frame, TROUBLE_CODES};

const SOURCE: u8 = 0x80;

/// A receiver of J1939-21 broadcasts. What it has to complain of is an error.
#[derive(Default)]
struct Receiver {
    /// Announced size, packets seen so far, their bytes, time of the last frame.
    open: Option<(usize, u8, Vec<u8>, u32)>,
}

impl Receiver {
    /// The content of a DM1 that this frame completes.
    fn take(&mut self, now: u32, frame: &J1939Frame) -> Result<Option<Vec<u8>>, String> {
        let [source, specific, format, priority] = frame.id.to_le_bytes();
        if source != SOURCE {
            return Err(format!("source {source:#x}"));
        }
        match (priority, format, specific, self.open.take()) {
            (0x18, 254, 202, None) => Ok(Some(frame.data.to_vec())),
            (0x1C, 236, 255, None) => {
                let [control, low, high, packets, reserved, pgn @ ..] = frame.data;
                let size = usize::from(low) + 256 * usize::from(high);
                let pgn = u32::from_le_bytes([pgn[0], pgn[1], pgn[2], 0]);
                if (control, reserved, pgn) != (32, 255, 65226) || !(9..=1785).contains(&size) {
                    return Err(format!("announces {:?}", frame.data));
                }
                if usize::from(packets) * 7 < size || usize::from(packets - 1) * 7 >= size {
                    return Err(format!("{packets} packets for {size} bytes"));
                }
                self.open = Some((size, 0, Vec::new(), now));
                Ok(None)
            }
            (0x1C, 235, 255, Some((size, seen, mut bytes, last))) => {
                if frame.data[0] != seen + 1 || !(50..=200).contains(&(now - last)) {
                    return Err(format!("packet {} after {seen}, {} ms later", frame.data[0], now - last));
                }
                bytes.extend_from_slice(&frame.data[1..]);
                if bytes.len() < size {
                    self.open = Some((size, seen + 1, bytes, now));
                    return Ok(None);
                }
                let padding = bytes.split_off(size);
                if padding.iter().any(|byte| *byte != 255) {
                    return Err(format!("padded with {padding:?}"));
                }
                Ok(Some(bytes))
            }
            _ => Err(format!("{:08X} does not belong here", frame.id)),
        }
    }
}

/// What a DM1 says: red stop lamp, amber warning lamp, and (SPN, FMI, count) of every code.
#[derive(Debug, PartialEq, Eq)]
struct Said {
    red: bool,
    amber: bool,
    codes: Vec<(u32, u8, u8)>,
}

fn read(content: &[u8]) -> Result<Said, String> {
    let [lamps, flash, codes @ ..] = content else { return Err("too short".to_owned()) };
    if flash != &0xFF || lamps & 0b1110_1011 != 0 {
        return Err(format!("lamps {lamps:08b}, flash {flash:08b}"));
    }
    // In a single frame two bytes are padding.
    let (codes, rest) = codes.as_chunks::<4>();
    if !(rest.is_empty() || rest == [0xFF, 0xFF]) {
        return Err(format!("{rest:?} left over"));
    }
    let mut said = Said { red: lamps & 0b1_0000 != 0, amber: lamps & 0b100 != 0, codes: Vec::new() };
    for [first, second, third, fourth] in codes {
        let spn = u32::from(*first) + 256 * u32::from(*second) + 65536 * u32::from(third / 32);
        if fourth & 0x80 != 0 {
            return Err("conversion method 1".to_owned());
        }
        said.codes.push((spn, third % 32, *fourth));
    }
    if said.codes == [(0, 0, 0)] {
        said.codes.clear();
    }
    Ok(said)
}

/// A bus with a report, a sender and a receiver, 10 ms a cycle.
struct Bus {
    now: u32,
    report: FaultReport,
    sender: Dm1Sender,
    receiver: Receiver,
    frames: Vec<(u32, J1939Frame)>,
    messages: Vec<(u32, Said)>,
}

impl Bus {
    fn new(begin: u32) -> Self {
        let (report, sender) = (settled(), Dm1Sender::new(SOURCE));
        Self { now: begin, report, sender, receiver: Receiver::default(), frames: Vec::new(), messages: Vec::new() }
    }

    fn run(&mut self, decision: &Decision, body: BodyFaults, millis: u32) -> Result<(), String> {
        for _ in 0..millis / 10 {
            self.report.observe(Millis::new(self.now), decision, body);
            if let Some(frame) = self.sender.poll(Millis::new(self.now), &self.report) {
                self.frames.push((self.now, frame));
                if let Some(content) = self.receiver.take(self.now, &frame)? {
                    self.messages.push((self.now, read(&content)?));
                }
            }
            self.now = self.now.wrapping_add(10);
        }
        Ok(())
    }
}

/// RPT-1c: one code, byte by byte by hand: SPN 84 (0x00054), FMI 2, count 1, amber lamp.
#[test]
fn one_code_is_one_frame_checked_by_hand() -> Outcome {
    let mut report = settled();
    observe(&mut report, &with(&quiet()?, Faults::SPEED_UNKNOWN), 0, 600);
    let frame = Dm1Sender::new(0x2A).poll(Millis::new(600), &report);
    // Amber lamp 01 in bits 4, 3; no flash; SPN low, middle; SPN high 000 and FMI 00010; CM 0 and count 1; padding.
    let data = [0x04, 0xFF, 0x54, 0x00, 0x02, 0x01, 0xFF, 0xFF];
    assert_eq!(frame, Some(J1939Frame { id: 0x18FE_CA2A, data }));
    Ok(())
}

/// RPT-1c: two codes, every frame by hand: announced, 2 packets, the last padded; an SPN of all 19 bits.
#[test]
fn two_codes_are_a_broadcast_checked_by_hand() -> Outcome {
    let mut report = settled();
    // STATE: SPN 516353 = 0x7E101, FMI 12, red. SPEED_UNKNOWN: SPN 84, FMI 2, amber.
    let decision = with(&quiet()?, Faults::SPEED_UNKNOWN.with(Faults::STATE));
    observe(&mut report, &decision, 0, 600);
    let mut sender = Dm1Sender::new(0x80);
    let frames: Vec<_> = (600..1600_u32)
        .step_by(10)
        .filter_map(|now| Some((now, sender.poll(Millis::new(now), &report)?)))
        .map(|(now, frame)| (now, frame.id, frame.data))
        .collect();
    let expected = [
        // Control 32, 10 bytes, 2 packets, reserved, PGN 0x00FECA.
        (600, 0x1CEC_FF80, [32, 10, 0, 2, 0xFF, 0xCA, 0xFE, 0x00]),
        // Both lamps; 0x7E101: 01, E1, then 111 above FMI 01100; count 1; first byte of SPN 84.
        (650, 0x1CEB_FF80, [1, 0x14, 0xFF, 0x01, 0xE1, 0xEC, 0x01, 0x54]),
        (700, 0x1CEB_FF80, [2, 0x00, 0x02, 0x01, 0xFF, 0xFF, 0xFF, 0xFF]),
    ];
    assert_eq!(frames, expected);
    Ok(())
}

/// RPT-1c: silent while nothing has been wrong; once a second while something is; one message that all is well again.
#[test]
fn sent_once_a_second_while_active_and_once_when_healed() -> Result<(), Box<dyn std::error::Error>> {
    let quiet = quiet()?;
    let mut bus = Bus::new(0);
    bus.run(&quiet, BodyFaults::NONE, 5000)?;
    assert!(bus.frames.is_empty());
    bus.run(&with(&quiet, Faults::EBS_RED), BodyFaults::NONE, 3000)?;
    bus.run(&quiet, BodyFaults::NONE, 60_000)?;
    // Active from 5.5 s to 18.0 s; the change is told with the next second.
    let times: Vec<u32> = bus.messages.iter().map(|(at, _)| *at).collect();
    assert_eq!(times, (5500..=18_500).step_by(1000).collect::<Vec<_>>());
    let last = bus.messages.last().map(|(_, said)| said);
    assert_eq!(last, Some(&Said { red: false, amber: false, codes: vec![] }));
    let hand = bus.frames.last().map(|(_, frame)| frame.data);
    assert_eq!(hand, Some([0x00, 0xFF, 0, 0, 0, 0, 0xFF, 0xFF]));
    let before = bus.messages.iter().rev().nth(1).map(|(_, said)| said);
    assert_eq!(before, Some(&Said { red: true, amber: false, codes: vec![(1439, 31, 1)] }));
    Ok(())
}

/// RPT-1c: faults that come one after the other do not make more than one message a second.
#[test]
fn changes_are_told_at_most_once_a_second() -> Result<(), Box<dyn std::error::Error>> {
    let quiet = quiet()?;
    let mut bus = Bus::new(0);
    let mut faults = Faults::NONE;
    for (fault, _) in Faults::NAMES {
        faults = faults.with(*fault);
        bus.run(&with(&quiet, faults), BodyFaults::NONE, 150)?;
    }
    bus.run(&with(&quiet, faults), BodyFaults::NONE, 5000)?;
    let announced = |frame: &J1939Frame| frame.id & 0x00FF_0000 != 0x00EB_0000;
    let begun: Vec<u32> = bus.frames.iter().filter(|(_, frame)| announced(frame)).map(|(at, _)| *at).collect();
    assert!(begun.len() >= 6 && begun.windows(2).all(|pair| pair[1] - pair[0] >= 1000), "{begun:?}");
    assert_eq!(bus.messages.last().map(|(_, said)| said.codes.len()), Some(Faults::NAMES.len()));
    Ok(())
}

/// RPT-1c: what changes while a session runs belongs to the next one: no message mixes two states.
#[test]
fn a_session_is_of_one_moment() -> Result<(), Box<dyn std::error::Error>> {
    let quiet = quiet()?;
    let mut bus = Bus::new(0);
    let first = Faults::CLOCK.with(Faults::STATE).with(Faults::EBS_RED);
    bus.run(&with(&quiet, first), BodyFaults::NONE, 60)?;
    // The session of the first three runs from 500 to 600 ms; the others ripen at 560 ms.
    bus.run(&with(&quiet, first.with(Faults::HINTS)), BodyFaults::NONE, 3000)?;
    let counts: Vec<usize> = bus.messages.iter().map(|(_, said)| said.codes.len()).collect();
    assert_eq!(counts, [3, 5, 5]);
    assert_eq!(bus.messages.first().map(|(at, _)| *at), Some(600));
    Ok(())
}

/// RPT-1c: the sender keeps its distance however wildly the clock leaps, and several polls at one time send one frame.
#[test]
fn no_two_frames_are_close_whatever_the_clock_does() -> Outcome {
    let mut report = settled();
    observe(&mut report, &with(&quiet()?, Faults::CLOCK.with(Faults::STATE)), 0, 600);
    let mut sender = Dm1Sender::new(SOURCE);
    assert!(sender.poll(Millis::new(7), &report).is_some());
    assert!((0..100).all(|_| sender.poll(Millis::new(7), &report).is_none()));
    // Each leap counts 10 ms: the fifth may send.
    let sent: Vec<bool> = [1_000_000, 5, u32::MAX, 900, 4_000_000_000]
        .map(|now| sender.poll(Millis::new(now), &report).is_some())
        .to_vec();
    assert_eq!(sent, [false, false, false, false, true]);
    Ok(())
}

/// RSP-1h: what does not follow stands in DM1 beside the core's faults.
#[test]
fn body_faults_are_in_dm1() -> Result<(), Box<dyn std::error::Error>> {
    let mut bus = Bus::new(0);
    let dark = BodyFaults::NONE.when(true, BodyPart::BrakeLamps).when(true, BodyPart::Wipers);
    bus.run(&with(&quiet()?, Faults::EBS_RED), dark, 3000)?;
    let codes = bus.messages.last().map(|(_, said)| said.codes.clone());
    assert_eq!(codes, Some(vec![(1439, 31, 1), (516_496, 7, 1), (516_497, 7, 1)]));
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// RPT-1c: for any set of faults and any start of the clock, the receiver finds every code exactly once, no other,
    /// and the lamps that belong to them.
    #[test]
    fn every_active_code_is_received_exactly_once(bits: u32, body: u8, begin: u32) {
        let quiet = quiet().map_err(|error| TestCaseError::fail(error.to_string()))?;
        let fault = |faults: Faults, (index, fault): (usize, &Faults)| faults.when(bits >> index & 1 == 1, *fault);
        let faults = Faults::NAMES.iter().map(|(fault, _)| fault).enumerate().fold(Faults::NONE, fault);
        let part = |faults: BodyFaults, part: &BodyPart| faults.when(body >> part.code() & 1 == 1, *part);
        let body = BodyPart::ALL.iter().fold(BodyFaults::NONE, part);
        let mut bus = Bus::new(begin);
        bus.run(&with(&quiet, faults), body, 6000).map_err(TestCaseError::fail)?;

        let active = |row: &&supervisor_report::TroubleCode| match row.source {
            supervisor_report::Source::Core(fault) => faults.contains(fault),
            supervisor_report::Source::Body(part) => body.contains(part),
        };
        let rows: Vec<_> = TROUBLE_CODES.iter().filter(active).collect();
        let mut expected: Vec<_> = rows.iter().map(|row| (row.spn.raw(), row.fmi.code(), 1)).collect();
        expected.sort_unstable();
        match bus.messages.last() {
            None => prop_assert!(expected.is_empty()),
            Some((_, said)) => {
                let mut codes = said.codes.clone();
                codes.sort_unstable();
                prop_assert_eq!(codes, expected);
                let lit = |lamp| rows.iter().any(|row| row.lamp == lamp);
                prop_assert_eq!(said.red, lit(supervisor_report::Lamp::RedStop));
                prop_assert_eq!(said.amber, lit(supervisor_report::Lamp::AmberWarning));
            }
        }
    }
}
