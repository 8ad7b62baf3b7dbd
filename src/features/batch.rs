//! Features of a whole record.

use super::{Cycle, Cycles, FeatureError, Features, Summary};
use crate::experiment::Record;

/// The two levels of a relay's command, as a record shows them.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct RelayLevels {
    /// Half the distance of the two levels, C.
    pub level: f64,
    /// Middle of the two levels.
    pub offset: f64,
}

/// Features of a record, with what only the whole record tells.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct RecordFeatures {
    /// Means and spreads.
    pub features: Features<f64>,
    /// The relay's two levels.
    pub relay: RelayLevels,
    /// Every cycle found, start-up included.
    pub cycles: Vec<Cycle<f64>>,
}

/// Share of samples that must lie at the two extremes of the input.
const AT_LEVEL: f64 = 0.95;
/// How near to an extreme counts as there, against the range.
const NEAR_LEVEL: f64 = 0.02;
/// Half periods without a change of the command that count as lost.
const LOST: f64 = 4.0;

impl RelayLevels {
    /// The levels of a two-valued input.
    ///
    /// # Errors
    /// [`FeatureError::ConstantInput`], [`FeatureError::NotARelay`].
    pub fn of(record: &Record) -> Result<Self, FeatureError> {
        let input = record.input();
        let low = input.iter().copied().fold(f64::INFINITY, f64::min);
        let high = input.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if low >= high {
            return Err(FeatureError::ConstantInput { value: low });
        }
        let near = NEAR_LEVEL * (high - low);
        let at = input.iter().filter(|value| **value <= low + near || **value >= high - near).count();
        #[allow(clippy::cast_precision_loss, reason = "a count of samples")]
        let share = at as f64 / input.len() as f64;
        if share < AT_LEVEL {
            return Err(FeatureError::NotARelay { percent: 100.0 * share, required: 100.0 * AT_LEVEL });
        }
        Ok(Self { level: (high - low) / 2.0, offset: f64::midpoint(low, high) })
    }
}

impl RecordFeatures {
    /// Features of a relay experiment: the stream's, fed with the record.
    ///
    /// # Errors
    /// [`FeatureError`] that names why the record is not usable.
    ///
    /// ```
    /// use selfosc::experiment::SimulatedExperiment;
    /// use selfosc::features::RecordFeatures;
    /// use selfosc::{nonlinearity::RelayHysteresis, orbit::limit_cycle, plant::DragAxis};
    /// let (axis, relay) = (DragAxis::quadratic(1.0, 0.5)?, RelayHysteresis::new(1.0, 0.3, 0.0)?);
    /// let found = RecordFeatures::of(&SimulatedExperiment::new(axis, relay, 100.0)?.run(60.0)?)?;
    /// let exact = limit_cycle(&axis, &relay)?;
    /// assert!((found.features.amplitude.mean - exact.amplitude).abs() < 1e-3 * exact.amplitude);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn of(record: &Record) -> Result<Self, FeatureError> {
        let relay = RelayLevels::of(record)?;
        let mut finder = Cycles::new(relay.offset);
        let mut summary = Summary::new();
        let mut cycles = Vec::new();
        for ((time, output), input) in record.time_s().iter().zip(record.output()).zip(record.input()) {
            if let Some(cycle) = finder.step(*time, *output, *input) {
                summary.push(cycle);
                cycles.push(cycle);
            }
        }
        lost(record, &finder, &cycles)?;
        if cycles.is_empty() {
            return Err(FeatureError::NoCycle { switchings: finder.switchings() });
        }
        Ok(Self { features: summary.features()?, relay, cycles })
    }
}

/// Whether the command stays at one level at the end for much longer than before.
fn lost(record: &Record, finder: &Cycles<f64>, cycles: &[Cycle<f64>]) -> Result<(), FeatureError> {
    let last = record.samples() - 1;
    let (end, level) = (record.time_s()[last], record.input()[last]);
    let Some(change) = finder.last_change_s() else { return Ok(()) };
    let half = match cycles.last() {
        Some(cycle) => cycle.time_positive_s.max(cycle.time_negative_s()),
        None => change - record.time_s()[0],
    };
    let duration_s = end - change;
    if half > 0.0 && duration_s > LOST * half {
        return Err(FeatureError::Saturated { level, duration_s, ratio: duration_s / half });
    }
    Ok(())
}
