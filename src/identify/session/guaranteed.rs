//! Guaranteed bounds within the workflow: asked for by name, under the drag law and the delay of the settings.

use core::num::NonZeroUsize;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::settings::Settings;
use crate::experiment::Record;
use crate::identify::answer::{Delay, DragLaw, IdentifyError};
use crate::identify::bounded::certificate::{Certificate, ReadAs, Unproved};
use crate::identify::bounded::{
    BoundedModel, Bounds, Consistency, Contradicting, DelayBound, Outlier, ParameterValues, Quantity, QuantityRange,
    enclose, enclose_with_certificate,
};

/// Bounds with the model that they are of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Guaranteed {
    /// What was assumed.
    pub model: BoundedModel,
    /// Its bounds from the records.
    pub bounds: Bounds,
    /// The proof, or why there is none; `None` where it was not asked for.
    #[serde(skip)]
    certificate: Option<Result<Certificate, Unproved>>,
}

impl Guaranteed {
    /// The text of the proof, which `selfosc verify --check` reads, or why none was found; `None` where
    /// [`Settings::certificate`] did not ask for it.
    #[must_use]
    pub fn certificate(&self) -> Option<Result<&dyn core::fmt::Display, &dyn core::error::Error>> {
        let found = self.certificate.as_ref()?.as_ref();
        Some(found.map(|proof| proof as _).map_err(|unproved| unproved as _))
    }

    /// Adds to the proof how its logs were read.
    pub(super) fn read_as(self, read_as: &ReadAs) -> Self {
        let proof = self.certificate.map(|proof| proof.map(|proof| proof.read_as(read_as.clone())));
        Self { certificate: proof, ..self }
    }

    /// Under the drag law given, or else under mixed drag, which has the other laws as its ends.
    pub(super) fn of(records: &[&Record], settings: &Settings) -> Result<Self, IdentifyError> {
        let delay = match settings.delay {
            Delay::KnownS(delay_s) => DelayBound::KnownS(delay_s),
            Delay::Estimated => DelayBound::Unknown,
        };
        let law = settings.drag.unwrap_or(DragLaw::Mixed);
        let usual = BoundedModel::new(law, delay);
        let model = BoundedModel {
            quantum: settings.quantum,
            error: settings.error,
            jitter_s: settings.jitter_s,
            outliers: settings.outliers,
            stiffness: settings.stiffness,
            lag: settings.lag,
            cubic: settings.cubic,
            either_sign: settings.either_sign,
            budget: settings.budget.map_or(usual.budget, NonZeroUsize::get),
            ..usual
        };
        let (bounds, certificate) = if settings.certificate {
            let (bounds, certificate) = enclose_with_certificate(records, &model)?;
            (bounds, Some(certificate))
        } else {
            (enclose(records, &model)?, None)
        };
        Ok(Self { model, bounds, certificate })
    }
}

/// Guaranteed bounds in the document: a pair of numbers is the least and the largest value that the readings allow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BoundedConclusion {
    /// `consistent`, `refuted` or `undecided`.
    pub verdict: Consistency,
    /// The drag law assumed.
    pub drag: DragLaw,
    /// The search box: no claim is made outside it.
    pub search_box: BTreeMap<String, [f64; 2]>,
    /// Inertia; this and the following fields are null where the model lacks them or is refuted.
    pub alpha: Option<[f64; 2]>,
    /// Linear drag.
    pub beta: Option<[f64; 2]>,
    /// Quadratic drag.
    pub beta_quadratic: Option<[f64; 2]>,
    /// Constant force of the only record; null for several.
    pub delta: Option<[f64; 2]>,
    /// Constant force during each record.
    pub deltas: Vec<[f64; 2]>,
    /// Cubic drag; this and the next two where the model was given them.
    pub beta_cubic: Option<[f64; 2]>,
    /// Restoring force over the coordinate.
    pub stiffness: Option<[f64; 2]>,
    /// Time constant of the force, in s.
    pub lag_s: Option<[f64; 2]>,
    /// Delay, in s.
    pub delay_s: Option<[f64; 2]>,
    /// A parameter vector that satisfies every reading; null if none was found.
    pub witness: Option<BTreeMap<String, f64>>,
    /// Largest error of a reading that was granted, of all records.
    pub error: f64,
    /// This error times the first does not make the model consistent if it is above one; times the second it does. The second is null
    /// where no parameter came near.
    pub error_factor: (f64, Option<f64>),
    /// Readings that contradict each other; empty unless refuted.
    pub contradicting: Vec<Contradicting>,
    /// Readings that may be in error by any amount: number allowed.
    pub outliers_allowed: usize,
    /// Of these, the readings that no parameter sought satisfies.
    pub outliers: Vec<Outlier>,
}

fn named(quantity: Quantity, several: bool) -> String {
    match quantity.record().filter(|_| several) {
        Some(record) => format!("{quantity}[{record}]"),
        None => quantity.to_string(),
    }
}

impl From<&Guaranteed> for BoundedConclusion {
    fn from(found: &Guaranteed) -> Self {
        let bounds = &found.bounds;
        let several = bounds.error.len() > 1;
        let deltas: Vec<[f64; 2]> =
            (0..bounds.error.len()).filter_map(|record| bounds.of(Quantity::Delta(record))).collect();
        let range = |range: &QuantityRange| (named(range.quantity, several), [range.low, range.high]);
        let point = |witness: &ParameterValues| {
            witness.values.iter().map(|(quantity, value)| (named(*quantity, several), *value)).collect()
        };
        Self {
            verdict: bounds.verdict,
            drag: found.model.law,
            search_box: bounds.search_box.iter().map(range).collect(),
            alpha: bounds.of(Quantity::Alpha),
            beta: bounds.of(Quantity::Beta),
            beta_quadratic: bounds.of(Quantity::BetaQuadratic),
            delta: if let [only] = deltas[..] { Some(only) } else { None },
            deltas,
            beta_cubic: bounds.of(Quantity::BetaCubic),
            stiffness: bounds.of(Quantity::Stiffness),
            lag_s: bounds.of(Quantity::LagS),
            delay_s: bounds.of(Quantity::DelayS),
            witness: bounds.witness.as_ref().map(point),
            error: bounds.error.iter().fold(0.0, |largest, error| error.max(largest)),
            error_factor: (bounds.error_factor[0], Some(bounds.error_factor[1]).filter(|most| *most < f64::MAX)),
            contradicting: bounds.contradicting.clone(),
            outliers_allowed: found.model.outliers,
            outliers: bounds.outliers.clone(),
        }
    }
}
