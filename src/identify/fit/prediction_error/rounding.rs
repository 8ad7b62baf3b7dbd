//! Effect of rounding on the estimates: the rounding errors of a motion's readings are correlated, as the motion determines.
//!
//! Where two points of the motion differ by the part d of a step, their roundings correlate by `1 - 6 d + 6 d^2` over all places
//! of the grid, of which `cos(2 pi h d)` is the part `6 / (pi h)^2` (Bennett 1948; Sripad and Snyder 1977). Roundings of a cycle
//! that locks to the sampling add up, those of a motion that passes the steps evenly cancel.

use core::f64::consts::{PI, TAU};

use nalgebra::{DMatrix, DVector};

use super::filter::{self, Evaluation};
use super::model::{NoiseParameter, Parameter};
use super::observations::Observations;
use super::scoring::Fitted;

/// Part of the variance below which roundings that belong together do not count.
const NEGLIGIBLE: f64 = 0.1;
/// Harmonics that are summed; the rest count as white.
const HARMONICS: usize = 16;

/// By how much the deviation of each estimate differs from that of the weighted likelihood, whose errors are white. `None` where
/// readings are not rounded, a noise hides their steps, or predictions follow them.
pub(super) fn factors(fitted: &Fitted, observations: &Observations, free: &[usize]) -> Option<[f64; Parameter::COUNT]> {
    let step = observations.step?;
    let model = &fitted.model;
    let variance = model.size(NoiseParameter::White) / (step * step);
    let noise = noise_beside(variance, observations.count());
    // A noise hides the steps.
    if observations.count() * strength(1.0, noise) < NEGLIGIBLE * variance {
        return None;
    }
    let pass = filter::run(observations, model, Evaluation::Slopes).filter(|pass| !pass.stochastic)?;
    let mut sums = Sums::new(free.len());
    let mut slopes = vec![0.0; free.len()];
    let samples = observations.output.iter().zip(&observations.weight).skip(observations.first);
    for (((output, weight), innovation), by) in samples.zip(&pass.innovations).zip(&pass.slopes) {
        if *weight > 0.0 {
            slopes.iter_mut().zip(free).for_each(|(slope, index)| *slope = by[*index]);
            sums.add((output - innovation.error) / step, *weight, &slopes);
        }
    }
    let covariance = sums.covariance(variance, noise)?;
    let [white, independent] = sums.under_white()?.map(|covariance| covariance * variance);
    let mut factors = [1.0; Parameter::COUNT];
    for (place, index) in free.iter().enumerate() {
        // Roundings that cancel count as independent ones: a structure that hardly shows does not cancel with them.
        let counted = covariance[(place, place)].max(independent[(place, place)]);
        factors[*index] = (counted / white[(place, place)]).sqrt();
    }
    Some(factors)
}

/// Variance of a rounding, in squares of its step.
const ROUNDING: f64 = 1.0 / 12.0;
/// Variance of its square over the square of its variance.
const SPREAD: f64 = 0.8;

/// Variance of a noise before the rounding, in squares of the step: as little as so many readings of this variance allow.
fn noise_beside(variance: f64, count: f64) -> f64 {
    (variance / (1.0 + 2.0 * (SPREAD / count).sqrt()) - ROUNDING).max(0.0)
}

/// Variance of a harmonic of roundings, in squares of the step, under a noise before them.
fn strength(harmonic: f64, noise: f64) -> f64 {
    let turn = PI * harmonic;
    libm::exp(-4.0 * turn * turn * noise) / (2.0 * turn * turn)
}

/// Sums over the readings of a least-squares estimate: matrices below their diagonals, row by row.
struct Sums {
    parameters: usize,
    information: Vec<f64>,
    unweighted: Vec<f64>,
    of_squares: Vec<f64>,
    /// Slopes against cosine and sine of every harmonic.
    waves: Vec<f64>,
}

impl Sums {
    fn new(parameters: usize) -> Self {
        let matrix = vec![0.0; parameters * (parameters + 1) / 2];
        Self {
            parameters,
            information: matrix.clone(),
            of_squares: matrix.clone(),
            unweighted: matrix,
            waves: vec![0.0; 2 * HARMONICS * parameters],
        }
    }

    /// A reading of a motion that is here, in steps, and what it changes by with each parameter.
    fn add(&mut self, steps: f64, weight: f64, slopes: &[f64]) {
        let mut place = 0;
        for (row, slope) in slopes.iter().enumerate() {
            for other in &slopes[..=row] {
                let product = slope * other;
                self.unweighted[place] += product;
                self.information[place] += weight * product;
                self.of_squares[place] += weight * weight * product;
                place += 1;
            }
        }
        let (sin, cos) = libm::sincos(TAU * steps);
        let (mut real, mut imaginary) = (weight, 0.0);
        for waves in self.waves.chunks_exact_mut(2 * self.parameters) {
            (real, imaginary) = (real * cos - imaginary * sin, real * sin + imaginary * cos);
            let (by_cosine, by_sine) = waves.split_at_mut(self.parameters);
            for ((by_cosine, by_sine), slope) in by_cosine.iter_mut().zip(by_sine).zip(slopes) {
                *by_cosine += real * slope;
                *by_sine += imaginary * slope;
            }
        }
    }

    fn matrix(&self, of: &[f64]) -> DMatrix<f64> {
        let at = |row: usize, column: usize| of[row * (row + 1) / 2 + column];
        DMatrix::from_fn(self.parameters, self.parameters, |i, j| at(i.max(j), i.min(j)))
    }

