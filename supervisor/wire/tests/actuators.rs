//! The bus of the actuators: whose frames are there? (SELF-10)

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use common::*;
use supervisor_core::*;
use supervisor_perceive::Scene;
use supervisor_wire::*;

/// The supervisor's side: its sender, and the receiver that watches the bus of the actuators.
#[derive(Clone)]
struct Node {
    sender: Sender,
    receiver: Receiver,
}

impl Node {
    fn new() -> Self {
        Self { sender: Sender::new(), receiver: Receiver::new(&at_once()) }
    }
    /// The frames of a cycle.
    fn send(&mut self, now: u32, outputs: &Outputs) -> Vec<Frame> {
        let mut frames = Vec::new();
        self.sender.encode_outputs(ms(now), outputs, &mut |frame| frames.push(frame));
        frames
    }
    /// Everything is sent, of which the frame of this message.
    fn first(&mut self, message: Message) -> Frame {
        let id = message.id_from(Source::Supervisor);
        self.send(0, &Outputs::NEUTRAL).into_iter().find(|frame| frame.id == id).unwrap()
    }
    fn watch(&mut self, now: u32, frame: &Frame) -> Result<(), Refusal> {
        self.receiver.accept_actuator(ms(now), frame, &mut self.sender)
    }
    /// Foreign channels, second sender.
    fn sample(&mut self, now: u32) -> (Channels, bool) {
        let inputs = self.receiver.sample(ms(now)).inputs;
        (inputs.foreign, inputs.second_sender)
    }
}

const NOTHING: (Channels, bool) = (Channels::NONE, false);

fn only(channel: Channel) -> Channels {
    Channels::NONE.with(channel)
}

/// The commands, each with its channel.
fn commands() -> impl Iterator<Item = (Message, Channel)> {
    Message::ALL.iter().filter_map(|message| match message.destination() {
        Destination::Command(channel) => Some((*message, channel)),
        Destination::Input | Destination::Radar(_) | Destination::Camera(_) | Destination::Status => None,
    })
}

fn somebody(message: Message) -> Result<(), Refusal> {
    Err(Refusal { message: Some(message), fault: Fault::Source })
}

/// The same identifier from another source address.
fn from(frame: &Frame, address: u32) -> Frame {
    Frame { id: frame.id & !0xFF | address, ..*frame }
}

/// SELF-10a: a command from another source address, of the main controller or of anybody, is foreign on its channel
/// and on no other; for one cycle. The priority in the identifier does not count.
#[test]
fn other_source_address() {
    for (message, channel) in commands() {
        for address in [0x00, 0x0B, 0x2A, 0x7F, 0x81, 0xFE, 0xFF] {
            for priority in 0..8 {
                let mut node = Node::new();
                let other = from(&node.first(message), address);
                let other = Frame { id: other.id & 0x03FF_FFFF | priority << 26, ..other };
                assert_eq!(node.watch(5, &other), somebody(message));
                assert_eq!(node.sample(10), (only(channel), false), "{message:?} {address}");
                assert_eq!(node.sample(20), NOTHING);
            }
        }
    }
}

/// SELF-10a: what it says, whether it is intact, and how long it is, does not matter: an actuator is not ours to check.
#[test]
fn any_content() {
    let mut node = Node::new();
    for (length, data) in [(8, [0; 8]), (8, [0xFF; 8]), (0, [0; 8]), (3, [7; 8])] {
        let id = Message::ServiceBrake.id_from(Source::MainController);
        assert_eq!(node.watch(0, &Frame { id, length, data }), somebody(Message::ServiceBrake));
        assert_eq!(node.sample(0), (only(Channel::ServiceBrake), false));
    }
}

/// SELF-10a: two of them in one cycle, or three, are no less foreign than one.
#[test]
fn more_than_one() {
    let mut node = Node::new();
    let other = node.first(Message::ServiceBrake);
    for count in 1..=3 {
        for _ in 0..count {
            assert_eq!(node.watch(0, &from(&other, 0x0B)), somebody(Message::ServiceBrake));
        }
        assert_eq!(node.sample(0), (only(Channel::ServiceBrake), false), "{count}");
    }
}

