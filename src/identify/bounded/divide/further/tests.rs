use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::super::super::BoundedModel;
use super::super::super::setup::Setup;
use super::super::super::simulated::{DRAG, Vehicle};
use super::*;

const QUANTUM: f64 = 0.01;
const BOXES: usize = 12;
const BUDGET: usize = 2000;
/// What the truth's integration may be off.
const OFF: f64 = 1e-7;

/// The readings of a vehicle, and its unknowns.
fn case(vehicle: &Vehicle, delay_known: bool) -> (Setup, Vec<f64>) {
    case_of(vehicle, delay_known, 110)
}

fn case_of(vehicle: &Vehicle, delay_known: bool, samples: usize) -> (Setup, Vec<f64>) {
    let motion = vehicle.motion(samples);
    let record = Vehicle::record(&motion, QUANTUM);
    let model = BoundedModel { either_sign: vehicle.linear < 0.0, ..vehicle.model(delay_known, QUANTUM) };
    let setup = Setup::new(&[&record], &model).expect("a problem");
    let truth = vehicle.truth(&setup, &motion);
    (setup, truth)
}

/// A box as wide as this share of each unknown, and no wider than what is searched, with the truth somewhere in it; `moved` by so many
/// widths.
fn about(setup: &Setup, truth: &[f64], share: f64, moved: f64, random: &mut Pcg64Mcg) -> Vec<Interval> {
    let mut at = setup.search.clone();
    for place in setup.layout.of_whole() {
        let width = share * truth[place].abs().max(0.1);
        let low = truth[place] - width * random.random_range(0.01..0.99) + if place == 0 { moved * width } else { 0.0 };
        let own = Interval::new(low, low + width).expect("an interval");
        at[place] = own.intersection(setup.search[place]).expect("it is looked for there");
    }
    at
}

/// A case of drag alone, and a box so wide with its truth.
fn drawn(share: f64, seed: u64) -> (Setup, Vec<f64>, Vec<Interval>) {
    let (setup, truth) = case(&DRAG, true);
    let at = about(&setup, &truth, share, 0.0, &mut Pcg64Mcg::seed_from_u64(seed));
    (setup, truth, at)
}

#[test]
fn what_is_followed_further_keeps_the_true_motion_and_what_lies_beside_it_is_excluded() {
    let cases = [
        (DRAG, true),
        (Vehicle { delayed: 5, ..DRAG }, false),
        (Vehicle { lag_rate: 5.0, ..DRAG }, true),
        (Vehicle { stiffness: 0.3, ..DRAG }, true),
        (Vehicle { linear: -0.2, quadratic: 0.9, ..DRAG }, true),
    ];
    let mut random = Pcg64Mcg::seed_from_u64(61);
    let (mut fewer, mut halved) = (0, 0);
    for (number, (vehicle, delay_known)) in cases.iter().enumerate() {
        let (setup, truth) = case(vehicle, *delay_known);
        let reaches = setup.reaches(3);
        for _ in 0..BOXES {
            let share = 10f64.powf(random.random_range(-3.0..-1.0));
            let around = about(&setup, &truth, share, 0.0, &mut random);
            let beside = about(&setup, &truth, 0.01, 3.0, &mut random);
            let mut search = Search::new(&setup);
            let division = search.follow_further(vec![Kept::new(around), Kept::new(beside.clone())], &reaches, BUDGET);
            halved += usize::from(division.kept.len() > 1);
            let hull = division.hull().unwrap_or_else(|| panic!("case {number}: the truth was excluded"));
            assert!(division.followed && search.model.reach == usize::MAX);
            for place in setup.layout.of_whole() {
                let near = hull[place] + Interval::symmetric(OFF);
                assert!(near.contains(truth[place]), "case {number}: {place} is {}, {near:?}", truth[place]);
            }
            let (mut alone, mut whole) = (Search::new(&setup), Search::new(&setup));
            let left = alone.follow_further(vec![Kept::new(beside.clone())], &reaches, BUDGET);
            let close = whole.search(beside, BUDGET);
            assert!(left.kept.is_empty() || !close.kept.is_empty(), "case {number}: windows exclude what is kept");
            fewer += usize::from(left.kept.is_empty());
        }
    }
    assert!(fewer > 4 * BOXES, "only {fewer} boxes beside the truth were excluded");
    assert!(halved > 0, "no box was left in parts");
}

