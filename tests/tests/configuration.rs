//! The supervisor itself: sealed configuration (SELF-4).

mod common;
use common::*;

const FAST: SpeedKmhQ8 = kmh(50);

/// CRC-32 (IEEE 802.3), for bytes that are sealed by somebody else.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xEDB8_8320 } else { crc >> 1 })
    })
}

fn default_bytes() -> [u8; SEALED_BYTES] {
    let Ok(sealed) = Sealed::from_default() else { unreachable!("the table is valid") };
    sealed.to_bytes()
}

/// The default with one word replaced and sealed anew. Words 0 to 2 are the header.
fn with_word(index: usize, word: u32) -> Result<Sealed, ConfigError> {
    let mut bytes = default_bytes();
    bytes[index * 4..index * 4 + 4].copy_from_slice(&word.to_le_bytes());
    let crc = crc32(&bytes[..SEALED_BYTES - 4]);
    bytes[SEALED_BYTES - 4..].copy_from_slice(&crc.to_le_bytes());
    Sealed::from_sealed(&bytes)
}

/// SELF-4a: the sealed default starts, and is the default.
#[test]
fn the_sealed_default_starts() {
    let Ok(sealed) = Sealed::from_sealed(&default_bytes()) else { unreachable!("the default is valid") };
    assert_eq!(sealed.intact(), Some(&Config::DEFAULT));
    assert_eq!(Ok(sealed), Sealed::from_default());
}

/// SELF-4a, SELF-4d: every single flipped bit is refused.
#[test]
fn every_flipped_bit_of_the_sealed_bytes_is_refused() {
    let bytes = default_bytes();
    for index in 0..SEALED_BYTES {
        for bit in 0..8 {
            let mut flipped = bytes;
            flipped[index] ^= 1 << bit;
            assert!(Sealed::from_sealed(&flipped).is_err(), "byte {index} bit {bit}");
        }
    }
}

/// SELF-4a, SELF-4d: another length, nothing, another header, even with a right CRC.
#[test]
fn another_form_is_refused() {
    let bytes = default_bytes();
    let longer = [&bytes[..], &[0]].concat();
    for wrong in [&[][..], &bytes[..SEALED_BYTES - 1], &bytes[..SEALED_BYTES - 4], &longer] {
        assert_eq!(Sealed::from_sealed(wrong), Err(ConfigError::Length(wrong.len())));
    }
    for index in 0..3 {
        let mut word = [0; 4];
        word.copy_from_slice(&bytes[index * 4..index * 4 + 4]);
        for other in [0, u32::MAX, u32::from_le_bytes(word).wrapping_add(1)] {
            assert_eq!(with_word(index, other), Err(ConfigError::Header), "word {index}");
        }
    }
    assert!(Sealed::from_sealed(&[0; SEALED_BYTES]).is_err());
    assert!(Sealed::from_sealed(&[0xFF; SEALED_BYTES]).is_err());
}

/// SELF-4b, SELF-4d: one below and one above the range of every value is refused, by name; nothing outside starts.
#[test]
fn every_value_outside_its_range_is_refused_by_name() {
    let mut index = 3;
    for limit in LIMITS {
        for _ in 0..limit.count {
            for outside in [limit.least - 1, limit.greatest + 1] {
                // Signed values rest as two's complement in 16 bits; what does not fit the type is refused as a word.
                let signed = u16::try_from(outside).ok().map(u32::from);
                let negative = i16::try_from(outside).ok().map(|value| u32::from(value.cast_unsigned()));
                for word in [u32::try_from(outside).ok(), signed, negative].into_iter().flatten() {
                    let refused = with_word(index, word);
                    assert!(
                        matches!(refused, Err(ConfigError::Word)) || refused == Err(ConfigError::Range(limit.name)),
                        "{} = {outside}: {refused:?}",
                        limit.name
                    );
                }
            }
            assert!(with_word(index, u32::MAX).is_err(), "{}", limit.name);
            index += 1;
        }
    }
    assert_eq!((index + 1) * 4, SEALED_BYTES, "every word was tried");
}

/// SELF-4b: the edges of every range are in it (where no relation stands against them).
#[test]
fn the_edges_of_every_range_are_in_it() {
    let mut index = 3;
    for limit in LIMITS {
        for _ in 0..limit.count {
            for edge in [limit.least, limit.greatest] {
                let word = u32::try_from(edge).unwrap_or(0);
                let result = with_word(index, word);
                assert!(
                    !matches!(result, Err(ConfigError::Range(_) | ConfigError::Word)),
                    "{} = {edge}: {result:?}",
                    limit.name
                );
            }
            index += 1;
        }
    }
}

