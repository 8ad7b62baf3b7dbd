//! Structures of known size that the caller places.

use core::mem::MaybeUninit;

use super::status::{Refused, Status, usable};

/// The words of an experiment on board. Begin it before any other call; it may be copied and moved, but not shared between
/// threads without a lock.
#[repr(C)]
pub struct ExperimentF64 {
    /// Not for the caller.
    words: [u64; 128],
}

/// The words of an experiment on board in single precision.
#[repr(C)]
pub struct ExperimentF32 {
    /// Not for the caller.
    words: [u64; 72],
}

/// The words of a controller. Begin it before any other call; as for an experiment.
#[repr(C)]
pub struct ControllerF64 {
    /// Not for the caller.
    words: [u64; 40],
}

/// The words of a controller in single precision.
#[repr(C)]
pub struct ControllerF32 {
    /// Not for the caller.
    words: [u64; 24],
}

/// Place for one value, and the mark of one that was begun.
pub(crate) trait Place: Sized {
    type Held: Copy;
    const MARK: u64;
}

macro_rules! places {
    ($($place:ident: $held:ty = $mark:literal),+ $(,)?) => { $(
        impl Place for $place {
            type Held = $held;
            const MARK: u64 = u64::from_be_bytes(*$mark);
        }
        const _: () = {
            assert!(size_of::<Begun<$held>>() <= size_of::<$place>());
            assert!(align_of::<Begun<$held>>() <= align_of::<$place>());
        };
    )+ };
}
places! {
    ExperimentF64: selfosc::on_board::Experiment<f64> = b"exper-64",
    ExperimentF32: selfosc::on_board::Experiment<f32> = b"exper-32",
    ControllerF64: selfosc::control::Controller<f64> = b"contr-64",
    ControllerF32: selfosc::control::Controller<f32> = b"contr-32",
}

/// What stands in the caller's words.
#[repr(C)]
struct Begun<H> {
    mark: u64,
    held: MaybeUninit<H>,
}

/// Puts a value into its place.
///
/// # Safety
/// The pointer is null or good for one value of its type.
pub(crate) unsafe fn begin<P: Place>(place: *mut P, held: P::Held) -> Result<(), Refused> {
    if !usable(place) {
        return Err(Status::BadPointer.into());
    }
    // SAFETY: neither null nor misaligned, and the place is at least as large and as aligned as what is written.
    unsafe { place.cast::<Begun<P::Held>>().write(Begun { mark: P::MARK, held: MaybeUninit::new(held) }) };
    Ok(())
}

/// The value in its place, once it was begun.
///
/// # Safety
/// The pointer is null or good for one value of its type, and nobody else uses that meanwhile.
pub(crate) unsafe fn held<'a, P: Place>(place: *mut P) -> Result<&'a mut P::Held, Refused> {
    if !usable(place) {
        return Err(Status::BadPointer.into());
    }
    // SAFETY: neither null nor misaligned; any words are a mark and what may be no value yet.
    let begun = unsafe { &mut *place.cast::<Begun<P::Held>>() };
    if begun.mark != P::MARK {
        return Err(Status::NotBegun.into());
    }
    // SAFETY: what bears the mark was written by `begin`.
    Ok(unsafe { begun.held.assume_init_mut() })
}
