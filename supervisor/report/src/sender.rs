//! DM1 on the bus: one frame, or a broadcast of several (J1939-21 transport protocol, BAM).

use supervisor_core::Millis;

use crate::clock::Clock;
use crate::dm1::{Dm1, PAD};
use crate::fault::FaultReport;

/// From one DM1 to the next: once a second while a code is active, and on a change (J1939-73).
pub const PERIOD: Millis = Millis::new(1000);
/// Between two frames of one broadcast: J1939-21 wants 50 to 200 ms.
pub const SPACING: Millis = Millis::new(50);

/// A CAN frame with a 29-bit identifier and eight data bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct J1939Frame {
    /// Identifier, 29 bits: priority, PGN, source address.
    pub id: u32,
    /// Data.
    pub data: [u8; 8],
}

/// DM1: priority 6, PGN 65226.
const DM1_ID: u32 = 0x18FE_CA00;
/// Connection management to all: priority 7, PGN 60416, destination 255.
const CONNECTION_ID: u32 = 0x1CEC_FF00;
/// Data transfer to all: priority 7, PGN 60160, destination 255.
const TRANSFER_ID: u32 = 0x1CEB_FF00;
/// Control byte of a broadcast announce message.
const BAM: u8 = 32;
/// Data bytes of one packet.
const PACKET: usize = 7;
/// What fits into one frame without a session.
const FRAME: usize = 8;

/// Sends DM1: [`poll`](Self::poll) it once a cycle.
///
/// Nothing is sent while no code has been active; when the last one has healed, one message says so. What a session
/// sends is fixed when it begins, so all its packets belong together. A session of many codes lasts longer than
/// [`PERIOD`]; the next one waits for its end.
#[derive(Clone, Debug)]
pub struct Dm1Sender {
    source: u8,
    clock: Clock,
    /// Since the last message began, saturating.
    since_message: Millis,
    /// Since the last frame, saturating.
    since_frame: Millis,
    content: Dm1,
    /// Packets that the session still has to send, and the number of the last one.
    session: Session,
}

/// A broadcast that runs: packets `next` to `last`, counted from 1; none when `next` is greater.
#[derive(Clone, Copy, Debug)]
struct Session {
    next: u8,
    last: u8,
}

impl Dm1Sender {
    /// Sends from this source address.
    #[must_use]
    pub fn new(source: u8) -> Self {
        Self {
            source,
            clock: Clock::NEW,
            since_message: PERIOD,
            since_frame: PERIOD,
            content: Dm1::clear(),
            session: Session { next: 1, last: 0 },
        }
    }

    /// The frame to send now, if any. Every step of the clock beyond 50 ms counts as 10 ms.
    pub fn poll(&mut self, now: Millis, report: &FaultReport) -> Option<J1939Frame> {
        let elapsed = self.clock.elapsed(now).raw();
        self.since_message = Millis::new(self.since_message.raw().saturating_add(elapsed));
        self.since_frame = Millis::new(self.since_frame.raw().saturating_add(elapsed));
        if self.since_frame < SPACING {
            return None;
        }
        let frame = if self.session.next <= self.session.last { self.packet() } else { self.begin(report)? };
        self.since_frame = Millis::ZERO;
        Some(frame)
    }

    /// Begins a message, if it is time for one.
    fn begin(&mut self, report: &FaultReport) -> Option<J1939Frame> {
        if self.since_message < PERIOD {
            return None;
        }
        let content = Dm1::of_report(report);
        if content == Dm1::clear() && content == self.content {
            return None;
        }
        self.content = content;
        self.since_message = Millis::ZERO;
        let length = self.content.length();
        if length <= FRAME {
            return Some(self.frame(DM1_ID, core::array::from_fn(|at| self.content.byte(at))));
        }
        // The table's length is checked to fit one session: at most 255 packets, 1785 bytes.
        let packets = u8::try_from(length.div_ceil(PACKET)).unwrap_or(u8::MAX);
        self.session = Session { next: 1, last: packets };
        let [low, high] = u16::try_from(length).unwrap_or(u16::MAX).to_le_bytes();
        let [_, pgn_low, pgn_high, _] = DM1_ID.to_le_bytes();
        Some(self.frame(CONNECTION_ID, [BAM, low, high, packets, PAD, pgn_low, pgn_high, 0]))
    }

    /// The next packet of the session.
    fn packet(&mut self) -> J1939Frame {
        let number = self.session.next;
        self.session.next = number.saturating_add(1);
        let first = usize::from(number).saturating_sub(1).saturating_mul(PACKET);
        let data = core::array::from_fn(|at| match at.checked_sub(1) {
            None => number,
            Some(at) => self.content.byte(first.saturating_add(at)),
        });
        self.frame(TRANSFER_ID, data)
    }

    fn frame(&self, id: u32, data: [u8; 8]) -> J1939Frame {
        J1939Frame { id: id | u32::from(self.source), data }
    }
}
