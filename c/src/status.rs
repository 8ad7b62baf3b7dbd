//! What a call answers, and why it refuses.

use core::ffi::c_char;
use core::ptr::null;

use selfosc::control::ControlError;
use selfosc::describing::DescribingError;
use selfosc::identify::IdentifyError;
use selfosc::nonlinearity::NonlinearityError;
use selfosc::numeric::OutOfDomain;
use selfosc::orbit::OrbitError;
use selfosc::plant::PlantError;
use selfosc::vehicle::VehicleError;

/// What every function answers. Unless it is `SELFOSC_STATUS_OK`, no result was written.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Results are written.
    Ok = 0,
    /// A pointer that must not be null is, or is not aligned as its type is.
    BadPointer = 1,
    /// A structure was not begun.
    NotBegun = 2,
    /// A number chooses nothing: characteristic, coordinate, structure of the controller, drag law.
    UnknownChoice = 3,
    /// More or fewer parameters than the characteristic has.
    WrongCount = 4,
    /// A number is outside its domain: the refusal says which.
    OutOfDomain = 5,
    /// There is no answer: the refusal says why.
    Refused = 6,
    /// The experiment is not done, so it has no outcome.
    NotDone = 7,
}

/// Characters without a zero at their end: `printf("%.*s", (int)text.length, text.bytes)`. They stay for good.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Text {
    /// The first character; null where there is none.
    pub bytes: *const c_char,
    /// How many there are.
    pub length: usize,
}

/// Why a call was refused.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Refusal {
    /// Short name of the reason: `out-of-domain`, `below-switching`, ...
    pub code: Text,
    /// The quantity outside its domain; none for other reasons.
    pub quantity: Text,
    /// Its value.
    pub value: f64,
    /// Its unit.
    pub unit: Text,
    /// What to do.
    pub remedy: Text,
}

impl Text {
    pub(crate) const NONE: Self = Self { bytes: null(), length: 0 };

    pub(crate) fn of(text: &'static str) -> Self {
        Self { bytes: text.as_ptr().cast(), length: text.len() }
    }
}

/// A call that gives nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Refused {
    pub(crate) status: Status,
    pub(crate) why: Refusal,
}

impl From<Status> for Refused {
    fn from(status: Status) -> Self {
        Self { status, why: Refusal::without_number("") }
    }
}

impl Refusal {
    fn without_number(code: &'static str) -> Self {
        let none = Text::NONE;
        Self { code: Text::of(code), quantity: none, value: 0.0, unit: none, remedy: none }
    }

    fn of(code: &'static str, fault: &OutOfDomain) -> Self {
        Self {
            code: Text::of(code),
            quantity: Text::of(fault.quantity),
            value: fault.value,
            unit: Text::of(fault.unit),
            remedy: Text::of(fault.remedy),
        }
    }
}

impl From<OutOfDomain> for Refused {
    fn from(fault: OutOfDomain) -> Self {
        Self { status: Status::OutOfDomain, why: Refusal::of("out-of-domain", &fault) }
    }
}

macro_rules! refusals {
    ($($error:ty),+) => { $(
        impl From<$error> for Refused {
            fn from(error: $error) -> Self {
                match error.out_of_domain() {
                    Some(fault) => Self { status: Status::OutOfDomain, why: Refusal::of(error.code(), fault) },
                    None => Self { status: Status::Refused, why: Refusal::without_number(error.code()) },
                }
            }
        }
    )+ };
}
refusals!(ControlError, DescribingError, IdentifyError, NonlinearityError, OrbitError, PlantError, VehicleError);

/// Writes the answer where the caller wants it, and the reason where there is none.
///
/// # Safety
/// Each pointer is null or good for one value of its type.
pub(crate) unsafe fn answer<R>(
    result: *mut R,
    refusal: *mut Refusal,
    call: impl FnOnce() -> Result<R, Refused>,
) -> Status {
    if !usable(result) {
        return Status::BadPointer;
    }
    match call() {
        Ok(value) => {
            // SAFETY: neither null nor misaligned, and good for one value.
            unsafe { result.write(value) };
            Status::Ok
        }
        Err(refused) => {
            if usable(refusal) {
                // SAFETY: as above.
                unsafe { refusal.write(refused.why) };
            }
            refused.status
        }
    }
}

/// What a pointer points at.
///
/// # Safety
/// It is null or good for one value of its type.
pub(crate) unsafe fn given<'a, V>(pointer: *const V) -> Result<&'a V, Refused> {
    // SAFETY: neither null nor misaligned, and good for one value.
    if usable(pointer) { Ok(unsafe { &*pointer }) } else { Err(Status::BadPointer.into()) }
}

pub(crate) fn usable<V>(pointer: *const V) -> bool {
    !pointer.is_null() && pointer.is_aligned()
}
