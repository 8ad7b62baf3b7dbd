//! Evidence of records on the drag law: linear and quadratic drag alone against their sum, by the likelihood ratio.
//!
//! Mixed drag contains both simple laws: no record refutes it in their favour, and a small difference is no evidence
//! for a simple law: only a refuted law is excluded.

use serde::{Deserialize, Serialize};

use super::DragLaw;
use super::distribution::chi_square_tail;

/// Log-likelihood of the records under each drag law, all further terms alike, less that of the likeliest: zero or negative.
///
/// `None` for a law that was not fitted (another was given) or could not be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LawEvidence {
    /// Linear drag alone.
    pub linear: Option<f64>,
    /// Quadratic drag alone.
    pub quadratic: Option<f64>,
    /// Their sum.
    pub mixed: Option<f64>,
    /// Number of records, each with parameters of its own: by as many fewer has a simple law.
    pub records: usize,
}

/// The verdict of records on the drag law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DragVerdict {
    /// Either simple law and their sum do for these records.
    NotDistinguishable,
    /// This law does; a simple law outside it does not. Mixed: neither simple law does.
    #[serde(untagged)]
    Law(DragLaw),
}

/// Significance level: a law is refuted at a probability below this.
const REFUTED: f64 = 0.01;

impl LawEvidence {
    /// Whether it is of no record.
    pub(crate) fn is_empty(&self) -> bool {
        self.records == 0
    }

    /// The difference of a law.
    #[must_use]
    pub fn of(&self, law: DragLaw) -> Option<f64> {
        match law {
            DragLaw::Linear => self.linear,
            DragLaw::Quadratic => self.quadratic,
            DragLaw::Mixed => self.mixed,
        }
    }

    /// Probability, under a simple law, of a likelihood ratio at least as large in favour of mixed drag (Wilks 1938);
    /// `None` for a law without a fit.
    #[must_use]
    pub fn by_chance(&self, law: DragLaw) -> Option<f64> {
        let gained = 2.0 * (self.mixed? - self.of(law)?);
        Some(if gained > 0.0 { chi_square_tail(gained, self.records.max(1)) } else { 1.0 })
    }

    /// The verdict; `None` where a law has no fit, because it was not asked for or failed.
    #[must_use]
    pub fn verdict(&self) -> Option<DragVerdict> {
        let [linear, quadratic] = [DragLaw::Linear, DragLaw::Quadratic].map(|law| self.by_chance(law));
        Some(match (linear? < REFUTED, quadratic? < REFUTED) {
            (false, false) => DragVerdict::NotDistinguishable,
            (false, true) => DragVerdict::Law(DragLaw::Linear),
            (true, false) => DragVerdict::Law(DragLaw::Quadratic),
            (true, true) => DragVerdict::Law(DragLaw::Mixed),
        })
    }

    /// 1 less the largest [probability by chance](Self::by_chance) among the laws that the verdict excludes: how surely
    /// they are refuted, not how probable the verdict is. `None` where nothing is excluded.
    #[must_use]
    pub fn confidence(&self) -> Option<f64> {
        let excluded = match self.verdict()? {
            DragVerdict::NotDistinguishable => return None,
            DragVerdict::Law(DragLaw::Linear) => vec![DragLaw::Quadratic],
            DragVerdict::Law(DragLaw::Quadratic) => vec![DragLaw::Linear],
            DragVerdict::Law(DragLaw::Mixed) => vec![DragLaw::Linear, DragLaw::Quadratic],
        };
        excluded.into_iter().filter_map(|law| self.by_chance(law)).reduce(f64::max).map(|chance| 1.0 - chance)
    }

    /// From log-likelihoods of linear, quadratic and mixed drag on a record.
    pub(crate) fn from_log_likelihoods([linear, quadratic, mixed]: [Option<f64>; 3]) -> Self {
        // The sum contains the simple laws: a search that ended below them ended too early.
        let mixed = mixed.map(|mixed| [linear, quadratic].into_iter().flatten().fold(mixed, f64::max));
        let best = [linear, quadratic, mixed].into_iter().flatten().fold(f64::NEG_INFINITY, f64::max);
        let [linear, quadratic, mixed] = [linear, quadratic, mixed].map(|law| law.map(|value| value - best));
        Self { linear, quadratic, mixed, records: 1 }
    }

    /// Of several records, each with its own parameters.
    pub(crate) fn sum(parts: impl Iterator<Item = Self>) -> Self {
        let whole = parts.reduce(|a, b| {
            let add = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a + b);
            Self {
                linear: add(a.linear, b.linear),
                quadratic: add(a.quadratic, b.quadratic),
                mixed: add(a.mixed, b.mixed),
                records: a.records + b.records,
            }
        });
        let Some(Self { linear, quadratic, mixed, records }) = whole else { return Self::default() };
        let best = [linear, quadratic, mixed].into_iter().flatten().fold(f64::NEG_INFINITY, f64::max);
        let [linear, quadratic, mixed] = [linear, quadratic, mixed].map(|law| law.map(|value| value - best));
        Self { linear, quadratic, mixed, records }
    }
}
