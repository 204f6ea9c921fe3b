//! Properties and harnesses.
