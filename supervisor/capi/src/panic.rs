//! What the compiler asks for in a static library without a standard library. No code of the supervisor reaches it
//! (SELF-1b): `tests/library.rs` looks for a panic in the linked program.

use core::panic::PanicInfo;

/// Does nothing more: no frame goes out and the watchdog is not answered.
#[panic_handler]
fn halt(_: &PanicInfo<'_>) -> ! {
    loop {
        core::hint::spin_loop();
    }
}
