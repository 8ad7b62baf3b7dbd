use super::super::super::bend::Carried;
use super::super::super::mix::{By, Mix};
use super::super::super::series::ORDER;
use super::super::super::simulated::{Ray, rays};
use super::super::{Manner, Step};
use super::*;

const MANNER: Manner = Manner { length: 1.4, degree: Some(ORDER) };
const SHORT_S: f64 = 0.01;
const LONG_S: f64 = 0.5;
const Z: f64 = 0.05;

fn point(value: f64) -> Interval {
    Interval::point(value)
}

/// By a series, and in closed form.
fn manners(ray: &Ray) -> impl Iterator<Item = Manner> {
    let (fields, _) = ray.over(Interval::ZERO);
    let closed = fields.closed().then_some(Manner { degree: None, ..MANNER });
    core::iter::once(MANNER).chain(closed)
}

/// A step over a ray, and what its unknown is.
fn step(ray: &Ray, h_s: f64, manner: Manner) -> (Box<Step>, Bundle) {
    let all = Interval::symmetric(Z);
    let (fields, start) = ray.over(all);
    let bundles = Bundle::of(&[Mix::of(ray.moved.iter().copied())], &[all]);
    let columns = [bundles[0].start];
    let carried = Carried { bundles: &bundles, columns: &columns, ..Carried::NOTHING };
    let step = fields.smooth(&start, point(ray.command), point(h_s), manner, &carried).expect("a step");
    (step, bundles.into_iter().next().expect("a bundle"))
}

/// For each component what the point's own slope leaves of the slope to the far end after a share of the step, and the doubt that is
/// granted.
fn off(ray: &Ray, h_s: f64, share: f64, manner: Manner) -> [(f64, f64); 3] {
    let (step, bundle) = step(ray, h_s, manner);
    let arrival = step.at_all(&[point(share * h_s)]).pop().expect("one");
    let at = arrival.at.expect("the point's own");
    let column = arrival.carry_bundle(&bundle.start, 0);
    let passed = ray.passed(Z, h_s);
    let exact = passed[(share * (passed.len() - 1) as f64).round() as usize];
    core::array::from_fn(|k| {
        let slope = column[k].interval_at(0);
        ((exact[k] - at[k].midpoint()) / Z - slope.midpoint(), slope.radius())
    })
}

/// Room for what the classical method leaves, over z.
const MISSED: f64 = 1e-12;
/// A thousand middles miss a mean by less.
const MISSED_OF_MEAN: f64 = 1e-6;

/// Rays without bends, of which the last start nowhere but at the point's state.
fn cases() -> impl Iterator<Item = (usize, Ray, Vec<usize>)> {
    let own = |ray: Ray| {
        let terms = ray.moved.iter().filter(|(by, _)| matches!(by, By::Term(_)));
        // A lag that is longer takes force away, as less gain does.
        let moved = terms.map(|(by, weight)| (*by, if *by == By::Term(Term::LagRate) { -weight } else { *weight }));
        Ray { moved: moved.collect(), ..ray }
    };
    let from_rest = rays().into_iter().map(move |(ray, tight)| (own(ray), tight));
    let all = rays().into_iter().chain(from_rest).enumerate();
    all.map(|(index, (ray, tight))| (index, Ray { bent: [0.0; 3], ..ray }, tight))
}

#[test]
fn what_slopes_over_a_box_are_off_is_within_the_doubt_and_fills_it() {
    for (index, ray, tight) in cases() {
        for (share, manner) in [0.5, 1.0].into_iter().flat_map(|share| manners(&ray).map(move |manner| (share, manner)))
        {
            for (component, (off, doubt)) in off(&ray, SHORT_S, share, manner).into_iter().enumerate() {
                assert!(off.abs() <= doubt + MISSED, "ray {index}, {component}: {off} off, {doubt} granted");
                // Each part of the doubt is a tenth of it or more.
                if tight.contains(&component) {
                    assert!(off.abs() > 0.9 * doubt, "ray {index}, {component}: {off} off, {doubt} granted");
                }
            }
        }
    }
}

