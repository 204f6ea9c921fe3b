//! The link: check fields, decoders, the order of frames, and when a command counts (E2E-1, CMD-1, CMD-2, CMD-7).
//!
//! Time is carried by the state of a link: each property holds from *any* state, so what it says of one frame holds
//! after every history.

use supervisor_core::{
    AngleDeciDeg, Cause, Command, Config, DecelMs2Q11, Evidence, Inputs, Millis, Outputs, Pedal250, Percent,
    RetarderMode, Seat, Signal, SpeedKmhQ8, kernel,
};
use supervisor_wire::inspect::{Link, Values, identify, read, send, write};
use supervisor_wire::{Destination, Fault, Frame, Message, Protection, Sender, Source};

use super::implies;

/// The check field that a payload with its counter must have, said once more: Profile 11 as the remainder of a long division, J1939 as
/// its text has it.
#[must_use]
pub fn check_field(protection: Protection, id: u32, payload: u64) -> u64 {
    let bytes = payload.to_le_bytes();
    let data_id = id.to_le_bytes();
    match protection {
        Protection::Profile11 => {
            // x⁸ + x⁴ + x³ + x² + 1 into the data id, low byte first, and bytes 1 to 7, eight zeros behind them.
            let message =
                [data_id[0], data_id[1], bytes[1], bytes[2], bytes[3], bytes[4], bytes[5], bytes[6], bytes[7]];
            let mut rest = message.iter().fold(0_u128, |rest, byte| rest << 8 | u128::from(*byte)) << 8;
            for bit in (8..80).rev() {
                if rest >> bit & 1 == 1 {
                    rest ^= 0x11D << (bit - 8);
                }
            }
            u64::try_from(rest).unwrap_or(u64::MAX)
        }
        Protection::Tsc1 | Protection::Xbr => {
            let counter = u32::from(bytes[7] & 0x0F);
            let sum = bytes[..7].iter().chain(&data_id).map(|byte| u32::from(*byte)).sum::<u32>() + counter;
            u64::from(if protection == Protection::Tsc1 {
                ((sum >> 6 & 3) + (sum >> 3) + sum) & 7
            } else {
                ((sum >> 4) + sum) & 15
            })
        }
        Protection::Bare => 0,
    }
}

/// Counter and check field as they stand in a payload; none in a bare message.
fn fields(protection: Protection, payload: u64) -> Option<(u8, u64)> {
    let [check, first, .., last] = payload.to_le_bytes();
    match protection {
        Protection::Profile11 => Some((first & 0x0F, u64::from(check))),
        Protection::Tsc1 | Protection::Xbr => Some((last & 0x0F, u64::from(last >> 4))),
        Protection::Bare => None,
    }
}

/// How many values the counter of a frame has: AUTOSAR Profile 11 counts 0 to 14, 15 is reserved; of J1939 TSC1 counts 0 to 7
/// (SPN 4206), 8 to 14 are reserved, 15 is not available; XBR counts 0 to 15 (SPN 3189).
const fn valid_counters(protection: Protection) -> u8 {
    match protection {
        Protection::Profile11 => 15,
        Protection::Tsc1 => 8,
        Protection::Xbr => 16,
        Protection::Bare => 0,
    }
}

/// E2E-1b, CMD-7c: a protected frame is intact exactly when its check field is right and its counter is one.
#[must_use]
pub fn e2e_1b_intact_exactly(protection: Protection, id: u32, payload: u64) -> bool {
    let opened = protection.open(id, payload);
    match fields(protection, payload) {
        None => opened == Ok(None),
        Some((counter, _)) if counter >= valid_counters(protection) => opened == Err(Fault::NoCounter),
        Some((_, check)) if check != check_field(protection, id, payload) => opened == Err(Fault::Checksum),
        Some((counter, _)) => opened == Ok(Some(counter)),
    }
}

/// E2E-1b: what is sealed is intact, with its counter; nothing but counter and check field is changed.
#[must_use]
pub fn e2e_1b_sealed_is_intact(protection: Protection, id: u32, payload: u64, counter: u8) -> bool {
    let sealed = protection.seal(id, payload, counter);
    let expected = if protection == Protection::Bare { None } else { Some(counter) };
    implies(counter < protection.counts(), protection.open(id, sealed) == Ok(expected))
        && (sealed ^ payload) & !protected_by(protection) == 0
}

