//! What a fit found.

use super::covariance::Covariance;
use super::gauss_newton::{GaussNewton, LinearisedTrajectory, StartingPoint};
use super::input::Between;
use super::sensitivity::SHARED;
use crate::identify::answer::{AxisParameter, ConfidenceInterval, DragLaw, Estimate, IdentifyError};
use crate::plant::{DragAxis, State};

/// A model fitted to whole records.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct RecordFit {
    law: DragLaw,
    between: Between,
    axis: DragAxis<f64>,
    estimates: [Estimate; SHARED],
    covariance: [[f64; SHARED]; SHARED],
    records: Vec<FittedRecord>,
    #[serde(with = "crate::identify::answer::any_float")]
    evidence: f64,
    parameters: usize,
}

/// The model along a record.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct FittedRecord {
    /// The constant force during this record.
    pub disturbance: Estimate,
    /// When the model begins: once every acting command is in the log.
    pub begin_s: f64,
    /// State then.
    pub start: State<f64>,
    /// Index of the first sample that the model covers; outputs begin there.
    pub first_sample: usize,
    /// Outputs of the model.
    pub output: Vec<f64>,
    /// Readings less outputs.
    pub residuals: Vec<f64>,
    /// Standard deviation of the noise, before rounding.
    pub noise: f64,
    /// Step of the sensor, zero for none.
    pub quantum: f64,
    /// Root mean square of the residuals.
    pub residual_rms: f64,
    /// Share of the output's variation about its mean that the model explains: `100 (1 - rms/std)`.
    pub fit_percent: f64,
    /// Correlation of successive residuals: near zero if white. Rounding alone makes it positive on slow motions.
    pub autocorrelation: f64,
    /// The strongest correlation of residuals up to [`LAGS`](Self::LAGS) samples apart, with its sign.
    pub strongest_correlation: f64,
    /// Ljung and Box's statistic over those lags as a standard normal deviate (Wilson and Hilferty's cube root): above 3, the
    /// residuals are hardly white.
    pub ljung_box_deviate: f64,
}

impl FittedRecord {
    /// Lags over which the residuals' whiteness is judged.
    pub const LAGS: usize = 20;
}

/// Correlations of values with those 1, 2, ... places later.
fn correlations(values: &[f64]) -> Vec<f64> {
    let power = values.iter().map(|value| value * value).sum::<f64>().max(f64::MIN_POSITIVE);
    let lags = 1..=FittedRecord::LAGS.min(values.len().saturating_sub(1));
    lags.map(|lag| values.iter().zip(&values[lag..]).map(|(a, b)| a * b).sum::<f64>() / power).collect()
}

/// Ljung and Box's statistic as a normal deviate.
#[allow(clippy::cast_precision_loss, reason = "counts of samples")]
fn ljung_box_deviate(correlations: &[f64], samples: usize) -> f64 {
    let (n, lags) = (samples as f64, correlations.len().max(1) as f64);
    let terms =
        correlations.iter().enumerate().map(|(k, correlation)| correlation * correlation / (n - 1.0 - k as f64));
    let statistic = n * (n + 2.0) * terms.sum::<f64>();
    let unit = 2.0 / (9.0 * lags);
    (libm::cbrt(statistic / lags) - (1.0 - unit)) / unit.sqrt()
}

