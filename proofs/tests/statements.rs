//! The properties that are not about one cycle, on random values and over whole ranges (CMD-2, CMD-5, SELF-4, SELF-5, SELF-6, SELF-9).

use arbitrary::{Arbitrary, Unstructured};
use proptest::collection::vec;
use proptest::prelude::{ProptestConfig, any, proptest};
use supervisor_core::{
    Checkpoint, Command, Config, DriveTorque, Envelope, Flow, Kind, Millis, Percent, Record, ResetCause, ServiceBrake,
    State, StateImage, Steering, vet_brake, vet_drive, vet_steering,
};
use supervisor_proofs::properties::boot::{self_9_boot, self_9_boot_exactly, self_9_record_survives};
use supervisor_proofs::properties::command::{
    cmd_2_usable_exactly, cmd_5_brake_nearest, cmd_5_drive_nearest, cmd_5_steering_nearest, cmd_5_verdict_is_true,
};
use supervisor_proofs::properties::configuration::self_4_sealed_exactly;
use supervisor_proofs::properties::flow::{
    self_6_answer_exactly, self_6_difference_stays, self_6_in_order_is_complete, self_6_stages_differ,
    self_6_wrong_stage_leaves_the_path,
};
use supervisor_proofs::properties::recovery::{
    self_5_damage_keeps_obligations, self_5_damage_permits_nothing, self_5_flipped_bit_is_recovered,
};

fn some<T: for<'a> Arbitrary<'a>>(source: &mut Unstructured<'_>) -> Option<T> {
    T::arbitrary(source).ok()
}

/// CMD-2, CMD-5: of one set of random values; `None` if the bytes did not suffice.
fn commands(bytes: &[u8]) -> Option<bool> {
    let source = &mut Unstructured::new(bytes);
    let envelope: Envelope = some(source).filter(Envelope::is_feasible)?;
    let (brake, drive, steering) =
        (some::<ServiceBrake>(source)?, some::<DriveTorque>(source)?, some::<Steering>(source)?);
    let (mode, gear, braking) = (some(source)?, some(source)?, some(source)?);
    let vetted_brake = vet_brake(&envelope, Command::Fresh(brake));
    let vetted_drive = vet_drive(&envelope, mode, gear, braking, Command::Fresh(drive));
    let vetted_steering = vet_steering(&envelope, Command::Fresh(steering));
    let (other, percent) = (some(source)?, some::<Percent>(source)?);
    let (command, timeout) = (some::<Command<Percent>>(source)?, some::<Millis>(source)?);
    let unchanged = vetted_brake.1.kind == Kind::Pass;
    Some(
        cmd_2_usable_exactly(command, timeout)
            && cmd_5_brake_nearest(&envelope, &brake, &vetted_brake.0, other)
            && cmd_5_drive_nearest(&envelope, mode, gear, braking, &drive, vetted_drive, percent)
            && cmd_5_steering_nearest(&envelope, &steering, vetted_steering, &some(source)?)
            && unchanged == (vetted_brake.0 == brake),
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 5_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// CMD-2a, CMD-5a, CMD-5e.
    #[test]
    fn commands_are_judged_truly(bytes in vec(any::<u8>(), 1_024)) {
        assert_ne!(commands(&bytes), Some(false));
    }

    /// SELF-5a, SELF-5c: any state, any single flipped bit of its image.
    #[test]
    fn a_damaged_state_keeps_what_it_owes(bytes in vec(any::<u8>(), 1_024), index in any::<usize>(), bit in 0_u32..32) {
        let old = State::arbitrary(&mut Unstructured::new(&bytes)).unwrap_or(State::INITIAL);
        let image = StateImage::encode(&old);
        let index = index % (2 * supervisor_core::STATE_WORDS + 1);
        let image = image.with_flipped_bit(index, bit);
        let damaged = State::damaged(&image);
        match image.decode::<State>() {
            Some(state) => assert_eq!((state, index), (old, 2 * supervisor_core::STATE_WORDS)),
            None => assert!(self_5_damage_keeps_obligations(&old, &damaged)),
        }
        assert!(self_5_damage_permits_nothing(&damaged));
        assert!(self_9_record_survives(&old, ResetCause::Watchdog));
    }

    /// SELF-4b, SELF-4c: a configuration with one value of the default changed, and one that is any.
    #[test]
    fn only_valid_configurations_are_sealed(bytes in vec(any::<u8>(), 1_024), value in any::<usize>(), bit in 0_u32..16) {
        let any = Config::arbitrary(&mut Unstructured::new(&bytes)).unwrap_or(Config::DEFAULT);
        assert!(self_4_sealed_exactly(&any) && self_4_sealed_exactly(&Config::DEFAULT));
        let words = <Config as supervisor_core::Words>::COUNT;
        let changed = supervisor_core::Sealed::from_default().ok().and_then(|sealed| sealed.with_flipped_bit(value % words, bit));
        let changed = changed.and_then(|sealed| sealed.intact().copied());
        assert!(changed.is_none_or(|config| self_4_sealed_exactly(&config)));
    }

    /// SELF-6a, SELF-6b.
    #[test]
    fn flow_differs_for_ever(bytes in vec(any::<u8>(), 16), question in any::<u8>()) {
        let source = &mut Unstructured::new(&bytes);
        let (Ok(flow), Ok(other)) = (Flow::arbitrary(source), Flow::arbitrary(source)) else { return Ok(()) };
        assert!(self_6_answer_exactly(flow, question) && self_6_answer_exactly(Flow::COMPLETE, question));
        for stage in Checkpoint::ALL {
            assert!(self_6_difference_stays(flow, other, *stage));
            assert!(Checkpoint::ALL.iter().all(|other| self_6_stages_differ(flow, *stage, *other)));
        }
    }

    /// SELF-5a: on short images, every bit.
    #[test]
    fn short_images_are_recovered(words in any::<[u32; 4]>()) {
        for index in 0..9 {
            assert!((0..32).all(|bit| self_5_flipped_bit_is_recovered(words, index, bit)));
        }
    }
}

/// SELF-6a: the right order, and every single wrong stage from each of its places.
#[test]
fn the_right_order_alone_is_complete() {
    assert!(self_6_in_order_is_complete());
    for before in 0..9 {
        assert!(Checkpoint::ALL.iter().all(|stage| self_6_wrong_stage_leaves_the_path(before, *stage)));
    }
}

/// SELF-9a: every cause with every record, and with none.
#[test]
fn boot_is_exact() {
    let records = Record::ALL.iter().copied().map(Some).chain([None]);
    for record in records {
        for cause in ResetCause::ALL {
            let state = State::boot(*cause, record);
            assert!(self_9_boot(&state, record) && self_9_boot_exactly(&state, *cause, record));
        }
    }
}

/// CMD-5a: a verdict that claims what did not happen is found.
#[test]
fn a_false_verdict_is_found() {
    let (asked, out) = (Command::Fresh(1_u8), 0);
    let pass = supervisor_core::Verdict::PASS;
    assert!(!cmd_5_verdict_is_true(asked, Millis::ZERO, out, 0, pass));
    assert!(cmd_5_verdict_is_true(asked, Millis::ZERO, 1, 0, pass));
}