/// E2E-1b: one flipped bit of an intact frame is found, whichever it is. (Of TSC1 alone J1939 lets some pass.)
#[must_use]
pub fn e2e_1b_flipped_bit_is_found(protection: Protection, id: u32, payload: u64, bit: u32) -> bool {
    let strong = matches!(protection, Protection::Profile11 | Protection::Xbr);
    let flipped = payload ^ 1_u64.rotate_left(bit);
    implies(strong && protection.open(id, payload).is_ok(), protection.open(id, flipped).is_err())
}

/// One frame at one link, before and after.
#[derive(Clone, Copy, Debug)]
pub struct Arrival {
    /// Which message.
    pub message: Message,
    /// When it came.
    pub now: Millis,
    /// The frame.
    pub frame: Frame,
    /// The link before it.
    pub before: Link,
    /// The link after it.
    pub after: Link,
    /// What frames have carried before.
    pub old: Values,
    /// And now; of a refused frame the receiver takes nothing over.
    pub new: Values,
    /// How many frames before it are lost, or what is wrong with it.
    pub result: Result<u8, Fault>,
}

/// A property of one frame at one link.
pub type Holds = fn(&Arrival) -> bool;

/// Every property of a frame, by its name.
pub const ALL: &[(&str, Holds)] = &[
    ("cmd_1_taken_means_encoded_the_same", cmd_1_taken_means_encoded_the_same),
    ("e2e_1c_result_is_exact", e2e_1c_result_is_exact),
    ("rule_5a_disobeyed_at_once", rule_5a_disobeyed_at_once),
    ("cmd_7a_commands_are_no_evidence", cmd_7a_commands_are_no_evidence),
    ("cmd_2b_fresh_only_when_taken", cmd_2b_fresh_only_when_taken),
];

impl Arrival {
    /// Receives a frame of this message.
    #[must_use]
    pub fn of(message: Message, before: Link, now: Millis, frame: Frame, old: Values) -> Self {
        let (mut after, mut new) = (before, old);
        let result = after.receive(now, &frame, &mut new);
        Self { message, now, frame, before, after, old, new, result }
    }
    fn protection(&self) -> Protection {
        self.message.protection()
    }
}

/// The bits of a payload that counter and check field take.
const fn protected_by(protection: Protection) -> u64 {
    match protection {
        Protection::Profile11 => 0x0FFF,
        Protection::Tsc1 | Protection::Xbr => 0xFF << 56,
        Protection::Bare => 0,
    }
}

/// CMD-1b, CMD-1c, E2E-1b, CMD-7c: a protected frame is taken only if writing what was read gives the same frame, to the bit: no field out of
/// its range, no code that is not in its table, no stray bit, the right check field.
#[must_use]
pub fn cmd_1_taken_means_encoded_the_same(arrival: &Arrival) -> bool {
    let Frame { id, length, .. } = arrival.frame;
    let payload = arrival.frame.payload();
    let same = match fields(arrival.protection(), payload) {
        None => true,
        Some((counter, _)) => arrival.protection().seal(id, write(arrival.message, &arrival.new), counter) == payload,
    };
    implies(arrival.result.is_ok(), length == 8 && same)
}

/// CMD-1b, CMD-1c: writing what was read of a protected message gives the same payload, to the bit.
#[must_use]
pub fn writes_back(message: Message, payload: u64, read: &Values) -> bool {
    let protection = message.protection();
    protection == Protection::Bare || (write(message, read) ^ payload) & !protected_by(protection) == 0
}

