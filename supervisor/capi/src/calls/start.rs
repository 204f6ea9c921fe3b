//! Start after a reset.
#![expect(unsafe_code, reason = "C calls these functions by their names and with pointers")]

use core::mem::MaybeUninit;

use supervisor::wire::{Receiver, Sender};
use supervisor::{Config, ConfigError, Record, ResetCause, Sealed, Supervisor};

use super::code;
use crate::codes::SupervisorCode;
use crate::diagnosis::Diagnosis;
use crate::memory::{Input, Place, disjoint};
use crate::state::State;
use crate::types::{SUPERVISOR_ABI_VERSION, SupervisorDiagnosis, SupervisorState};

/// Stands for a `SupervisorRecord` that fails its CRC when it is read back. Never given by a step.
pub const SUPERVISOR_RECORD_BROKEN: u8 = 255;

/// Starts a supervisor in the caller's memory (SELF-9). Once after every reset; whatever the memory held is given up.
///
/// `bytes` is `sizeof` the state, `abi_version` is `SUPERVISOR_ABI_VERSION`, `reset_cause` a `SupervisorResetCause`,
/// `record` the `SupervisorRecord` that was persisted, or `SUPERVISOR_RECORD_BROKEN` if it fails its CRC. The
/// configuration is copied: `supervise config seal` makes the bytes. If it is refused there is no supervisor: every
/// later call with this state is refused, too.
///
/// # Safety
/// `state` leads to writable memory of `bytes` bytes that was written at least once (zeros will do), `sealed` to
/// `sealed_bytes` readable ones.
#[must_use]
// SAFETY: no other function of the program has this name; it begins with that of the library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn supervisor_init(
    state: *mut SupervisorState,
    bytes: usize,
    abi_version: u32,
    sealed: *const u8,
    sealed_bytes: usize,
    reset_cause: u8,
    record: u8,
) -> SupervisorCode {
    code(|| {
        fits::<SupervisorState>(bytes, abi_version)?;
        // SAFETY: promised by the caller, and `bytes` are enough.
        let place = unsafe { Place::<State>::new(state) }?;
        place.clear();
        // SAFETY: promised by the caller.
        let sealed = unsafe { Input::new(sealed, sealed_bytes) }?;
        disjoint(&[place.span(), sealed.span()])?;
        let cause = ResetCause::from_code(reset_cause).ok_or(SupervisorCode::Value)?;
        let record = match record {
            SUPERVISOR_RECORD_BROKEN => None,
            record => Some(Record::from_code(record).ok_or(SupervisorCode::Value)?),
        };
        let sealed = Sealed::from_sealed(sealed.values()).map_err(refused)?;
        place.keep(|slot| build(slot, &sealed, cause, record));
        Ok(SupervisorCode::Ok)
    })
}

/// On its own, so that the compiler writes into the slot and not past the stack.
#[inline(never)]
fn build<'s>(
    slot: &'s mut MaybeUninit<State>,
    sealed: &Sealed,
    cause: ResetCause,
    record: Option<Record>,
) -> &'s mut State {
    let receiver = Receiver::new(sealed.intact().unwrap_or(&Config::DEFAULT));
    slot.write(State {
        supervisor: Supervisor::new(*sealed, cause, record),
        receiver,
        sender: Sender::new(),
        last: None,
    })
}

/// Starts a diagnosis in the caller's memory: nothing has happened yet.
///
/// # Safety
/// `diagnosis` leads to writable memory of `bytes` bytes that was written at least once (zeros will do).
#[must_use]
// SAFETY: no other function of the program has this name; it begins with that of the library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn supervisor_diagnosis_init(
    diagnosis: *mut SupervisorDiagnosis,
    bytes: usize,
    abi_version: u32,
) -> SupervisorCode {
    code(|| {
        fits::<SupervisorDiagnosis>(bytes, abi_version)?;
        // SAFETY: promised by the caller, and `bytes` are enough.
        unsafe { Place::<Diagnosis>::new(diagnosis) }?.keep(|slot| slot.write(Diagnosis::new()));
        Ok(SupervisorCode::Ok)
    })
}

fn fits<M>(bytes: usize, abi_version: u32) -> Result<(), SupervisorCode> {
    if abi_version != SUPERVISOR_ABI_VERSION {
        Err(SupervisorCode::Version)
    } else if bytes < size_of::<M>() {
        Err(SupervisorCode::Size)
    } else {
        Ok(())
    }
}

fn refused(error: ConfigError) -> SupervisorCode {
    match error {
        ConfigError::Length(_) => SupervisorCode::ConfigLength,
        ConfigError::Header => SupervisorCode::ConfigHeader,
        ConfigError::Crc => SupervisorCode::ConfigCrc,
        ConfigError::Word => SupervisorCode::ConfigWord,
        ConfigError::Range(_) => SupervisorCode::ConfigRange,
        ConfigError::Relation(_) => SupervisorCode::ConfigRelation,
    }
}
