//! Several floats side by side: common decisions are made once, and the processor works on them together.

mod circular;
#[cfg(test)]
#[path = "../../tests/properties/private/lanes.rs"]
mod tests;

use core::array;

use wide::f64x4;

use super::Real;
use super::real::{near_reciprocal, operators, own_sine_series};

/// Floats of which each takes the same operations as it would alone: a formula gives the same bits.
///
/// Both sides of a decision are evaluated where they do not agree. [`bounds`](Real::bounds) are those of all of them,
/// and not a number where any of them is not finite: a check that passes has passed for each. A formula that branches
/// on them otherwise is none for this arithmetic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes(f64x4);

/// Whether the processor's minimum and maximum answer with the second number where both are equal, or either is NaN.
const AS_ALONE: bool = cfg!(target_feature = "sse2");

impl Lanes {
    /// As many as the vector type has.
    pub(crate) const COUNT: usize = 4;

    #[inline(always)]
    pub(crate) fn new(values: [f64; Self::COUNT]) -> Self {
        Self(f64x4::new(values))
    }
    #[inline(always)]
    pub(crate) fn values(self) -> [f64; Self::COUNT] {
        self.0.to_array()
    }

    /// Whether all are.
    #[inline(always)]
    pub(crate) fn is_finite(self) -> bool {
        // Zero times a finite number is zero, times another none.
        (self.0 * 0.0).simd_eq(f64x4::splat(0.0)).all()
    }

    /// Lanes in sequence.
    #[inline(always)]
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        Self::new(self.values().map(f))
    }

    /// Each lane from the side that its answer selects.
    #[inline(always)]
    fn decide<const N: usize>(
        answers: f64x4,
        below: impl FnOnce() -> [Self; N],
        above: impl FnOnce() -> [Self; N],
    ) -> [Self; N] {
        // Each side is called at a single place, to be inlined.
        let mut chosen = [Self(answers); N];
        if !answers.all() {
            chosen = below();
        }
        if answers.any() {
            for (chosen, above) in chosen.iter_mut().zip(above()) {
                chosen.0 = answers.select(above.0, chosen.0);
            }
        }
        chosen
    }
}

operators! {
    [#[inline(always)] Lanes]
    Neg::neg = |a| Self(-a.0);
    Add::add = |a, b| Self(a.0 + b.0);
    Sub::sub = |a, b| Self(a.0 - b.0);
    Mul::mul = |a, b| Self(a.0 * b.0);
    Div::div = |a, b| Self(a.0 / b.0);
}

macro_rules! one_by_one {
    ($($method:ident),+) => { $(
        #[inline(never)]
        fn $method(self) -> Self {
            self.each(Real::$method)
        }
    )+ };
}

impl Lanes {
    #[inline(never)]
    fn asin_of_each(self) -> Self {
        self.each(Real::asin)
    }
}

impl Real for Lanes {
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self(f64x4::splat(value))
    }
    #[inline(always)]
    fn pi() -> Self {
        Self::from_f64(f64::pi())
    }
    #[inline(always)]
    fn inverse_pi() -> Self {
        Self::from_f64(f64::inverse_pi())
    }
    #[inline(always)]
    fn bounds(self) -> (f64, f64) {
        if !self.is_finite() {
            return (f64::NAN, f64::NAN);
        }
        let [a, b, c, d] = self.values();
        (Real::min(Real::min(a, b), Real::min(c, d)), Real::max(Real::max(a, b), Real::max(c, d)))
    }
    #[inline(always)]
    fn near_reciprocal(self) -> Self {
        self.each(|lane| near_reciprocal(lane, f64::MIN_POSITIVE))
    }
    #[inline(always)]
    fn vanishes(self) -> bool {
        self.0.simd_eq(f64x4::splat(0.0)).all()
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(if AS_ALONE { other.0.fast_min(self.0) } else { other.0.simd_lt(self.0).select(other.0, self.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(if AS_ALONE { other.0.fast_max(self.0) } else { other.0.simd_gt(self.0).select(other.0, self.0) })
    }
    /// The processor's: any square root is rounded correctly.
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    /// Formulas ask for it near zero, where all go together.
    #[inline(always)]
    fn asin(self) -> Self {
        let near = self.0.abs().simd_lt(f64x4::splat(0.5)).all();
        if near { Self(circular::asin_below_half(self.0)) } else { self.asin_of_each() }
    }
    #[inline(always)]
    fn atan(self) -> Self {
        Self(circular::atan(self.0))
    }
    one_by_one!(sin, cos, tan, acos, exp, exp_m1, ln, ln_1p, sinh, cosh, tanh, atanh, floor);
    fn pow(self, exponent: Self) -> Self {
        let (values, exponents) = (self.values(), exponent.values());
        Self::new(array::from_fn(|lane| values[lane].pow(exponents[lane])))
    }
    #[inline(always)]
    fn select_all<const N: usize>(
        self,
        below: impl FnOnce() -> [Self; N],
        above: impl FnOnce() -> [Self; N],
    ) -> [Self; N] {
        Self::decide(self.0.simd_gt(f64x4::splat(0.0)), below, above)
    }
    #[inline(always)]
    fn inflate(self, _: f64) -> Self {
        self
    }
    #[inline(always)]
    fn minus_own_sine(self, sine: Self) -> Self {
        let from_one = self.0.simd_ge(f64x4::splat(1.0));
        let [difference] = Self::decide(from_one, || [own_sine_series(self)], || [self - sine]);
        difference
    }
}
