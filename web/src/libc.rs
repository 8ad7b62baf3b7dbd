//! Functions of C that the standard library links and that Debian's `wasi-libc` has not: a module has one thread and no such files.

use core::ffi::{c_char, c_int, c_void};
use core::ptr::null_mut;

/// `ENOTSUP` of WASI.
const NOT_SUPPORTED: c_int = 58;

/// The error of the last call.
struct Errno(core::cell::UnsafeCell<c_int>);

// SAFETY: a module has one thread.
unsafe impl Sync for Errno {}

static ERRNO: Errno = Errno(core::cell::UnsafeCell::new(0));

#[unsafe(no_mangle)]
extern "C" fn __errno_location() -> *mut c_int {
    ERRNO.0.get()
}

/// Whoever asks for a thread does the work on this one.
#[unsafe(no_mangle)]
extern "C" fn pthread_create(_: *mut c_void, _: *const c_void, _: *const c_void, _: *mut c_void) -> c_int {
    NOT_SUPPORTED
}

#[unsafe(no_mangle)]
extern "C" fn pthread_join(_: *mut c_void, _: *mut *mut c_void) -> c_int {
    NOT_SUPPORTED
}

#[unsafe(no_mangle)]
extern "C" fn pthread_detach(_: *mut c_void) -> c_int {
    NOT_SUPPORTED
}

#[unsafe(no_mangle)]
extern "C" fn pthread_attr_init(_: *mut c_void) -> c_int {
    0
}

#[unsafe(no_mangle)]
extern "C" fn pthread_attr_setstacksize(_: *mut c_void, _: usize) -> c_int {
    0
}

#[unsafe(no_mangle)]
extern "C" fn pthread_attr_destroy(_: *mut c_void) -> c_int {
    0
}

/// No path has another name.
#[unsafe(no_mangle)]
extern "C" fn realpath(_: *const c_char, _: *mut c_char) -> *mut c_char {
    __set_errno(NOT_SUPPORTED);
    null_mut()
}

/// No file has permissions.
#[unsafe(no_mangle)]
extern "C" fn fchmod(_: c_int, _: u32) -> c_int {
    0
}

fn __set_errno(error: c_int) {
    // SAFETY: a module has one thread, and nobody holds a reference to the cell.
    unsafe { *ERRNO.0.get() = error }
}
