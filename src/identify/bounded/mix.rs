//! What an unknown of a motion moves: one thing, or several at once in fixed proportions.

use super::field::{TERMS, Term};
use crate::numeric::{Balls, Interval, Sizes};

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

    /// Whether it is of anything.
    pub(super) fn moves(&self) -> bool {
        let weights = self.start.iter().chain(&self.terms).chain([&self.delay]);
        !self.instants.is_empty() || weights.into_iter().any(|weight| *weight != 0.0)
    }

    /// By how much a switching comes later.
    fn shift(&self, edge: usize) -> Interval {
        let own = self.instants.iter().filter(|(own, _)| *own == edge);
        own.fold(Interval::point(self.delay), |shift, (_, weight)| shift + Interval::point(*weight))
    }
}

/// Several unknowns side by side: mixes, and how far from the point each may be.
#[derive(Clone, Debug)]
pub(super) struct Bundle {
    mixes: Vec<Mix>,
    /// Of the state at the beginning.
    pub(super) start: [Balls; 3],
    pub(super) deviations: Balls,
    /// Terms that move, with the weights.
    terms: Vec<(Term, Balls)>,
}

/// A number of each mix; of those that are missing, zero.
fn side_by_side(mixes: &[Mix], number: impl Fn(&Mix) -> f64) -> Balls {
    Balls::points(core::array::from_fn(|place| mixes.get(place).map_or(0.0, &number)))
}

impl Bundle {
    /// All unknowns, in their order.
    pub(super) fn of(mixes: &[Mix], deviations: &[Interval]) -> Vec<Self> {
        let bundles = mixes.chunks(Balls::COUNT).zip(deviations.chunks(Balls::COUNT));
        bundles
            .map(|(mixes, deviations)| Self {
                start: core::array::from_fn(|component| side_by_side(mixes, |mix| mix.start[component])),
                deviations: Balls::new(core::array::from_fn(|place| {
                    deviations.get(place).copied().unwrap_or(Interval::ZERO)
                })),
                terms: Term::ALL
                    .into_iter()
                    .filter(|term| mixes.iter().any(|mix| mix.terms[*term as usize] != 0.0))
                    .map(|term| (term, side_by_side(mixes, |mix| mix.terms[term as usize])))
                    .collect(),
                mixes: mixes.to_vec(),
            })
            .collect()
    }

    /// How many.
    pub(super) fn count(&self) -> usize {
        self.mixes.len()
    }

    /// Whether any of them moves the vehicle on the way.
    pub(super) fn pushes(&self) -> bool {
        !self.terms.is_empty()
    }

    /// What they push, velocity and force, given what each term multiplies.
    #[inline]
    pub(super) fn pushed(&self, by: impl Fn(Term) -> Balls) -> [Balls; 2] {
        let of = |force: bool| {
            let terms = self.terms.iter().filter(move |(term, _)| (*term == Term::LagRate) == force);
            Balls::dot(terms.map(|(term, weight)| (*weight, by(*term))))
        };
        [of(false), of(true)]
    }

    /// The same at most.
    #[inline]
    pub(super) fn pushed_at_most(&self, by: impl Fn(Term) -> Sizes) -> [Sizes; 2] {
        let of = |force: bool| {
            let terms = self.terms.iter().filter(move |(term, _)| (*term == Term::LagRate) == force);
            Sizes::dot(terms.map(|(term, weight)| (weight.sizes(), by(*term))))
        };
        [of(false), of(true)]
    }

    /// Terms of the damping that move.
    pub(super) fn damping_terms(&self) -> impl Iterator<Item = (Term, Balls)> + '_ {
        self.terms.iter().copied().filter(|(term, _)| matches!(term, Term::Linear | Term::Quadratic | Term::Cubic))
    }

    /// How much of a term one of them moves.
    pub(super) fn weight(&self, term: Term, place: usize) -> f64 {
        self.mixes.get(place).map_or(0.0, |mix| mix.terms[term as usize])
    }

    /// By how much a switching comes later; `None` for not at all.
    pub(super) fn shifts(&self, edge: usize) -> Option<Balls> {
        let shifts = core::array::from_fn(|place| self.mixes.get(place).map_or(Interval::ZERO, |mix| mix.shift(edge)));
        (shifts != [Interval::ZERO; Balls::COUNT]).then(|| Balls::new(shifts))
    }
}