impl GaussNewton<'_> {
    /// The result, with errors.
    pub(super) fn finish(self) -> Result<RecordFit, IdentifyError> {
        let linearised = self
            .motions
            .iter()
            .map(|motion| motion.linearise(&self.shared, 1))
            .collect::<Result<Vec<LinearisedTrajectory>, _>>()?;
        let covariance = Covariance::of(&self, &linearised)?;
        let fixed = self.fixed();
        let [alpha, linear, quadratic, delay_s] = self.shared;
        let estimate = |k: usize| {
            let spread = (fixed[k].is_none() && self.shared[k] > 0.0)
                .then(|| ConfidenceInterval::normal(self.shared[k], covariance.shared[k][k].sqrt()))
                .map(|spread| ConfidenceInterval { low: spread.low.max(0.0), ..spread });
            Estimate::new(self.shared[k], spread)
        };
        let estimates = [estimate(0), estimate(1), estimate(2), estimate(3)];
        let records =
            self.motions.iter().zip(&linearised).zip(&covariance.disturbance).map(|((motion, rows), variance)| {
                let residuals = motion.residuals(rows);
                let output: Vec<f64> = rows.rows.iter().flatten().map(|(_, model)| model.value).collect();
                let start =
                    motion.intervals.first().map_or(State { position: 0.0, velocity: 0.0 }, |first| first.start);
                let first_sample = rows.rows.iter().flatten().next().map_or(0, |(sample, _)| *sample);
                let readings = &motion.record.output()[first_sample..];
                let (rms, std) = (mean_square(&residuals, 0.0).sqrt(), mean_square(readings, mean(readings)).sqrt());
                let correlations = correlations(&residuals);
                let strongest = correlations.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()));
                FittedRecord {
                    disturbance: Estimate::new(
                        motion.disturbance,
                        Some(ConfidenceInterval::normal(motion.disturbance, variance.sqrt())),
                    ),
                    begin_s: motion.intervals.first().map_or(0.0, |first| first.begin_s),
                    start,
                    first_sample,
                    noise: if motion.noise.quantum > 0.0 { motion.real_noise(rows) } else { motion.noise.std },
                    quantum: motion.noise.quantum,
                    residual_rms: rms,
                    fit_percent: 100.0 * (1.0 - rms / std.max(f64::MIN_POSITIVE)),
                    autocorrelation: correlations.first().copied().unwrap_or(0.0),
                    strongest_correlation: strongest.unwrap_or(0.0),
                    ljung_box_deviate: ljung_box_deviate(&correlations, residuals.len()),
                    output,
                    residuals,
                }
            });
        Ok(RecordFit {
            law: self.law,
            between: self.between,
            axis: DragAxis::mixed(alpha, linear, quadratic)?.with_delay_s(delay_s)?,
            estimates,
            covariance: covariance.shared,
            records: records.collect(),
            evidence: self.evidence(),
            parameters: self.parameters(),
        })
    }
}

/// Adds `variance`; the interval's lower end is at least `least`.
fn wider(estimate: Estimate, variance: f64, least: f64) -> Estimate {
    let wider = |before: ConfidenceInterval| {
        let after = ConfidenceInterval::normal(estimate.value, (before.std * before.std + variance).sqrt());
        ConfidenceInterval { low: after.low.max(least), ..after }
    };
    Estimate { spread: estimate.spread.map(wider), ..estimate }
}

#[allow(clippy::cast_precision_loss, reason = "a count of samples")]
fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

#[allow(clippy::cast_precision_loss, reason = "a count of samples")]
fn mean_square(values: &[f64], about: f64) -> f64 {
    values.iter().map(|value| (value - about).powi(2)).sum::<f64>() / values.len().max(1) as f64
}

impl RecordFit {
    /// The same model with the input's uncertainty between samples added to its errors: `other` is the fit under the second of two
    /// treatments of the input between which there is a continuum. The likelihood of an intermediate treatment is the parabola through both likelihoods, and the
    /// estimate moves along with it.
    pub(super) fn widened(mut self, other: &Self) -> Self {
        let lost = (self.evidence - other.evidence).max(0.5);
        let share = 0.5 / lost;
        let apart: [f64; SHARED] = core::array::from_fn(|k| self.estimates[k].value - other.estimates[k].value);
        for (i, row) in self.covariance.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value += share * apart[i] * apart[j];
            }
            self.estimates[i] = wider(self.estimates[i], share * apart[i] * apart[i], 0.0);
        }
        for (record, other) in self.records.iter_mut().zip(&other.records) {
            let apart = record.disturbance.value - other.disturbance.value;
            record.disturbance = wider(record.disturbance, share * apart * apart, f64::NEG_INFINITY);
        }
        self
    }

    /// As the start of another search.
    pub(super) fn place(&self) -> StartingPoint {
        let disturbances = self.records.iter().map(|record| record.disturbance.value).collect();
        StartingPoint { between: self.between, shared: self.estimates.map(|estimate| estimate.value), disturbances }
    }
    /// The drag law fitted.
    #[must_use]
    pub fn law(&self) -> DragLaw {
        self.law
    }
    /// Treatment of the command between samples.
    #[must_use]
    pub fn between(&self) -> Between {
        self.between
    }
    /// The model, without a disturbance: that belongs to a record.
    #[must_use]
    pub fn axis(&self) -> &DragAxis<f64> {
        &self.axis
    }
    /// A parameter with its error; without an error where the law lacks this drag, where it was given, or where it ended on zero.
    #[must_use]
    pub fn estimate(&self, parameter: AxisParameter) -> Estimate {
        self.estimates[parameter as usize]
    }
    /// The records, in the order given.
    #[must_use]
    pub fn records(&self) -> &[FittedRecord] {
        &self.records
    }
    /// Logarithm of the likelihood at the estimate, uncertain instants integrated out: for comparison of drag laws on the same
    /// records.
    #[must_use]
    pub fn log_likelihood(&self) -> f64 {
        self.evidence
    }
    /// Parameters estimated, each record's own included.
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.parameters
    }
}
