use super::super::certificate::Certificate;
use super::super::search::Left;
use super::super::simulated::{DRAG, Vehicle};
use super::super::{Consistency, DelayBound};
use super::*;

const QUANTUM: f64 = 0.005;
const SAMPLES: usize = 300;
const DELAYED: Vehicle = Vehicle { delayed: 5, ..DRAG };

/// What the fit says, to within this share.
fn estimates(share: f64) -> Estimates {
    let near = |value: f64| value * (1.0 + share);
    Some(vec![
        (Quantity::Alpha, near(1.0 / DELAYED.gain)),
        (Quantity::Beta, near(DELAYED.linear / DELAYED.gain)),
        (Quantity::BetaQuadratic, near(DELAYED.quadratic / DELAYED.gain)),
        (Quantity::DelayS, near(0.025)),
        (Quantity::Delta(0), near(DELAYED.disturbance / DELAYED.gain)),
    ])
}

#[test]
fn from_wherever_the_search_begins_the_truth_is_inside_and_the_bounds_are_the_same() {
    let motion = DELAYED.motion(SAMPLES);
    let record = Vehicle::record(&motion, QUANTUM);
    let settings = BoundedModel { delay: DelayBound::Unknown, ..DELAYED.model(false, QUANTUM) };
    let setup = Setup::new(&[&record], &settings).expect("a problem");
    let truth = DELAYED.truth(&setup, &motion);
    let mut ends = Vec::new();
    for edge in [None, Some(3), Some(7)] {
        let begun = edge.map(|edge| setup.after(&settings, edge).expect("there are readings after it"));
        let begun = begun.unwrap_or_else(|| setup.clone());
        let beginnings = begun.beginnings(&settings, SEARCHED).expect("long enough");
        let division = Search::new(&beginnings).search(beginnings.search.clone(), 20_000);
        let boxes = begun.boxes(&beginnings, &division);
        let division = Search::new(&begun).follow_further(boxes, &begun.reaches(SEARCHED.swings), settings.budget);
        assert!(division.followed);
        let hull = division.hull().expect("the truth is inside");
        let all = setup.narrowed(&settings, &hull).expect("a problem");
        assert!(all.onset == [0] && all.layout.windows()[0].first < SAMPLES / 10, "readings before are not heard");
        let start = led(&all, &begun, &settings, &division).expect("a frame");
        // It holds the truth, and one whose frame is not moved with its centre does not.
        let own = DELAYED.truth(&all, &motion);
        let mut frame = start.slanted.clone().expect("a frame").frame;
        frame.z.iter_mut().for_each(|z| *z += Interval::symmetric(1e-7));
        assert!(frame.holds(&own, 0.0), "{edge:?}");
        assert!(!frame.holds(&own, 0.5), "{edge:?}: with half as much gain besides");
        let mut search = Search::new(&all);
        let left = search.follow_further(vec![start], &all.reaches(SEARCHED.swings), settings.budget);
        let (bounds, hull) = conclude(&setup, search, left, &settings, &Box::new(estimates(0.0)), |_, _| ());
        assert_eq!(bounds.verdict, Consistency::Consistent);
        let hull = hull.expect("the truth is inside");
        let inside = |place: usize| (hull[place] + Interval::symmetric(1e-7)).contains(truth[place]);
        assert!((0..setup.layout.parameters()).all(inside), "{edge:?}: {hull:?}, {truth:?}");
        ends.push(bounds.of(Quantity::Alpha).expect("a range"));
    }
    let width = ends[0][1] - ends[0][0];
    for [low, high] in &ends {
        let apart = (low - ends[0][0]).abs().max((high - ends[0][1]).abs());
        assert!(apart < 0.02 * width, "{ends:?}");
    }
}

#[test]
fn a_search_without_patience_begins_where_estimates_say_and_without_any_where_the_record_does() {
    let motion = DELAYED.motion(SAMPLES);
    let settings = DELAYED.model(false, QUANTUM);
    let setup = Setup::new(&[&Vehicle::record(&motion, QUANTUM)], &settings).expect("a problem");
    let with = |estimates: Estimates, patience: usize| begin(&setup, &settings, &Box::new(estimates), patience);
    let moved = with(estimates(0.001), 1);
    let patient = with(estimates(0.001), 20_000);
    let (alone, unmoved) = (with(None, 1), with(None, 20_000));
    assert!(matches!(moved.setup, Cow::Owned(_)) && moved.setup.onset[0] > 0);
    for begun in [&patient, &alone, &unmoved] {
        assert!(matches!(begun.setup, Cow::Borrowed(_)));
    }
    let impatient = with(estimates(0.001), 60);
    assert!(matches!(impatient.setup, Cow::Owned(_)) && impatient.spent > moved.spent, "what was in vain counts");
    let known = DELAYED.model(true, QUANTUM);
    let of_known = Setup::new(&[&Vehicle::record(&motion, QUANTUM)], &known).expect("a problem");
    assert!(matches!(begin(&of_known, &known, &Box::new(estimates(0.001)), 1).setup, Cow::Borrowed(_)));
    let hull = |begun: &Begun<'_>| {
        let boxes = begun.boxes.iter().map(|kept| kept.at.clone());
        super::super::divide::around(boxes).expect("the truth is inside")
    };
    let truth = DELAYED.truth(&setup, &motion);
    for begun in [&moved, &patient, &alone, &unmoved] {
        let hull = hull(begun);
        assert!((0..setup.layout.parameters()).all(|place| hull[place].contains(truth[place])), "{hull:?}");
        assert!(begun.spent > 0);
    }
    // What is worked off after a budget was spent is what is worked off at once.
    let [gone_on, at_once] = [hull(&alone)[0], hull(&unmoved)[0]];
    assert!((gone_on.width() / at_once.width() - 1.0).abs() < 0.2, "{gone_on:?}, {at_once:?}");
}

