//! The family of models: which parameters a model has, and their values.

use crate::identify::answer::DragLaw;
use crate::identify::signal::{Clock, SwitchingInstant};

/// Structural parameters of
/// `alpha x'' + (1 + skew sgn x') (beta + beta_quadratic |x'| + beta_cubic x'^2) x' + memory s + k x = a(t - T_d) + delta + w(t)`,
/// `tau a' = u - a`, `memory_s s' = x' - s`, `filter y' = x - y`, and the state in which the record begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(usize)]
pub enum Parameter {
    /// Inertia with added mass alpha, above zero.
    Alpha,
    /// Linear drag beta, of either sign.
    LinearDrag,
    /// Quadratic drag, the factor of `|x'| x'`.
    QuadraticDrag,
    /// Cubic drag, the factor of `x'^3`.
    CubicDrag,
    /// Part by which drag is larger to the positive side than the mean of both sides, and smaller to the negative one.
    Skew,
    /// Restoring force per unit of output, k.
    Stiffness,
    /// Factor of the drag that follows the speed late, of either sign: the water that the vehicle moved before still moves.
    Memory,
    /// Time constant with which it follows, in s.
    MemoryS,
    /// Constant force delta.
    Disturbance,
    /// Pure delay T_d between command and actuator, in s, zero or more.
    DelayS,
    /// Time constant tau of the actuator, in s.
    LagS,
    /// Time that an actuator of limited rate takes over the command's whole range, in s.
    RampS,
    /// Time without thrust after the command changes its sign, in s.
    PauseS,
    /// Time constant of the sensor's filter, in s.
    FilterS,
    /// Output where the record begins.
    Position,
    /// Its rate there, per s.
    Velocity,
}

impl Parameter {
    /// Number of structural parameters.
    pub const COUNT: usize = 16;
    /// All of them, in the order of their numbers.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Alpha,
        Self::LinearDrag,
        Self::QuadraticDrag,
        Self::CubicDrag,
        Self::Skew,
        Self::Stiffness,
        Self::Memory,
        Self::MemoryS,
        Self::Disturbance,
        Self::DelayS,
        Self::LagS,
        Self::RampS,
        Self::PauseS,
        Self::FilterS,
        Self::Position,
        Self::Velocity,
    ];

    /// Mean time by which one unit of the parameter makes the output late: half of a ramp or of a pause, which begin at once.
    pub(super) fn mean_lag(self) -> f64 {
        match self {
            Self::DelayS | Self::LagS | Self::FilterS => 1.0,
            Self::RampS | Self::PauseS => 0.5,
            _ => 0.0,
        }
    }
}

/// Parameters of the random inputs, each a logarithm.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(usize)]
pub(super) enum NoiseParameter {
    /// Variance of the white error of a reading, rounding included.
    White,
    /// Intensity of the process force, a random walk: variance of its change in one second.
    Force,
    /// Intensity of the coloured error of a reading.
    Colour,
    /// Rate at which that error is forgotten, per s.
    ColourRate,
    /// Intensity of a white force, as variance of the velocity gained in one second: lets a poor start follow the record.
    Tracking,
}

impl NoiseParameter {
    pub(super) const COUNT: usize = 5;
    pub(super) const ALL: [Self; Self::COUNT] =
        [Self::White, Self::Force, Self::Colour, Self::ColourRate, Self::Tracking];
}

/// A model with its values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct VehicleModel {
    pub(super) values: [f64; Parameter::COUNT],
    /// Whether each is estimated; the rest are given, or zero because the model lacks the term.
    pub(super) free: [bool; Parameter::COUNT],
    /// Logarithms; minus infinity for absent terms.
    pub(super) noise: [f64; NoiseParameter::COUNT],
    pub(super) noise_free: [bool; NoiseParameter::COUNT],
    pub(super) switching: SwitchingInstant,
    pub(super) clock: Clock,
}

impl VehicleModel {
    /// Nothing but zeros.
    pub(super) fn plain(switching: SwitchingInstant) -> Self {
        Self {
            values: [0.0; Parameter::COUNT],
            free: [false; Parameter::COUNT],
            noise: [f64::NEG_INFINITY; NoiseParameter::COUNT],
            noise_free: [false; NoiseParameter::COUNT],
            switching,
            clock: Clock::Stamps,
        }
    }

    pub(super) fn value(&self, parameter: Parameter) -> f64 {
        self.values[parameter as usize]
    }

    /// Mean time by which parameters make the output late, in s.
    pub(super) fn mean_lag_s(&self, parameters: &[Parameter]) -> f64 {
        parameters.iter().map(|parameter| parameter.mean_lag() * self.value(*parameter)).sum()
    }

    pub(super) fn is_free(&self, parameter: Parameter) -> bool {
        self.free[parameter as usize]
    }

    pub(super) fn has_noise(&self, noise: NoiseParameter) -> bool {
        self.noise[noise as usize] > f64::NEG_INFINITY
    }

    /// The size itself, zero for an absent term.
    pub(super) fn size(&self, noise: NoiseParameter) -> f64 {
        libm::exp(self.noise[noise as usize])
    }

    pub(super) fn set(&mut self, parameter: Parameter, value: f64, free: bool) {
        self.values[parameter as usize] = value;
        self.free[parameter as usize] = free;
    }

    pub(super) fn set_noise(&mut self, noise: NoiseParameter, size: f64, free: bool) {
        self.noise[noise as usize] = libm::log(size);
        self.noise_free[noise as usize] = free;
    }

    /// The model with another drag law: equal drag at `speed` > 0.
    pub(super) fn with_drag(&self, law: DragLaw, speed: f64) -> Self {
        let (linear, quadratic) = (self.value(Parameter::LinearDrag), self.value(Parameter::QuadraticDrag));
        let (linear, quadratic) = match law {
            DragLaw::Mixed => (linear, quadratic),
            DragLaw::Linear => (linear + quadratic * speed, 0.0),
            DragLaw::Quadratic => (0.0, quadratic + linear / speed),
        };
        let mut model = self.clone();
        model.set(Parameter::LinearDrag, linear, law.has_linear());
        model.set(Parameter::QuadraticDrag, quadratic, law.has_quadratic());
        model
    }

    /// Whether both have the same parameters under the same reading of the record.
    pub(super) fn is_alike(&self, other: &Self) -> bool {
        (self.free, self.noise_free, self.switching, self.clock)
            == (other.free, other.noise_free, other.switching, other.clock)
    }

    /// Structural parameters that are estimated.
    pub(super) fn structure(&self) -> impl Iterator<Item = Parameter> {
        let free = self.free;
        Parameter::ALL.into_iter().filter(move |parameter| free[*parameter as usize])
    }

    /// Number of all that is estimated.
    pub(super) fn freedom(&self) -> usize {
        self.free.iter().chain(&self.noise_free).filter(|free| **free).count()
    }
}
