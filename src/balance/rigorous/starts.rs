//! Where to look: balances of a few harmonics with the loop gain free, along curves that folds do not interrupt.

use core::ops::RangeInclusive;

use nalgebra::{DMatrix, DVector};

use super::closed_loop::{Centre, LipschitzLoop, jacobian, residual};
use super::spectrum::Spectrum;
use super::wave::HarmonicOrders;
use crate::numeric::scan;

/// Highest harmonic, and samples of a turn.
const HIGHEST: usize = 9;
const SAMPLES: usize = 256;
/// Amplitudes from this share of the first bend to this multiple of the last.
const BELOW: f64 = 0.2;
const ABOVE: f64 = 100.0;
/// Ratio of neighbouring amplitudes at which a curve may begin.
const RATIO: f64 = 1.5;
/// Crossings of the real axis that are followed, at most: a dead time has infinitely many.
const CROSSINGS: usize = 8;
/// Steps along a curve, in logarithms of frequency, gain and amplitude: longest, shortest, and how many.
const LONGEST: f64 = 0.04;
const SHORTEST: f64 = 1e-4;
const LENGTH: usize = 2000;
/// Newton steps at most, and the step that ends them: samples of a kink move the derivative in jumps.
const NEWTON_STEPS: usize = 8;
const ARRIVED: f64 = 1e-7;
/// Logarithm of the gain at which a curve ends.
const FAR: f64 = 6.0;
/// Distance between two curves' points that makes them the same curve.
const SAME: f64 = 1e-3;

/// Logarithms of frequency, gain and amplitude, then real and imaginary parts of `X_k/a` from k = 3.
type Coordinates = DVector<f64>;

