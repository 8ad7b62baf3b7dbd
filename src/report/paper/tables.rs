//! The regenerated paper's tables.

use super::Reproduction;
use crate::numeric::Interval;
use crate::paper::consistency::Verdict;
use crate::paper::figure15::CRITERIA;
use crate::paper::quantisation::{curves, figure14};
use crate::paper::{table2, table3, table4};
use crate::proof::Expression;
use crate::report::{Cell, ReportError, Table};

/// Units of Table 4's parameters.
const UNITS: &str = "Units: alpha 1e-4 N m/(deg/s^2), beta_r 1e-4 N m/(deg/s), beta_rr 1e-5 N m/(deg/s)^2.";

/// Symbols of Tables 2 and 3 with their LaTeX, meanings and units.
#[rustfmt::skip]
const SYMBOLS: [[[&str; 4]; 8]; 2] = [[
    ["m", "m", "mass; I_z, moment of inertia", "kg; kg m^2"],
    ["u", "u", "speed of surge; v sway, w heave, r yaw", "m/s; rad/s"],
    ["X_udot", r"X_{\dot u}", "hydrodynamic force per acceleration", "kg; kg m^2"],
    ["X_u", "X_u", "hydrodynamic force per speed", "N/(m/s); N m/(rad/s)"],
    ["X_uu", r"X_{u|u|}", "hydrodynamic force per squared speed", "N/(m/s)^2; N m/(rad/s)^2"],
    ["tau_XE", r"\tau_{XE}", "constant external force", "N; N m"],
    ["W", "W", "weight", "N"],
    ["B", "B", "buoyancy", "N"],
], [
    ["C", "C", "relay level", "N; N m"],
    ["x_a", "x_a", "output at which the relay switches", "m; rad"],
    ["X_m", "X_m", "amplitude of the output", "m; rad"],
    ["x_0", "x_0", "bias of the output", "m; rad"],
    ["w", r"\omega", "frequency of the oscillation", "rad/s"],
    ["T_d", "T_d", "delay of the loop", "s"],
    ["t_plus", "t_+", "time per period at command +C", "s"],
    ["t_minus", "t_-", "time per period at command -C", "s"],
]];

pub(super) fn symbols(name: &'static str, of: usize) -> Table {
    let row = |[text, latex, meaning, unit]: [&'static str; 4]| {
        [Expression::symbol(text, latex, Interval::ENTIRE).into(), meaning.into(), unit.into()]
    };
    Table::new(name, "Symbols", &["symbol", "meaning", "unit"]).rows(SYMBOLS[of].map(row))
}

pub(super) fn table2() -> Table {
    let columns = ["axis", "inertia alpha", "drag -beta(nu)", "disturbance delta"];
    let rows = table2::formulas().into_iter().map(|(axis, terms)| {
        let name = format!("{axis:?}").to_lowercase();
        [Cell::Text(name), terms.alpha.into(), terms.minus_beta.into(), terms.delta.into()]
    });
    Table::new("table2", "Uncoupled axes (eq. 6)", &columns).rows(rows)
}

/// The row of an experiment.
fn numbered(experiment: u32, values: impl IntoIterator<Item = f64>) -> impl Iterator<Item = Cell> {
    [Cell::count(experiment as usize)].into_iter().chain(values.into_iter().map(|value| Cell::number(value, 2)))
}

pub(super) fn quantisation() -> Table {
    let columns = ["amplitude X_m/x_a", "inertia (% per %)", "linear drag (% per %)", "quadratic drag (% per %)"];
    let rows = curves().into_iter().map(|point| {
        let s = point.sensitivity;
        [point.amplitude_ratio, s.alpha, s.beta, s.beta_quadratic].map(|value| Cell::number(value, 3))
    });
    Table::new("quantisation", "Error per error of the amplitude", &columns).rows(rows)
}

