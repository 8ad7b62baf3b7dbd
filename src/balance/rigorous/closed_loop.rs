//! The loop `x = -G n(x)` in harmonics, `E_k = X_k g_k + N_k = 0`, and its derivatives.

use nalgebra::{DMatrix, DVector, RowDVector};

use super::characteristic::OddCharacteristic;
use super::error::ExistenceError;
use super::inverse_response::InverseResponse;
use super::spectrum::Spectrum;
use super::wave::{HarmonicOrders, Wave};
use crate::numeric::{Complex, Real};
use crate::plant::TransferFunction;

/// Highest harmonic of a wave at most: the equations of all of them are solved together.
pub(super) const HIGHEST: usize = 299;

/// A strictly proper plant with dead time in negative feedback with an odd characteristic of bounded slope.
#[derive(Clone, Debug)]
pub struct LipschitzLoop<'a> {
    pub(super) plant: &'a TransferFunction,
    pub(super) inverse: InverseResponse<'a>,
    pub(super) characteristic: OddCharacteristic,
}

/// A frequency and the harmonics of the characteristic's input, `X_1 = a` real: the subject of a proof, not its result.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Centre {
    pub(super) omega_rad_s: f64,
    pub(super) wave: Wave,
}

impl Centre {
    pub(super) fn new(omega_rad_s: f64, orders: HarmonicOrders, pairs: &[[f64; 2]]) -> Self {
        let harmonics = pairs.iter().map(|&[re, im]| Complex::new(re, im)).collect();
        Self { omega_rad_s, wave: Wave { orders, harmonics } }
    }

    /// Real and imaginary parts of the harmonics.
    pub(super) fn pairs(&self) -> Vec<[f64; 2]> {
        self.wave.harmonics.iter().map(|harmonic| [harmonic.re, harmonic.im]).collect()
    }

    /// Real unknowns: frequency, then the harmonics' parts that are not zero by definition.
    pub(super) fn unknowns(&self) -> DVector<f64> {
        let harmonics = self.pairs();
        DVector::from_vec(core::iter::once(self.omega_rad_s).chain(self.wave.orders.unknowns(&harmonics)).collect())
    }

    /// The centre of new unknowns of the same orders.
    pub(super) fn moved(&self, unknowns: &DVector<f64>) -> Self {
        let orders = self.wave.orders;
        Self::new(unknowns[0], orders, &orders.pairs(&unknowns.as_slice()[1..]))
    }

    pub(super) fn amplitude(&self) -> f64 {
        let first = self.wave.orders.place(1);
        first.and_then(|place| self.wave.harmonics.get(place)).map_or(0.0, |first| first.re)
    }
}

impl<'a> LipschitzLoop<'a> {
    /// The loop.
    ///
    /// # Errors
    /// [`ExistenceError::Feedthrough`] where the plant is not strictly proper, [`ExistenceError::Characteristic`] where a number of
    /// the characteristic is not finite or the kinks are not in order.
    pub fn new(plant: &'a TransferFunction, characteristic: OddCharacteristic) -> Result<Self, ExistenceError> {
        let inverse = InverseResponse::new(plant);
        if inverse.relative_degree() == 0 {
            return Err(ExistenceError::Feedthrough { degree: plant.denominator().len() - 1 });
        }
        Ok(Self { plant, inverse, characteristic: characteristic.checked()? })
    }
}

/// Real and imaginary part of a balance; that of the means is real.
fn parts<T>(k: usize, balance: Complex<T>) -> impl Iterator<Item = T> {
    [balance.re, balance.im].into_iter().take(if k == 0 { 1 } else { 2 })
}

/// `E_k` of every harmonic of the wave.
pub(super) fn residual<T: Real + nalgebra::Scalar>(
    inverse: &InverseResponse<'_>,
    omega: T,
    wave: &Wave,
    spectrum: &Spectrum<T>,
) -> DVector<T> {
    let rows = wave.terms().zip(&spectrum.output).flat_map(|((k, harmonic), &output)| {
        let input = Complex::new(T::from_f64(harmonic.re), T::from_f64(harmonic.im));
        parts(k, input * inverse.at(omega, k).0 + output)
    });
    DVector::from_vec(rows.collect())
}

/// Derivatives of the residual by the unknowns: `dN_k = sum over l of D_(k-l) dX_l + D_(k+l) conj dX_l`, half of it for `k = 0`, and
/// `X_k dg_k/dw` in the first column.
pub(super) fn jacobian<T: Real + nalgebra::Scalar>(
    inverse: &InverseResponse<'_>,
    omega: T,
    wave: &Wave,
    spectrum: &Spectrum<T>,
) -> DMatrix<T> {
    let rows = wave.terms().flat_map(|(k, harmonic)| {
        let (response, response_slope) = inverse.at(omega, k);
        let input = Complex::new(T::from_f64(harmonic.re), T::from_f64(harmonic.im));
        let share = T::from_f64(if k == 0 { 0.5 } else { 1.0 });
        let mut columns = vec![input * response_slope];
        for (l, _) in wave.terms() {
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
