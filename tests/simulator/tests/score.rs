//! The scoring itself, by tools whose worth is known, and its yardstick of widths.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use nalgebra::{DMatrix, DVector};
use selfosc_simulator::answer::{Answer, Interval, Trust};
use selfosc_simulator::command::Commander;
use selfosc_simulator::kinds::{Case, Group, Kind};
use selfosc_simulator::random::Random;
use selfosc_simulator::scenario::{Logged, Scenario};
use selfosc_simulator::score::{Score, Selection, Table, median};
use selfosc_simulator::sensor::Sensor;
use selfosc_simulator::truth::{Known, Truth};
use selfosc_simulator::vehicle::Vehicle;

/// An answer about alpha alone.
fn answer(trust: Trust, alpha: Interval) -> Answer {
    Answer { trust, reasons: Vec::new(), alpha: Some(alpha), ..Answer::refused("") }
}

/// A fit that knows everything: the truth with an error of the reference's spread, times a factor.
fn oracle(case: &Case, factor: f64) -> Answer {
    let std = case.reference_std_alpha().unwrap();
    let value = case.truths[0].alpha + std * Random::new(case.seed, "error of the oracle").normal();
    let half = 1.96 * factor * std;
    answer(Trust::Good, Interval { value, low: value - half, high: value + half })
}

fn score(name: &str, records: u64, tool: impl Fn(&Case) -> Answer) -> Score {
    let kind = Kind::named(name).unwrap();
    let mut score = Score::default();
    (1..=records).map(|seed| kind.case(seed)).for_each(|case| score.count(&case, &tool(&case)));
    score
}

/// Without drag the motion is linear in 1/alpha, delta/alpha and the start: a regression on integrals that are written out here.
#[test]
fn the_reference_is_the_error_of_a_regression() {
    let (alpha, noise) = (1.6, 0.02);
    let changes = vec![(0.0, 1.0), (2.0, -1.0), (5.0, 0.5), (9.0, -0.2)];
    let scenario = Scenario {
        vehicle: Vehicle { alpha, delta: 0.07, ..Vehicle::default() },
        commander: Commander::Sequence { changes: changes.clone() },
        sensor: Sensor { noise, ..Sensor::default() },
        logged: Logged::Order,
        duration_s: 20.0,
        lead_s: 0.0,
        first_stamp_s: 0.0,
        position: 0.1,
        speed: 0.05,
        starts_high: true,
    };
    let run = scenario.run(1);
    // Double integral of the command: each change adds a parabola.
    let pushed = |t: f64| {
        let mut before = 0.0;
        let mut sum = 0.0;
        for (from_s, level) in &changes {
            sum += 0.5 * (level - before) * (t - from_s).max(0.0).powi(2);
            before = *level;
        }
        sum
    };
    let times = &run.record.time_s;
    let columns = DMatrix::from_fn(times.len(), 4, |row, column| match column {
        0 => pushed(times[row]),
        1 => 0.5 * times[row].powi(2),
        2 => 1.0,
        _ => times[row],
    });
    let inverse = (columns.transpose() * &columns).try_inverse().unwrap();
    let expected = alpha * alpha * noise * inverse[(0, 0)].sqrt();
    let truths = vec![Truth::of(&run)];
    let known = Known { delay_s: Some(0.0), turn: None };
    let case = Case { kind: Kind::named("linear, noise").unwrap(), seed: 1, runs: vec![run], truths, known };
    let found = case.reference_std_alpha().unwrap();
    assert!((found / expected - 1.0).abs() < 1e-5, "{found} for {expected}");
    // Nor is the regression's value off: the record is what it says.
    let outputs = DVector::from_vec(case.runs[0].record.output.clone());
    let estimate = 1.0 / (inverse * columns.transpose() * outputs)[0];
    assert!((estimate - alpha).abs() < 4.0 * expected, "{estimate}");
}

