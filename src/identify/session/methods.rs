//! Every method asked for, on the same records. A method that refuses gives its reason.

use core::cmp::Ordering;

use super::guaranteed::Guaranteed;
use super::identification::{Caution, Identification, MethodRefusal, Source, Validation};
use super::model::Model;
use super::refusal::Refusal;
use super::settings::{Method, Settings};
use super::stage::Stage;
use crate::experiment::{Log, Record};
use crate::features::{FeatureError, NotAnExperiment, RecordFeatures};
use crate::identify::answer::{AxisParameter, Delay, DragLaw, IdentifyError, MotionScale, Reason, Reported, Warning};
use crate::identify::fit::prediction_error::{Estimator, Prediction, Several};
use crate::identify::fit::select::likelihood::{Choice, fit_each};
use crate::identify::fit::shooting::RecordFit;
use crate::identify::signal::{Clock, Signal, SwitchingInstant};
use crate::identify::{exact, iso};

/// The results so far.
pub(super) struct Findings<'a> {
    settings: &'a Settings,
    sources: Vec<Source>,
    reported: Option<Reported>,
    left_out: Vec<Option<Prediction>>,
    bounded: Option<Guaranteed>,
    models: Vec<Model>,
    fits: Option<Choice>,
    cautions: Vec<Caution>,
    refused: Vec<MethodRefusal>,
    /// The reason where nothing is found: that of the last method.
    failure: Refusal,
}

/// The model of a method under a law, or the refusal.
type Attempt = (Method, DragLaw, Result<Model, IdentifyError>);

impl<'a> Findings<'a> {
    pub(super) fn new(settings: &'a Settings, sources: Vec<Source>, cautions: Vec<Caution>) -> Self {
        let failure = IdentifyError::TooFewEquations { equations: 0, parameters: 1 }.into();
        let (models, refused) = (Vec::new(), Vec::new());
        let left_out = vec![None; sources.len()];
        Self {
            settings,
            sources,
            reported: None,
            bounded: None,
            left_out,
            models,
            fits: None,
            cautions,
            refused,
            failure,
        }
    }

    /// Records without features, with the reason from `failures`.
    pub(super) fn by_all_methods(
        mut self,
        failures: &[(usize, FeatureError)],
        validation: Vec<(String, Log)>,
        progress: impl Fn(Stage),
    ) -> Result<Identification, Refusal> {
        if self.settings.method == Method::Bounded {
            progress(Stage::Bounds);
            self.enclose();
        } else {
            self.estimate(failures, progress)?;
        }
        if self.models.is_empty() && self.reported.is_none() && self.bounded.is_none() {
            return Err(self.failure);
        }
        let Self { settings, sources, reported, bounded, left_out, models, fits, cautions, refused, .. } = self;
        let validated = validation.into_iter().map(|(file, log)| {
            let prediction = reported.as_ref().and_then(|reported| reported.predict(&log.record));
            Validation { file, prediction }
        });
        let validation: Vec<Validation> = validated.collect();
        let explained = validation.iter().map(|one| one.prediction.map(|prediction| prediction.explained()));
        // The least: `None`, where a motion diverges, is less than any number.
        let worst = explained.min_by(|a, b| a.partial_cmp(b).unwrap_or(Ordering::Less));
        let reason = worst.and_then(Reason::does_not_predict);
        let reported = reported.map(|reported| reason.into_iter().fold(reported, Reported::with_reason));
        let law_given = settings.drag;
        Ok(Identification {
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
        })
    }

    /// The guaranteed bounds.
    fn enclose(&mut self) {
        match Guaranteed::of(&self.records(), self.settings) {
            Ok(found) => self.bounded = Some(found),
            Err(error) => self.refuse(Method::Bounded.name(), None, error),
        }
    }

