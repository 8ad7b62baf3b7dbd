//! The finding of a check, and the word for it.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::{ClaimDomain, ClaimPart, Witness};

/// The answer to "does this hold?".
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// It holds, as far as the evidence goes.
    Holds(Evidence),
    /// It does not, and here is the case.
    Refuted(Witness),
    /// The paper has it as approximate; as an equation it does not, and here is a case.
    Approximate(Witness),
    /// The budget ran out first, or a proof did not succeed.
    Undecided {
        /// What was tried.
        spent: String,
    },
}

/// Why a statement is believed. A number that means nothing for the way it was checked is `None`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Evidence {
    /// Enclosed: true of every point of these parts.
    pub proved: ClaimDomain,
    /// Finite models of which every state was visited: true of each of them alone.
    pub exhausted: ClaimDomain,
    /// Random cases that satisfy the hypotheses, or states visited.
    pub cases: Option<usize>,
    /// Boxes that the proved parts were divided into.
    pub boxes: Option<usize>,
    /// An identity's sides differ by no more than this on the proved parts.
    pub residual_bound: Option<f64>,
    /// Smallest margin: of an inequality over the proved parts, else of the random cases, where 1 is exact and 0 the limit.
    pub margin: Option<f64>,
}

impl Evidence {
    /// Cases drawn. They cover no part of a domain, however many they are.
    pub(crate) fn sampled(cases: usize, margin: f64) -> Self {
        Self { cases: Some(cases), margin: Some(margin), ..Self::default() }
    }
    /// An identity, enclosed.
    pub(crate) fn identity(part: ClaimPart, residual_bound: f64, boxes: usize) -> Self {
        Self { proved: part.into(), boxes: Some(boxes), residual_bound: Some(residual_bound), ..Self::default() }
    }
    /// An inequality, enclosed.
    pub(crate) fn inequality(proved: ClaimDomain, margin: f64, boxes: usize) -> Self {
        Self { proved, boxes: Some(boxes), margin: Some(margin), ..Self::default() }
    }
    /// Every state of a finite model.
    pub(crate) fn exhausted(part: ClaimPart, states: usize) -> Self {
        Self { exhausted: part.into(), cases: Some(states), ..Self::default() }
    }

    /// That of two statements together: each part keeps its own evidence.
    fn with(self, other: Self) -> Self {
        fn both<T>(a: Option<T>, b: Option<T>, join: fn(T, T) -> T) -> Option<T> {
            match (a, b) {
                (Some(a), Some(b)) => Some(join(a, b)),
                (one, other) => one.or(other),
            }
        }
        Self {
            proved: self.proved.union(other.proved),
            exhausted: self.exhausted.union(other.exhausted),
            cases: both(self.cases, other.cases, |a, b| a + b),
            boxes: both(self.boxes, other.boxes, |a, b| a + b),
            residual_bound: both(self.residual_bound, other.residual_bound, f64::max),
            margin: both(self.margin, other.margin, f64::min),
        }
    }
}

/// A word for a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Word {
    /// Enclosed on the whole domain as stated.
    Proved,
    /// Enclosed on a part of it.
    ProvedInPart,
    /// Every state of a finite model was visited, and these models are the whole domain as stated.
    Exhausted,
    /// True of every random case.
    Sampled,
    /// False, with a witness.
    Refuted,
    /// An approximation under a hypothesis that the source states; as an equation it is false, with a witness.
    Approximate,
    /// Neither.
    Undecided,
    /// There is no such statement.
    NotApplicable,
}

impl Word {
    /// Every word.
    pub const ALL: [Self; 8] = [
        Self::Proved,
        Self::ProvedInPart,
        Self::Exhausted,
        Self::Sampled,
        Self::Refuted,
        Self::Approximate,
        Self::Undecided,
        Self::NotApplicable,
    ];

    /// As the command prints it.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::ProvedInPart => "proved-in-part",
            Self::Exhausted => "exhausted",
            Self::Sampled => "sampled",
            Self::Refuted => "refuted",
            Self::Approximate => "approximate",
            Self::Undecided => "undecided",
            Self::NotApplicable => "not-applicable",
        }
    }
}

impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}

impl Verdict {
    pub(crate) fn undecided(spent: &str) -> Self {
        Self::Undecided { spent: spent.to_owned() }
    }

