//! What an unknown of a motion moves: one thing, or several at once in fixed proportions.

use super::field::{TERMS, Term};
use crate::numeric::Interval;

/// A weight for each term of the equation.
pub(super) type Weights = [f64; TERMS];

/// What a column of slopes is by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum By {
    /// A component of the state at the beginning.
    Start(usize),
    /// A term of the equation.
    Term(Term),
    /// The delay: it moves every switching.
    Delay,
    /// The instant of one switching, by its number.
    Instant(usize),
}

/// So much of each.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Mix {
    start: [f64; 3],
    terms: Weights,
    delay: f64,
    instants: Vec<(usize, f64)>,
}

impl Mix {
    /// Of several at once.
    pub(super) fn of(parts: impl IntoIterator<Item = (By, f64)>) -> Self {
        let mut mix = Self::default();
        for (by, weight) in parts {
            match by {
                By::Start(component) => mix.start[component] += weight,
                By::Term(term) => mix.terms[term as usize] += weight,
                By::Delay => mix.delay += weight,
                By::Instant(edge) if weight != 0.0 => mix.instants.push((edge, weight)),
                By::Instant(_) => {}
            }
        }
        mix
    }

    /// Of the state at the beginning.
    pub(super) fn start(&self) -> [f64; 3] {
        self.start
    }

    /// The terms, if there are any.
    pub(super) fn pushes(&self) -> Option<&Weights> {
        self.terms.iter().any(|weight| *weight != 0.0).then_some(&self.terms)
    }

    /// By how much a switching comes later.
    pub(super) fn shift(&self, edge: usize) -> Interval {
        let own = self.instants.iter().filter(|(own, _)| *own == edge);
        own.fold(Interval::point(self.delay), |shift, (_, weight)| shift + Interval::point(*weight))
    }
}
