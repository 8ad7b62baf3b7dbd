//! How a model gets a term and loses it.

use super::model::{NoiseParameter, Parameter, VehicleModel};
use super::observations::Observations;
use crate::identify::answer::Term;

impl Term {
    /// The structural parameters that the term consists of; none for what is random.
    pub(super) fn parameters(self) -> &'static [Parameter] {
        match self {
            Self::Lag => &[Parameter::LagS],
            Self::RateLimit => &[Parameter::RampS],
            Self::ReversalPause => &[Parameter::PauseS],
            Self::Stiffness => &[Parameter::Stiffness],
            Self::CubicDrag => &[Parameter::CubicDrag],
            Self::SkewDrag => &[Parameter::Skew],
            Self::FluidMemory => &[Parameter::Memory, Parameter::MemoryS],
            Self::SensorFilter => &[Parameter::FilterS],
            Self::Delay => &[Parameter::DelayS],
            _ => &[],
        }
    }

    /// Whether the term belongs to the motion rather than to what is random.
    pub(super) fn is_structural(self) -> bool {
        !self.parameters().is_empty()
    }

    fn noises(self) -> &'static [NoiseParameter] {
        match self {
            Self::ProcessForce => &[NoiseParameter::Force],
            Self::ColouredNoise => &[NoiseParameter::Colour, NoiseParameter::ColourRate],
            _ => &[],
        }
    }

    /// Number of parameters that it adds.
    pub(super) fn freedom(self) -> usize {
        self.parameters().len() + self.noises().len()
    }

    pub(super) fn is_in(self, model: &VehicleModel) -> bool {
        self.parameters().iter().all(|parameter| model.is_free(*parameter))
            && self.noises().iter().all(|noise| model.has_noise(*noise))
    }

    /// Whether a record can show the term.
    pub(super) fn is_shown(self, observations: &Observations) -> bool {
        match self {
            Self::RateLimit => observations.switched,
            Self::ReversalPause => observations.reverses(),
            _ => true,
        }
    }

    /// Whether the term is not tried beside the other.
    pub(super) fn excludes(self, other: Self) -> bool {
        let pair = [self, other];
        // Behind a lag or a ramp the force has no derivative by the length of a pause.
        let behind = pair.contains(&Self::Lag) || pair.contains(&Self::RateLimit);
        // A force that changes with time takes in the effect of late drag.
        (pair.contains(&Self::ReversalPause) && behind) || (self == Self::FluidMemory && other == Self::ProcessForce)
    }

    /// Whether the model admits the term.
    pub(super) fn applies(self, model: &VehicleModel, observations: &Observations) -> bool {
        let excluded = Self::ALL.into_iter().any(|other| self.excludes(other) && other.is_in(model));
        !self.is_in(model) && !excluded && self.is_shown(observations)
    }

    /// The model without the term; what rests on it goes too. `known_delay_s` takes the place of one estimated.
    pub(super) fn without(self, model: &VehicleModel, known_delay_s: Option<f64>) -> VehicleModel {
        let mut model = model.clone();
        if self == Self::Delay {
            let value = known_delay_s.unwrap_or(model.value(Parameter::DelayS));
            model.set(Parameter::DelayS, value, false);
            return model;
        }
        if model.is_free(Parameter::DelayS) {
            // The mean delay stays.
            model.values[Parameter::DelayS as usize] += model.mean_lag_s(self.parameters());
        }
        self.parameters().iter().for_each(|parameter| model.set(*parameter, 0.0, false));
        for noise in self.noises() {
            model.set_noise(*noise, 0.0, false);
        }
        model
    }

    /// Whether the starts make the record as likely as each other: none of them stands for the rest.
    pub(super) fn starts_without_effect(self) -> bool {
        self == Self::FluidMemory
    }

    /// Models with the term from which a search may start.
    pub(super) fn starts(self, model: &VehicleModel, observations: &Observations) -> Vec<VehicleModel> {
        let with = |parameter: Parameter, value: f64| {
            let mut model = model.clone();
            model.set(parameter, value, true);
            model
        };
        let noisy = |sizes: &[(NoiseParameter, f64)]| {
            let mut model = model.clone();
            for (noise, size) in sizes {
                model.set_noise(*noise, *size, true);
            }
            model
        };
        let (interval, half_period) = (observations.interval_s, observations.half_period_s);
        match self {
            Self::Stiffness | Self::CubicDrag | Self::SkewDrag => {
                self.parameters().iter().map(|parameter| with(*parameter, 0.0)).collect()
            }
            Self::FluidMemory => {
                let slow = |part: f64| {
                    let mut model = with(Parameter::Memory, 0.0);
                    model.set(Parameter::MemoryS, part * half_period, true);
                    model
                };
                [0.15, 0.5, 1.5].map(slow).to_vec()
            }
            Self::Delay => vec![with(Parameter::DelayS, model.value(Parameter::DelayS))],
            Self::Lag | Self::RateLimit | Self::ReversalPause | Self::SensorFilter => {
                let parameter = self.parameters()[0];
                let delay_s = model.value(Parameter::DelayS);
                let late = |part: f64| {
                    // At a known delay the lag comes on top; else it takes the place of a part of the delay.
                    let time_s =
                        if model.is_free(Parameter::DelayS) { part * delay_s } else { 0.1 * part * half_period };
                    let mut model = with(parameter, time_s.max(0.3 * interval) / parameter.mean_lag());
                    if model.is_free(Parameter::DelayS) {
                        model.values[Parameter::DelayS as usize] = (delay_s - time_s).max(0.0);
                    }
                    model
                };
                [0.15, 0.4, 0.7, 0.95].map(late).to_vec()
            }
            Self::ProcessForce => {
                let unit = observations.range * observations.range / half_period;
                [1e-6, 1e-5, 1e-4, 1e-3, 1e-2].map(|part| noisy(&[(NoiseParameter::Force, part * unit)])).to_vec()
            }
            Self::ColouredNoise => {
                let white = model.size(NoiseParameter::White);
                let times = [2.0 * interval, 8.0 * interval, 40.0 * interval, observations.duration_s()];
                let start = |time_s: f64, part: f64| {
                    noisy(&[
                        (NoiseParameter::Colour, 2.0 * part * white / time_s),
                        (NoiseParameter::ColourRate, 1.0 / time_s),
                        (NoiseParameter::White, (1.0 - part).max(0.1) * white),
                    ])
                };
                times.iter().flat_map(|time| [0.15, 0.5, 0.95].map(|part| start(*time, part))).collect()
            }
        }
    }
}
