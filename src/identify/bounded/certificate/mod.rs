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
mod statement;
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
use crate::experiment::{Columns, Record};
use crate::identify::IdentifyError;
use crate::numeric::Interval;

pub use check::{Shown, Unproved};
use prove::Goal;

/// Changes with the meaning of a field.
const FORMAT: u32 = 3;
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
    /// In words, by the others.
    pub(super) statement: String,
    /// The equation, and what is granted to a reading and a stamp.
    pub(super) model: BoundedModel,
    /// How the readings were taken from the logs; null where they are from none.
    pub(super) read_as: Option<ReadAs>,
    /// The rows of the logs.
    pub(super) records: Vec<Rows>,
    /// What these and the model come to.
    pub(super) searched: Searched,
    /// One after the other; each begins where the one before ended.
    pub(super) stages: Vec<Stage>,
    /// One parameter.
    pub(super) witness: Option<Witness>,
}

/// How a log's columns become readings and commands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReadAs {
    /// Columns and their units.
    pub columns: Columns,
    /// The level to which the command is scaled, if it is.
    pub relay_level: Option<f64>,
}

/// Where parameters are looked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Searched {
    /// Of the equation, in the order in which they stand in a box.
    pub(super) terms: Vec<Term>,
    /// The linear term's coefficient is that of the drag plus twice this times the quadratic one's, in output units per s.
    pub(super) middle_speed: f64,
    /// No linear drag below this, over alpha, in 1/s.
    pub(super) least_linear: f64,
    /// No speed above this.
    pub(super) fastest: f64,
    /// Terms, the delay where it is unknown, then each record's disturbance and instants.
    pub(super) from: Vec<[f64; 2]>,
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

/// The rows of a log: stamps, readings, and the command that each row has.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Rows {
    pub(super) time_s: Vec<f64>,
    pub(super) reading: Vec<f64>,
    pub(super) command: Vec<f64>,
    /// Step of the sensor: the model's, else the one that the readings show; zero for none.
    pub(super) quantum: f64,
}

/// What is left of the box at hand: of the first stage that is searched, of any other what the one before left.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Stage {
    /// Record, first and last sample of each window.
    pub(super) windows: Vec<[usize; 3]>,
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
        records: &[&Record],
        wide: &Setup,
        settings: &BoundedModel,
        explored: &Explored,
        witness: Option<Witness>,
    ) -> Result<Result<Self, Unproved>, IdentifyError> {
        let (mut certificate, passes) = (Self::of(records, wide, settings, witness), explored.bounds.passes);
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
            match certificate.stage(wide, setup, setup.ended(settings, PROVED).as_ref(), &goal, passes) {
                Ok(stage) => certificate.stages.push(stage),
                Err(error) => return Ok(Err(error)),
            }
            if certificate.stages.last().is_some_and(|stage| stage.left.is_none()) {
                break;
            }
        }
        certificate.statement = certificate.words(records);
        Ok(Ok(certificate))
    }

    /// One without stages.
    fn of(records: &[&Record], wide: &Setup, settings: &BoundedModel, witness: Option<Witness>) -> Self {
        let rows = records.iter().map(|record| Rows {
            time_s: record.time_s().to_vec(),
            reading: record.output().to_vec(),
            command: record.input().to_vec(),
            quantum: settings.step(record),
        });
        Self {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            statement: String::new(),
            model: settings.clone(),
            read_as: None,
            records: rows.collect(),
            searched: Searched::of(wide),
            stages: Vec::new(),
            witness,
        }
    }

    /// The same of logs that were read so.
    pub(crate) fn read_as(self, read_as: ReadAs) -> Self {
        Self { read_as: Some(read_as), ..self }
    }

    /// From the text of a file.
    ///
    /// # Errors
    /// [`Unproved::Format`] for another program's, [`Unproved::Foreign`] for what is no certificate.
    pub fn read(text: &str) -> Result<Self, Unproved> {
        /// What every format has.
        #[derive(Deserialize)]
        struct Head {
            format: u32,
        }
        match serde_json::from_str(text) {
            Ok(Head { format }) if format != FORMAT => Err(Unproved::Format { found: format, expected: FORMAT }),
            // Its fields are told apart only where it is JSON.
            Err(error) if !error.is_data() => Err(Unproved::Foreign { text: error.to_string() }),
            _ => serde_json::from_str(text).map_err(|error| Unproved::Foreign { text: error.to_string() }),
        }
    }
}

impl Searched {
    fn of(setup: &Setup) -> Self {
        Self {
            terms: setup.layout.terms().to_vec(),
            middle_speed: setup.middle_speed,
            least_linear: setup.least_linear,
            fastest: setup.fastest,
            from: ends(&setup.search[..setup.layout.parameters()]),
        }
    }
}

/// Ranges as a file has them.
fn ends(at: &[Interval]) -> Vec<[f64; 2]> {
    at.iter().map(|side| [side.lower(), side.upper()]).collect()
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