/// E2E-1c, E2E-1e: what becomes of a frame, exactly: refused for its length, its check field, its content; then by its counter: after a gap an
/// input is taken, a command is not; one to three steps on are taken, and what lies between is lost; all else is refused. A bare one
/// has no counter.
#[must_use]
pub fn e2e_1c_result_is_exact(arrival: &Arrival) -> bool {
    let payload = arrival.frame.payload();
    let counts = arrival.protection().counts();
    let last = arrival.before.predecessor(arrival.now);
    let order = |counter: u8| match last {
        None if arrival.message.is_command() => Err(Fault::NoPredecessor),
        None => Ok(0),
        Some(last) => match (counter + counts).saturating_sub(last) % counts {
            0 => Err(Fault::Repeated),
            step @ 1..=3 => Ok(step - 1),
            _ => Err(Fault::Sequence),
        },
    };
    let expected = if arrival.frame.length == 8 {
        arrival.protection().open(arrival.frame.id, payload).and_then(|counter| {
            read(arrival.message, payload, &mut { arrival.old })?;
            counter.map_or(Ok(0), order)
        })
    } else {
        Err(Fault::Length)
    };
    let counts_on = |last: Option<u8>| last.is_none_or(|last| last < counts);
    // A counter of the table stays one: the premise is an invariant.
    implies(counts_on(last), arrival.result == expected && counts_on(arrival.after.predecessor(arrival.now)))
}

/// RULE-5a, E2E-1j, CMD-7c: a frame that is refused is disobeyed in the cycle in which it arrives; one that is taken counts, or its sender has yet
/// to prove itself.
#[must_use]
pub fn rule_5a_disobeyed_at_once(arrival: &Arrival) -> bool {
    let mut after = arrival.after;
    let (quality, command) = (after.quality(arrival.now), { after }.command(arrival.now, ()));
    match arrival.result {
        Ok(_) => matches!(quality, Ok(Millis::ZERO) | Err(Cause::Requalifying)),
        Err(fault) => {
            quality == Err(Cause::EndToEnd) && fault.rejection().is_some_and(|why| command == Command::Rejected(why))
        }
    }
}

/// CMD-7a: nothing that a command says is evidence: inputs and what the supervisor says of itself stay as they are; and no input commands.
#[must_use]
pub fn cmd_7a_commands_are_no_evidence(arrival: &Arrival) -> bool {
    reads_its_own(arrival.message, &arrival.old, &arrival.new)
}

/// CMD-7a: reading a message changes nothing but what it carries, whether it is read to its end or refused on the way.
#[must_use]
pub fn reads_its_own(message: Message, old: &Values, new: &Values) -> bool {
    let evidence = matches!(message.destination(), Destination::Input);
    implies(!evidence, old.inputs == new.inputs)
        && implies(!message.is_command(), old.outputs == new.outputs)
        && implies(message.destination() != Destination::Status, old.status == new.status)
        && old.inputs.foreign == new.inputs.foreign
        && old.inputs.second_sender == new.inputs.second_sender
}

/// CMD-2b, CMD-2c, CMD-2d: in the cycle of a frame that is taken the command is fresh, unless its sender has yet to prove itself; later it is
/// held with its age up to the time-out, then it is absent.
#[must_use]
pub fn cmd_2b_fresh_only_when_taken(arrival: &Arrival) -> bool {
    let at_once = { arrival.after }.command(arrival.now, ());
    match arrival.result {
        Ok(_) => matches!(at_once, Command::Fresh(()) | Command::Absent),
        Err(_) => !matches!(at_once, Command::Fresh(()) | Command::Held(..)),
    }
}

/// CMD-2b, CMD-2c, CMD-2d, E2E-1g, E2E-1h: a link that nothing has come to in this cycle, later: a command that counted is held with its age
/// exactly as long as its time-out, or for good if it asks for nothing on demand; then it is absent and stays so. It is never fresh.
#[must_use]
pub fn cmd_2c_held_up_to_its_timeout(arrival: &Arrival, timeout: Millis, later: Millis) -> bool {
    let mut link = arrival.after;
    link.fresh = false;
    let age = Millis::new(later.raw().wrapping_sub(arrival.now.raw()));
    let counted = { link }.quality(arrival.now).is_ok();
    let command = link.command(later, ());
    let expected =
        if asks_nothing(arrival) || age <= timeout { Command::Held(age.min(timeout), ()) } else { Command::Absent };
    implies(arrival.result.is_ok() && counted, command == expected)
        && !matches!(command, Command::Fresh(()))
        && implies(arrival.result.is_ok(), !matches!(command, Command::Rejected(_)))
}

/// E2E-1h: TSC1 pauses while nothing is asked for.
fn asks_nothing(arrival: &Arrival) -> bool {
    let (drive, retarder) = (arrival.new.outputs.drive, arrival.new.outputs.retarder);
    let (to_drive, to_retarder) = (arrival.message == Message::DriveTorque, arrival.message == Message::Retarder);
    to_drive && !drive.active && drive.torque == Percent::ZERO || to_retarder && retarder.mode == RetarderMode::Off
}

