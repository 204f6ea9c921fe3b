//! The properties of the link on random frames, links and times (E2E-1, CMD-1, CMD-2, CMD-7, RULE-5).

use arbitrary::{Arbitrary, Unstructured};
use proptest::collection::vec;
use proptest::prelude::{ProptestConfig, Strategy, any, prop_oneof, proptest};
use proptest::sample::select;
use supervisor_core::{Config, Inputs, Millis, Outputs, Status};
use supervisor_proofs::properties::frame::{
    ALL, Arrival, cmd_1a_closed_table, cmd_2c_held_up_to_its_timeout, cmd_3c_outputs_come_back, cmd_3c_written_is_read,
    cmd_3e_counters_run_on, e2e_1b_flipped_bit_is_found, e2e_1b_intact_exactly, e2e_1b_sealed_is_intact,
    e2e_1d_redundant_known_only_while_agreed, e2e_1i_brake_switches, e2e_1i_our_own_signals, e2e_1i_wheel_speed,
};
use supervisor_proofs::properties::qualifier::{
    e2e_1g_stale_stays_stale, e2e_1g_timeout_is_exact, e2e_1j_first_good_frame_begins,
    e2e_1j_further_good_frames_go_on, rule_1a_quality_is_one_of_five, rule_5a_failure_counts_at_once,
};
use supervisor_wire::inspect::{Link, Values, write};
use supervisor_wire::{Destination, Frame, Message, Protection, Qualifier, Sender, Source, Timing};

const CASES: u32 = 40_000;
const PROTECTIONS: [Protection; 4] = [Protection::Profile11, Protection::Tsc1, Protection::Xbr, Protection::Bare];
const BYTES: usize = 1_024;

fn values(bytes: &[u8]) -> Option<Values> {
    let mut source = Unstructured::new(bytes);
    Some(Values {
        inputs: Inputs::arbitrary(&mut source).ok()?,
        outputs: Outputs::arbitrary(&mut source).ok()?,
        status: Status::arbitrary(&mut source).ok()?,
        stamp: Millis::arbitrary(&mut source).ok()?,
        ..Values::NONE
    })
}

/// A span of time about a time-out or a requalification, or any.
fn span() -> impl Strategy<Value = u32> {
    prop_oneof![0..130_u32, 120..130_u32, 245..255_u32, 495..505_u32, 995..1_005_u32, 0..1_100_u32, any::<u32>()]
}

/// What happened at a sender: spans, and whether its frames were good.
fn history() -> impl Strategy<Value = Vec<(u32, u8)>> {
    vec((prop_oneof![4 => (0..140_u32).boxed(), 1 => span().boxed()], 0..8_u8), 0..14)
}

