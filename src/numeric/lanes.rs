//! Several floats side by side: what they have in common is decided once, and the processor works on them together.

use core::array;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Real;
use super::real::own_sine_series;

/// Floats of which each takes the same operations as it would alone, so that a formula gives the same bits.
///
/// Both sides of a decision are evaluated where they do not agree. [`bounds`](Real::bounds) are those of all of them, and
/// not a number where one of them is not finite: a check that passes has passed for each. A formula that branches on them
/// otherwise is none for this arithmetic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes([f64; Lanes::COUNT]);

impl Lanes {
    /// More keep no more of the processor busy and disagree more often.
    pub(crate) const COUNT: usize = 4;

    #[inline]
    pub(crate) fn from_fn(value: impl FnMut(usize) -> f64) -> Self {
        Self(array::from_fn(value))
    }
    #[inline]
    pub(crate) fn values(self) -> [f64; Self::COUNT] {
        self.0
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut values = self.0;
        for (value, other) in values.iter_mut().zip(other.0) {
            *value = f(*value, other);
        }
        Self(values)
    }

    /// Each lane from the side that its answer selects.
    #[inline(always)]
    fn decide<const N: usize>(
        answers: [bool; Self::COUNT],
        below: impl FnOnce() -> [Self; N],
        above: impl FnOnce() -> [Self; N],
    ) -> [Self; N] {
        match answers.iter().filter(|&&answer| answer).count() {
            0 => return below(),
            Self::COUNT => return above(),
            _ => {}
        }
        let mut chosen = below();
        for (chosen, above) in chosen.iter_mut().zip(above()) {
            for ((value, above), answer) in chosen.0.iter_mut().zip(above.0).zip(answers) {
                *value = if answer { above } else { *value };
            }
        }
        chosen
    }
}

macro_rules! lane_by_lane {
    ($($trait:ident::$method:ident),+) => { $(
        impl $trait for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, $trait::$method)
            }
        }
    )+ };
}
lane_by_lane!(Add::add, Sub::sub, Mul::mul, Div::div);

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(Neg::neg)
    }
}

/// Functions of one float, one after the other.
macro_rules! one_by_one {
    ($($method:ident),+) => { $(
        #[inline(never)]
        fn $method(self) -> Self {
            self.map(<f64 as Real>::$method)
        }
    )+ };
}

impl Real for Lanes {
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self([value; Self::COUNT])
    }
    #[inline(always)]
    fn pi() -> Self {
        Self::from_f64(f64::pi())
    }
    #[inline(always)]
    fn inverse_pi() -> Self {
        Self::from_f64(f64::inverse_pi())
    }
    #[inline]
    fn bounds(self) -> (f64, f64) {
        if self.0.iter().any(|value| !value.is_finite()) {
            return (f64::NAN, f64::NAN);
        }
        (self.0.into_iter().fold(f64::INFINITY, Real::min), self.0.into_iter().fold(f64::NEG_INFINITY, Real::max))
    }
    #[inline]
    fn vanishes(self) -> bool {
        self.0.into_iter().all(Real::vanishes)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, Real::min)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, Real::max)
    }
    /// The processor's: any square root is rounded correctly.
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }
    one_by_one!(sin, cos, tan, asin, acos, atan, exp, exp_m1, ln, ln_1p, sinh, cosh, tanh, atanh, floor);
    fn pow(self, exponent: Self) -> Self {
        self.zip(exponent, Real::pow)
    }
    #[inline(always)]
    fn select_all<const N: usize>(
        self,
        below: impl FnOnce() -> [Self; N],
        above: impl FnOnce() -> [Self; N],
    ) -> [Self; N] {
        Self::decide(self.0.map(|value| value > 0.0), below, above)
    }
    #[inline(always)]
    fn inflate(self, _: f64) -> Self {
        self
    }
    #[inline(always)]
    fn minus_own_sine(self, sine: Self) -> Self {
        let [difference] = Self::decide(self.0.map(|value| value >= 1.0), || [own_sine_series(self)], || [self - sine]);
        difference
    }
}
