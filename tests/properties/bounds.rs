//! Guaranteed bounds of records of known truth, with and without readings that are moved at will.

use selfosc::experiment::Record;
use selfosc::identify::DragLaw;
use selfosc::identify::bounded::{BoundedModel, Bounds, Consistency, DelayBound, Outlier, Quantity, enclose};

const ALPHA: f64 = 1.3;
const BETA: f64 = 0.6;
const DELTA: f64 = 0.1;
const STEP: f64 = 0.02;
const TURN_S: f64 = 2.0;
/// Bounds that differ by less of their width are the same.
const SAME: f64 = 0.01;

/// Linear drag under a square wave, by the solution in closed form: time, position, velocity and command at every sample.
fn motion(samples: usize) -> Vec<[f64; 4]> {
    let (mut x, mut v) = (0.0f64, 0.2f64);
    let h = 0.1;
    let advance = |sample: usize| {
        let now = sample as f64 * h;
        // Just after a switching instant, however the product rounds.
        let u = if ((now + 1e-9) / TURN_S).floor() % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let here = [now, x, v, u];
        let (rate, terminal) = (BETA / ALPHA, (u + DELTA) / BETA);
        let decay = (-rate * h).exp();
        x += terminal * h + (v - terminal) * (1.0 - decay) / rate;
        v = terminal + (v - terminal) * decay;
        here
    };
    (0..samples).map(advance).collect()
}

/// The same, rounded to steps of `STEP`.
pub(crate) fn record(samples: usize) -> Record {
    let motion = motion(samples);
    let of = |value: &dyn Fn(&[f64; 4]) -> f64| motion.iter().map(value).collect();
    Record::new(of(&|[now, ..]| *now), of(&|[_, x, ..]| (x / STEP).round() * STEP), of(&|[.., u]| *u))
        .expect("a record")
}

pub(crate) fn settings(law: DragLaw) -> BoundedModel {
    BoundedModel { quantum: Some(STEP), ..BoundedModel::new(law, DelayBound::KnownS(0.0)) }
}

#[test]
fn the_truth_is_inside_from_a_wide_start() {
    let wide = enclose(&[&record(300)], &settings(DragLaw::Linear)).expect("bounds");
    assert_eq!(wide.verdict, Consistency::Consistent);
    for (quantity, value) in [(Quantity::Alpha, ALPHA), (Quantity::Beta, BETA), (Quantity::Delta(0), DELTA)] {
        let [low, high] = wide.of(quantity).expect("a range");
        assert!(low <= value && value <= high, "{quantity}: {value} outside [{low}, {high}]");
    }
}

#[test]
fn a_wide_start_and_a_near_one_end_in_the_same_bounds() {
    let record = record(300);
    let near = BoundedModel { reach: 5.0, ..settings(DragLaw::Linear) };
    let [wide, near] = [settings(DragLaw::Linear), near].map(|model| enclose(&[&record], &model).expect("bounds"));
    for quantity in [Quantity::Alpha, Quantity::Beta] {
        let [[low, high], other] = [&wide, &near].map(|bounds| bounds.of(quantity).expect("a range"));
        let apart = (low - other[0]).abs().max((high - other[1]).abs()) / (high - low);
        assert!(apart < SAME, "{quantity}: [{low}, {high}] and {other:?}, {apart} of the width apart");
    }
}

/// A vehicle that obeys `v' = acceleration(v, u)`, u the logged relay's 0.4 s ago and at first what acted before the log; rounded to a
/// hundredth.
fn vehicle(acceleration: impl Fn(f64, f64) -> f64, before: f64) -> Record {
    const INTERVAL_S: f64 = 0.1;
    const PARTS: usize = 100;
    const DELAYED: usize = 4;
    let command = |sample: usize| if (sample / 15).is_multiple_of(2) { 1.0 } else { -1.0 };
    let (mut position, mut velocity, h) = (0.0, 0.0, INTERVAL_S / PARTS as f64);
    let (mut time_s, mut output, mut input) = (Vec::new(), Vec::new(), Vec::new());
    for sample in 0..300 {
        time_s.push(INTERVAL_S * sample as f64);
        output.push((100.0f64 * position).round() / 100.0);
        input.push(command(sample));
        let u = if sample < DELAYED { before } else { command(sample - DELAYED) };
        for _ in 0..PARTS {
            let middle = velocity + 0.5 * h * acceleration(velocity, u);
            position += h * middle;
            velocity += h * acceleration(middle, u);
        }
    }
    Record::new(time_s, output, input).expect("a record")
}

#[test]
fn what_acted_before_the_log_may_have_been_anything() {
    for before in [-6.0, 1.0, 40.0] {
        let record = vehicle(|v, u| u - 0.5 * v, before);
        let model = BoundedModel { delay: DelayBound::KnownS(0.4), quantum: Some(0.01), ..settings(DragLaw::Linear) };
        let found = enclose(&[&record], &model).expect("bounds");
        let [low, high] = found.of(Quantity::Alpha).expect("bounds of alpha");
        assert!(found.verdict == Consistency::Consistent && low <= 1.0 && 1.0 <= high, "{before}: {found:?}");
    }
}

#[test]
fn quadratic_and_cubic_drag_without_a_linear_one_are_found() {
    let record = vehicle(|v, u| u - 0.5 * v * v.abs() - 0.3 * v * v * v, 1.0);
    let model = BoundedModel {
        delay: DelayBound::KnownS(0.4),
        quantum: Some(0.01),
        cubic: true,
        ..settings(DragLaw::Quadratic)
    };
    let found = enclose(&[&record], &model).expect("bounds");
    for (quantity, truth) in [(Quantity::Alpha, 1.0), (Quantity::BetaQuadratic, 0.5), (Quantity::BetaCubic, 0.3)] {
        let [low, high] = found.of(quantity).expect("bounds");
        assert!(found.verdict == Consistency::Consistent && low <= truth && truth <= high, "{quantity:?}: {found:?}");
    }
}

const SAMPLES: usize = 150;

/// The record of known truth with some readings moved by so many steps.
fn moved(by: &[(usize, f64)]) -> Record {
    let record = record(SAMPLES);
    let mut output = record.output().to_vec();
    for (sample, steps) in by {
        output[*sample] += steps * STEP;
    }
    Record::new(record.time_s().to_vec(), output, record.input().to_vec()).expect("a record")
}

fn bounds(by: &[(usize, f64)], outliers: usize) -> Bounds {
    let model = BoundedModel { outliers, ..settings(DragLaw::Linear) };
    enclose(&[&moved(by)], &model).expect("bounds")
}

fn holds_the_truth(bounds: &Bounds) -> bool {
    [(Quantity::Alpha, ALPHA), (Quantity::Beta, BETA), (Quantity::Delta(0), DELTA)]
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
        let model = BoundedModel { outliers: 2, budget, ..settings(DragLaw::Linear) };
        let found = enclose(&[&moved(&[(40, 6.0), (101, -50.0)])], &model).expect("bounds");
        assert!(holds_the_truth(&found), "budget {budget}: {:?}", found.bounds);
        assert_ne!(found.verdict, Consistency::Refuted);
    }
}

#[test]
fn more_than_the_record_bears_are_refused() {
    let model = BoundedModel { outliers: 6, ..settings(DragLaw::Linear) };
    let refused = enclose(&[&moved(&[])], &model).expect_err("six of 150");
    assert!(refused.to_string().contains("5 or less"), "{refused}");
}
