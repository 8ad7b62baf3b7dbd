//! What a checker answers.

use std::fmt;

/// The answer to "does this hold?".
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// It holds, as far as the evidence goes.
    Holds(Evidence),
    /// It does not, and here is the case.
    Refuted(Witness),
    /// The budget ran out first.
    Undecided {
        /// What was tried.
        spent: String,
    },
}

/// Why a claim is believed.
#[derive(Clone, Debug, PartialEq)]
pub enum Evidence {
    /// Enclosed over the whole domain: true of every point of it.
    Proved {
        /// The domain, in words and numbers.
        domain: String,
        /// The bound that was proved, as small as the enclosure made it.
        bound: f64,
        /// Boxes the domain was divided into.
        boxes: usize,
    },
    /// Every case of a finite domain was tried: true of each of them, and said of nothing else.
    Exhausted {
        /// The domain, in words and numbers.
        domain: String,
        /// States reached, all of them.
        states: usize,
    },
    /// True of every case drawn. Says nothing of the cases not drawn.
    Sampled {
        /// Cases drawn that meet the hypotheses.
        cases: usize,
        /// Distance of the worst case from failing, as a fraction of what was allowed: 1 is exact, 0 is the limit.
        margin: f64,
    },
}

impl Evidence {
    /// What can be said of two statements together: sampling where either is sampled, else the union of the proofs.
    fn weaker(self, other: Self) -> Self {
        match (self, other) {
            (Self::Sampled { cases: a, margin: m }, Self::Sampled { cases: b, margin: n }) => {
                Self::Sampled { cases: a + b, margin: m.min(n) }
            }
            (Self::Proved { domain: a, bound: m, boxes: i }, Self::Proved { domain: b, bound: n, boxes: j }) => {
                let domain = if a == b { a } else { format!("{a}; {b}") };
                Self::Proved { domain, bound: m.max(n), boxes: i + j }
            }
            (Self::Exhausted { domain: a, states: i }, Self::Exhausted { domain: b, states: j }) => {
                let domain = if a == b { a } else { format!("{a}; {b}") };
                Self::Exhausted { domain, states: i + j }
            }
            (sampled @ Self::Sampled { .. }, _) | (_, sampled @ Self::Sampled { .. }) => sampled,
            (exhausted @ Self::Exhausted { .. }, _) | (_, exhausted) => exhausted,
        }
    }
}

/// A case that refutes, as numbers that a reader can put in again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Witness {
    /// Names and values, SI units unless the name says otherwise.
    pub numbers: Vec<(&'static str, f64)>,
}

impl Witness {
    /// From names and values.
    #[must_use]
    pub fn new(numbers: &[(&'static str, f64)]) -> Self {
        Self { numbers: numbers.to_vec() }
    }
}

impl fmt::Display for Witness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, (name, value)) in self.numbers.iter().enumerate() {
            let separator = if place == 0 { "" } else { ", " };
            write!(f, "{separator}{name} = {}", short(*value))?;
        }
        Ok(())
    }
}

/// Six digits, and no more of them than there are.
fn short(value: f64) -> String {
    let rounded = format!("{value:.6e}").parse::<f64>().unwrap_or(value);
    if rounded != 0.0 && !(1e-4..1e6).contains(&rounded.abs()) { format!("{rounded:e}") } else { rounded.to_string() }
}

impl Verdict {
    /// The budget ran out.
    pub(super) fn undecided(spent: &str) -> Self {
        Self::Undecided { spent: spent.to_owned() }
    }

    /// One word, as the command prints it.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Holds(Evidence::Proved { .. } | Evidence::Exhausted { .. }) => "proved",
            Self::Holds(Evidence::Sampled { .. }) => "sampled",
            Self::Refuted(_) => "refuted",
            Self::Undecided { .. } => "undecided",
        }
    }

    /// Whether it holds.
    #[must_use]
    pub fn holds(&self) -> bool {
        matches!(self, Self::Holds(_))
    }

    /// Whether it is refuted.
    #[must_use]
    pub fn is_refuted(&self) -> bool {
        matches!(self, Self::Refuted(_))
    }

    /// With the evidence of a proof, where sampling found nothing against the statement and the proof succeeds.
    #[must_use]
    pub fn backed_by(self, proof: fn(f64) -> Self) -> Self {
        match self {
            Self::Holds(sampled) => match proof(1.0) {
                Self::Holds(proved) => Self::Holds(proved),
                Self::Refuted(_) | Self::Undecided { .. } => Self::Holds(sampled),
            },
            failed => failed,
        }
    }

    /// Both: the first that fails, else the weaker of the two evidences.
    #[must_use]
    pub fn and(self, other: impl FnOnce() -> Self) -> Self {
        match self {
            Self::Holds(mine) => match other() {
                Self::Holds(theirs) => Self::Holds(mine.weaker(theirs)),
                failed => failed,
            },
            failed => failed,
        }
    }
}
