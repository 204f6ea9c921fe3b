//! Automatic steering (STR).

use super::{Property, all};

/// Every property of this file.
pub const ALL: &[Property] = all![];
