use super::super::field::VELOCITY;
use super::super::series::ORDER;
use super::super::simulated::{Ray, rays};
use super::super::step::Manner;
use super::*;

const SERIES: Manner = Manner { length: 1.4, degree: Some(ORDER) };
const CLOSED: Manner = Manner { degree: None, ..SERIES };
const H_S: f64 = 0.01;
const Z: f64 = 0.05;

/// Every ray with the manners of which it has one.
fn manners(ray: &Ray) -> &'static [Manner] {
    let (fields, _) = ray.over(Interval::ZERO);
    if fields.closed() { &[SERIES, CLOSED] } else { &[SERIES] }
}

/// For each component what the second order leaves of the motion at the end, and the rest that is granted.
fn left(ray: &Ray, manner: Manner, h_s: f64) -> [(f64, f64); 3] {
    let all = Interval::symmetric(Z);
    let (fields, start) = ray.over(all);
    let mixes = [Mix::of(ray.moved.iter().copied())];
    let (bundles, pairs) = (Bundle::of(&mixes, &[all]), Pairs::of(&mixes, &[all]));
    let columns = [bundles[0].start];
    let bends = [ray.bent.map(|bent| Balls::splat(Interval::point(bent)))];
    let carried =
        Carried { bundles: &bundles, columns: &columns, pairs: Some(&pairs), bends: &bends, rest: [Interval::ZERO; 3] };
    let mut step =
        fields.smooth(&start, Interval::point(ray.command), Interval::point(h_s), manner, &carried).expect("a step");
    assert!(step.bends());
    let (_, arrival) = step.arrivals(&[], Interval::point(h_s)).expect("an end");
    let at = arrival.at.expect("the point's own");
    let (column, bend) = (arrival.carry_bundle(&columns[0], 0), arrival.carry_bends(&bends));
    let rest = arrival.carry_rest(&[Interval::ZERO; 3]);
    let passed = ray.passed(Z, h_s);
    let exact = passed[passed.len() - 1];
    core::array::from_fn(|k| {
        let [first, second] = [column[k], bend[0][k]].map(|balls| balls.interval_at(0).midpoint());
        (exact[k] - at[k].midpoint() - Z * first - 0.5 * Z * Z * second, rest[k].magnitude())
    })
}

#[test]
fn what_the_second_order_leaves_is_within_the_rest_and_fills_it() {
    for (index, (ray, tight)) in rays().into_iter().enumerate() {
        for manner in manners(&ray) {
            for (component, (left, rest)) in left(&ray, *manner, H_S).into_iter().enumerate() {
                assert!(left.abs() <= rest + 1e-15, "ray {index}, {component}: {left} left, {rest} granted");
                // Each part of the bound is a tenth of it or more.
                if tight.contains(&component) {
                    assert!(left.abs() > 0.92 * rest, "ray {index}, {component}: {left} left, {rest} granted");
                }
            }
        }
    }
}

#[test]
fn over_a_long_step_the_rest_holds_what_is_left_and_is_not_many_times_as_much() {
    for (index, (ray, tight)) in rays().into_iter().enumerate() {
        let cubic = ray.has(Term::Cubic);
        for manner in manners(&ray) {
            for (component, (left, rest)) in left(&ray, *manner, 0.5).into_iter().enumerate() {
                assert!(left.abs() <= rest + 1e-15, "ray {index}, {component}: {left} left, {rest} granted");
                // Sizes over the whole step give a third of this share.
                if component == VELOCITY && tight.contains(&VELOCITY) && !cubic {
                    assert!(left.abs() > 0.4 * rest, "ray {index}, {component}: {left} left, {rest} granted");
                }
            }
        }
    }
}
