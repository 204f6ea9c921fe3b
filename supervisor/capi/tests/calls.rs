//! The calls beside the Rust interface: the same decisions, frames, verdicts, events and codes. Also run under Miri.
#![expect(dead_code, reason = "each test file uses a part of the caller")]

mod common;
use common::*;
use supervisor::report::{BodyFeedback, BodyMonitor, Dm1Sender, EventRecord, FaultReport};
use supervisor::wire::{Frame, Receiver, Sender};
use supervisor::{Channel, Decision, Inputs, Millis, Outputs, Percent, Record, ResetCause, Scene, Sealed, Supervisor};
use supervisor_capi::*;

/// Never called: keeps the expectation above fulfilled also where a file uses all of the caller.
fn _unused() {}

/// Fewer cycles under Miri, which takes its time.
const CYCLES: u32 = if cfg!(miri) { 30 } else { 2_000 };

/// Numbers that are not random, only different.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 11
    }
    fn byte(&mut self) -> u8 {
        self.next().to_le_bytes()[2]
    }
}

fn c_frame(frame: Frame) -> SupervisorFrame {
    SupervisorFrame { id: frame.id, data: frame.data, length: frame.length, reserved: [0; 3] }
}

/// Rust's side of the comparison.
struct Rust {
    supervisor: Supervisor,
    receiver: Receiver,
    sender: Sender,
}

impl Rust {
    fn new() -> Self {
        let Ok(sealed) = Sealed::from_default() else { unreachable!("the table is valid") };
        let supervisor = Supervisor::new(sealed, ResetCause::PowerOn, Some(Record::None));
        Self { receiver: Receiver::new(supervisor.config()), supervisor, sender: Sender::new() }
    }
    fn step(&mut self, now: Millis) -> (Decision, Vec<SupervisorFrame>) {
        let mut frames = Vec::new();
        let sample = self.receiver.sample(now);
        let decision = self.supervisor.step(now, sample.inputs, sample.scene, sample.commands);
        self.sender.encode_outputs(now, &decision.outputs, &mut |frame| frames.push(c_frame(frame)));
        self.sender.encode_status(now, &decision.status, &mut |frame| frames.push(c_frame(frame)));
        (decision, frames)
    }
}

/// What can be compared of both, as C has it.
fn same(stepped: &Stepped, decision: &Decision) {
    for ((channel, verdict), of_c) in decision.verdicts.iter().zip(stepped.decision.verdicts) {
        let told = (of_c.kind, of_c.reason, of_c.value, of_c.limit, of_c.margin);
        let made = (verdict.kind.code(), verdict.reason.code(), verdict.value, verdict.limit, verdict.margin);
        assert_eq!(told, made, "{channel:?}");
    }
    let (status, told) = (&decision.status, &stepped.decision.status);
    assert_eq!(told.faults, status.faults.bits());
    assert_eq!((told.record, told.exit, told.level), (status.record.code(), status.exit.code(), status.level.code()));
    assert_eq!((told.safe_state == 1, told.parked_by_leave == 1), (status.safe_state, status.parked_by_leave));
    assert_eq!(stepped.decision.outputs.drive_torque, decision.outputs.drive.torque.raw());
    assert_eq!(stepped.decision.outputs.brake_total, decision.outputs.brake.total.raw());
}

/// SELF-3a, SELF-1a: frames of a healthy bus among frames of any content give what the Rust interface gives.
#[test]
fn every_cycle_is_that_of_the_rust_interface() {
    let (mut rust, mut state, mut dice) = (Rust::new(), started(), Dice(7));
    let (mut sensors, mut controller, mut refused) = (Sender::new(), Sender::new(), 0_u32);
    for cycle in 1..=CYCLES {
        let now = cycle * 10;
        let mut outputs = Outputs::NEUTRAL;
        outputs.drive.torque = Percent::new(dice.byte());
        let mut frames = Vec::new();
        sensors.encode_inputs(Millis::new(now), &Inputs::NEVER, &Scene::clear(), &mut |frame| frames.push(frame));
        let commands = outputs.as_commands();
        controller.encode_commands(Millis::new(now), &commands, &mut |frame| frames.push(frame));
        for frame in &mut frames {
            if dice.byte() < 20 {
                frame.data = dice.next().to_le_bytes();
                frame.length = dice.byte() % 10;
            }
        }
        for frame in frames {
            let accepted = rust.receiver.accept(Millis::new(now), &frame);
            let (code, receipt) = receive(&mut state, now, &c_frame(frame));
            if let Ok(accepted) = accepted {
                assert_eq!(code, SupervisorCode::Ok);
                assert_eq!((receipt.fault, receipt.lost), (0, accepted.lost));
                assert_eq!(usize::from(receipt.message), accepted.message.number());
            } else {
                assert_eq!(code, SupervisorCode::FrameRefused);
                assert!((1..=10).contains(&receipt.fault), "{}", receipt.fault);
                refused += 1;
            }
        }
        let (decision, frames) = rust.step(Millis::new(now));
        let stepped = step(&mut state, now);
        assert_eq!(stepped.code, SupervisorCode::Ok);
        assert_eq!(stepped.frames, frames, "at {now} ms");
        same(&stepped, &decision);
    }
    assert!(refused > 10, "{refused} frames were refused");
}