    /// By the methods that estimate.
    fn estimate(&mut self, failures: &[(usize, FeatureError)], progress: impl Fn(Stage)) -> Result<(), Refusal> {
        let by_samples = self.settings.method.includes(Method::Fit);
        // The methods for mean cycles need a delay from somewhere.
        let reporting = by_samples || self.settings.delay == Delay::Estimated;
        let stages = [by_samples.then_some(Stage::Fit), reporting.then_some(Stage::Terms)];
        stages.into_iter().flatten().for_each(progress);
        let laws = self.settings.drag.map_or(DragLaw::ALL.to_vec(), |law| vec![law]);
        let records = self.records();
        // In parallel: either alone has idle cores towards its end.
        let (fits, answer) = rayon::join(
            || by_samples.then(|| fit_each(&laws, &records, self.settings.delay)),
            || reporting.then(|| self.estimator().records(&records)),
        );
        if let Some(fits) = fits {
            self.fit(&laws, fits);
        }
        if let Some(answer) = answer {
            self.report(answer)?;
        }
        for (index, error) in failures {
            self.refuse_cycles(*index, error);
        }
        match self.delay_s() {
            Some(delay_s) => self.identify_cycles(delay_s),
            None => self.refuse_all_cycles(),
        }
        if !by_samples {
            self.reported = None;
            self.left_out.fill(None);
        }
        Ok(())
    }

    fn estimator(&self) -> Estimator {
        let estimator = Estimator::new(self.settings.delay);
        self.settings.drag.map_or(estimator, |law| estimator.with_law(law))
    }

    /// The answer to use: terms found, models averaged. No method makes sense of a command of the opposite sign.
    fn report(&mut self, answer: Result<Several, IdentifyError>) -> Result<(), Refusal> {
        match answer {
            Ok(several) => {
                let headings = self.sources.iter().any(|source| source.log.is_heading());
                let assumed = if headings { self.settings.assume } else { self.settings.assume.without_heading() };
                let scales: Vec<MotionScale> = self.records().into_iter().map(motion_scale).collect();
                let reported = several.reported.with_budget(&assumed, &scales);
                let missing = self.records().into_iter().find_map(NotAnExperiment::find).map(Reason::NoExperiment);
                self.reported = Some(missing.into_iter().fold(reported, Reported::with_reason));
                self.left_out = several.left_out;
                let several = self.sources.len() > 1;
                self.cautions.extend(self.sources.iter().filter_map(|source| {
                    let (searched, samples) = (Estimator::SEARCHED, source.log.record.samples());
                    let warning = Warning::SearchedInPart { searched, samples };
                    (samples > searched).then(|| source.caution(warning, several))
                }));
            }
            Err(error @ IdentifyError::CommandSign) => return Err(error.into()),
            Err(error) => self.refuse("prediction-error", None, error),
        }
        Ok(())
    }

    /// Every drag law asked for, fitted to all records.
    fn fit(&mut self, laws: &[DragLaw], results: Vec<Result<RecordFit, IdentifyError>>) {
        for (law, result) in laws.iter().zip(&results) {
            if let Err(error) = result {
                self.refuse(Method::Fit.name(), Some((None, *law)), *error);
            }
        }
        let samples = self.sources.iter().map(|source| source.log.record.samples()).sum();
        if let Ok(fits) = Choice::of(results, samples) {
            self.models.extend(fits.fits().iter().map(Model::of_fit));
            self.fits = Some(fits);
        }
    }

    /// The loop's delay for methods without a lag: the given delay, or the estimated delay plus all lags.
    fn delay_s(&self) -> Option<f64> {
        match (self.settings.delay, &self.reported, &self.fits) {
            (Delay::KnownS(delay_s), ..) => Some(delay_s),
            (Delay::Estimated, Some(reported), _) => Some(reported.mean_delay_s()),
            (Delay::Estimated, None, Some(fits)) => Some(fits.likeliest().estimate(AxisParameter::DelayS).value),
            (Delay::Estimated, None, None) => None,
        }
    }

    fn refuse(&mut self, method: &'static str, of: Option<(Option<usize>, DragLaw)>, error: IdentifyError) {
        let several = self.sources.len() > 1;
        let place = of.map_or_else(String::new, |(record, law)| match record.filter(|_| several) {
            Some(index) => format!("{}, {} drag: ", self.sources[index].name, law.name()),
            None => format!("{} drag: ", law.name()),
        });
        let text = format!("{place}{error}");
        self.refused.push(MethodRefusal { method: method.into(), code: error.code().into(), text });
        self.failure = error.into();
    }

