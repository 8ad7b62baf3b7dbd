use super::super::super::mix::{By, Mix};
use super::super::super::simulated::Ray;
use super::super::super::step::Manner;
use super::*;
use crate::numeric::Real;

const PART_S: f64 = 0.4;

fn point(value: f64) -> Interval {
    Interval::point(value)
}

/// What `t (part - t)` is at most in the first part, of whose ends both are nothing, where it bends by so much.
fn arch(bent: f64) -> f64 {
    let mut sums = [[Sizes::ZERO; 2]; 2];
    let bent = [Sizes::ZERO, Sizes::splat(point(bent))];
    add_largest(&mut sums, Sizes::splat(point(2.0)), [[Balls::ZERO; 2]; 3].into_iter(), point(PART_S), bent);
    0.5 * sums[0][1].interval().upper()
}

#[test]
fn what_bends_between_the_ends_of_a_part_is_counted_and_by_the_ends_alone_it_is_missed() {
    let (top, own) = (0.25 * PART_S * PART_S, arch(1.0));
    assert!(own >= top && own < 1.0001 * top, "{own} for {top}");
    assert!(arch(0.0) < top);
}

#[test]
fn parts_are_as_many_as_the_fastest_rate_asks_for_and_end_with_the_step() {
    let h_s = 0.9;
    for (fastest, count) in [(0.0, 1), (0.2, 1), (1.0, 4), (2.0, 7), (1e3, 16), (f64::INFINITY, 16)] {
        let ends = parts(point(h_s), fastest);
        assert_eq!(ends.len(), count, "{fastest}");
        for (part, end) in ends.iter().enumerate() {
            let exact = h_s * (part + 1) as f64 / count as f64;
            assert!(end.inflate(1e-15).contains(exact) && end.width() < 1e-15, "{end:?} for {exact}");
        }
    }
}

#[test]
fn states_are_as_large_as_at_the_ends_of_each_part() {
    let state = |v: f64| [Balls::ZERO, Balls::points([0.0, 0.0, v, 0.0]), Balls::ZERO];
    for values in [[3.0, 1.0, 2.0], [-1.0, 4.0, -2.0], [0.5, -1.0, 2.0]] {
        let mut sums = [[Sizes::ZERO; 3]; 2];
        add_largest(
            &mut sums,
            Sizes::splat(Interval::ONE),
            values.map(state).into_iter(),
            point(0.4),
            [Sizes::ZERO; 3],
        );
        for (sum, around) in sums.iter().zip(values.windows(2)) {
            let largest = around.iter().fold(0.0f64, |most, value| most.max(value.abs()));
            let size = sum[VELOCITY].spread(2).interval().upper();
            assert!(size >= largest && size < largest + 1e-12, "{size} for {largest}");
        }
    }
}

#[test]
fn growth_is_no_less_than_the_exponential_s_and_without_the_square_it_is() {
    for grown in [-2.0, -0.7, -0.1, -1e-3, 1e-3, 0.2, 0.6] {
        let Growth { kept, mean, longest } = Growth::by(point(grown));
        let (exact, exact_mean) = (libm::exp(grown), libm::expm1(grown) / grown);
        assert!(kept.upper() >= exact, "{grown}: {kept:?} for {exact}");
        assert!(mean.upper() >= exact_mean, "{grown}: {mean:?} for {exact_mean}");
        assert!(longest.upper() >= exact.max(1.0), "{grown}: {longest:?}");
        if (-0.7..0.0).contains(&grown) {
            assert!(kept.upper() < 1.3 * exact && mean.upper() < 1.03 * exact_mean, "{grown}: {kept:?}, {mean:?}");
            assert!(1.0 + grown < exact && 1.0 + 0.5 * grown < exact_mean);
        }
    }
}

#[test]
fn a_rest_counts_what_is_left_by_the_end_of_the_part_in_which_it_is_asked_for() {
    let size = |size: f64| [Interval::symmetric(size); 3];
    let rest = Rest { until: vec![(0.4, size(1.0)), (0.8, size(2.0))], at_end: size(1.5) };
    for (time_s, exact) in [(0.1, 1.0), (0.4, 1.0), (0.41, 2.0), (0.8, 2.0), (0.9, 2.0)] {
        assert_eq!(rest.after(point(time_s))[VELOCITY].upper(), exact, "after {time_s} s");
    }
    let across = Interval::new(0.3, 0.5).expect("an interval");
    assert_eq!(rest.after(across)[VELOCITY].upper(), 2.0);
    assert_eq!(rest.at_end()[VELOCITY].upper(), 1.5);
}

/// What is in each part of a step along a ray, and how long one is.
fn along(ray: &Ray, h_s: f64) -> (Vec<Part>, f64) {
    let (h, z) = (point(h_s), Interval::symmetric(1e-3));
    let (field, start) = ray.over(Interval::ZERO);
    let mixes = [Mix::of(ray.moved.iter().copied())];
    let (bundles, pairs) = (Bundle::of(&mixes, &[z]), Pairs::of(&mixes, &[z]));
    let columns = [bundles[0].start];
    let bends = [[Balls::ZERO; 3]];
    let carried =
        Carried { bundles: &bundles, columns: &columns, pairs: Some(&pairs), bends: &bends, ..Carried::NOTHING };
    let manner = Manner { length: 1.4, degree: Some(10) };
    let step = field.smooth(&start, point(ray.command), h, manner, &carried).expect("a step");
    let ends = step.at_all(&parts(h, field.over.fastest(step.within[VELOCITY])));
    let damping = field.at.damping(step.within[VELOCITY], step.within[VELOCITY]);
    let states = [&start.at, &start.at, &step.within];
    let ground = Ground::of(&field, states, (point(ray.command), false), (damping, h), BENT);
    let largest = ground.largest(&carried, &pairs, BENT).expect("bounds");
    let part_s = h / point(ends.len() as f64);
    (ground.driven(&carried, &pairs, &largest, &ends, part_s).expect("parts"), part_s.midpoint())
}

