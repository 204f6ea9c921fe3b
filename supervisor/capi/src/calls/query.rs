//! The numbers of the header, as the library has them: an integrator compares both at start.
#![expect(unsafe_code, reason = "C calls these functions by their names")]

use crate::types::{
    SUPERVISOR_ABI_VERSION, SUPERVISOR_OUTPUT_FRAMES, SUPERVISOR_SEALED_BYTES, SupervisorDiagnosis, SupervisorState,
};

/// The version of the library's interface; that of the header is `SUPERVISOR_ABI_VERSION`.
#[must_use]
// SAFETY: no other function of the program has this name; it begins with that of the library. So below.
#[unsafe(no_mangle)]
pub extern "C" fn supervisor_abi_version() -> u32 {
    SUPERVISOR_ABI_VERSION
}

/// Bytes of a `SupervisorState`.
#[must_use]
// SAFETY: see `supervisor_abi_version`.
#[unsafe(no_mangle)]
pub extern "C" fn supervisor_state_bytes() -> usize {
    size_of::<SupervisorState>()
}

/// Alignment of a `SupervisorState`.
#[must_use]
// SAFETY: see `supervisor_abi_version`.
#[unsafe(no_mangle)]
pub extern "C" fn supervisor_state_alignment() -> usize {
    align_of::<SupervisorState>()
}

/// Bytes of a `SupervisorDiagnosis`.
#[must_use]
// SAFETY: see `supervisor_abi_version`.
#[unsafe(no_mangle)]
pub extern "C" fn supervisor_diagnosis_bytes() -> usize {
    size_of::<SupervisorDiagnosis>()
}

/// Alignment of a `SupervisorDiagnosis`.
#[must_use]
// SAFETY: see `supervisor_abi_version`.
#[unsafe(no_mangle)]
pub extern "C" fn supervisor_diagnosis_alignment() -> usize {
    align_of::<SupervisorDiagnosis>()
}

/// Bytes of a sealed configuration.
#[must_use]
// SAFETY: see `supervisor_abi_version`.
#[unsafe(no_mangle)]
pub extern "C" fn supervisor_sealed_bytes() -> usize {
    SUPERVISOR_SEALED_BYTES
}

/// How many frames a step gives at most.
#[must_use]
// SAFETY: see `supervisor_abi_version`.
#[unsafe(no_mangle)]
pub extern "C" fn supervisor_output_frames() -> usize {
    SUPERVISOR_OUTPUT_FRAMES
}
