//! What recomputing the paper shows, each with a false variant that does not show it.

use proptest::prelude::*;
use selfosc::identify::fit::select::pairwise::relative_spread_percent;
use selfosc::identify::iso::{Oscillation, amplitude_sensitivity};
use selfosc::numeric::{Interval, Real};
use selfosc::paper::audit::{Group, audit};
use selfosc::paper::consistency::{Consistency, Verdict, consistency};
use selfosc::paper::figure15::{CRITERIA, Counts, Pairs, figure15};
use selfosc::paper::fixtures::{read_statements, read_table4, statements};
use selfosc::paper::table4::{PrintedTable, Table4, table4};
use selfosc::paper::{PaperError, Printed, quantisation, relay_figures, table2, table3, thruster_figure};
use selfosc::proof::Expression;
use selfosc::vehicle::{Axis, pool_vehicle};

use crate::tolerance;

const TABLE_4: &str = include_str!("../../fixtures/table4.csv");

fn regenerated() -> (PrintedTable, Table4, Vec<Group>) {
    let printed = PrintedTable::compiled_in().unwrap();
    let table = table4(&printed).unwrap();
    let groups = audit(&printed, &table).unwrap();
    (printed, table, groups)
}

fn agreeing(groups: &[Group], name: &str) -> (usize, usize) {
    let group = groups.iter().find(|group| group.name == name).unwrap_or_else(|| panic!("no group `{name}`"));
    (group.agreeing(), group.items.len())
}

#[test]
fn drag_is_reproduced_with_the_bias_and_not_without() {
    let groups = regenerated().2;
    assert_eq!(agreeing(&groups, "beta_r"), (19, 19));
    assert_eq!(agreeing(&groups, "beta_rr"), (19, 19));
    assert!(agreeing(&groups, "beta_r, x_0 = 0").0 < 19);
    assert!(agreeing(&groups, "beta_rr, x_0 = 0").0 < 19);
}

#[test]
fn inertia_is_reproduced_only_with_a_raised_relay_level() {
    let (_, table, groups) = regenerated();
    assert_eq!(agreeing(&groups, "alpha"), (0, 19));
    assert_eq!(agreeing(&groups, "alpha, C raised"), (19, 19));
    // The published analysis of the residual: 0.528 and 0.22 %.
    assert_eq!(format!("{:.3} {:.2}", table.level_offset, table.level_offset_residual_percent), "0.528 0.22");
    let ratios = table.rows.iter().map(|row| row.recomputed.alpha / row.printed.alpha);
    assert!(ratios.clone().all(|ratio| (0.795..0.975).contains(&ratio)), "{:?}", ratios.collect::<Vec<_>>());
    // False variant: any other constant of the size of the printed digits fails.
    for offset in [0.0, 0.3, 0.8] {
        let other = Table4 { level_offset: offset, ..table.clone() };
        let groups = audit(&PrintedTable::compiled_in().unwrap(), &other).unwrap();
        assert!(agreeing(&groups, "alpha, C raised").0 < 19, "{offset}");
    }
}

#[test]
fn last_rows_follow_from_the_table_and_the_text_does_not() {
    let groups = regenerated().2;
    assert_eq!(agreeing(&groups, "last rows of Table 4"), (6, 6));
    assert_eq!(agreeing(&groups, "spread in the text"), (0, 1));
}

#[test]
fn the_point_of_row_9_has_one_place() {
    for (amplitude, place) in [("3.657", false), ("36.57", true), ("365.7", false), ("3657", false)] {
        let text = TABLE_4.replace(",36.57,", &format!(",{amplitude},"));
        let row = read_table4(&text).unwrap()[8];
        let oscillation = Oscillation {
            relay_level: row.relay_level.value(),
            switch_level: row.switch_level.value(),
            amplitude: row.amplitude.value(),
            bias: row.bias.value(),
            period_s: row.period.value(),
            delay_s: 0.2,
        };
        let reproduced = oscillation.identify().is_ok_and(|parameters| {
            (parameters.beta * 100.0 - row.beta_r.value()).abs() < 0.02
                && (parameters.beta_quadratic * 1000.0 - row.beta_rr.value()).abs() < 0.01
        });
        assert_eq!(reproduced, place, "{amplitude}");
    }
    assert_eq!(agreeing(&regenerated().2, "X_m"), (19, 19));
}

