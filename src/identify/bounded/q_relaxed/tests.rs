//! Readings moved at will: found, granted, and too many of them.

use super::super::answer::{Consistency, Outlier, Quantity};
use super::super::settings::BoundedModel;
use super::super::{enclose, tests};
use super::pairs;
use crate::experiment::Record;
use crate::identify::DragLaw;
use crate::identify::bounded::Bounds;

const SAMPLES: usize = 150;

/// The record of known truth with some readings moved by so many steps.
fn moved(by: &[(usize, f64)]) -> Record {
    let record = tests::record(SAMPLES);
    let mut output = record.output().to_vec();
    for (sample, steps) in by {
        output[*sample] += steps * tests::STEP;
    }
    Record::new(record.time_s().to_vec(), output, record.input().to_vec()).expect("a record")
}

fn bounds(by: &[(usize, f64)], outliers: usize) -> Bounds {
    let model = BoundedModel { outliers, ..tests::settings(DragLaw::Linear) };
    enclose(&[&moved(by)], &model).expect("bounds")
}

fn holds_the_truth(bounds: &Bounds) -> bool {
    [(Quantity::Alpha, tests::ALPHA), (Quantity::Beta, tests::BETA), (Quantity::Delta(0), tests::DELTA)]
        .into_iter()
        .all(|(quantity, value)| bounds.of(quantity).is_some_and(|[low, high]| low <= value && value <= high))
}

fn width(bounds: &Bounds) -> f64 {
    bounds.of(Quantity::Alpha).map_or(f64::INFINITY, |[low, high]| high - low)
}

fn samples(bounds: &Bounds) -> Vec<usize> {
    bounds.outliers.iter().map(|Outlier { sample, .. }| *sample).collect()
}

#[test]
fn two_of_two_are_found_and_the_bounds_are_those_without_them() {
    let two = bounds(&[(40, 6.0), (101, -50.0)], 2);
    assert_eq!(two.verdict, Consistency::Consistent);
    assert_eq!(samples(&two), [40, 101]);
    assert!(holds_the_truth(&two));
    let none = bounds(&[], 0);
    let wider = width(&two) / width(&none);
    assert!(wider < 1.2, "{wider} times as wide as those of all readings");
}

#[test]
fn fewer_allowed_than_there_are_refute_the_model() {
    let mut shown = 0;
    for steps in [1.2, 1.5, 3.0, 50.0] {
        let by = [(40, steps), (101, -steps)];
        for allowed in [0, 1] {
            let found = bounds(&by, allowed);
            assert_eq!(found.verdict, Consistency::Refuted, "{allowed} allowed, {steps} steps");
            assert!(found.bounds.is_empty());
            // A contradiction has one of them in it; a reading far off contradicts speeds alone, and none is shown.
            let contradicting: Vec<usize> = found.contradicting.iter().map(|part| part.sample).collect();
            let known = contradicting.iter().any(|part| by.iter().any(|(sample, _)| sample == part));
            assert!(known || contradicting.is_empty(), "{contradicting:?} are without any of them");
            shown += usize::from(known);
        }
    }
    assert!(shown > 0, "no contradiction was shown");
}

#[test]
fn a_reading_that_need_not_be_an_outlier_is_not_called_one() {
    let bare = bounds(&[], 0);
    for (sample, steps) in [(0, 0.0), (70, 1.0), (12, -2.0)] {
        let by: &[(usize, f64)] = if steps == 0.0 { &[] } else { &[(sample, steps)] };
        let one = bounds(by, 1);
        assert_ne!(one.verdict, Consistency::Refuted);
        assert!(holds_the_truth(&one), "sample {sample} moved by {steps} steps");
        assert!(samples(&one).iter().all(|found| *found == sample && steps != 0.0), "{:?}", one.outliers);
        // Granting more keeps all that fewer keep.
        let [[low, high], own] = [&bare, &one].map(|bounds| bounds.of(Quantity::Alpha).expect("a range"));
        assert!(own[0] <= low + 0.1 * (high - low) && high - 0.1 * (high - low) <= own[1]);
    }
}

#[test]
fn the_truth_is_inside_whatever_the_budget() {
    for budget in [0, 1, 5, 20] {
        let model = BoundedModel { outliers: 2, budget, ..tests::settings(DragLaw::Linear) };
        let found = enclose(&[&moved(&[(40, 6.0), (101, -50.0)])], &model).expect("bounds");
        assert!(holds_the_truth(&found), "budget {budget}: {:?}", found.bounds);
        assert_ne!(found.verdict, Consistency::Refuted);
    }
}

#[test]
fn of_two_more_groups_than_outliers_two_are_free_of_them_and_of_one_more_not() {
    let free = |groups: usize, spoilt: &[usize]| pairs(groups).any(|pair| spoilt.iter().all(|one| !pair.contains(one)));
    for outliers in 1..5 {
        let spoilt: Vec<usize> = (0..outliers).collect();
        assert!(free(outliers + 2, &spoilt));
        assert!(!free(outliers + 1, &spoilt));
    }
}

#[test]
fn more_than_the_record_bears_are_refused() {
    let model = BoundedModel { outliers: 6, ..tests::settings(DragLaw::Linear) };
    let refused = enclose(&[&moved(&[])], &model).expect_err("six of 150");
    assert!(refused.to_string().contains("5 or less"), "{refused}");
}
