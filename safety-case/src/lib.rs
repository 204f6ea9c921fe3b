//! Safety analysis and host tools.
