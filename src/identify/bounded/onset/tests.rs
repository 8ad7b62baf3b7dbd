use super::super::problem::Readings;
use super::super::setup::Scales;
use super::super::simulated::{DRAG, Sample, Vehicle};
use super::super::{BoundedModel, DelayBound};
use super::*;

const QUANTUM: f64 = 0.01;
const SAMPLES: usize = 300;
/// Samples between two switchings.
const SWING: usize = 16;
const DELAYED: Vehicle = Vehicle { delayed: 5, ..DRAG };

fn case(delay_known: bool) -> (Setup, BoundedModel, Vec<Sample>) {
    let motion = DELAYED.motion(SAMPLES);
    let settings = DELAYED.model(delay_known, QUANTUM);
    let setup = Setup::new(&[&Vehicle::record(&motion, QUANTUM)], &settings).expect("a problem");
    (setup, settings, motion)
}

/// A box about the truth; its first unknown from so much of its width above it.
fn about(setup: &Setup, truth: &[f64], moved: f64) -> Vec<Interval> {
    let mut at = setup.search.clone();
    for place in 0..setup.layout.parameters() {
        let off = if place == 0 { moved } else { 0.0 };
        let width = 0.02 * truth[place].abs().max(0.1);
        let side = Interval::new(truth[place] + (off - 0.4) * width, truth[place] + (off + 0.6) * width);
        at[place] = side.and_then(|side| side.intersection(setup.search[place])).expect("it is looked for there");
    }
    at
}

#[test]
fn later_beginnings_hold_the_truth_and_those_of_which_a_reading_moved_do_not() {
    for delay_known in [true, false] {
        let (setup, settings, motion) = case(delay_known);
        for edge in [2, 5, 9] {
            let later = setup.after(&settings, edge).expect("there are readings after it");
            let beginnings = later.beginnings(&settings, SEARCHED).expect("long enough");
            // A window for every swing, and a reach of as many as the beginnings have.
            assert!(later.most_windows().abs_diff(SAMPLES / SWING - edge) <= 1, "{} windows", later.most_windows());
            assert_eq!(later.reaches(SEARCHED.swings)[0], 3);
            let (begin, end) = (beginnings.layout.windows()[0], beginnings.layout.windows().last().expect("windows"));
            let time_s = &beginnings.records[0].time_s;
            let instants = [begin.first, end.last].map(|sample| (10.0 * time_s[sample]).round() as usize);
            // From the switching on, up to the third after it.
            assert!(instants[0].abs_diff(SWING * (edge + 1)) <= 1, "edge {edge}: {instants:?}");
            assert!(instants[1].abs_diff(SWING * (edge + 4)) <= 1, "edge {edge}: {instants:?}");
            assert!(beginnings.samples() <= 3 * SWING + 2, "{} samples count", beginnings.samples());
            let truth = DELAYED.truth(&beginnings, &motion);
            let mut at = about(&beginnings, &truth, 0.0);
            Search::new(&beginnings).contract(&mut at, true).expect("the truth is inside");
            let inside = |place: usize| (at[place] + Interval::symmetric(1e-7)).contains(truth[place]);
            assert!(beginnings.layout.of_whole().into_iter().all(inside), "edge {edge}: {at:?}, {truth:?}");
            let mut wrong = beginnings.clone();
            let middle = usize::midpoint(begin.first, end.last);
            wrong.records[0].value[middle] += 20.0 * QUANTUM;
            let mut at = about(&wrong, &truth, 0.0);
            let left = Search::new(&wrong).contract(&mut at, true);
            assert!(left.is_err() || !inside_all(&at, &truth, wrong.layout.parameters()), "edge {edge}: {at:?}");
        }
        assert!(setup.after(&settings, 400).is_none() && setup.after(&settings, 17).is_none(), "nothing is left");
    }
    let (setup, settings, _) = case(false);
    let delayed = BoundedModel { delay: DelayBound::WithinS([0.0, 3.0]), ..settings };
    let late = Setup::of(setup.records.clone(), &delayed, &[Scales::of(&setup.records[0])]).expect("a problem");
    assert!(late.after(&delayed, 0).is_none(), "the command that acts there is not in the log");
    assert!(late.after(&delayed, 1).is_some());
}

fn inside_all(at: &[Interval], truth: &[f64], parameters: usize) -> bool {
    at.iter().zip(truth).take(parameters).all(|(side, value)| side.contains(*value))
}

#[test]
fn what_is_left_out_of_a_record_is_what_came_before() {
    let (setup, ..) = case(true);
    let readings: &Readings = &setup.records[0];
    let skipped = [0, 1, SWING - 1, SWING, 2 * SWING - 1, 2 * SWING, 5 * SWING].map(|onset| readings.skipped(onset));
    assert_eq!(skipped, [0, 0, 0, 0, 0, 1, 4]);
    let later = readings.from(7);
    assert_eq!((later.time_s[0], later.value[0]), (readings.time_s[7], readings.value[7]));
    assert_eq!((later.value.len(), later.command.edges()), (SAMPLES - 7, readings.command.edges()));
}

/// The logarithm of the product of the parameters' ranges that a search of the beginnings leaves.
fn searched(setup: &Setup, settings: &BoundedModel) -> f64 {
    let beginnings = setup.beginnings(settings, SEARCHED).expect("long enough");
    let division = Search::new(&beginnings).search(beginnings.search.clone(), 10_000);
    let hull = division.hull().expect("the truth is inside");
    hull.iter().take(beginnings.layout.parameters()).map(|side| side.width().ln()).sum()
}

#[test]
fn where_the_search_begins_less_is_left_than_at_the_records_beginning() {
    let motion = DELAYED.motion(SAMPLES);
    let settings = DELAYED.model(false, QUANTUM);
    let (mut later, mut less) = (0, 0);
    for shift in 0..6 {
        // Other readings are rounded up, and down.
        let shifted: Vec<Sample> =
            motion.iter().map(|([x, v, f], u)| ([x + 0.23 * QUANTUM * f64::from(shift), *v, *f], *u)).collect();
        let setup = Setup::new(&[&Vehicle::record(&shifted, QUANTUM)], &settings).expect("a problem");
        let truth = DELAYED.truth(&setup, &shifted);
        let Some(found) = Search::new(&setup).later_about(&settings, &truth) else { continue };
        later += 1;
        assert!(found.onset[0] > SWING && found.onset[0] <= SAMPLES / 2 + SWING, "from {}", found.onset[0]);
        less += usize::from(searched(&found, &settings) < searched(&setup, &settings));
    }
    assert!(later >= 3 && less == later, "{less} of {later}");
}