impl LipschitzLoop<'_> {
    /// Waves of a few harmonics near which oscillations may be, over a range of frequencies. A scan: it may miss a wave.
    ///
    /// The gain that balances is a function along curves of amplitude and frequency; where it is the loop's own, a wave begins.
    pub(super) fn starts(&self, omega_rad_s: &RangeInclusive<f64>) -> Vec<Centre> {
        let (low, high) = self.characteristic.bends();
        let range = libm::log(BELOW * low)..=libm::log(ABOVE * high);
        let count = ((range.end() - range.start()) / libm::log(RATIO)).ceil();
        if !count.is_finite() {
            return Vec::new();
        }
        let count = count as i32;
        let mut curves: Vec<Vec<Coordinates>> = Vec::new();
        for omega in self.real_crossings(omega_rad_s) {
            for i in 0..=count {
                let log_amplitude = range.start() + (range.end() - range.start()) * f64::from(i) / f64::from(count);
                let along = DVector::from_fn(3 + HIGHEST - 1, |place, _| f64::from(u8::from(place == 2)));
                let begin = self.first_harmonic(log_amplitude, omega).and_then(|start| self.corrected(start, &along));
                let Some(begin) = begin else { continue };
                if !curves.iter().any(|curve| is_on(&begin, curve)) {
                    let mut curve = self.traced(&begin, -1.0, &range);
                    curve.reverse();
                    curve.push(begin.clone());
                    curve.extend(self.traced(&begin, 1.0, &range));
                    curves.push(curve);
                }
            }
        }
        let mut found: Vec<Centre> = Vec::new();
        for pair in curves.iter().flat_map(|curve| curve.windows(2)) {
            let (a, b) = (pair[0][1], pair[1][1]);
            if (a < 0.0) != (b < 0.0) {
                let between = &pair[0] + (&pair[1] - &pair[0]) * (a / (a - b));
                found.push(centre(&between));
            }
        }
        found
    }

    /// Frequencies at which `G(jw)` is real.
    fn real_crossings(&self, omega_rad_s: &RangeInclusive<f64>) -> Vec<f64> {
        let (low, high) = (libm::log(*omega_rad_s.start()), libm::log(*omega_rad_s.end()));
        let turn = self.plant.delay_s() * omega_rad_s.end();
        let count = (1000.0 + 40.0 * turn).min(1e5) as i32;
        let nodes: Vec<f64> =
            (0..=count).map(|i| libm::exp(low + (high - low) * f64::from(i) / f64::from(count))).collect();
        let mut crossings = scan::roots(&nodes, |omega| Some(self.plant.response(omega).ok()?.im));
        crossings.truncate(CROSSINGS);
        crossings
    }

    /// The balance of the first harmonic alone, at an amplitude and a frequency at which the plant's response is real.
    fn first_harmonic(&self, log_amplitude: f64, omega_rad_s: f64) -> Option<Coordinates> {
        let mut point = DVector::zeros(3 + HIGHEST - 1);
        (point[0], point[2]) = (libm::log(omega_rad_s), log_amplitude);
        let gain = self.sampled(&centre(&point)).output[0].re / libm::exp(log_amplitude);
        let factor = -1.0 / (gain * self.plant.response(omega_rad_s).ok()?.re);
        point[1] = libm::log(factor);
        point[1].is_finite().then_some(point)
    }

    fn sampled(&self, centre: &Centre) -> Spectrum<f64> {
        Spectrum::sampled(&centre.wave, |x| self.characteristic.output_and_slope(x), SAMPLES, HIGHEST, 2 * HIGHEST)
    }

    /// The equations over the amplitude, and their derivatives by the coordinates of a point.
    fn equations(&self, point: &Coordinates) -> (DVector<f64>, DMatrix<f64>) {
        let centre = centre(point);
        let (amplitude, gain) = (centre.amplitude(), libm::exp(point[1]));
        let mut spectrum = self.sampled(&centre);
        for harmonic in spectrum.output.iter_mut().chain(&mut spectrum.slope) {
            *harmonic = harmonic.scaled(gain);
        }
        let error = residual(&self.inverse, centre.omega_rad_s, &centre.wave, &spectrum) / amplitude;
        let slopes = jacobian(&self.inverse, centre.omega_rad_s, &centre.wave, &spectrum);
        let unknowns = centre.unknowns();
        let outputs = spectrum.output.iter().flat_map(|output| [output.re, output.im]).collect();
        let mut by_point = DMatrix::zeros(slopes.nrows(), slopes.ncols() + 1);
        by_point.set_column(0, &(slopes.column(0) * (centre.omega_rad_s / amplitude)));
        by_point.set_column(1, &(DVector::from_vec(outputs) / amplitude));
        // All harmonics grow with the amplitude.
        let growing = (1..unknowns.len()).map(|i| slopes.column(i) * (unknowns[i] / amplitude));
        by_point.set_column(2, &growing.fold(DVector::zeros(slopes.nrows()), |sum, column| sum + column));
        for i in 2..unknowns.len() {
            by_point.set_column(i + 1, &slopes.column(i));
        }
        (error, by_point)
    }

    /// Newton's method from a guess, perpendicular to `along`.
    fn corrected(&self, mut point: Coordinates, along: &Coordinates) -> Option<Coordinates> {
        for _ in 0..NEWTON_STEPS {
            let (error, slopes) = self.equations(&point);
            let step = bordered(&slopes, along).lu().solve(&error.push(0.0))?;
            let size = step.amax();
            if !(size < 1.0) {
                return None;
            }
            point -= step;
            if size < ARRIVED {
                return Some(point);
            }
        }
        None
    }

    /// The curve through a point, in either direction, up to the end of the range.
    fn traced(&self, begin: &Coordinates, sign: f64, range: &RangeInclusive<f64>) -> Vec<Coordinates> {
        let mut curve = Vec::new();
        let mut at = begin.clone();
        let mut along = DVector::from_fn(at.len(), |place, _| f64::from(u8::from(place == 2)) * sign);
        let mut step = LONGEST;
        while curve.len() < LENGTH && step > SHORTEST {
            // The direction in which the equations stay as they are, on from the last direction.
            let (_, slopes) = self.equations(&at);
            let onwards = DVector::from_fn(at.len(), |place, _| f64::from(u8::from(place + 1 == at.len())));
            let Some(tangent) = bordered(&slopes, &along).lu().solve(&onwards) else { break };
            let tangent = tangent.normalize();
            let next = self.corrected(&at + &tangent * step, &tangent);
            match next.filter(|next| (next - &at).norm() < 1.5 * step) {
                Some(next) => {
                    let inside = range.contains(&next[2]) && next[1].abs() < FAR;
                    (at, along) = (next.clone(), tangent);
                    curve.push(next);
                    if !inside {
                        break;
                    }
                    step = (1.5 * step).min(LONGEST);
                }
                None => step *= 0.5,
            }
        }
        curve
    }
}

fn bordered(slopes: &DMatrix<f64>, along: &Coordinates) -> DMatrix<f64> {
    let mut matrix = slopes.clone().insert_row(slopes.nrows(), 0.0);
    matrix.set_row(slopes.nrows(), &along.transpose());
    matrix
}

/// Whether a point lies on a curve, between two of its own.
fn is_on(point: &Coordinates, curve: &[Coordinates]) -> bool {
    curve.windows(2).any(|pair| {
        let (way, from) = (&pair[1] - &pair[0], point - &pair[0]);
        let share = (way.dot(&from) / way.norm_squared()).clamp(0.0, 1.0);
        (from - way * share).amax() < SAME
    })
}

fn centre(point: &Coordinates) -> Centre {
    let amplitude = libm::exp(point[2]);
    let higher = point.as_slice()[3..].chunks_exact(2).map(|pair| [amplitude * pair[0], amplitude * pair[1]]);
    let harmonics: Vec<[f64; 2]> = core::iter::once([amplitude, 0.0]).chain(higher).collect();
    Centre::new(libm::exp(point[0]), HarmonicOrders::Odd, &harmonics)
}
