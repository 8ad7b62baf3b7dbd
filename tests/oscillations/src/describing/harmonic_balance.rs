//! Harmonic balance with many odd harmonics, by Newton's iteration.

use num_complex::Complex64;

use super::characteristic::Characteristic;
use super::first_harmonic::{FirstHarmonic, Segment};
use super::spectrum::{Spectrum, odd};
use crate::linear::solve;
use crate::plant::Plant;
use crate::scalar::Scalar;

/// A half-wave symmetric oscillation `y = Re sum X_k e^(ik omega t)`, k odd, `X_1` real.
#[derive(Clone, Debug)]
pub struct Balance {
    /// Frequency in rad/s.
    pub omega: f64,
    /// What the loop gain has to be divided by for the oscillation: 1 for one of the loop itself.
    pub inverse_gain: f64,
    /// `X_1, X_3, ...`
    pub harmonics: Vec<Complex64>,
}

/// The unknown beside frequency and higher harmonics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Free {
    /// Amplitude of the first harmonic, at the loop's own gain.
    Amplitude,
    /// The loop gain, at a given amplitude.
    Gain,
}

/// Highest harmonic of the balance that judges.
pub const HIGHEST: usize = 397;
/// Highest harmonic while amplitudes are scanned.
const SCANNED: usize = 29;
/// Amplitudes scanned.
const AMPLITUDES: usize = 240;

/// `G(s)` and `dG/ds` with dead time.
#[must_use]
pub fn response(plant: &Plant, s: Complex64) -> (Complex64, Complex64) {
    let value = |coefficients: &[f64]| {
        let zero = (Complex64::ZERO, Complex64::ZERO);
        coefficients.iter().fold(zero, |(value, slope), &c| (value * s + c, slope * s + value))
    };
    let ((num, num_slope), (den, den_slope)) = (value(&plant.num), value(&plant.den));
    let late = (-plant.delay * s).exp();
    let gain = num / den * late;
    (gain, (num_slope - num * den_slope / den) / den * late - plant.delay * gain)
}

impl Balance {
    /// Odd harmonics up to the 29th of a period of a motion, the first one turned to be real.
    #[must_use]
    pub fn of<S: Scalar>(segments: &[Segment<S>], omega: f64) -> Self {
        let harmonic = |number: usize| {
            let found = FirstHarmonic::of(segments, number);
            Complex64::new(found.cosine.to_f64(), -found.sine.to_f64())
        };
        let turn = -harmonic(1).arg();
        let turned = |k: usize| harmonic(k) * Complex64::cis(turn * k as f64);
        Self { omega, inverse_gain: 1.0, harmonics: (1..=SCANNED).step_by(2).map(turned).collect() }
    }

    /// The balance nearest to a first harmonic, with [`HIGHEST`] harmonics: by way of that of the same amplitude.
    #[must_use]
    pub fn near(plant: &Plant, characteristic: &Characteristic, amplitude: f64, omega: f64) -> Option<Self> {
        let mut harmonics = vec![Complex64::ZERO; SCANNED.div_ceil(2)];
        harmonics[0] = Complex64::from(amplitude);
        let sinusoid = Self { omega, inverse_gain: 1.0, harmonics };
        sinusoid.newton(plant, characteristic, Free::Gain)?.refined(plant, characteristic, HIGHEST)
    }

    /// Amplitude of the first harmonic.
    #[must_use]
    pub fn amplitude(&self) -> f64 {
        self.harmonics[0].re
    }

    /// The balance with more harmonics, from this one.
    #[must_use]
    pub fn refined(&self, plant: &Plant, characteristic: &Characteristic, highest: usize) -> Option<Self> {
        let mut start = self.clone();
        start.harmonics.resize(highest.div_ceil(2), Complex64::ZERO);
        start.inverse_gain = 1.0;
        start.newton(plant, characteristic, Free::Amplitude)
    }

    /// Output and its first derivatives as multiples of harmonics: the state `z, z', ...` of a monic denominator at an angle.
    #[must_use]
    pub fn state(&self, plant: &Plant, theta: f64) -> Vec<f64> {
        let numerator = |s: Complex64| plant.num.iter().fold(Complex64::ZERO, |value, &c| value * s + c / plant.den[0]);
        let derivative = |i: u32| {
            let one = |(k, x): (f64, Complex64)| {
                let s = Complex64::new(0.0, k * self.omega);
                (x / numerator(s) * s.powu(i) * Complex64::cis(k * theta)).re
            };
            odd(&self.harmonics).map(one).sum()
        };
        (0..plant.order() as u32).map(derivative).collect()
    }

