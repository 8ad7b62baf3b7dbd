//! The record of an experiment.

use super::{ExperimentError, Place};

/// Fewer gaps are not bursts. Bursts are where gaps take half of the time.
const FEWEST_BURSTS: usize = 4;

/// Time, output and input of one experiment, simulated or logged.
///
/// Every value is finite and at most [`LARGEST`](Self::LARGEST) in magnitude, time increases strictly, and no interval is longer than [`LONGEST_GAP`](Self::LONGEST_GAP)
/// times the middle one. The input of a sample is the command that the logger saw with it.
///
/// ```
/// use selfosc::experiment::Record;
/// let time: Vec<f64> = (0..20).map(|i| 0.1 * f64::from(i)).collect();
/// assert!(Record::new(time.clone(), vec![0.0; 20], vec![1.0; 20]).is_ok());
/// assert!(Record::new(time.into_iter().rev().collect(), vec![0.0; 20], vec![1.0; 20]).is_err());
/// ```
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(try_from = "Samples")]
pub struct Record {
    time_s: Vec<f64>,
    output: Vec<f64>,
    input: Vec<f64>,
    #[serde(skip_serializing)]
    interval_s: f64,
}

/// A record as it is written, not yet checked.
#[derive(serde::Deserialize)]
struct Samples {
    time_s: Vec<f64>,
    output: Vec<f64>,
    input: Vec<f64>,
}

impl TryFrom<Samples> for Record {
    type Error = ExperimentError;

    fn try_from(samples: Samples) -> Result<Self, ExperimentError> {
        Self::new(samples.time_s, samples.output, samples.input)
    }
}

/// The value in the middle of all; of two the larger.
pub(super) fn middle(mut values: Vec<f64>) -> Option<f64> {
    let half = values.len() / 2;
    (half < values.len()).then(|| *values.select_nth_unstable_by(half, f64::total_cmp).1)
}

impl Record {
    /// The fewest samples that make a record.
    pub const FEWEST_SAMPLES: usize = 16;
    /// The largest magnitude of any number: sums of squares of larger ones leave the arithmetic.
    pub const LARGEST: f64 = 1e50;
    /// The longest interval allowed, in middle intervals: longer, and the input in between is anyone's guess.
    pub const LONGEST_GAP: f64 = 10.0;

    /// # Errors
    /// [`ExperimentError`] that names the sample and what is wrong with it.
    pub fn new(time_s: Vec<f64>, output: Vec<f64>, input: Vec<f64>) -> Result<Self, ExperimentError> {
        Self::placed(time_s, output, input, Place::Sample)
    }

    /// As [`new`](Self::new), with places in the file rather than in the record.
    pub(super) fn placed(
        time_s: Vec<f64>,
        output: Vec<f64>,
        input: Vec<f64>,
        place: impl Fn(usize) -> Place,
    ) -> Result<Self, ExperimentError> {
        let samples = time_s.len();
        if output.len() != samples || input.len() != samples {
            return Err(ExperimentError::Lengths { time: samples, output: output.len(), input: input.len() });
        }
        let columns = [&time_s, &output, &input];
        let unusable = |sample: &usize| columns.iter().any(|values| !(values[*sample].abs() <= Self::LARGEST));
        if let Some(sample) = (0..samples).find(unusable) {
            return Err(Self::unusable(place(sample), columns, sample));
        }
        if samples < Self::FEWEST_SAMPLES {
            return Err(ExperimentError::TooShort { samples });
        }
        let intervals: Vec<f64> = time_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
        if let Some(sample) = intervals.iter().position(|interval| *interval <= 0.0) {
            let (previous_s, time_s) = (time_s[sample], time_s[sample + 1]);
            return Err(ExperimentError::TimeOrder { place: place(sample + 1), time_s, previous_s });
        }
        let interval_s = middle(intervals.clone()).unwrap_or(f64::NAN);
        let limit_s = Self::LONGEST_GAP * interval_s;
        if let Some(sample) = intervals.iter().position(|interval| *interval > limit_s) {
            let gaps = || intervals.iter().filter(|interval| **interval > limit_s);
            let (count, all_s) = (gaps().count(), gaps().sum::<f64>());
            if count >= FEWEST_BURSTS && all_s > 0.5 * (time_s[samples - 1] - time_s[0]) {
                #[allow(clippy::cast_precision_loss, reason = "fewer samples than 2^53")]
                return Err(ExperimentError::Bursts { count, gap_s: all_s / count as f64, interval_s });
            }
            return Err(ExperimentError::Gap { place: place(sample + 1), gap_s: intervals[sample], limit_s });
        }
        Ok(Self { time_s, output, input, interval_s })
    }

    /// What is wrong with a sample that has a number that is none, or too large.
    pub(super) fn unusable(place: Place, columns: [&Vec<f64>; 3], sample: usize) -> ExperimentError {
        let named = ["time", "output", "input"].into_iter().zip(columns.map(|column| column[sample]));
        // NaN is larger than all.
        let worst = named.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let (column, value) = worst.unwrap_or(("time", f64::NAN));
        if value.is_finite() {
            return ExperimentError::TooLarge { place, column, value };
        }
        ExperimentError::NotFinite { place, column, value }
    }

    /// Times of the samples in s.
    #[must_use]
    pub fn time_s(&self) -> &[f64] {
        &self.time_s
    }
    /// Outputs: heading, depth, integrated speed.
    #[must_use]
    pub fn output(&self) -> &[f64] {
        &self.output
    }
    /// Inputs: commands.
    #[must_use]
    pub fn input(&self) -> &[f64] {
        &self.input
    }
    /// Number of samples.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.time_s.len()
    }
    /// Its first samples; `None` where it has no more than these.
    pub(crate) fn beginning(&self, samples: usize) -> Option<Self> {
        let part = |values: &[f64]| values[..samples].to_vec();
        let longer = self.samples() > samples;
        longer.then(|| Self::new(part(&self.time_s), part(&self.output), part(&self.input)).ok()).flatten()
    }
    /// Time from the first sample to the last, in s.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.time_s[self.samples() - 1] - self.time_s[0]
    }
    /// The middle sampling interval, in s.
    #[must_use]
    pub fn interval_s(&self) -> f64 {
        self.interval_s
    }

    /// Step of the sensor: the spacing that every output is a whole number of steps away from; `None` for a sensor
    /// without one, as far as this record tells.
    ///
    /// A record printed with few digits has the step of its last digit. Values within a thousandth of a step count as on it.
    #[must_use]
    pub fn quantum(&self) -> Option<f64> {
        let mut sorted = self.output.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let range = sorted[sorted.len() - 1] - sorted[0];
        // Equal readings differ by at most this through rounding.
        let same = 1e-9 * range.max(sorted[0].abs()).max(sorted[sorted.len() - 1].abs());
        sorted.dedup_by(|next, kept| *next - *kept <= same);
        let steps: Vec<f64> = sorted.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let least = steps.iter().copied().fold(f64::INFINITY, f64::min);
        // A record with hardly a value twice has not been rounded, or its step does not matter.
        let rounded = steps.len() > 1 && 2 * sorted.len() < self.output.len();
        let whole = |step: &f64| (step / least - (step / least).round()).abs() * least <= 1e-3 * least + same;
        (rounded && steps.iter().all(whole)).then_some(least)
    }
}
