//! What becomes of frames on their way.

use std::collections::{BTreeMap, VecDeque};

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use supervisor::wire::{Frame, Message};
use supervisor::{ContactorRequest, DecelMs2Q11, DriveTorque, Origin, Outputs, Percent};

use super::kind::Mangled;
use crate::bench::Node;

/// Frames too many in each cycle.
const BABBLE: usize = 40;

/// A failing link.
#[derive(Clone, Debug)]
pub struct Frames {
    kind: Mangled,
    /// How long late frames wait, in ms.
    delay_ms: u32,
    waiting: VecDeque<(u32, Frame)>,
    /// The last frame of each identifier, before it began.
    last: BTreeMap<u32, Frame>,
    /// A frame that waits for the next one of its message.
    held: BTreeMap<u32, Frame>,
    values: VecDeque<(u32, Outputs)>,
}

impl Frames {
    /// `delay_ms` is how long late frames wait.
    #[must_use]
    pub const fn new(kind: Mangled, delay_ms: u32) -> Self {
        Self {
            kind,
            delay_ms,
            waiting: VecDeque::new(),
            last: BTreeMap::new(),
            held: BTreeMap::new(),
            values: VecDeque::new(),
        }
    }

    /// The values that go out behind the frames: a check field that is wrong hides a wrong value best.
    pub fn corrupt(&self, sent: &mut Outputs) {
        if matches!(self.kind, Mangled::Corrupted | Mangled::WrongIdentifier) {
            sent.drive = DriveTorque { torque: Percent::FULL, active: false, origin: Origin::Driver };
        }
    }

    /// While it lasts.
    pub fn mangle(&mut self, now_ms: u32, node: Node, frames: &mut Vec<Frame>, random: &mut ChaCha8Rng) {
        match (node, self.kind) {
            (Node::Sensors, Mangled::SeatLost) => {
                let seat = [Message::Seat1.id(), Message::Seat2.id()];
                frames.retain(|frame| !seat.contains(&frame.id));
            }
            (Node::Sensors, _) | (Node::Controller, Mangled::SeatLost) => {}
            (Node::Controller, Mangled::LostSome) => frames.retain(|_| random.random_range(0..3) > 0),
            (Node::Controller, Mangled::Lost) => frames.clear(),
            (Node::Controller, Mangled::Repeated) => {
                for frame in frames {
                    *frame = *self.last.entry(frame.id).or_insert(*frame);
                }
            }
            (Node::Controller, Mangled::Late) => {
                let due = now_ms.saturating_add(self.delay_ms);
                self.waiting.extend(frames.drain(..).map(|frame| (due, frame)));
                while self.waiting.front().is_some_and(|(due, _)| *due <= now_ms) {
                    frames.extend(self.waiting.pop_front().map(|(_, frame)| frame));
                }
            }
            (Node::Controller, Mangled::Reordered) => {
                let mut swapped = Vec::new();
                for frame in frames.drain(..) {
                    match self.held.remove(&frame.id) {
                        Some(earlier) => swapped.extend([frame, earlier]),
                        None => drop(self.held.insert(frame.id, frame)),
                    }
                }
                *frames = swapped;
            }
            (Node::Controller, Mangled::Corrupted) => {
                for frame in frames {
                    let bit: u32 = random.random_range(0..64);
                    *frame = Frame::new(frame.id, frame.payload() ^ 1_u64.rotate_left(bit));
                }
            }
            (Node::Controller, Mangled::Babbling) => {
                let ids: Vec<u32> = self.last.keys().copied().collect();
                for _ in 0..BABBLE {
                    let id = ids.get(random.random_range(0..ids.len().max(1))).copied();
                    frames.extend(id.map(|id| Frame::new(id, random.random())));
                }
            }
            (Node::Controller, Mangled::WrongIdentifier) => {
                let ids: Vec<u32> = self.last.keys().copied().collect();
                for frame in frames {
                    let next = ids.iter().find(|id| **id > frame.id).or(ids.first());
                    frame.id = next.copied().unwrap_or(frame.id);
                }
            }
        }
    }

    /// Before it begins.
    pub fn watch(&mut self, node: Node, frames: &[Frame]) {
        if node == Node::Controller {
            self.last.extend(frames.iter().map(|frame| (frame.id, *frame)));
        }
    }

    /// What an actuator that checks neither counter, check field nor age would take from these frames.
    pub fn unsupervised(&mut self, now_ms: u32, sent: &Outputs, random: &mut ChaCha8Rng) -> Outputs {
        match self.kind {
            Mangled::Lost | Mangled::Repeated => {
                self.values.truncate(1);
                self.values.front().map_or(*sent, |(_, first)| *first)
            }
            Mangled::Late => {
                self.values.push_back((now_ms, *sent));
                while self.values.get(1).is_some_and(|(at, _)| at.saturating_add(self.delay_ms) <= now_ms) {
                    self.values.pop_front();
                }
                self.values.front().map_or(*sent, |(_, late)| *late)
            }
            Mangled::Babbling => {
                let mut outputs = *sent;
                outputs.drive.torque = Percent::new(random.random_range(0..=100));
                outputs.brake.total = DecelMs2Q11::new(random.random_range(0..6 * 2048));
                outputs.contactors.k1 = ContactorRequest::Open;
                outputs
            }
            Mangled::LostSome
            | Mangled::Reordered
            | Mangled::Corrupted
            | Mangled::WrongIdentifier
            | Mangled::SeatLost => *sent,
        }
    }

    /// What actuators took last, before it began.
    pub fn took(&mut self, now_ms: u32, sent: &Outputs) {
        self.values.clear();
        self.values.push_back((now_ms, *sent));
    }
}
