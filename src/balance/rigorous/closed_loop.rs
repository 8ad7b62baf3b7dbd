//! The loop `x = -G n(x)` in harmonics, `E_k = X_k g_k + N_k = 0` for odd k, and its derivatives.

use nalgebra::{DMatrix, DVector};

use super::characteristic::OddCharacteristic;
use super::error::ExistenceError;
use super::inverse_response::InverseResponse;
use super::spectrum::Spectrum;
use super::wave::Wave;
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

/// A frequency and the harmonics of the characteristic's input, `X_1 = a` real: what a proof is about, not what is shown.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Centre {
    pub(super) omega_rad_s: f64,
    pub(super) wave: Wave,
}

impl Centre {
    /// Real unknowns in order: frequency, a, then real and imaginary parts of X_3, X_5, ...
    pub(super) fn unknowns(&self) -> DVector<f64> {
        let higher = self.wave.0.iter().skip(1).flat_map(|harmonic| [harmonic.re, harmonic.im]);
        DVector::from_vec([self.omega_rad_s, self.amplitude()].into_iter().chain(higher).collect())
    }

    pub(super) fn from_unknowns(unknowns: &DVector<f64>) -> Self {
        let first = Complex::new(unknowns[1], 0.0);
        let higher = unknowns.as_slice()[2..].chunks_exact(2).map(|pair| Complex::new(pair[0], pair[1]));
        Self { omega_rad_s: unknowns[0], wave: Wave(core::iter::once(first).chain(higher).collect()) }
    }

    pub(super) fn amplitude(&self) -> f64 {
        self.wave.0.first().map_or(0.0, |first| first.re)
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

/// `E_k` of every harmonic of the wave, real and imaginary parts in turn.
pub(super) fn residual<T: Real + nalgebra::Scalar>(
    inverse: &InverseResponse<'_>,
    omega: T,
    wave: &Wave,
    spectrum: &Spectrum<T>,
) -> DVector<T> {
    let rows = wave.orders().zip(&spectrum.output).flat_map(|((k, harmonic), &output)| {
        let input = Complex::new(T::from_f64(harmonic.re), T::from_f64(harmonic.im));
        let error = input * inverse.at(omega, k).0 + output;
        [error.re, error.im]
    });
    DVector::from_vec(rows.collect())
}

/// Derivatives of the residual by the unknowns: `dN_k = D_(k-l) dX_l + D_(k+l) conj dX_l`, and `X_k dg_k/dw` in the first column.
pub(super) fn jacobian<T: Real + nalgebra::Scalar>(
    inverse: &InverseResponse<'_>,
    omega: T,
    wave: &Wave,
    spectrum: &Spectrum<T>,
) -> DMatrix<T> {
    let size = wave.highest() + 1;
    let mut matrix = DMatrix::from_element(size, size, T::zero());
    for (row, (k, harmonic)) in wave.orders().enumerate() {
        let (response, response_slope) = inverse.at(omega, k);
        let input = Complex::new(T::from_f64(harmonic.re), T::from_f64(harmonic.im));
        let mut set = |column: usize, entry: Complex<T>| {
            matrix[(2 * row, column)] = entry.re;
            matrix[(2 * row + 1, column)] = entry.im;
        };
        set(0, input * response_slope);
        for (place, (l, _)) in wave.orders().enumerate() {
            let (below, above) =
                (spectrum.slope_at(k as isize - l as isize), spectrum.slope_at(k as isize + l as isize));
            let below = if k == l { below + response } else { below };
            // The first harmonic has no imaginary part: column 1 is a, columns 2 and 3 are X_3.
            let real_column = if place == 0 { 1 } else { 2 * place };
            set(real_column, below + above);
            if place > 0 {
                set(2 * place + 1, (below - above).times_j());
            }
        }
    }
    matrix
}