    /// Covariance of the estimate under white errors of variance one, by the weights and with each reading counted once.
    fn under_white(&self) -> Option<[DMatrix<f64>; 2]> {
        let inverse = |of: &[f64]| Some(self.matrix(of).cholesky()?.inverse());
        Some([inverse(&self.information)?, inverse(&self.unweighted)?])
    }

    /// Covariance of the estimate under errors of this variance, a noise before the rounding among them.
    fn covariance(&self, variance: f64, noise: f64) -> Option<DMatrix<f64>> {
        let mut rest = variance.max(ROUNDING);
        let mut errors = DMatrix::zeros(self.parameters, self.parameters);
        for (h, waves) in self.waves.chunks_exact(2 * self.parameters).enumerate() {
            let strength = strength((h + 1) as f64, noise);
            rest -= strength;
            for wave in waves.chunks_exact(self.parameters) {
                let wave = DVector::from_column_slice(wave);
                errors.ger(strength, &wave, &wave, 1.0);
            }
        }
        errors += rest * self.matrix(&self.of_squares);
        let inverse = self.matrix(&self.information).cholesky()?.inverse();
        Some(&inverse * errors * &inverse)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::{ROUNDING, Sums, noise_beside};

    /// Variance of the estimates of level and slope of a line beneath a known motion, by rounding it on a grid at every place.
    fn by_rounding(motion: &[f64], weights: &[f64]) -> [f64; 2] {
        const PLACES: usize = 2000;
        let (mut s0, mut s1, mut s2) = (0.0, 0.0, 0.0);
        for (k, w) in weights.iter().enumerate() {
            let t = k as f64;
            (s0, s1, s2) = (s0 + w, s1 + w * t, s2 + w * t * t);
        }
        let determinant = s0 * s2 - s1 * s1;
        let mut variance = [0.0; 2];
        for place in 0..PLACES {
            let shift = place as f64 / PLACES as f64;
            let (mut r0, mut r1) = (0.0, 0.0);
            for (k, (y, w)) in motion.iter().zip(weights).enumerate() {
                let error = (y + shift).round() - (y + shift);
                (r0, r1) = (r0 + w * error, r1 + w * error * k as f64);
            }
            let estimate = [(s2 * r0 - s1 * r1) / determinant, (s0 * r1 - s1 * r0) / determinant];
            (0..2).for_each(|i| variance[i] += estimate[i] * estimate[i] / PLACES as f64);
        }
        variance
    }

    fn computed(motion: &[f64], weights: &[f64], noise: f64) -> DMatrix<f64> {
        let mut sums = Sums::new(2);
        for (k, (y, w)) in motion.iter().zip(weights).enumerate() {
            sums.add(*y, *w, &[1.0, k as f64]);
        }
        sums.covariance(ROUNDING + noise, noise).expect("two parameters")
    }

    /// Variance of a level under white errors.
    fn white(count: usize) -> f64 {
        ROUNDING / count as f64
    }

    #[test]
    fn variance_is_that_of_rounding_at_every_place_of_the_grid() {
        let motions: [fn(f64) -> f64; 3] =
            [|t| 9.3 * (0.15 * t).sin() + 0.02 * t, |t| 3.0 * (0.4 * t).sin(), |t| 0.013 * t * t];
        for (index, motion) in motions.into_iter().enumerate() {
            let motion: Vec<f64> = (0..90).map(|k| motion(f64::from(k))).collect();
            let weights: Vec<f64> = (0..90).map(|k| if k % 30 < 15 { 1.0 } else { 0.4 }).collect();
            let (expected, found) = (by_rounding(&motion, &weights), computed(&motion, &weights, 0.0));
            for i in 0..2 {
                let ratio = found[(i, i)] / expected[i];
                assert!((ratio - 1.0).abs() < 0.05, "motion {index}, parameter {i}: {ratio}");
            }
        }
    }

    #[test]
    fn repeated_roundings_add_up_and_evenly_passed_steps_cancel() {
        let weights = [1.0; 120];
        let locked: Vec<f64> =
            (0..120).map(|k| 7.3 * (core::f64::consts::TAU * f64::from(k % 4) / 4.0).cos()).collect();
        assert!(computed(&locked, &weights, 0.0)[(0, 0)] > 10.0 * white(120));
        // The golden section: as far from every cycle as can be.
        let even: Vec<f64> = (0..120).map(|k| 0.618_033_988_749_894_9 * f64::from(k)).collect();
        // At the end of a line of unknown slope white errors leave four times the variance of a level.
        assert!(computed(&even, &weights, 0.0)[(0, 0)] < 0.1 * 4.0 * white(120));
    }

    #[test]
    fn a_noise_of_half_a_step_makes_roundings_white() {
        let still = [0.2; 100];
        let weights = [1.0; 100];
        let alone = computed(&still, &weights, 0.0);
        let dithered = computed(&still, &weights, 0.25);
        let both = white(100) + 0.25 / 100.0;
        // Level at the middle of the record, where level and slope are independent.
        let at_middle = |c: &DMatrix<f64>| c[(0, 0)] + 99.0 * c[(0, 1)] + 49.5 * 49.5 * c[(1, 1)];
        assert!(at_middle(&alone) > 0.9 * ROUNDING);
        assert!((at_middle(&dithered) / both - 1.0).abs() < 0.02);
    }

    #[test]
    fn no_more_noise_is_seen_than_the_readings_allow() {
        assert_eq!(noise_beside(ROUNDING, 600.0), 0.0);
        assert_eq!(noise_beside(1.06 * ROUNDING, 600.0), 0.0);
        let seen = noise_beside(ROUNDING + 1.0, 600.0);
        assert!(seen < 1.0 && seen > 0.9);
        assert!(noise_beside(ROUNDING + 1.0, 10.0) < seen);
    }
}
