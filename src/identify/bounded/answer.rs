//! The answer: bounds, verdict, outliers.

use serde::{Deserialize, Serialize};

/// The answer to whether a record contradicts a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Consistency {
    /// A parameter of the model satisfies every reading: the witness.
    Consistent,
    /// None in the search box does.
    Refuted,
    /// The budget was spent before a decision.
    Undecided,
}

impl Consistency {
    /// Name in JSON and in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Consistent => "consistent",
            Self::Refuted => "refuted",
            Self::Undecided => "undecided",
        }
    }
}

/// A quantity of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Inertia with added mass.
    Alpha,
    /// Coefficient of drag proportional to speed.
    Beta,
    /// Of drag proportional to its square.
    BetaQuadratic,
    /// Of drag proportional to its cube.
    BetaCubic,
    /// Restoring force over the coordinate.
    Stiffness,
    /// Time constant of the force, in s.
    LagS,
    /// Delay of the loop, in s.
    DelayS,
    /// Disturbance during the record of this number.
    Delta(usize),
    /// Inertia, as its reciprocal: force to acceleration.
    Gain,
    /// A drag coefficient over alpha, as it was searched in: linear.
    LinearRate,
    /// The same, quadratic.
    QuadraticRate,
    /// The same, cubic.
    CubicRate,
    /// Stiffness over alpha.
    StiffnessRate,
    /// Reciprocal of the lag.
    LagRate,
    /// Disturbance over alpha.
    DeltaRate(usize),
    /// Position at the first sample that the model covers, by record.
    Position(usize),
    /// Velocity there.
    Velocity(usize),
    /// Largest speed that was looked for.
    Speed,
}

impl Quantity {
    /// The record whose own it is; `None` for a quantity common to all.
    #[must_use]
    pub fn record(self) -> Option<usize> {
        match self {
            Self::Delta(record) | Self::DeltaRate(record) | Self::Position(record) | Self::Velocity(record) => {
                Some(record)
            }
            _ => None,
        }
    }
}

impl core::fmt::Display for Quantity {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let name = match self {
            Self::Alpha => "alpha",
            Self::Beta => "beta",
            Self::BetaQuadratic => "beta_quadratic",
            Self::BetaCubic => "beta_cubic",
            Self::Stiffness => "stiffness",
            Self::LagS => "lag_s",
            Self::DelayS => "delay_s",
            Self::Delta(_) => "delta",
            Self::Gain => "1/alpha",
            Self::LinearRate => "beta/alpha",
            Self::QuadraticRate => "beta_quadratic/alpha",
            Self::CubicRate => "beta_cubic/alpha",
            Self::StiffnessRate => "stiffness/alpha",
            Self::LagRate => "1/lag_s",
            Self::DeltaRate(_) => "delta/alpha",
            Self::Position(_) => "position",
            Self::Velocity(_) => "velocity",
            Self::Speed => "speed",
        };
        f.write_str(name)
    }
}

/// A quantity with the enclosure of its values, in the units of the records.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuantityRange {
    /// Which.
    pub quantity: Quantity,
    /// Not less than this.
    pub low: f64,
    /// Not more than this.
    pub high: f64,
}

impl QuantityRange {
    pub(super) fn of((quantity, side): (Quantity, crate::numeric::Interval)) -> Self {
        Self { quantity, low: side.lower(), high: side.upper() }
    }

    /// The union of several sets' ranges of each quantity.
    pub(super) fn union(ranges: impl Iterator<Item = Self>) -> Vec<Self> {
        let mut all: Vec<Self> = Vec::new();
        for range in ranges {
            match all.iter_mut().find(|own| own.quantity == range.quantity) {
                Some(own) => (own.low, own.high) = (own.low.min(range.low), own.high.max(range.high)),
                None => all.push(range),
            }
        }
        all
    }
}

/// A parameter of the model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParameterValues {
    /// Its quantities; each record's state is at the first sample that the model covers.
    pub values: Vec<(Quantity, f64)>,
    /// The largest misfit of a reading, over its largest error.
    pub misfit: f64,
}

/// A reading that takes part in a contradiction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contradicting {
    /// Number of the record.
    pub record: usize,
    /// Number of the sample.
    pub sample: usize,
    /// Whether the model stays above the reading's bounds, rather than below.
    pub model_above: bool,
    /// Its share of the contradiction; their sum is 1.
    pub share: f64,
}

impl Contradicting {
    /// Readings in their order, with shares whose sum is 1.
    pub(super) fn normalised(mut readings: Vec<Self>) -> Vec<Self> {
        let sum: f64 = readings.iter().map(|part| part.share).sum();
        readings.iter_mut().for_each(|part| part.share /= sum);
        readings.sort_by_key(|part| (part.record, part.sample));
        readings
    }
}

/// A reading in error by more than is granted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Outlier {
    /// Number of the record.
    pub record: usize,
    /// Number of the sample.
    pub sample: usize,
}

/// The parameters of a model that no record excludes.
///
/// Guaranteed: a parameter within the search box that satisfies every constraint lies within `bounds`; where the
/// verdict is `refuted` there is none; where it is `consistent` the witness satisfies all. No guarantee covers
/// parameters outside the search box, or a sensor whose errors are larger than stated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// The answer.
    pub verdict: Consistency,
    /// Where parameters were looked for, in the coordinates of the search.
    pub search_box: Vec<QuantityRange>,
    /// What is left; empty where refuted.
    pub bounds: Vec<QuantityRange>,
    /// A parameter whose motion, enclosed in intervals, satisfies every reading.
    pub witness: Option<ParameterValues>,
    /// The parameter found with the least largest misfit: for less than `misfit` times the given error no parameter is shown.
    pub nearest: Option<ParameterValues>,
    /// Largest error of a reading that was taken, by record: half the sensor's step and the given error.
    pub error: Vec<f64>,
    /// The error is to be multiplied by at least the first, at most the second, for the model to be consistent.
    pub error_factor: [f64; 2],
    /// Contradictory readings, where refuted, in the part of the box that was hardest to refute; where no part shows
    /// any, readings between two switchings that no motion satisfies with any parameters.
    pub contradicting: Vec<Contradicting>,
    /// Readings missed by every parameter that misses no more than [`BoundedModel::outliers`](super::BoundedModel::outliers).
    /// Fewer than these may be found, and the bounds are wider then: any of the rest could be outliers.
    pub outliers: Vec<Outlier>,
    /// Passes over the records.
    pub passes: usize,
}

impl Bounds {
    /// The enclosure of a quantity.
    #[must_use]
    pub fn of(&self, quantity: Quantity) -> Option<[f64; 2]> {
        self.bounds.iter().find(|range| range.quantity == quantity).map(|range| [range.low, range.high])
    }
}
