//! Features of a whole record.

use super::orders::Orders;
use super::{Cycle, Cycles, FeatureError, Features, LOST, Summary};
use crate::experiment::Record;

/// The two levels of a relay's command, as a record shows them.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct RelayLevels {
    /// Half the distance of the two levels, C.
    pub level: f64,
    /// Middle of the two levels.
    pub offset: f64,
}

/// Features of a whole record: its cycles, the steady part and the levels of the command.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct RecordFeatures {
    /// Means and spreads.
    pub features: Features<f64>,
    /// The relay's two levels.
    pub relay: RelayLevels,
    /// Mean time in s that the command takes from level to level, as a rudder does; zero where it is the relay's. Cycles are
    /// those of the orders: the command's way to a level begins with them.
    #[serde(default)]
    pub ramp_s: f64,
    /// Every cycle found, start-up included.
    pub cycles: Vec<Cycle<f64>>,
}

impl RelayLevels {
    /// The levels of a two-valued input, or of an input that passes between two values at a constant rate.
    ///
    /// # Errors
    /// [`FeatureError::ConstantInput`], [`FeatureError::NotARelay`].
    pub fn of(record: &Record) -> Result<Self, FeatureError> {
        Orders::of(record).map(|orders| orders.relay)
    }
}

impl RecordFeatures {
    /// Features of a relay experiment: the stream's, fed with the record. Where the command goes from level to level at a
    /// limited rate, the relay's orders are taken to be given where it begins to move.
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
        let Orders { relay, input, ramp_s } = Orders::of(record)?;
        let mut finder = Cycles::new(relay.offset);
        let mut summary = Summary::new();
        let mut cycles = Vec::new();
        for ((time, output), input) in record.time_s().iter().zip(record.output()).zip(&input) {
            if let Some(cycle) = finder.step(*time, *output, *input) {
                summary.push(cycle);
                cycles.push(cycle);
            }
        }
        lost(record, &finder, &cycles)?;
        if cycles.is_empty() {
            return Err(FeatureError::NoCycle { switchings: finder.switchings() });
        }
        Ok(Self { features: summary.features()?, relay, ramp_s, cycles })
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
