use super::super::search::Search;
use super::super::setup::{SEARCHED, Setup};
use super::super::simulated::{DRAG, Vehicle};
use super::*;
use crate::identify::bounded::contract::{Linear, Span};
use crate::identify::bounded::mix::Mix;
use crate::identify::bounded::trajectory::Unknowns;
use crate::numeric::{Interval, Real};

const QUANTUM: f64 = 0.01;

fn setup_of(vehicle: &Vehicle) -> (Setup, Vec<f64>) {
    let motion = vehicle.motion(300);
    let setup = Setup::new(&[&Vehicle::record(&motion, QUANTUM)], &vehicle.model(true, QUANTUM)).expect("a problem");
    let truth = vehicle.truth(&setup, &motion);
    (setup, truth)
}

#[test]
fn clones_count_together_and_each_search_by_itself() {
    let effort = Effort::default();
    effort.clone().pivot(100);
    effort.slopes(1000);
    assert!((effort.us() - 100.0 * PIVOT_US - 1000.0 * SLOPE_US).abs() < 1e-9);
    assert!(Effort::default().us() == 0.0);
}

#[test]
fn a_motion_takes_its_steps_and_samples_and_more_with_polynomials() {
    let taken = |vehicle: &Vehicle| {
        let (setup, truth) = setup_of(vehicle);
        let search = Search::new(&setup);
        let whole = Span { from: 0, to: setup.layout.windows().len() };
        search.model.outputs(whole, &truth).expect("an enclosure");
        let of_point = search.model.effort.us();
        // About as many samples as steps, of a point no more than one and a half microseconds each.
        assert!(of_point > 300.0 * NODE_US && of_point < 300.0 * (NODE_US + 3.0 * POINT_US), "{of_point} us");
        let mut at = setup.search.clone();
        for (side, value) in at.iter_mut().zip(&truth) {
            *side = Interval::point(*value).inflate(1e-5);
        }
        search.model.motion(Span { from: 0, to: 1 }, &at, &truth).expect("an enclosure");
        search.model.effort.us() - of_point
    };
    let closed = taken(&DRAG);
    let series = taken(&Vehicle { stiffness: 0.3, ..DRAG });
    assert!(closed > 0.0 && series > 1.5 * closed, "{closed} and {series} us");
}

#[test]
fn what_a_search_takes_counts_as_passes_and_over_part_of_the_records_as_its_part() {
    let (setup, _) = setup_of(&DRAG);
    let beginnings = setup.beginnings(&DRAG.model(true, QUANTUM), SEARCHED).expect("long enough");
    let passes = 1000.0;
    let us = passes * (PASS_US + PASS_SAMPLE_US * setup.samples() as f64);
    let counted = |mut search: Search<'_>| {
        search.model.effort.take(us);
        search.count_pass();
        search.passes as f64
    };
    let whole = counted(Search::new(&setup));
    assert!((whole - passes).abs() <= 1.0, "{whole}");
    let part = counted(Search::new(&beginnings).part_of(&setup));
    let share = beginnings.samples() as f64 / setup.samples() as f64;
    assert!(share < 0.5 && (share * part - passes).abs() <= 1.0, "{part} of {share}");
    let after = counted(Search::new(&setup).after(70));
    assert!((after - passes - 70.0).abs() <= 1.0, "{after}");
}

#[test]
fn hats_bends_and_linear_programmes_take_their_part() {
    let (setup, truth) = setup_of(&DRAG);
    let mut search = Search::new(&setup);
    let effort = search.model.effort.clone();
    search.weigh(&mut setup.search.clone()).expect("the truth is inside");
    let by_hats = effort.us();
    assert!(by_hats > WEIGHED_US * setup.samples() as f64, "{by_hats} us with a linear programme");
    let near = |value: f64| Interval::point(value).inflate(1e-5);
    let at: Vec<Interval> = truth.iter().map(|value| near(*value)).collect();
    let whole = Span { from: 0, to: setup.layout.windows().len() };
    let taken = |bending: bool| {
        let (by, places) = setup.layout.columns(0);
        let mixes: Vec<Mix> = by.iter().map(|by| Mix::of([(*by, 1.0)])).collect();
        let deviations: Vec<Interval> =
            places.iter().map(|place| at[*place] - Interval::point(truth[*place])).collect();
        let before = effort.us();
        let unknowns = Unknowns { mixes: &mixes, deviations: &deviations, bending };
        search.model.follow(whole, &at, &truth, unknowns, &search.model.times(whole)).expect("an enclosure");
        effort.us() - before
    };
    let [straight, bent] = [false, true].map(taken);
    assert!(bent > 1.05 * straight, "{straight} and {bent} us");
    let linear = Linear {
        effort: Effort::default(),
        deviations: vec![Interval::symmetric(1.0); 2],
        centre: vec![0.0; 2],
        ..Linear::default()
    };
    let mut rows = linear.clone();
    rows.rows.slopes = vec![vec![(0, Interval::ONE), (1, Interval::ONE)]];
    rows.rows.limits = vec![0.5];
    rows.programme(&[0, 1]).maximise(&[(0, 1.0), (1, 1.0)]);
    assert!(linear.effort.us() >= 2.0 * SLOPE_US + 2.0 * PIVOT_US, "{} us", linear.effort.us());
}