fn counts(counts: &Counts) -> (u32, u32, u32) {
    (counts.correct, counts.wrong, counts.undecided)
}

/// The bars of Fig. 15.
const BARS: [(u32, u32, u32); 4] = [(115, 16, 0), (105, 14, 12), (87, 7, 37), (75, 2, 54)];

#[test]
fn figure_15_needs_the_square_root_of_two() {
    let (printed, _, groups) = regenerated();
    let levels: Vec<f64> = printed.experiments().iter().map(|row| row.relay_level.value()).collect();
    let pairs = Pairs::new(&levels, &printed.printed()).unwrap();
    assert_eq!(pairs.len(), 131);
    let bars = figure15(&levels, &printed.printed()).unwrap();
    assert_eq!(bars.iter().map(counts).collect::<Vec<_>>(), BARS);
    let without: Vec<_> = CRITERIA
        .iter()
        .map(|criterion| counts(&pairs.counts(criterion, |a, b| relative_spread_percent(a, b) / 2f64.sqrt())))
        .collect();
    assert_ne!(without, BARS);
    assert_eq!(agreeing(&groups, "Fig. 15"), (13, 13));
    assert_eq!(agreeing(&groups, "words on Fig. 15"), (6, 6));
}

#[test]
fn every_statement_is_audited_once() {
    let groups = regenerated().2;
    let items: Vec<&str> = groups.iter().flat_map(|group| &group.items).map(|item| item.item.as_str()).collect();
    for statement in statements().unwrap() {
        assert_eq!(items.iter().filter(|item| **item == statement.item).count(), 1, "{}", statement.item);
    }
}

#[test]
fn inertia_is_insensitive_at_the_square_root_of_two() {
    let curves = quantisation::curves();
    let zero = curves.iter().find(|point| point.sensitivity.alpha.abs() < 1e-12).unwrap();
    assert_eq!(zero.amplitude_ratio, 2f64.sqrt());
    // Against the inertia itself, by central differences: its slope in the amplitude changes sign there and nowhere else.
    let alpha = |ratio: f64| {
        let (switch_level, amplitude) = (1.0, ratio);
        let oscillation =
            Oscillation { relay_level: 1.0, switch_level, amplitude, bias: 0.0, period_s: 1.0, delay_s: 0.0 };
        oscillation.identify().unwrap().alpha
    };
    for ratio in [1.2, 2f64.sqrt(), 2.0, 3.5] {
        let step = 1e-5;
        let slope = (alpha(ratio + step) - alpha(ratio - step)) / (2.0 * step) * ratio / alpha(ratio);
        assert!((slope - amplitude_sensitivity(ratio).alpha).abs() < tolerance::CENTRAL_DIFFERENCE, "{ratio}: {slope}");
    }
}

#[test]
fn figure_14_bounds_shrink_with_the_amplitude() {
    let errors = quantisation::figure14(&PrintedTable::compiled_in().unwrap());
    let mean_error: f64 = errors.iter().map(|error| error.percent.beta_rr).sum::<f64>() / 19.0;
    assert!(mean_error.abs() < 1e-12);
    let (first, last) = (errors[0].bound_percent, errors[18].bound_percent);
    // Amplitudes 20.6 and 60.33: 2/20.6 and 3/60.33 in percent.
    assert!((first.beta_r - 200.0 / 20.6).abs() < 1e-12 && (last.beta_rr - 300.0 / 60.33).abs() < 1e-12);
}

#[test]
fn figures_of_the_relay_switch_where_they_say() {
    let late = relay_figures::figure7();
    let at = |step: usize| (late.samples[step].1 * 1e9).round() / 1e9;
    assert_eq!((at(5), at(6), late.switching.0), (2.15, 6.57, 6.0));
    let [_, output] = relay_figures::figure6().unwrap();
    let high = output.iter().filter(|point| point.1 > 1.0).count();
    assert!(2 * high > output.len(), "a positive bias keeps the output high for longer");
    let [rising, falling] = relay_figures::figure5().unwrap();
    let at_zero = |curve: &[(f64, f64)]| curve.iter().find(|point| point.0.abs() < 1e-12).unwrap().1;
    assert_eq!((at_zero(&rising), at_zero(&falling)), (-0.7, 1.3));
}

