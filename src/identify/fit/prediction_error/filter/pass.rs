//! Result of a run through the record.

use crate::identify::fit::prediction_error::model::{NoiseParameter, Parameter};

pub(super) const STRUCTURE: usize = Parameter::COUNT;
pub(super) const NOISES: usize = NoiseParameter::COUNT;

/// Error of a one-step prediction, and its variance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Innovation {
    pub(crate) error: f64,
    pub(crate) variance: f64,
}

impl Innovation {
    /// The error in standard deviations.
    pub(crate) fn standardised(self) -> f64 {
        self.error / self.variance.sqrt()
    }

    /// Logarithm of its density.
    pub(crate) fn log_density(self) -> f64 {
        -0.5 * (libm::log(core::f64::consts::TAU * self.variance) + self.standardised().powi(2))
    }
}

/// Gradient of the log-likelihood and Fisher's information.
#[derive(Clone, Debug)]
pub(crate) struct Score {
    pub(crate) structure: [f64; STRUCTURE],
    pub(crate) structure_information: [[f64; STRUCTURE]; STRUCTURE],
    pub(crate) noise: [f64; NOISES],
    pub(crate) noise_information: [[f64; NOISES]; NOISES],
}

impl Score {
    pub(super) fn zero() -> Self {
        Self {
            structure: [0.0; STRUCTURE],
            structure_information: [[0.0; STRUCTURE]; STRUCTURE],
            noise: [0.0; NOISES],
            noise_information: [[0.0; NOISES]; NOISES],
        }
    }

    /// The sums so far; resets them to zero. Only the half below the diagonal of the structure's information is summed.
    pub(super) fn take(&mut self) -> Self {
        let mut sum = core::mem::replace(self, Self::zero());
        for i in 0..STRUCTURE {
            for j in 0..i {
                sum.structure_information[j][i] = sum.structure_information[i][j];
            }
        }
        sum
    }

    pub(super) fn add(&mut self, other: &Self) {
        for i in 0..STRUCTURE {
            self.structure[i] += other.structure[i];
            for j in 0..STRUCTURE {
                self.structure_information[i][j] += other.structure_information[i][j];
            }
        }
        for i in 0..NOISES {
            self.noise[i] += other.noise[i];
            for j in 0..NOISES {
                self.noise_information[i][j] += other.noise_information[i][j];
            }
        }
    }
}

/// A run through the record.
#[derive(Clone, Debug)]
pub(crate) struct FilterPass {
    pub(crate) log_likelihood: f64,
    /// One per sample from [`Observations::first`] on.
    pub(crate) innovations: Vec<Innovation>,
    /// Scores of consecutive parts of the record; empty where no derivatives were asked for.
    pub(crate) parts: Vec<Score>,
    /// Derivatives of each prediction's error by the structural parameters; empty where they were not asked for.
    pub(crate) slopes: Vec<[f64; STRUCTURE]>,
    /// Whether predictions follow the readings before them, or the motion alone.
    pub(crate) stochastic: bool,
    /// Steps of the integration.
    pub(crate) steps: usize,
}

impl FilterPass {
    pub(crate) fn score(&self) -> Score {
        let mut sum = Score::zero();
        for part in &self.parts {
            sum.add(part);
        }
        sum
    }
}
