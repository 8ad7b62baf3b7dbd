//! Warnings to read before trusting a result.

use core::fmt;

use super::AxisParameter;
use crate::features::{CycleStatistics, RecordFeatures};

/// Something that would mislead. Ratios are plain numbers; a ratio to an estimate of zero is infinite, and written as text in JSON.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(tag = "code", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Warning {
    /// The command goes from level to level at a limited rate, and the orders behind it were derived.
    OrdersDerived {
        /// Time that it takes, in s.
        ramp_s: f64,
    },
    /// The oscillation barely passes the switching level: inertia follows from a small difference.
    IllConditioned {
        /// Switching level with magnitude of the bias, over amplitude.
        #[serde(with = "super::any_float")]
        ratio: f64,
    },
    /// The paper's method and the answer disagree by more than their errors.
    MethodsDisagree {
        /// The parameter.
        parameter: AxisParameter,
        /// Value by the paper's method over the reported value.
        #[serde(with = "super::any_float")]
        ratio: f64,
    },
    /// The record is long: terms were looked for in its beginning, and the whole record fitted the likeliest models of it.
    SearchedInPart {
        /// Samples of the beginning.
        searched: usize,
        /// Samples of the record.
        samples: usize,
    },
    /// An oscillation locked to the sampling: each cycle repeats the last reading for reading.
    Locked {
        /// Cycles.
        cycles: u32,
        /// Their period, in s.
        period_s: f64,
    },
}

/// Relative spread that is rounding of sums: readings in steps differ by more.
const SAME: f64 = 1e-9;

/// Switching level over amplitude from which inertia is ill-conditioned.
const NEAR_AMPLITUDE: f64 = 0.9;
impl Warning {
    /// Short name for scripts.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::OrdersDerived { .. } => "orders-derived",
            Self::IllConditioned { .. } => "ill-conditioned",
            Self::MethodsDisagree { .. } => "methods-disagree",
            Self::SearchedInPart { .. } => "searched-in-part",
            Self::Locked { .. } => "locked",
        }
    }

    /// Warnings that features give.
    #[must_use]
    pub fn of_features(RecordFeatures { features, ramp_s, .. }: &RecordFeatures) -> Vec<Self> {
        let ratio = (features.switch_level.mean + features.bias.mean.abs()) / features.amplitude.mean;
        let derived = (*ramp_s > 0.0).then_some(Self::OrdersDerived { ramp_s: *ramp_s });
        let same = |of: CycleStatistics<f64>| of.std <= SAME * of.mean;
        let locked = features.cycles > 1 && same(features.period_s) && same(features.amplitude);
        let locked = locked.then_some(Self::Locked { cycles: features.cycles, period_s: features.period_s.mean });
        let near = (ratio > NEAR_AMPLITUDE).then_some(Self::IllConditioned { ratio });
        derived.into_iter().chain(near).chain(locked).collect()
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::OrdersDerived { ramp_s } => write!(
                f,
                "the command takes {ramp_s:.2} s from level to level: orders are taken to be given where it begins to move, and \
                 the methods for mean cycles take it for a relay that is late by half of that"
            ),
            Self::IllConditioned { ratio } => write!(
                f,
                "switching level with bias is {ratio:.2} of the amplitude (above {NEAR_AMPLITUDE}): inertia follows from a \
                 small difference; `selfosc design` computes which relay determines it better"
            ),
            Self::MethodsDisagree { parameter, ratio } => write!(
                f,
                "the paper's method gives {ratio:.2} times the {} reported: it takes the oscillation for a sinusoid, and knows no \
                 other term than drag and constant force",
                parameter.name()
            ),
            Self::SearchedInPart { searched, samples } => write!(
                f,
                "terms were looked for in the first {searched} of {samples} samples; a part of the record alone (--from, --to) tells \
                 whether others are at work there"
            ),
            Self::Locked { cycles, period_s } => write!(
                f,
                "all {cycles} steady cycles are one, reading for reading, with a period of {period_s:.4} s: further cycles bring no \
                 new reading; give a record at another relay level beside it"
            ),
        }
    }
}
