use super::super::field::{TERMS, Triple};
use super::super::mix::By;
use super::super::series::ORDER;
use super::super::simulated::runge_kutta;
use super::super::step::{Fields, Manner, Pair, Step};
use super::*;

const MANNER: Manner = Manner { length: 1.4, degree: ORDER };
const H_S: f64 = 0.01;
const Z: f64 = 0.05;

/// A model, what an unknown moves, and how the state bends by it at the start of a step.
struct Case {
    terms: Vec<(Term, f64)>,
    start: [f64; 3],
    command: f64,
    moved: Vec<(By, f64)>,
    bent: [f64; 3],
}

impl Case {
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

    /// The state at the end by the classical method of Runge and Kutta, in steps of a hundredth.
    fn end(&self, z: f64, h_s: f64) -> [f64; 3] {
        let terms = self.field(z);
        let of = |term: Term| terms[term as usize];
        let rate = |[x, v, f]: [f64; 3]| {
            let drag = of(Term::Linear) * v + of(Term::Quadratic) * v * v.abs() + of(Term::Cubic) * v * v * v;
            [v, of(Term::Gain) * f - drag - of(Term::Stiffness) * x, of(Term::LagRate) * (self.command - f)]
        };
        let (mut state, h) = (self.at_start(z), h_s / 100.0);
        for _ in 0..100 {
            state = runge_kutta(state, h, rate);
        }
        state
    }

    fn intervals(&self, z: Interval) -> Field {
        let mut active = [false; TERMS];
        self.terms.iter().for_each(|(term, _)| active[*term as usize] = true);
        let [low, high] = [z.lower(), z.upper()].map(|z| self.field(z));
        let terms = core::array::from_fn(|k| Interval::point(low[k]).hull(Interval::point(high[k])));
        Field { terms, active, middle_speed: 0.0 }
    }

    /// The step, and for each component what the second order leaves of the motion, and the rest that is granted.
    fn left(&self, h_s: f64) -> [(f64, f64); 3] {
        let all = Interval::symmetric(Z);
        let fields = Fields { over: self.intervals(all), at: self.intervals(Interval::ZERO) };
        let [low, high] = [-Z, Z].map(|z| self.at_start(z));
        let over: Triple = core::array::from_fn(|k| Interval::point(low[k]).hull(Interval::point(high[k])));
        let start = Pair { over, at: self.start.map(Interval::point) };
        let mixes = [Mix::of(self.moved.iter().copied())];
        let (bundles, pairs) = (Bundle::of(&mixes, &[all]), Pairs::of(&mixes, &[all]));
        let columns = [bundles[0].start];
        let bends = [self.bent.map(|bent| Balls::splat(Interval::point(bent)))];
        let carried = Carried {
            bundles: &bundles,
            columns: &columns,
            pairs: Some(&pairs),
            bends: &bends,
            rest: [Interval::ZERO; 3],
        };
        let step: Box<Step> = fields
            .smooth(&start, Interval::point(self.command), Interval::point(h_s), MANNER, &carried)
            .expect("a step");
        assert!(step.curve.is_some());
        let arrival = step.at_end(Interval::point(h_s));
        let at = arrival.at.expect("the point's own");
        let (column, bend) = (arrival.carry_bundle(&columns[0], 0), arrival.carry_bends(&bends));
        let rest = arrival.carry_rest(&[Interval::ZERO; 3]);
        let exact = self.end(Z, h_s);
        core::array::from_fn(|k| {
            let [first, second] = [column[k], bend[0][k]].map(|balls| balls.interval_at(0).midpoint());
            (exact[k] - at[k].midpoint() - Z * first - 0.5 * Z * Z * second, rest[k].magnitude())
        })
    }
}

/// Cases in which all that is of the third order has the same sign, so that nothing may be missing from its bound.
fn cases() -> Vec<(Case, Vec<usize>)> {
    let drag = |term: Term, sign: f64| Case {
        terms: vec![(Term::Gain, 1.0), (term, 0.5)],
        start: [0.0, 0.6 * sign, sign],
        command: sign,
        moved: vec![(By::Term(term), 1.0), (By::Start(VELOCITY), sign)],
        bent: [0.0, 2.4 * sign, 0.0],
    };
    let spring = Case {
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
    let lag = Case {
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

#[test]
fn what_the_second_order_leaves_is_within_the_rest_and_fills_it() {
    for (index, (case, tight)) in cases().into_iter().enumerate() {
        for (component, (left, rest)) in case.left(H_S).into_iter().enumerate() {
            assert!(left.abs() <= rest + 1e-15, "case {index}, {component}: {left} left, {rest} granted");
            // Each part of the bound is a tenth of it or more.
            if tight.contains(&component) {
                assert!(left.abs() > 0.92 * rest, "case {index}, {component}: {left} left, {rest} granted");
            }
        }
    }
}

#[test]
fn over_a_long_step_the_rest_holds_what_is_left_and_is_not_many_times_as_much() {
    for (index, (case, tight)) in cases().into_iter().enumerate() {
        let cubic = case.terms.iter().any(|(term, _)| *term == Term::Cubic);
        for (component, (left, rest)) in case.left(0.5).into_iter().enumerate() {
            assert!(left.abs() <= rest + 1e-15, "case {index}, {component}: {left} left, {rest} granted");
            // Sizes over the whole step give a third of this share.
            if component == VELOCITY && tight.contains(&VELOCITY) && !cubic {
                assert!(left.abs() > 0.4 * rest, "case {index}, {component}: {left} left, {rest} granted");
            }
        }
    }
}