/// What is unknown costs: a delay that is not told, and coloured noise, widen the reference; more samples narrow it.
#[test]
fn the_reference_moves_as_it_must() {
    let middle = |name: &str| {
        let cases = (1..=15).map(|seed| Kind::named(name).unwrap().case(seed));
        let relative = cases.map(|case| case.reference_std_alpha().unwrap() / case.truths[0].alpha);
        median(&relative.collect::<Vec<_>>()).unwrap()
    };
    let plain = middle("quadratic, noise");
    assert!(middle("quadratic, noise, delay unknown") > plain);
    assert!(middle("autoregressive noise 0.9") > plain);
    assert!(middle("random-walk force 0.05") > 2.0 * plain);
    assert!(middle("200 s") < plain);
}

#[test]
fn every_kind_has_a_reference_or_none_by_its_nature() {
    for kind in Kind::all() {
        let case = kind.case(4);
        let none = kind.group == Group::Unshowable || kind.name.starts_with("two vehicles");
        assert_eq!(case.reference_std_alpha().is_none(), none, "{}", kind.name);
    }
}

/// A tool at the bound misses one in twenty, with a width of one. One that claims half of it misses six times as often.
#[test]
fn tools_of_known_worth_get_what_they_deserve() {
    let honest = score("linear, noise", 200, |case| oracle(case, 1.0));
    let missed = honest.missed_percent().unwrap();
    // Three standard deviations of a binomial share of 200 about 5 %.
    assert!((0.4..=9.6).contains(&missed), "{missed}");
    assert!((median(&honest.ratios).unwrap() - 1.0).abs() < 1e-9);
    let bold = score("linear, noise", 200, |case| oracle(case, 0.5)).missed_percent().unwrap();
    assert!(bold > 20.0, "{bold}");
    let wrong = score("linear, noise", 20, |case| {
        let value = 1.1 * case.truths[0].alpha;
        answer(Trust::Widened, Interval { value, low: 0.99 * value, high: 1.01 * value })
    });
    assert_eq!((wrong.missed, wrong.trusted, wrong.good), (20, 20, 0));
    let shy = score("linear, noise", 20, |case| answer(Trust::Doubtful, Interval::exact(case.truths[0].alpha)));
    assert_eq!((shy.trusted, shy.doubtful, shy.right_percent()), (0, 20, Some(0.0)));
    let silent = score("linear, noise", 20, |_| Answer::refused("nothing"));
    assert_eq!((silent.refused, silent.missed_percent()), (20, None));
}

/// One interval for two vehicles must hold both.
#[test]
fn one_answer_for_two_vehicles_holds_both_or_misses() {
    let only_first = score("two vehicles, 5 % apart", 5, |case| {
        let value = case.truths[0].alpha;
        answer(Trust::Good, Interval { value, low: 0.98 * value, high: 1.02 * value })
    });
    assert_eq!(only_first.missed, 5);
    let both = score("two vehicles, 5 % apart", 5, |case| {
        let value = case.truths[0].alpha;
        answer(Trust::Widened, Interval { value, low: 0.98 * value, high: 1.06 * value })
    });
    assert_eq!(both.missed, 0);
}

#[test]
fn the_table_says_which_seeds_and_refuses_unknown_kinds() {
    let selection = Selection {
        records: 3,
        seed: 7,
        kind: vec!["lag 0.2 s".to_owned()],
        group: None,
        out: None,
        threads: 2,
        list: false,
    };
    let table = Table::of(&selection, |case| oracle(case, 1.0)).unwrap();
    assert_eq!(table.kind("lag 0.2 s").unwrap().cases, 3);
    let text = table.markdown();
    assert!(text.contains("Seeds 7 to 9 (development)") && text.contains("| lag 0.2 s | 3 |"), "{text}");
    let unknown = Selection { kind: vec!["perpetual motion".to_owned()], ..selection };
    assert!(Table::of(&unknown, |case| oracle(case, 1.0)).unwrap_err().to_string().contains("perpetual motion"));
}
