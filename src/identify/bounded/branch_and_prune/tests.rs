use super::super::simulated::{Known, LINEAR};
use super::*;

#[test]
fn boxes_that_are_left_contain_the_truth_and_none_is_left_beside_it() {
    let known = Known::of(&LINEAR, 300, true);
    let mut contractor = Contractor::new(known.problem.clone());
    let found = contractor.prune(known.problem.search.clone(), 2000);
    assert!(found.complete);
    let holds = |kept: &Kept| kept.at.iter().zip(&known.truth).all(|(side, value)| side.contains(*value));
    assert!(found.kept.iter().any(holds));
    let budget = contractor.passes() + 2000;
    assert!(contractor.prune(known.about(0.05, 0.01), budget).kept.is_empty());
}
