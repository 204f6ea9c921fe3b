//! Files of the host, by semihosting: where golden vectors come from. A firmware in a bus has none of this.
#![allow(unsafe_code, reason = "a call of the debugger is an instruction with an address in a register")]

use core::ffi::CStr;

use cortex_m_semihosting::{nr, syscall};

/// A file that is read from begin to end.
pub struct File {
    handle: usize,
    buffer: [u8; 4096],
    filled: usize,
    taken: usize,
}

impl File {
    /// Opens it; `None` if there is none.
    pub fn open(name: &CStr) -> Option<Self> {
        let block = [name.as_ptr().addr(), nr::open::R_BINARY, name.count_bytes()];
        // SAFETY: the block has what the call reads (Arm's semihosting: name, mode, length), and the name outlives it.
        let handle = unsafe { syscall!(OPEN, block[0], block[1], block[2]) };
        (handle != usize::MAX).then_some(Self { handle, buffer: [0; 4096], filled: 0, taken: 0 })
    }

    /// The next bytes, or `None` at the end.
    pub fn read<const COUNT: usize>(&mut self) -> Option<[u8; COUNT]> {
        let mut bytes = [0; COUNT];
        for byte in &mut bytes {
            if self.taken == self.filled {
                let block = [self.handle, self.buffer.as_mut_ptr().addr(), self.buffer.len()];
                // SAFETY: the debugger writes into the buffer, no more than its length; the answer is what is missing.
                let missing = unsafe { syscall!(READ, block[0], block[1], block[2]) };
                (self.filled, self.taken) = (self.buffer.len().checked_sub(missing)?, 0);
                if self.filled == 0 {
                    return None;
                }
            }
            *byte = *self.buffer.get(self.taken)?;
            self.taken += 1;
        }
        Some(bytes)
    }

    /// Closes it.
    pub fn close(self) {
        let handle = self.handle;
        // SAFETY: the handle is that of an open file, and nobody has it afterwards.
        let _ = unsafe { syscall!(CLOSE, handle) };
    }
}
