//! The linear programmes of guaranteed bounds: the simplex method against corners, and against its own multipliers.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use selfosc::identify::bounded::linear_program::{Inequalities, Outcome, Programme};
use selfosc::identify::bounded::work::Work;
use selfosc::numeric::Interval;

/// The largest value of an objective over the corners of `a . z <= b`, each where two of these meet; none where no corner is left.
fn highest_corner(constraints: &[([f64; 2], f64)], objective: [f64; 2]) -> Option<f64> {
    let met = |z: [f64; 2]| constraints.iter().all(|([a, b], limit)| a * z[0] + b * z[1] <= limit + 1e-9);
    let corners = constraints.iter().enumerate().flat_map(|(index, ([a, b], e))| {
        constraints[..index].iter().filter_map(move |([c, d], f)| {
            let determinant = a * d - b * c;
            (determinant.abs() > 1e-9).then(|| [(e * d - b * f) / determinant, (a * f - e * c) / determinant])
        })
    });
    corners.filter(|z| met(*z)).map(|[x, y]| objective[0] * x + objective[1] * y).reduce(f64::max)
}

#[test]
fn the_highest_corner_is_reached_and_its_multipliers_show_it() {
    let mut random = Pcg64Mcg::seed_from_u64(11);
    let (mut bounded, mut empty) = (0, 0);
    for _ in 0..300 {
        let mut any = || random.random_range(-1.0..1.0);
        let rows: Vec<([f64; 2], f64)> = (0..6).map(|_| ([any(), any()], any() + 0.3)).collect();
        let objective = [any(), any()];
        let sides = [([1.0, 0.0], 2.0), ([-1.0, 0.0], 1.0), ([0.0, 1.0], 0.5), ([0.0, -1.0], 1.5)];
        let deviations = [(-1.0, 2.0), (-1.5, 0.5)].map(|(low, high)| Interval::new(low, high).expect("ordered"));
        let inequalities = Inequalities {
            coefficients: rows
                .iter()
                .map(|(a, _)| a.iter().copied().map(Interval::point).enumerate().collect())
                .collect(),
            limits: rows.iter().map(|(_, limit)| *limit).collect(),
        };
        let all: Vec<([f64; 2], f64)> = rows.iter().copied().chain(sides).collect();
        let sought: Vec<(usize, f64)> = objective.into_iter().enumerate().collect();
        match (
            Programme::of(&inequalities, &deviations, &Work::default()).maximise(&sought),
            highest_corner(&all, objective),
        ) {
            (Outcome::Bounded { multipliers, at }, Some(highest)) => {
                let shown = inequalities.upper_bound(&sought, &multipliers, &deviations);
                let reached = objective[0] * at[0] + objective[1] * at[1];
                assert!(
                    (shown - highest).abs() < 1e-6 && (reached - highest).abs() < 1e-6,
                    "{shown}, {reached}, {highest}"
                );
                bounded += 1;
            }
            (Outcome::Empty { multipliers }, None) => {
                assert!(inequalities.upper_bound(&[], &multipliers, &deviations) < 0.0);
                empty += 1;
            }
            (outcome, corner) => panic!("{outcome:?} where the highest corner is {corner:?}"),
        }
    }
    assert!(bounded > 50 && empty > 50, "{bounded} and {empty}");
}

#[test]
fn without_an_unknown_a_row_is_met_or_it_is_not() {
    let outcome = |limit: f64| {
        let rows = Inequalities { coefficients: vec![Vec::new()], limits: vec![limit] };
        Programme::of(&rows, &[], &Work::default()).maximise(&[])
    };
    assert!(matches!(outcome(1.0), Outcome::Bounded { .. }));
    assert!(matches!(outcome(-1.0), Outcome::Empty { .. }));
}

