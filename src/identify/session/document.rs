//! The result of an identification: the JSON document of `selfosc identify --json`.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

pub use super::guaranteed::BoundedConclusion;
pub use super::identification::MethodRefusal;
use super::identification::{Caution, Identification, Source, Validation};
use super::model::Model;
use super::refusal::Refusal;
use crate::features::{CycleStatistics, RecordFeatures};
use crate::identify::answer::{DragVerdict, Estimate, LawEvidence, Reported};
use crate::identify::fit::prediction_error::Prediction;

/// The document: all results except the samples. SI units, angles in radians, full precision; null if missing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Conclusion {
    /// All records together.
    pub record: Total,
    /// Features of the only record; null for several.
    pub features: Option<FeatureMeans>,
    /// The answer to use; null where the fit was not asked for or refused.
    pub reported: Option<ReportedModel>,
    /// Models of every method under every law.
    pub estimates: Vec<Model>,
    /// The guaranteed bounds; null where they were not asked for.
    pub bounded: Option<BoundedConclusion>,
    /// Methods that gave nothing, with their reasons.
    pub refused_methods: Vec<MethodRefusal>,
    /// The drag law.
    pub choice: DragChoice,
    /// Cautions.
    pub warnings: Vec<Caution>,
    /// Every record, in the order given.
    pub records: Vec<RecordConclusion>,
    /// Records that were predicted and took no part in the estimate.
    pub validation: Vec<Validation>,
    /// Units of the numbers.
    pub units: UnitNames,
    /// Version of this library.
    pub version: Cow<'static, str>,
}

/// The answer to use. Numbers are absent where the drag law or the terms have them not.
pub type ReportedModel = Reported<Option<Estimate>, Caution>;

impl From<&Reported> for ReportedModel {
    fn from(reported: &Reported) -> Self {
        let Reported { drag, alpha, beta_cubic, skew, coulomb, memory, memory_s, stiffness, .. } = *reported;
        let Reported { lag_s, ramp_s, pause_s, filter_s, delay_s, drag_covariance, trust, .. } = *reported;
        Self {
            drag,
            laws: LawEvidence::default(),
            terms: reported.terms.clone(),
            alpha,
            beta: drag.has_linear().then_some(reported.beta),
            beta_quadratic: drag.has_quadratic().then_some(reported.beta_quadratic),
            beta_cubic,
            drag_covariance,
            skew,
            coulomb,
            memory,
            memory_s,
            stiffness,
            lag_s,
            ramp_s,
            pause_s,
            filter_s,
            deltas: reported.deltas.clone(),
            budget: reported.budget.clone(),
            delay_s,
            trust,
            reasons: reported.reasons.iter().copied().map(Caution::from).collect(),
        }
    }
}

/// Units of the numbers: `command` and `output` are those of the log's columns, angles in radians, depths in m.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct UnitNames {
    /// Of the output column as read.
    pub output: Cow<'static, str>,
    /// Of alpha.
    pub alpha: Cow<'static, str>,
    /// Of linear drag.
    pub beta: Cow<'static, str>,
    /// Of quadratic drag.
    pub beta_quadratic: Cow<'static, str>,
    /// Of cubic drag.
    pub beta_cubic: Cow<'static, str>,
    /// Of stiffness.
    pub stiffness: Cow<'static, str>,
    /// Of a constant force.
    pub delta: Cow<'static, str>,
}

impl UnitNames {
    pub(crate) fn of(sources: &[Source]) -> Self {
        let output = match sources {
            _ if sources.iter().any(|source| source.log.is_heading()) => "rad",
            [_, ..] if sources.iter().all(|source| source.log.is_length()) => "m",
            _ => "output",
        };
        Self::with_output(output)
    }

    /// Where the output is in this unit.
    pub(crate) fn with_output(output: &'static str) -> Self {
        Self {
            output: output.into(),
            alpha: "command s^2/output".into(),
            beta: "command s/output".into(),
            beta_quadratic: "command s^2/output^2".into(),
            beta_cubic: "command s^3/output^3".into(),
            stiffness: "command/output".into(),
            delta: "command".into(),
        }
    }
}

/// All records together.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Total {
    /// Samples.
    pub samples: usize,
    /// Time logged, in s.
    pub duration_s: f64,
    /// Steady cycles; null where no record shows any.
    pub cycles_used: Option<u32>,
}

