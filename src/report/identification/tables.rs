//! What was found, as tables and sentences.

use crate::features::CycleStatistics;
use crate::identify::document::UnitNames;
use crate::identify::{
    BudgetEntry, Caution, ConfidenceInterval, DragLaw, DragVerdict, Estimate, Identification, Prediction, Reason,
    Reported, Source, Trust,
};
use crate::numeric::significant;
use crate::report::{Cell, Table, Uncertain};

/// Digits that a measured number is shown with, after the first.
const DIGITS: u8 = 3;
/// Less than this is rounding, in whatever unit.
const NOTHING: f64 = 1e-12;

pub(super) fn cell(value: f64) -> Cell {
    // The magnitude after rounding: 0.99996 is shown as 1.000.
    let rounded = format!("{value:.digits$e}", digits = usize::from(DIGITS));
    let magnitude = rounded.split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0);
    let decimals = i32::from(DIGITS) - magnitude;
    // Rounding of what is zero has no digits to show.
    let decimals = if value.abs() < NOTHING { i32::from(DIGITS) } else { decimals };
    Cell::number(value, usize::try_from(decimals).unwrap_or(0))
}

fn value(estimate: Option<Estimate>) -> Cell {
    estimate.map_or(Cell::Missing, |estimate| cell(estimate.value))
}

/// One sentence on size and cycles.
#[must_use]
pub(crate) fn summary(source: &Source) -> String {
    let record = &source.log.record;
    let cycles = source.features.as_ref().map_or_else(String::new, |found| {
        format!(", {} steady cycles after {} of start-up", found.features.cycles, found.features.start_up_cycles)
    });
    let turns = match source.log.unwrapped {
        0 => String::new(),
        jumps => format!("; {jumps} jumps by a turn taken out"),
    };
    let turns = match source.log.skipped {
        0 => turns,
        rows => format!("{turns}; {rows} rows that cannot be used left out"),
    };
    let unit = if source.log.degrees { " in degrees" } else { "" };
    format!(
        "{}: {} samples over {:.1} s{cycles}; columns {}, {}{unit}, {}{turns}.",
        source.name,
        record.samples(),
        record.duration_s(),
        source.log.columns[0],
        source.log.columns[1],
        source.log.columns[2],
    )
}

/// Name of the output with its unit.
pub(super) fn output_label(source: &Source) -> &'static str {
    if source.log.degrees { "output (rad)" } else { "output" }
}

/// Means over the steady cycles.
#[must_use]
pub(crate) fn feature_table(source: &Source) -> Option<Table> {
    let found = source.features.as_ref()?;
    let f = &found.features;
    let title = format!("Features over {} steady cycles", f.cycles);
    let table = Table::new("features", &title, &["feature", "mean", "spread"]);
    let row = |table: Table, name: &str, spread: &CycleStatistics<f64>| {
        if spread.std < NOTHING * spread.mean.abs() {
            return table.row([name.into(), cell(spread.mean), cell(0.0)]);
        }
        let Uncertain { value, half_width, .. } = Uncertain::new(spread.mean, spread.std);
        table.row([name.into(), Cell::Text(value), Cell::Text(half_width)])
    };
    let angle = if source.log.degrees { " (rad)" } else { "" };
    let table = row(table, &format!("amplitude X_m{angle}"), &f.amplitude);
    let table = row(table, &format!("bias x_0{angle}"), &f.bias);
    let table = row(table, "period T (s)", &f.period_s);
    let table = row(table, &format!("switching level x_a*{angle}"), &f.switch_level);
    let table = row(table, "time at +C (s)", &f.time_positive_s);
    let table = row(table, "time at -C (s)", &f.time_negative_s);
    let table = table.row(["relay level C".into(), cell(found.relay.level)]);
    let ramp = (found.ramp_s > 0.0).then(|| ["from level to level (s)".into(), cell(found.ramp_s)]);
    Some(ramp.into_iter().fold(table, Table::row))
}