/// E2E-1e, E2E-1f, E2E-1i: the speed of CCVS1 by its upper byte: up to 0xFA valid, then out of range, error and not available; of all
/// inputs it says nothing else.
#[must_use]
pub fn e2e_1i_wheel_speed(arrival: &Arrival) -> bool {
    let [_, low, high, ..] = arrival.frame.data;
    let wheel_speed = match high {
        0..=0xFA => Signal::Known(SpeedKmhQ8::new(u16::from_le_bytes([low, high]))),
        0xFB..=0xFD => Signal::Unknown(Cause::OutOfRange),
        0xFE | 0xFF => Signal::Unknown(Cause::NotAvailable),
    };
    let taken = arrival.frame.length == 8;
    arrival.result.is_ok() == taken
        && implies(taken, arrival.new.inputs == Inputs { wheel_speed, ..arrival.old.inputs })
}

/// E2E-1e, E2E-1f, E2E-1i: the four switches of EBC1: off, on, else unknown; of all inputs it says nothing else.
#[must_use]
pub fn e2e_1i_brake_switches(arrival: &Arrival) -> bool {
    let switch = |byte: usize, shift: u32| match arrival.frame.data[byte] >> shift & 3 {
        0 => Signal::Known(false),
        1 => Signal::Known(true),
        _ => Signal::Unknown(Cause::NotAvailable),
    };
    let (asr, abs) = (switch(0, 2), switch(0, 4));
    let (ebs_red, ebs_amber) = (switch(5, 2), switch(5, 4));
    let taken = arrival.frame.length == 8;
    arrival.result.is_ok() == taken
        && implies(taken, arrival.new.inputs == Inputs { asr, abs, ebs_red, ebs_amber, ..arrival.old.inputs })
}

/// CMD-3c: whatever is written into a protected message, with whatever values, is read again, and as what was written.
#[must_use]
pub fn cmd_3c_written_is_read(message: Message, values: &Values) -> bool {
    let payload = write(message, values);
    let mut again = Values::NONE;
    let same = read(message, payload, &mut again).is_ok() && write(message, &again) == payload;
    same || message.protection() == Protection::Bare
}

/// CMD-3c: an output comes out as it went in, up to what a field of J1939 holds: a torque of at most 125 %, a deceleration of at most 15.687 m/s².
#[must_use]
pub fn cmd_3c_outputs_come_back(message: Message, values: &Values) -> bool {
    let mut sent = values.outputs;
    sent.drive.torque = sent.drive.torque.min(Percent::new(125));
    sent.retarder.torque = sent.retarder.torque.min(Percent::new(125));
    sent.brake.total = DecelMs2Q11::new(sent.brake.total.raw().min(32_127));
    // Over what was sent, what is read changes nothing but this.
    let mut again = Values { outputs: sent, ..Values::NONE };
    read(message, write(message, values), &mut again).is_ok() && again.outputs == sent
}

/// E2E-1i, CMD-1c: our own signals, by the three codings that all rows share: the greatest raw value is unknown, every other one of a number is
/// that number, and a code that is not in its table is refused.
#[must_use]
pub fn e2e_1i_our_own_signals(arrival: &Arrival) -> bool {
    let [_, _, b2, b3, ..] = arrival.frame.data;
    let raw = u16::from_le_bytes([b2, b3]);
    let inputs = &arrival.new.inputs;
    let not_available = Cause::NotAvailable;
    let seat = [
        Some(Signal::Known(Seat::Vacant)),
        Some(Signal::Known(Seat::Occupied)),
        None,
        Some(Signal::Unknown(not_available)),
    ][usize::from(b2 & 3)];
    let speed = if raw == u16::MAX { Signal::Unknown(not_available) } else { Signal::Known(SpeedKmhQ8::new(raw)) };
    let angle = AngleDeciDeg::new(raw.cast_signed());
    let angle = if raw == 0x7FFF { Signal::Unknown(not_available) } else { Signal::Known(angle) };
    let taken = |message| arrival.message == message && arrival.result.is_ok();
    implies(taken(Message::Seat1), seat == Some(inputs.seat[0]))
        && implies(taken(Message::DriveStatus), inputs.motor_speed == speed)
        && implies(taken(Message::SteeringStatus), inputs.steering_angle == angle)
}

