//! The likelihood of a reading: Gaussian noise, interval-censored where the sensor rounds.

use core::f64::consts::{LN_2, PI, SQRT_2};

use crate::numeric::golden_section;

/// How a reading differs from the output: Gaussian noise, then perhaps rounding to whole steps.
///
/// Interval censoring: a rounded reading means that the noisy output lay within half a step of it, and nothing more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ReadingNoise {
    pub(super) std: f64,
    /// Step of the sensor; zero for none.
    pub(super) quantum: f64,
}

/// Standard deviations from which on the tail is its asymptotic series: three terms err by 15/5^6 there (Abramowitz and Stegun 26.2.12).
const FAR_OUT: f64 = 5.0;
/// The likeliest noise is found to this power of two.
const NOISE_TOLERANCE: f64 = 0.01;

/// Likelihood of a reading, about the model's output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Likelihood {
    /// Logarithm: of a density without rounding, of a probability with it.
    pub(super) log: f64,
    /// Its derivative with respect to the output.
    pub(super) score: f64,
    /// Less its second derivative: never negative.
    pub(super) information: f64,
}

impl ReadingNoise {
    /// Of a reading that is `residual` above the model's output.
    pub(super) fn likelihood(&self, residual: f64) -> Likelihood {
        let precision = 1.0 / self.std;
        if self.quantum == 0.0 {
            let scaled = residual * precision;
            let log = -0.5 * scaled * scaled - libm::log((2.0 * PI).sqrt() * self.std);
            return Likelihood { log, score: scaled * precision, information: precision * precision };
        }
        // The noise lies between these two, in standard deviations; by symmetry nearer to the lower end.
        let (distance, half) = (residual.abs() * precision, 0.5 * self.quantum * precision);
        let (low, high) = (distance - half, distance + half);
        let (log, lower, upper) = if low > FAR_OUT {
            // Far out, the nearer end decides: P = density(low)/low (1 - 1/low^2 + ...).
            let series = 1.0 - 1.0 / (low * low) + 3.0 / low.powi(4);
            let ratio = libm::exp(-0.5 * (high * high - low * low));
            let log = -0.5 * low * low + libm::log(series / ((2.0 * PI).sqrt() * low));
            (log, low / series, ratio * low / series)
        } else {
            let probability = 0.5 * (libm::erfc(low / SQRT_2) - libm::erfc(high / SQRT_2));
            let density = |z: f64| libm::exp(-0.5 * z * z) / (2.0 * PI).sqrt();
            (libm::log(probability), density(low) / probability, density(high) / probability)
        };
        let score = (lower - upper) * precision;
        let curvature = score * precision * (lower - upper) - (low * lower - high * upper) * precision * precision;
        Likelihood { log, score: score * residual.signum(), information: curvature.max(0.0) }
    }

    /// Reading less output, where the noise is `disturbed` standard deviations.
    pub(super) fn reading_error(&self, output: f64, disturbed: f64) -> f64 {
        let noisy = output + self.std * disturbed;
        if self.quantum == 0.0 { noisy - output } else { (noisy / self.quantum).round() * self.quantum - output }
    }

    /// The standard deviation, between `least` and `most`, under which the residuals are likeliest.
    pub(super) fn likeliest_std(residuals: &[f64], quantum: f64, least: f64, most: f64) -> f64 {
        let cost = |ln: f64| -> f64 {
            let noise = Self { std: libm::exp(ln), quantum };
            -residuals.iter().map(|residual| noise.likelihood(*residual).log).sum::<f64>()
        };
        let (low, high) = (libm::log(least), libm::log(most.max(2.0 * least)));
        golden_section(|ln| Some(cost(ln)), low, high, NOISE_TOLERANCE * LN_2)
            .map_or(least, |[low, high]| libm::exp(f64::midpoint(low, high)))
    }
}

/// The score as a table, where it is asked for more often than there are different answers.
pub(super) struct ScoreTable {
    noise: ReadingNoise,
    cells_per_unit: f64,
    scores: Vec<f64>,
}

impl ScoreTable {
    /// Cells in a standard deviation or a sensor's step, whichever is less: linear interpolation then errs by 1e-5 of the score.
    const CELLS: f64 = 128.0;
    /// The most cells: no noise is below a part of a step.
    const MOST_CELLS: f64 = 1e5;
    /// Reach in steps of the sensor, and in standard deviations beyond.
    const REACH: [f64; 2] = [2.0, 5.0];

    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most MOST_CELLS")]
    pub(super) fn new(noise: ReadingNoise) -> Self {
        let scale = if noise.quantum > 0.0 { noise.std.min(noise.quantum) } else { noise.std };
        let reach = Self::REACH[0] * noise.quantum + Self::REACH[1] * noise.std;
        let cells_per_unit = Self::CELLS / scale;
        let cells = (reach * cells_per_unit).min(Self::MOST_CELLS) as u32;
        let scores = (0..=cells).map(|cell| noise.likelihood(f64::from(cell) / cells_per_unit).score).collect();
        Self { noise, cells_per_unit, scores }
    }

    pub(super) fn at(&self, residual: f64) -> f64 {
        let place = residual.abs() * self.cells_per_unit;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let cell = place as u32;
        match self.scores.get(cell as usize..).unwrap_or_default() {
            [low, high, ..] => residual.signum() * (low + (place - f64::from(cell)) * (high - low)),
            _ => self.noise.likelihood(residual).score,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tail's series continues the difference of two error functions, but for the term that it leaves out.
    #[test]
    fn the_likelihood_is_continuous_where_the_tail_begins() {
        let noise = ReadingNoise { std: 0.1, quantum: 0.2 };
        let beside = |low: f64| noise.likelihood(0.1 * low + 0.1);
        let (within, beyond) = (beside(FAR_OUT - 1e-9), beside(FAR_OUT + 1e-9));
        let left_out = 15.0 / FAR_OUT.powi(6);
        assert!((within.log - beyond.log).abs() <= 1.1 * left_out, "{} {}", within.log, beyond.log);
        assert!((within.score / beyond.score - 1.0).abs() <= 1.1 * left_out, "{} {}", within.score, beyond.score);
    }
}