/// SELF-10a, SELF-10b: what was sent comes back as an echo; a foreign command is refused and seen in the next step.
#[test]
fn a_foreign_command_is_found() {
    let mut state = started();
    let sent = step(&mut state, 10).frames;
    assert_eq!(sent.len(), SUPERVISOR_OUTPUT_FRAMES, "the first cycle sends everything");
    let mut back = |frame: &SupervisorFrame| {
        let mut receipt = SupervisorReceipt { message: 0, fault: 0, lost: 0, reserved: 0 };
        let code = call!(supervisor_receive_actuator(&raw mut *state, 12, frame, &raw mut receipt));
        (code, receipt.message)
    };
    for frame in &sent {
        assert_eq!(back(frame), (SupervisorCode::Ok, 255), "{:08X}", frame.id);
    }
    let foreign = SupervisorFrame { id: 0x0C04_0B2A, data: [0; 8], length: 8, reserved: [0; 3] };
    assert_eq!(back(&foreign), (SupervisorCode::FrameRefused, 21));
    let decision = step(&mut state, 20).decision;
    assert_ne!(decision.status.faults & (1 << 24), 0, "the bypass is reported");
}

/// SELF-2c, CMD-5a: what went out passes unchanged, on every channel; a code of no table is rejected.
#[test]
fn an_output_passes_and_a_wrong_code_is_rejected() {
    let mut state = started();
    let out = step(&mut state, 10).decision.outputs;
    for channel in Channel::ALL {
        let (code, outputs, verdict) = vet(&mut state, 15, channel.code(), &out);
        assert_eq!((code, verdict.kind), (SupervisorCode::Ok, 0), "{channel:?}");
        assert_eq!(outputs, out, "{channel:?}");
    }
    let torque = SupervisorOutputs { drive_torque: 60, ..out };
    let (code, outputs, verdict) = vet(&mut state, 15, Channel::DriveTorque.code(), &torque);
    assert_eq!((code, outputs.drive_torque), (SupervisorCode::Ok, 0), "no pedal is known");
    assert_eq!((verdict.kind, verdict.value, verdict.limit, verdict.margin), (1, 60, 0, -60));
    let wrong = [
        (Channel::DriveTorque, SupervisorOutputs { drive_origin: 3, ..out }),
        (Channel::DriveTorque, SupervisorOutputs { drive_active: 2, ..out }),
        (Channel::ServiceBrake, SupervisorOutputs { brake_mode: 3, ..out }),
        (Channel::Retarder, SupervisorOutputs { retarder_mode: 1, ..out }),
        (Channel::Gear, SupervisorOutputs { gear: 5, ..out }),
        (Channel::ParkingBrake, SupervisorOutputs { epb_request: 3, ..out }),
        (Channel::Steering, SupervisorOutputs { steering_enable: 255, ..out }),
        (Channel::Contactors, SupervisorOutputs { k1: 3, ..out }),
        (Channel::Auxiliaries, SupervisorOutputs { dc_dc: 7, ..out }),
        (Channel::Warnings, SupervisorOutputs { headway: 2, ..out }),
        (Channel::Body, SupervisorOutputs { wipers: 4, ..out }),
        (Channel::Mode, SupervisorOutputs { mode: 2, ..out }),
    ];
    for (channel, asked) in wrong {
        let (code, outputs, verdict) = vet(&mut state, 15, channel.code(), &asked);
        assert_eq!(code, SupervisorCode::Ok, "{channel:?}");
        assert_ne!(verdict.kind, 0, "{channel:?}: a rejected command does not pass");
        assert_eq!(outputs, out, "{channel:?}: and changes nothing");
    }
}

/// SELF-9a, SELF-9e: the record goes in as it came out, and one that fails its CRC is another boot.
#[test]
fn the_record_decides_the_boot() {
    for (record, parked) in [(0, 0), (1, 1), (2, 1), (255, 0)] {
        let (mut state, sealed) = (zeroed(), sealed());
        let code = call!(supervisor_init(
            &raw mut *state,
            SUPERVISOR_STATE_BYTES,
            SUPERVISOR_ABI_VERSION,
            sealed.as_ptr(),
            sealed.len(),
            POWER_ON,
            record
        ));
        assert_eq!(code, SupervisorCode::Ok);
        let status = step(&mut state, 10).decision.status;
        assert_eq!(status.parked_by_leave, parked, "record {record}");
        assert_eq!(status.record, if record == 255 { 0 } else { record });
    }
}