/// Every cycle.
pub(super) fn cycle_table(source: &Source) -> Option<Table> {
    let found = source.features.as_ref()?;
    let columns = [
        "begins (s)",
        "period (s)",
        "at +C (s)",
        "at -C (s)",
        "maximum",
        "minimum",
        "amplitude",
        "switching level",
        "used",
    ];
    let table = Table::new("cycles", "Cycles", &columns);
    let start_up = found.features.start_up_cycles as usize;
    Some(table.rows(found.cycles.iter().enumerate().map(|(number, cycle)| {
        let numbers = [
            cycle.begin_s,
            cycle.period_s,
            cycle.time_positive_s,
            cycle.time_negative_s(),
            cycle.maximum,
            cycle.minimum,
            cycle.amplitude(),
            cycle.switch_level(),
        ];
        numbers.map(cell).into_iter().chain([Cell::Flag(number >= start_up)])
    })))
}

/// The inertia, the trust, the drag law, the units and what to do next, a sentence each.
#[must_use]
pub(crate) fn verdict(found: &Identification) -> String {
    let Some(reported) = found.reported() else { return "Nothing is reported: that takes the fit.".to_owned() };
    let trust = match reported.trust {
        Trust::Good => "Trust: good. No test contradicts the model.",
        Trust::Widened => "Trust: widened. The intervals allow for what is named below.",
        Trust::Doubtful => "Trust: doubtful. Do not use the numbers, for the reasons named below.",
    };
    let (alpha, drag, next) =
        (inertia_sentence(reported.alpha), drag_sentence(found, reported), next_sentence(found, reported));
    format!("{alpha}{trust}\n{drag}\n{SCALE}\n{next}")
}

/// What to do next: gains, and what narrows the practical interval most; without trust, another record.
fn next_sentence(found: &Identification, reported: &Reported) -> String {
    if reported.trust == Trust::Doubtful {
        return "Next: another record. `selfosc design` computes which level and half-width.".to_owned();
    }
    let half = |interval: Option<ConfidenceInterval>| interval.map_or(0.0, |ends| 0.5 * (ends.high - ends.low));
    // H^2 = (2 h)^2 + declared^2.
    let (statistical, practical) = (2.0 * half(reported.alpha.spread), half(reported.alpha.combined));
    let narrower = match reported.budget.first() {
        Some(largest) if 2.0 * statistical.powi(2) < practical.powi(2) => largest.remedy.as_ref(),
        _ if found.cautions().iter().any(|caution| caution.code == "locked") => {
            "record another relay level and give both"
        }
        _ => "record longer, or as `selfosc design` proposes",
    };
    format!(
        "Next: gains, by `selfosc tune --model FILE` with this answer's --json as FILE. For a narrower interval, {narrower}."
    )
}

/// The inertia with both intervals, the practical one first.
fn inertia_sentence(alpha: Estimate) -> String {
    let Some((statistical, practical)) = alpha.spread.zip(alpha.combined) else { return String::new() };
    let [practical, statistical] = [practical, statistical].map(|interval| between(alpha, interval));
    let (Uncertain { value, half_width, .. }, exact) = (practical, statistical.half_width);
    format!("alpha = {value} \u{b1} {half_width} (practical, 95 %; \u{b1} {exact} if the model is exact).\n")
}

/// An estimate with one of its intervals.
fn between(estimate: Estimate, interval: ConfidenceInterval) -> Uncertain {
    Uncertain::between(estimate.value, interval.low, interval.high)
}

/// Sources shown to a person; the document has all.
const SHOWN_SOURCES: usize = 3;

/// What the practical intervals hold beside the record's scatter.
fn budget_table(reported: &Reported) -> Option<Table> {
    let columns = ["source", "size", "unit", "of alpha (%)", "what lowers it"];
    let table = Table::new("budget", "Errors that no residual shows, the largest first", &columns);
    let rows = reported.budget.iter().take(SHOWN_SOURCES);
    let row = |entry: &BudgetEntry| {
        let [source, unit, remedy] = [&entry.source, &entry.unit, &entry.remedy].map(|text| Cell::from(text.as_ref()));
        [source, Cell::Text(significant(entry.size, 2)), unit, Cell::number(entry.share_percent, 2), remedy]
    };
    (!reported.budget.is_empty()).then(|| table.rows(rows.map(row)))
}

