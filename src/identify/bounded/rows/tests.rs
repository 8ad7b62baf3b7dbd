use super::super::contract::Origin;
use super::super::search::Search;
use super::super::setup::Setup;
use super::super::simulated::Vehicle;
use super::super::tests::{met, setup, truth};
use super::*;

#[test]
fn beginnings_drawn_in_by_their_readings_hold_the_truth_and_links_to_where_they_were_do_not() {
    let (setup, mut at) = setup(0.05);
    let (layout, truth) = (&setup.layout, truth(&setup));
    let velocities: Vec<usize> = (0..layout.windows().len()).map(|window| layout.start(window, 1)).collect();
    for &velocity in &velocities {
        at[velocity] = setup.search[velocity];
    }
    let search = Search::new(&setup);
    let centre: Vec<f64> = at.iter().map(|side| side.midpoint()).collect();
    let (mut given, mut drawn) = (at.clone(), at);
    search.model.chained(&mut given, centre.clone(), Starts::Given).expect("not empty").expect("an enclosure");
    let linear = search.model.chained(&mut drawn, centre.clone(), Starts::Drawn);
    let mut linear = linear.expect("not empty: the truth is inside").expect("an enclosure");
    assert!(drawn.iter().zip(&truth).all(|(side, value)| side.contains(*value)), "{drawn:?}");
    assert!(drawn[velocities[0]].width() < 0.2 * given[velocities[0]].width(), "{:?}", drawn[velocities[0]]);
    assert!(met(&linear, &truth, |_| true));
    let moved: Vec<usize> =
        velocities.iter().copied().filter(|place| linear.centre[*place] != centre[*place]).collect();
    assert!(moved.len() > 1, "no window but the first was followed anew");
    for place in moved {
        // As if the rows were still about the first middle.
        linear.centre[place] = centre[place];
    }
    assert!(!met(&linear, &truth, |origin| matches!(origin, Origin::Link { .. })));
}

#[test]
fn velocities_and_forces_behind_a_lag_are_drawn_in_about_the_same_middles() {
    const STEP: f64 = 1e-4;
    let vehicle = Vehicle { gain: 1.0, linear: 0.5, lag_rate: 4.0, ..Vehicle::default() };
    let motion = vehicle.motion(90);
    let setup = Setup::new(&[&Vehicle::record(&motion, STEP)], &vehicle.model(true, STEP)).expect("a problem");
    let truth = vehicle.truth(&setup, &motion);
    let mut at = setup.search.clone();
    for (side, value) in at.iter_mut().zip(&truth[..4]) {
        *side = Interval::point(*value) + Interval::symmetric(1e-4);
    }
    // Velocities far from the middle of what they may be, and forces with them.
    for window in 0..setup.layout.windows().len() {
        for (component, side) in [(1, [-1.5, 2.5]), (2, [-1.1, 1.1])] {
            let place = setup.layout.start(window, component);
            at[place] = Interval::new(side[0], side[1]).expect("an interval");
        }
    }
    let search = Search::new(&setup);
    let centre: Vec<f64> = at.iter().map(|side| side.midpoint()).collect();
    let linear = search.model.chained(&mut at, centre.clone(), Starts::Drawn);
    let linear = linear.expect("not empty: the truth is inside").expect("an enclosure");
    for (place, (side, value)) in at.iter().zip(&truth).enumerate() {
        assert!(side.contains(*value), "{place}: {value} outside of {side:?}");
    }
    assert!(met(&linear, &truth, |_| true));
    let first = [1, 2].map(|component| setup.layout.start(0, component));
    assert!(first.iter().all(|place| linear.centre[*place] != centre[*place]), "both are followed anew");
}
