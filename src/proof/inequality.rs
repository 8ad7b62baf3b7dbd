//! Inequalities over boxes, and proofs of them that can be checked again without a search.

use core::fmt;
use core::str::FromStr;

use super::branch_and_bound::prove_positive;
use super::outcome::{Extent, NotProved};
use crate::numeric::Interval;

/// Unknowns of an inequality, used or not.
pub const VARIABLES: usize = 3;

/// A box: one interval for each unknown.
pub type Cell = [Interval; VARIABLES];

/// `margin > 0` for every point of a box.
#[derive(Clone, Copy, Debug)]
pub struct Inequality {
    /// Its name, and that of its proof.
    pub id: &'static str,
    /// What is positive.
    pub statement: &'static str,
    /// The box.
    pub variables: [Extent; VARIABLES],
    /// An enclosure of the margin over a part of the box.
    pub margin: fn(&Cell) -> Interval,
}

/// A proof: boxes that cuts divide the domain into, on each of which interval arithmetic alone shows the inequality.
///
/// They come in the order of the cuts, what lies below a cut before what lies above it, so that one pass sees that they
/// cover the domain. To check a proof takes one evaluation for each box; the search took one more for each box that it
/// divided, and one for that box's midpoint: about three times as long. Where the domain need not be divided, search
/// and check are the same one evaluation.
///
/// As text, one item a line: `inequality ID`, `domain LO HI ...`, `bound B`, and `box LO HI ...` for each box.
#[derive(Clone, Debug, PartialEq)]
pub struct Proof {
    /// What was proved, by [`Inequality::id`].
    pub inequality: String,
    /// Where.
    pub domain: Cell,
    /// The margin is at least this, everywhere.
    pub bound: f64,
    /// The boxes.
    pub boxes: Vec<Cell>,
}

/// Why a proof is not accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// A line that is not of the format.
    #[error("line {line}: `{text}` is not an item of a proof, or is out of place")]
    Malformed {
        /// From one.
        line: usize,
        /// The line.
        text: String,
    },
    /// A proof of something else.
    #[error("a proof of `{found}`; `{expected}` is in question")]
    Other {
        /// What is proved.
        found: String,
        /// What should be.
        expected: &'static str,
    },
    /// No proof of what should be proved.
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
    /// The boxes are not what cuts divide the domain into, or not in that order.
    #[error("the boxes, in the order given, do not make up the domain")]
    NotCovered,
}

impl Refusal {
    /// Short name for scripts; it does not change with the wording of the message.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::Malformed { .. } => "malformed-proof",
            Self::Other { .. } => "other-proof",
            Self::Missing { .. } => "missing-proof",
            Self::Domain { .. } => "other-domain",
            Self::Bound { .. } => "vacuous-bound",
            Self::NotShown { .. } => "not-shown",
            Self::NotCovered => "not-covered",
        }
    }
}

impl Inequality {
    /// The box, or `None` where a range is empty.
    #[must_use]
    pub fn domain(&self) -> Option<Cell> {
        let [a, b, c] = self.variables.map(|variable| Interval::new(variable.lower, variable.upper));
        Some([a?, b?, c?])
    }

    /// Searches for a proof by subdivision, on at most `budget` boxes.
    ///
    /// # Errors
    /// [`NotProved`].
    pub fn prove(&self, budget: usize) -> Result<Proof, NotProved<VARIABLES>> {
        let domain = self.domain().ok_or(NotProved::Undecided { at: [Interval::ENTIRE; VARIABLES], boxes: 0 })?;
        let proved = prove_positive(self.margin, domain, budget)?;
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
        for (index, at) in proof.boxes.iter().enumerate() {
            let margin = (self.margin)(at);
            if margin.lower() < proof.bound {
                return Err(Refusal::NotShown { index, margin, bound: proof.bound });
            }
        }
        if tile(&proof.domain, &proof.boxes) { Ok(()) } else { Err(Refusal::NotCovered) }
    }
}

/// Whether the boxes are what dividing `domain` by cuts leaves, in the order of the cuts: joined with their neighbours, one
/// after the other, they give it back.
fn tile(domain: &Cell, boxes: &[Cell]) -> bool {
    let mut joined: Vec<Cell> = Vec::new();
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
fn join(before: &Cell, after: &Cell) -> Option<Cell> {
    let cut = (0..VARIABLES).find(|&i| before[i] != after[i])?;
    let mut whole = *after;
    whole[cut] = before[cut].hull(after[cut]);
    let others_agree = (cut + 1..VARIABLES).all(|i| before[i] == after[i]);
    (others_agree && before[cut].upper() == after[cut].lower()).then_some(whole)
}

struct Numbers<'a>(&'a Cell);

impl fmt::Display for Numbers<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // The shortest decimals that give the same doubles again.
        self.0.iter().try_for_each(|side| write!(f, " {:?} {:?}", side.lower(), side.upper()))
    }
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "inequality {}\ndomain{}\nbound {:?}", self.inequality, Numbers(&self.domain), self.bound)?;
        self.boxes.iter().try_for_each(|at| writeln!(f, "box{}", Numbers(at)))
    }
}

/// Several proofs, one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Proofs(pub Vec<Proof>);

impl fmt::Display for Proofs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|proof| write!(f, "{proof}"))
    }
}

impl FromStr for Proofs {
    type Err = Refusal;

    fn from_str(text: &str) -> Result<Self, Refusal> {
        let mut proofs: Vec<Proof> = Vec::new();
        for (index, line) in text.lines().enumerate() {
            let fault = || Refusal::Malformed { line: index + 1, text: line.to_owned() };
            let (item, rest) = line.split_once(' ').ok_or_else(fault)?;
            if item == "inequality" {
                let domain = [Interval::ENTIRE; VARIABLES];
                proofs.push(Proof { inequality: rest.to_owned(), domain, bound: 0.0, boxes: Vec::new() });
                continue;
            }
            let proof = proofs.last_mut().ok_or_else(fault)?;
            match item {
                "domain" => proof.domain = cell(rest).ok_or_else(fault)?,
                "bound" => proof.bound = rest.parse().map_err(|_| fault())?,
                "box" => proof.boxes.push(cell(rest).ok_or_else(fault)?),
                _ => return Err(fault()),
            }
        }
        Ok(Self(proofs))
    }
}

fn cell(text: &str) -> Option<Cell> {
    let numbers: Vec<f64> = text.split(' ').map(|word| word.parse().ok()).collect::<Option<_>>()?;
    let [a, b, c, d, e, f] = numbers[..] else { return None };
    Some([Interval::new(a, b)?, Interval::new(c, d)?, Interval::new(e, f)?])
}
