//! Interval arithmetic: sets of real numbers with f64 endpoints that enclose all values of a formula.

mod circular;
mod exponential;
mod real;
mod rounding;
mod series;
#[cfg(test)]
#[path = "../../tests/properties/private/interval.rs"]
mod tests;

use core::fmt;
use core::ops::{Div, Mul};

use rounding::{product, quotient, sum};

use super::real::operators;

/// A closed interval of real numbers; its endpoints may be infinite but belong to it only when finite.
///
/// **Guarantee.** For every function `f` of this type and all real arguments within the given intervals, the result
/// contains the exact value of `f`. It rests on IEEE 754 double arithmetic in round-to-nearest mode, and on nothing else:
/// the values of `libm` serve as guesses that are checked.
///
/// **Outside a domain** (division by an interval that contains zero, the square root of an interval that reaches below zero, the
/// inverse sine beyond 1, the tangent across a pole) the result is [`Interval::ENTIRE`], the whole real line. It is sticky: every
/// operation on it except [`intersection`](Self::intersection) gives it again, even `abs`, `tanh` or `0 *`: a
/// violated domain cannot be laundered into a proof. No operation gives NaN.
///
/// Intervals have no order and no [`Scalar`](super::Scalar); ask [`is_positive`](Self::is_positive),
/// [`is_interior_to`](Self::is_interior_to) and the like, whose `false` means "not decided".
///
/// ```
/// use selfosc::numeric::{Interval, Real};
/// let third = Interval::one() / Interval::from_f64(3.0);
/// let one = third + third + third;
/// assert!(one.contains(1.0) && one.width() < 1e-15);
/// assert_eq!(Interval::from_f64(-1.0).sqrt(), Interval::ENTIRE);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "std", serde(into = "[Option<f64>; 2]", try_from = "[Option<f64>; 2]"))]
pub struct Interval {
    // Invariant: lo <= hi, lo < inf, hi > -inf; neither is NaN.
    lo: f64,
    hi: f64,
}

