//! What a call answers, and why it refuses.

use core::ffi::c_char;
use core::ptr::null;

use selfosc::autotune::ProcessError;
use selfosc::control::ControlError;
use selfosc::describing::DescribingError;
use selfosc::identify::IdentifyError;
use selfosc::nonlinearity::NonlinearityError;
use selfosc::numeric::{Limit, OutOfDomain};
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

impl From<ProcessError> for Refused {
    fn from(error: ProcessError) -> Self {
        Self { status: Status::Refused, why: Refusal::without_number(error.code()) }
    }
}

/// What a call may give. Nothing else leaves by `answer`, so that no number that is none reaches C.
pub(crate) trait Answer {
    /// The first number in it that is none, by its name.
    fn no_number(&self) -> Option<(&'static str, f64)>;
}

impl Answer for () {
    fn no_number(&self) -> Option<(&'static str, f64)> {
        None
    }
}

macro_rules! numbers {
    ($($number:ty),+) => { $(
        impl Answer for $number {
            fn no_number(&self) -> Option<(&'static str, f64)> {
                if self.is_finite() { None } else { Some(("result", f64::from(*self))) }
            }
        }
    )+ };
}
numbers!(f32, f64);

/// Structures: their numbers, then the fields that are none or that the caller gave. A field that is in neither list does not compile.
macro_rules! answers {
    ($($name:ident<$number:ident> { $($field:ident),+ $(; $other:ident)* }),+ $(,)?) => { $(
        impl<$number: Answer> Answer for super::values::$name<$number> {
            fn no_number(&self) -> Option<(&'static str, f64)> {
                let Self { $($field,)+ $($other: _,)* } = self;
                let parts = [$((stringify!($field), $field.no_number())),+];
                parts.into_iter().find_map(|(name, found)| found.map(|(_, value)| (name, value)))
            }
        }
    )+ };
}
answers! {
    DescribingFunction<T> { f0, p, q },
    LimitCycle<T> { amplitude, bias, period_s, time_positive_s, time_negative_s, multiplier },
    Parameters<T> { alpha, beta, beta_quadratic, disturbance },
    Axis<T> { alpha, linear_drag, quadratic_drag, disturbance, delay_s },
    Protocol<T> {
        reference, neutral_command, relay_offset, lowest_command, highest_command, relay_level, half_width, largest_excursion,
        wrong_way, dwell_s, interval_s, resolution, largest_rate, unchanged_s, patience_s, duration_s, spread, factor
        ; coordinate; cycles; most_cycles; attempts
    },
    ExperimentStep<T> { command; phase; fault },
    CycleStatistics<T> { mean, std },
    Outcome<T> {
        amplitude, bias, period_s, switch_level, time_positive_s, time_negative_s, relay_level, half_width; cycles; attempts
    },
    ControllerSettings<T> {
        proportional, integral, derivative, filter_s
        ; structure; lowest_command; highest_command; turn; longest_hold_s; neutral_command
    },
    Process<T> { drag, stiffness, dead_time_s; reverse },
    Margins<T> { gain, gain_reduction, phase_rad, delay_s, crossover_rad_s },
    ControlStep<T> { command; limited; fault },
    Delivered<T> { command, thrust_n },
}

impl Answer for super::values::Parameter {
    fn no_number(&self) -> Option<(&'static str, f64)> {
        None
    }
}

const REMEDY: &str =
    "the result leaves the range of the arithmetic: choose units in which the numbers are nearer to one";

/// The answer, unless a number in it is none.
fn sound<R: Answer>(value: R) -> Result<R, Refused> {
    match value.no_number() {
        None => Ok(value),
        Some((quantity, value)) => {
            Err(OutOfDomain { quantity, value, unit: "", limit: Limit::Finite, remedy: REMEDY }.into())
        }
    }
}

/// Writes the answer where the caller wants it, and the reason where there is none.
///
/// # Safety
/// Each pointer is null or good for one value of its type.
pub(crate) unsafe fn answer<R: Answer>(
    result: *mut R,
    refusal: *mut Refusal,
    call: impl FnOnce() -> Result<R, Refused>,
) -> Status {
    if !usable(result) {
        return Status::BadPointer;
    }
    match call().and_then(sound) {
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
