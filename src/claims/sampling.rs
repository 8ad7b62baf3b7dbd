//! Drawing cases, with a record of the numbers.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use serde::{Deserialize, Serialize};

use super::{Evidence, Verdict, Witness};

/// How many cases to draw, and from which seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Budget {
    /// Cases for each checker.
    pub cases: usize,
    /// Seed of the generator. The same seed draws the same cases on every machine.
    pub seed: u64,
}

impl Default for Budget {
    fn default() -> Self {
        Self { cases: 1000, seed: 1 }
    }
}

/// Numbers of a case, with the names they are reported under.
#[derive(Debug)]
pub(crate) struct Draw {
    generator: Pcg64,
    drawn: Vec<(&'static str, f64)>,
}

impl Draw {
    /// Uniform on `[from, to)`.
    pub(crate) fn uniform(&mut self, name: &'static str, from: f64, to: f64) -> f64 {
        let value = self.generator.random_range(from..to);
        self.note(name, value)
    }
    /// Uniform in the logarithm on `[from, to)`, both positive.
    pub(crate) fn log_uniform(&mut self, name: &'static str, from: f64, to: f64) -> f64 {
        let value = libm::exp(self.generator.random_range(libm::log(from)..libm::log(to)));
        self.note(name, value)
    }
    /// Uniform on `[from, to)`, too many of a kind to be shown in a witness.
    pub(crate) fn unrecorded(&mut self, from: f64, to: f64) -> f64 {
        self.generator.random_range(from..to)
    }
    /// A whole number of `0..count`.
    pub(crate) fn index(&mut self, name: &'static str, count: usize) -> usize {
        let value = self.generator.random_range(0..count);
        self.note(name, value as f64);
        value
    }
    /// Adds a number that follows from the random numbers to the witness.
    pub(crate) fn note(&mut self, name: &'static str, value: f64) -> f64 {
        self.drawn.push((name, value));
        value
    }
    /// The two sides of an equation, equal to `tolerance` relative to `scale`.
    pub(crate) fn equal(
        &mut self,
        (name, value): (&'static str, f64),
        expected: f64,
        scale: f64,
        tolerance: f64,
    ) -> Case {
        self.note(name, value);
        self.note("expected", expected);
        Case::margin(1.0 - (value - expected).abs() / (tolerance * scale.abs()))
    }
    /// Equations: the name, the two sides and the scale of each.
    pub(crate) fn equations<const N: usize>(
        &mut self,
        equations: [(&'static str, f64, f64, f64); N],
        tolerance: f64,
    ) -> Case {
        let equal = |(name, value, expected, scale)| self.equal((name, value), expected, scale, tolerance);
        equations.map(equal).into_iter().fold(Case::margin(f64::INFINITY), Case::and)
    }
    /// `lesser <= greater`; the margin is the gap relative to `scale`.
    pub(crate) fn at_most(&mut self, lesser: (&'static str, f64), greater: (&'static str, f64), scale: f64) -> Case {
        self.note(lesser.0, lesser.1);
        self.note(greater.0, greater.1);
        Case::margin((greater.1 - lesser.1) / scale.abs())
    }
}

/// That the statement holds in a case, with this margin; that it fails where the margin is negative or no number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Case(f64);

impl Case {
    /// By margin: below zero, or no number, fails.
    pub(crate) fn margin(margin: f64) -> Self {
        Self(margin)
    }
    /// By truth.
    pub(crate) fn truth(holds: bool) -> Self {
        Self(if holds { 1.0 } else { -1.0 })
    }
    /// Both, by the smaller margin.
    pub(crate) fn and(self, other: Self) -> Self {
        if self.0.is_nan() || other.0 >= self.0 { self } else { other }
    }
}

/// Draws until `budget.cases` cases have counted; a draw that violates the hypotheses does not count. Refuted by the
/// first that fails, undecided where the hypotheses hold too rarely.
pub(crate) fn sample(budget: Budget, mut case: impl FnMut(&mut Draw) -> Option<Case>) -> Verdict {
    let mut draw = Draw { generator: Pcg64::seed_from_u64(budget.seed), drawn: Vec::new() };
    let (mut counted, mut worst) = (0, f64::INFINITY);
    let tries = 100 * budget.cases;
    for _ in 0..tries {
        if counted == budget.cases {
            break;
        }
        draw.drawn.clear();
        match case(&mut draw) {
            None => {}
            Some(Case(margin)) if margin >= 0.0 => {
                counted += 1;
                worst = worst.min(margin);
            }
            Some(_) => return Verdict::Refuted(Witness::new(draw.drawn)),
        }
    }
    if counted < budget.cases || counted == 0 {
        return Verdict::Undecided { spent: format!("{counted} of {} cases in {tries} draws", budget.cases) };
    }
    Verdict::Holds(Evidence::sampled(counted, worst))
}