    fn newton(mut self, plant: &Plant, characteristic: &Characteristic, free: Free) -> Option<Self> {
        let count = self.harmonics.len();
        let mut before = f64::INFINITY;
        for _ in 0..60 {
            let (jacobian, right) = self.equations(plant, characteristic, free);
            let step = solve(jacobian, right)?;
            let size = step[0].abs() / self.omega
                + step[1..].iter().map(|one| one.abs()).sum::<f64>() / self.amplitude().abs();
            // Far from the solution the full step may leave its neighbourhood.
            let share = (0.3 / size).min(1.0);
            self.omega -= share * step[0];
            match free {
                Free::Amplitude => self.harmonics[0].re -= share * step[1],
                Free::Gain => self.inverse_gain -= share * step[1],
            }
            for k in 1..count {
                self.harmonics[k] -= share * Complex64::new(step[2 * k], step[2 * k + 1]);
            }
            if !(self.omega > 0.0 && self.amplitude() > 0.0 && size.is_finite()) {
                return None;
            }
            // Steps of rounding size grow no smaller.
            if size < 1e-15 || (size < 1e-11 && size >= 0.5 * before) {
                return Some(self);
            }
            before = size;
        }
        None
    }

    /// Jacobian and value of `mu X_k + G(jk omega) N_k`, real and imaginary part of each, mu the inverse gain.
    fn equations(&self, plant: &Plant, characteristic: &Characteristic, free: Free) -> (Vec<Vec<f64>>, Vec<f64>) {
        let count = self.harmonics.len();
        let spectrum = Spectrum::of(characteristic, &self.harmonics);
        let mut jacobian = Vec::with_capacity(2 * count);
        let mut value = Vec::with_capacity(2 * count);
        for row in 0..count {
            let k = 2 * row as isize + 1;
            let s = Complex64::new(0.0, k as f64 * self.omega);
            let (gain, slope) = response(plant, s);
            let (x, output) = (self.harmonics[row], spectrum.output[row]);
            let own = |column: usize| if row == column { self.inverse_gain } else { 0.0 };
            let of_real = |column: usize| {
                let j = 2 * column as isize + 1;
                own(column) + gain * (spectrum.slope(k - j) + spectrum.slope(k + j))
            };
            let of_imaginary = |column: usize| {
                let j = 2 * column as isize + 1;
                Complex64::i() * (own(column) + gain * (spectrum.slope(k - j) - spectrum.slope(k + j)))
            };
            let second = if free == Free::Amplitude { of_real(0) } else { x };
            let columns: Vec<Complex64> = [slope * Complex64::new(0.0, k as f64) * output, second]
                .into_iter()
                .chain((1..count).flat_map(|column| [of_real(column), of_imaginary(column)]))
                .collect();
            let residual = self.inverse_gain * x + gain * output;
            jacobian.push(columns.iter().map(|c| c.re).collect());
            jacobian.push(columns.iter().map(|c| c.im).collect());
            value.extend([residual.re, residual.im]);
        }
        (jacobian, value)
    }
}

/// Frequencies in rad/s at which `G(j omega)` is real, from 1e-2 to 1e2.
fn real_crossings(plant: &Plant) -> Vec<f64> {
    let imaginary = |omega: f64| response(plant, Complex64::new(0.0, omega)).0.im;
    let grid = |i: usize| 1e-2 * 1e4_f64.powf(i as f64 / 8000.0);
    let mut found = Vec::new();
    for i in 0..8000 {
        let (mut low, mut high) = (grid(i), grid(i + 1));
        if (imaginary(low) > 0.0) != (imaginary(high) > 0.0) {
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if (imaginary(middle) > 0.0) == (imaginary(low) > 0.0) { low = middle } else { high = middle }
            }
            found.push(0.5 * (low + high));
        }
    }
    found
}