/// SELF-10a: TSC1 to all addresses is obeyed by drive and retarder, XBR to all by the brakes. Proprietary B has no
/// address: there 0xFF is another message.
#[test]
fn to_all_addresses() {
    let mut node = Node::new();
    assert!(node.watch(0, &Frame::new(0x0C00_FF21, 0)).is_err());
    assert_eq!(node.sample(0), (only(Channel::DriveTorque).with(Channel::Retarder), false));
    assert!(node.watch(0, &Frame::new(0x0C04_FF21, 0)).is_err());
    assert_eq!(node.sample(0), (only(Channel::ServiceBrake), false));
    assert_eq!(node.watch(0, &Frame::new(0x0CFF_FF21, 0)), Ok(()));
    // From our address: a second sender too.
    assert!(node.watch(0, &Frame::new(0x0C04_FF80, 0)).is_err());
    assert_eq!(node.sample(0), (only(Channel::ServiceBrake), true));
    // TSC1 to an actuator that is not ours: the transmission.
    assert_eq!(node.watch(0, &Frame::new(0x0C00_0321, 0)), Ok(()));
    assert_eq!(node.sample(0), NOTHING);
}

/// SELF-10a: several in one cycle are all told.
#[test]
fn several_in_one_cycle() {
    let mut node = Node::new();
    let mut all = Channels::NONE;
    for (message, channel) in commands() {
        let _ = node.watch(0, &Frame::new(message.id(), 0));
        assert!(only(channel).contains(channel));
        all = all.with(channel);
    }
    let inside = |channel: &Channel| commands().any(|(_, commanded)| commanded == *channel);
    assert!(Channel::ALL.iter().all(|channel| all.contains(*channel) == inside(channel)));
    assert!(Channel::ALL.iter().all(|channel| !Channels::NONE.contains(*channel)));
    assert_eq!(node.sample(0), (all, false));
}

/// SELF-10b: a frame of ours that we did not send is a second sender, and foreign on its channel; on the first frame.
#[test]
fn second_sender() {
    for (message, channel) in commands() {
        let mut node = Node::new();
        let id = message.id_from(Source::Supervisor);
        assert_eq!(node.watch(0, &Frame::new(id, 0)), somebody(message));
        assert_eq!(node.sample(0), (only(channel), true));
        assert_eq!(node.sample(10), NOTHING, "cleared by the sample");
    }
    for message in [Message::SupervisorStatus, Message::SupervisorFaults] {
        let mut node = Node::new();
        assert_eq!(node.watch(0, &Frame::new(message.id(), 0)), somebody(message));
        assert_eq!(node.sample(0), (Channels::NONE, true));
        // The same parameter group of another is no command.
        assert_eq!(node.watch(0, &Frame::new(message.id() & !0xFF | 0x21, 0)), Ok(()));
        assert_eq!(node.sample(0), NOTHING);
    }
}

/// SELF-10b: a controller that hands back its own frames gives no alarm: at once, a cycle or two later, one frame
/// behind the sender; for minutes of changing outputs. Nor does one that hands back none, or some.
#[test]
fn echoes() {
    for late in [0, 3, 10, 19, 20] {
        for dropped in [1, 3, 1000] {
            let (mut node, mut random) = (Node::new(), Random::new(1));
            let mut waiting: Vec<(u32, Frame)> = Vec::new();
            let status = random.status();
            for now in (0..20_000).step_by(10) {
                let before = now - now.min(10);
                let arrived = |due: &(u32, Frame)| due.0 + late > before && due.0 + late <= now;
                for (sent, frame) in waiting.iter().filter(|due| arrived(due)) {
                    if now % dropped != 0 || dropped == 1000 {
                        assert_eq!(node.watch(sent + late, frame), Ok(()), "{late} {now}");
                    }
                }
                assert_eq!(node.sample(now), NOTHING);
                waiting.retain(|due| due.0 + late > now);
                // At most one change in two cycles: the second-last frame is the oldest that is remembered.
                let outputs = if now % 20 == 0 { random.outputs() } else { Outputs::NEUTRAL };
                waiting.extend(node.send(now, &outputs).into_iter().map(|frame| (now, frame)));
                node.sender.encode_status(ms(now), &status, &mut |frame| waiting.push((now, frame)));
                // Zero milliseconds late: within the same cycle.
                for (sent, frame) in waiting.iter().filter(|_| late == 0) {
                    assert_eq!(node.watch(*sent, frame), Ok(()));
                }
                waiting.retain(|_| late > 0);
            }
        }
    }
}

