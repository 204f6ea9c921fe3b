//! Program flow (SELF-6): a signature over the stages of a cycle, and the answer to the watchdog that needs it.
//!
//! The watchdog is that of a safety SBC such as TLF35584: it asks one of 16 questions and takes four response bytes.
//! The bytes come out right only if every stage ran once and in order: what the signature differs by goes into them.

use core::hint::black_box;

use crate::word::{Word, codes};

codes! {
    /// A stage of the cycle, in the order in which they run.
    Checkpoint {
        /// Object lists became a threat.
        Perceive = 0,
        /// The retained state was decoded.
        Decode = 1,
        /// The configuration was checked.
        Configuration = 2,
        /// Actuators were compared with what they were told.
        Observe = 3,
        /// The envelope was made.
        Decide = 4,
        /// Every channel was vetted.
        Vet = 5,
        /// The outputs were recorded in the state.
        Record = 6,
        /// The state was put to rest.
        Encode = 7,
    }
}

/// Third response byte to each question; the others differ from it by [`OTHERS`].
/// Source: public data sheets of question-and-answer watchdogs (TLF35584, TCAN1465-Q1) agree on this table.
const RESPONSE: [u8; 16] =
    [0xFF, 0xB0, 0xE9, 0xA6, 0x75, 0x3A, 0x63, 0x2C, 0xD2, 0x9D, 0xC4, 0x8B, 0x58, 0x17, 0x4E, 0x01];
/// The response bytes in the order in which they are sent (3, 2, 1, 0), each as its difference from the third.
const OTHERS: [u8; 4] = [0x00, 0xF0, 0x0F, 0xFF];

/// The signature of the stages so far. Order counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Flow(u32);

impl Flow {
    /// No stage has run.
    pub const START: Self = Self(0x6A09_E667);
    /// Perception has run: for a caller that has its threat from elsewhere.
    pub const PERCEIVED: Self = Self::START.mixed(Checkpoint::Perceive);
    /// Every stage up to the record has run once and in order: what rests in the state.
    pub const RECORDED: Self = Self::PERCEIVED
        .mixed(Checkpoint::Decode)
        .mixed(Checkpoint::Configuration)
        .mixed(Checkpoint::Observe)
        .mixed(Checkpoint::Decide)
        .mixed(Checkpoint::Vet)
        .mixed(Checkpoint::Record);
    /// Every stage has run once and in order.
    pub const COMPLETE: Self = Self::RECORDED.mixed(Checkpoint::Encode);

    /// Multiplication by an odd number, rotation and exclusive or are each reversible: two signatures that differ
    /// stay different whatever runs after.
    const fn mixed(self, checkpoint: Checkpoint) -> Self {
        const FACTOR: u32 = 0x9E37_79B1;
        let code = 0x0100_0193_u32.rotate_left(Self::turn(checkpoint));
        Self((self.0 ^ code).wrapping_mul(FACTOR).rotate_left(13))
    }

    const fn turn(checkpoint: Checkpoint) -> u32 {
        match checkpoint {
            Checkpoint::Perceive => 1,
            Checkpoint::Decode => 4,
            Checkpoint::Configuration => 7,
            Checkpoint::Observe => 10,
            Checkpoint::Decide => 13,
            Checkpoint::Vet => 16,
            Checkpoint::Record => 19,
            Checkpoint::Encode => 22,
        }
    }

    /// A stage has run. The compiler is kept from computing the end result beforehand.
    #[must_use]
    pub fn pass(self, checkpoint: Checkpoint) -> Self {
        Self(black_box(self.0)).mixed(checkpoint)
    }

    /// The four bytes for the watchdog's question (its low four bits), in the order in which they are sent.
    /// Right only for [`COMPLETE`](Self::COMPLETE): any other signature changes at least one byte.
    #[must_use]
    pub fn answer(self, question: u8) -> [u8; 4] {
        let third = RESPONSE.get(usize::from(question & 15)).copied().unwrap_or(0);
        let [first, second, last, end] = (self.0 ^ Self::COMPLETE.0).to_le_bytes();
        let [zero, one, two, three] = OTHERS;
        [third ^ zero ^ first, third ^ one ^ second, third ^ two ^ last, third ^ three ^ end]
    }
}

impl Word for Flow {
    fn to_word(self) -> u32 {
        self.0
    }
    fn from_word(word: u32) -> Option<Self> {
        Some(Self(word))
    }
}