/// SELF-4b: the table names source and requirement of every limit, once.
#[test]
fn the_table_names_source_and_requirement_of_every_limit() {
    for (position, limit) in LIMITS.iter().enumerate() {
        assert!(!limit.source.is_empty() && !limit.requirement.is_empty() && !limit.unit.is_empty(), "{}", limit.name);
        assert!(limit.least <= limit.greatest, "{}", limit.name);
        assert!(limit.default.iter().all(|value| (limit.least..=limit.greatest).contains(value)), "{}", limit.name);
        assert!(LIMITS.iter().skip(position + 1).all(|other| other.name != limit.name), "{}", limit.name);
    }
}

/// SELF-4c, SELF-4d: relations: time-out > period, thresholds in order, no obligation beyond the cap.
#[test]
fn broken_relations_are_refused() {
    let default = Config::DEFAULT;
    let millis = Millis::new;
    let broken: Vec<(&str, Config)> = vec![
        ("time-outs rise", Config { timeout_50: millis(180), timeout_100: millis(150), ..default }),
        ("time-outs rise", Config { timeout_100: millis(500), timeout_200: millis(300), ..default }),
        ("levels fall", Config { level_ttc: Row([millis(3_600), millis(4_400), millis(2_700)]), ..default }),
        ("levels fall", Config { level_ttc: Row([millis(4_400), millis(2_700), millis(3_600)]), ..default }),
        ("demands rise", Config { level_decel: Row([ms2(250), ms2(100), ms2(500)]), ..default }),
        ("exit angle", Config { level_exit_angle: Row([angle(599), angle(900)]), ..default }),
        ("exit angle", Config { level_exit_angle: Row([angle(800), angle(699)]), ..default }),
        ("warning hysteresis", Config { forward_ttc: Row([millis(4_500), millis(4_000)]), ..default }),
        ("warning hysteresis", Config { pedestrian_ttc: Row([millis(4_501), millis(4_500)]), ..default }),
        (
            "comfort cap",
            Config { comfort_cap: DecelMs2Q11::new(12_288), brake_cap: DecelMs2Q11::new(10_240), ..default },
        ),
        (
            "overlay below takeover",
            Config { steering_overlay: hand_torque(3_000), takeover_torque: hand_torque(3_000), ..default },
        ),
        ("apply within hold", Config { epb_speed: kmh_q8(400), leave_hold_speed: kmh_q8(399), ..default }),
        ("freeze below vacancy", Config { seat_freeze: millis(500), seat_vacant: millis(500), ..default }),
        ("boot after confirmation", Config { boot_settle: millis(2_500), seat_confirm: millis(1_000), ..default }),
    ];
    for (name, config) in broken {
        assert!(matches!(Sealed::new(config), Err(ConfigError::Relation(_))), "{name}: {:?}", Sealed::new(config));
        assert!(!config.is_valid());
    }
    let Row(mut table) = default.leave_decel;
    table.swap(3, 4);
    assert!(matches!(Sealed::new(Config { leave_decel: Row(table), ..default }), Err(ConfigError::Relation(_))));
    let Row(mut map) = default.pedal_map;
    map.swap(3, 4);
    assert!(matches!(Sealed::new(Config { pedal_map: Row(map), ..default }), Err(ConfigError::Relation(_))));
    assert!(default.timeout_50 > default.cycle_greatest, "time-out > period");
}

/// SELF-4d: a camera that is turned by more than 45°, or a row of its rotation that is not of length 1, is refused; each alone.
#[test]
fn a_camera_that_does_not_look_ahead_is_refused() {
    // Rows to the right, down and ahead, with the element that must be long and one that fills the row up to length 1.
    let with = |row: usize, elements: [i16; 3]| {
        let Row(mut rotation) = Config::DEFAULT.camera_rotation;
        for (place, element) in elements.into_iter().enumerate() {
            rotation[row * 3 + place] = RotationQ14::new(element);
        }
        Config { camera_rotation: Row(rotation), ..Config::DEFAULT }
    };
    let rows = |long: i16, other: i16| [[other, -long, 0], [0, other, -long], [long, other, 0]];
    let told = Some("camera_rotation looks ahead, upright, its rows of length 1");
    for (row, name) in ["to the right", "down", "ahead"].into_iter().enumerate() {
        assert_eq!(with(row, rows(11_585, 11_585)[row]).broken_relation(), None, "{name}: turned by 45°");
        assert_eq!(with(row, rows(11_584, 11_587)[row]).broken_relation(), told, "{name}: turned by more");
        assert_eq!(with(row, rows(-16_384, 0)[row]).broken_relation(), told, "{name}: the other way");
        // Squares of 2^28 ± 1 %.
        assert_eq!(with(row, rows(16_302, 0)[row]).broken_relation(), None, "{name}: shrinks by half a per cent");
        assert_eq!(with(row, rows(16_301, 0)[row]).broken_relation(), told, "{name}: shrinks by more");
        assert_eq!(with(row, rows(16_384, 1_638)[row]).broken_relation(), None, "{name}: stretches by half a per cent");
        assert_eq!(with(row, rows(16_384, 1_639)[row]).broken_relation(), told, "{name}: stretches by more");
    }
}

