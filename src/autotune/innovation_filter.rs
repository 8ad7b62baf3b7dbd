//! Innovations of readings by a Kalman filter, under a load that wanders or for errors in an autoregression. Initial states are coefficients
//! of the regression: the filter begins without their variance (de Jong, *Annals of Statistics* 19, 1991).

use nalgebra::{DVector, Matrix3, Vector3};

use super::response::StateSpace;

/// The filter of readings whose white errors have a variance of one.
pub(super) struct InnovationFilter {
    output: Vector3<f64>,
    steps: Vec<FilterStep>,
    /// Mean logarithm of the innovations' variances.
    pub(super) log_variance: f64,
}

/// A gain that changes by less, relative, from reading to reading is that of all that follow at the same interval.
const STEADY: f64 = 1e-12;

/// Of one reading: standard deviation of its innovation, gain, and transition to the next reading.
#[derive(Clone, Copy)]
struct FilterStep {
    std: f64,
    gain: Vector3<f64>,
    transition: Matrix3<f64>,
}

impl InnovationFilter {
    /// Of a process whose load takes a normal step at each of these times; `walk` is the variance that the load gains in a second over the
    /// variance of a reading's white error.
    pub(super) fn of_load(space: &StateSpace, time_s: &[f64], walk: f64) -> Self {
        let (output, mut transitions) = (space.output(), space.transitions());
        let mut covariance = Matrix3::zeros();
        let mut steps: Vec<FilterStep> = Vec::with_capacity(time_s.len());
        let mut steady = false;
        for k in 0..time_s.len() {
            let after_s = time_s.get(k + 1).map_or(0.0, |next| next - time_s[k]);
            let transition = transitions(after_s);
            let step = match steps.last() {
                Some(last) if steady && last.transition == transition => *last,
                last => {
                    let spread = covariance * output;
                    let variance = 1.0 + output.dot(&spread);
                    let gain = spread / variance;
                    covariance -= gain * spread.transpose();
                    covariance = transition * covariance * transition.transpose();
                    covariance[(2, 2)] += walk * after_s;
                    steady = last.is_some_and(|last| {
                        last.transition == transition && (last.gain - gain).amax() < STEADY * gain.amax()
                    });
                    FilterStep { std: variance.sqrt(), gain, transition }
                }
            };
            steps.push(step);
        }
        let log_variance = 2.0 * steps.iter().map(|step| libm::log(step.std)).sum::<f64>() / time_s.len() as f64;
        Self { output, steps, log_variance }
    }

