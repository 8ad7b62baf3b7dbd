//! What was found, as tables and sentences.

use crate::features::CycleStatistics;
use crate::identify::joint::Estimate;
use crate::identify::select::likelihood::DECIDED;
use crate::identify::{Caution, Identification, Method, Model, Source};
use crate::report::{Cell, Table};

/// Digits that a measured number is shown with, after the first.
const DIGITS: u8 = 3;

fn cell(value: f64) -> Cell {
    // The magnitude after rounding: 0.99996 is shown as 1.000.
    let rounded = format!("{value:.digits$e}", digits = usize::from(DIGITS));
    let magnitude = rounded.split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0);
    Cell::number(value, usize::try_from(i32::from(DIGITS) - magnitude).unwrap_or(0).min(12))
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
        table.row([name.into(), cell(spread.mean), cell(spread.std)])
    };
    let table = row(table, "amplitude X_m", &f.amplitude);
    let table = row(table, "bias x_0", &f.bias);
    let table = row(table, "period T (s)", &f.period_s);
    let table = row(table, "switching level x_a*", &f.switch_level);
    let table = row(table, "time at +C (s)", &f.time_positive_s);
    let table = row(table, "time at -C (s)", &f.time_negative_s);
    Some(table.row(["relay level C".into(), cell(found.relay.level)]))
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
    Some(found.cycles.iter().enumerate().fold(table, |table, (number, cycle)| {
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
        table.row(numbers.map(cell).into_iter().chain([Cell::Flag(number >= start_up)]))
    }))
}

/// The drag law in one sentence.
#[must_use]
pub(crate) fn verdict(found: &Identification) -> String {
    match (found.choice(), found.likeliest_fit(), found.law_given()) {
        (Some((Some(law), confidence)), ..) => {
            format!("Drag is {}, with probability {confidence:.3} among the laws fitted.", law.name())
        }
        (Some((None, confidence)), Some(fit), _) => format!(
            "The drag law is undecided: {} drag is likeliest, but with probability {confidence:.3}, below {DECIDED}. A \
             record with another relay level decides.",
            fit.law().name()
        ),
        (_, _, Some(law)) => format!("Drag was taken to be {}.", law.name()),
        _ => "No drag law was chosen: that takes the fit.".to_owned(),
    }
}

/// The likeliest fit with its intervals, then every method.
pub(crate) fn model_tables(found: &Identification) -> impl Iterator<Item = Table> + use<> {
    let chosen = found.likeliest_fit().map(|fit| fit.law());
    let fit = found.models().iter().find(|model| model.method == Method::Fit && Some(model.drag) == chosen);
    fit.map(|model| parameter_table(found, model)).into_iter().chain([comparison(found)])
}

fn parameter_table(found: &Identification, model: &Model) -> Table {
    let title = format!("Parameters by fit, {} drag", model.drag.name());
    let columns = ["parameter", "value", "std", "95 % from", "to"];
    let named = [
        ("inertia alpha", Some(model.alpha)),
        ("linear drag beta", model.beta),
        ("quadratic drag beta_quadratic", model.beta_quadratic),
        ("delay (s)", Some(model.delay_s)),
    ];
    let shared = named.into_iter().filter_map(|(name, estimate)| Some((name.to_owned(), estimate?)));
    let deltas = found.sources().iter().zip(&model.deltas).map(|(source, delta)| match found.sources().len() {
        1 => ("disturbance delta".to_owned(), *delta),
        _ => (format!("disturbance delta in {}", source.name), *delta),
    });
    shared.chain(deltas).fold(Table::new("parameters", &title, &columns), |table, (name, estimate)| {
        let error = estimate.spread.map(|spread| [spread.std, spread.low, spread.high]);
        let error = error.map_or([const { Cell::Missing }; 3], |error| error.map(cell));
        table.row([Cell::Text(name), cell(estimate.value)].into_iter().chain(error))
    })
}

/// Every method beside the others.
fn comparison(found: &Identification) -> Table {
    let several = found.sources().len() > 1;
    let mut columns = vec!["method", "drag"];
    columns.extend(several.then_some("record"));
    columns.extend(["alpha", "beta", "beta_quadratic", "delta", "delay (s)", "fit (%)", "residual rms", "probability"]);
    let table = Table::new("methods", "Methods compared", &columns);
    found.models().iter().fold(table, |table, model| {
        let record = model.record.map_or("all", |index| &found.sources()[index].name);
        let fits = found.fits().filter(|_| model.method == Method::Fit && found.law_given().is_none());
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
            fits.map_or(Cell::Missing, |fits| Cell::number(fits.probability(model.drag), 3)),
        ]);
        table.row(cells)
    })
}

pub(super) fn caution_table(cautions: &[Caution]) -> Table {
    let table = Table::new("warnings", "Warnings", &["name", "meaning"]);
    cautions
        .iter()
        .fold(table, |table, caution| table.row([caution.code.as_ref().into(), caution.text.as_str().into()]))
}
