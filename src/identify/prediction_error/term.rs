//! Terms that a model may have beside inertia, linear and quadratic drag and white noise.

use serde::{Deserialize, Serialize};

use super::model::{Model, Noise, Parameter};
use super::observations::Observations;

/// What a model may have in addition, each tried where it makes the record likelier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Term {
    /// First-order lag of the actuator.
    Lag,
    /// Limited rate of the actuator.
    RateLimit,
    /// Restoring force.
    Stiffness,
    /// Drag proportional to the cube of the speed.
    CubicDrag,
    /// Drag larger to one side than to the other.
    SkewDrag,
    /// Coulomb friction.
    Coulomb,
    /// Drag that follows the speed late, as of water set in motion before.
    FluidMemory,
    /// First-order filter of the sensor.
    SensorFilter,
    /// A delay other than the one given.
    Delay,
    /// A force that walks at random.
    ProcessForce,
    /// That force forgets (Ornstein-Uhlenbeck).
    ProcessForceMemory,
    /// An error of the reading that is alike from sample to sample.
    ColouredNoise,
    /// Time stamps that err at random.
    StampJitter,
    /// Instants of switching that err at random.
    SwitchJitter,
}

impl Term {
    pub(super) const ALL: [Self; 14] = [
        Self::Lag,
        Self::RateLimit,
        Self::Stiffness,
        Self::CubicDrag,
        Self::SkewDrag,
        Self::Coulomb,
        Self::FluidMemory,
        Self::SensorFilter,
        Self::Delay,
        Self::ProcessForce,
        Self::ProcessForceMemory,
        Self::ColouredNoise,
        Self::StampJitter,
        Self::SwitchJitter,
    ];