impl Interval {
    /// All real numbers: no bound, or a violated domain.
    pub const ENTIRE: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };
    /// Zero.
    pub const ZERO: Self = Self { lo: 0.0, hi: 0.0 };
    /// One.
    pub const ONE: Self = Self { lo: 1.0, hi: 1.0 };
    /// `[-1, 1]`.
    pub const UNIT: Self = Self { lo: -1.0, hi: 1.0 };
    /// The circle constant; its double lies below it.
    pub const PI: Self = Self { lo: core::f64::consts::PI, hi: core::f64::consts::PI.next_up() };
    /// The reciprocal of the circle constant; its double lies above it.
    pub const INVERSE_PI: Self =
        Self { lo: core::f64::consts::FRAC_1_PI.next_down(), hi: core::f64::consts::FRAC_1_PI };

    /// The interval from `lo` to `hi`; `None` if it would be empty or an endpoint is NaN.
    #[must_use]
    pub const fn new(lo: f64, hi: f64) -> Option<Self> {
        if lo <= hi && lo < f64::INFINITY && hi > f64::NEG_INFINITY { Some(Self { lo, hi }) } else { None }
    }

    /// The number `value` alone. An infinity stands for all numbers beyond the largest double, NaN for [`Self::ENTIRE`].
    #[must_use]
    pub const fn point(value: f64) -> Self {
        if value.is_nan() {
            Self::ENTIRE
        } else {
            // Both endpoints are the value itself unless it is infinite.
            Self { lo: value.min(f64::MAX), hi: value.max(f64::MIN) }
        }
    }

    /// From `-radius` to `radius`; the sign of `radius` does not matter, and NaN gives [`Self::ENTIRE`].
    #[must_use]
    pub const fn symmetric(radius: f64) -> Self {
        if radius.is_nan() { Self::ENTIRE } else { Self { lo: -radius.abs(), hi: radius.abs() } }
    }

    /// The reciprocal of a positive integer, for the coefficients of series.
    pub(super) const fn reciprocal(integer: f64) -> Self {
        let nearest = 1.0 / integer;
        Self { lo: nearest.next_down(), hi: nearest.next_up() }
    }

    /// Lower endpoint, possibly `-inf`.
    #[must_use]
    pub const fn lower(self) -> f64 {
        self.lo
    }

    /// Upper endpoint, possibly `inf`.
    #[must_use]
    pub const fn upper(self) -> f64 {
        self.hi
    }

    /// Whether it has no bound ([`Self::ENTIRE`]).
    #[must_use]
    pub const fn is_entire(self) -> bool {
        self.lo == f64::NEG_INFINITY && self.hi == f64::INFINITY
    }

    /// Whether both endpoints are finite.
    #[must_use]
    pub const fn is_bounded(self) -> bool {
        self.lo > f64::NEG_INFINITY && self.hi < f64::INFINITY
    }

    /// Whether the interval is a single number.
    #[must_use]
    pub const fn is_point(self) -> bool {
        self.lo >= self.hi
    }

    /// Whether the finite number `value` belongs to the interval.
    #[must_use]
    pub const fn contains(self, value: f64) -> bool {
        self.lo <= value && value <= self.hi
    }

    /// Whether zero belongs to the interval.
    #[must_use]
    pub const fn contains_zero(self) -> bool {
        self.contains(0.0)
    }

    /// Whether every element is above zero.
    #[must_use]
    pub const fn is_positive(self) -> bool {
        self.lo > 0.0
    }

    /// Whether every element is below zero.
    #[must_use]
    pub const fn is_negative(self) -> bool {
        self.hi < 0.0
    }

    /// Whether every element is smaller than every element of `other`.
    #[must_use]
    pub const fn precedes(self, other: Self) -> bool {
        self.hi < other.lo
    }

    /// Whether every element belongs to `other`.
    #[must_use]
    pub const fn is_subset_of(self, other: Self) -> bool {
        other.lo <= self.lo && self.hi <= other.hi
    }

    /// Whether every element belongs to `other` and none is an endpoint of it.
    #[must_use]
    pub const fn is_interior_to(self, other: Self) -> bool {
        other.lo < self.lo && self.hi < other.hi
    }

    /// Upper bound of the distance of the endpoints.
    #[must_use]
    pub fn width(self) -> f64 {
        sum(self.hi, -self.lo).up()
    }

    /// Upper bound of the distance of any element from [`midpoint`](Self::midpoint).
    #[must_use]
    pub fn radius(self) -> f64 {
        let middle = self.midpoint();
        sum(self.hi, -middle).up().max(sum(middle, -self.lo).up())
    }

    /// A finite element near the middle.
    #[must_use]
    pub const fn midpoint(self) -> f64 {
        let lo = self.lo.max(f64::MIN);
        let hi = self.hi.min(f64::MAX);
        let middle = 0.5 * lo + 0.5 * hi;
        // Halving a subnormal endpoint may round out of the interval.
        middle.max(lo).min(hi)
    }

    /// The largest absolute value of an element.
    #[must_use]
    pub const fn magnitude(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    /// The two halves, which share the midpoint.
    #[must_use]
    pub const fn bisect(self) -> (Self, Self) {
        let middle = self.midpoint();
        (Self { lo: self.lo, hi: middle }, Self { lo: middle, hi: self.hi })
    }

    /// The elements of both; `None` if there are none.
    #[must_use]
    pub const fn intersection(self, other: Self) -> Option<Self> {
        Self::new(self.lo.max(other.lo), self.hi.min(other.hi))
    }

    /// The smallest interval that contains both.
    #[must_use]
    pub const fn hull(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The whole number of factors that a power with this exponent is best computed from.
    pub(super) fn small_natural(self) -> Option<u32> {
        (0..=8).find(|&count| self == Self::from(f64::from(count)))
    }

    /// The sum of products, of at most a thousand, rounded to nearest with a single step outwards for all roundings.
    #[inline]
    pub(crate) fn dot(pairs: impl Iterator<Item = (Self, Self)> + Clone) -> Self {
        /// Between these nothing overflows, and underflow adds up to less than `UNDERFLOW`.
        const SIZES: core::ops::RangeInclusive<f64> = 1e-270..=1e300;
        const UNDERFLOW: f64 = 1e-300;
        let smaller = |a: f64, b: f64| if b < a { b } else { a };
        let (mut size, mut lower, mut minus_upper) = (0.0, RoundedSum::default(), RoundedSum::default());
        for (a, b) in pairs.clone() {
            let [p, q, r, s] = [a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi];
            lower.add(smaller(smaller(p, q), smaller(r, s)));
            minus_upper.add(smaller(smaller(-p, -q), smaller(-r, -s)));
            size += a.magnitude() * b.magnitude();
        }
        // An infinite endpoint makes the size infinite, or NaN.
        if !SIZES.contains(&size) {
            return pairs.map(|(a, b)| a * b).reduce(|sum, term| sum + term).unwrap_or(Self::ZERO);
        }
        Self { lo: lower.down() - UNDERFLOW, hi: UNDERFLOW - minus_upper.down() }
    }

    /// The values of an increasing function, from `at_point`: its enclosure at an endpoint, or its limit at an infinite endpoint.
    #[inline]
    fn increasing(self, at_point: impl Fn(f64) -> Self) -> Self {
        if self.is_entire() {
            return self;
        }
        let at_lower = at_point(self.lo);
        if self.is_point() {
            return at_lower;
        }
        Self { lo: at_lower.lo, hi: at_point(self.hi).hi }
    }

    /// [`increasing`](Self::increasing) by a single enclosure, for an interval too narrow for an evaluation of both ends to be tighter.
    #[inline]
    fn increasing_over(self, over: impl Fn(Self) -> Self) -> Self {
        const NARROW: f64 = 4096.0 * f64::EPSILON;
        if self.width() <= NARROW { over(self) } else { self.increasing(|end| over(Self::point(end))) }
    }
}

/// A sum of rounded numbers.
#[derive(Clone, Copy, Default)]
struct RoundedSum {
    nearest: f64,
    /// Of absolute values of the numbers and of the partial sums: each was rounded by half an epsilon of it at most.
    rounded: f64,
}

impl RoundedSum {
    #[inline]
    fn add(&mut self, term: f64) {
        self.nearest += term;
        self.rounded += term.abs() + self.nearest.abs();
    }

    /// A number below the sum of the unrounded numbers. The excess over a half is for this difference's rounding and `rounded`'s own.
    #[inline]
    fn down(self) -> f64 {
        self.nearest - (0.501 * f64::EPSILON) * (self.rounded + self.nearest.abs())
    }
}

impl From<f64> for Interval {
    fn from(value: f64) -> Self {
        Self::point(value)
    }
}

/// Both ends, an infinite end as `None`: for a file without infinities.
impl From<Interval> for [Option<f64>; 2] {
    fn from(Interval { lo, hi }: Interval) -> Self {
        [lo, hi].map(|end| Some(end).filter(|end| end.is_finite()))
    }
}

impl TryFrom<[Option<f64>; 2]> for Interval {
    type Error = &'static str;

    fn try_from([lo, hi]: [Option<f64>; 2]) -> Result<Self, Self::Error> {
        Self::new(lo.unwrap_or(f64::NEG_INFINITY), hi.unwrap_or(f64::INFINITY))
            .ok_or("the ends of an interval in order")
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "[{:?}, {:?}]", self.lo, self.hi)
    }
}

