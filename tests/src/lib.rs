//! Closed-loop bus model and drives.
