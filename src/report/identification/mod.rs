//! One vehicle identified from its records, as tables, figures and sentences.

mod bounds;
mod figures;
mod samples;
mod tables;

pub(crate) use bounds::{bounds_tables, bounds_verdict};
pub(crate) use samples::samples;
pub(crate) use tables::{answer_tables, feature_table, method_tables, reasons, summary, verdict};

use super::{Document, Section, Table};
use crate::identify::fit::RecordFit;
use crate::identify::{Identification, Source};
use figures::Predicted;
use tables::{caution_table, cycle_table, refused_table};

/// The model, as the guide has it.
const MODEL: &str =
    r"\alpha \ddot x + \beta \dot x + \beta_{\text{quadratic}} |\dot x| \dot x = u(t - \text{delay}) + \delta";

/// Everything as one file: the answer, its numbers and their errors, the records, then every method.
#[must_use]
pub fn document(found: &Identification) -> Document {
    let answer = found.bounded().map_or_else(|| verdict(found), bounds_verdict);
    let bounds = found.bounded().into_iter().flat_map(|bounded| bounds_tables(found, bounded));
    let reasons = caution_table("reasons", "Why the answer is not simply good", &reasons(found));
    let (parameters, budget): (Vec<_>, Vec<_>) =
        answer_tables(found).into_iter().partition(|table| table.name == "parameters");
    let cautions = caution_table("warnings", "Warnings", found.cautions());
    let model = Section {
        title: "Model".to_owned(),
        paragraphs: vec!["The model, with output x and command u:".to_owned()],
        equations: vec![MODEL],
        tables: reasons.into_iter().chain(bounds).chain(parameters).chain(cautions).collect(),
        ..Section::default()
    };
    let errors = (!budget.is_empty()).then(|| Section {
        title: "Budget of errors".to_owned(),
        tables: budget,
        figures: figures::budget_figure(found).into_iter().collect(),
        ..Section::default()
    });
    let records = found.sources().iter().enumerate().flat_map(|(index, source)| record_sections(found, index, source));
    let tables: Vec<Table> = method_tables(found).into_iter().chain(refused_table(found)).collect();
    let methods = (!tables.is_empty()).then(|| Section {
        title: "Methods beside each other".to_owned(),
        paragraphs: vec![
            "The bars of the fits hold where their own drag law does; that of the answer also allows for what the record leaves open."
                .to_owned(),
        ],
        tables,
        figures: figures::interval_figure(found).into_iter().collect(),
        ..Section::default()
    });
    Document {
        title: "Identification from self-oscillations".to_owned(),
        answer: answer.lines().map(str::to_owned).collect(),
        sections: std::iter::once(model).chain(errors).chain(records).chain(methods).collect(),
        provenance: vec![concat!("Written by selfosc ", env!("CARGO_PKG_VERSION")).to_owned()],
    }
}

/// A record with the reported model, then what the model leaves of it.
fn record_sections(found: &Identification, index: usize, source: &Source) -> Vec<Section> {
    let between = found.likeliest_fit().map(RecordFit::between);
    let predicted = Predicted::of(found, index);
    let record = Section {
        title: format!("Record {}", source.name),
        paragraphs: vec![summary(source)],
        tables: feature_table(source).into_iter().chain(cycle_table(source).map(Table::folded)).collect(),
        figures: vec![figures::record(source, predicted.as_ref(), between)],
        ..Section::default()
    };
    let residuals = predicted.map(|predicted| Section {
        title: if found.sources().len() > 1 {
            format!("Residuals of record {}", index + 1)
        } else {
            "Residuals".to_owned()
        },
        paragraphs: vec![predicted.sentence()],
        figures: figures::residuals(source, &predicted),
        ..Section::default()
    });
    [record].into_iter().chain(residuals).collect()
}
