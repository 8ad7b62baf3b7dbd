//! What one pair of imaginary poles of a characteristic adds to its describing function, and what the poles on a line do.

use core::ops::{Add, Mul};

use crate::nonlinearity::Sinusoid;
use crate::numeric::Real;

/// `re + i im`; just what the formulas here need.
#[derive(Clone, Copy, Debug)]
pub(super) struct Complex<T> {
    pub(super) re: T,
    pub(super) im: T,
}

impl<T: Real> Add for Complex<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<T: Real> Mul for Complex<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}

impl<T: Real> Mul<T> for Complex<T> {
    type Output = Self;
    fn mul(self, factor: T) -> Self {
        Self { re: self.re * factor, im: self.im * factor }
    }
}

impl<T: Real> Complex<T> {
    pub(super) fn inverse(self) -> Self {
        let square = self.re.square() + self.im.square();
        Self { re: self.re / square, im: -self.im / square }
    }
}

/// The pole pair `x = +-i c/k` of a characteristic with argument `kx`, under a sweep with `beta = kB`, `kappa = kX`.
///
/// With `w = c - i beta` and `S = sqrt(w^2 + kappa^2)` the mean of `1/(w + i kappa sin)` over the circle is `1/S`, and
/// the mean of `sin/(w + i kappa sin)` is `-i kappa/(S (w + S))`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pole<T> {
    /// `w`.
    pub(super) position: Complex<T>,
    /// `S`.
    pub(super) root: Complex<T>,
}

impl<T: Real> Pole<T> {
    /// `S` as the product of the roots of `c - i k (B + X)` and `c - i k (B - X)`; its smaller part comes from
    /// `Im S^2 = -2 c beta`, so that nothing cancels.
    pub(super) fn new(c: T, scale: T, sweep: &Sinusoid<T>) -> Self {
        let position = Complex { re: c, im: -(scale * sweep.bias()) };
        let half = |y: T| {
            let re = (((c.square() + y.square()).sqrt() + c) / T::two()).sqrt();
            Complex { re, im: -y / (T::two() * re) }
        };
        let (upper, lower) = (scale * sweep.maximum(), scale * sweep.minimum());
        let (a, b) = (half(upper), half(lower));
        let product = a * b;
        let cross = c * position.im;
        let one_sided = upper * lower;
        let re = one_sided.select(|| product.re, || cross / product.im);
        let im = one_sided.select(|| cross / product.re, || product.im);
        Self { position, root: Complex { re, im } }
    }

    /// `w + S`.
    pub(super) fn sum(self) -> Complex<T> {
        self.position + self.root
    }

    /// `-arg(w + S)`, the integral of `Im 1/S` over c from here to infinity.
    pub(super) fn angle(self) -> T {
        let sum = self.sum();
        (-sum.im / sum.re).atan()
    }
}
