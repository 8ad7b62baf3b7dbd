//! Complex numbers over any arithmetic of this crate; over intervals, rectangles that enclose.

use super::real::operators;
use super::{Interval, Real};

/// `re + j im`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Complex<T> {
    pub(crate) re: T,
    pub(crate) im: T,
}

impl<T: Real> Complex<T> {
    pub(crate) fn new(re: T, im: T) -> Self {
        Self { re, im }
    }

    pub(crate) fn zero() -> Self {
        Self::new(T::zero(), T::zero())
    }

    /// `exp(j angle)`.
    pub(crate) fn turn(angle: T) -> Self {
        Self::new(angle.cos(), angle.sin())
    }

    pub(crate) fn conjugate(self) -> Self {
        Self::new(self.re, -self.im)
    }

    pub(crate) fn times_j(self) -> Self {
        Self::new(-self.im, self.re)
    }

    pub(crate) fn scaled(self, factor: T) -> Self {
        Self::new(self.re * factor, self.im * factor)
    }

    pub(crate) fn square_norm(self) -> T {
        self.re.square() + self.im.square()
    }

    pub(crate) fn over(self, divisor: Self) -> Self {
        (self * divisor.conjugate()).scaled(T::one() / divisor.square_norm())
    }
}

impl Complex<Interval> {
    pub(crate) fn midpoint(self) -> Complex<f64> {
        Complex::new(self.re.midpoint(), self.im.midpoint())
    }

    pub(crate) fn norm(self) -> Interval {
        self.square_norm().sqrt()
    }
}

operators! {
    [Complex<T>, T: Real]
    Neg::neg = |a| Self::new(-a.re, -a.im);
    Add::add = |a, b| Self::new(a.re + b.re, a.im + b.im);
    Sub::sub = |a, b| Self::new(a.re - b.re, a.im - b.im);
    Mul::mul = |a, b| Self::new(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re);
}
