//! One vehicle identified from its records, as tables, figures and sentences.

mod bounds;
mod figures;
mod samples;
mod tables;

pub(crate) use bounds::{bounds_tables, bounds_verdict};
pub(crate) use samples::samples;
pub(crate) use tables::{feature_table, model_tables, reasons, summary, verdict};

use super::{Document, Section};
use crate::identify::{Identification, Source};
use figures::figures;
use tables::{caution_table, cycle_table, refused_table};

/// Everything as one file.
#[must_use]
pub fn document(found: &Identification) -> Document {
    let mut tables = model_tables(found);
    let parameters = found.reported().and_then(|_| tables.next());
    let reasons = caution_table("reasons", "Why the answer is not simply good", &reasons(found));
    let cautions = caution_table("warnings", "Warnings", found.cautions());
    let summary = Section {
        title: "Model".to_owned(),
        paragraphs: found.bounded().map_or_else(|| verdict(found), bounds_verdict).lines().map(str::to_owned).collect(),
        tables: found
            .bounded()
            .into_iter()
            .flat_map(|bounded| bounds_tables(found, bounded))
            .chain([parameters, reasons].into_iter().flatten())
            .chain(tables)
            .chain(refused_table(found))
            .chain(cautions)
            .collect(),
        figures: Vec::new(),
    };
    let records = found.sources().iter().enumerate().map(|(index, source)| record_section(found, index, source));
    let methods = figures::interval_figure(found).map(|figure| Section {
        title: "Methods beside each other".to_owned(),
        paragraphs: vec![
            "A dot without a bar comes without an interval. The bars of the fits hold where their own drag law does; that of \
             the answer also allows for what the record leaves open."
                .to_owned(),
        ],
        figures: vec![figure],
        ..Section::default()
    });
    Document {
        title: "Identification from self-oscillations".to_owned(),
        sections: std::iter::once(summary).chain(records).chain(methods).collect(),
        provenance: vec![concat!("Written by selfosc ", env!("CARGO_PKG_VERSION")).to_owned()],
    }
}

fn record_section(found: &Identification, index: usize, source: &Source) -> Section {
    let fitted = found.likeliest_fit().map(|fit| (fit, &fit.records()[index]));
    let mut paragraphs = vec![summary(source)];
    paragraphs.extend(fitted.map(|(fit, record)| {
        format!(
            "The model with {} drag leaves residuals of rms {:.3e} and explains {:.1} % of the output's variation; \
             successive residuals have correlation {:.2}.",
            fit.law().name(),
            record.residual_rms,
            record.fit_percent,
            record.autocorrelation
        )
    }));
    Section {
        title: format!("Record {}", source.name),
        paragraphs,
        tables: feature_table(source).into_iter().chain(cycle_table(source)).collect(),
        figures: figures(source, fitted),
    }
}
