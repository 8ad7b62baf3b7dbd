//! Complex numbers over any arithmetic of this crate; over intervals, rectangles that enclose.

use core::ops::{Add, Mul, Neg, Sub};

use crate::numeric::{Interval, Real};

/// `re + j im`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Phasor<T> {
    pub(super) re: T,
    pub(super) im: T,
}

impl<T: Real> Phasor<T> {
    pub(super) fn new(re: T, im: T) -> Self {
        Self { re, im }
    }

    pub(super) fn zero() -> Self {
        Self::new(T::zero(), T::zero())
    }

    /// `exp(j angle)`.
    pub(super) fn turn(angle: T) -> Self {
        Self::new(angle.cos(), angle.sin())
    }

    pub(super) fn conj(self) -> Self {
        Self::new(self.re, -self.im)
    }

    pub(super) fn times_j(self) -> Self {
        Self::new(-self.im, self.re)
    }

    pub(super) fn scaled(self, factor: T) -> Self {
        Self::new(self.re * factor, self.im * factor)
    }

    pub(super) fn square_norm(self) -> T {
        self.re.square() + self.im.square()
    }

    pub(super) fn over(self, divisor: Self) -> Self {
        (self * divisor.conj()).scaled(T::one() / divisor.square_norm())
    }
}

impl Phasor<f64> {
    pub(super) fn enclosed(self) -> Phasor<Interval> {
        Phasor::new(Interval::point(self.re), Interval::point(self.im))
    }
}

impl Phasor<Interval> {
    pub(super) fn midpoint(self) -> Phasor<f64> {
        Phasor::new(self.re.midpoint(), self.im.midpoint())
    }

    pub(super) fn norm(self) -> Interval {
        self.square_norm().sqrt()
    }
}

impl<T: Real> Add for Phasor<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl<T: Real> Sub for Phasor<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }
}

impl<T: Real> Neg for Phasor<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.re, -self.im)
    }
}

impl<T: Real> Mul for Phasor<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
    }
}
