//! From measured features to what the methods take.

use super::exact::MeanCycle;
use super::iso::Oscillation;
use crate::features::Features;
use crate::numeric::Scalar;

impl<S: Scalar> Oscillation<S> {
    /// The means over steady cycles (steps 1 to 3 of the paper's procedure), with the level of the relay and the delay of the
    /// loop, which a record alone does not show. Condition 40 (step 4) is checked when parameters are asked for (step 5).
    ///
    /// ```
    /// use selfosc::experiment::SimulatedExperiment;
    /// use selfosc::features::RecordFeatures;
    /// use selfosc::identify::iso::Oscillation;
    /// use selfosc::{nonlinearity::RelayHysteresis, plant::DragAxis};
    /// let axis = DragAxis::quadratic(1.0, 0.5)?;
    /// let record = SimulatedExperiment::new(axis, RelayHysteresis::new(1.0, 0.3, 0.0)?, 100.0)?.run(60.0)?;
    /// let found = RecordFeatures::of(&record)?;
    /// let parameters = Oscillation::of(&found.features, found.relay.level, 0.0).identify()?;
    /// assert!((parameters.alpha - 1.0).abs() < 0.05);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn of(features: &Features<S>, relay_level: S, delay_s: S) -> Self {
        Self {
            relay_level,
            switch_level: features.switch_level.mean,
            amplitude: features.amplitude.mean,
            bias: features.bias.mean,
            period_s: features.period_s.mean,
            delay_s,
        }
    }
}

impl<S: Scalar> MeanCycle<S> {
    /// The means over steady cycles, with the level of the relay and the delay of the loop.
    pub fn of(features: &Features<S>, relay_level: S, delay_s: S) -> Self {
        Self {
            relay_level,
            switch_level: features.switch_level.mean,
            amplitude: features.amplitude.mean,
            time_positive_s: features.time_positive_s.mean,
            time_negative_s: features.time_negative_s.mean,
            delay_s,
        }
    }
}
