//! Collision mitigation: latches and warnings (MIT, FCW, PCW).

use super::{Property, all};

/// Every property of this file.
pub const ALL: &[Property] = all![];
