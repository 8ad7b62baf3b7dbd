use super::super::problem::Problem;
use super::super::tests::{ALPHA, BETA, DELTA, off, record, settings};
use super::*;
use crate::identify::DragLaw;

#[test]
fn the_widest_box_comes_first_and_of_two_as_wide_the_later() {
    let open = |number: usize| OpenBox { at: vec![Interval::point(number as f64)], modulating: true };
    let mut queue = Queue::default();
    for (number, width) in [0.3, f64::INFINITY, 0.0, 2.0, 0.3].into_iter().enumerate() {
        queue.push(width, open(number));
    }
    let order: Vec<f64> = core::iter::from_fn(|| queue.pop()).map(|open| open.at[0].lower()).collect();
    assert_eq!(order, [1.0, 3.0, 4.0, 0.0, 2.0]);
}

#[test]
fn boxes_that_are_left_contain_the_truth_and_none_is_left_beside_it() {
    let problem = Problem::new(&[&record(300)], &settings(DragLaw::Linear)).expect("a problem");
    let mut contractor = Contractor::new(problem.clone());
    let found = contractor.prune(problem.search.clone(), 2000);
    assert!(found.complete);
    let truth = [1.0 / ALPHA, BETA / ALPHA, DELTA / ALPHA];
    let holds = |kept: &Kept| kept.at.iter().zip(truth).all(|(side, value)| side.contains(value));
    assert!(found.kept.iter().any(holds));
    let budget = contractor.passes() + 2000;
    assert!(contractor.prune(off(&problem, 0.05, 0.01), budget).kept.is_empty());
}
