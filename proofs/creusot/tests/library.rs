//! Tries what `src/library.rs` assumes of Rust's library.

/// All of 16 bits into 8.
#[test]
fn narrowing_to_8_bits_tells_whether_it_fits() {
    for wide in 0..=u16::MAX {
        match u8::try_from(wide) {
            Ok(narrow) => assert_eq!(u16::from(narrow), wide),
            Err(_) => assert!(wide > u16::from(u8::MAX)),
        }
    }
}

/// Into 16 bits: all that fit, as many that do not, and each single higher bit.
#[test]
fn narrowing_to_16_bits_tells_whether_it_fits() {
    let bits = (16..64).flat_map(|bit| [0, 1, u64::from(u16::MAX)].map(|low| (1_u64 << bit) | low));
    for wide in (0..=2 * u64::from(u16::MAX)).chain(bits).chain([u64::from(u32::MAX), u64::MAX]) {
        let fits = wide <= u64::from(u16::MAX);
        assert_eq!(u16::try_from(wide).map(u64::from).ok(), fits.then_some(wide));
        if let Ok(wide) = u32::try_from(wide) {
            assert_eq!(u16::try_from(wide).map(u32::from).ok(), fits.then_some(wide));
        }
    }
}