/// Velocities from the beginning of a part to its end.
fn passed(ray: &Ray, z: f64, [from_s, to_s]: [f64; 2]) -> Vec<f64> {
    const INSTANTS: usize = 40;
    let at = |k: usize| {
        let until = from_s + (to_s - from_s) * k as f64 / INSTANTS as f64;
        ray.passed(z, until).pop().expect("an end")[VELOCITY]
    };
    (0..=INSTANTS).map(at).collect()
}

/// An axis with quadratic drag, of which the gain is unknown, from a column at which its velocity is the same at both ends of a part.
fn there_and_back() -> Ray {
    Ray {
        terms: vec![(Term::Gain, 1.0), (Term::Quadratic, 1.0)],
        start: [0.0, 0.2, 1.0],
        command: 1.0,
        moved: vec![(By::Term(Term::Gain), 1.0), (By::Start(VELOCITY), 1.59)],
        bent: [0.0; 3],
    }
}

#[test]
fn the_damping_changes_by_no_more_than_is_said_and_by_its_ends_alone_it_does() {
    let ray = there_and_back();
    let (all, part_s) = along(&ray, 0.25);
    assert_eq!(all.len(), 1);
    let off = 1e-4;
    let span = [0.0, part_s];
    let [more, less] = [off, -off].map(|z| passed(&ray, z, span));
    // Twice the drag times what the velocity changes by.
    let damps: Vec<f64> = more.iter().zip(&less).map(|(more, less)| 2.0 * (more - less) / (2.0 * off)).collect();
    let most = 1e-3 * damps.iter().copied().fold(0.0, f64::max);
    let ends = 1e-3 * damps[0].max(damps[damps.len() - 1]);
    let own = all[0].damps.upper();
    assert!(most > ends * 1.001, "{damps:?}");
    assert!(own >= most && own < 1.1 * most, "{own} for {most}");
}

#[test]
fn what_damps_in_a_part_holds_all_of_it_though_a_velocity_turns() {
    let axis = |stiffness: f64, x: f64, v: f64| Ray {
        terms: vec![(Term::Gain, 1.0), (Term::Quadratic, 0.5), (Term::Stiffness, stiffness)],
        start: [x, v, 1.0],
        command: 1.0,
        moved: vec![(By::Start(VELOCITY), 1.0)],
        bent: [0.0; 3],
    };
    let alone = Ray { terms: vec![(Term::Gain, 1.0), (Term::Quadratic, 0.5)], ..axis(0.0, 0.0, 0.6) };
    for (ray, h_s) in [(alone, 0.5), (axis(4.0, 0.15, 0.6), 0.13)] {
        let (all, part_s) = along(&ray, h_s);
        let mut turned = false;
        for (index, part) in all.iter().enumerate() {
            let velocities = passed(&ray, 0.0, [index as f64 * part_s, (index + 1) as f64 * part_s]);
            for v in &velocities {
                assert!(part.damping.inflate(1e-12).contains(-v), "{v} in {:?}", part.damping);
            }
            let ends = velocities[0].max(velocities[velocities.len() - 1]);
            turned |= velocities.iter().any(|v| *v > 1.0001 * ends);
        }
        assert_eq!(turned, ray.has(Term::Stiffness));
    }
}

#[test]
fn the_rest_is_driven_by_just_what_the_first_two_orders_leave_of_the_drag() {
    // Terms at the point and what they are off; the velocity; what it is off to the first order, the second and behind.
    let ([linear, quadratic, cubic], apart) = ([0.7, 0.5, 0.3], [0.2, 0.15, 0.1]);
    let (v, [first, second, rest]) = (0.6, [0.4, 0.3, 0.25]);
    let drag = |[linear, quadratic, cubic]: [f64; 3], v: f64| v * (linear + v * (quadratic + v * cubic));
    let slope = |[linear, quadratic, cubic]: [f64; 3]| linear + v * (2.0 * quadratic + v * 3.0 * cubic);
    let own = [linear, quadratic, cubic];
    let over: [f64; 3] = core::array::from_fn(|k| own[k] + apart[k]);
    let kink = quadratic + 3.0 * cubic * v;
    let known = drag(own, v)
        + slope(own) * (first + second + rest)
        + drag(apart, v)
        + slope(apart) * first
        + kink * first * first;
    let exact = drag(over, v + first + second + rest) - known;
    let part = Part {
        damping: Interval::ZERO,
        damps: point(slope(apart) + 2.0 * kink * first),
        first: [Interval::ZERO, point(first), Interval::ZERO],
        second: [Interval::ZERO, point(second), Interval::ZERO],
    };
    let kink_apart = apart[1] + 3.0 * apart[2] * v;
    let [kink, kink_apart, cubic] = [kink + kink_apart, kink_apart, over[2]].map(point);
    let nothing = Interval::ZERO;
    let push = Push { kink, kink_apart, cubic, stiff: nothing, gain: nothing, lag: nothing };
    let [pushed, filled] = push.on(&part, &[Interval::ZERO, point(rest), Interval::ZERO]);
    assert!(pushed.inflate(1e-14).contains(exact) && pushed.width() < 1e-12, "{pushed:?} for {exact}");
    assert_eq!(filled.upper(), 0.0);
}