/// All balances with [`HIGHEST`] harmonics that a scan over amplitudes finds, by growing amplitude.
///
/// For each frequency at which G is real and each amplitude the balance is solved for the loop gain, which a fold does not
/// disturb; where the gain passes that of the loop, the amplitude is solved for.
#[must_use]
pub fn balances(plant: &Plant, characteristic: &Characteristic, amplitudes: [f64; 2]) -> Vec<Balance> {
    let mut found: Vec<Balance> = Vec::new();
    for omega in real_crossings(plant) {
        let scan = scan(plant, characteristic, omega, amplitudes, AMPLITUDES);
        for pair in scan.windows(2) {
            let passes = (pair[0].inverse_gain > 1.0) != (pair[1].inverse_gain > 1.0);
            let near = (pair[0].inverse_gain - 1.0).abs().min((pair[1].inverse_gain - 1.0).abs()) < 0.01;
            if passes {
                add(&mut found, plant, characteristic, &pair[0]);
                add(&mut found, plant, characteristic, &pair[1]);
            } else if near {
                // Close to a fold two oscillations may stand between neighbouring amplitudes.
                let range = [pair[0].amplitude(), pair[1].amplitude()];
                for between in self::scan(plant, characteristic, omega, range, 12) {
                    if between.inverse_gain > 1.0 {
                        add(&mut found, plant, characteristic, &pair[0]);
                        add(&mut found, plant, characteristic, &pair[1]);
                    }
                }
            }
        }
    }
    found.sort_by(|a, b| a.amplitude().total_cmp(&b.amplitude()));
    found
}

fn scan(plant: &Plant, characteristic: &Characteristic, omega: f64, range: [f64; 2], count: usize) -> Vec<Balance> {
    let (gain, _) = response(plant, Complex64::new(0.0, omega));
    let mut found: Vec<Balance> = Vec::new();
    for index in 0..count {
        let amplitude = range[0] * (range[1] / range[0]).powf(index as f64 / (count - 1) as f64);
        let sinusoid = [Complex64::from(amplitude)];
        let inverse_gain = -(Spectrum::of(characteristic, &sinusoid).output[0] * gain).re / amplitude;
        // Weak gains are far from the loop's, and strong harmonics of theirs hold the iteration up.
        if !(0.25..=4.0).contains(&inverse_gain) {
            continue;
        }
        let mut harmonics = vec![Complex64::ZERO; SCANNED.div_ceil(2)];
        harmonics[0] = sinusoid[0];
        let first = Balance { omega, inverse_gain, harmonics };
        let solved =
            first.newton(plant, characteristic, Free::Gain).filter(|one| (one.omega / omega - 1.0).abs() < 0.5);
        // From the neighbour where the sinusoid is too far off.
        let warm = || {
            let mut near = found.last()?.clone();
            near.harmonics[0] = sinusoid[0];
            near.newton(plant, characteristic, Free::Gain)
        };
        found.extend(solved.or_else(warm));
    }
    found
}

fn add(found: &mut Vec<Balance>, plant: &Plant, characteristic: &Characteristic, near: &Balance) {
    let Some(coarse) = near.refined(plant, characteristic, SCANNED) else { return };
    let same = |other: &Balance, one: &Balance, tolerance: f64| {
        (other.amplitude() / one.amplitude() - 1.0).abs() < tolerance
            && (other.omega / one.omega - 1.0).abs() < tolerance
    };
    if (coarse.amplitude() / near.amplitude() - 1.0).abs() > 0.3 || found.iter().any(|other| same(other, &coarse, 1e-4))
    {
        return;
    }
    if let Some(fine) = coarse.refined(plant, characteristic, HIGHEST)
        && !found.iter().any(|other| same(other, &fine, 1e-9))
    {
        found.push(fine);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_response_and_its_slope() {
        let plant = Plant::new(&[2.0, 1.0], &[1.0, 3.0, 2.0, 0.0], 0.4);
        let s = Complex64::new(0.0, 1.3);
        let (gain, slope) = response(&plant, s);
        let exact = (2.0 * s + 1.0) / (s * (s + 1.0) * (s + 2.0)) * (-0.4 * s).exp();
        assert!((gain - exact).norm() < 1e-14);
        let h = Complex64::new(0.0, 1e-6);
        assert!(((response(&plant, s + h).0 - response(&plant, s - h).0) / (2.0 * h) - slope).norm() < 1e-8);
    }

    #[test]
    fn van_der_pol_with_many_harmonics() {
        // x'' - (1 - x^2) x' + x = 0: period 6.6632868593231301896996820305 (published to 28 digits).
        let plant = Plant::new(&[1.0, 0.0], &[1.0, -1.0, 1.0], 0.0);
        let cubic = Characteristic::Polynomial { coefficients: vec![0.0, 0.0, 0.0, 1.0 / 3.0] };
        let found = balances(&plant, &cubic, [0.3, 5.0]);
        assert_eq!(found.len(), 1);
        let period = std::f64::consts::TAU / found[0].omega;
        assert!((period - 6.663_286_859_323_13).abs() < 1e-13, "{period}");
    }
}
