//! A value with its error.

use super::distribution::NORMAL_95;

/// A value with its standard deviation and interval, if any.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(into = "EstimateFields", try_from = "EstimateFields")]
pub struct Estimate {
    /// The value, in the units of the experiments.
    pub value: f64,
    /// Its statistical error, of the record's scatter; `None` for a value that was given, or that ended on its bound zero.
    pub spread: Option<ConfidenceInterval>,
    /// The practical interval, at coverage factor 2 (JCGM 100:2008, 6.2): the statistical error with the sources declared in the
    /// [budget](super::BudgetEntry). `None` where there is no statistical error, and outside of [`Reported`](super::Reported).
    pub combined: Option<ConfidenceInterval>,
}

/// An estimate as it is written: `{"value", "std", "low", "high", "combined"}`; the three before the last are null together.
#[derive(serde::Serialize, serde::Deserialize)]
struct EstimateFields {
    value: f64,
    std: Option<f64>,
    low: Option<f64>,
    high: Option<f64>,
    #[serde(default)]
    combined: Option<ConfidenceInterval>,
}

impl From<Estimate> for EstimateFields {
    fn from(Estimate { value, spread, combined }: Estimate) -> Self {
        let field = |of: fn(ConfidenceInterval) -> f64| spread.map(of);
        Self { value, std: field(|s| s.std), low: field(|s| s.low), high: field(|s| s.high), combined }
    }
}

impl TryFrom<EstimateFields> for Estimate {
    type Error = &'static str;

    fn try_from(fields: EstimateFields) -> Result<Self, Self::Error> {
        let EstimateFields { value, std, low, high, combined } = fields;
        match (std, low, high) {
            (Some(std), Some(low), Some(high)) => {
                Ok(Self { value, spread: Some(ConfidenceInterval { std, low, high }), combined })
            }
            (None, None, None) => Ok(Self { value, spread: None, combined }),
            _ => Err("std, low and high of an estimate must be numbers or null together"),
        }
    }
}

/// Error of an estimate.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ConfidenceInterval {
    /// Standard deviation.
    pub std: f64,
    /// Lower end of the 95 % interval (Student's t), not below zero.
    pub low: f64,
    /// Upper end of the 95 % interval.
    pub high: f64,
}

/// The constant force during each record. In JSON a single record's is repeated as `delta`, null for several.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(into = "DisturbanceFields", from = "DisturbanceFields")]
pub struct Disturbances(Vec<Estimate>);

#[derive(serde::Serialize, serde::Deserialize)]
struct DisturbanceFields {
    #[serde(skip_deserializing)]
    delta: Option<Estimate>,
    deltas: Vec<Estimate>,
}

impl Disturbances {
    /// That of the only record.
    #[must_use]
    pub fn single(&self) -> Option<Estimate> {
        if let [only] = self.0[..] { Some(only) } else { None }
    }
}

impl From<Disturbances> for DisturbanceFields {
    fn from(all: Disturbances) -> Self {
        Self { delta: all.single(), deltas: all.0 }
    }
}

impl From<DisturbanceFields> for Disturbances {
    fn from(fields: DisturbanceFields) -> Self {
        Self(fields.deltas)
    }
}

impl FromIterator<Estimate> for Disturbances {
    fn from_iter<I: IntoIterator<Item = Estimate>>(estimates: I) -> Self {
        Self(estimates.into_iter().collect())
    }
}

impl core::ops::Deref for Disturbances {
    type Target = [Estimate];

    fn deref(&self) -> &[Estimate] {
        &self.0
    }
}

impl core::ops::DerefMut for Disturbances {
    fn deref_mut(&mut self) -> &mut [Estimate] {
        &mut self.0
    }
}

impl ConfidenceInterval {
    /// The 95 % interval of a normal error about a value.
    pub(crate) fn normal(value: f64, std: f64) -> Self {
        Self { std, low: value - NORMAL_95 * std, high: value + NORMAL_95 * std }
    }

    /// Half its width in normal standard deviations: right for an interval that is not normal, too.
    pub(crate) fn deviation(self) -> f64 {
        0.5 * (self.high - self.low) / NORMAL_95
    }
}

impl Estimate {
    /// With its statistical error alone.
    pub(crate) fn new(value: f64, spread: Option<ConfidenceInterval>) -> Self {
        Self { value, spread, combined: None }
    }

    /// With the practical interval that `declared`, half the width of the declared sources' own interval, makes: on either side
    /// `H^2 = (2 h)^2 + declared^2` with the statistical half-width h.
    ///
    /// The factor 2 on h allows for a structure that passes for another. It is tuned; `spec/trust.md` has its misses on fresh records.
    pub(super) fn with_declared(self, declared: f64) -> Self {
        let combined = self.spread.map(|spread| {
            let side = |h: f64| libm::hypot(2.0 * h.max(0.0), declared);
            let (below, above) = (side(self.value - spread.low), side(spread.high - self.value));
            ConfidenceInterval { std: 0.25 * (below + above), low: self.value - below, high: self.value + above }
        });
        Self { combined, ..self }
    }

    /// The same, of a number that is not negative.
    pub(super) fn not_below_zero(mut self) -> Self {
        if let Some(combined) = &mut self.combined {
            combined.low = combined.low.max(0.0);
        }
        self
    }

    /// With a relative error that all records share.
    pub(crate) fn with_error(mut self, relative: f64) -> Self {
        if let Some(spread) = &mut self.spread {
            let more = self.value.abs() * relative;
            let wider = NORMAL_95 * (libm::hypot(spread.deviation(), more) - spread.deviation());
            let std = libm::hypot(spread.std, more);
            *spread = ConfidenceInterval { std, low: spread.low - wider, high: spread.high + wider };
        }
        self
    }

    /// With an interval that contains the rest, too.
    pub(crate) fn holding(mut self, others: &[Self]) -> Self {
        if let Some(spread) = &mut self.spread {
            for other in others.iter().filter_map(|other| other.spread) {
                (spread.low, spread.high) = (spread.low.min(other.low), spread.high.max(other.high));
            }
            spread.std = spread.std.max(spread.deviation());
        }
        self
    }

    /// In another unit.
    pub(crate) fn in_units(mut self, factor: f64) -> Self {
        self.value *= factor;
        if let Some(spread) = &mut self.spread {
            for number in [&mut spread.std, &mut spread.low, &mut spread.high] {
                *number *= factor;
            }
        }
        self
    }
}
