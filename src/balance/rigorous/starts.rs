//! Where to look: balances of a few harmonics with the loop gain free, along curves that folds do not interrupt.

use core::ops::RangeInclusive;

use nalgebra::{DMatrix, DVector};

use super::closed_loop::LipschitzLoop;
use super::refine::COMPARED;
use super::spectrum::Spectrum;
use super::wave::{HarmonicOrders, Wave};
use crate::numeric::scan;

/// Samples of a turn.
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
const SIZE: usize = COMPARED + 2;

/// The direction of a coordinate.
fn along(coordinate: usize) -> Coordinates {
    DVector::from_fn(SIZE, |place, _| f64::from(u8::from(place == coordinate)))
}

impl LipschitzLoop<'_> {
    /// Waves of a few harmonics near which oscillations may be, over a range of frequencies. A scan: it may miss a wave.
    ///
    /// The gain that balances is a function along curves of amplitude and frequency; where it is the loop's own, a wave begins.
    pub(super) fn starts(&self, omega_rad_s: &RangeInclusive<f64>) -> Vec<Wave> {
        let Some([least, largest]) = self.characteristic.bends() else { return Vec::new() };
        let ends = [libm::log(BELOW * least), libm::log(ABOVE * largest)];
        let mut curves: Vec<Vec<Coordinates>> = Vec::new();
        for omega in self.real_crossings(omega_rad_s) {
            for log_amplitude in evenly(ends, (ends[1] - ends[0]) / libm::log(RATIO)) {
                let begin = self.first_harmonic(log_amplitude, omega).and_then(|near| self.corrected(near, &along(2)));
                let Some(begin) = begin else { continue };
                if !curves.iter().any(|curve| is_on(&begin, curve)) {
                    let [down, up] = [-1.0, 1.0].map(|sign| self.traced(&begin, along(2) * sign, ends));
                    curves.push(down.into_iter().rev().chain([begin]).chain(up).collect());
                }
            }
        }
        let crossing = |pair: &[Coordinates]| {
            let (a, b) = (pair[0][1], pair[1][1]);
            ((a < 0.0) != (b < 0.0)).then(|| centre(&pair[0].lerp(&pair[1], a / (a - b))))
        };
        curves.iter().flat_map(|curve| curve.windows(2)).filter_map(crossing).collect()
    }

    /// Frequencies at which `G(jw)` is real.
    fn real_crossings(&self, omega_rad_s: &RangeInclusive<f64>) -> Vec<f64> {
        let ends = [*omega_rad_s.start(), *omega_rad_s.end()];
        let count = (1000.0 + 40.0 * self.plant.delay_s() * ends[1]).min(1e5);
        let nodes: Vec<f64> = evenly(ends.map(libm::log), count).map(libm::exp).collect();
        let mut crossings = scan::roots(&nodes, &mut |omega| Some(self.plant.response(omega).ok()?.im));
        crossings.truncate(CROSSINGS);
        crossings
    }

    /// The balance of the first harmonic alone, at an amplitude and a frequency at which the plant's response is real.
    fn first_harmonic(&self, log_amplitude: f64, omega_rad_s: f64) -> Option<Coordinates> {
        let mut point = along(0) * libm::log(omega_rad_s) + along(2) * log_amplitude;
        let gain = self.sampled(&centre(&point)).output[0].re / libm::exp(log_amplitude);
        point[1] = libm::log(-1.0 / (gain * self.plant.response(omega_rad_s).ok()?.re));
        point[1].is_finite().then_some(point)
    }

    fn sampled(&self, centre: &Wave) -> Spectrum<f64> {
        Spectrum::sampled(centre, |x| self.characteristic.output_and_slope(x), SAMPLES, COMPARED, 2 * COMPARED)
    }

    /// The equations over the amplitude, with a zero for what is perpendicular to a direction; and the derivatives by the coordinates.
    fn equations(&self, point: &Coordinates, direction: &Coordinates) -> (DVector<f64>, DMatrix<f64>) {
        let centre = centre(point);
        let (amplitude, gain, omega) = (centre.amplitude(), libm::exp(point[1]), centre.omega_rad_s);
        let mut spectrum = self.sampled(&centre);
        for harmonic in spectrum.output.iter_mut().chain(&mut spectrum.slope) {
            *harmonic = harmonic.scaled(gain);
        }
        let error = self.residual(omega, &centre, &spectrum) / amplitude;
        let slopes = self.jacobian(omega, &centre, &spectrum);
        let outputs = spectrum.output.iter().flat_map(|output| [output.re, output.im]).collect();
        // All harmonics grow with the amplitude.
        let growing = slopes.columns(1, SIZE - 2) * centre.unknowns().rows(1, SIZE - 2);
        let first = [slopes.column(0) * omega, DVector::from_vec(outputs), growing].map(|column| column / amplitude);
        let columns: Vec<DVector<f64>> =
            first.into_iter().chain(slopes.column_iter().skip(2).map(|column| column.into_owned())).collect();
        let mut bordered = DMatrix::from_columns(&columns).insert_row(SIZE - 1, 0.0);
        bordered.set_row(SIZE - 1, &direction.transpose());
        (error.push(0.0), bordered)
    }

    /// Newton's method from a guess, perpendicular to a direction.
    fn corrected(&self, mut point: Coordinates, direction: &Coordinates) -> Option<Coordinates> {
        for _ in 0..NEWTON_STEPS {
            let (error, slopes) = self.equations(&point, direction);
            let step = slopes.lu().solve(&error)?;
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

    /// The curve from a point on in a direction, up to an end of the range of amplitudes.
    fn traced(&self, begin: &Coordinates, mut direction: Coordinates, ends: [f64; 2]) -> Vec<Coordinates> {
        let mut curve = Vec::new();
        let mut at = begin.clone();
        let mut step = LONGEST;
        while curve.len() < LENGTH && step > SHORTEST {
            // The direction in which the equations stay as they are, on from the last.
            let Some(tangent) = self.equations(&at, &direction).1.lu().solve(&along(SIZE - 1)) else { break };
            let tangent = tangent.normalize();
            let next = self.corrected(&at + &tangent * step, &tangent);
            let Some(next) = next.filter(|next| (next - &at).norm() < 1.5 * step) else {
                step *= 0.5;
                continue;
            };
            (at, direction, step) = (next.clone(), tangent, (1.5 * step).min(LONGEST));
            curve.push(next);
            if !(at[2] >= ends[0] && at[2] <= ends[1] && at[1].abs() < FAR) {
                break;
            }
        }
        curve
    }
}

/// Whether a point lies on a curve, between two of its own.
fn is_on(point: &Coordinates, curve: &[Coordinates]) -> bool {
    curve.windows(2).any(|pair| {
        let (way, from) = (&pair[1] - &pair[0], point - &pair[0]);
        let share = (way.dot(&from) / way.norm_squared()).clamp(0.0, 1.0);
        (from - way * share).amax() < SAME
    })
}

fn centre(point: &Coordinates) -> Wave {
    let (amplitude, orders) = (libm::exp(point[2]), HarmonicOrders::Odd);
    let harmonics: Vec<f64> = [1.0].iter().chain(&point.as_slice()[3..]).map(|part| amplitude * part).collect();
    Wave { omega_rad_s: libm::exp(point[0]), orders, harmonics: orders.pairs(&harmonics) }
}

/// From end to end in at least that many steps; none where the number is not finite.
fn evenly([low, high]: [f64; 2], steps: f64) -> impl Iterator<Item = f64> {
    let count = steps.ceil();
    let last = if count.is_finite() { count as i32 } else { -1 };
    (0..=last).map(move |i| low + (high - low) * f64::from(i) / count)
}
