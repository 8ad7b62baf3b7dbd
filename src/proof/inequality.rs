//! Inequalities over boxes, and proofs of them that can be checked again without a search.

use serde::{Deserialize, Serialize};

use super::branch_and_bound::prove_positive;
use super::margin::{Margin, VARIABLES, VariableBox};
use super::outcome::{Extent, NotProved};
use crate::numeric::Interval;

/// `margin > 0` for every point of a box.
#[derive(Clone, Copy, Debug)]
pub struct Inequality {
    /// Its name, and that of its proof.
    pub id: &'static str,
    /// What is positive.
    pub statement: &'static str,
    /// The box.
    pub variables: [Extent; VARIABLES],
    /// What exceeds zero.
    pub margin: Margin,
}

/// A proof: boxes that cuts divide the domain into, on each of which interval arithmetic alone shows the inequality.
///
/// Boxes come in the order of the cuts, below before above, so that a single pass checks that they
/// cover the domain. A check takes one evaluation for each box; the search took another for each box that it
/// divided, and another for that box's midpoint: about three times as long. Where the domain need not be divided, search
/// and check are the same evaluation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Proof {
    /// The proved inequality, by [`Inequality::id`].
    pub inequality: String,
    /// Where.
    pub domain: VariableBox,
    /// The margin is at least this, everywhere.
    pub bound: f64,
    /// The boxes.
    pub boxes: Vec<VariableBox>,
}

/// Why a proof is not accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// A file that is not of the format.
    #[error("not a certificate: {text}")]
    Malformed {
        /// The fault, and its place.
        text: String,
    },
    /// A certificate of a different statement.
    #[error("`{field}` is not that of `{claim}`: {found}")]
    Statement {
        /// The claim in question.
        claim: &'static str,
        /// Which item of the certificate.
        field: &'static str,
        /// What it says.
        found: String,
    },
    /// A proof of something else.
    #[error("a proof of `{found}`; `{expected}` is in question")]
    Other {
        /// What is proved.
        found: String,
        /// What should be.
        expected: &'static str,
    },
    /// The proof of an inequality is missing.
    #[error("there is no proof of `{inequality}`")]
    Missing {
        /// What should be.
        inequality: &'static str,
    },
    /// A proof on another domain.
    #[error("the domain is not that of `{inequality}`")]
    Domain {
        /// The inequality.
        inequality: &'static str,
    },
    /// A bound that proves nothing.
    #[error("the bound {bound} is not above 0")]
    Bound {
        /// The bound.
        bound: f64,
    },
    /// A box on which the margin may lie below the bound.
    #[error("on box {index} the margin is {margin}, which reaches below the bound {bound}")]
    NotShown {
        /// Place in the list, from zero.
        index: usize,
        /// The margin.
        margin: Interval,
        /// The bound claimed.
        bound: f64,
    },
    /// The boxes are no division of the domain by cuts, or not in that order.
    #[error("the boxes, in the order given, do not make up the domain")]
    NotCovered,
}

crate::numeric::codes! { pub Refusal {
    Malformed => "malformed-proof", Statement => "other-statement", Other => "other-proof",
    Missing => "missing-proof", Domain => "other-domain", Bound => "vacuous-bound", NotShown => "not-shown",
    NotCovered => "not-covered",
} }

impl Inequality {
    /// The box, or `None` where a range is empty.
    #[must_use]
    pub fn domain(&self) -> Option<VariableBox> {
        let [a, b, c] = self.variables.map(|variable| Interval::new(variable.lower, variable.upper));
        Some([a?, b?, c?])
    }

    /// Searches for a proof by subdivision, on at most `budget` boxes.
    ///
    /// # Errors
    /// [`NotProved`].
    pub fn prove(&self, budget: usize) -> Result<Proof, NotProved<VARIABLES>> {
        let domain = self.domain().ok_or(NotProved::Undecided { at: [Interval::ENTIRE; VARIABLES], boxes: 0 })?;
        let proved = prove_positive(|at| self.margin.over(at), domain, budget)?;
        let bound = proved.bound.value();
        Ok(Proof { inequality: self.id.to_owned(), domain, bound, boxes: proved.parts })
    }

    /// Whether `proof` shows this inequality: by evaluation on the boxes listed, and by their making up the domain. Searches
    /// nothing, and takes no box on trust: wherever the cuts are, boxes that pass cover the domain.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn check(&self, proof: &Proof) -> Result<(), Refusal> {
        if proof.inequality != self.id {
            return Err(Refusal::Other { found: proof.inequality.clone(), expected: self.id });
        }
        if self.domain() != Some(proof.domain) {
            return Err(Refusal::Domain { inequality: self.id });
        }
        if !(proof.bound > 0.0) {
            return Err(Refusal::Bound { bound: proof.bound });
        }
        if !tile(&proof.domain, &proof.boxes) {
            return Err(Refusal::NotCovered);
        }
        for (index, at) in proof.boxes.iter().enumerate() {
            let margin = self.margin.over(at);
            if !(margin.lower() >= proof.bound) {
                return Err(Refusal::NotShown { index, margin, bound: proof.bound });
            }
        }
        Ok(())
    }
}

/// Whether the boxes partition `domain` by cuts, in the order of the cuts: joined with their neighbours in
/// turn, they give it back.
fn tile(domain: &VariableBox, boxes: &[VariableBox]) -> bool {
    let mut joined: Vec<VariableBox> = Vec::new();
    for &at in boxes {
        let mut last = at;
        while let Some(whole) = joined.last().and_then(|before| join(before, &last)) {
            joined.pop();
            last = whole;
        }
        joined.push(last);
    }
    joined == [*domain]
}

/// The union of two boxes that differ in one side alone, in which the second continues the first.
fn join(before: &VariableBox, after: &VariableBox) -> Option<VariableBox> {
    let cut = (0..VARIABLES).find(|&i| before[i] != after[i])?;
    let mut whole = *after;
    whole[cut] = before[cut].hull(after[cut]);
    let others_agree = (cut + 1..VARIABLES).all(|i| before[i] == after[i]);
    (others_agree && before[cut].upper() == after[cut].lower()).then_some(whole)
}