/// Stated once: the scale that no record shows.
const SCALE: &str = "All parameters are in units of the logged command: its scale in newtons, and at one level its dead zone and \
                     asymmetry, no record shows.";

fn drag_sentence(found: &Identification, reported: &Reported) -> String {
    if let Some(law) = found.law_given() {
        return format!("Drag was taken to be {}.", law.name());
    }
    let laws = reported.laws;
    let gap = |law: DragLaw| laws.of(law).map_or(0.0, |value| (0.0 - value).max(0.0));
    match laws.verdict() {
        Some(DragVerdict::NotDistinguishable) => format!(
            "Neither simple drag law is refuted: linear drag alone loses {:.1} and quadratic drag alone {:.1} in log-likelihood.",
            gap(DragLaw::Linear),
            gap(DragLaw::Quadratic),
        ),
        Some(DragVerdict::Law(DragLaw::Mixed)) => format!(
            "Drag is mixed: linear drag alone loses {:.1} and quadratic drag alone {:.1} in log-likelihood.",
            gap(DragLaw::Linear),
            gap(DragLaw::Quadratic),
        ),
        Some(DragVerdict::Law(law)) => {
            let other = if law == DragLaw::Linear { DragLaw::Quadratic } else { DragLaw::Linear };
            format!(
                "{} drag alone is refuted: it loses {:.1} in log-likelihood. {} drag alone loses {:.1} and is not: the interval of \
                 the {} drag says how much there may be.",
                capitalised(other.name()),
                gap(other),
                capitalised(law.name()),
                gap(law),
                other.name(),
            )
        }
        None => "No verdict on the drag law: not every law could be fitted.".to_owned(),
    }
}

fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Why the answer is not simply good, a line each.
#[must_use]
pub(crate) fn reasons(found: &Identification) -> Vec<Caution> {
    let reasons = found.reported().map_or(&[][..], |reported| &reported.reasons);
    reasons.iter().copied().map(|reason: Reason| Caution::from(reason)).collect()
}

/// The answer with its intervals, and what they hold beside the record's scatter.
pub(crate) fn answer_tables(found: &Identification) -> Vec<Table> {
    let Some(reported) = found.reported() else { return Vec::new() };
    [parameter_table(found, reported)].into_iter().chain(budget_table(reported)).collect()
}

/// Every method, and records predicted.
pub(crate) fn method_tables(found: &Identification) -> Vec<Table> {
    let compared = (!found.models().is_empty()).then(|| comparison(found));
    compared.into_iter().chain(prediction_table(found)).collect()
}

fn parameter_table(found: &Identification, reported: &Reported) -> Table {
    let terms: Vec<&str> = reported.terms.iter().map(|term| term.name()).collect();
    let terms = if terms.is_empty() { String::new() } else { format!(", with {}", terms.join(", ")) };
    let title = format!("Reported: {} drag{terms}", reported.drag.name());
    let columns = ["parameter", "value \u{b1} practical, 95 %", "\u{b1} if exact", "unit"];
    let units = UnitNames::of(found.sources());
    let (one, second) = (String::new(), "s".to_owned());
    let [alpha, beta, quadratic, cubic, stiffness] =
        [&units.alpha, &units.beta, &units.beta_quadratic, &units.beta_cubic, &units.stiffness]
            .map(|unit| unit.replace("output", &units.output));
    let force = units.delta.clone().into_owned();
    let named = [
        ("inertia alpha", Some(reported.alpha), &alpha),
        ("linear drag beta", reported.drag.has_linear().then_some(reported.beta), &beta),
        ("quadratic drag beta_quadratic", reported.drag.has_quadratic().then_some(reported.beta_quadratic), &quadratic),
        ("cubic drag beta_cubic", reported.beta_cubic, &cubic),
        ("one-sidedness of drag skew", reported.skew, &one),
        ("drag that follows late memory", reported.memory, &beta),
        ("its time constant", reported.memory_s, &second),
        ("restoring force stiffness", reported.stiffness, &stiffness),
        ("delay", Some(reported.delay_s), &second),
        ("lag of the actuator", reported.lag_s, &second),
        ("ramp of the actuator", reported.ramp_s, &second),
        ("pause at a reversal", reported.pause_s, &second),
        ("filter of the sensor", reported.filter_s, &second),
    ];
    let shared = named.into_iter().filter_map(|(name, estimate, unit)| Some((name.to_owned(), estimate?, unit)));
    let deltas = found.sources().iter().zip(&*reported.deltas).map(|(source, delta)| match found.sources().len() {
        1 => ("disturbance delta".to_owned(), *delta, &force),
        _ => (format!("disturbance delta in {}", source.name), *delta, &force),
    });
    shared.chain(deltas).fold(Table::new("parameters", &title, &columns), |table, (name, estimate, unit)| {
        let value = estimate.combined.map_or_else(
            || significant(estimate.value, usize::from(DIGITS) + 1),
            |interval| between(estimate, interval).to_string(),
        );
        let exact = estimate.spread.map_or_else(String::new, |interval| between(estimate, interval).half_width);
        table.row([Cell::Text(name), Cell::Text(value), Cell::Text(exact), Cell::from(unit.as_str())])
    })
}

