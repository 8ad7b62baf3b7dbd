//! A vehicle identified from its records.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::guaranteed::Guaranteed;
use super::model::Model;
use crate::experiment::Log;
use crate::features::RecordFeatures;
use crate::identify::answer::{DragLaw, Reason, Reported, Warning};
use crate::identify::bounded::certificate::ReadAs;
use crate::identify::fit::prediction_error::Prediction;
use crate::identify::fit::select::likelihood::Choice;
use crate::identify::fit::shooting::RecordFit;

/// Something to know before trusting the result.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Caution {
    /// Short name for scripts.
    pub code: Cow<'static, str>,
    /// Meaning and remedy.
    pub text: String,
}

impl From<Warning> for Caution {
    fn from(warning: Warning) -> Self {
        Self { code: warning.code().into(), text: warning.to_string() }
    }
}

impl From<Reason> for Caution {
    fn from(reason: Reason) -> Self {
        Self { code: reason.code().into(), text: reason.to_string() }
    }
}

/// A method that gives no model of these records, under a given law or under any law.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MethodRefusal {
    /// The method: a name of [`Method`](super::Method), or `prediction-error` for the answer to use.
    pub method: Cow<'static, str>,
    /// Short name of the reason for scripts.
    pub code: Cow<'static, str>,
    /// The reason.
    pub text: String,
}

/// A record with its features.
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
    pub(super) fn caution(&self, warning: Warning, several: bool) -> Caution {
        let text = if several { format!("{}: {warning}", self.name) } else { warning.to_string() };
        Caution { code: warning.code().into(), text }
    }

    /// Of a record with the samples of an earlier record.
    pub(super) fn same_as_one_of(&self, earlier: &[Self]) -> Option<Caution> {
        let record = &self.log.record;
        let same =
            |other: &&Self| other.log.record.output() == record.output() && other.log.record.input() == record.input();
        let other = earlier.iter().find(same)?;
        let text = format!(
            "{} has the samples of {}: they count twice, and the statistical intervals are too narrow; give every record once",
            self.name, other.name
        );
        Some(Caution { code: "same-record".into(), text })
    }
}

/// A record that took no part in the estimate, and how well the answer predicts it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Validation {
    /// Where it comes from.
    pub file: String,
    /// The prediction; null where nothing is reported, or the motion diverged.
    pub prediction: Option<Prediction>,
}

/// A vehicle identified from its records: the results of all methods, and the records.
///
/// As JSON it comes back equal, records and residuals included; [`conclusion`](Self::conclusion) is the short document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "UncheckedIdentification")]
pub struct Identification {
    pub(super) sources: Vec<Source>,
    pub(super) reported: Option<Reported>,
    pub(super) left_out: Vec<Option<Prediction>>,
    pub(super) validation: Vec<Validation>,
    pub(super) bounded: Option<Guaranteed>,
    pub(super) models: Vec<Model>,
    pub(super) fits: Option<Choice>,
    pub(super) cautions: Vec<Caution>,
    pub(super) refused: Vec<MethodRefusal>,
    pub(super) law_given: Option<DragLaw>,
}

/// The same fields, not yet checked for consistency.
#[derive(Deserialize)]
struct UncheckedIdentification {
    sources: Vec<Source>,
    reported: Option<Reported>,
    left_out: Vec<Option<Prediction>>,
    validation: Vec<Validation>,
    #[serde(default)]
    bounded: Option<Guaranteed>,
    models: Vec<Model>,
    fits: Option<Choice>,
    cautions: Vec<Caution>,
    refused: Vec<MethodRefusal>,
    law_given: Option<DragLaw>,
}

impl TryFrom<UncheckedIdentification> for Identification {
    type Error = &'static str;

    fn try_from(parts: UncheckedIdentification) -> Result<Self, Self::Error> {
        let UncheckedIdentification {
            sources,
            reported,
            bounded,
            left_out,
            validation,
            models,
            fits,
            cautions,
            refused,
            law_given,
        } = parts;
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
        if reported.as_ref().is_some_and(|reported| reported.deltas.len() != sources.len()) {
            return Err("the answer has not one disturbance for each record; keep a document as it was written");
        }
        Ok(Self { sources, reported, bounded, left_out, validation, models, fits, cautions, refused, law_given })
    }
}

impl Identification {
    /// The answer to use, with its trust and the reasons. `None` where the fit was not asked for or refused: the methods for
    /// mean cycles neither tell drag laws apart nor know their errors.
    #[must_use]
    pub fn reported(&self) -> Option<&Reported> {
        self.reported.as_ref()
    }

    /// Each record predicted from the rest, in the order given: `None` for a single record, or without a reported model.
    #[must_use]
    pub fn left_out(&self) -> &[Option<Prediction>] {
        &self.left_out
    }

    /// Records that were predicted and took no part in the estimate.
    #[must_use]
    pub fn validation(&self) -> &[Validation] {
        &self.validation
    }

    /// Adds to the proof how its logs were read.
    pub(super) fn read_as(self, read_as: &ReadAs) -> Self {
        Self { bounded: self.bounded.map(|bounded| bounded.read_as(read_as)), ..self }
    }

    /// The guaranteed bounds; `None` where they were not asked for.
    #[must_use]
    pub fn bounded(&self) -> Option<&Guaranteed> {
        self.bounded.as_ref()
    }

    /// The records, in the order given.
    #[must_use]
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// Models of every method under every law, the fits last.
    #[must_use]
    pub fn models(&self) -> &[Model] {
        &self.models
    }

    /// The fits to all records at once; `None` where none was asked for or possible.
    #[doc(hidden)]
    #[must_use]
    pub fn fits(&self) -> Option<&Choice> {
        self.fits.as_ref()
    }

    /// The likeliest fit, with its residuals.
    #[doc(hidden)]
    #[must_use]
    pub fn likeliest_fit(&self) -> Option<&RecordFit> {
        self.fits.as_ref().map(Choice::likeliest)
    }

    /// Cautions.
    #[must_use]
    pub fn cautions(&self) -> &[Caution] {
        &self.cautions
    }

    /// Methods that gave nothing, with their reasons.
    #[must_use]
    pub fn refused(&self) -> &[MethodRefusal] {
        &self.refused
    }

    /// The drag law given beforehand.
    #[must_use]
    pub fn law_given(&self) -> Option<DragLaw> {
        self.law_given
    }
}
