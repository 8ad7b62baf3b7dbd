//! Every method asked for, tried on the same records.

use super::identification::{Caution, Identification, Source};
use super::model::Model;
use super::session::Stage;
use super::settings::{Method, Settings};
use crate::experiment::Record;
use crate::features::RecordFeatures;
use crate::identify::fit::Fit;
use crate::identify::joint::{Delay, Parameter};
use crate::identify::select::likelihood::{Choice, fit_each};
use crate::identify::{DragLaw, IdentifyError, Warning, exact, iso};

/// What has been found so far.
pub(super) struct Found<'a> {
    settings: &'a Settings,
    sources: Vec<Source>,
    models: Vec<Model>,
    fits: Option<Choice>,
    cautions: Vec<Caution>,
}

/// What one method gave under one law.
type Attempt = (Method, DragLaw, Result<Model, IdentifyError>);

impl<'a> Found<'a> {
    pub(super) fn new(settings: &'a Settings, sources: Vec<Source>, cautions: Vec<Caution>) -> Self {
        Self { settings, sources, models: Vec::new(), fits: None, cautions }
    }

    pub(super) fn by_all_methods(mut self, progress: impl Fn(Stage)) -> Result<Identification, IdentifyError> {
        let mut failure = None;
        if self.settings.method.includes(Method::Fit) {
            progress(Stage::Fit);
            failure = self.fit().err();
        }
        let delay_s = match (self.settings.delay, &self.fits) {
            (Delay::KnownS(delay_s), _) => Some(delay_s),
            (Delay::Estimated, Some(fits)) => Some(fits.likeliest().estimate(Parameter::DelayS).value),
            (Delay::Estimated, None) => None,
        };
        if let Some(delay_s) = delay_s {
            failure = self.identify_cycles(delay_s).or(failure);
        }
        if self.models.is_empty() {
            let none = IdentifyError::TooFewEquations { equations: 0, parameters: 1 };
            return Err(failure.unwrap_or(none));
        }
        if self.fits.is_some() {
            progress(Stage::Delay);
            self.check_fit();
        }
        let Self { settings, sources, models, fits, cautions } = self;
        Ok(Identification { sources, models, fits, cautions, law_given: settings.drag })
    }

    /// Every drag law asked for, fitted to all records.
    fn fit(&mut self) -> Result<(), IdentifyError> {
        let laws = self.settings.drag.map_or(DragLaw::ALL.to_vec(), |law| vec![law]);
        let records = self.records();
        let samples = records.iter().map(|record| record.samples()).sum();
        let results = fit_each(&laws, &records, self.settings.delay);
        for (law, result) in laws.iter().zip(&results) {
            if let Err(error) = result {
                let text = format!("no fit with {} drag: {error}", law.name());
                self.cautions.push(Caution { code: "fit-failed".into(), text });
            }
        }
        let fits = Choice::of(results, samples)?;
        self.models.extend(fits.fits().iter().map(Model::of_fit));
        self.fits = Some(fits);
        Ok(())
    }

    /// Warnings of the likeliest fit, beside the same fit with a free delay where one was given.
    fn check_fit(&mut self) {
        let Some(fit) = self.fits.as_ref().map(Choice::likeliest) else { return };
        let free = match self.settings.delay {
            Delay::KnownS(_) => Fit::new(fit.law(), Delay::Estimated).records_from(&self.records(), &[fit]).ok(),
            Delay::Estimated => None,
        };
        let warnings = Warning::of_fit(fit, free.as_ref());
        self.cautions.extend(warnings.into_iter().map(Caution::from));
    }

    /// The methods that work on the features of one record, put before the fits; the last failure.
    fn identify_cycles(&mut self, delay_s: f64) -> Option<IdentifyError> {
        let several = self.sources.len() > 1;
        let (mut models, mut cautions, mut failure) = (Vec::new(), Vec::new(), None);
        for (index, source) in self.sources.iter().enumerate() {
            let Some(features) = &source.features else { continue };
            let record = several.then_some(index);
            let (attempts, warnings) = self.attempts(features, delay_s, record);
            cautions.extend(warnings.into_iter().map(|warning| source.caution(warning, record)));
            for (method, law, result) in attempts {
                match result {
                    Ok(model) => models.push(model),
                    Err(error) => {
                        let (name, method, law) = (&source.name, method.name(), law.name());
                        let text = format!("{name}: no model by {method} with {law} drag: {error}");
                        cautions.push(Caution { code: "method-failed".into(), text });
                        failure = Some(error);
                    }
                }
            }
        }
        self.cautions.extend(cautions);
        models.append(&mut self.models);
        self.models = models;
        failure
    }

    /// The methods for mean cycles on one record, and where they disagree with the fit.
    fn attempts(&self, found: &RecordFeatures, delay_s: f64, record: Option<usize>) -> (Vec<Attempt>, Vec<Warning>) {
        let (features, relay) = (&found.features, &found.relay);
        let switch_level = self.settings.half_width.unwrap_or(features.switch_level.mean);
        let (mut attempts, mut warnings) = (Vec::new(), Vec::new());
        if self.settings.method.includes(Method::Iso) {
            let of_record = iso::Oscillation::of(features, relay.level, delay_s);
            let parameters = iso::Oscillation { switch_level, ..of_record }.identify();
            if let (Ok(parameters), Some(fits)) = (&parameters, &self.fits) {
                warnings = Warning::of_methods(parameters, fits.likeliest());
            }
            for law in [DragLaw::Linear, DragLaw::Quadratic] {
                let model = parameters.map(|found| Model::of_iso(law, &found, relay, delay_s, record));
                attempts.push((Method::Iso, law, model));
            }
        }
        if self.settings.method.includes(Method::Exact) {
            let of_record = exact::MeanCycle::of(features, relay.level, delay_s);
            let cycle = exact::MeanCycle { switch_level, ..of_record };
            for (law, axis) in [(DragLaw::Linear, cycle.linear_drag()), (DragLaw::Quadratic, cycle.quadratic_drag())] {
                attempts.push((Method::Exact, law, axis.map(|axis| Model::of_exact(law, &axis, relay, record))));
            }
        }
        attempts.retain(|(_, law, _)| self.settings.drag.is_none_or(|given| given == *law));
        (attempts, warnings)
    }

    fn records(&self) -> Vec<&Record> {
        self.sources.iter().map(|source| &source.log.record).collect()
    }
}