    fn cycle_methods(&self) -> impl Iterator<Item = Method> + use<> {
        let asked = self.settings.method;
        [Method::Iso, Method::Exact].into_iter().filter(move |method| asked.includes(*method))
    }

    /// The methods for mean cycles have none of this record.
    fn refuse_cycles(&mut self, index: usize, error: &FeatureError) {
        let name = self.sources[index].name.clone();
        for method in self.cycle_methods() {
            let (code, text) = (error.code().into(), format!("{name}: {error}"));
            self.refused.push(MethodRefusal { method: method.name().into(), code, text });
            self.failure = Refusal::Features { name: name.clone(), source: *error };
        }
    }

    /// They have no delay either.
    fn refuse_all_cycles(&mut self) {
        for method in self.cycle_methods() {
            let text = "the delay could not be estimated; give it".to_owned();
            self.refused.push(MethodRefusal { method: method.name().into(), code: "delay-unknown".into(), text });
        }
    }

    /// The methods that work on the features of a record, put before the fits.
    fn identify_cycles(&mut self, delay_s: f64) {
        let several = self.sources.len() > 1;
        let mut models = Vec::new();
        for index in 0..self.sources.len() {
            let source = &self.sources[index];
            let Some(features) = &source.features else { continue };
            let record = several.then_some(index);
            let (attempts, warnings) = self.attempts(features, delay_s, record);
            let cautions: Vec<Caution> = warnings.into_iter().map(|warning| source.caution(warning, several)).collect();
            self.cautions.extend(cautions);
            for (method, law, result) in attempts {
                match result {
                    Ok(model) => models.push(model),
                    Err(error) => self.refuse(method.name(), Some((Some(index), law)), error),
                }
            }
        }
        models.append(&mut self.models);
        self.models = models;
    }

    /// The methods for mean cycles on a record, and where they disagree with the answer.
    fn attempts(&self, found: &RecordFeatures, delay_s: f64, record: Option<usize>) -> (Vec<Attempt>, Vec<Warning>) {
        let (features, relay) = (&found.features, &found.relay);
        let delay_s = delay_s + 0.5 * found.ramp_s;
        let switch_level = self.settings.half_width.unwrap_or(features.switch_level.mean);
        let (mut attempts, mut warnings) = (Vec::new(), Vec::new());
        if self.settings.method.includes(Method::Iso) {
            let of_record = iso::Oscillation::of(features, relay.level, delay_s);
            let parameters = iso::Oscillation { switch_level, ..of_record }.identify();
            let reported = self.reported.as_ref().and_then(|reported| reported.at_level(relay.level));
            if let (Ok(parameters), Some(reported)) = (&parameters, &reported) {
                warnings = disagreements(parameters, reported);
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

/// The record's own units of force, speed and time.
fn motion_scale(record: &Record) -> MotionScale {
    let Signal { range, fastest, half_period_s, .. } = Signal::new(record, Clock::Stamps, SwitchingInstant::AtSamples);
    MotionScale { level: 0.5 * range, speed: fastest, half_period_s }
}

/// Difference between the methods that is the sinusoid's own error.
const METHOD_ERROR: f64 = 0.1;
/// Standard deviations that count as a difference.
const SIGNIFICANT: f64 = 3.0;

/// Where the paper's method and the answer disagree.
fn disagreements(iso: &iso::Parameters<f64>, reported: &Reported) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let drag = match (reported.drag.has_linear(), reported.drag.has_quadratic()) {
        (true, false) => Some((AxisParameter::LinearDrag, iso.beta, reported.beta)),
        (false, true) => Some((AxisParameter::QuadraticDrag, iso.beta_quadratic, reported.beta_quadratic)),
        _ => None,
    };
    for (parameter, value, estimate) in
        [Some((AxisParameter::Alpha, iso.alpha, reported.alpha)), drag].into_iter().flatten()
    {
        let std = estimate.spread.map_or(0.0, |spread| spread.std);
        if (value - estimate.value).abs() > (SIGNIFICANT * std).max(METHOD_ERROR * estimate.value.abs()) {
            warnings.push(Warning::MethodsDisagree { parameter, ratio: value / estimate.value });
        }
    }
    warnings
}
