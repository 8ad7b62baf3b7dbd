//! Every model tried, and the answer to a single record.

use super::model::Parameter;
use crate::identify::answer::{Reported, Term};
use crate::identify::signal::Clock;

/// A model that was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Its terms in addition to drag.
    pub terms: Vec<Term>,
    /// Its clock.
    pub clock: Clock,
    /// Its structural parameters.
    pub values: [f64; Parameter::COUNT],
}

/// Everything the estimator found.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordAnswer {
    /// The answer to use.
    pub reported: Reported,
    /// The same with the mean over the models of each parameter by itself, by which records are pooled.
    pub(super) means: Reported,
    /// All models tried, the likeliest for its number of parameters first.
    pub candidates: Vec<Candidate>,
    /// Level of the command: half its range.
    pub command_level: f64,
}
