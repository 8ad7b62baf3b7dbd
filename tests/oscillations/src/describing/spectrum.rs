//! Harmonics of a characteristic's output and slope under a half-wave symmetric input.
//!
//! Input `u = Re sum X_k e^(ik theta)` over odd k. Output harmonics `N_k = (1/pi) int n(u) e^(-ik theta)` over a turn, slope
//! harmonics `D_m = (1/2 pi) int n'(u) e^(-im theta)`, m even. `dN_k = sum D_(k-j) dX_j + D_(k+j) conj(dX_j)`.

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use super::characteristic::Characteristic;

/// Harmonics under one input.
#[derive(Clone, Debug)]
pub struct Spectrum {
    /// `N_1, N_3, ...`
    pub output: Vec<Complex64>,
    /// `D_0, D_2, ...`, to twice the highest harmonic.
    slope: Vec<Complex64>,
}

/// Samples of half a turn for each odd harmonic, between which kinks are looked for.
const SAMPLES: usize = 24;

/// Value of the input.
#[must_use]
pub fn input(harmonics: &[Complex64], theta: f64) -> f64 {
    odd(harmonics).map(|(k, x)| (x * Complex64::cis(k * theta)).re).sum()
}

/// Odd harmonics with their numbers.
pub fn odd(harmonics: &[Complex64]) -> impl DoubleEndedIterator<Item = (f64, Complex64)> + '_ {
    harmonics.iter().enumerate().map(|(index, &x)| ((2 * index + 1) as f64, x))
}

impl Spectrum {
    /// `D_m` for an even m of either sign.
    #[must_use]
    pub fn slope(&self, m: isize) -> Complex64 {
        let one = self.slope[m.unsigned_abs() / 2];
        if m < 0 { one.conj() } else { one }
    }

    /// The spectrum of an odd characteristic.
    #[must_use]
    pub fn of(characteristic: &Characteristic, harmonics: &[Complex64]) -> Self {
        if characteristic.has_kinks() {
            Self::piecewise(characteristic, harmonics)
        } else {
            Self::smooth(characteristic, harmonics)
        }
    }

    /// Trapezoid rule: its error falls exponentially for analytic functions.
    fn smooth(characteristic: &Characteristic, harmonics: &[Complex64]) -> Self {
        let count = harmonics.len();
        let samples = (8 * count).max(256);
        let turn: Vec<Complex64> = (0..samples).map(|i| Complex64::cis(TAU * i as f64 / samples as f64)).collect();
        let mut found = Self { output: vec![Complex64::ZERO; count], slope: vec![Complex64::ZERO; 2 * count] };
        for i in 0..samples {
            let u: f64 = harmonics.iter().enumerate().map(|(j, x)| (x * turn[i * (2 * j + 1) % samples]).re).sum();
            let (output, slope) = (characteristic.output(u), characteristic.slope(u));
            for (j, sum) in found.output.iter_mut().enumerate() {
                *sum += 2.0 * output / samples as f64 * turn[i * (2 * j + 1) % samples].conj();
            }
            for (j, sum) in found.slope.iter_mut().enumerate() {
                *sum += slope / samples as f64 * turn[i * 2 * j % samples].conj();
            }
        }
        found
    }

    /// Exact integrals between the angles at which the input passes a kink.
    fn piecewise(characteristic: &Characteristic, harmonics: &[Complex64]) -> Self {
        let count = harmonics.len();
        let angles = kink_angles(characteristic, harmonics);
        let mut constant = vec![Complex64::ZERO; count];
        let mut slope = vec![Complex64::ZERO; 2 * count];
        for pair in angles.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let piece = characteristic.piece(input(harmonics, 0.5 * (from + to)));
            let (s, c) = characteristic.line::<f64>(piece);
            let integral = |m: f64| {
                if m == 0.0 {
                    Complex64::from(to - from)
                } else {
                    (Complex64::cis(-m * to) - Complex64::cis(-m * from)) / Complex64::new(0.0, -m)
                }
            };
            // Half a turn counts twice.
            slope.iter_mut().enumerate().for_each(|(j, sum)| *sum += s / PI * integral((2 * j) as f64));
            constant.iter_mut().enumerate().for_each(|(j, sum)| *sum += 2.0 * c / PI * integral((2 * j + 1) as f64));
        }
        let mut found = Self { output: constant, slope };
        for k in 0..count {
            let row: Complex64 = (0..count)
                .map(|j| {
                    let (k, j) = (2 * k as isize + 1, 2 * j as isize + 1);
                    let x = harmonics[(j as usize - 1) / 2];
                    found.slope(k - j) * x + found.slope(k + j) * x.conj()
                })
                .sum();
            found.output[k] += row;
        }
        found
    }
}