operators! {
    [#[inline] Interval]
    Neg::neg = |a| Self { lo: -a.hi, hi: -a.lo };
    Add::add = |a, b| Self { lo: sum(a.lo, b.lo).down(), hi: sum(a.hi, b.hi).up() };
    Sub::sub = |a, b| a + -b;
}

macro_rules! assigned {
    ($($trait:ident::$method:ident by $operator:tt),+) => { $(
        impl core::ops::$trait for Interval {
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )+ };
}
assigned!(AddAssign::add_assign by +, SubAssign::sub_assign by -, MulAssign::mul_assign by *);

impl Mul for Interval {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        if self.lo >= 0.0 && other.lo >= 0.0 {
            Self { lo: product(self.lo, other.lo).down(), hi: product(self.hi, other.hi).up() }
        } else if self.is_entire() || other.is_entire() {
            Self::ENTIRE
        } else if self.lo >= 0.0 {
            self.nonnegative_times(other)
        } else if self.hi <= 0.0 {
            -(-self).nonnegative_times(other)
        } else if other.lo >= 0.0 {
            other.nonnegative_times(self)
        } else if other.hi <= 0.0 {
            -(-other).nonnegative_times(self)
        } else {
            Self {
                lo: product(self.lo, other.hi).down().min(product(self.hi, other.lo).down()),
                hi: product(self.lo, other.lo).up().max(product(self.hi, other.hi).up()),
            }
        }
    }
}

impl Interval {
    #[inline]
    fn nonnegative_times(self, other: Self) -> Self {
        let for_lower = if other.lo >= 0.0 { self.lo } else { self.hi };
        let for_upper = if other.hi >= 0.0 { self.hi } else { self.lo };
        Self { lo: product(for_lower, other.lo).down(), hi: product(for_upper, other.hi).up() }
    }

    #[inline]
    fn over_positive(self, divisor: Self) -> Self {
        let for_lower = if self.lo >= 0.0 { divisor.hi } else { divisor.lo };
        let for_upper = if self.hi >= 0.0 { divisor.lo } else { divisor.hi };
        Self { lo: quotient(self.lo, for_lower).down(), hi: quotient(self.hi, for_upper).up() }
    }
}

impl Div for Interval {
    type Output = Self;
    #[inline]
    fn div(self, divisor: Self) -> Self {
        if self.is_entire() || divisor.contains_zero() {
            Self::ENTIRE
        } else if divisor.lo > 0.0 {
            self.over_positive(divisor)
        } else {
            (-self).over_positive(-divisor)
        }
    }
}