/// One record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordConclusion {
    /// Where it comes from.
    pub file: String,
    /// Samples.
    pub samples: usize,
    /// Rows omitted as unusable.
    #[serde(default)]
    pub skipped_rows: usize,
    /// Time from the first to the last, in s.
    pub duration_s: f64,
    /// Steady cycles; null where it shows no steady self-oscillation.
    pub cycles_used: Option<u32>,
    /// Its features; null likewise.
    pub features: Option<FeatureMeans>,
    /// Its prediction from the remaining records; null for a single record.
    pub predicted: Option<Prediction>,
}

/// Means over the steady cycles, the relay, and sample standard deviations over cycles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FeatureMeans {
    /// Means.
    #[serde(flatten)]
    pub mean: FeatureValues,
    /// Relay level C, in command units.
    pub relay: f64,
    /// Standard deviations of a single cycle's value.
    pub std: FeatureValues,
}

/// A number for each feature.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FeatureValues {
    /// Amplitude X_m, in output units.
    pub amplitude: f64,
    /// Bias x_0 against the reference, in output units.
    pub bias: f64,
    /// Period T, in s.
    pub period_s: f64,
    /// Level x_a* where the command really switched, in output units.
    pub switch_level: f64,
    /// Time per period with the positive command, in s.
    pub time_positive_s: f64,
    /// Time per period with the negative command, in s.
    pub time_negative_s: f64,
}

/// The drag law and its evidence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DragChoice {
    /// The law given, or the records' verdict; null where no law was given, or not all were fitted.
    pub drag: Option<DragVerdict>,
    /// How surely the laws not chosen are refuted; null where none is, or the law was given.
    pub confidence: Option<f64>,
    /// Log-likelihood of each law less that of the likeliest.
    pub log_likelihood: LawEvidence,
}

/// The document of a refusal: `{"refused": {"code", "text"}}`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RefusalDocument {
    /// Why.
    pub refused: Caution,
}

impl From<&Refusal> for RefusalDocument {
    fn from(refusal: &Refusal) -> Self {
        Self { refused: Caution { code: refusal.code().into(), text: refusal.to_string() } }
    }
}

impl Identification {
    /// The short document.
    #[must_use]
    pub fn conclusion(&self) -> Conclusion {
        let records: Vec<RecordConclusion> =
            self.sources.iter().zip(&self.left_out).map(RecordConclusion::of).collect();
        let used: Vec<u32> = records.iter().filter_map(|record| record.cycles_used).collect();
        Conclusion {
            record: Total {
                samples: records.iter().map(|record| record.samples).sum(),
                duration_s: records.iter().map(|record| record.duration_s).sum(),
                cycles_used: (!used.is_empty()).then(|| used.iter().sum()),
            },
            features: if let [only] = &records[..] { only.features } else { None },
            reported: self.reported.as_ref().map(ReportedModel::from),
            estimates: self.models.clone(),
            bounded: self.bounded.as_ref().map(BoundedConclusion::from),
            refused_methods: self.refused.clone(),
            choice: self.drag_choice(),
            warnings: self.cautions.clone(),
            records,
            validation: self.validation.clone(),
            units: UnitNames::of(&self.sources),
            version: env!("CARGO_PKG_VERSION").into(),
        }
    }

    fn drag_choice(&self) -> DragChoice {
        let laws = self.reported.as_ref().map_or_else(LawEvidence::default, |reported| reported.laws);
        match self.law_given {
            Some(law) => DragChoice { drag: Some(DragVerdict::Law(law)), confidence: None, log_likelihood: laws },
            None => DragChoice { drag: laws.verdict(), confidence: laws.confidence(), log_likelihood: laws },
        }
    }
}

impl RecordConclusion {
    fn of((source, predicted): (&Source, &Option<Prediction>)) -> Self {
        Self {
            predicted: *predicted,
            file: source.name.clone(),
            samples: source.log.record.samples(),
            skipped_rows: source.log.skipped,
            duration_s: source.log.record.duration_s(),
            cycles_used: source.features.as_ref().map(|found| found.features.cycles),
            features: source.features.as_ref().map(FeatureMeans::of),
        }
    }
}

impl FeatureMeans {
    fn of(found: &RecordFeatures) -> Self {
        let f = &found.features;
        let values = |of: fn(&CycleStatistics<f64>) -> f64| FeatureValues {
            amplitude: of(&f.amplitude),
            bias: of(&f.bias),
            period_s: of(&f.period_s),
            switch_level: of(&f.switch_level),
            time_positive_s: of(&f.time_positive_s),
            time_negative_s: of(&f.time_negative_s),
        };
        let (mean, std) = (values(|spread| spread.mean), values(|spread| spread.std));
        Self { mean, relay: found.relay.level, std }
    }
}
