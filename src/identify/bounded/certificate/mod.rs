//! A proof of bounds, or of a refutation, in a file: checked without a search.
//!
//! A stage begins with a box of parameters and goes through it depth first. Each step contracts the box at hand, divides it, excludes
//! it, or keeps it as a part of what is left; what contracts and excludes are nonnegative multipliers of inequalities that the
//! readings imply over that box. A box may be slanted: it then lies in a box of other coordinates, too, those of its frame. Whoever
//! checks it encloses the motion over the boxes that the file names, and adds.

mod check;
mod prove;
mod prover;
mod seek;
mod slant;
#[cfg(test)]
mod tests;
mod walk;

use serde::{Deserialize, Serialize};

use super::contract::Origin;
use super::explore::Explored;
use super::field::Term;
use super::search::Search;
use super::settings::BoundedModel;
use super::setup::{PROVED, Setup};
use crate::identify::IdentifyError;
use crate::numeric::Interval;

pub use check::{Shown, Unproved};
use prove::Goal;

/// Changes with the meaning of a field.
const FORMAT: u32 = 2;
/// What hats and chained windows cost against a motion to the second order over as much of a record.
const BY_HATS: f64 = 0.15;
const BY_CHAIN: f64 = 0.45;
/// Remainders of the motions that steps name may be so many times as large as those of a search: fewer steps of a motion for a check.
const ROUGHLY: f64 = 100.0;

/// Of which a model has the reciprocal time over which they matter.
fn roughly(swing_s: f64) -> Option<f64> {
    Some(ROUGHLY / swing_s)
}

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

/// Whence inequalities are; of each record so many windows are followed, from its first on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum By {
    /// The equation weighed with hats, and speeds from the readings.
    Hats(usize),
    /// The motion over windows, each linked to the next.
    Chain(usize),
    /// The motion without a break, to the second order in the coordinates of the box's frame; of a box without one, along the axes
    /// about its middle.
    Slanted(usize),
    /// What [`By::Slanted`] found last over a box that this one is a part of.
    Same,
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

/// Coordinates z of parameters and of the states at records' beginnings: `centre + M z`, M unit lower triangular.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Axes {
    /// Of each row.
    pub(super) centre: Vec<f64>,
    /// Row by row, below the diagonal.
    pub(super) lower: Vec<Vec<f64>>,
}

/// What is done with the box at hand.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Step {
    /// It shrinks; to nothing where a range ends before it begins. A cut may use what those before it leave.
    Contract { by: By, cuts: Vec<Cut> },
    /// It shrinks in the coordinates of another frame, or of its own, and has that frame then.
    Turn { by: By, frame: Option<Axes>, cuts: Vec<Cut> },
    /// Nothing is in it; without rows where enclosures have nothing in common.
    Exclude { by: By, rows: Combination },
    /// In two at a value of an unknown; the upper part is the next but what the lower one leads to.
    Divide { unknown: usize, at: f64 },
    /// The same at a value of a coordinate.
    Part { coordinate: usize, at: f64 },
    /// It lies in what is left.
    Keep,
}

impl Step {
    /// Windows of each record that are followed, and what it takes to follow them, against a motion to the second order; none where
    /// nothing is.
    fn follows(&self) -> Option<(usize, f64)> {
        match self {
            Self::Contract { by, .. } | Self::Exclude { by, .. } | Self::Turn { by, .. } => match by {
                By::Hats(reach) => Some((*reach, BY_HATS)),
                By::Chain(reach) => Some((*reach, BY_CHAIN)),
                By::Slanted(reach) => Some((*reach, 1.0)),
                By::Same => None,
            },
            Self::Divide { .. } | Self::Part { .. } | Self::Keep => None,
        }
    }
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
    /// Of what was `explored` from the box of `wide`: with more readings once more where it left two hulls; from where it began where
    /// that is not the records' beginning and tells enough.
    ///
    /// # Errors
    /// [`Unproved::NotFound`] where a stage takes too many steps, however much room there is around what is left.
    pub(super) fn prove(
        wide: &Setup,
        settings: &BoundedModel,
        explored: &Explored,
        witness: Option<Witness>,
    ) -> Result<Result<Self, Unproved>, IdentifyError> {
        let (mut certificate, passes) = (Self::of(wide, witness), explored.bounds.passes);
        let Explored { hulls, left, .. } = explored;
        // What all readings leave is more than nothing, or those from there on leave nothing.
        let later = explored.later.as_ref().filter(|_| left.is_some() || hulls.len() == 1);
        let hulls = if later.is_some() { core::slice::from_ref(left) } else { hulls };
        for (index, hull) in hulls.iter().enumerate() {
            let left = certificate.stages.last().and_then(|stage| check::sides(stage.left.as_ref()?));
            let narrowed = left.map(|left| wide.narrowed(settings, &left)).transpose()?;
            let setup = narrowed.as_ref().or(later).unwrap_or(wide);
            let goal = match hull {
                Some(_) if index + 1 < hulls.len() => Goal::Narrow,
                Some(hull) => Goal::Within(hull),
                None => Goal::Nothing,
            };
            match certificate.stage(setup, setup.ended(settings, PROVED).as_ref(), &goal, passes) {
                Ok(stage) => certificate.stages.push(stage),
                Err(error) => return Ok(Err(error)),
            }
            if certificate.stages.last().is_some_and(|stage| stage.left.is_none()) {
                break;
            }
        }
        certificate.statement = certificate.words();
        Ok(Ok(certificate))
    }

    /// One without stages.
    fn of(wide: &Setup, witness: Option<Witness>) -> Self {
        let sensed = wide.records.iter().map(|readings| Sensed {
            time_s: readings.time_s.clone(),
            reading: readings.value.clone(),
            error: readings.error,
            jitter_s: readings.jitter_s,
            levels: readings.command.levels().to_vec(),
            switched_s: readings.command.spans().iter().map(|(first, last)| [*first, *last]).collect(),
        });
        Self {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            statement: String::new(),
            terms: wide.layout.terms().to_vec(),
            middle_speed: wide.middle_speed,
            least_linear: wide.least_linear,
            fastest: wide.fastest,
            records: sensed.collect(),
            stages: Vec::new(),
            witness,
        }
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
