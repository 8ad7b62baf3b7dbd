//! Every model tried, and the answer to one record.

use super::model::Parameter;
use crate::identify::answer::{Reported, Term};
use crate::identify::signal::{Clock, SwitchingInstant};

/// A model that was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Which drag terms it has: linear, quadratic.
    pub drag: [bool; 2],
    /// Its other terms.
    pub terms: Vec<Term>,
    /// When the command changes.
    pub switching: SwitchingInstant,
    /// Its clock.
    pub clock: Clock,
    /// Its log-likelihood, half cycles that repeat counted once.
    pub log_likelihood: f64,
    /// Number of parameters estimated.
    pub freedom: usize,
    /// Share in the average.
    pub weight: f64,
    /// Its structural parameters.
    pub values: [f64; Parameter::COUNT],
    /// Their standard deviations; zero for those not estimated, infinite where the record leaves them open. Without a share, those
    /// under white errors.
    pub deviations: [f64; Parameter::COUNT],
    /// Whether its search came to rest.
    pub settled: bool,
    /// Steps of the search.
    pub iterations: usize,
}

/// Everything the estimator found.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordAnswer {
    /// The one answer to use.
    pub reported: Reported,
    /// All models tried, the likeliest for its number of parameters first.
    pub candidates: Vec<Candidate>,
    /// Innovations of the likeliest model in standard deviations, with their times in s.
    pub innovations: Vec<(f64, f64)>,
    /// What the readings count together, those of repeated half cycles once.
    pub effective_samples: f64,
    /// Largest less least command.
    pub command_range: f64,
}

impl RecordAnswer {
    /// Level of the command: half its range.
    pub(super) fn level(&self) -> f64 {
        0.5 * self.command_range
    }
}