/// Inequalities as those of windows: each has some of the unknowns next to each other and one common to all; those that are far off
/// are met all over the box.
fn of_windows(random: &mut Pcg64Mcg, unknowns: usize, feasible: bool) -> (Inequalities, Vec<Interval>) {
    let deviations: Vec<Interval> = (0..unknowns)
        .map(|_| {
            let middle = random.random_range(-0.5..0.5);
            Interval::new(middle - random.random_range(0.1..2.0), middle + random.random_range(0.1..2.0))
                .expect("ordered")
        })
        .collect();
    let point: Vec<f64> = deviations.iter().map(|z| z.lower() + random.random_range(0.0..1.0) * z.width()).collect();
    let mut rows = Inequalities::default();
    for row in 0..8 * unknowns {
        let first = 1 + row / 8 % (unknowns - 1);
        let places = [0, first, (first + 1).min(unknowns - 1)];
        let mut coefficients: Vec<(usize, Interval)> = Vec::new();
        for place in places {
            if coefficients.iter().all(|(own, _)| *own != place) {
                coefficients.push((place, Interval::point(random.random_range(-1.0..1.0))));
            }
        }
        let there: f64 = coefficients.iter().map(|(place, slope)| slope.midpoint() * point[*place]).sum();
        let room = if feasible { 10f64.powf(random.random_range(-3.0..1.5)) } else { random.random_range(-0.3..2.0) };
        rows.coefficients.push(coefficients);
        rows.limits.push(there + room);
    }
    (rows, deviations)
}

#[test]
fn a_point_that_meets_all_rows_and_multipliers_that_allow_no_more_show_each_other() {
    let mut random = Pcg64Mcg::seed_from_u64(12);
    let (mut bounded, mut empty, mut short) = (0, 0, 0);
    for number in 0..200 {
        let unknowns = random.random_range(2..30);
        let (rows, deviations) = of_windows(&mut random, unknowns, number % 3 > 0);
        let sought: Vec<(usize, f64)> =
            (0..random.random_range(1..4)).map(|k| (k * 7 % unknowns, random.random_range(-1.0..1.0))).collect();
        let programme = Programme::of(&rows, &deviations, &Work::default());
        short += usize::from(programme.rows() < rows.limits.len());
        match programme.maximise(&sought) {
            Outcome::Bounded { multipliers, at } => {
                let shown = rows.upper_bound(&sought, &multipliers, &deviations);
                let reached: f64 = sought.iter().map(|(place, weight)| weight * at[*place]).sum();
                assert!((shown - reached).abs() < 1e-6, "{number}: {shown} is shown and {reached} reached");
                for (coefficients, limit) in rows.coefficients.iter().zip(&rows.limits) {
                    let there: f64 = coefficients.iter().map(|(place, slope)| slope.midpoint() * at[*place]).sum();
                    assert!(there <= limit + 1e-7, "{number}: a row is missed by {}", there - limit);
                }
                for (at, side) in at.iter().zip(&deviations) {
                    assert!((at - side.midpoint()).abs() <= side.radius() + 1e-7, "{number}: {at} outside of {side:?}");
                }
                bounded += 1;
            }
            Outcome::Empty { multipliers } => {
                let shown = rows.upper_bound(&[], &multipliers, &deviations);
                assert!(shown < 0.0 && number % 3 == 0, "{number}: {shown}");
                empty += 1;
            }
        }
    }
    assert!(bounded > 120 && empty > 20 && short > 100, "{bounded}, {empty}, {short}");
}

#[test]
fn rows_that_are_met_all_over_the_box_are_left_out_and_those_that_just_may_be_missed_are_not() {
    let side = Interval::new(-1.0, 3.0).expect("ordered");
    let rows = |limit: f64| Inequalities {
        coefficients: vec![vec![(0, Interval::new(1.0, 2.0).expect("ordered"))], vec![(0, Interval::point(-1.0))]],
        limits: vec![limit, 1.0],
    };
    // By the slope that is met most easily three is the largest.
    let of = |limit: f64| Programme::of(&rows(limit), &[side], &Work::default()).rows();
    assert_eq!([of(3.01), of(2.99), of(-100.0)], [0, 1, 1]);
}
