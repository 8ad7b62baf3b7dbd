//! The format of a certificate.

use serde::{Deserialize, Serialize};

use super::super::linear_relaxation::{Origin, half_line};
use super::super::problem::Problem;
use super::super::settings::BoundedModel;
use super::super::vector_field::FieldTerm;
use super::unproved::Unproved;
use crate::experiment::{Columns, Record};
use crate::numeric::Interval;

/// Changes with the meaning of a field, and with the bounds on which steps rest.
const FORMAT: u32 = 5;

/// The statement, its readings, and the steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// Of the file.
    pub(super) format: u32,
    /// Of the crate that wrote it.
    pub(super) version: String,
    /// In words, by the fields below.
    pub(super) statement: String,
    /// The equation, and the errors granted to a reading and a stamp.
    pub(super) model: BoundedModel,
    /// How the readings were taken from the logs; null where they are from none.
    pub(super) read_as: Option<ReadAs>,
    /// The rows of the logs.
    pub(super) records: Vec<LogRows>,
    /// The ranges that follow from these and the model.
    pub(super) searched: Searched,
    /// In order; each begins where its predecessor ended.
    pub(super) stages: Vec<ProofStage>,
    /// A parameter.
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
    pub(super) terms: Vec<FieldTerm>,
    /// The linear term's coefficient is that of the drag plus twice this times the quadratic one's, in output units per s.
    pub(super) middle_speed: f64,
    /// No linear drag below this, over alpha, in 1/s.
    pub(super) least_linear: f64,
    /// No speed above this.
    pub(super) fastest: f64,
    /// Terms, the delay where it is unknown, then each record's disturbance and instants.
    pub(super) from: Vec<[f64; 2]>,
}

/// A parameter that satisfies every reading from some sample on.
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
pub(super) struct LogRows {
    pub(super) time_s: Vec<f64>,
    pub(super) reading: Vec<f64>,
    pub(super) command: Vec<f64>,
    /// Step of the sensor: the model's, else the readings' own; zero for none.
    pub(super) quantum: f64,
}

/// The proof that a box has no feasible parameters but the remainder: the search box, or the remainder of the stage before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ProofStage {
    /// Record, first and last sample of each shooting interval.
    pub(super) shooting: Vec<[usize; 3]>,
    /// The remainder; null for nothing.
    pub(super) left: Option<Vec<[f64; 2]>>,
    pub(super) steps: Vec<Step>,
}

/// The source of inequalities, over a number of shooting intervals of each record, from its first on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum By {
    /// The weak form, and velocities from the readings.
    ModulatingFunctions(usize),
    /// The motion over shooting intervals, each linked to the next.
    Shooting(usize),
}

/// Inequalities with nonnegative multipliers.
pub(super) type Combination = Vec<(Origin, f64)>;

/// A new end of the range of an unknown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Cut {
    pub(super) unknown: usize,
    pub(super) upper: bool,
    pub(super) end: f64,
    /// Empty where the enclosure itself proves the end.
    pub(super) rows: Combination,
}

/// A step with the box at hand.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Step {
    /// It shrinks; to nothing where a range ends before it begins. A cut may use those before it.
    Contract { by: By, cuts: Vec<Cut> },
    /// It is empty; without rows where enclosures have no value in common.
    Exclude { by: By, rows: Combination },
    /// In two at a value of an unknown; the lower part is next, then the upper part.
    Divide { unknown: usize, at: f64 },
    /// It is within the rest.
    Keep,
}

impl Cut {
    /// Shortens the range; `false` where it becomes empty.
    pub(super) fn shorten(&self, at: &mut [Interval]) -> bool {
        let left = at[self.unknown].intersection(half_line(self.end, self.upper));
        left.inspect(|left| at[self.unknown] = *left).is_some()
    }
}

/// Ranges as the file has them.
pub(super) fn ends(at: &[Interval]) -> Vec<[f64; 2]> {
    at.iter().map(|side| [side.lower(), side.upper()]).collect()
}

/// Ranges of a file; `None` where one is none.
pub(super) fn sides(ends: &[[f64; 2]]) -> Option<Vec<Interval>> {
    ends.iter().map(|[low, high]| Interval::new(*low, *high).filter(|side| side.is_bounded())).collect()
}

impl Certificate {
    /// One without stages.
    pub(super) fn of(
        records: &[&Record],
        problem: &Problem,
        settings: &BoundedModel,
        witness: Option<Witness>,
    ) -> Self {
        let log = |record: &&Record| LogRows {
            time_s: record.time_s().to_vec(),
            reading: record.output().to_vec(),
            command: record.input().to_vec(),
            quantum: settings.step(record),
        };
        Self {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            statement: String::new(),
            model: settings.clone(),
            read_as: None,
            records: records.iter().map(log).collect(),
            searched: Searched::of(problem),
            stages: Vec::new(),
            witness,
        }
    }

    /// The same of logs that were read likewise.
    pub(crate) fn read_as(self, read_as: ReadAs) -> Self {
        Self { read_as: Some(read_as), ..self }
    }

    /// How the logs are to be read for it.
    #[must_use]
    pub fn reading(&self) -> Option<&ReadAs> {
        self.read_as.as_ref()
    }

    /// From the text of a file.
    ///
    /// # Errors
    /// [`Unproved::Format`] for the format of another version, [`Unproved::Foreign`] for a text that is no certificate.
    pub fn read(text: &str) -> Result<Self, Unproved> {
        /// Common to all formats.
        #[derive(Deserialize)]
        struct Head {
            format: u32,
        }
        let foreign = |error: serde_json::Error| Unproved::Foreign { text: error.to_string() };
        match serde_json::from_str(text) {
            Ok(Head { format }) if format != FORMAT => Err(Unproved::Format { found: format, expected: FORMAT }),
            // Fields are distinguished only where the text is JSON.
            Err(error) if !error.is_data() => Err(foreign(error)),
            _ => serde_json::from_str(text).map_err(foreign),
        }
    }
}

impl Searched {
    pub(super) fn of(problem: &Problem) -> Self {
        Self {
            terms: problem.unknowns.terms.clone(),
            middle_speed: problem.middle_speed,
            least_linear: problem.least_linear,
            fastest: problem.fastest,
            from: ends(&problem.search[..problem.unknowns.parameters()]),
        }
    }
}

impl Witness {
    pub(super) fn of(problem: &Problem, at: &[f64]) -> Self {
        let unknowns = &problem.unknowns;
        let first = (0..unknowns.records()).map(|record| unknowns.shooting[unknowns.first(record)].first);
        let values = unknowns.of_single_shooting().into_iter().map(|place| at[place]);
        Self { first: first.collect(), values: values.collect() }
    }
}

impl core::fmt::Display for Certificate {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&serde_json::to_string(self).map_err(|_| core::fmt::Error)?)
    }
}