impl Reproduction {
    /// Formulas without and with delay, and their values for an experiment of Table 4 in SI units per degree.
    pub(super) fn table3(&self) -> Result<Vec<Table>, ReportError> {
        let quantities = [
            ("inertia alpha", "N s^2/m"),
            ("linear drag beta", "N s/m"),
            ("quadratic drag beta_xx", "N s^2/m^2"),
            ("disturbance delta, by the bias", "N"),
            ("disturbance delta, by the times", "N"),
        ];
        let listed = |table: &table3::Table3<Expression>| {
            let p = table.parameters;
            [p.alpha, p.beta, p.beta_quadratic, p.disturbance, table.disturbance_from_times]
        };
        let formulas = |name, title, delayed| -> Result<Table, ReportError> {
            let rows = quantities.into_iter().zip(listed(&table3::formulas(delayed)?));
            let rows = rows.map(|((name, unit), formula)| [name.into(), unit.into(), formula.into()]);
            Ok(Table::new(name, title, &["parameter", "unit", "formula"]).rows(rows))
        };
        Ok(vec![
            formulas("table3", "Formulas without delay", false)?,
            formulas("table3-delay", "Formulas with the delay corrected (eq. 34)", true)?,
            symbols("table3-symbols", 1).note("Of yaw, N m stands for N and rad for m."),
        ])
    }

    /// Means and spreads.
    pub(super) fn parameters_table(&self) -> Table {
        let t = &self.table4;
        let row = |name: &str, yaw: table4::Yaw<f64>| {
            let values = yaw.named().map(|(_, value)| Cell::number(value, 2));
            [Cell::from(name)].into_iter().chain(values)
        };
        let columns = ["statistic", "inertia alpha", "linear drag beta_r", "quadratic drag beta_rr"];
        Table::new("table4-means", "Table 4: 19 experiments on the yaw axis", &columns)
            .note(UNITS)
            .row(row("mean, printed rows", t.mean))
            .row(row("mean, recomputed rows", t.recomputed_mean))
            .row(row("spread in %, printed rows", t.std_percent))
            .row(row("spread in %, recomputed rows", t.recomputed_std_percent))
    }

    pub(super) fn table4(&self) -> Table {
        let columns = [
            "experiment",
            "inertia alpha",
            "alpha printed",
            "alpha raised",
            "linear drag beta_r",
            "beta_r printed",
            "quadratic drag beta_rr",
            "beta_rr printed",
        ];
        let table = Table::new("table4", "Recomputed and printed", &columns).note(format!(
            "{UNITS} Raised: with {:.3}e-2 N m added \
             to the relay level, the constant that fits best; it leaves {:.2} %.",
            self.table4.level_offset, self.table4.level_offset_residual_percent,
        ));
        table.rows(self.table4.rows.iter().map(|row| {
            let (new, old) = (row.recomputed, row.printed);
            let values = [new.alpha, old.alpha, row.alpha_raised, new.beta_r, old.beta_r, new.beta_rr, old.beta_rr];
            numbered(row.experiment, values)
        }))
    }

    pub(super) fn figure14_table(&self) -> Table {
        let columns =
            ["experiment", "inertia", "its bound", "linear drag", "bound of it", "quadratic drag", "bound of that"];
        let table = Table::new("fig14", "Relative errors and their bounds by quantisation (%)", &columns);
        table.rows(figure14(&self.printed).into_iter().map(|error| {
            let pairs = error.percent.named().into_iter().zip(error.bound_percent.named());
            numbered(error.experiment, pairs.flat_map(|((_, percent), (_, bound))| [percent, bound]))
        }))
    }

    pub(super) fn figure15_table(&self) -> Table {
        let title = "Fig. 15: the drag law from pairs of experiments with different relay levels";
        let table = Table::new("fig15", title, &["criterion", "margin", "pairs", "correct", "wrong", "undecided"]);
        table.rows(self.figure15.iter().zip(&CRITERIA).map(|(counts, criterion)| {
            let (correct, wrong, undecided) = (counts.correct, counts.wrong, counts.undecided);
            let [number, all, correct, wrong, undecided] =
                [counts.criterion, correct + wrong + undecided, correct, wrong, undecided]
                    .map(|number| Cell::count(number as usize));
            [number, criterion.margin.into(), all, correct, wrong, undecided]
        }))
    }

