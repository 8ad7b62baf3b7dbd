//! The error of a number outside its domain, and the checks that give it.

use core::fmt;

use super::Real;

/// A number outside its domain: quantity, value, domain, remedy.
///
/// ```
/// use selfosc::nonlinearity::Sinusoid;
/// let fault = *Sinusoid::new(0.0, -1.0).unwrap_err().out_of_domain().unwrap();
/// assert_eq!((fault.quantity, fault.value), ("amplitude", -1.0));
/// assert!(fault.to_string().starts_with("amplitude is -1 (input units): must be a finite number above 0; "));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{quantity} is {}{}: must be {limit}; {remedy}", Plain(*.value), Unit(.unit))]
pub struct OutOfDomain {
    /// Name of the quantity.
    pub quantity: &'static str,
    /// The value given, in `unit`: the lower bound of an interval.
    pub value: f64,
    /// Unit of the value; empty where it has none.
    pub unit: &'static str,
    /// The condition on the value, in the same unit.
    pub limit: Limit,
    /// What to do.
    pub remedy: &'static str,
}

/// Short names of the variants of an enum of errors, as `code`, and `out_of_domain`. A variant with a field named has its short name from the
/// error there, unless another is given, and its number.
macro_rules! codes {
    ($visibility:vis $name:ident {
        $( $(#[$attribute:meta])* $variant:ident $(. $field:tt)? $(=> $code:literal)? ),+ $(,)?
    }) => {
        impl $name {
            /// Short name for scripts; it does not change with the wording of the message.
            #[must_use]
            $visibility fn code(&self) -> &'static str {
                match self { $(
                    $(#[$attribute])* Self::$variant { $($field: error,)? .. } =>
                        $crate::numeric::codes!(@code [$($code)?] $(error $field)?),
                )+ }
            }

            /// The number outside its domain, if that is the reason.
            #[must_use]
            $visibility fn out_of_domain(&self) -> Option<&$crate::numeric::OutOfDomain> {
                match self { $(
                    $(#[$attribute])* Self::$variant { $($field: error,)? .. } =>
                        $crate::numeric::codes!(@number $(error $field)?),
                )+ }
            }
        }
    };
    (@code [$code:literal] $($error:ident $field:tt)?) => {{ $(let _ = $error;)? $code }};
    (@code [] $error:ident $field:tt) => { $error.code() };
    (@number) => { None };
    (@number $error:ident $field:tt) => { $error.out_of_domain() };
}
pub(crate) use codes;

impl OutOfDomain {
    pub(crate) fn code(&self) -> &'static str {
        "out-of-domain"
    }

    pub(crate) fn out_of_domain(&self) -> Option<&Self> {
        Some(self)
    }
}

/// A condition on a number. Not a number and infinity are within none.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Limit {
    /// Any finite number.
    Finite,
    /// Above zero.
    Positive,
    /// Zero or more.
    NonNegative,
    /// Other than zero.
    NonZero,
    /// Above this number.
    Above(f64),
    /// This number or more.
    AtLeast(f64),
    /// This number or less.
    AtMost(f64),
    /// Between two numbers, both included.
    Within(f64, f64),
    /// A condition that takes words.
    Words(&'static str),
}

impl Limit {
    /// Whether the value, or all of an interval, is finite and within the limit. A condition in words is for the caller to check.
    #[inline]
    pub(crate) fn holds<T: Real>(self, value: T) -> bool {
        let (lower, upper) = value.bounds();
        let inside = match self {
            Self::Finite | Self::Words(_) => true,
            Self::Positive => lower > 0.0,
            Self::NonNegative => lower >= 0.0,
            Self::NonZero => lower > 0.0 || upper < 0.0,
            Self::Above(least) => lower > least,
            Self::AtLeast(least) => lower >= least,
            Self::AtMost(most) => upper <= most,
            Self::Within(least, most) => lower >= least && upper <= most,
        };
        inside && lower > f64::NEG_INFINITY && upper < f64::INFINITY
    }
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finite => write!(f, "a finite number"),
            Self::Positive => write!(f, "a finite number above 0"),
            Self::NonNegative => write!(f, "a finite number, 0 or more"),
            Self::NonZero => write!(f, "a finite number other than 0"),
            Self::Above(least) => write!(f, "a finite number above {}", Plain(*least)),
            Self::AtLeast(least) => write!(f, "a finite number, {} or more", Plain(*least)),
            Self::AtMost(most) => write!(f, "a finite number, {} or less", Plain(*most)),
            Self::Within(least, most) => write!(f, "a number from {} to {}", Plain(*least), Plain(*most)),
            Self::Words(words) => write!(f, "{words}"),
        }
    }
}

