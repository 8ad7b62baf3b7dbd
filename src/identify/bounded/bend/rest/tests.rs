use super::super::NONE;
use super::*;
use crate::numeric::Real;

const STEP_S: f64 = 0.8;

fn point(value: f64) -> Interval {
    Interval::point(value)
}

/// A step in two parts, and what `t (part - t)` is on it: nothing at both ends of the first.
fn arch() -> (Course, [Short; 3]) {
    let part = STEP_S / PARTS as f64;
    let mut path = [NONE; 3];
    path[VELOCITY][1] = Balls::splat(point(part));
    path[VELOCITY][2] = Balls::splat(point(-1.0));
    let ends = core::array::from_fn(|end| {
        let all = powers(point(part * (end + 1) as f64), BEND_ORDER);
        (core::array::from_fn(|k| all[k]), [Balls::ZERO; 3])
    });
    (Course { part_s: point(part), ends, components: 2 }, path)
}

#[test]
fn what_bends_between_the_ends_of_a_part_is_counted_and_by_the_ends_alone_it_is_missed() {
    let (course, path) = arch();
    let part = STEP_S / PARTS as f64;
    let bent = [Sizes::ZERO, Sizes::splat(Interval::ONE), Sizes::ZERO];
    let [own, none] = [bent, [Sizes::ZERO; 3]].map(|bent| {
        let mut sums = [[Sizes::ZERO; 3]; PARTS];
        course.add_largest(&mut sums, Sizes::splat(Interval::ONE), &course.along(&path), bent);
        sums[0][VELOCITY].interval().upper()
    });
    let top = 0.25 * part * part;
    assert!(own >= top && own < 1.0001 * top, "{own} for {top}");
    assert!(none < top, "without what bends {none} for {top}");
}

#[test]
fn states_are_carried_to_the_end_of_each_part() {
    let (mut course, path) = arch();
    // Every component of a start becomes half of itself.
    for (end, (_, carried)) in course.ends.iter_mut().enumerate() {
        for (component, value) in carried.iter_mut().enumerate() {
            let mut own = [0.0; 4];
            own[component] = 0.5f64.powi(end as i32 + 1);
            *value = Balls::points(own);
        }
    }
    let start = [Balls::ZERO, Balls::splat(point(3.0)), Balls::ZERO];
    let ends = course.carried(&start, &path);
    let part = STEP_S / PARTS as f64;
    for (end, kept) in [1.0, 0.5, 0.25].into_iter().enumerate() {
        let t = part * end as f64;
        let exact = 3.0 * kept + t * (part - t);
        assert!(ends[end][VELOCITY].interval_at(2).inflate(1e-14).contains(exact), "{:?}", ends[end][VELOCITY]);
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
    let rest = Rest { until: [(0.4, size(1.0)), (0.8, size(2.0))], at_end: size(1.5) };
    for (time_s, exact) in [(0.1, 1.0), (0.4, 1.0), (0.41, 2.0), (0.8, 2.0), (0.9, 2.0)] {
        assert_eq!(rest.after(point(time_s))[VELOCITY].upper(), exact, "after {time_s} s");
    }
    let across = Interval::new(0.3, 0.5).expect("an interval");
    assert_eq!(rest.after(across)[VELOCITY].upper(), 2.0);
    assert_eq!(rest.at_end()[VELOCITY].upper(), 1.5);
}
