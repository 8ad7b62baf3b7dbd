//! What an identification comes to, as the JSON document of `selfosc identify --json`.

use serde::{Deserialize, Serialize};

use super::identification::{Caution, Identification, Source};
use super::model::Model;
use super::refusal::Refusal;
use crate::features::{CycleStatistics, RecordFeatures};
use crate::identify::DragLaw;
use crate::identify::select::likelihood::Choice;

/// The document: everything found but the samples. SI units, angles in radians, full precision; what is missing is null.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Conclusion {
    /// All records together.
    pub record: Total,
    /// Features of the only record; null for several.
    pub features: Option<FeatureMeans>,
    /// What every method found under every law.
    pub estimates: Vec<Model>,
    /// The drag law.
    pub choice: DragChoice,
    /// What to beware of.
    pub warnings: Vec<Caution>,
    /// Every record, in the order given.
    pub records: Vec<RecordConclusion>,
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
    /// Time from the first to the last, in s.
    pub duration_s: f64,
    /// Steady cycles; null where it shows no steady self-oscillation.
    pub cycles_used: Option<u32>,
    /// Its features; null likewise.
    pub features: Option<FeatureMeans>,
}

/// Means over the steady cycles, the relay, and sample standard deviations over cycles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FeatureMeans {
    /// Means.
    #[serde(flatten)]
    pub mean: FeatureValues,
    /// Relay level C, in command units.
    pub relay: f64,
    /// Standard deviations of one cycle's value.
    pub std: FeatureValues,
}

/// One number for each feature.
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

/// The drag law and how sure it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DragChoice {
    /// The law given, or what the records say; null where no law was given or fitted.
    pub drag: Option<DragVerdict>,
    /// Probability of the likeliest law; null where the law was given or nothing was fitted.
    pub confidence: Option<f64>,
    /// Probability of every law; null likewise.
    pub probabilities: Option<Probabilities>,
}

/// What records say of the drag law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DragVerdict {
    /// No law is certain enough.
    Undecided,
    /// This law.
    #[serde(untagged)]
    Law(DragLaw),
}

/// Probability of every law among those fitted; zero for one that could not be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Probabilities {
    /// Linear drag.
    pub linear: f64,
    /// Quadratic drag.
    pub quadratic: f64,
    /// Their sum.
    pub mixed: f64,
}

/// The document of a refusal: `{"refused": {"code", "text"}}`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Refused {
    /// Why.
    pub refused: Caution,
}

impl From<&Refusal> for Refused {
    fn from(refusal: &Refusal) -> Self {
        Self { refused: Caution { code: refusal.code().into(), text: refusal.to_string() } }
    }
}

impl Identification {
    /// The short document.
    #[must_use]
    pub fn conclusion(&self) -> Conclusion {
        let records: Vec<RecordConclusion> = self.sources.iter().map(RecordConclusion::of).collect();
        let used: Vec<u32> = records.iter().filter_map(|record| record.cycles_used).collect();
        Conclusion {
            record: Total {
                samples: records.iter().map(|record| record.samples).sum(),
                duration_s: records.iter().map(|record| record.duration_s).sum(),
                cycles_used: (!used.is_empty()).then(|| used.iter().sum()),
            },
            features: if let [only] = &records[..] { only.features } else { None },
            estimates: self.models.clone(),
            choice: self.drag_choice(),
            warnings: self.cautions.clone(),
            records,
        }
    }

    fn drag_choice(&self) -> DragChoice {
        match (self.choice(), &self.fits) {
            (Some((law, confidence)), Some(fits)) => DragChoice {
                drag: Some(law.map_or(DragVerdict::Undecided, DragVerdict::Law)),
                confidence: Some(confidence),
                probabilities: Some(Probabilities::of(fits)),
            },
            _ => DragChoice { drag: self.law_given.map(DragVerdict::Law), confidence: None, probabilities: None },
        }
    }
}

impl RecordConclusion {
    fn of(source: &Source) -> Self {
        Self {
            file: source.name.clone(),
            samples: source.log.record.samples(),
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

impl Probabilities {
    fn of(fits: &Choice) -> Self {
        let [linear, quadratic, mixed] = DragLaw::ALL.map(|law| fits.probability(law));
        Self { linear, quadratic, mixed }
    }
}