    /// Name on the command line and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Lag => "lag",
            Self::RateLimit => "rate-limit",
            Self::Stiffness => "stiffness",
            Self::CubicDrag => "cubic-drag",
            Self::SkewDrag => "one-sided-drag",
            Self::Coulomb => "coulomb-friction",
            Self::FluidMemory => "fluid-memory",
            Self::SensorFilter => "sensor-filter",
            Self::Delay => "delay",
            Self::ProcessForce => "process-force",
            Self::ProcessForceMemory => "process-force-memory",
            Self::ColouredNoise => "coloured-noise",
            Self::StampJitter => "stamp-jitter",
            Self::SwitchJitter => "switch-jitter",
        }
    }

    /// What a record with the term shows, as the beginning of a sentence.
    pub(super) fn finding(self) -> &'static str {
        match self {
            Self::Lag => "the actuator follows the command with a lag",
            Self::RateLimit => "the actuator follows the command at a limited rate",
            Self::Stiffness => "a restoring force acts",
            Self::CubicDrag => "drag grows with the cube of the speed",
            Self::SkewDrag => "drag is larger to one side than to the other",
            Self::Coulomb => "friction acts that does not grow with the speed",
            Self::FluidMemory => "a part of the drag follows the speed late",
            Self::SensorFilter => "the sensor follows the motion with a lag",
            Self::Delay => "the delay is another than the one given",
            Self::ProcessForce => "a force acts that changes with time",
            Self::ProcessForceMemory => "that force returns to its mean",
            Self::ColouredNoise => "errors of the readings are alike from sample to sample",
            Self::StampJitter => "the time stamps err at random",
            Self::SwitchJitter => "the command acts at instants that err at random",
        }
    }

    /// The structural parameters that the term consists of; none for what is random.
    fn parameters(self) -> &'static [Parameter] {
        match self {
            Self::Lag => &[Parameter::LagS],
            Self::RateLimit => &[Parameter::RampS],
            Self::Stiffness => &[Parameter::Stiffness],
            Self::CubicDrag => &[Parameter::CubicDrag],
            Self::SkewDrag => &[Parameter::Skew],
            Self::Coulomb => &[Parameter::Coulomb],
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

    fn noises(self) -> &'static [Noise] {
        match self {
            Self::ProcessForce => &[Noise::Force],
            Self::ProcessForceMemory => &[Noise::ForceRate],
            Self::ColouredNoise => &[Noise::Colour, Noise::ColourRate],
            Self::StampJitter => &[Noise::StampJitter],
            Self::SwitchJitter => &[Noise::SwitchJitter],
            _ => &[],
        }
    }

    /// Number of parameters that it adds.
    pub(super) fn freedom(self) -> usize {
        self.parameters().len() + self.noises().len()
    }

    pub(super) fn is_in(self, model: &Model) -> bool {
        self.parameters().iter().all(|parameter| model.is_free(*parameter))
            && self.noises().iter().all(|noise| model.has_noise(*noise))
    }

    /// Whether the model can have the term besides what it has.
    pub(super) fn applies(self, model: &Model, observations: &Observations) -> bool {
        !self.is_in(model)
            && match self {
                Self::RateLimit | Self::SwitchJitter => observations.switched,
                Self::ProcessForceMemory => Self::ProcessForce.is_in(model),
                // A force that changes with time takes in what late drag does.
                Self::FluidMemory => !Self::ProcessForce.is_in(model),
                _ => true,
            }
    }

    /// The model without the term; what rests on it goes too. `known_delay_s` takes the place of one estimated.
    pub(super) fn without(self, model: &Model, known_delay_s: Option<f64>) -> Model {
        let mut model = model.clone();
        if self == Self::Delay {
            let value = known_delay_s.unwrap_or(model.value(Parameter::DelayS));
            model.set(Parameter::DelayS, value, false);
            return model;
        }
        for &parameter in self.parameters() {
            // The mean delay stays.
            let late = match parameter {
                Parameter::LagS | Parameter::FilterS => model.value(parameter),
                Parameter::RampS => 0.5 * model.value(Parameter::RampS),
                _ => 0.0,
            };
            if model.is_free(Parameter::DelayS) {
                model.values[Parameter::DelayS as usize] += late;
            }
            model.set(parameter, 0.0, false);
        }
        let dependent: &[Noise] = if self == Self::ProcessForce { &[Noise::ForceRate] } else { &[] };
        for noise in self.noises().iter().chain(dependent) {
            model.set_noise(*noise, 0.0, false);
        }
        model
    }

    /// Whether the starts make the record as likely as each other: none of them stands for the rest.
    pub(super) fn starts_without_effect(self) -> bool {
        self == Self::FluidMemory
    }

    /// Models with the term from which a search may start.
    pub(super) fn starts(self, model: &Model, observations: &Observations) -> Vec<Model> {
        let with = |parameter: Parameter, value: f64| {
            let mut model = model.clone();
            model.set(parameter, value, true);
            model
        };
        let noisy = |sizes: &[(Noise, f64)]| {
            let mut model = model.clone();
            for (noise, size) in sizes {
                model.set_noise(*noise, *size, true);
            }
            model
        };
        let (interval, swing) = (observations.interval_s, observations.swing_s);
        match self {
            Self::Stiffness | Self::CubicDrag | Self::SkewDrag | Self::Coulomb => {
                self.parameters().iter().map(|parameter| with(*parameter, 0.0)).collect()
            }
            Self::FluidMemory => {
                let slow = |part: f64| {
                    let mut model = with(Parameter::Memory, 0.0);
                    model.set(Parameter::MemoryS, part * swing, true);
                    model
                };
                [0.15, 0.5, 1.5].map(slow).to_vec()
            }
            Self::Delay => vec![with(Parameter::DelayS, model.value(Parameter::DelayS))],
            Self::Lag | Self::RateLimit | Self::SensorFilter => {
                let (parameter, mean) = match self {
                    Self::RateLimit => (Parameter::RampS, 0.5),
                    Self::Lag => (Parameter::LagS, 1.0),
                    _ => (Parameter::FilterS, 1.0),
                };
                let delay_s = model.value(Parameter::DelayS);
                let late = |part: f64| {
                    // At a known delay the lag comes on top; else it takes the place of a part of the delay.
                    let time_s = if model.is_free(Parameter::DelayS) { part * delay_s } else { 0.1 * part * swing };
                    let mut model = with(parameter, time_s.max(0.3 * interval) / mean);
                    if model.is_free(Parameter::DelayS) {
                        model.values[Parameter::DelayS as usize] = (delay_s - time_s).max(0.0);
                    }
                    model
                };
                [0.15, 0.4, 0.7, 0.95].map(late).to_vec()
            }
            Self::ProcessForce => {
                let unit = observations.range * observations.range / swing;
                [1e-6, 1e-5, 1e-4, 1e-3, 1e-2].map(|part| noisy(&[(Noise::Force, part * unit)])).to_vec()
            }
            Self::ProcessForceMemory => [0.1, 0.5, 2.0]
                .map(|rate| {
                    let (rate, force) = (rate / swing, model.size(Noise::Force));
                    noisy(&[(Noise::ForceRate, rate), (Noise::Force, force * (1.0 + rate * swing))])
                })
                .to_vec(),
            Self::ColouredNoise => {
                let white = model.size(Noise::White);
                let times = [2.0 * interval, 8.0 * interval, 40.0 * interval, observations.duration_s()];
                let start = |time_s: f64, part: f64| {
                    noisy(&[
                        (Noise::Colour, 2.0 * part * white / time_s),
                        (Noise::ColourRate, 1.0 / time_s),
                        (Noise::White, (1.0 - part).max(0.1) * white),
                    ])
                };
                times.iter().flat_map(|time| [0.15, 0.5, 0.95].map(|part| start(*time, part))).collect()
            }
            Self::StampJitter => {
                [0.03, 0.1, 0.3].map(|part| noisy(&[(Noise::StampJitter, (part * interval).powi(2))])).to_vec()
            }
            Self::SwitchJitter => {
                [0.05, 0.2, 0.6].map(|part| noisy(&[(Noise::SwitchJitter, (part * interval).powi(2))])).to_vec()
            }
        }
    }
}
