//! One vehicle identified from its records.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::model::Model;
use super::settings::Method;
use crate::experiment::Log;
use crate::features::RecordFeatures;
use crate::identify::fit::RecordFit;
use crate::identify::select::likelihood::Choice;
use crate::identify::{DragLaw, Warning};

/// Something to know before trusting the result.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Caution {
    /// Short name for scripts.
    pub code: Cow<'static, str>,
    /// What it means and what to do.
    pub text: String,
}

impl From<Warning> for Caution {
    fn from(warning: Warning) -> Self {
        Self { code: warning.code().into(), text: warning.to_string() }
    }
}

/// A record with what it shows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Where it comes from.
    pub name: String,
    /// The record with its columns, the command in the units wanted.
    pub log: Log,
    /// Its features; `None` where it shows no steady self-oscillation under a relay.
    pub features: Option<RecordFeatures>,
}

impl Source {
    /// With the record's name where there are several.
    pub(super) fn caution(&self, warning: Warning, record: Option<usize>) -> Caution {
        let text = if record.is_some() { format!("{}: {warning}", self.name) } else { warning.to_string() };
        Caution { code: warning.code().into(), text }
    }
}

/// One vehicle identified from its records: everything that the methods found, with the records themselves.
///
/// As JSON it comes back equal, records and residuals included; [`conclusion`](Self::conclusion) is the short document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Parts")]
pub struct Identification {
    pub(super) sources: Vec<Source>,
    pub(super) models: Vec<Model>,
    pub(super) fits: Option<Choice>,
    pub(super) cautions: Vec<Caution>,
    pub(super) law_given: Option<DragLaw>,
}

/// The same, not known to belong together.
#[derive(Deserialize)]
struct Parts {
    sources: Vec<Source>,
    models: Vec<Model>,
    fits: Option<Choice>,
    cautions: Vec<Caution>,
    law_given: Option<DragLaw>,
}

impl TryFrom<Parts> for Identification {
    type Error = &'static str;

    fn try_from(parts: Parts) -> Result<Self, Self::Error> {
        let Parts { sources, models, fits, cautions, law_given } = parts;
        let covers = |fit: &RecordFit| {
            fit.records().len() == sources.len()
                && fit.records().iter().zip(&sources).all(|(fitted, source)| {
                    let last = fitted.first_sample.checked_add(fitted.output.len());
                    fitted.output.len() == fitted.residuals.len()
                        && last.is_some_and(|last| last <= source.log.record.samples())
                })
        };
        if !fits.iter().flat_map(Choice::fits).all(covers) {
            return Err("a fit does not belong to these records; keep a document as it was written");
        }
        if models.iter().any(|model| model.record.is_some_and(|index| index >= sources.len())) {
            return Err("a model belongs to a record that is not there; keep a document as it was written");
        }
        Ok(Self { sources, models, fits, cautions, law_given })
    }
}

impl Identification {
    /// The one model to use: that of the likeliest fit, with its intervals. `None` where no fit was asked for or possible: the
    /// methods for mean cycles neither decide between drag laws nor know their errors.
    #[must_use]
    pub fn reported(&self) -> Option<&Model> {
        let law = self.likeliest_fit()?.law();
        self.models.iter().find(|model| model.method == Method::Fit && model.drag == law)
    }

    /// The records, in the order given.
    #[must_use]
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// What every method found under every law, the fits last.
    #[must_use]
    pub fn models(&self) -> &[Model] {
        &self.models
    }

    /// The fits to all records at once; `None` where none was asked for or possible.
    #[must_use]
    pub fn fits(&self) -> Option<&Choice> {
        self.fits.as_ref()
    }

    /// The likeliest fit, with its residuals.
    #[must_use]
    pub fn likeliest_fit(&self) -> Option<&RecordFit> {
        self.fits.as_ref().map(Choice::likeliest)
    }

    /// What to beware of.
    #[must_use]
    pub fn cautions(&self) -> &[Caution] {
        &self.cautions
    }

    /// The drag law that the records speak for with its probability; no law where none is certain enough, and nothing where
    /// the law was given or nothing was fitted.
    #[must_use]
    pub fn choice(&self) -> Option<(Option<DragLaw>, f64)> {
        let fits = self.fits.as_ref().filter(|_| self.law_given.is_none())?;
        Some((fits.decision(), fits.probability(fits.likeliest().law())))
    }

    /// The drag law given beforehand.
    #[must_use]
    pub fn law_given(&self) -> Option<DragLaw> {
        self.law_given
    }
}