#[test]
fn figure_9_fits_its_readings() {
    let figure = thruster_figure::figure9().unwrap();
    for &(command, thrust) in &figure.readings {
        // Readings are rounded to 0.1 N.
        assert!((figure.map.thruster.thrust(command) - thrust).abs() < 0.1, "{command}");
    }
}

#[test]
fn table_2_is_the_vehicle_s_own_reduction() {
    let vehicle = pool_vehicle().unwrap();
    let p = vehicle.parameters();
    for axis in Axis::ALL {
        let i = axis.index();
        let external = 0.3;
        let coefficients = table2::Coefficients {
            inertia: if axis == Axis::Yaw { p.inertia_kg_m2[(2, 2)] } else { p.mass_kg },
            by_acceleration: -p.added_mass[(i, i)],
            by_speed: -p.linear_drag[(i, i)],
            by_speed_magnitude: -p.quadratic_drag[i],
            external,
            weight: vehicle.weight_n(),
            buoyancy: p.buoyancy_n,
        };
        let (terms, speed) = (table2::uncoupled(axis, &coefficients, -0.5), 0.5);
        let own = vehicle.axis(axis, &nalgebra::Vector6::from_element(external));
        assert!((terms.alpha - own.alpha).abs() < tolerance::VEHICLE_ALGEBRA, "{axis:?}");
        assert!(
            (terms.minus_beta + own.linear_drag + own.quadratic_drag * speed).abs() < tolerance::VEHICLE_ALGEBRA,
            "{axis:?}"
        );
        assert!((terms.delta - own.disturbance).abs() < tolerance::VEHICLE_ALGEBRA, "{axis:?}");
    }
}

