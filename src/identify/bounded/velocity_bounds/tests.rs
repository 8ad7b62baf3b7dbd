use super::*;
use crate::numeric::runge_kutta;

const FORCES: [f64; 5] = [-2.0, -0.3, 0.0, 0.4, 2.0];
const VELOCITIES: [f64; 7] = [-1.5, -0.4, -0.01, 0.0, 0.02, 0.5, 1.5];
/// Linear, quadratic, cubic: with damping alone, mixed, and with linear drag that drives.
const DRAGS: [[f64; 3]; 4] = [[0.8, 0.0, 0.0], [0.0, 1.1, 0.0], [0.3, 0.4, 0.2], [-0.5, 0.9, 0.0]];
const LASTED_S: f64 = 0.1;
const STEPS: usize = 400;
/// What the classical method leaves in so many steps.
const MISSED: f64 = 1e-10;

fn rate([linear, quadratic, cubic]: [f64; 3], force: f64, v: f64) -> f64 {
    force - linear * v - quadratic * v * v.abs() - cubic * v * v * v
}

/// The velocity at every step, by the classical method of Runge and Kutta.
fn motion(drag: [f64; 3], force: f64, from: f64) -> Vec<f64> {
    let h = LASTED_S / STEPS as f64;
    let mut passed = vec![from];
    for _ in 0..STEPS {
        let v = passed[passed.len() - 1];
        let [next] = runge_kutta([v], h, |[v]| [rate(drag, force, v)]);
        passed.push(next);
    }
    passed
}

fn cases() -> impl Iterator<Item = ([f64; 3], f64, f64)> {
    let each = DRAGS.iter().flat_map(|drag| FORCES.iter().map(move |force| (*drag, *force)));
    each.flat_map(|(drag, force)| VELOCITIES.iter().map(move |v| (drag, force, *v)))
}

fn end(passed: &[f64]) -> f64 {
    passed[passed.len() - 1]
}

#[test]
fn the_least_velocity_is_enclosed_and_by_the_first_rate_alone_it_is_not() {
    let lasted = Interval::point(LASTED_S);
    let mut by_the_first_rate = 0;
    for (drag, force, v) in cases() {
        let passed = motion(drag, force, v);
        let least = Drag(drag.map(Interval::point)).least(v, Interval::point(force), lasted);
        let lowest = passed.iter().copied().fold(v, f64::min);
        assert!(least <= lowest + MISSED, "{drag:?} {force} {v}: {least} is above {lowest}");
        // Hardly less than it is: rates change by a tenth of themselves.
        let changed = (lowest - v).abs();
        assert!(lowest - least <= 0.2 * changed + MISSED, "{drag:?} {force} {v}: {least} for {lowest}");
        by_the_first_rate += usize::from(v + LASTED_S * rate(drag, force, v) > end(&passed) + MISSED);
    }
    assert!(by_the_first_rate > 10, "the first rate alone is wrong {by_the_first_rate} times");
}

#[test]
fn over_a_box_of_drags_and_forces_it_is_below_every_corner_and_the_middle_s_is_not() {
    let lasted = Interval::point(LASTED_S).inflate(0.01);
    let mut by_the_middle = 0;
    for (drag, force, v) in cases() {
        let room = drag.map(|term| 0.3 * term.abs());
        let over = core::array::from_fn(|k| Interval::point(drag[k]).inflate(room[k]));
        let least = Drag(over).least(v, Interval::point(force).inflate(0.2), lasted);
        let middle = Drag(drag.map(Interval::point)).least(v, Interval::point(force), Interval::point(LASTED_S));
        for corner in 0..16 {
            let side = |k: usize| if corner >> k & 1 == 1 { 1.0 } else { -1.0 };
            let own = core::array::from_fn(|k| drag[k] + side(k) * room[k]);
            let reached = end(&motion(own, force + 0.2 * side(3), v));
            assert!(least <= reached + MISSED, "{drag:?} {force} {v}: {least} is above {reached}");
            by_the_middle += usize::from(middle > reached + MISSED);
        }
    }
    assert!(by_the_middle > 100, "the middle alone is wrong {by_the_middle} times");
}
