//! What is assumed of Rust's own library beyond the contracts of `creusot-std`: narrowing tells whether a value fits.
//!
//! `tests/library.rs` tries these statements on the real library.

use core::num::TryFromIntError;
use creusot_std::prelude::*;

extern_spec! {
    impl TryFrom<u16> for u8 {
        #[check(ghost)]
        #[ensures(match result { Ok(narrow) => narrow@ == wide@, Err(_) => wide@ > u8::MAX@ })]
        fn try_from(wide: u16) -> Result<u8, TryFromIntError>;
    }

    impl TryFrom<u32> for u16 {
        #[check(ghost)]
        #[ensures(match result { Ok(narrow) => narrow@ == wide@, Err(_) => wide@ > u16::MAX@ })]
        fn try_from(wide: u32) -> Result<u16, TryFromIntError>;
    }

    impl TryFrom<u64> for u16 {
        #[check(ghost)]
        #[ensures(match result { Ok(narrow) => narrow@ == wide@, Err(_) => wide@ > u16::MAX@ })]
        fn try_from(wide: u64) -> Result<u16, TryFromIntError>;
    }
}
