//! Complex numbers over any arithmetic of this crate; over intervals, rectangles that enclose.

use core::ops::{Add, Mul, Neg, Sub};

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

impl<T: Real> Add for Complex<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl<T: Real> Sub for Complex<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }
}

impl<T: Real> Neg for Complex<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.re, -self.im)
    }
}

impl<T: Real> Mul for Complex<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
    }
}