/// 0, the angles of half a turn at which the input passes a kink, and pi.
fn kink_angles(characteristic: &Characteristic, harmonics: &[Complex64]) -> Vec<f64> {
    let samples = (SAMPLES * harmonics.len()).max(512);
    let theta = |i: usize| PI * i as f64 / samples as f64;
    let values: Vec<f64> = (0..=samples).map(|i| input(harmonics, theta(i))).collect();
    let mut angles = vec![0.0];
    for (i, pair) in values.windows(2).enumerate() {
        let mut within: Vec<f64> = characteristic
            .kinks()
            .iter()
            .filter(|&&kink| (pair[0] > kink) != (pair[1] > kink))
            .map(|&kink| passing(harmonics, kink, theta(i), theta(i + 1)))
            .collect();
        within.sort_by(f64::total_cmp);
        angles.extend(within);
    }
    angles.push(PI);
    angles
}

/// The angle between two at which the input passes a value: secants kept in the bracket (Illinois).
fn passing(harmonics: &[Complex64], value: f64, mut low: f64, mut high: f64) -> f64 {
    let (mut at_low, mut at_high) = (input(harmonics, low) - value, input(harmonics, high) - value);
    for _ in 0..100 {
        let middle = (low * at_high - high * at_low) / (at_high - at_low);
        if !(middle > low && middle < high) {
            break;
        }
        let at_middle = input(harmonics, middle) - value;
        if (at_middle > 0.0) == (at_high > 0.0) {
            (high, at_high) = (middle, at_middle);
            at_low *= 0.5;
        } else {
            (low, at_low) = (middle, at_middle);
            at_high *= 0.5;
        }
        if at_middle == 0.0 || high - low < 1e-16 {
            return middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn describing_functions_in_closed_form() {
        let amplitude = 2.5;
        let first = |one: &Characteristic| Spectrum::of(one, &[Complex64::from(amplitude), Complex64::ZERO]).output[0];
        let cubic = first(&Characteristic::Polynomial { coefficients: vec![0.0, -2.0, 0.0, 1.0] });
        assert!((cubic - amplitude * (0.75 * amplitude * amplitude - 2.0)).norm() < 1e-13);
        let saturation = first(&Characteristic::odd(&[1.0], &[1.0, 0.0]));
        let ratio = 1.0 / amplitude;
        let exact = 2.0 / PI * (ratio.asin() + ratio * (1.0 - ratio * ratio).sqrt());
        assert!((saturation - amplitude * exact).norm() < 1e-14);
    }

    #[test]
    fn both_ways_agree_and_slopes_are_derivatives() {
        let harmonics = [Complex64::from(1.7), Complex64::new(0.2, -0.1), Complex64::new(-0.05, 0.02)];
        let dead_zone = Characteristic::odd(&[0.4, 1.1], &[0.2, 1.0, 0.3]);
        let exact = Spectrum::of(&dead_zone, &harmonics);
        // A fine sum over midpoints instead.
        let samples = 200_000;
        for (j, found) in exact.output.iter().enumerate() {
            let k = (2 * j + 1) as f64;
            let sum: Complex64 = (0..samples)
                .map(|i| PI * (i as f64 + 0.5) / samples as f64)
                .map(|theta| dead_zone.output(input(&harmonics, theta)) * Complex64::cis(-k * theta))
                .sum();
            assert!((found - 2.0 * sum / samples as f64).norm() < 1e-9);
        }
        for one in [dead_zone, Characteristic::Tanh { gain: 1.0, scale: 2.0 }] {
            let spectrum = Spectrum::of(&one, &harmonics);
            for (j, change) in [(0, Complex64::new(1e-6, 0.0)), (1, Complex64::new(0.0, 1e-6))] {
                let (mut up, mut down) = (harmonics, harmonics);
                up[j] += change;
                down[j] -= change;
                let (up, down) = (Spectrum::of(&one, &up), Spectrum::of(&one, &down));
                for k in 0..3 {
                    let (k, j) = (2 * k as isize + 1, 2 * j as isize + 1);
                    let linear = spectrum.slope(k - j) * change + spectrum.slope(k + j) * change.conj();
                    let row = (k as usize - 1) / 2;
                    assert!(((up.output[row] - down.output[row]) / 2.0 - linear).norm() < 1e-12);
                }
            }
        }
    }
}
