//! The arithmetics a formula can be evaluated in.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// Implements operators of a type, each by a formula of its operands.
macro_rules! operators {
    ($type:tt $($trait:ident::$method:ident = |$a:ident $(, $b:ident)?| $formula:expr;)+) => {
        $( $crate::numeric::operators!(@ $type $trait $method |$a $(, $b)?| $formula); )+
    };
    (@ [$(#[$attribute:meta])* $type:ty $(, $($generics:tt)+)?] $trait:ident $method:ident |$a:ident $(, $b:ident)?| $formula:expr) => {
        impl $(<$($generics)+>)? core::ops::$trait for $type {
            type Output = Self;
            $(#[$attribute])*
            fn $method(self $(, $b: Self)?) -> Self {
                let $a = self;
                $formula
            }
        }
    };
}
pub(crate) use operators;

/// A number a formula of this crate can be written over: f32, f64, dual numbers, intervals.
///
/// A formula generic over `Real` has no branches on values: an interval can straddle a case distinction, hence `Real`
/// has no order. Where a decision is needed, ask for [`Scalar`], which intervals do not implement.
///
/// Angles are in radians. Outside its domain (the square root of a negative number, say) a function gives NaN in
/// floating point and the widest enclosure, or none, in intervals; the layers above check domains before they call.
pub trait Real:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// The number `value`, exactly where the arithmetic holds it (f32 rounds).
    fn from_f64(value: f64) -> Self;
    /// The circle constant, enclosed in interval arithmetic.
    fn pi() -> Self;
    /// Lower and upper bound as f64: both the value itself for a point arithmetic, the real part for a dual number.
    fn bounds(self) -> (f64, f64);

    /// Whether this is zero with all its derivatives: its factors need not be computed; `false` decides nothing.
    #[inline]
    fn vanishes(self) -> bool {
        false
    }
    /// Absolute value.
    fn abs(self) -> Self;
    /// The smaller of two numbers.
    fn min(self, other: Self) -> Self;
    /// The larger of two numbers.
    fn max(self, other: Self) -> Self;
    /// Square root, domain `>= 0`.
    fn sqrt(self) -> Self;
    /// Sine.
    fn sin(self) -> Self;
    /// Cosine.
    fn cos(self) -> Self;
    /// Tangent.
    fn tan(self) -> Self;
    /// Inverse sine, domain `[-1, 1]`, range `[-pi/2, pi/2]`.
    fn asin(self) -> Self;
    /// Inverse tangent, range `(-pi/2, pi/2)`.
    fn atan(self) -> Self;
    /// Exponential function.
    fn exp(self) -> Self;
    /// `exp(x) - 1` without cancellation near zero.
    fn exp_m1(self) -> Self;
    /// Natural logarithm, domain `> 0`.
    fn ln(self) -> Self;
    /// `ln(1 + x)` without cancellation near zero, domain `> -1`.
    fn ln_1p(self) -> Self;
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Inverse hyperbolic tangent, domain `(-1, 1)`.
    fn atanh(self) -> Self;
    /// Power with a real exponent, domain `self >= 0`; `0^0 = 1`.
    #[must_use]
    fn pow(self, exponent: Self) -> Self;
    /// The largest whole number not above; all of them, for an interval.
    fn floor(self) -> Self;
    /// `above` where this number is positive, `below` where it is not; both, joined, where an interval straddles zero.
    /// Several numbers that hang on the same decision are selected together.
    #[must_use]
    fn select_all<const N: usize>(
        self,
        below: impl FnOnce() -> [Self; N],
        above: impl FnOnce() -> [Self; N],
    ) -> [Self; N];
    /// [`select_all`](Self::select_all) between two expressions of the same numbers, each the more accurate on its side of
    /// zero. That they are the same, as functions, is for the caller to know: a jet that straddles zero stays smooth.
    #[must_use]
    #[inline(always)]
    fn prefer_all<const N: usize>(
        self,
        below: impl FnOnce() -> [Self; N],
        above: impl FnOnce() -> [Self; N],
    ) -> [Self; N] {
        self.select_all(below, above)
    }
    /// This number, with an error of at most that magnitude: an enclosure is widened by it; a float is returned
    /// unchanged. Of a jet or gradient the value alone is widened: it bounds every function that near the function with
    /// these derivatives.
    #[must_use]
    fn inflate(self, error: f64) -> Self;
    /// `self - sin(self)` for `self >= 0` without cancellation near zero, given `sine = sin(self)` from elsewhere.
    fn minus_own_sine(self, sine: Self) -> Self;

    /// [`select_all`](Self::select_all) of a single number.
    #[must_use]
    #[inline]
    fn select(self, below: impl FnOnce() -> Self, above: impl FnOnce() -> Self) -> Self {
        let [selected] = self.select_all(|| [below()], || [above()]);
        selected
    }
    /// [`prefer_all`](Self::prefer_all) of a single number.
    #[must_use]
    #[inline(always)]
    fn prefer(self, below: impl FnOnce() -> Self, above: impl FnOnce() -> Self) -> Self {
        let [preferred] = self.prefer_all(
            #[inline(always)]
            || [below()],
            #[inline(always)]
            || [above()],
        );
        preferred
    }
    /// The reciprocal of [`pi`](Self::pi): dividing by a constant costs a division each time.
    #[must_use]
    fn inverse_pi() -> Self {
        Self::one() / Self::pi()
    }
    /// A power of two that scales a positive number to about 1, if any: multiplying by it is exact. A constant,
    /// for types whose results do not hang on it.
    #[must_use]
    #[inline]
    fn near_reciprocal(self) -> Self {
        Self::from_f64(near_reciprocal(self.bounds().1, f64::MIN_POSITIVE))
    }
    /// Zero.
    #[must_use]
    fn zero() -> Self {
        Self::from_f64(0.0)
    }
    /// One.
    #[must_use]
    fn one() -> Self {
        Self::from_f64(1.0)
    }
    /// Two.
    #[must_use]
    fn two() -> Self {
        Self::from_f64(2.0)
    }
    /// The square; an interval that straddles zero keeps its lower bound at zero.
    #[must_use]
    fn square(self) -> Self {
        self * self
    }
    /// Inverse cosine, domain `[-1, 1]`, range `[0, pi]`.
    #[must_use]
    fn acos(self) -> Self {
        Self::pi() / Self::two() - self.asin()
    }
    /// The nearest point of `[-1, 1]`: a breakpoint outside the sweep counts as reached at the turning point.
    #[must_use]
    fn clamp_unit(self) -> Self {
        self.max(-Self::one()).min(Self::one())
    }
}

/// A [`Real`] whose comparisons decide: f32, f64, dual numbers (by their real part). Intervals are not scalars.
pub trait Scalar: Real + PartialOrd {
    /// Distance from 1 to the next larger number, as the real part's arithmetic has it.
    fn epsilon() -> Self;
    /// The value as f64 (the real part of a dual number).
    #[must_use]
    fn value(self) -> f64 {
        self.bounds().0
    }
    /// A function given at the real part by value and slope, carried over to this arithmetic: a float gets the value, a
    /// dual number of first order its derivatives. An infinite slope becomes the largest number.
    #[must_use]
    fn lift(self, value: f64, slope: f64) -> Self {
        let slope = slope.clamp(-f64::MAX, f64::MAX);
        Self::from_f64(value) + Self::from_f64(slope) * (self - Self::from_f64(self.value()))
    }
    /// Neither infinite nor NaN.
    #[must_use]
    fn is_finite(self) -> bool {
        self.value().is_finite()
    }
}

/// The largest absolute value that `x` may have.
#[inline]
pub(super) fn magnitude<T: Real>(x: T) -> f64 {
    let (lower, upper) = x.bounds();
    lower.abs().max(upper.abs())
}

/// The power of two that brings a positive number near 1, as long as neither it nor its own reciprocal is below `smallest`.
#[inline(always)]
pub(super) fn near_reciprocal(x: f64, smallest: f64) -> f64 {
    const LARGEST_POWER: f64 = f64::from_bits(f64::INFINITY.to_bits() - (1 << (f64::MANTISSA_DIGITS - 1)));
    let exponent = x.to_bits() & f64::INFINITY.to_bits();
    f64::from_bits(LARGEST_POWER.to_bits().wrapping_sub(exponent)).max(smallest).min(1.0 / smallest)
}

/// `x - sin x`: the series below 1, where the difference cancels.
#[inline]
pub(super) fn minus_own_sine<S: Scalar>(x: S, sine: S) -> S {
    if x >= S::one() { x - sine } else { own_sine_series(x) }
}

/// `x - sin x` for `x <= 1`; the first omitted term is below 2e-17 of the sum.
#[inline]
pub fn own_sine_series<S: Real>(x: S) -> S {
    // 6 (-1)^k/(2 k + 3)!, in pairs: the processor works on several at once.
    const FACTORS: [[f64; 2]; 4] = [
        [1.0, -1.0 / 20.0],
        [1.0 / 840.0, -1.0 / 60_480.0],
        [1.0 / 6_652_800.0, -1.0 / 1_037_836_800.0],
        [1.0 / 217_945_728_000.0, -1.0 / 59_281_238_016_000.0],
    ];
    let square = x * x;
    let fourth = square * square;
    let [a, b, c, d] = FACTORS.map(|[even, odd]| S::from_f64(even) + square * S::from_f64(odd));
    let sum = (a + fourth * b) + fourth * fourth * (c + fourth * d);
    sum * square * x * S::from_f64(1.0 / 6.0)
}

/// Functions that are `libm`'s rather than the platform's: results are the same on every machine.
macro_rules! by_libm {
    ($float:ident: $($method:ident = $function:ident),+) => { $(
        #[inline]
        fn $method(self) -> Self {
            libm::Libm::<$float>::$function(self)
        }
    )+ };
}

macro_rules! float {
    ($float:ident) => {
        impl Real for $float {
            #[allow(clippy::cast_possible_truncation, reason = "f32 holds what it can")]
            #[inline]
            fn from_f64(value: f64) -> Self {
                value as $float
            }
            #[inline]
            fn pi() -> Self {
                core::$float::consts::PI
            }
            #[inline]
            fn inverse_pi() -> Self {
                core::$float::consts::FRAC_1_PI
            }
            #[inline]
            fn bounds(self) -> (f64, f64) {
                (f64::from(self), f64::from(self))
            }
            #[inline]
            fn near_reciprocal(self) -> Self {
                Self::from_f64(near_reciprocal(f64::from(self), f64::from(Self::MIN_POSITIVE)))
            }
            #[inline]
            fn vanishes(self) -> bool {
                self == 0.0
            }
            #[inline]
            fn abs(self) -> Self {
                $float::abs(self)
            }
            #[inline]
            fn min(self, other: Self) -> Self {
                if other < self { other } else { self }
            }
            #[inline]
            fn max(self, other: Self) -> Self {
                if other > self { other } else { self }
            }
            #[inline]
            fn select_all<const N: usize>(
                self,
                below: impl FnOnce() -> [Self; N],
                above: impl FnOnce() -> [Self; N],
            ) -> [Self; N] {
                if self > 0.0 { above() } else { below() }
            }
            #[inline]
            fn inflate(self, _: f64) -> Self {
                self
            }
            #[inline]
            fn minus_own_sine(self, sine: Self) -> Self {
                minus_own_sine(self, sine)
            }
            #[inline]
            fn pow(self, exponent: Self) -> Self {
                libm::Libm::<$float>::pow(self, exponent)
            }
            by_libm! {
                $float: sqrt = sqrt, sin = sin, cos = cos, tan = tan, asin = asin, acos = acos, atan = atan, exp = exp,
                exp_m1 = expm1, ln = log, ln_1p = log1p, sinh = sinh, cosh = cosh, tanh = tanh, atanh = atanh, floor = floor
            }
        }
        impl Scalar for $float {
            #[inline]
            fn epsilon() -> Self {
                $float::EPSILON
            }
        }
    };
}

float!(f64);
float!(f32);