/// CMD-1a, SELF-10b: an identifier is that of one message from one sender, or of none and refused.
#[must_use]
pub fn cmd_1a_closed_table(id: u32) -> bool {
    let is = |message: Message, source: Source| message.id_from(source) == id;
    match identify(id) {
        Some((message, source)) => is(message, source),
        None => {
            !Message::ALL.iter().any(|message| is(*message, Source::MainController) || is(*message, Source::Supervisor))
        }
    }
}

/// CMD-3e, SELF-8a: one message that is sent goes out once, intact, with the counter after its last one, the first with 0; no
/// other message's counter moves.
#[must_use]
pub fn cmd_3e_next_counter(before: &Sender, now: Millis, message: Message, values: &Values) -> bool {
    let (mut after, mut frames, mut good) = (before.clone(), 0_u8, true);
    let next = before.counter(message).map_or(0, |last| u16::from(last) + 1);
    let next = if next < u16::from(message.protection().counts()) { next } else { 0 };
    let id = message.id_from(Source::Supervisor);
    send(&mut after, now, message, values, &mut |frame| {
        let counter = message.protection().open(frame.id, frame.payload()).ok().flatten();
        good &= frame.id == id && counter.map(u16::from) == Some(next);
        frames = frames.saturating_add(1);
    });
    let kept = |other: Message| other == message || after.counter(other) == before.counter(other);
    good && frames == 1 && after.counter(message).map(u16::from) == Some(next) && Message::ALL.iter().copied().all(kept)
}

/// CMD-3e, SELF-8a: in every cycle, whatever is sent, each output of a message has the counter after its last one; the first has 0. None goes out
/// twice, and a message that does not go out keeps its counter.
#[must_use]
pub fn cmd_3e_counters_run_on(before: &Sender, now: Millis, outputs: &Outputs) -> bool {
    let mut after = before.clone();
    let mut sent = [None; Message::COUNT];
    let mut good = true;
    after.encode_outputs(now, outputs, &mut |frame| {
        for message in Message::ALL.iter().copied().filter(|message| message.id_from(Source::Supervisor) == frame.id) {
            let place = &mut sent[message.number()];
            let counter = message.protection().open(frame.id, frame.payload()).ok().flatten();
            good &= place.is_none() && counter.is_some() && message.is_command();
            *place = counter;
        }
    });
    let goes_on = |message: Message| {
        let last = before.counter(message);
        let next = last.map_or(0, |last| u16::from(last) + 1);
        let next = if next < u16::from(message.protection().counts()) { next } else { 0 };
        match sent[message.number()] {
            Some(counter) => u16::from(counter) == next && after.counter(message) == Some(counter),
            None => after.counter(message) == last,
        }
    };
    good && Message::ALL.iter().copied().all(goes_on)
}

/// E2E-1d, RULE-6c: two sources agree within their bound, or the value is unknown.
#[must_use]
pub fn e2e_1d_redundant_known_only_while_agreed(inputs: &Inputs, config: &Config) -> bool {
    let Evidence { speed, accelerator, .. } = Evidence::gather(inputs, config);
    let speeds = inputs.wheel_speed.known().zip(inputs.motor_speed.known());
    let agreed = speeds.filter(|(wheel, motor)| {
        let difference = wheel.raw().abs_diff(motor.raw());
        difference <= config.speed_agree.raw()
            || kernel::within_percent(difference, config.speed_agree_percent.raw(), wheel.raw().max(motor.raw()))
    });
    let pedal = |track: Signal<Pedal250>| track.known().filter(|travel| travel.raw() <= 250);
    let [first, second] = inputs.accelerator.map(pedal);
    let tracks = first.zip(second).filter(|(one, other)| one.raw().abs_diff(other.raw()) <= config.pedal_agree.raw());
    speed.map(|speed| (speed.low, speed.high)) == agreed.map(|(wheel, motor)| (wheel.min(motor), wheel.max(motor)))
        && accelerator == tracks.map(|(one, other)| one.min(other))
}
