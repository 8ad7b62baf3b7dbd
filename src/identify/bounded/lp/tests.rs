use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::*;

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
        let inequalities = Rows {
            slopes: rows.iter().map(|(a, _)| a.iter().copied().map(Interval::point).enumerate().collect()).collect(),
            limits: rows.iter().map(|(_, limit)| *limit).collect(),
        };
        let all: Vec<([f64; 2], f64)> = rows.iter().copied().chain(sides).collect();
        let sought: Vec<(usize, f64)> = objective.into_iter().enumerate().collect();
        match (Programme::of(&inequalities, &deviations, &[0, 1]).maximise(&sought), highest_corner(&all, objective)) {
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
        let rows = Rows { slopes: vec![Vec::new()], limits: vec![limit] };
        Programme::of(&rows, &[], &[]).maximise(&[])
    };
    assert!(matches!(outcome(1.0), Outcome::Bounded { .. }));
    assert!(matches!(outcome(-1.0), Outcome::Empty { .. }));
}