#[test]
fn boxes_that_are_done_stay_where_a_search_goes_on() {
    let motion = DELAYED.motion(SAMPLES);
    let settings = DELAYED.model(false, QUANTUM);
    let setup = Setup::new(&[&Vehicle::record(&motion, QUANTUM)], &settings).expect("a problem");
    let beginnings = setup.beginnings(&settings, SEARCHED).expect("long enough");
    let mut stayed = 0;
    for budget in (50..300).step_by(50) {
        let mut search = Search::new(&beginnings);
        let mut division = search.search(beginnings.search.clone(), budget);
        let done = |kept: &&Kept| matches!(kept.left, Left::Followed { .. });
        let before: Vec<Vec<Interval>> = division.kept.iter().filter(done).map(|kept| kept.at.clone()).collect();
        search.go_on(&mut division, 20_000);
        assert!(division.followed && division.kept.iter().all(|kept| done(&kept)));
        assert!(before.iter().all(|at| division.kept.iter().any(|kept| kept.at == *at)), "after {budget} passes");
        stayed += before.len();
    }
    assert!(stayed > 0, "nothing was done before");
}

#[test]
fn a_witness_meets_the_readings_before_the_onset_where_the_budget_is_spent_after_it() {
    let verdict = |off: f64| {
        let mut motion = DELAYED.motion(SAMPLES);
        // After the longest delay, and before the onset.
        motion[40].0[0] += off;
        let settings = DELAYED.model(false, QUANTUM);
        let setup = Setup::new(&[&Vehicle::record(&motion, QUANTUM)], &settings).expect("a problem");
        let later = setup.after(&settings, 5).expect("there are readings after it");
        let boxes = vec![Kept::new(later.search.clone())];
        let begun = Begun { setup: Cow::Owned(later), boxes, spent: settings.budget };
        let explored = go_further(&setup, begun, &settings, &Box::new(estimates(0.001)), |_, _| ());
        explored.expect("bounds").bounds.verdict
    };
    assert_eq!(verdict(0.0), Consistency::Consistent);
    for off in [1.5, 5.0] {
        assert_eq!(verdict(off * QUANTUM), Consistency::Undecided, "a reading that nothing meets, {off} steps off");
    }
}

#[test]
fn a_proof_begins_where_the_search_did_unless_what_follows_does_not_suffice() {
    let motion = DELAYED.motion(SAMPLES);
    let settings = DELAYED.model(false, QUANTUM);
    let record = Vehicle::record(&motion, QUANTUM);
    let records = [&record];
    let setup = Setup::new(&records, &settings).expect("a problem");
    let estimates = Box::new(estimates(0.001));
    let begun = begin(&setup, &settings, &estimates, 1);
    assert!(matches!(begun.setup, Cow::Owned(_)));
    let explored = go_further(&setup, begun, &settings, &estimates, |_, _| ()).expect("bounds");
    let onset = explored.later.as_ref().expect("another onset").onset[0];
    let firsts = |explored: &Explored| {
        let certificate =
            Certificate::prove(&records, &setup, &settings, explored, None).expect("setups").expect("a proof");
        certificate.check().expect("accepted");
        certificate.stages.iter().map(|stage| stage.windows[0][1]).collect::<Vec<usize>>()
    };
    assert!(onset > 0);
    assert_eq!(firsts(&explored), [onset]);
    // From the record's beginning: readings after the longest delay, then all.
    let patient = Explored { later: None, ..explored };
    let [first, second] = firsts(&patient)[..] else { panic!("two stages") };
    assert!(second < first && first < onset, "{second}, {first}, {onset}");
}

#[test]
fn what_only_readings_before_the_onset_contradict_is_shown_from_the_beginning() {
    let mut motion = DELAYED.motion(SAMPLES);
    let settings = DELAYED.model(false, QUANTUM);
    // After the longest delay, and by so little that speeds do not tell.
    for sample in &mut motion[40..80] {
        sample.0[0] += 0.7 * QUANTUM;
    }
    let record = Vehicle::record(&motion, QUANTUM);
    let setup = Setup::new(&[&record], &settings).expect("a problem");
    let later = setup.after(&settings, 5).expect("there are readings after it");
    let beginnings = later.beginnings(&settings, SEARCHED).expect("long enough");
    let division = Search::new(&beginnings).search(beginnings.search.clone(), 20_000);
    let boxes = later.boxes(&beginnings, &division);
    let begun = Begun { setup: Cow::Owned(later), boxes, spent: 0 };
    let explored = go_further(&setup, begun, &settings, &Box::new(estimates(0.001)), |_, _| ()).expect("bounds");
    assert_eq!(explored.bounds.verdict, Consistency::Refuted);
    assert!(explored.left.is_none() && explored.hulls.len() == 2);
    let certificate =
        Certificate::prove(&[&record], &setup, &settings, &explored, None).expect("setups").expect("a proof");
    certificate.check().expect("accepted");
    assert!(certificate.stages.last().is_some_and(|stage| stage.left.is_none()));
}