fn names<'a>(names: &'a [(&'a str, f64)]) -> impl Fn(&str) -> Option<f64> + 'a {
    |name| names.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
}

proptest! {
    /// The printed formula has the value of the evaluated one.
    #[test]
    fn formulas_of_table_3_are_those_evaluated(
        level in 0.1..10.0f64, switch_level in 1.0..2.0f64, bias in -1.0..1.0f64, amplitude in 9.0..10.0f64,
        omega in 1.0..2.0f64, delay in 0.0..0.5f64,
    ) {
        let period_s = core::f64::consts::TAU / omega;
        let oscillation = Oscillation { relay_level: level, switch_level, amplitude, bias, period_s, delay_s: delay };
        let evaluated = table3::evaluate(&oscillation, 1.1, 1.3).unwrap();
        let formulas = table3::formulas(true).unwrap();
        let quantities = [
            ("C", level), ("x_a", switch_level), ("x_0", bias), ("X_m", amplitude), ("w", omega), ("T_d", delay),
            ("t_plus", 1.1), ("t_minus", 1.3),
        ];
        let (f, e) = (formulas.parameters, evaluated.parameters);
        for (formula, value) in [
            (f.alpha, e.alpha), (f.beta, e.beta), (f.beta_quadratic, e.beta_quadratic), (f.disturbance, e.disturbance),
            (formulas.disturbance_from_times, evaluated.disturbance_from_times),
        ] {
            let printed = formula.value(&names(&quantities)).unwrap();
            prop_assert!((printed - value).abs() <= tolerance::REARRANGED * level, "{formula}: {printed} against {value}");
        }
    }

    /// Collecting powers and terms keeps the value.
    #[test]
    fn algebra_keeps_the_value(a in 1.0..2.0f64, b in 3.0..4.0f64, shape in prop::array::uniform8(0..6usize)) {
        let symbol = |name, from, to| Expression::symbol(name, name, Interval::new(from, to).unwrap());
        fn build<T: Real>(a: T, b: T, shape: [usize; 8]) -> T {
            shape.into_iter().fold(a, |formula, step| match step {
                0 => formula + b / a,
                1 => formula * (a - b),
                2 => formula / (a + b),
                3 => -formula - T::from_f64(0.75) * a * a,
                4 => (b - formula) * (b + formula),
                _ => (formula / b).atan().max(T::from_f64(-7.0)),
            })
        }
        let formula = build(symbol("a", 1.0, 2.0), symbol("b", 3.0, 4.0), shape);
        let (printed, value) = (formula.value(&names(&[("a", a), ("b", b)])).unwrap(), build(a, b, shape));
        let exact = build(Interval::point(a), Interval::point(b), shape);
        // Rounding is what the intervals allow, a hundredfold: the order of operations differs.
        let room = 100.0 * exact.width() + 1e-12 * (1.0 + value.abs());
        prop_assert!((printed - value).abs() <= room, "{formula}: {printed} against {value}");
    }

    /// Any text is read or refused, never a panic; a refusal names the line.
    #[test]
    fn any_fixture_is_read_or_refused(text in "\\PC*(\n\\PC*)*") {
        prop_assert!(read_table4(&text).map_or(true, |rows| rows.is_empty()));
        prop_assert!(read_statements(&text).map_or(true, |rows| rows.is_empty()));
    }

    /// A printed decimal lies in the middle of what it stands for.
    #[test]
    fn decimals_stand_for_half_a_unit(digits in 0..1_000_000i64, decimals in 0..5usize) {
        let text = format!("{:.decimals$}", digits as f64 / 10f64.powi(decimals as i32));
        let printed = Printed::parse(&text).unwrap();
        prop_assert_eq!(printed.value(), text.parse::<f64>().unwrap());
        let interval = printed.interval(2);
        let half = 0.5 * 10f64.powi(-(decimals.max(2) as i32));
        prop_assert!((interval.width() / (2.0 * half) - 1.0).abs() < 1e-6 && interval.contains(printed.value()));
    }
}

#[test]
fn corrupt_fixtures_are_refused_with_line_and_column() {
    let refuse = |from: &str, to: &str| read_table4(&TABLE_4.replacen(from, to, 1)).unwrap_err();
    let PaperError::Cell { line, column, cell, .. } = refuse("4,3.85,16.84", "4,3.85,16.8o") else { panic!() };
    assert_eq!((line, column.as_str(), cell.as_str()), (5, "x_a_star_deg", "16.8o"));
    for (from, to, line, column) in [
        (",4.26,", ",-4.26,", 2, "period_s"),
        (",4.26,", ",NaN,", 2, "period_s"),
        (",4.26,", ",,", 2, "period_s"),
        (",4.26,", ",", 2, "beta_rr_1e-5"),
        ("period_s", "period", 1, "period_s"),
    ] {
        let (PaperError::Cell { line: at, column: name, .. } | PaperError::Row { line: at, column: name, .. }) =
            refuse(from, to)
        else {
            panic!("{from} as {to}")
        };
        assert_eq!((at, name.as_str()), (line, column), "{from} as {to}");
    }
    // An experiment that does not meet condition 40 is named.
    let printed = refuse_row(",53,", ",40,");
    assert!(printed.contains("experiment 6") && printed.contains("40"), "{printed}");
}

/// What is said of a table that reads well and that the method does not take.
fn refuse_row(from: &str, to: &str) -> String {
    let rows = read_table4(&TABLE_4.replacen(from, to, 1)).unwrap();
    let table = PrintedTable::new(rows).unwrap();
    table4(&table).unwrap_err().to_string()
}

fn about<'a>(found: &'a [Consistency], question: &str) -> &'a Consistency {
    found.iter().find(|found| found.question == question).unwrap()
}