/// RPT-1a, RPT-1c: events, trouble codes and DM1 are those of the Rust interface.
#[test]
fn the_diagnosis_is_that_of_the_rust_interface() {
    let (mut rust, mut state) = (Rust::new(), started());
    let (mut record, mut faults) = (EventRecord::<SUPERVISOR_EVENTS, 1>::new(), FaultReport::default());
    let (mut lamps, mut dm1) = (BodyMonitor::new(), Dm1Sender::new(0x80));
    let mut diagnosis = Box::new(SupervisorDiagnosis::ZERO);
    let diagnosis = &raw mut *diagnosis;
    let code = call!(supervisor_diagnosis_init(diagnosis, SUPERVISOR_DIAGNOSIS_BYTES, SUPERVISOR_ABI_VERSION));
    assert_eq!(code, SupervisorCode::Ok);
    assert_eq!(
        call!(supervisor_diagnosis_observe(diagnosis, &raw mut *state, core::ptr::null())),
        SupervisorCode::NotStepped
    );
    let off = SupervisorBodyFeedback {
        wipers: 9,
        brake_lamps: 0,
        indicator_left: 2,
        indicator_right: 255,
        low_beam: 255,
        high_beam: 255,
    };
    let feedback = BodyFeedback { brake_lamps: supervisor::Signal::Known(false), ..BodyFeedback::NEVER };
    for cycle in 1..=CYCLES {
        let now = Millis::new(cycle * 10);
        let (decision, _) = rust.step(now);
        record.observe(now, &decision, None);
        faults.observe(now, &decision, lamps.observe(now, &decision, &feedback));
        assert_eq!(step(&mut state, now.raw()).code, SupervisorCode::Ok);
        let code = call!(supervisor_diagnosis_observe(diagnosis, &raw mut *state, &raw const off));
        assert_eq!(code, SupervisorCode::Ok);
        let mut frame = NO_FRAME;
        let code = call!(supervisor_diagnosis_dm1(diagnosis, now.raw(), &raw mut frame));
        match dm1.poll(now, &faults) {
            Some(due) => assert_eq!((code, frame.id, frame.data), (SupervisorCode::Ok, due.id, due.data)),
            None => assert_eq!(code, SupervisorCode::Nothing),
        }
    }
    let none =
        SupervisorEvent { time_ms: 0, value: 0, limit: 0, margin: 0, code: 0, what: 0, channel: 0, kind: 0, reason: 0 };
    for room in [0, 3, SUPERVISOR_EVENTS] {
        let (mut events, mut count, mut dropped) = (vec![none; SUPERVISOR_EVENTS], 0, 99_u32);
        let (first, count_at, dropped_at) = (events.as_mut_ptr(), &raw mut count, &raw mut dropped);
        let code = call!(supervisor_diagnosis_events(diagnosis, first, room, count_at, dropped_at));
        assert_eq!((code, dropped), (SupervisorCode::Ok, record.dropped()));
        let newest: Vec<u32> = record.iter().map(|event| event.time.raw()).collect();
        let newest = newest.split_at(newest.len().saturating_sub(room)).1;
        assert!(events.iter().take(count).map(|event| event.time_ms).eq(newest.iter().copied()), "the newest {room}");
        assert!(room == 0 || count > 0, "something has happened");
    }
    let trouble = SupervisorTrouble {
        spn: 0,
        fmi: 0,
        lamp: 0,
        system: 0,
        ads_code: 0,
        occurrences: 0,
        present: 0,
        reserved: [0; 2],
    };
    let (mut troubles, mut count) = (vec![trouble; SUPERVISOR_TROUBLES], 0);
    let (first, room) = (troubles.as_mut_ptr(), troubles.len());
    assert_eq!(call!(supervisor_diagnosis_troubles(diagnosis, first, room, &raw mut count)), SupervisorCode::Ok);
    let active = faults.active().map(|trouble| (trouble.code.spn.raw(), trouble.code.fmi.code(), trouble.occurrences));
    assert!(troubles.iter().take(count).map(|trouble| (trouble.spn, trouble.fmi, trouble.occurrences)).eq(active));
    assert!(cfg!(miri) || count > 3, "nothing was ever received: {count} codes");
}

/// CMD-3a: a silent main controller and silent sensors give every channel its frame and a reason.
#[test]
fn silence_gives_frames() {
    let first = step(&mut started(), 10);
    assert_eq!(first.frames.len(), SUPERVISOR_OUTPUT_FRAMES);
    assert!(first.frames.iter().all(|frame| frame.length == 8 && frame.reserved == [0; 3]));
    assert!(first.decision.verdicts.iter().all(|verdict| verdict.reason != 0 && verdict.reserved == [0; 2]));
}