fn timing() -> impl Strategy<Value = Timing> {
    (select(vec![125_u32, 250, 500]), select(vec![0_u32, 300, 1_000]))
        .prop_map(|(timeout, requalify)| Timing { timeout: Millis::new(timeout), requalify: Millis::new(requalify) })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: CASES, failure_persistence: None, ..ProptestConfig::default() })]

    /// E2E-1b, CMD-7c: intact exactly with the right check field; what is sealed is; one flipped bit is found, whichever it is.
    #[test]
    fn check_fields(id in any::<u32>(), payload in any::<u64>(), counter in 0..17_u8) {
        for protection in PROTECTIONS {
            assert!(e2e_1b_sealed_is_intact(protection, id, payload, counter));
            let sealed = protection.seal(id, payload, counter);
            assert!(e2e_1b_intact_exactly(protection, id, payload));
            assert!(e2e_1b_intact_exactly(protection, id, sealed));
            for bit in 0..64 {
                assert!(e2e_1b_intact_exactly(protection, id, sealed ^ 1_u64.rotate_left(bit)));
                assert!(e2e_1b_flipped_bit_is_found(protection, id, sealed, bit));
            }
        }
    }

    /// E2E-1g, E2E-1j, RULE-1a, RULE-5a: a sender after any history.
    #[test]
    fn qualification(history in history(), timing in timing(), now in span(), later in span(), start in any::<u32>()) {
        let (mut qualifier, mut time) = (Qualifier::NEVER, Millis::new(start));
        let on = |time: Millis, span: u32| Millis::new(time.raw().wrapping_add(span));
        for (span, kind) in history {
            time = on(time, span);
            match kind {
                0 => qualifier.bad(time, timing),
                1 => {
                    let _ = qualifier.quality(time, timing);
                }
                _ => qualifier.good(time, timing),
            }
        }
        let now = on(time, now);
        let later = on(now, later);
        assert!(e2e_1g_timeout_is_exact(qualifier, timing, now, later));
        assert!(e2e_1g_stale_stays_stale(qualifier, timing, now, later));
        assert!(e2e_1j_first_good_frame_begins(qualifier, timing, now, later));
        assert!(e2e_1j_further_good_frames_go_on(qualifier, timing, now, later));
        assert!(rule_5a_failure_counts_at_once(qualifier, timing, now, later));
        assert!(rule_1a_quality_is_one_of_five(qualifier, timing, now));
    }

    /// E2E-1b, E2E-1c, E2E-1e to E2E-1i, CMD-1b, CMD-1c, CMD-2b to CMD-2d, CMD-7a, CMD-7c, RULE-5a: one frame of any message after any history.
    #[test]
    fn every_property_of_a_frame_holds(
        message in select(Message::ALL), history in history(), timing in timing(), bytes in vec(any::<u8>(), BYTES),
        (counter, noise, dense, short) in (0..16_u8, any::<[u64; 4]>(), 0..8_u8, 0..20_u8), now in span(), later in span(),
    ) {
        let old = values(&bytes).unwrap_or(Values::NONE);
        let frame = |counter, payload| {
            let id = message.id_from(Source::MainController);
            Frame::new(id, message.protection().seal(id, payload, counter))
        };
        let (mut link, mut time) = (Link::new(message, timing), Millis::new(bytes.len().try_into().unwrap_or(0)));
        let mut current = 0;
        for (span, kind) in history {
            time = Millis::new(time.raw().wrapping_add(span));
            current = (current + kind) % message.protection().counts();
            let refused = u64::from(kind == 7) << 60;
            let _ = link.receive(time, &frame(current, write(message, &old) ^ refused), &mut { old });
        }
        let now = Millis::new(time.raw().wrapping_add(now));
        let [one, two, three, any] = noise;
        let payload = match dense {
            0 => any,
            1..=3 => write(message, &old) ^ one & two & three,
            _ => write(message, &old),
        };
        let counter = if counter < 12 { (current + counter % 5) % message.protection().counts() } else { counter };
        let sealed = if dense == 0 { Frame::new(message.id(), any) } else { frame(counter, payload) };
        let arrival = Arrival::of(message, link, now, Frame { length: if short == 0 { 7 } else { 8 }, ..sealed }, old);
        let broken = ALL.iter().find(|(_, holds)| !holds(&arrival)).map(|(name, _)| *name);
        assert_eq!(broken, None, "{message:?}");
        let later = Millis::new(now.raw().wrapping_add(later));
        assert!(cmd_2c_held_up_to_its_timeout(&arrival, timing.timeout, later));
        assert!(e2e_1i_our_own_signals(&arrival));
        assert!(message != Message::Ccvs1 || e2e_1i_wheel_speed(&arrival));
        assert!(message != Message::Ebc1 || e2e_1i_brake_switches(&arrival));
    }

    /// CMD-1a: identifiers near those of the table, and any.
    #[test]
    fn closed_table(id in any::<u32>(), message in select(Message::ALL), bit in 0..32_u32) {
        assert!(cmd_1a_closed_table(id) && cmd_1a_closed_table(message.id() ^ 1_u32.rotate_left(bit)));
        assert!(cmd_1a_closed_table(message.id()) && cmd_1a_closed_table(message.id_from(Source::Supervisor)));
    }

    /// CMD-3c: whatever is written is read again, of every message that is no part of a list.
    #[test]
    fn written_is_read(bytes in vec(any::<u8>(), BYTES)) {
        let values = values(&bytes);
        assert!(values.is_some());
        for message in Message::ALL.iter().copied() {
            let listed = matches!(message.destination(), Destination::Radar(_) | Destination::Camera(_));
            assert!(listed || cmd_3c_written_is_read(message, &values.unwrap_or(Values::NONE)), "{message:?}");
            assert!(listed || cmd_3c_outputs_come_back(message, &values.unwrap_or(Values::NONE)), "{message:?}");
        }
    }

    /// CMD-3e: counters of the outputs, cycle by cycle.
    #[test]
    fn counters_run_on(bytes in vec(any::<u8>(), BYTES), spans in vec((0..120_u32, any::<bool>()), 1..20)) {
        let outputs = [Outputs::NEUTRAL, values(&bytes).map_or(Outputs::NEUTRAL, |values| values.outputs)];
        let (mut sender, mut time) = (Sender::new(), Millis::ZERO);
        for (span, which) in spans {
            time = Millis::new(time.raw() + span);
            let outputs = &outputs[usize::from(which)];
            assert!(cmd_3e_counters_run_on(&sender, time, outputs));
            sender.encode_outputs(time, outputs, &mut |_| ());
        }
    }

    /// E2E-1d, RULE-6c: redundant inputs.
    #[test]
    fn redundant_known_only_while_agreed(bytes in vec(any::<u8>(), BYTES)) {
        let inputs = Inputs::arbitrary(&mut Unstructured::new(&bytes)).unwrap_or(Inputs::NEVER);
        assert!(e2e_1d_redundant_known_only_while_agreed(&inputs, &Config::DEFAULT));
    }
}