    /// The word, by comparison of the domain that is claimed with the parts that are established.
    #[must_use]
    pub fn word(&self, claimed: &ClaimDomain) -> Word {
        let evidence = match self {
            Self::Holds(evidence) => evidence,
            Self::Refuted(_) => return Word::Refuted,
            Self::Approximate(_) => return Word::Approximate,
            Self::Undecided { .. } => return Word::Undecided,
        };
        let all = claimed.parts.len();
        let within = |domain: &ClaimDomain| all > 0 && claimed.covered_by(domain).len() == all;
        if within(&evidence.proved) {
            Word::Proved
        } else if within(&evidence.proved.clone().union(evidence.exhausted.clone())) {
            Word::Exhausted
        } else if evidence.proved.parts.is_empty() && evidence.exhausted.parts.is_empty() {
            Word::Sampled
        } else {
            Word::ProvedInPart
        }
    }

    /// Whether it holds, as far as the evidence goes.
    #[must_use]
    pub fn holds(&self) -> bool {
        matches!(self, Self::Holds(_))
    }

    /// Whether it is refuted.
    #[must_use]
    pub fn is_refuted(&self) -> bool {
        matches!(self, Self::Refuted(_))
    }

    /// Of an approximation: the case that refutes the equation shows its error.
    pub(crate) fn approximated(self) -> Self {
        match self {
            Self::Refuted(witness) => Self::Approximate(witness),
            other => other,
        }
    }

    /// Sampled and proved: refuted by either, undecided unless both hold. The margin is then the proof's, if any.
    pub(crate) fn backed_by(self, proof: impl FnOnce() -> Self) -> Self {
        match (self, proof) {
            (Self::Holds(sampled), proof) => match proof() {
                Self::Holds(proved) => {
                    let margin = proved.margin.or(sampled.margin);
                    Self::Holds(Evidence { margin, ..sampled.with(proved) })
                }
                failed => failed,
            },
            (failed, _) => failed,
        }
    }

    /// All of them: the first that fails, else the evidence of all.
    pub(crate) fn all(verdicts: impl IntoIterator<Item = Self>) -> Self {
        verdicts.into_iter().reduce(|all, next| all.and(|| next)).unwrap_or_else(|| Self::undecided("nothing"))
    }

    /// The text of each established part is that of the claim's part of its name.
    pub(crate) fn worded(mut self, claimed: &ClaimDomain) -> Self {
        if let Self::Holds(evidence) = &mut self {
            for part in evidence.proved.parts.to_mut().iter_mut().chain(evidence.exhausted.parts.to_mut()) {
                if let Some(whole) = claimed.parts.iter().find(|whole| whole.name == part.name) {
                    part.text.clone_from(&whole.text);
                }
            }
        }
        self
    }

    /// Both: the first that fails, else the evidence of both.
    pub(crate) fn and(self, other: impl FnOnce() -> Self) -> Self {
        match self {
            Self::Holds(mine) => match other() {
                Self::Holds(theirs) => Self::Holds(mine.with(theirs)),
                failed => failed,
            },
            failed => failed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{ClaimDomain, ClaimPart, Evidence, Verdict, Witness, Word};

    #[test]
    fn a_failed_proof_is_not_made_up_for_by_cases() {
        let (sampled, part) = (|| Verdict::Holds(Evidence::sampled(10, 0.5)), ClaimPart::whole("whole", ""));
        let (failed, refuted) = (|| Verdict::undecided("ten boxes"), || Verdict::Refuted(Witness::default()));
        let proved = || Verdict::Holds(Evidence::identity(ClaimPart::whole("whole", ""), 0.0, 1));
        let claimed = ClaimDomain::from(part);
        assert_eq!(sampled().word(&claimed), Word::Sampled);
        assert_eq!(sampled().backed_by(proved).word(&claimed), Word::Proved);
        assert_eq!(sampled().backed_by(failed).word(&claimed), Word::Undecided);
        assert_eq!(sampled().backed_by(refuted).word(&claimed), Word::Refuted);
        assert_eq!(refuted().backed_by(proved).word(&claimed), Word::Refuted);
        assert_eq!(proved().and(failed).word(&claimed), Word::Undecided);
        assert_eq!(failed().and(proved).word(&claimed), Word::Undecided);
    }
}