    pub(super) fn joint_table(&self) -> Table {
        let columns = ["law", "delay (s)", "inertia alpha", "linear beta_r", "quadratic beta_rr", "residual (%)"];
        let title = "All 19 experiments together, exact limit cycles (value and half-width of the 95 % interval)";
        let table = Table::new("joint", title, &columns).note(UNITS);
        let with_error = |value: f64, interval: Option<[f64; 2]>, decimals: usize| {
            let half = interval.map(|[low, high]| (high - value).max(value - low));
            let shown = half.map_or_else(String::new, |half| format!(" \u{b1} {half:.decimals$}"));
            Cell::from(format!("{value:.decimals$}{shown}").as_str())
        };
        let drag = |value: Option<f64>, interval| value.map_or(Cell::Missing, |value| with_error(value, interval, 2));
        table.rows(self.joint.iter().map(|row| {
            [
                row.drag.into(),
                with_error(row.delay_s, row.delay_interval_s, 2),
                with_error(row.alpha, row.alpha_interval, 2),
                drag(row.beta, row.beta_interval),
                drag(row.beta_quadratic, row.beta_quadratic_interval),
                Cell::number(100.0 * row.residual_rms, 1),
            ]
        }))
    }

    pub(super) fn audit_summary(&self) -> Table {
        let columns = ["printed quantity", "agree", "of", "off by", "reason"];
        let table = Table::new("audit", "Audit: printed numbers that meet their recomputation in intervals", &columns);
        table.rows(self.audit.iter().map(|group| {
            let (agree, of) = (Cell::count(group.agreeing()), Cell::count(group.items.len()));
            let difference = Cell::number(group.largest_difference(), 2);
            [group.name.as_str().into(), agree, of, difference, group.note.as_str().into()]
        }))
    }

    pub(super) fn consistency_table(&self) -> Table {
        let columns =
            ["all rows agree in", "relay level off by", "verdict", "delay (s)", "offset", "growth", "experiments"];
        let note = "Searched: delays 0 to 0.6 s, offsets of the relay level -1 to 2 (1e-2 N m), factors 0.5 to 2, drag coefficients of \
                    zero or more. Refuted: proved that nothing there meets all rows, by the formulas of first harmonics. Else what no \
                    row contradicts lies within the bounds of delay and offset. Growth: half-units of the last decimal so many times \
                    as large are refuted too, and so many are not by this search. Experiments: these alone are refuted, with a quarter of that growth.";
        let table = Table::new("consistency", "Table 4's rows at once, in intervals", &columns).note(note.to_owned());
        let bounds = |range: Option<(f64, f64)>, decimals: usize| {
            range.map_or(Cell::Missing, |(low, high)| {
                // Outwards, as they are bounds.
                let unit: f64 = std::iter::repeat_n(10.0, decimals).product();
                let (low, high) = ((low * unit).floor() / unit, (high * unit).ceil() / unit);
                Cell::from(format!("{low:.decimals$} to {high:.decimals$}").as_str())
            })
        };
        self.consistency().into_iter().fold(table, |table, found| {
            let verdict = match found.verdict {
                Verdict::Refuted => "refuted",
                Verdict::NotRefuted => "not refuted",
            };
            let growth = found.growth.map_or(Cell::Missing, |(refuted, met)| {
                let met = met.map_or_else(String::new, |met| format!(" to {:.1}", (10.0 * met).ceil() / 10.0));
                Cell::from(format!("{:.1}{met}", (10.0 * refuted).floor() / 10.0).as_str())
            });
            let experiments: Vec<String> = found.contradicting.iter().map(u32::to_string).collect();
            table.row([
                found.question.into(),
                found.allowed.into(),
                verdict.into(),
                bounds(found.delay_s, 4),
                bounds(found.level_offset.filter(|_| found.allowed.starts_with("offset")), 3),
                growth,
                experiments.join(", ").as_str().into(),
            ])
        })
    }

    pub(super) fn audit_table(&self) -> Table {
        let columns = ["group", "item", "printed", "recomputed", "lowest", "highest", "agrees", "note"];
        let table = Table::new("audit-items", "Every item", &columns);
        let items = self.audit.iter().flat_map(|group| group.items.iter().map(move |item| (group, item)));
        items.fold(table, |table, (group, item)| {
            let numbers =
                [item.printed, item.recomputed, item.range.0, item.range.1].map(|value| Cell::number(value, 3));
            let words = [Cell::from(group.name.as_str()), item.item.as_str().into()];
            let verdict = [Cell::Flag(item.agrees), item.note.as_str().into()];
            table.row(words.into_iter().chain(numbers).chain(verdict))
        })
    }
}
