//! A record predicted from an answer that it had no part in.

use serde::{Deserialize, Serialize};

use super::model::{NoiseParameter, Parameter, VehicleModel};
use super::observations::Observations;
use super::scoring::{Fitted, climb};
use crate::experiment::Record;
use crate::identify::answer::{Estimate, Reported};
use crate::identify::signal::{Clock, SwitchingInstant};
use crate::plant::State;

/// Readings omitted at the beginning beyond the delay, in half-periods.
const UNSEEN: f64 = 0.05;
/// White variance that the search for the disturbance starts with, in squares of the output's range.
const FIRST_VARIANCE: f64 = 1e-2;

/// How well an answer predicts a record: parameters from the answer, the disturbance and the initial state from the record itself,
/// and no reading of it used on the way.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Prediction {
    /// Share of the output's variation that the prediction has, in percent; below zero where the mean would do better.
    pub fit_percent: f64,
    /// Root mean square of the error, in output units.
    pub rms: f64,
    /// The disturbance found.
    pub disturbance: f64,
}

impl Prediction {
    /// Part of the output's variance that the prediction explains: one less the squared error over the variance.
    pub(crate) fn explained(&self) -> f64 {
        1.0 - (1.0 - 0.01 * self.fit_percent).powi(2)
    }
}

/// A record's outputs as an answer predicts them.
#[derive(Clone, Debug, PartialEq)]
pub struct PredictedMotion {
    /// How well it does.
    pub prediction: Prediction,
    /// The first sample predicted.
    pub first_sample: usize,
    /// The outputs from there on, in output units; `None` where the reading counts as an outlier.
    pub output: Vec<Option<f64>>,
}

impl Reported {
    /// Predicts a record, with the thrust of its command's level if the fitted records determined the thrust law; `None` where
    /// the motion diverges, or the command never leaves the dead zone.
    #[must_use]
    pub fn predict(&self, record: &Record) -> Option<Prediction> {
        Some(self.predicted_motion(record)?.prediction)
    }

    /// As [`predict`](Self::predict), with the outputs.
    #[must_use]
    pub fn predicted_motion(&self, record: &Record) -> Option<PredictedMotion> {
        let (low, high) =
            record.input().iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), u| (u.min(low), u.max(high)));
        let vehicle = self.at_level(0.5 * (high - low))?;
        let ways = [SwitchingInstant::AtSamples, SwitchingInstant::Between];
        let ends = ways.into_iter().filter_map(|switching| vehicle.predicted(record, switching));
        ends.min_by(|a, b| a.prediction.rms.total_cmp(&b.prediction.rms))
    }

    fn predicted(&self, record: &Record, switching: SwitchingInstant) -> Option<PredictedMotion> {
        let mut observations = Observations::new(record, Clock::Stamps, switching);
        observations.skip(self.mean_delay_s() + UNSEEN * observations.half_period_s);
        let State { position, velocity } = observations.start_state();
        let mut model = VehicleModel::plain(switching);
        let value = |estimate: Option<Estimate>| estimate.map_or(0.0, |estimate| estimate.value);
        for (parameter, value, free) in [
            (Parameter::Alpha, self.alpha.value, false),
            (Parameter::LinearDrag, self.beta.value, false),
            (Parameter::QuadraticDrag, self.beta_quadratic.value, false),
            (Parameter::CubicDrag, value(self.beta_cubic), false),
            (Parameter::Skew, value(self.skew), false),
            (Parameter::Stiffness, value(self.stiffness), false),
            (Parameter::Memory, value(self.memory), false),
            (Parameter::MemoryS, value(self.memory_s), false),
            (Parameter::DelayS, self.delay_s.value, false),
            (Parameter::LagS, value(self.lag_s), false),
            (Parameter::RampS, value(self.ramp_s), false),
            (Parameter::PauseS, value(self.pause_s), false),
            (Parameter::FilterS, value(self.filter_s), false),
            (Parameter::Disturbance, 0.0, true),
            (Parameter::Position, position, true),
            (Parameter::Velocity, velocity, true),
        ] {
            model.set(parameter, value, free);
        }
        model.set_noise(NoiseParameter::White, FIRST_VARIANCE * observations.span * observations.span, true);
        let Fitted { model, pass, .. } = climb(&observations, model)?;
        let seen = &observations.output[observations.first..];
        #[allow(clippy::cast_precision_loss, reason = "a count of samples")]
        let count = seen.len() as f64;
        let mean = seen.iter().sum::<f64>() / count;
        let variation = seen.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
        // Outliers have no weight and no error.
        let square = pass.innovations.iter().map(|innovation| innovation.error * innovation.error).sum::<f64>();
        let prediction = Prediction {
            fit_percent: 100.0 * (1.0 - (square / variation.max(f64::MIN_POSITIVE)).sqrt()),
            rms: (square / count).sqrt(),
            disturbance: model.value(Parameter::Disturbance),
        };
        // An outlier has no weight, and its innovation no meaning.
        let counted = observations.weight[observations.first..].iter().map(|weight| *weight > 0.0);
        let predicted = seen.iter().zip(&pass.innovations).map(|(reading, innovation)| reading - innovation.error);
        let output = counted.zip(predicted).map(|(counted, predicted)| counted.then_some(predicted));
        Some(PredictedMotion { prediction, first_sample: observations.first, output: output.collect() })
    }
}