    /// Of errors `e_k = a_1 e_(k-1) + a_2 e_(k-2) + noise` for so many readings: the states are the two errors before.
    pub(super) fn of_autoregression(coefficients: &[f64], readings: usize) -> Self {
        let output = Vector3::from_fn(|k, _| coefficients.get(k).copied().unwrap_or(0.0));
        // The next error is its prediction and the innovation, which is the third state.
        let transition = Matrix3::new(output[0], output[1], 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        let step = FilterStep { std: 1.0, gain: Vector3::z(), transition };
        Self { output, steps: vec![step; readings], log_variance: 0.0 }
    }

    /// Innovations of a series: values less their prediction from the values before, with the load as it shows in these.
    pub(super) fn innovations(&self, series: &[f64]) -> impl Iterator<Item = f64> {
        let mut state = Vector3::zeros();
        self.steps.iter().zip(series).map(move |(step, value)| {
            let innovation = value - self.output.dot(&state);
            state = step.transition * (state + step.gain * innovation);
            innovation
        })
    }

    /// The same of several series, over their standard deviations.
    pub(super) fn whitened(&self, series: &[&[f64]]) -> Vec<DVector<f64>> {
        let mut states = vec![Vector3::zeros(); series.len()];
        let mut whitened = vec![DVector::zeros(self.steps.len()); series.len()];
        for (k, step) in self.steps.iter().enumerate() {
            let by_std = step.std.recip();
            for ((one, state), whitened) in series.iter().zip(&mut states).zip(&mut whitened) {
                let innovation = one[k] - self.output.dot(state);
                *state = step.transition * (*state + step.gain * innovation);
                whitened[k] = innovation * by_std;
            }
        }
        whitened
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::InnovationFilter;
    use crate::autotune::Family;
    use crate::autotune::response::StateSpace;

    /// Output after a unit step of the load, in closed form.
    fn step_response(family: Family, [slow, fast]: [f64; 2], t: f64) -> f64 {
        let lag = |lag_s: f64| 1.0 - (-t / lag_s).exp();
        match family {
            Family::FirstOrder => lag(slow),
            Family::SecondOrder | Family::SecondOrderZero => (slow * lag(slow) - fast * lag(fast)) / (slow - fast),
            Family::EqualLags => lag(slow) - t / slow * (-t / slow).exp(),
            Family::Integrator => t,
            Family::IntegratorLag => t - slow * lag(slow),
        }
    }

    /// Readings as one normal vector: their covariance sums the answers to all steps of the load. A load that starts a reading late has
    /// another likelihood.
    #[test]
    fn innovations_have_the_likelihood_of_the_dense_normal_vector() {
        // After steady intervals three that differ.
        let time_s: Vec<f64> =
            (0..64).map(|k: i32| 0.3 * f64::from(k) + 0.1 * f64::from((k - 58).clamp(0, 3))).collect();
        let readings: Vec<f64> = (0..64).map(|k| (0.7 * f64::from(k)).sin() + 0.2 * f64::from(k % 5)).collect();
        let (lags_s, walk) = ([2.0, 0.6], 1.7);
        for family in Family::ALL {
            let dense = |late: usize| {
                let covariance = DMatrix::from_fn(64, 64, |i, j| {
                    let steps = 1..=i.min(j).saturating_sub(late);
                    let answer = |k: usize, step: usize| step_response(family, lags_s, time_s[k] - time_s[step + late]);
                    let product = |m: usize| walk * (time_s[m] - time_s[m - 1]) * answer(i, m) * answer(j, m);
                    steps.map(product).sum::<f64>() + f64::from(u8::from(i == j))
                });
                let factor = covariance.cholesky().unwrap();
                let output = DVector::from(readings.clone());
                [output.dot(&factor.solve(&output)), 2.0 * factor.l().diagonal().map(f64::ln).sum() / 64.0]
            };
            let filter = InnovationFilter::of_load(&StateSpace::new(family, &lags_s), &time_s, walk);
            let square = filter.whitened(&[&readings])[0].norm_squared();
            let off = |[expected, log_variance]: [f64; 2]| {
                (square / expected - 1.0).abs() + (filter.log_variance - log_variance).abs()
            };
            assert!(off(dense(0)) < 1e-9, "{family:?}: {square} {} for {:?}", filter.log_variance, dense(0));
            assert!(off(dense(1)) > 1e-3, "{family:?}");
        }
    }

    /// Innovations of an autoregression are differences from its prediction; with the coefficients exchanged they are others.
    #[test]
    fn innovations_of_an_autoregression_are_its_noise() {
        let noise: Vec<f64> = (0..40).map(|k| (1.3 * f64::from(k * k)).sin()).collect();
        let mut errors = vec![0.0; 40];
        for k in 0..40 {
            let before = |back: usize| if k >= back { errors[k - back] } else { 0.0 };
            errors[k] = 1.1 * before(1) - 0.4 * before(2) + noise[k];
        }
        let off = |coefficients: [f64; 2]| {
            let whitened = InnovationFilter::of_autoregression(&coefficients, 40).whitened(&[&errors]);
            whitened[0].iter().zip(&noise).map(|(found, noise)| (found - noise).abs()).fold(0.0, f64::max)
        };
        assert!(off([1.1, -0.4]) < 1e-12 && off([-0.4, 1.1]) > 0.1);
    }
}
