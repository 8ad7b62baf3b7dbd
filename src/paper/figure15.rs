//! Fig. 15: how often two experiments decide the drag law, and how often rightly (eqs. 41-42).

use serde::Serialize;

use super::PaperError;
use super::table4::Yaw;
use crate::identify::fit::select::pairwise::{Decision, decide, relative_spread_percent};
use crate::numeric::{Interval, Real};

/// A criterion: the margin lambda of eq. 42.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Criterion {
    /// Its number in the paper.
    pub number: u32,
    /// The margin by its formula.
    pub margin: &'static str,
    /// Weight of the spread of alpha.
    spread_share: f64,
    /// Additive constant, in percent.
    constant_percent: f64,
}

/// The four criteria of the paper.
pub const CRITERIA: [Criterion; 4] = [
    Criterion { number: 1, margin: "0", spread_share: 0.0, constant_percent: 0.0 },
    Criterion { number: 2, margin: "sigma_alpha", spread_share: 1.0, constant_percent: 0.0 },
    Criterion { number: 3, margin: "sigma_alpha + 5 %", spread_share: 1.0, constant_percent: 5.0 },
    Criterion { number: 4, margin: "sigma_alpha + 10 %", spread_share: 1.0, constant_percent: 10.0 },
];

/// A group of bars of Fig. 15. Quadratic drag counts as correct: the joint fit of all 19 experiments selects it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Number of the criterion.
    pub criterion: u32,
    /// Pairs that decide for quadratic drag.
    pub correct: u32,
    /// Pairs that decide for linear drag.
    pub wrong: u32,
    /// Pairs that do not decide.
    pub undecided: u32,
}

/// A measure of the spread of two values in percent: eq. 41, or something else to compare it with.
pub type SpreadMeasure<T> = fn(T, T) -> T;

/// Relay levels and parameters of the experiments of which pairs are formed.
#[derive(Clone, Debug, PartialEq)]
pub struct Pairs<T> {
    pairs: Vec<(Yaw<T>, Yaw<T>)>,
}

impl<T: Copy> Pairs<T> {
    /// All pairs with different relay levels.
    ///
    /// # Errors
    /// [`PaperError::Missing`] where there are not as many levels as rows of parameters.
    pub fn new(levels: &[f64], parameters: &[Yaw<T>]) -> Result<Self, PaperError> {
        if levels.len() != parameters.len() {
            let missing = format!("parameters for {} experiments: {} given", levels.len(), parameters.len());
            return Err(PaperError::Missing { fixture: "table4.csv", missing });
        }
        let rows: Vec<_> = levels.iter().zip(parameters).collect();
        let different = |(index, first): (usize, &(&f64, &Yaw<T>))| {
            let (level, one) = (*first.0, *first.1);
            rows[index + 1..]
                .iter()
                .filter(move |row| *row.0 != level)
                .map(move |row| (one, *row.1))
                .collect::<Vec<_>>()
        };
        Ok(Self { pairs: rows.iter().enumerate().flat_map(different).collect() })
    }

    /// How many pairs there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Whether all experiments had the same relay level.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }
}

impl Pairs<f64> {
    /// The bars of a criterion.
    #[must_use]
    pub fn counts(&self, criterion: &Criterion, spread: SpreadMeasure<f64>) -> Counts {
        let mut counts = Counts { criterion: criterion.number, correct: 0, wrong: 0, undecided: 0 };
        for pair in &self.pairs {
            let (spreads, margin) = criterion.measure(pair, spread);
            *counts.of(decide(spreads.beta_r, spreads.beta_rr, margin)) += 1;
        }
        counts
    }
}

impl Pairs<Interval> {
    /// The bars of a criterion when parameters are intervals: the pairs that certainly count and those that may.
    #[must_use]
    pub fn count_ranges(&self, criterion: &Criterion) -> (Counts, Counts) {
        let none = Counts { criterion: criterion.number, correct: 0, wrong: 0, undecided: 0 };
        let (mut certain, mut possible) = (none, none);
        for pair in &self.pairs {
            let (spreads, margin) = criterion.measure(pair, relative_spread_percent);
            let decisions = possible_decisions(spreads.beta_r - spreads.beta_rr, margin);
            for (index, &decision) in decisions.iter().enumerate() {
                if !decisions[..index].contains(&decision) {
                    *possible.of(decision) += 1;
                }
            }
            if decisions.iter().all(|&decision| decision == decisions[0]) {
                *certain.of(decisions[0]) += 1;
            }
        }
        (certain, possible)
    }
}

impl Criterion {
    /// The spreads of a pair's parameters, and the margin that they give.
    fn measure<T: Real>(&self, (first, second): &(Yaw<T>, Yaw<T>), spread: SpreadMeasure<T>) -> (Yaw<T>, T) {
        let spreads = first.with(*second, spread);
        let margin = T::from_f64(self.spread_share) * spreads.alpha + T::from_f64(self.constant_percent);
        (spreads, margin)
    }
}

impl Counts {
    fn of(&mut self, decision: Decision) -> &mut u32 {
        match decision {
            Decision::Quadratic => &mut self.correct,
            Decision::Linear => &mut self.wrong,
            Decision::Undecided => &mut self.undecided,
        }
    }
}

/// What eq. 42 can decide for a difference and a margin in intervals, from the combinations most in favour of each decision.
fn possible_decisions(difference: Interval, margin: Interval) -> [Decision; 3] {
    let nearest_to_zero = 0f64.max(difference.lower()).min(difference.upper());
    [
        decide(difference.upper(), 0.0, margin.lower()),
        decide(difference.lower(), 0.0, margin.lower()),
        decide(nearest_to_zero, 0.0, margin.upper()),
    ]
}

/// The bars of Fig. 15 for these experiments, criterion by criterion.
///
/// # Errors
/// As [`Pairs::new`].
pub fn figure15(levels: &[f64], parameters: &[Yaw<f64>]) -> Result<Vec<Counts>, PaperError> {
    let pairs = Pairs::new(levels, parameters)?;
    Ok(CRITERIA.iter().map(|criterion| pairs.counts(criterion, relative_spread_percent)).collect())
}