/// SELF-10b: an echo after more than two cycles, one that is altered anywhere, and a second one, are not echoes.
#[test]
fn not_an_echo() {
    for (message, channel) in commands() {
        let found = (only(channel), true);
        // Late, to the millisecond; and when the clock steps back.
        for (now, expected) in [(20, NOTHING), (21, found), (50, found), (u32::MAX, found)] {
            let mut node = Node::new();
            let frame = node.first(message);
            assert_eq!(node.watch(now, &frame).is_ok(), expected == NOTHING);
            assert_eq!(node.sample(now), expected, "{message:?} {now}");
        }
        // Altered: every bit of the payload, the length, the priority.
        for bit in 0..64 {
            let mut node = Node::new();
            let frame = node.first(message);
            let _ = node.watch(5, &Frame::new(frame.id, frame.payload() ^ 1 << bit));
            assert_eq!(node.sample(10), found, "{message:?} bit {bit}");
            // The true one is still an echo.
            assert_eq!(node.watch(10, &frame), Ok(()));
        }
        let mut node = Node::new();
        let frame = node.first(message);
        for altered in [Frame { length: 7, ..frame }, Frame { id: frame.id ^ 1 << 26, ..frame }] {
            assert_eq!(node.watch(5, &altered), somebody(message));
            assert_eq!(node.sample(10), found);
        }
        // Twice: the second one is of somebody else, who makes the actuator see a repeated counter.
        assert_eq!(node.watch(11, &frame), Ok(()));
        assert_eq!(node.sample(20), NOTHING);
        assert_eq!(node.watch(20, &frame), somebody(message));
        assert_eq!(node.sample(20), found);
        // The one before the last is remembered, the one before that is not.
        for (later, remembered) in [(1, true), (2, false)] {
            let mut node = Node::new();
            let frame = node.first(message);
            let again = |now| node_sends(&mut node, message, now);
            (1..=later).for_each(again);
            assert_eq!(node.watch(3, &frame).is_ok(), remembered, "{message:?}");
        }
    }
}

/// Makes the node send this message once more.
fn node_sends(node: &mut Node, message: Message, now: u32) {
    let id = message.id_from(Source::Supervisor);
    let seed = (1..100).find(|seed| {
        let outputs = Random::new(*seed).outputs();
        node.clone().send(now, &outputs).iter().any(|frame| frame.id == id)
    });
    let _ = node.send(now, &Random::new(seed.unwrap()).outputs());
}

/// SELF-10a: what is no command to an actuator is of no concern: inputs, object lists, status, the rest of the bus.
#[test]
fn unrelated() {
    let (mut node, mut random) = (Node::new(), Random::new(2));
    let mut sensors = Sender::new();
    for now in (0..1000).step_by(10) {
        sensors.encode_inputs(ms(now), &random.inputs(), &Scene::clear(), &mut |frame| {
            assert_eq!(node.watch(now, &frame), Ok(()));
        });
        for id in [0x18FE_CA80, 0x18FE_CA21, 0x18EE_FF80, 0x1FFF_FFFF, 0x0CFF_2C2A] {
            assert_eq!(node.watch(now, &Frame::new(id, random.next())), Ok(()));
        }
        assert_eq!(node.sample(now), NOTHING);
    }
}

/// SELF-10a: the watch is beside the other way in: a command that is foreign there is still no command here, and the
/// other inputs stay as they are.
#[test]
fn changes_nothing_else() {
    let (mut bench, mut random) = (Bench::new(&at_once()), Random::new(3));
    let (inputs, outputs) = (random.inputs(), random.outputs());
    for _ in 0..21 {
        bench.send(&inputs, &Scene::clear(), &fresh(&outputs));
        bench.pass(10);
    }
    let mut sender = Sender::new();
    for (message, _) in commands() {
        let _ = bench.receiver.accept_actuator(bench.now, &Frame::new(message.id(), 0), &mut sender);
    }
    let sample = bench.receiver.sample(bench.now);
    assert_ne!(sample.inputs.foreign, Channels::NONE);
    assert_eq!(Inputs { foreign: Channels::NONE, ..*sample.inputs }, inputs);
    assert_eq!(*sample.commands, fresh(&outputs));
}
