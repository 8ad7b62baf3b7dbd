//! A proof of bounds, or of a refutation, in a file: checked without a search.
//!
//! A stage begins with a box of parameters and goes through it depth first. Each step contracts the box at hand, divides it, excludes
//! it, or keeps it as a part of what is left; what contracts and excludes are nonnegative multipliers of inequalities that the
//! readings imply over that box. Whoever checks it encloses the motion over the boxes that the file names, and adds.

mod check;
mod prove;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use super::contract::Origin;
use super::field::Term;
use super::search::Search;
use super::settings::BoundedModel;
use super::setup::Setup;
use crate::identify::IdentifyError;
use crate::numeric::Interval;

pub use check::{Shown, Unproved};

/// Changes with the meaning of a field.
const FORMAT: u32 = 1;

/// What is shown, of which readings, and the steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// Of the file.
    pub(super) format: u32,
    /// Of the crate that wrote it.
    pub(super) version: String,
    /// In words.
    pub(super) statement: String,
    /// Of the equation, in the order in which they stand in a box.
    pub(super) terms: Vec<Term>,
    /// The linear term's coefficient is that of the drag plus twice this times the quadratic one's, in output units per s.
    pub(super) middle_speed: f64,
    /// No linear drag below this, over alpha, is looked for, in 1/s.
    pub(super) least_linear: f64,
    /// No speed above this is looked for.
    pub(super) fastest: f64,
    /// Readings with their errors.
    pub(super) records: Vec<Sensed>,
    /// One after the other; each begins where the one before ended.
    pub(super) stages: Vec<Stage>,
    /// One parameter.
    pub(super) witness: Option<Witness>,
}

/// A parameter that meets every reading from some sample on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Witness {
    /// That sample, by record.
    pub(super) first: Vec<usize>,
    /// As in a box, then the state at each of these samples.
    pub(super) values: Vec<f64>,
}

/// A record as a set of constraints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Sensed {
    pub(super) time_s: Vec<f64>,
    pub(super) reading: Vec<f64>,
    /// The largest of a reading, in its units.
    pub(super) error: f64,
    /// The largest error of a stamp.
    pub(super) jitter_s: f64,
    /// Commands, the first before any switching.
    pub(super) levels: Vec<f64>,
    /// First and last instant of each switching.
    pub(super) switched_s: Vec<[f64; 2]>,
}

/// A box and what is left of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Stage {
    /// The delay where it is no unknown; null where it is.
    pub(super) delay_s: Option<f64>,
    /// Record, first and last sample of each window.
    pub(super) windows: Vec<[usize; 3]>,
    /// Where it begins: terms, delay, then each record's disturbance and instants.
    pub(super) from: Vec<[f64; 2]>,
    /// What is left; null for nothing.
    pub(super) left: Option<Vec<[f64; 2]>>,
    pub(super) steps: Vec<Step>,
}

/// Whence inequalities are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum By {
    /// The equation weighed with hats, and speeds from the readings.
    Hats,
    /// Whole records.
    Whole,
    /// All windows, each linked to the next.
    Chain,
    /// One window alone.
    Window(usize),
}

/// Inequalities with nonnegative multipliers.
pub(super) type Combination = Vec<(Origin, f64)>;

/// A new end of one unknown's range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Cut {
    pub(super) unknown: usize,
    pub(super) upper: bool,
    pub(super) end: f64,
    /// None where the enclosure itself shows it.
    pub(super) rows: Combination,
}

/// What is done with the box at hand.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Step {
    /// It shrinks; to nothing where a range ends before it begins.
    Contract { by: By, cuts: Vec<Cut> },
    /// Nothing is in it; without rows where enclosures have nothing in common.
    Exclude { by: By, rows: Combination },
    /// In two at a value of an unknown; the upper part is the next but what the lower one leads to.
    Divide { unknown: usize, at: f64 },
    /// It lies in what is left.
    Keep,
}

/// Whether anything is left of the range.
fn shorten(at: &mut [Interval], cut: &Cut) -> bool {
    let side = at[cut.unknown];
    let half = if cut.upper { Interval::new(side.lower(), cut.end) } else { Interval::new(cut.end, side.upper()) };
    match half.and_then(|half| half.intersection(side)) {
        Some(left) => {
            at[cut.unknown] = left;
            true
        }
        None => false,
    }
}

impl Certificate {
    /// Of a search from the box of `wide`, and of a second one with more readings where there are two `hulls`: what each left.
    ///
    /// # Errors
    /// [`Unproved::NotFound`] where a stage takes too many steps, however much room there is around what is left.
    pub(super) fn prove(
        wide: &Setup,
        settings: &BoundedModel,
        hulls: &[Option<Vec<Interval>>],
        witness: Option<Witness>,
    ) -> Result<Result<Self, Unproved>, IdentifyError> {
        let mut stages: Vec<Stage> = Vec::new();
        for hull in hulls {
            let left = stages.last().and_then(|stage| check::sides(stage.left.as_ref()?));
            let narrowed = left.map(|left| wide.narrowed(settings, &left)).transpose()?;
            match Stage::prove(narrowed.as_ref().unwrap_or(wide), hull.as_deref()) {
                Ok(stage) => stages.push(stage),
                Err(error) => return Ok(Err(error)),
            }
        }
        let sensed = wide.records.iter().map(|readings| Sensed {
            time_s: readings.time_s.clone(),
            reading: readings.value.clone(),
            error: readings.error,
            jitter_s: readings.jitter_s,
            levels: readings.command.levels().to_vec(),
            switched_s: readings.command.spans().iter().map(|(first, last)| [*first, *last]).collect(),
        });
        let mut certificate = Self {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            statement: String::new(),
            terms: wide.layout.terms().to_vec(),
            middle_speed: wide.middle_speed,
            least_linear: wide.least_linear,
            fastest: wide.fastest,
            records: sensed.collect(),
            stages,
            witness,
        };
        certificate.statement = certificate.words();
        Ok(Ok(certificate))
    }

    /// From the text of a file.
    ///
    /// # Errors
    /// [`Unproved::Malformed`].
    pub fn read(text: &str) -> Result<Self, Unproved> {
        serde_json::from_str(text).map_err(|error| Unproved::Malformed { text: error.to_string() })
    }
}

impl Witness {
    pub(super) fn of(search: &Search<'_>, at: &[f64]) -> Self {
        let layout = &search.setup.layout;
        let spans = search.model.whole();
        let mut values = at[..layout.parameters()].to_vec();
        for span in &spans {
            values.extend((0..layout.state_size()).map(|component| at[layout.start(span.from, component)]));
        }
        Self { first: spans.iter().map(|span| layout.windows()[span.from].first).collect(), values }
    }
}

impl core::fmt::Display for Certificate {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&serde_json::to_string(self).map_err(|_| core::fmt::Error)?)
    }
}
