//! Contribution of a pair of imaginary poles to a describing function, and that of all poles on a line.

use crate::nonlinearity::Sinusoid;
use crate::numeric::{Complex, Real};

/// The pole pair `x = +-i c/k` of a characteristic with argument `kx`, under a sweep with `beta = kB`, `kappa = kX`.
///
/// With `w = c - i beta` and `S = sqrt(w^2 + kappa^2)` the mean of `1/(w + i kappa sin)` over the circle is `1/S`, and
/// the mean of `sin/(w + i kappa sin)` is `-i kappa/(S (w + S))`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pole<T> {
    /// `w`.
    pub(super) position: Complex<T>,
    /// `S`, its real part positive.
    pub(super) root: Complex<T>,
    /// `abs(S)^2`.
    pub(super) square: T,
}

/// The bias and both ends of a sweep, times the scale; the squares and the product of the ends serve every pole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scaled<T> {
    bias: T,
    ends: [T; 2],
    squares: [T; 2],
    product: T,
}

impl<T: Real> Scaled<T> {
    pub(super) fn new(scale: T, sweep: &Sinusoid<T>) -> Self {
        Self::from_ends(scale * sweep.bias(), [sweep.minimum(), sweep.maximum()].map(|end| scale * end))
    }

    fn from_ends(bias: T, ends: [T; 2]) -> Self {
        Self { bias, ends, squares: ends.map(T::square), product: ends[0] * ends[1] }
    }

    /// Moved by a bias.
    pub(super) fn moved(&self, by: T) -> Self {
        Self::from_ends(self.bias + by, self.ends.map(|end| end + by))
    }

    pub(super) fn bias(&self) -> T {
        self.bias
    }
}

impl<T: Real> Pole<T> {
    /// `abs(S)^2` is `abs(c - i upper) abs(c - i lower)`, and the real part of `S^2` is `c^2 - upper lower`. The larger part of S
    /// comes from their sum or difference, the smaller part from `Im S^2 = -2 c beta`, so that nothing cancels. Either way the parts are the same, because
    /// `(c^2 + upper^2)(c^2 + lower^2) = (c^2 - upper lower)^2 + c^2 (upper + lower)^2`.
    pub(super) fn new(c: T, scaled: &Scaled<T>) -> Self {
        let c_square = c.square();
        let [a, b] = scaled.squares.map(|end| (c_square + end).sqrt());
        let (square, real) = (a * b, c_square - scaled.product);
        let half = T::from_f64(0.5);
        let cross = -c * scaled.bias;
        let [re, im] = real.prefer_all(
            || {
                let size = (half * (square - real)).sqrt();
                let im = cross.select(|| -size, || size);
                [cross / im, im]
            },
            || {
                let re = (half * (square + real)).sqrt();
                [re, cross / re]
            },
        );
        Self { position: Complex { re: c, im: -scaled.bias }, root: Complex { re, im }, square }
    }

    /// `w + S`.
    pub(super) fn sum(&self) -> Complex<T> {
        self.position + self.root
    }

    /// Imaginary part of `1/S`.
    pub(super) fn mean(&self) -> T {
        -self.root.im / self.square
    }

    /// `1/(S (w + S))`.
    pub(super) fn component(&self) -> Complex<T> {
        let (sum, root) = (self.sum(), self.root);
        let size = self.square * (sum.re.square() + sum.im.square());
        let re = (root.re * sum.re - root.im * sum.im) / size;
        Complex { re, im: -(root.re * sum.im + root.im * sum.re) / size }
    }

    /// `-arg(w + S)`, the integral of [`mean`](Self::mean) over c from here to infinity.
    pub(super) fn mean_beyond(&self) -> T {
        let sum = self.sum();
        (-sum.im / sum.re).atan()
    }

    /// Real part of `1/(w + S)`, the integral of that of [`component`](Self::component) over c from here to infinity.
    pub(super) fn component_beyond(&self) -> T {
        let sum = self.sum();
        sum.re / (sum.re.square() + sum.im.square())
    }
}
