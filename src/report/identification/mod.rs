//! One vehicle identified from its records: every method asked for, the drag law chosen, and what to beware of.

mod estimate;
mod figures;
mod tables;

pub use estimate::{Method, Model};

use super::{Document, Section};
use crate::experiment::{ExperimentError, Log, Record};
use crate::features::{FeatureError, RecordFeatures, RelayLevels};
use crate::identify::fit::{Fit, RecordFit};
use crate::identify::joint::{Delay, Parameter};
use crate::identify::select::likelihood::{Choice, fit_each};
use crate::identify::{DragLaw, IdentifyError, Warning, exact, iso};

/// What to find, and what is known beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Methods to use.
    pub method: Method,
    /// The drag law, if it is known; else every law that a method has.
    pub drag: Option<DragLaw>,
    /// Delay of the whole loop.
    pub delay: Delay,
    /// Relay level in the units wanted, if the log has the command in others.
    pub relay_level: Option<f64>,
    /// Level at which the command switched, in output units, if it is not to be read off the record.
    pub half_width: Option<f64>,
}

/// Why there is no model. [`code`](Self::code) is the name that scripts see.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// The log holds no record.
    #[error("{name}: {source}")]
    Record {
        /// The record.
        name: String,
        /// What is wrong.
        source: ExperimentError,
    },
    /// The record shows no steady self-oscillation.
    #[error("{name}: {source}")]
    Features {
        /// The record.
        name: String,
        /// What is wrong.
        source: FeatureError,
    },
    /// No method gives a model.
    #[error("no model from these records: {0}")]
    Model(#[from] IdentifyError),
}

impl Refusal {
    /// Short name for scripts; it does not change with the wording of the message.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::Record { source, .. } => source.code(),
            Self::Features { source, .. } => source.code(),
            Self::Model(error) => error.code(),
        }
    }
}

/// Something to know before trusting the result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Caution {
    /// Short name for scripts.
    pub code: &'static str,
    /// What it means and what to do.
    pub text: String,
}

/// A record with what it shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Where it comes from.
    pub name: String,
    /// The record with its columns.
    pub log: Log,
    /// Its features; `None` where it shows no steady self-oscillation under a relay.
    pub features: Option<RecordFeatures>,
}

/// One vehicle identified from its records.
#[derive(Clone, Debug, PartialEq)]
pub struct Identification {
    /// The records, in the order given.
    pub sources: Vec<Source>,
    /// What every method found.
    pub models: Vec<Model>,
    /// The fits to all records at once; `None` where none was asked for or possible.
    pub fits: Option<Choice>,
    /// What to beware of.
    pub cautions: Vec<Caution>,
    law_given: Option<DragLaw>,
}

