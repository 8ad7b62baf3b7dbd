use super::super::super::tests::{record, settings};
use super::*;
use crate::identify::DragLaw;

/// The lower half of what is searched of the first unknown, in a frame around another range of it.
fn framed(setup: &Setup, range: impl Fn(Interval, Interval) -> Interval) -> Open {
    let (mut at, mut around) = (setup.search.clone(), setup.search.clone());
    let side = at[0];
    at[0] = Interval::new(side.lower(), side.midpoint()).expect("ordered");
    around[0] = range(side, at[0]);
    let slanted = Some(Slanted::straight(&setup.layout, &around));
    Open { at, slanted, weighed: true, level: 0, met: usize::MAX }
}

#[test]
fn a_box_is_met_with_its_frame_before_it_is_divided() {
    let setup = Setup::new(&[&record(300)], &settings(DragLaw::Linear)).expect("a setup");
    let all = setup.most_windows();
    let mut prover = Prover::of(&setup, &setup, &[all], &Goal::Nothing, 1.0, f64::INFINITY);
    let above = |side: Interval, low: Interval| Interval::new(low.upper() + 0.1 * side.width(), side.upper());
    let mut apart = framed(&setup, |side, low| above(side, low).expect("ordered"));
    // A check finds nothing in it, and so no division.
    assert!(matches!(prover.part(&mut apart, Widest::Unknown(0)), Ok(None)));
    assert!(matches!(prover.steps[..], [Step::Keep]));
    let mut quarter = framed(&setup, |side, low| Interval::new(side.lower(), low.midpoint()).expect("ordered"));
    let parts = prover.part(&mut quarter, Widest::Unknown(0)).expect("a division").expect("something in common");
    let quarter = setup.search[0].lower() + 0.26 * setup.search[0].width();
    assert!(parts.iter().all(|part| part.at[0].upper() < quarter), "{:?}", parts.map(|part| part.at[0]));
    assert!(matches!(prover.steps[..], [Step::Keep, Step::Divide { unknown: 0, .. }]));
}
