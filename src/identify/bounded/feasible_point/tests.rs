use super::super::problem::Problem;
use super::super::settings::DelayBound;
use super::super::simulated::{Known, LINEAR, VehicleTerms, record};
use super::super::solve::solve;
use super::super::{BoundedModel, Consistency, Quantity, enclose};
use super::*;
use crate::identify::DragLaw;

#[test]
fn feasible_points_are_found_towards_both_ends_of_the_bounds() {
    let problem = Known::of(&VehicleTerms { quadratic: 0.3, ..LINEAR }, 250, true).problem;
    let mut contractor = Contractor::new(problem.clone());
    let hull = contractor.prune(problem.search, 2000).hull().expect("not empty: the truth is inside");
    let nearest = contractor.nearest(&hull, &hull).filter(ParameterPoint::is_feasible).expect("a feasible point");
    for place in 0..contractor.problem.unknowns.common() {
        let [low, high] = [-1.0, 1.0].map(|sign| contractor.furthest(&nearest, &hull, place, sign));
        assert!(low.is_feasible() && high.is_feasible());
        let reached = (high.at[place] - low.at[place]) / hull[place].width();
        assert!(reached > 0.05, "unknown {place}: feasible points reach over {reached} of the bounds");
    }
}

#[test]
fn a_point_is_found_about_the_fit_where_division_has_hardly_begun_and_none_where_there_is_none() {
    let record = record(&LINEAR.motion(300));
    let of = |law, delay| BoundedModel { budget: 1, law, delay, ..LINEAR.model(true) };
    let brief = of(DragLaw::Mixed, DelayBound::Unknown);
    let found = enclose(&[&record], &brief).expect("bounds");
    assert_eq!(found.verdict, Consistency::Consistent);
    let ([low, high], alpha) = (found.of(Quantity::Alpha).expect("a range"), 1.0 / LINEAR.gain);
    assert!(low <= alpha && alpha <= high && high > 2.0 * low, "[{low}, {high}] after one pass");
    let problem = Problem::new(&[&record], &brief).expect("a problem");
    let without = solve(&problem, &brief, || None).expect("bounds");
    assert_eq!(without.bounds.verdict, Consistency::Undecided, "without estimates");
    let late = of(DragLaw::Linear, DelayBound::KnownS(0.15));
    assert_ne!(enclose(&[&record], &late).expect("bounds").verdict, Consistency::Consistent);
}

#[test]
fn a_point_is_found_outside_of_the_box_from_which_the_descent_begins() {
    let known = Known::of(&LINEAR, 300, true);
    let contractor = Contractor::new(known.problem.clone());
    let from = known.about(0.01, 0.002);
    let inside = contractor.nearest(&from, &from).expect("a parameter");
    let outside = contractor.nearest(&from, &known.problem.search).expect("a parameter");
    assert!(!inside.is_feasible() && outside.is_feasible(), "{} and {}", inside.misfit, outside.misfit);
}

/// A reading that is three errors too high and one that is three too low: a parameter misses either by two to four.
#[test]
fn a_misfit_counts_readings_above_and_below() {
    let Known { problem, truth, .. } = Known::of(&LINEAR, 100, true);
    assert!(problem.misfit(&truth).expect("a motion") <= 1.0);
    for errors in [-3.0, 3.0] {
        let mut off = problem.clone();
        let readings = &mut off.records[0];
        readings.value[50] += errors * readings.error;
        let misfit = off.misfit(&truth).expect("a motion");
        assert!((2.0..=4.0).contains(&misfit), "{errors}: {misfit}");
    }
}