#[test]
fn boxes_whose_frames_leave_too_much_in_doubt_are_followed_window_by_window() {
    let (setup, truth, mut wide) = drawn(0.5, 62);
    for place in setup.layout.of_whole().into_iter().skip(setup.layout.parameters()) {
        wide[place] = setup.search[place];
    }
    let mut search = Search::new(&setup);
    let straight = Open::new(Kept::new(wide.clone()));
    assert!(matches!(search.narrow(straight), Ok(Next::Broken(_))));
    let division = search.follow_further(vec![Kept::new(wide)], &setup.reaches(3), BUDGET);
    let hull = division.hull().expect("the truth is inside");
    assert!(truth.iter().zip(&hull).take(setup.layout.parameters()).all(|(value, side)| side.contains(*value)));
    assert!(hull[0].width() < 0.05 * truth[0], "{:?}", hull[0]);
}

#[test]
fn one_reach_after_the_other_costs_less_than_all_windows_and_than_all_at_once() {
    let (setup, truth) = case_of(&DRAG, true, 600);
    let mut random = Pcg64Mcg::seed_from_u64(63);
    let mut left = |share: f64, other: fn(&mut Search<'_>, Vec<Interval>) -> Division| {
        let at = about(&setup, &truth, share, 0.0, &mut random);
        let (mut further, mut otherwise) = (Search::new(&setup), Search::new(&setup));
        let left =
            further.follow_further(vec![Kept::new(at.clone())], &setup.reaches(3), BUDGET).hull().expect("the truth");
        let whole = other(&mut otherwise, at).hull().expect("the truth");
        assert!(left[0].width() < 1.5 * whole[0].width(), "{:?} and {:?}", left[0], whole[0]);
        [further, otherwise].map(|search| search.model.effort.us())
    };
    let windows = left(0.05, |search, at| search.search(at, BUDGET));
    assert!(windows[0] < windows[1], "{windows:?}");
    let at_once =
        left(0.15, |search, at| search.follow_further(vec![Kept::new(at)], &[search.setup.most_windows()], BUDGET));
    assert!(at_once[0] < at_once[1], "{at_once:?}");
}

#[test]
fn windows_of_the_next_reach_come_before_those_of_whole_records() {
    let (setup, truth) = case_of(&Vehicle { delayed: 5, ..DRAG }, false, 600);
    let reaches = setup.reaches(3);
    assert!(reaches.len() > 3, "{reaches:?}");
    let mut wide = about(&setup, &truth, 0.5, 0.0, &mut Pcg64Mcg::seed_from_u64(67));
    for place in setup.layout.of_whole().into_iter().skip(setup.layout.parameters()) {
        wide[place] = setup.search[place];
    }
    let (mut further, mut whole) = (Search::new(&setup), Search::new(&setup));
    assert!(matches!(further.narrow(Open::new(Kept::new(wide.clone()))), Ok(Next::Broken(_))));
    let left = further.follow_further(vec![Kept::new(wide.clone())], &reaches, BUDGET);
    let close = whole.search(wide, BUDGET);
    let [left, close] = [left, close].map(|division| division.hull().expect("the truth is inside"));
    assert!(left[0].contains(truth[0]) && left[0].width() < 1.5 * close[0].width(), "{:?} and {:?}", left[0], close[0]);
    let [further, whole] = [further, whole].map(|search| search.model.effort.us());
    assert!(further < whole, "{further} and {whole}");
}

/// A box in a frame along what the readings tell, its coordinates so many times as wide as they are.
fn informed(search: &mut Search<'_>, at: &[Interval], factor: f64) -> Open {
    let Ok(Next::Again(mut here)) = search.narrow(Open::new(Kept::new(at.to_vec()))) else { panic!("no frame") };
    let slanted = here.kept.slanted.as_mut().expect("a frame");
    for z in &mut slanted.frame.z {
        *z *= Interval::point(factor);
    }
    here.kept.at = search.setup.search.clone();
    here
}

