//! Rounding error of a formula: intervals of the exact and of the floating-point value, and a bound of their distance.
//!
//! Compiled twice, as `numeric::rounded` of the library's own tests and of the property tests.
//!
//! A formula written over [`Real`] runs in [`Rounded`] as it does in a float, and every operation adds its
//! largest rounding error: half a unit in the last place, or a function's own error, on top of the errors that came in
//! times the slope of the operation. The result holds for all floats within the given intervals at once.
//!
//! | file | content |
//! |---|---|
//! | `format` | the two formats, and what their functions are known to keep |
//! | `functions` | the functions of `Real` and `Special` |
//! | `order` | formulas with comparisons |
//! | `testing` | a formula's proved bounds against 42 digits |
#![allow(dead_code, reason = "either crate uses its part")]

pub(crate) mod format;
mod functions;
pub(crate) mod order;
pub(crate) mod testing;

use core::marker::PhantomData;
use core::ops::{Add, Div, Mul, Neg, Sub};

pub(crate) use format::{Double, Format, Single};

use crate::numeric::{Interval, Real};

/// A number of a formula: where its exact value lies, where its float lies, and how far apart they can be.
///
/// **Guarantee.** It holds for all floats within the intervals given to [`Rounded::input`]. `exact` contains the formula's value in real
/// numbers, `float` the formula's value in the format, and `error` is at least their distance. The format's functions are assumed as exact
/// as in [`Format`]. An infinite `error` is no bound: an argument may lie outside its domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rounded<F> {
    exact: Interval,
    float: Interval,
    error: f64,
    format: PhantomData<F>,
}

/// At least `bound`, a sum or product of a few numbers that are not negative, each rounded.
fn up(bound: f64) -> f64 {
    if bound.is_nan() { f64::INFINITY } else { bound * (1.0 + 64.0 * f64::EPSILON) }
}

impl<F: Format> Rounded<F> {
    /// Nothing is known.
    const UNKNOWN: Self =
        Self { exact: Interval::ENTIRE, float: Interval::ENTIRE, error: f64::INFINITY, format: PhantomData };

    /// Any float of the format within an interval.
    #[must_use]
    pub(crate) fn input(interval: Interval) -> Self {
        Self { exact: interval, float: interval, error: 0.0, format: PhantomData }
    }

    /// The exact value's interval.
    #[must_use]
    pub(crate) fn exact(self) -> Interval {
        self.exact
    }

    /// A bound of the distance between exact value and float; infinite where there is none.
    #[must_use]
    pub(crate) fn error(self) -> f64 {
        self.error
    }

    /// Exact value and float of an operation: the float's operation on floats without rounding, the error that came in times slopes,
    /// and the operation's own error relative to its result.
    fn of(exact: Interval, unrounded: Interval, passed_on: f64, own: f64) -> Self {
        let size = unrounded.magnitude();
        let rounding = up(own * size + if own > 0.0 { F::TINY } else { 0.0 });
        let error = up(passed_on + rounding);
        // Above this the float may have overflowed.
        if !(error < F::LARGEST && size < F::LARGEST) {
            return Self::UNKNOWN;
        }
        let float = unrounded + Interval::symmetric(rounding);
        let near = exact + Interval::symmetric(error);
        Self { exact, float: float.intersection(near).unwrap_or(float), error, format: PhantomData }
    }

    /// Both values of this number.
    fn hull(self) -> Interval {
        self.exact.hull(self.float)
    }

    /// The union of two branches chosen by rounding or by the numbers; adds `apart` where the exact value may be from
    /// the first branch and the float from the second.
    fn either(self, other: Self, apart: f64) -> Self {
        Self {
            exact: self.exact.hull(other.exact),
            float: self.float.hull(other.float),
            error: self.error.max(other.error).max(apart),
            format: PhantomData,
        }
    }
}

/// The largest distance between elements of two intervals.
fn farthest(a: Interval, b: Interval) -> f64 {
    up((a.upper() - b.lower()).max(b.upper() - a.lower()).max(0.0))
}

impl<F: Format> Neg for Rounded<F> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { exact: -self.exact, float: -self.float, ..self }
    }
}

impl<F: Format> Add for Rounded<F> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        // Nothing is rounded where zero is added.
        let zero = self.vanishes() || other.vanishes();
        let own = if zero { 0.0 } else { F::UNIT };
        Self::of(self.exact + other.exact, self.float + other.float, self.error + other.error, own)
    }
}

impl<F: Format> Sub for Rounded<F> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<F: Format> Mul for Rounded<F> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.vanishes() || other.vanishes() {
            return Self::of(self.exact * other.exact, self.float * other.float, 0.0, 0.0);
        }
        // A product with a power of two is rounded where it underflows only, and TINY is for that.
        let own = if self.is_power_of_two() || other.is_power_of_two() { f64::MIN_POSITIVE } else { F::UNIT };
        let (a, b) = (self.exact.magnitude(), other.float.magnitude());
        Self::of(self.exact * other.exact, self.float * other.float, up(a * other.error) + up(b * self.error), own)
    }
}

impl<F: Format> Div for Rounded<F> {
    type Output = Self;
    fn div(self, divisor: Self) -> Self {
        let own = if divisor.is_power_of_two() { f64::MIN_POSITIVE } else { F::UNIT };
        let (exact, unrounded) = (self.exact / divisor.exact, self.float / divisor.float);
        // a'/b' - a/b = ((a' - a) - (b' - b) a/b)/b'.
        let least = divisor.float.lower().max(-divisor.float.upper());
        if !(least > 0.0) {
            return Self::UNKNOWN;
        }
        let passed_on = up(up(self.error + exact.magnitude() * divisor.error) / least);
        Self::of(exact, unrounded, passed_on, own)
    }
}

impl<F: Format> Rounded<F> {
    /// Whether it is a single power of two, in both senses, or its opposite.
    fn is_power_of_two(self) -> bool {
        const FRACTION: u64 = (1 << 52) - 1;
        let value = self.exact.lower();
        self.error == 0.0
            && self.exact.is_point()
            && self.float == self.exact
            && value.is_normal()
            && value.to_bits() & FRACTION == 0
    }
}