/// A number that nobody has to count the zeros of.
pub(crate) struct Plain(pub(crate) f64);

impl fmt::Display for Plain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || !size.is_finite() || (1e-5..1e12).contains(&size) {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

macro_rules! of_three_digits {
    ($($(#[$meaning:meta])* $name:ident by $round:path;)+) => { $(
        $(#[$meaning])*
        pub(crate) struct $name(pub(crate) f64);

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt_three_digits(self.0, $round, f)
            }
        }
    )+ };
}
of_three_digits! {
    /// A computed number, to three digits.
    About by libm::round;
    /// A computed upper bound that a user may type in: three digits, not rounded up.
    AtMost by libm::floor;
    /// A computed lower bound, not rounded down.
    AtLeast by libm::ceil;
}

fn fmt_three_digits(value: f64, round: fn(f64) -> f64, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let shown = three_digits(value, round);
    // Beyond, powers of ten and the product are inexact.
    if shown == 0.0 || !shown.is_finite() || (1e-20..1e20).contains(&shown.abs()) {
        fmt::Display::fmt(&Plain(shown), f)
    } else {
        write!(f, "{shown:.2e}")
    }
}

/// A number rounded to three digits.
pub(crate) fn three_digits(value: f64, round: fn(f64) -> f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let exponent = 2.0 - libm::floor(libm::log10(value.abs()));
    let place = libm::pow(10.0, exponent.abs());
    if !place.is_finite() {
        value
    } else if exponent >= 0.0 {
        round(value * place) / place
    } else {
        round(value / place) * place
    }
}

struct Unit<'a>(&'a str);

impl fmt::Display for Unit<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() { Ok(()) } else { write!(f, " ({})", self.0) }
    }
}

/// The value, where `inside` is true and `limit` holds.
#[inline]
pub(crate) fn require_that<T: Real>(
    inside: bool,
    quantity: &'static str,
    value: T,
    unit: &'static str,
    limit: Limit,
    remedy: &'static str,
) -> Result<T, OutOfDomain> {
    if inside && limit.holds(value) { Ok(value) } else { outside(quantity, value.bounds().0, unit, limit, remedy) }
}

#[cold]
#[inline(never)]
fn outside<T>(
    quantity: &'static str,
    value: f64,
    unit: &'static str,
    limit: Limit,
    remedy: &'static str,
) -> Result<T, OutOfDomain> {
    Err(OutOfDomain { quantity, value, unit, limit, remedy })
}

/// The value, where `limit` holds.
#[inline]
pub(crate) fn require<T: Real>(
    quantity: &'static str,
    value: T,
    unit: &'static str,
    limit: Limit,
    remedy: &'static str,
) -> Result<T, OutOfDomain> {
    require_that(true, quantity, value, unit, limit, remedy)
}

/// The value, where it is finite.
pub(crate) fn finite<T: Real>(quantity: &'static str, value: T, unit: &'static str) -> Result<T, OutOfDomain> {
    require(quantity, value, unit, Limit::Finite, "check where it comes from")
}

/// The value, where it is finite and above zero.
pub(crate) fn positive<T: Real>(quantity: &'static str, value: T, unit: &'static str) -> Result<T, OutOfDomain> {
    require(quantity, value, unit, Limit::Positive, "check its sign and where it comes from")
}

/// The value, where it is finite and zero or more.
pub(crate) fn non_negative<T: Real>(quantity: &'static str, value: T, unit: &'static str) -> Result<T, OutOfDomain> {
    require(quantity, value, unit, Limit::NonNegative, "check its sign and where it comes from")
}

/// The remedy where a result cannot be represented.
pub(crate) const UNITS: &str =
    "the result leaves the range of the arithmetic: choose units in which the numbers are nearer to one";

/// A result, where it can be represented: no infinity, and no number that is none. Of an interval a single bound may be infinite.
pub(crate) fn representable<T: Real>(quantity: &'static str, value: T, unit: &'static str) -> Result<T, OutOfDomain> {
    let (lower, upper) = value.bounds();
    let number = lower.is_finite() || lower < upper;
    if number { Ok(value) } else { outside(quantity, lower, unit, Limit::Finite, UNITS) }
}

/// Nothing, where both ends of the range are above zero and in order.
#[cfg(feature = "std")]
pub(crate) fn ascending(
    [lowest, highest]: [&'static str; 2],
    range: &core::ops::RangeInclusive<f64>,
    unit: &'static str,
) -> Result<(), OutOfDomain> {
    let (from, to) = (*range.start(), *range.end());
    let remedy = "give a range above 0 with its lower end first";
    require(lowest, from, unit, Limit::Positive, remedy)?;
    require(highest, to, unit, Limit::Above(from), remedy).map(drop)
}
