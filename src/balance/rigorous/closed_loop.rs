//! The loop `x = -G n(x)` in harmonics, `E_k = X_k g_k + N_k = 0` with `g_k(w) = 1/G(jkw)`, and its derivatives.

use nalgebra::{DMatrix, DVector, RowDVector};

use super::characteristic::OddCharacteristic;
use super::error::ExistenceError;
use super::spectrum::Spectrum;
use super::wave::Wave;
use crate::numeric::{Complex, Interval, Real};
use crate::plant::TransferFunction;

/// A strictly proper plant with dead time in negative feedback with an odd characteristic of bounded slope.
#[derive(Clone, Debug)]
pub struct LipschitzLoop<'a> {
    pub(super) plant: &'a TransferFunction,
    pub(super) characteristic: OddCharacteristic,
}

impl<'a> LipschitzLoop<'a> {
    /// The loop.
    ///
    /// # Errors
    /// [`ExistenceError::Feedthrough`] where the plant is not strictly proper, [`ExistenceError::Characteristic`] where a number of
    /// the characteristic is not finite or the kinks are not in order.
    pub fn new(plant: &'a TransferFunction, characteristic: OddCharacteristic) -> Result<Self, ExistenceError> {
        let found = Self { plant, characteristic: characteristic.checked()? };
        if found.relative_degree() == 0 {
            return Err(ExistenceError::Feedthrough { degree: plant.denominator().len() - 1 });
        }
        Ok(found)
    }
}

/// Real and imaginary part of a balance; that of the means is real.
fn parts<T>(k: usize, balance: Complex<T>) -> impl Iterator<Item = T> {
    [balance.re, balance.im].into_iter().take(if k == 0 { 1 } else { 2 })
}

impl LipschitzLoop<'_> {
    /// Degree of the denominator less that of the numerator.
    pub(super) fn relative_degree(&self) -> usize {
        self.plant.denominator().len() - self.plant.numerator().len()
    }

    /// `g_k` and its derivative by `w`: with `s = jkw`, `dg_k/dw = jk exp(s L) ((D' N - D N')/N^2 + L D/N)`.
    pub(super) fn inverse_response<T: Real>(&self, omega: T, k: usize) -> (Complex<T>, Complex<T>) {
        let order = T::from_f64(k as f64);
        let y = order * omega;
        let (denominator, denominator_slope) = polynomial(self.plant.denominator(), y);
        let (numerator, numerator_slope) = polynomial(self.plant.numerator(), y);
        let delay = T::from_f64(self.plant.delay_s());
        let turn = if delay.vanishes() { Complex::new(T::one(), T::zero()) } else { Complex::turn(y * delay) };
        let plain = denominator.over(numerator);
        let slope = (denominator_slope - plain * numerator_slope).over(numerator);
        (plain * turn, ((slope + plain.scaled(delay)) * turn).times_j().scaled(order))
    }

    /// A number `c` with `abs(g(jy)) >= c y^q` for all `y >= from`, q the relative degree: lower orders count less as y grows.
    pub(super) fn growth(&self, from: Interval) -> Interval {
        // The share of the orders below the leading order: sum over i of abs(p_i/p_n) y^(i - n).
        let share = |coefficients: &[f64]| {
            let mut power = Interval::ONE;
            coefficients.iter().skip(1).fold(Interval::ZERO, |sum, &coefficient| {
                power = power / from;
                sum + (Interval::point(coefficient) / Interval::point(coefficients[0])).abs() * power
            })
        };
        let (denominator, numerator) = (self.plant.denominator(), self.plant.numerator());
        let leading = (Interval::point(denominator[0]) / Interval::point(numerator[0])).abs();
        leading * (Interval::ONE - share(denominator)) / (Interval::ONE + share(numerator))
    }

    /// `E_k` of every harmonic of the wave, at a frequency.
    pub(super) fn residual<T: Real + nalgebra::Scalar>(
        &self,
        omega: T,
        wave: &Wave,
        spectrum: &Spectrum<T>,
    ) -> DVector<T> {
        let rows = wave
            .terms::<T>()
            .zip(&spectrum.output)
            .flat_map(|((k, input), &output)| parts(k, input * self.inverse_response(omega, k).0 + output));
        DVector::from_vec(rows.collect())
    }

    /// Derivatives of the residual by the unknowns: `dN_k = sum over l of D_(k-l) dX_l + D_(k+l) conj dX_l`, half of it for `k = 0`, and
    /// `X_k dg_k/dw` in the first column.
    pub(super) fn jacobian<T: Real + nalgebra::Scalar>(
        &self,
        omega: T,
        wave: &Wave,
        spectrum: &Spectrum<T>,
    ) -> DMatrix<T> {
        let rows = wave.terms::<T>().flat_map(|(k, input)| {
            let (response, response_slope) = self.inverse_response(omega, k);
            let share = T::from_f64(if k == 0 { 0.5 } else { 1.0 });
            let mut columns = vec![input * response_slope];
            for (l, _) in wave.terms::<T>() {
                let slope = |m: isize| spectrum.slope_at(m).scaled(share);
                let (below, above) = (slope(k as isize - l as isize), slope((k + l) as isize));
                let below = if k == l { below + response } else { below };
                columns.push(below + above);
                if l > 1 {
                    columns.push((below - above).times_j());
                }
            }
            let row = |part: fn(&Complex<T>) -> T| RowDVector::from_iterator(columns.len(), columns.iter().map(part));
            parts(k, Complex { re: row(|entry| entry.re), im: row(|entry| entry.im) }).collect::<Vec<_>>()
        });
        DMatrix::from_rows(&rows.collect::<Vec<_>>())
    }
}

/// Value and derivative by `s` of a polynomial in descending powers at `s = jy`.
fn polynomial<T: Real>(descending: &[f64], y: T) -> (Complex<T>, Complex<T>) {
    descending.iter().fold((Complex::zero(), Complex::zero()), |(value, slope), &coefficient| {
        let value_next = value.times_j().scaled(y) + Complex::new(T::from_f64(coefficient), T::zero());
        (value_next, slope.times_j().scaled(y) + value)
    })
}