impl Identification {
    /// Identifies one vehicle: by the fit from all records at once, by the other methods from each record. `stage` hears what
    /// comes next.
    ///
    /// # Errors
    /// [`Refusal`] for records that cannot be used; the fit alone takes records without a steady oscillation.
    pub fn of(logs: Vec<(String, Log)>, settings: &Settings, stage: impl Fn(&'static str)) -> Result<Self, Refusal> {
        stage("looking for cycles");
        let mut cautions = Vec::new();
        let mut sources = Vec::with_capacity(logs.len());
        for (name, log) in logs {
            sources.push(source(name, log, settings, &mut cautions)?);
        }
        let mut found = Self { sources, models: Vec::new(), fits: None, cautions, law_given: settings.drag };
        let mut failure = None;
        if settings.method.fits() {
            stage("fitting the drag laws");
            failure = found.fit(settings).err();
        }
        let delay_s = match (settings.delay, &found.fits) {
            (Delay::KnownS(delay_s), _) => Some(delay_s),
            (Delay::Estimated, Some(fits)) => Some(fits.likeliest().estimate(Parameter::DelayS).value),
            (Delay::Estimated, None) => None,
        };
        if let Some(delay_s) = delay_s {
            failure = found.identify_cycles(settings, delay_s).or(failure);
        }
        if found.models.is_empty() {
            let none = IdentifyError::TooFewEquations { equations: 0, parameters: 1 };
            return Err(failure.unwrap_or(none).into());
        }
        if let Some(fits) = &found.fits {
            stage("checking the delay");
            let fit = fits.likeliest();
            let free = match settings.delay {
                Delay::KnownS(_) => {
                    Fit::new(fit.law(), Delay::Estimated).records_from(&records(&found.sources), &[fit]).ok()
                }
                Delay::Estimated => None,
            };
            found.cautions.extend(Warning::of_fit(fit, free.as_ref()).into_iter().map(Caution::from));
        }
        Ok(found)
    }

    /// The likeliest fit.
    #[must_use]
    pub fn fit_chosen(&self) -> Option<&RecordFit> {
        self.fits.as_ref().map(Choice::likeliest)
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

    /// Everything as one file.
    #[must_use]
    pub fn document(&self) -> Document {
        let summary = Section {
            title: "Model".to_owned(),
            paragraphs: vec![self.verdict()],
            tables: self.model_tables().chain((!self.cautions.is_empty()).then(|| self.caution_table())).collect(),
            figures: Vec::new(),
        };
        let records = (0..self.sources.len()).map(|index| self.record_section(index));
        Document {
            title: "Identification from self-oscillations".to_owned(),
            sections: std::iter::once(summary).chain(records).collect(),
        }
    }

    fn record_section(&self, index: usize) -> Section {
        let source = &self.sources[index];
        let mut paragraphs = vec![source.summary()];
        if let Some(fit) = self.fit_chosen() {
            let record = &fit.records()[index];
            paragraphs.push(format!(
                "The model with {} drag leaves residuals of rms {:.3e} and explains {:.1} % of the output's variation; \
                 successive residuals have correlation {:.2}.",
                fit.law().name(),
                record.residual_rms,
                record.fit_percent,
                record.autocorrelation
            ));
        }
        Section {
            title: format!("Record {}", source.name),
            paragraphs,
            tables: source.feature_table().into_iter().chain(source.cycle_table()).collect(),
            figures: source.figures(self.fit_chosen().map(|fit| (fit, &fit.records()[index]))),
        }
    }

    /// Every drag law asked for, fitted to all records.
    fn fit(&mut self, settings: &Settings) -> Result<(), IdentifyError> {
        let laws = settings.drag.map_or(DragLaw::ALL.to_vec(), |law| vec![law]);
        let records = records(&self.sources);
        let results = fit_each(&laws, &records, settings.delay);
        for (law, result) in laws.iter().zip(&results) {
            if let Err(error) = result {
                let text = format!("no fit with {} drag: {error}", law.name());
                self.cautions.push(Caution { code: "fit-failed", text });
            }
        }
        let fits = Choice::of(results, records.iter().map(|record| record.samples()).sum())?;
        self.models.extend(fits.fits().iter().map(Model::of_fit));
        self.fits = Some(fits);
        Ok(())
    }

    /// The methods that work on the features of one record, put before the fits; the last failure.
    fn identify_cycles(&mut self, settings: &Settings, delay_s: f64) -> Option<IdentifyError> {
        let fit = self.fits.as_ref().map(Choice::likeliest);
        let mut models = Vec::new();
        let mut failure = None;
        for (index, source) in self.sources.iter().enumerate() {
            let Some(found) = &source.features else { continue };
            let record = (self.sources.len() > 1).then_some(index);
            let (features, relay) = (&found.features, &found.relay);
            let switch_level = settings.half_width.unwrap_or(features.switch_level.mean);
            let mut results = Vec::new();
            if settings.method.has(Method::Iso) {
                let of_record = iso::Oscillation::of(features, relay.level, delay_s);
                let parameters = iso::Oscillation { switch_level, ..of_record }.identify();
                if let (Ok(parameters), Some(fit)) = (&parameters, fit) {
                    let disagreements = Warning::of_methods(parameters, fit);
                    self.cautions.extend(disagreements.into_iter().map(|warning| source.caution(warning, record)));
                }
                for law in [DragLaw::Linear, DragLaw::Quadratic] {
                    results.push((
                        law,
                        Method::Iso,
                        parameters.map(|p| Model::of_iso(law, &p, relay, delay_s, record)),
                    ));
                }
            }
            if settings.method.has(Method::Exact) {
                let of_record = exact::Cycle::of(features, relay.level, delay_s);
                let cycle = exact::Cycle { switch_level, ..of_record };
                for (law, axis) in
                    [(DragLaw::Linear, cycle.linear_drag()), (DragLaw::Quadratic, cycle.quadratic_drag())]
                {
                    results.push((law, Method::Exact, axis.map(|axis| Model::of_exact(law, &axis, relay, record))));
                }
            }
            results.retain(|(law, ..)| settings.drag.is_none_or(|given| given == *law));
            for (law, method, result) in results {
                match result {
                    Ok(model) => models.push(model),
                    Err(error) => {
                        let (name, law) = (&source.name, law.name());
                        let text = format!("{name}: no model by {} with {law} drag: {error}", method.name());
                        self.cautions.push(Caution { code: "method-failed", text });
                        failure = Some(error);
                    }
                }
            }
        }
        models.append(&mut self.models);
        self.models = models;
        failure
    }
}

impl Source {
    /// With the record's name where there are several.
    fn caution(&self, warning: Warning, record: Option<usize>) -> Caution {
        let text = if record.is_some() { format!("{}: {warning}", self.name) } else { warning.to_string() };
        Caution { code: warning.code(), text }
    }
}

impl From<Warning> for Caution {
    fn from(warning: Warning) -> Self {
        Self { code: warning.code(), text: warning.to_string() }
    }
}

fn records(sources: &[Source]) -> Vec<&Record> {
    sources.iter().map(|source| &source.log.record).collect()
}

/// The record in the units wanted, with its features.
fn source(name: String, mut log: Log, settings: &Settings, cautions: &mut Vec<Caution>) -> Result<Source, Refusal> {
    let refused = |source| Refusal::Features { name: name.clone(), source };
    if let Some(level) = settings.relay_level {
        let scale = level / RelayLevels::of(&log.record).map_err(refused)?.level;
        let input = log.record.input().iter().map(|command| command * scale).collect();
        log.record = Record::new(log.record.time_s().to_vec(), log.record.output().to_vec(), input)
            .map_err(|source| Refusal::Record { name: name.clone(), source })?;
    }
    let features = match (RecordFeatures::of(&log.record), settings.method) {
        (Ok(features), _) => {
            cautions.extend(Warning::of_features(&features.features).into_iter().map(Caution::from));
            Some(features)
        }
        (Err(error @ FeatureError::ConstantInput { .. }), _) => return Err(refused(error)),
        // The fit needs neither a relay nor a steady oscillation; that the other methods do is worth a word.
        (Err(error), Method::Fit) | (Err(error @ FeatureError::NotARelay { .. }), Method::All) => {
            cautions.push(Caution { code: error.code(), text: format!("{name}: {error}") });
            None
        }
        (Err(error), _) => return Err(refused(error)),
    };
    Ok(Source { name, log, features })
}
