//! Retained values at rest: every field is one `u32` word.
//!
//! Rust may assume that a `bool` or an enum in memory is never out of range, so a check on those types would be
//! compiled away. State and configuration therefore rest as integers; reading them back is a decoding that can fail.

/// A value that rests as one 32-bit word.
pub trait Word: Copy {
    /// The word at rest.
    fn to_word(self) -> u32;
    /// The value, or `None` if no value of this type rests as `word`.
    fn from_word(word: u32) -> Option<Self>;
}

impl Word for bool {
    fn to_word(self) -> u32 {
        u32::from(self)
    }
    fn from_word(word: u32) -> Option<Self> {
        match word {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }
}

impl Word for u32 {
    fn to_word(self) -> u32 {
        self
    }
    fn from_word(word: u32) -> Option<Self> {
        Some(word)
    }
}

impl Word for u8 {
    fn to_word(self) -> u32 {
        u32::from(self)
    }
    fn from_word(word: u32) -> Option<Self> {
        Self::try_from(word).ok()
    }
}

impl Word for u16 {
    fn to_word(self) -> u32 {
        u32::from(self)
    }
    fn from_word(word: u32) -> Option<Self> {
        Self::try_from(word).ok()
    }
}

/// `None` rests as the one word that no [`codes!`](crate::codes) value rests as; for those alone.
impl<T: Word> Word for Option<T> {
    fn to_word(self) -> u32 {
        self.map_or(u32::MAX, T::to_word)
    }
    fn from_word(word: u32) -> Option<Self> {
        if word == u32::MAX { Some(None) } else { T::from_word(word).map(Some) }
    }
}

/// A fixed sequence of words: a machine's state, a configuration, an array of either.
pub trait Words: Sized {
    /// How many words it takes.
    const COUNT: usize;
    /// Hands out every word, in order.
    fn write(&self, sink: &mut impl FnMut(u32));
    /// Takes every word back, in the same order; `None` at the first one that decodes to nothing.
    fn read(source: &mut impl FnMut() -> Option<u32>) -> Option<Self>;
}

impl<T: Word> Words for T {
    const COUNT: usize = 1;
    fn write(&self, sink: &mut impl FnMut(u32)) {
        sink(self.to_word());
    }
    fn read(source: &mut impl FnMut() -> Option<u32>) -> Option<Self> {
        T::from_word(source()?)
    }
}

/// Gives plain enums their stable codes: `code`, `from_code`, `ALL`, and the word at rest.
#[macro_export]
macro_rules! codes {
    ($($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $code:literal,)+ })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        pub enum $name { $($(#[$variant_doc])* $variant,)+ }

        impl $name {
            /// Every value, in the order of the codes.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)+];
            /// The stable code of this value.
            #[must_use]
            pub const fn code(self) -> u8 {
                match self { $(Self::$variant => $code,)+ }
            }
            /// The value with this code; `None` for every other number (closed world).
            #[must_use]
            pub const fn from_code(code: u8) -> Option<Self> {
                match code { $($code => Some(Self::$variant),)+ _ => None }
            }
        }

        impl $crate::word::Word for $name {
            fn to_word(self) -> u32 {
                u32::from(self.code())
            }
            fn from_word(word: u32) -> Option<Self> {
                Self::from_code(u8::try_from(word).ok()?)
            }
        }
    )*};
}
pub use codes;

/// Declares one machine's retained state: fields with their value after reset, and their words at rest.
#[macro_export]
macro_rules! retained {
    ($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $type:ty = $initial:expr,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        pub struct $name { $($(#[$field_doc])* pub $field: $type,)+ }

        impl $name {
            /// The state after reset.
            pub const INITIAL: Self = Self { $($field: $initial,)+ };
        }

        impl $crate::word::Words for $name {
            const COUNT: usize = 0 $(+ <$type as $crate::word::Words>::COUNT)+;
            #[expect(clippy::inline_always, reason = "measured: decoding the state costs half when it is one piece")]
            #[inline(always)]
            fn write(&self, sink: &mut impl FnMut(u32)) {
                $(self.$field.write(sink);)+
            }
            #[expect(clippy::inline_always, reason = "measured: decoding the state costs half when it is one piece")]
            #[inline(always)]
            fn read(source: &mut impl FnMut() -> Option<u32>) -> Option<Self> {
                Some(Self { $($field: <$type as $crate::word::Words>::read(source)?,)+ })
            }
        }
    };
}
pub use retained;

/// Permitted when every condition holds; refused with the reason beside the first that does not.
#[macro_export]
macro_rules! permit {
    ($($condition:expr => $reason:expr),+ $(,)?) => {
        $(if !$condition { Err($reason) } else)+ { Ok(()) }
    };
}
pub use permit;