#[test]
fn a_box_is_contracted_while_that_helps_and_halved_where_much_is_in_doubt() {
    let (setup, _, at) = drawn(0.01, 65);
    let mut search = Search::new(&setup);
    let mut seen = [0; 2];
    for factor in [1.0, 3.0, 10.0, 20.0, 30.0, 50.0] {
        let here = informed(&mut search, &at, factor);
        match search.narrow(Open { halvings: 2, ..here.clone() }) {
            Ok(Next::Again(Open { halvings, .. })) => {
                assert_eq!(halvings, 0);
                seen[0] += 1;
            }
            Ok(Next::Halves(halves)) => {
                assert!(halves.iter().all(|half| half.halvings == 3));
                // The next one comes to nothing.
                assert!(matches!(search.narrow(Open { halvings: 3, ..here }), Ok(Next::Broken(_))));
                seen[1] += 1;
            }
            _ => {}
        }
    }
    assert!(seen[0] > 0 && seen[1] > 0, "{seen:?}");
    let settled = (0..9).try_fold(informed(&mut search, &at, 1.0), |here, _| match search.narrow(here) {
        Ok(Next::Again(here)) => Ok(here),
        Ok(Next::Settled(_)) => Err(true),
        _ => Err(false),
    });
    assert!(matches!(settled, Err(true)));
}

#[test]
fn a_motion_is_made_anew_where_what_is_of_the_third_order_weighs() {
    let (setup, _, at) = drawn(0.01, 66);
    let mut search = Search::new(&setup);
    for most in [f64::INFINITY, 0.0] {
        let mut anew = Vec::new();
        for factor in [0.3, 1.0, 3.0, 10.0, 20.0, 30.0, 50.0] {
            let mut here = informed(&mut search, &at, factor).kept;
            let came = search.slant(&mut here.at, &mut here.slanted, most).expect("the truth is inside");
            let slanted = match came {
                Slant::Contracted(_) => here.slanted,
                Slant::Doubtful { slanted, .. } => Some(slanted),
                Slant::NoEnclosure => break,
            };
            anew.push(slanted.expect("a frame").surface.is_none());
        }
        // What is of the third order grows faster than what is of the second.
        assert!(anew.is_sorted() && anew.first() == Some(&false) && anew.last() == Some(&true), "{most}: {anew:?}");
    }
}

#[test]
fn a_spent_budget_leaves_one_box_around_all() {
    let (setup, truth) = case(&DRAG, true);
    let mut random = Pcg64Mcg::seed_from_u64(64);
    let boxes: Vec<Vec<Interval>> = (0..3).map(|_| about(&setup, &truth, 0.01, 0.0, &mut random)).collect();
    let division =
        Search::new(&setup).follow_further(boxes.iter().cloned().map(Kept::new).collect(), &setup.reaches(3), 0);
    assert!(!division.followed && division.kept.len() == 1);
    let hull = &division.kept[0].at;
    let ends = |end: fn(&Interval) -> f64| boxes.iter().map(|at| end(&at[0])).collect::<Vec<f64>>();
    let (low, high) = (ends(|side| side.lower()), ends(|side| side.upper()));
    assert_eq!(hull[0].lower(), low.into_iter().fold(f64::INFINITY, f64::min));
    assert_eq!(hull[0].upper(), high.into_iter().fold(f64::NEG_INFINITY, f64::max));
}

#[test]
fn reaches_double_and_the_last_is_all() {
    let (setup, _) = case(&DRAG, true);
    assert_eq!(setup.most_windows(), 7);
    assert_eq!(setup.reaches(3), [3, 6, 7]);
    assert_eq!(setup.reaches(7), [7]);
    assert_eq!(setup.reaches(9), [7]);
}

#[test]
fn what_beginnings_leave_of_a_records_first_state_is_known_of_the_record() {
    let motion = DRAG.motion(110);
    let settings = DRAG.model(true, QUANTUM);
    let setup = Setup::new(&[&Vehicle::record(&motion, QUANTUM)], &settings).expect("a problem");
    let beginnings = setup.beginnings(&settings, super::super::super::setup::SEARCHED).expect("long enough");
    let mut at = beginnings.search.clone();
    let velocity = Interval::new(-0.5, -0.3).expect("an interval");
    at[beginnings.layout.start(0, 1)] = velocity;
    at[0] = Interval::new(0.8, 1.0).expect("an interval");
    let begun = setup.begun(&beginnings, &at);
    assert_eq!(begun.len(), setup.search.len());
    assert_eq!([begun[0], begun[setup.layout.start(0, 1)]], [at[0], velocity]);
    assert_eq!(begun[setup.layout.start(1, 0)], setup.search[setup.layout.start(1, 0)]);
}