/// SELF-4d: what was refused is told with its name.
#[test]
fn a_refusal_says_what_it_refuses() {
    for (error, told) in [
        (ConfigError::Length(7), "7 bytes"),
        (ConfigError::Header, "version"),
        (ConfigError::Crc, "CRC"),
        (ConfigError::Word, "no value"),
        (ConfigError::Range("mild"), "mild is out of range"),
        (ConfigError::Relation("a <= b"), "does not hold: a <= b"),
    ] {
        assert!(error.to_string().contains(told), "{error}");
    }
}

/// SELF-4e: the digest of the configuration begins with all bits set: memory that was cleared, digest and all, does not agree with itself.
#[test]
fn the_digest_of_cleared_memory_is_not_zero() {
    let fold = |words: &[u32]| words.iter().fold(u32::MAX, |digest, word| digest.rotate_left(5) ^ word);
    let Ok(sealed) = Sealed::from_default() else { unreachable!("the table is valid") };
    let mut words = Vec::new();
    Config::DEFAULT.write(&mut |word| words.push(word));
    let text = format!("{sealed:?}");
    assert!(text.ends_with(&format!("digest: {} }}", fold(&words))), "{text}");
    words.fill(0);
    assert_ne!(fold(&words), 0);
    for bit in 0..32 {
        let flipped = sealed.with_flipped_digest(bit);
        assert_eq!((flipped.intact(), flipped.with_flipped_digest(bit)), (None, sealed), "bit {bit}");
    }
}

/// SELF-4e, SELF-5b: a configuration that changes while it is used is the safe state, latched.
#[test]
fn a_configuration_that_changes_is_the_safe_state() {
    let Ok(sealed) = Sealed::from_default() else { unreachable!("the table is valid") };
    for bit in 0..32 {
        let changed = sealed.with_flipped_digest(bit);
        assert_eq!(changed.intact(), None);
        let mut bus = Bus::with_sealed(&changed, ResetCause::PowerOn, Some(Record::None), healthy());
        let decision = bus.step();
        assert!(decision.status.safe_state && decision.status.faults.contains(Faults::CONFIGURATION), "bit {bit}");
        assert!(bus.run_for(1_000).status.safe_state);
    }
}

/// SELF-4f: with the widest valid values of every single limit the release, the contactors and P stay guarded.
#[test]
fn no_valid_configuration_is_an_off_switch() {
    let mut index = 3;
    for limit in LIMITS {
        for _ in 0..limit.count {
            for edge in [limit.least, limit.greatest] {
                let Ok(sealed) = with_word(index, u32::try_from(edge).unwrap_or(0)) else { continue };
                let inputs = Inputs { seat: [known(Seat::Vacant); 2], ..healthy() };
                let mut bus = Bus::with_sealed(&sealed, ResetCause::PowerOn, Some(Record::None), inputs);
                bus.speed(FAST);
                bus.ask_epb(EpbRequest::Release);
                bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Open);
                bus.ask_gear(GearRequest::Park);
                bus.ask_torque(100);
                for _ in 0..300 {
                    let outputs = bus.step_unjudged(CYCLE).outputs;
                    assert_ne!(outputs.epb.request, EpbRequest::Release, "{}", limit.name);
                    assert_eq!(outputs.contactors, Contactors::NEUTRAL, "{}", limit.name);
                    assert_ne!(outputs.gear, GearRequest::Park, "{}", limit.name);
                    assert_eq!(outputs.drive.torque, Percent::ZERO, "{}", limit.name);
                }
            }
            index += 1;
        }
    }
}
