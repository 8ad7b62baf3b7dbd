use super::super::contract::Linear;
use super::super::rows::Starts;
use super::super::setup::Setup;
use super::super::tests::{ALPHA, BETA, DELTA, off, record, settings};
use super::*;
use crate::identify::DragLaw;

#[test]
fn whole_records_tell_more_than_their_windows_and_are_tried_where_not_too_much_is_in_doubt_of_these() {
    let setup = Setup::new(&[&record(150)], &settings(DragLaw::Linear)).expect("a problem");
    let mut search = Search::new(&setup);
    let at = off(&setup, 0.0, 0.003);
    let kept = search.unbroken(&at, 1.0).expect("the truth is inside").expect("little is in doubt");
    let Left::Followed { slack, .. } = kept.left else { panic!("not followed") };
    let centre = at.iter().map(|side| side.midpoint()).collect();
    let linear =
        search.chained(&mut at.clone(), centre, Starts::Given).expect("the truth is inside").expect("an enclosure");
    assert!(slack < 0.1 * search.slack(&linear).0, "{slack} of {}", search.slack(&linear).0);
    let truth = [1.0 / ALPHA, BETA / ALPHA, DELTA / ALPHA];
    assert!(kept.slanted.is_some() && kept.at.iter().zip(truth).all(|(side, value)| side.contains(value)));
    assert!(search.unbroken(&at, 10.0).expect("the truth is inside").is_none());
    // Nothing meets the readings one per cent off.
    assert!(search.unbroken(&off(&setup, 0.01, 0.002), 1.0).is_err());
}

#[test]
fn what_two_divisions_left_and_excluded_is_joined() {
    let part = |end: f64, followed: bool| {
        let mut part = Division::new();
        let linear = Some(Linear { centre: vec![end], ..Linear::default() });
        part.exclude(Empty { method: Method::Chain, multipliers: Vec::new(), linear });
        let at = vec![Interval::new(0.0, end).expect("ordered")];
        part.kept.push(Kept { at, left: Left::Wide(0), slanted: None });
        Division { followed, ..part }
    };
    for (followed, other) in [(true, false), (false, true), (true, true)] {
        let mut all = part(1.0, followed);
        all.join(part(2.0, other));
        assert_eq!(all.followed, followed && other);
        let centres = all.empties.iter().filter_map(|empty| empty.linear.as_ref().map(|linear| linear.centre[0]));
        assert_eq!(centres.collect::<Vec<f64>>(), [1.0, 2.0]);
        assert_eq!(all.kept.iter().map(|kept| kept.at[0].upper()).collect::<Vec<f64>>(), [1.0, 2.0]);
    }
}

#[test]
fn the_widest_box_comes_first_and_of_two_as_wide_the_later() {
    let part = |number: usize| Part { at: vec![Interval::point(number as f64)], wide: true };
    let mut queue = Queue::default();
    for (number, width) in [0.3, f64::INFINITY, 0.0, 2.0, 0.3].into_iter().enumerate() {
        queue.push(width, part(number));
    }
    let order: Vec<f64> = core::iter::from_fn(|| queue.pop()).map(|part| part.at[0].lower()).collect();
    assert_eq!(order, [1.0, 3.0, 4.0, 0.0, 2.0]);
}
