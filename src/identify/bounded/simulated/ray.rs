//! A vehicle along one line through its unknowns.

use super::super::field::{FORCE, Field, POSITION, TERMS, Term, Triple, VELOCITY};
use super::super::mix::By;
use super::super::step::{Fields, Pair};
use super::runge_kutta;
use crate::numeric::Interval;

/// Steps of the method that it moves by.
const STEPS: usize = 100;

/// A model, what an unknown z moves, and how the state bends by it at the start of a step.
pub(in super::super) struct Ray {
    pub(in super::super) terms: Vec<(Term, f64)>,
    pub(in super::super) start: [f64; 3],
    pub(in super::super) command: f64,
    pub(in super::super) moved: Vec<(By, f64)>,
    pub(in super::super) bent: [f64; 3],
}

impl Ray {
    fn field(&self, z: f64) -> [f64; TERMS] {
        let mut terms = [0.0; TERMS];
        for (term, value) in &self.terms {
            let by = self.moved.iter().filter(|(by, _)| *by == By::Term(*term)).map(|(_, weight)| weight);
            terms[*term as usize] = value + z * by.sum::<f64>();
        }
        terms
    }

    fn at_start(&self, z: f64) -> [f64; 3] {
        core::array::from_fn(|k| {
            let by = self.moved.iter().filter(|(by, _)| *by == By::Start(k)).map(|(_, weight)| weight);
            self.start[k] + z * by.sum::<f64>() + 0.5 * z * z * self.bent[k]
        })
    }

    /// The states from the start to `h_s` later, by the classical method of Runge and Kutta.
    pub(in super::super) fn passed(&self, z: f64, h_s: f64) -> Vec<[f64; 3]> {
        let terms = self.field(z);
        let of = |term: Term| terms[term as usize];
        let rate = |[x, v, f]: [f64; 3]| {
            let drag = of(Term::Linear) * v + of(Term::Quadratic) * v * v.abs() + of(Term::Cubic) * v * v * v;
            [v, of(Term::Gain) * f - drag - of(Term::Stiffness) * x, of(Term::LagRate) * (self.command - f)]
        };
        let step = |state: &[f64; 3]| Some(runge_kutta(*state, h_s / STEPS as f64, rate));
        core::iter::successors(Some(self.at_start(z)), step).take(STEPS + 1).collect()
    }

    fn intervals(&self, z: Interval) -> Field {
        let mut active = [false; TERMS];
        self.terms.iter().for_each(|(term, _)| active[*term as usize] = true);
        let [low, high] = [z.lower(), z.upper()].map(|z| self.field(z));
        let terms = core::array::from_fn(|k| Interval::point(low[k]).hull(Interval::point(high[k])));
        Field { terms, active, middle_speed: 0.0 }
    }

    /// The equation, and the states that it starts from, for a range of the unknown about zero.
    pub(in super::super) fn over(&self, z: Interval) -> (Fields, Pair) {
        let fields = Fields { over: self.intervals(z), at: self.intervals(Interval::ZERO) };
        let [low, high] = [z.lower(), z.upper()].map(|z| self.at_start(z));
        let over: Triple = core::array::from_fn(|k| Interval::point(low[k]).hull(Interval::point(high[k])));
        (fields, Pair { over, at: self.start.map(Interval::point) })
    }

    pub(in super::super) fn has(&self, term: Term) -> bool {
        self.terms.iter().any(|(own, _)| *own == term)
    }
}

/// Some of which all that is of the second order has the same sign, and all that is of the third, so that nothing may be missing from
/// a bound; each with the components of which that is so.
pub(in super::super) fn rays() -> Vec<(Ray, Vec<usize>)> {
    let drag = |term: Term, sign: f64| Ray {
        terms: vec![(Term::Gain, 1.0), (term, 0.5)],
        start: [0.0, 0.6 * sign, sign],
        command: sign,
        moved: vec![(By::Term(term), 1.0), (By::Start(VELOCITY), sign)],
        bent: [0.0, 2.4 * sign, 0.0],
    };
    let spring = Ray {
        terms: vec![(Term::Gain, 1.0), (Term::Linear, 0.5), (Term::Stiffness, 0.4)],
        start: [0.3, 0.6, 1.0],
        command: 1.0,
        moved: vec![
            (By::Term(Term::Linear), 1.0),
            (By::Term(Term::Stiffness), 1.0),
            (By::Start(POSITION), 1.0),
            (By::Start(VELOCITY), 1.0),
        ],
        bent: [2.4, 2.4, 0.0],
    };
    let lag = Ray {
        terms: vec![(Term::Gain, 1.0), (Term::Linear, 0.5), (Term::LagRate, 2.0)],
        start: [0.0, 0.6, 0.2],
        command: 1.0,
        moved: vec![
            (By::Term(Term::Gain), -1.0),
            (By::Term(Term::Linear), 1.0),
            (By::Term(Term::LagRate), 1.0),
            (By::Start(VELOCITY), 1.0),
            (By::Start(FORCE), 1.0),
        ],
        bent: [0.0, 2.4, 2.4],
    };
    vec![
        (drag(Term::Quadratic, 1.0), vec![VELOCITY]),
        (drag(Term::Quadratic, -1.0), vec![VELOCITY]),
        (drag(Term::Cubic, 1.0), vec![VELOCITY]),
        (spring, vec![VELOCITY]),
        (lag, vec![VELOCITY, FORCE]),
    ]
}
