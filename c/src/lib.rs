//! Routines of `selfosc` for controllers, callable from C and C++; `include/selfosc.h` and `README.md` are for who calls them.
//!
//! | file | content |
//! |---|---|
//! | `f64`, `f32` | what C calls: one line for each function and precision; the second is made from the first |
//! | `routines` | the same over either precision |
//! | `values` | plain structures that go in and out |
//! | `status` | what a call answers, and why it refuses |
//! | `placed` | structures of known size that the caller places |
#![no_std]
#![allow(clippy::missing_safety_doc, reason = "what a pointer has to be is said once, in the header's guide")]

mod f32;
mod f64;
mod placed;
mod routines;
mod status;
mod values;

unsafe extern "C" {
    /// Nowhere defined: a program in which any way leads to a panic does not link.
    safe fn selfosc_would_panic() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    selfosc_would_panic()
}

// On systems with unwinding the compiler's own routines name this one; nothing here unwinds. Weak, so that a program may have
// its own.
#[cfg(target_os = "linux")]
core::arch::global_asm!(".weak rust_eh_personality", "rust_eh_personality:");

use status::{Refusal, Status};
use values::Parameter;

/// The parameter with this index, from 0, of one of `SelfoscCharacteristic`; `SELFOSC_STATUS_WRONG_COUNT` after the last one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_parameter(characteristic: u32, index: usize, result: *mut Parameter) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    unsafe {
        status::answer::<Parameter>(result, core::ptr::null_mut::<Refusal>(), || {
            routines::parameter(characteristic, index)
        })
    }
}

/// For `check.sh`: panics.
///
/// cbindgen:ignore
#[cfg(feature = "panics")]
#[unsafe(no_mangle)]
pub extern "C" fn selfosc_panics(index: usize) -> u8 {
    *b"panic".get(index).expect("out of bounds")
}
