use super::super::contract::Origin;
use super::super::search::Search;
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
