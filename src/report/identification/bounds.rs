//! Guaranteed bounds as tables and sentences.

use super::tables::cell;
use crate::identify::bounded::{Bounds, Consistency, DelayBound, Outlier, Quantity, QuantityRange};
use crate::identify::{Guaranteed, Identification};
use crate::report::{Cell, Table};

/// The bounds of every parameter with the witness, or the contradicting readings.
pub(crate) fn bounds_tables(found: &Identification, guaranteed: &Guaranteed) -> Vec<Table> {
    let bounds = &guaranteed.bounds;
    let tables = [
        (!bounds.bounds.is_empty()).then(|| bounds_table(found, bounds)),
        (!bounds.contradicting.is_empty()).then(|| contradiction_table(found, bounds)),
        (!bounds.outliers.is_empty()).then(|| outlier_table(found, bounds)),
    ];
    tables.into_iter().flatten().chain([search_table(found, bounds)]).collect()
}

fn name(found: &Identification, quantity: Quantity) -> Cell {
    match quantity.record().filter(|_| found.sources().len() > 1) {
        Some(record) => Cell::Text(format!("{quantity} in {}", found.sources()[record].name)),
        None => Cell::Text(quantity.to_string()),
    }
}

fn bounds_table(found: &Identification, bounds: &Bounds) -> Table {
    let table = Table::new("bounds", "Guaranteed bounds", &["parameter", "at least", "at most", "witness"]);
    table.rows(bounds.bounds.iter().map(|range| {
        let values = bounds.witness.iter().flat_map(|witness| &witness.values);
        let witness = values.filter(|(quantity, _)| *quantity == range.quantity).map(|(_, value)| cell(*value)).next();
        [name(found, range.quantity), cell(range.low), cell(range.high), witness.unwrap_or(Cell::Missing)]
    }))
}

fn search_table(found: &Identification, bounds: &Bounds) -> Table {
    let row = |range: &QuantityRange| [name(found, range.quantity), cell(range.low), cell(range.high)];
    Table::new("search", "Where parameters were looked for", &["quantity", "from", "to"])
        .rows(bounds.search_box.iter().map(row))
}

fn contradiction_table(found: &Identification, bounds: &Bounds) -> Table {
    let columns = ["record", "time (s)", "reading", "the model is", "share (%)"];
    let rows = bounds.contradicting.iter().map(|part| {
        let [record, time, reading] = sample_cells(found, part.record, part.sample);
        let side = if part.model_above { "not above" } else { "not below" };
        [record, time, reading, side.into(), Cell::number(100.0 * part.share, 1)]
    });
    Table::new("contradiction", "Readings that contradict each other", &columns).rows(rows).note(
        "No motion of the model stays within these bounds of these readings at once, in the part of the search box that was \
         excluded last; the share is each bound's weight in the proof.",
    )
}

fn outlier_table(found: &Identification, bounds: &Bounds) -> Table {
    let title = "Outliers: readings missed by every parameter that is left";
    let row = |&Outlier { record, sample }: &Outlier| sample_cells(found, record, sample);
    Table::new("outliers", title, &["record", "time (s)", "reading"]).rows(bounds.outliers.iter().map(row))
}

/// A reading: its record, time and value.
fn sample_cells(found: &Identification, record: usize, sample: usize) -> [Cell; 3] {
    let source = &found.sources()[record];
    let (time_s, output) = (source.log.record.time_s()[sample], source.log.record.output()[sample]);
    [source.name.as_str().into(), Cell::number(time_s, 3), cell(output)]
}

/// So many readings, in words.
fn readings(number: usize) -> String {
    if number == 1 { "one reading".to_owned() } else { format!("{number} readings") }
}

/// The sentence on outliers.
fn doubted(allowed: usize, found: usize, met: bool) -> String {
    let rest = allowed - found.min(allowed);
    let up_to = format!(" Up to {} may be in error by any amount", readings(allowed));
    match (allowed, found) {
        (0, _) => String::new(),
        (_, 0) => format!("{up_to}; none is known to be."),
        _ if rest == 0 && met => format!("{up_to}: those of the table are, and every other one is met."),
        _ if rest == 0 => format!("{up_to}: those of the table are."),
        _ => format!(
            "{up_to}: those of the table are. {} more may be, which makes the bounds wider than with {found} allowed.",
            if rest == 1 { "One".to_owned() } else { rest.to_string() }
        ),
    }
}

/// The answer in sentences.
#[must_use]
pub(crate) fn bounds_verdict(guaranteed: &Guaranteed) -> String {
    let (model, bounds) = (&guaranteed.model, &guaranteed.bounds);
    let delay = match model.delay {
        DelayBound::KnownS(delay_s) => format!("a delay of {delay_s} s"),
        DelayBound::WithinS([low, high]) => format!("a delay between {low} and {high} s"),
        DelayBound::Unknown => "an unknown delay".to_owned(),
    };
    let mut terms = vec![format!("{} drag", model.law.name())];
    let given = [
        (model.either_sign, "linear drag of either sign"),
        (model.cubic, "cubic drag"),
        (model.stiffness, "a restoring force"),
        (model.lag, "a lag"),
    ];
    terms.extend(given.into_iter().filter(|(given, _)| *given).map(|(_, term)| term.to_owned()));
    let of = format!("{} and {delay}", terms.join(", "));
    let errors: Vec<String> = bounds.error.iter().map(|error| format!("{error:.4e}")).collect();
    let [least, most] = bounds.error_factor;
    let every = match model.outliers {
        0 => "every reading".to_owned(),
        some => format!("every reading but {} at most", if some == 1 { "one".to_owned() } else { some.to_string() }),
    };
    let budget = if model.budget == 1 { "one pass".to_owned() } else { format!("{} passes", model.budget) };
    let answer = match bounds.verdict {
        Consistency::Consistent => format!(
            "Consistent: a parameter of the model with {of} meets {every}, and every parameter in the search box that does lies \
             within the bounds."
        ),
        Consistency::Refuted => format!(
            "Refuted: no parameter in the search box lets the model with {of} meet {every}. This is proved by interval \
             arithmetic, without an assumption on the distribution of errors."
        ),
        Consistency::Undecided => format!(
            "Undecided: the budget of {budget} was spent before a parameter of the model with {of} was found that meets \
             {every}, or all were excluded. The bounds hold nevertheless; a larger --budget may decide."
        ),
    };
    let granted = format!("Every reading was granted an error of {}.", errors.join(", "));
    let smallest = match bounds.verdict {
        Consistency::Refuted if most < f64::MAX => {
            format!(
                " With {most:.3} times that error a parameter would meet {every}; with no more than that error none does."
            )
        }
        Consistency::Refuted => String::new(),
        _ if least > 0.0 => format!(" With less than {least:.3} times that error none would."),
        _ => String::new(),
    };
    let doubted = match bounds.verdict {
        Consistency::Refuted => String::new(),
        verdict => doubted(model.outliers, bounds.outliers.len(), verdict == Consistency::Consistent),
    };
    let wide = if bounds.verdict == Consistency::Consistent && bounds.passes >= model.budget {
        format!(
            " The budget of {budget} was spent before all of the search box was worked off: the bounds hold, but may be far \
             wider than what the readings leave; a larger --budget may draw them in."
        )
    } else {
        String::new()
    };
    format!("{answer}{wide}\n{granted}{smallest}{doubted}")
}