/// Whether every row's printed value can be had at a delay and an offset of the level, in plain floats and with the formulas
/// written out: between its least and its largest value over the corners of the readings' decimals lies the printed one.
fn reproduced(rows: &[[f64; 9]], column: usize, delay_s: f64, offset: f64) -> bool {
    rows.iter().all(|row| {
        let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
        for corner in 0..32 {
            let at = |i: usize| row[1 + i] + if corner >> i & 1 == 1 { 0.005 } else { -0.005 };
            let (level, on, size, bias, omega) = (at(0) + offset, at(1), at(2), at(3), core::f64::consts::TAU / at(4));
            let root = |reach: f64| (1.0 - (reach / size).powi(2)).sqrt();
            let scale = level / (core::f64::consts::PI * size);
            let (p, q) = (2.0 * scale * (root(on - bias) + root(on + bias)), -4.0 * scale * on / size);
            let (sin, cos) = (omega * delay_s).sin_cos();
            let value = match column {
                0 => 100.0 * (p * cos + q * sin) / omega.powi(2),
                1 => 100.0 * (p * sin - q * cos) / omega,
                _ => 1000.0 * 3.0 * core::f64::consts::PI / 8.0 * (p * sin - q * cos) / (size * omega.powi(2)),
            };
            (least, largest) = (least.min(value), largest.max(value));
        }
        least - 0.005 <= row[6 + column] && row[6 + column] <= largest + 0.005
    })
}

#[test]
fn delays_and_offsets_left_are_those_that_reproduce_every_row() {
    let numbers = |line: &str| -> [f64; 9] {
        line.split(',').map(|cell| cell.parse().unwrap()).collect::<Vec<_>>().try_into().unwrap()
    };
    let rows: Vec<[f64; 9]> = TABLE_4.lines().skip(1).map(numbers).collect();
    let found = consistency(&PrintedTable::compiled_in().unwrap());
    for (column, question, middle) in [(0, "alpha", 0.525), (1, "beta_r", 0.0), (2, "beta_rr", 0.0)] {
        let left = about(&found, question);
        let (delay, offset) = (left.delay_s.unwrap(), left.level_offset.unwrap());
        assert_eq!(left.verdict, Verdict::NotRefuted);
        assert!(reproduced(&rows, column, 0.1997, middle), "{question}");
        for i in 0..=120 {
            for j in 0..=100 {
                let (delay_s, level) = (0.14 + 0.001 * f64::from(i), middle - 0.1 + 0.002 * f64::from(j));
                let inside = delay.0 <= delay_s && delay_s <= delay.1 && offset.0 <= level && level <= offset.1;
                assert!(inside || !reproduced(&rows, column, delay_s, level), "{question}: {delay_s}, {level}");
            }
        }
    }
}

#[test]
fn rows_contradict_each_other_in_inertia_and_drag() {
    let found = consistency(&PrintedTable::compiled_in().unwrap());
    let each = about(&found, "alpha and beta_r");
    assert_eq!(each.verdict, Verdict::Refuted);
    // What inertia and drag of one row say of the delay, whatever the level: rows 1 and 16, in plain floats.
    let delay = |on: f64, size: f64, bias: f64, period: f64, alpha: f64, beta: f64| {
        let omega = core::f64::consts::TAU / period;
        let root = |reach: f64| (1.0 - (reach / size).powi(2)).sqrt();
        ((beta / (alpha * omega)).atan() - (2.0 * on / size / (root(on - bias) + root(on + bias))).atan()) / omega
    };
    let (first, other) = (delay(10.29, 20.6, 2.0, 4.26, 5.05, 6.4), delay(14.33, 42.73, 2.36, 2.51, 5.52, 15.07));
    assert!(first < 0.13 && other > 0.19, "{first} {other}");
    // Every law is refuted for one vehicle, quadratic drag at less growth than linear drag.
    let growth = |law: &str| about(&found, &format!("one vehicle, {law} drag")).growth.unwrap();
    assert!(growth("quadratic").1.unwrap() < growth("linear").0 && growth("mixed").0 > 1.0);
}

/// False variant: one row's drag off by ten units of its last decimal, and nothing is left. Three are within what the rounded
/// readings leave open.
#[test]
fn a_misprint_in_one_row_is_refuted() {
    let altered = TABLE_4.replace(",11.84,", ",11.94,");
    let table = PrintedTable::new(read_table4(&altered).unwrap()).unwrap();
    let found = consistency(&table);
    let drag = about(&found, "beta_r");
    assert_eq!(drag.verdict, Verdict::Refuted);
    assert!(drag.contradicting.contains(&9), "{:?}", drag.contradicting);
    assert_eq!(about(&found, "alpha").verdict, Verdict::NotRefuted);
}