/// Comparison of the methods.
fn comparison(found: &Identification) -> Table {
    let several = found.sources().len() > 1;
    let mut columns = vec!["method", "drag"];
    columns.extend(several.then_some("record"));
    columns.extend([
        "alpha",
        "beta",
        "beta_quadratic",
        "delta",
        "delay (s)",
        "fit (%)",
        "residual rms",
        "log-likelihood",
    ]);
    let table = Table::new("methods", "Methods compared", &columns);
    found.models().iter().fold(table, |table, model| {
        let record = model.record.map_or("all", |index| &found.sources()[index].name);
        let mut cells = vec![model.method.name().into(), model.drag.name().into()];
        cells.extend(several.then(|| record.into()));
        cells.extend([
            cell(model.alpha.value),
            value(model.beta),
            value(model.beta_quadratic),
            value(model.delta()),
            cell(model.delay_s.value),
            model.fit_percent.map_or(Cell::Missing, |percent| Cell::number(percent, 2)),
            model.residual_rms.map_or(Cell::Missing, cell),
            model.log_likelihood.map_or(Cell::Missing, |value| Cell::number(value, 1)),
        ]);
        table.row(cells)
    })
}

/// Records predicted by an answer that they had no part in.
fn prediction_table(found: &Identification) -> Option<Table> {
    let left_out = found.sources().iter().zip(found.left_out());
    let left_out = left_out.filter_map(|(source, predicted)| Some((&source.name, "the other records", (*predicted)?)));
    let validated = found.validation().iter().filter_map(|one| Some((&one.file, "all records", one.prediction?)));
    let columns = ["record", "predicted from", "fit (%)", "rms", "disturbance"];
    let rows: Vec<_> = left_out.chain(validated).collect();
    let table = Table::new("predictions", "Records predicted", &columns);
    (!rows.is_empty()).then(|| {
        table.rows(rows.into_iter().map(|(name, from, Prediction { fit_percent, rms, disturbance })| {
            [name.as_str().into(), from.into(), Cell::number(fit_percent, 2), cell(rms), cell(disturbance)]
        }))
    })
}

/// What was refused, by whom and why.
pub(super) fn refused_table(found: &Identification) -> Option<Table> {
    let table = Table::new("refused", "Methods without a model", &["method", "name", "reason"]);
    let rows = found.refused().iter().map(|one| [&*one.method, &*one.code, &*one.text].map(Cell::from));
    (!found.refused().is_empty()).then(|| table.rows(rows))
}

pub(super) fn caution_table(name: &'static str, title: &str, cautions: &[Caution]) -> Option<Table> {
    let table = Table::new(name, title, &["name", "meaning"]);
    let rows = cautions.iter().map(|caution| [caution.code.as_ref().into(), caution.text.as_str().into()]);
    (!cautions.is_empty()).then(|| table.rows(rows))
}

#[cfg(test)]
mod tests {
    use super::{Cell, cell};

    #[test]
    fn rounding_of_zero_shows_no_digits() {
        assert_eq!(cell(3e-16), Cell::number(3e-16, 3));
        assert_eq!(cell(-6.345e-7), Cell::number(-6.345e-7, 10));
        assert_eq!(cell(0.99996), Cell::number(0.99996, 3));
    }
}
