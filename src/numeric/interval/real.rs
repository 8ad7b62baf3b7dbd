//! Intervals as an arithmetic for the formulas of this crate.

use super::rounding::{product, square_root};
use super::{Interval, circular, exponential};
use crate::numeric::Real;

macro_rules! circular {
    ($($function:ident)+) => { $(
        fn $function(self) -> Self {
            circular::$function(self)
        }
    )+ };
}

/// Increasing functions by their enclosures at a point, on the whole line or above a bound.
macro_rules! increasing {
    ($($function:ident by $at_point:ident $(above $least:literal)?),+) => { $(
        fn $function(self) -> Self {
            $( if self.lo <= $least { return Self::ENTIRE; } )?
            self.increasing(exponential::$at_point)
        }
    )+ };
}

impl Real for Interval {
    #[inline]
    fn from_f64(value: f64) -> Self {
        Self::point(value)
    }
    #[inline]
    fn pi() -> Self {
        Self::PI
    }
    #[inline]
    fn inverse_pi() -> Self {
        Self::INVERSE_PI
    }
    #[inline]
    fn bounds(self) -> (f64, f64) {
        (self.lo, self.hi)
    }
    #[inline]
    fn vanishes(self) -> bool {
        self == Self::ZERO
    }
    fn abs(self) -> Self {
        if self.is_entire() || self.lo >= 0.0 {
            self
        } else if self.hi <= 0.0 {
            -self
        } else {
            Self { lo: 0.0, hi: self.magnitude() }
        }
    }
    fn min(self, other: Self) -> Self {
        if self.is_entire() || other.is_entire() {
            return Self::ENTIRE;
        }
        Self { lo: self.lo.min(other.lo), hi: self.hi.min(other.hi) }
    }
    fn max(self, other: Self) -> Self {
        if self.is_entire() || other.is_entire() {
            return Self::ENTIRE;
        }
        Self { lo: self.lo.max(other.lo), hi: self.hi.max(other.hi) }
    }
    fn square(self) -> Self {
        if self.is_entire() {
            return self;
        }
        let size = self.abs();
        Self { lo: product(size.lo, size.lo).down(), hi: product(size.hi, size.hi).up() }
    }
    fn sqrt(self) -> Self {
        if self.lo < 0.0 {
            return Self::ENTIRE;
        }
        Self { lo: square_root(self.lo).down(), hi: square_root(self.hi).up() }
    }
    fn pow(self, exponent: Self) -> Self {
        if self.lo < 0.0 || self.is_entire() || exponent.is_entire() {
            Self::ENTIRE
        } else if let Some(count) = exponent.small_natural() {
            (0..count).fold(Self::ONE, |power, _| power * self)
        } else if self.lo > 0.0 {
            (exponent * self.ln()).exp()
        } else if exponent.lo < 0.0 {
            Self::ENTIRE
        } else {
            // Zero to a positive power is zero; 1 is a value if the exponent may vanish.
            let at_zero = Self { lo: 0.0, hi: if exponent.lo > 0.0 { 0.0 } else { 1.0 } };
            if self.hi > 0.0 { at_zero.hull((exponent * Self::point(self.hi).ln()).exp()) } else { at_zero }
        }
    }
    fn floor(self) -> Self {
        Self { lo: libm::floor(self.lo), hi: libm::floor(self.hi) }
    }
    fn select_all<const N: usize>(
        self,
        below: impl FnOnce() -> [Self; N],
        above: impl FnOnce() -> [Self; N],
    ) -> [Self; N] {
        if self.is_entire() {
            [Self::ENTIRE; N]
        } else if self.lo > 0.0 {
            above()
        } else if self.hi <= 0.0 {
            below()
        } else {
            let (below, above) = (below(), above());
            core::array::from_fn(|k| below[k].hull(above[k]))
        }
    }
    fn inflate(self, error: f64) -> Self {
        self + Self::symmetric(error)
    }
    fn minus_own_sine(self, sine: Self) -> Self {
        let difference = self - sine;
        if difference.is_entire() {
            return difference;
        }
        circular::minus_own_sine(self, difference)
    }
    circular!(sin cos tan asin acos atan);
    increasing!(
        exp by exp_at, exp_m1 by exp_m1_at, ln by ln_at above 0.0, ln_1p by ln_1p_at above -1.0, sinh by sinh_at, tanh by tanh_at
    );
    fn cosh(self) -> Self {
        self.abs().increasing(exponential::cosh_at)
    }
    fn atanh(self) -> Self {
        if self.is_interior_to(Self::UNIT) { self.increasing(exponential::atanh_at) } else { Self::ENTIRE }
    }
}