#[test]
fn over_a_long_step_the_doubt_holds_what_slopes_are_off_and_is_not_many_times_as_much() {
    let started = rays().len();
    for (index, ray, tight) in cases() {
        let shares = [0.1, 0.5, 1.0].into_iter();
        for (share, manner) in shares.flat_map(|share| manners(&ray).map(move |manner| (share, manner))) {
            for (component, (off, doubt)) in off(&ray, LONG_S, share, manner).into_iter().enumerate() {
                assert!(off.abs() <= doubt + MISSED, "ray {index}, {component}: {off} off, {doubt} granted");
                // Of cubic drag the remainder counts for more, in so long a step; from rest signs are not all the same.
                if share == 1.0 && index < started && tight.contains(&component) && !ray.has(Term::Cubic) {
                    assert!(off.abs() > 0.3 * doubt, "ray {index}, {component}: {off} off, {doubt} granted");
                }
            }
        }
    }
}

#[test]
fn what_a_lag_or_a_spring_drives_does_not_fade_like_what_comes_in_at_once() {
    let ray = |term: Term, start: usize, apart: (By, f64)| Ray {
        terms: vec![(Term::Gain, 1.0), (Term::Linear, 2.0), (term, 0.1)],
        start: [0.3, 0.6, 0.2],
        command: 1.0,
        moved: vec![apart, (By::Start(start), 1.0)],
        bent: [0.0; 3],
    };
    let lagged = ray(Term::LagRate, FORCE, (By::Term(Term::Gain), -1.0));
    let stiff = ray(Term::Stiffness, POSITION, (By::Term(Term::Stiffness), 1.0));
    let [at_once, ..] = left(point(2.0 * LONG_S));
    for ray in [lagged, stiff] {
        let (off, doubt) = off(&ray, LONG_S, 1.0, MANNER)[VELOCITY];
        assert!(off.abs() <= doubt, "{off} off, {doubt} granted");
        assert!(off.abs() > at_once.upper() * doubt, "{off} off of {doubt} would be within what fades at once");
    }
}

#[test]
fn velocities_are_no_further_off_the_point_s_than_is_said() {
    for (index, ray, _) in cases() {
        let all = Interval::symmetric(Z);
        let (fields, start) = ray.over(all);
        let passed = [0.0, Z].map(|z| ray.passed(z, LONG_S));
        let around = |states: &[[f64; 3]]| -> Triple {
            core::array::from_fn(|k| {
                states.iter().map(|state| point(state[k])).reduce(|a, b| a.hull(b)).expect("states")
            })
        };
        let (at, over) = (around(&passed[0]), around(&passed.concat()));
        let damping = fields.over.damping(over[VELOCITY], at[VELOCITY]);
        let equations = Equations::of(&fields.over, 1);
        let push = |term: Term| Sizes::splat(fields.at.push(term, &at, point(ray.command)));
        let starts = [&start.over, &start.at];
        let said = super::off(&fields, &equations, starts, damping, push, point(LONG_S)).expect("a bound");
        let apart = passed[0].iter().zip(&passed[1]).map(|(a, b)| (a[VELOCITY] - b[VELOCITY]).abs());
        let furthest = apart.fold(0.0, f64::max);
        assert!(furthest <= said.upper() && said.upper() < 2.5 * furthest, "ray {index}: {furthest}, {said:?}");
    }
}

/// The mean over a range from zero to one, by a thousand of its middles.
fn mean(of: impl Fn(f64) -> f64) -> f64 {
    (0..1000).map(|k| of((f64::from(k) + 0.5) / 1000.0)).sum::<f64>() / 1000.0
}

#[test]
fn what_fading_leaves_is_no_less_than_it_does_and_not_much_more() {
    for x in [0.01, 0.1, 0.5, 1.0, 3.0] {
        let evenly = |y: f64| 2.0 * (1.0 - libm::exp(-y) * (1.0 + y)) / (y * y);
        let exact = [libm::exp(-x), mean(|q| 2.0 * q * libm::exp(-x * q)), mean(|q| 3.0 * q * q * evenly(x * q))];
        for (k, (bound, exact)) in left(point(x)).into_iter().zip(exact).enumerate() {
            assert!(
                bound.upper() >= exact - MISSED_OF_MEAN && bound.upper() <= 1.0,
                "{k} of {x}: {bound:?} for {exact}"
            );
            if x <= 1.0 {
                assert!(bound.upper() < 1.03 * exact, "{k} of {x}: {bound:?} for {exact}");
            }
        }
    }
}
