//! The untrusted half: a centre by Newton's method with more and more harmonics, and radii for it. The proof judges both.

use nalgebra::DVector;

use super::brouwer::LinearisedBalance;
use super::closed_loop::LipschitzLoop;
use super::error::CannotTell;
use super::spectrum::{EnclosedSpectrum, enclose};
use super::wave::Wave;
use crate::numeric::{Complex, Interval};

/// Highest harmonic of the balances by which oscillations are found and told apart.
pub(super) const COMPARED: usize = 9;
/// Newton steps at most, and the step, relative to the amplitude, at which rounding takes over.
const STEPS: usize = 20;
const ARRIVED: f64 = 1e-13;
/// Rounds in which the radii are enlarged until their image is inside, and proofs tried with them.
const ROUNDS: usize = 40;
const PROOFS: usize = 3;

impl LipschitzLoop<'_> {
    fn spectrum(&self, centre: &Wave) -> Result<EnclosedSpectrum, CannotTell> {
        let reach = centre.sum_of_magnitudes(0).upper();
        enclose(&self.characteristic, centre, reach, 0.0)
    }

    /// The balance of the harmonics up to `highest` near a centre with fewer.
    pub(super) fn refine(&self, mut centre: Wave, highest: usize) -> Result<Wave, CannotTell> {
        let output = self.spectrum(&centre)?.harmonics.output;
        let orders = centre.orders;
        for place in centre.harmonics.len()..orders.count(highest) {
            let response = self.inverse_response(centre.omega_rad_s, orders.at(place)).0;
            let input = -output.get(place).map_or(Complex::zero(), |output| output.midpoint()).over(response);
            centre.harmonics.push([input.re, input.im]);
        }
        let (omega, amplitude) = (centre.omega_rad_s, centre.amplitude());
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let spectrum = self.spectrum(&centre)?.harmonics;
            let at = Interval::point(centre.omega_rad_s);
            let error = self.residual(at, &centre, &spectrum).map(Interval::midpoint);
            let slopes = self.jacobian(at, &centre, &spectrum).map(Interval::midpoint);
            let step = slopes.lu().solve(&error).ok_or(CannotTell::NoBalance)?;
            let size = step.amax() / amplitude;
            // A long step is shortened, as the kinks move under it.
            let share = (0.2 / size).min(1.0);
            centre = centre.moved(&(centre.unknowns() - share * step));
            let near = |value: f64, start: f64| value > 0.5 * start && value < 2.0 * start;
            if !(near(centre.amplitude(), amplitude) && near(centre.omega_rad_s, omega)) {
                return Err(CannotTell::NoBalance);
            }
            if size <= ARRIVED || (size < 1e-9 && size >= 0.5 * last) {
                return Ok(centre);
            }
            last = size;
        }
        Err(CannotTell::NoBalance)
    }

    /// Radii for which the proof holds, with its remainder.
    pub(super) fn enclose_near(&self, centre: &Wave) -> Result<(DVector<f64>, f64), CannotTell> {
        let mut radii = DVector::zeros(centre.unknowns().len());
        let mut why = CannotTell::NoContraction { ratio: f64::INFINITY };
        for _ in 0..PROOFS {
            let linearised = self.linearise(centre, &radii)?;
            radii = linearised.radii(radii.len()).ok_or(why)?;
            match self.holds(centre, &radii) {
                Ok(shown) => return Ok((radii, shown)),
                Err(no_contraction @ CannotTell::NoContraction { .. }) => why = no_contraction,
                Err(other) => return Err(other),
            }
        }
        Err(why)
    }
}

impl LinearisedBalance {
    /// Radii whose image is well inside, frequencies and kinks as they were.
    fn radii(&self, count: usize) -> Option<DVector<f64>> {
        let mut radii = DVector::zeros(count);
        for _ in 0..=ROUNDS {
            let (images, _) = self.images(&radii);
            if images.iter().zip(&radii).all(|(image, radius)| *image < 0.9 * radius) {
                return Some(radii);
            }
            radii = DVector::from_vec(images.into_iter().map(|image| 1.25 * image + 1e-300).collect());
        }
        None
    }
}
