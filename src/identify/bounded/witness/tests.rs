use super::super::explore::explore;
use super::super::setup::Setup;
use super::super::tests::{ALPHA, off, oscillation, record, settings};
use super::super::{BoundedModel, Consistency, DelayBound, Quantity, enclose};
use super::*;
use crate::identify::DragLaw;
use crate::plant::DragAxis;

#[test]
fn witnesses_are_found_towards_both_ends_of_the_bounds() {
    let record = oscillation(DragAxis::mixed(1.2, 0.5, 0.4).expect("an axis"), 10.0, 25.0);
    let setup = Setup::new(&[&record], &settings(DragLaw::Mixed)).expect("a problem");
    let mut search = Search::new(&setup);
    let division = search.search(setup.search.clone(), 600);
    let hull = division.hull().expect("not empty: the truth is inside");
    let witness = search.nearest(&hull, &hull).filter(|tried| tried.misfit <= 1.0).expect("a witness");
    for place in 0..setup.layout.common() {
        let [low, high] = [-1.0, 1.0].map(|sign| search.furthest(&witness, &hull, place, sign).expect("a witness"));
        assert!(low.misfit <= 1.0 && high.misfit <= 1.0);
        let reached = (high.at[place] - low.at[place]) / hull[place].width();
        assert!(reached > 0.05, "unknown {place}: witnesses reach over {reached} of the bounds");
    }
}

#[test]
fn a_witness_is_found_about_the_fit_where_division_has_hardly_begun_and_none_where_there_is_none() {
    let record = record(300);
    let brief = BoundedModel { budget: 1, delay: DelayBound::Unknown, ..settings(DragLaw::Mixed) };
    let found = enclose(&[&record], &brief).expect("bounds");
    assert_eq!(found.verdict, Consistency::Consistent);
    let [low, high] = found.of(Quantity::Alpha).expect("a range");
    assert!(low <= ALPHA && ALPHA <= high && high > 2.0 * low, "[{low}, {high}] after one pass");
    let setup = Setup::new(&[&record], &brief).expect("a problem");
    let without = explore(&setup, &brief, || None, |_, _| ()).expect("bounds");
    assert_eq!(without.bounds.verdict, Consistency::Undecided, "without estimates");
    let late = BoundedModel { delay: DelayBound::KnownS(0.15), budget: 1, ..settings(DragLaw::Linear) };
    assert_ne!(enclose(&[&record], &late).expect("bounds").verdict, Consistency::Consistent);
}

#[test]
fn a_witness_is_found_outside_of_the_box_that_a_step_is_as_wide_as() {
    let setup = Setup::new(&[&record(300)], &settings(DragLaw::Linear)).expect("a problem");
    let mut search = Search::new(&setup);
    let from = off(&setup, 0.01, 0.002);
    let inside = search.nearest(&from, &from).expect("a parameter");
    let outside = search.nearest(&from, &setup.search).expect("a parameter");
    assert!(inside.misfit > 1.0 && outside.misfit <= 1.0, "{} and {}", inside.misfit, outside.misfit);
}

#[test]
fn whole_records_lead_to_as_small_a_misfit_as_windows_for_fewer_passes() {
    let setup = Setup::new(&[&record(300)], &settings(DragLaw::Linear)).expect("a problem");
    let from = off(&setup, 0.001, 0.002);
    let (mut whole, mut windows) = (Search::new(&setup), Search::new(&setup));
    let near = whole.nearest(&from, &setup.search).expect("a parameter");
    let other = windows.nearest_by_windows(&from, &setup.search).expect("a parameter");
    assert!(near.misfit <= 1.0 && near.misfit < 1.001 * other.misfit, "{} and {}", near.misfit, other.misfit);
    assert!(whole.passes < windows.passes, "{} and {} passes", whole.passes, windows.passes);
}
