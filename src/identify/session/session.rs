//! From logs to an identification.

use std::io::Read;
use std::path::Path;

use super::identification::{Identification, Source};
use super::methods::Findings;
use super::refusal::Refusal;
use super::settings::{Method, Settings, SettingsError};
use super::stage::Stage;
use crate::experiment::{Columns, Log, Record};
use crate::features::{FeatureError, NotAnExperiment, RecordFeatures, RelayLevels};
use crate::files::Input;
use crate::identify::answer::{Delay, Warning};
use crate::identify::bounded::certificate::ReadAs;
use crate::numeric::{Limit, domain};

/// A vehicle to be identified: settings, and its records, which are fitted jointly.
///
/// ```
/// # let folder = std::env::temp_dir().join(format!("selfosc-session-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder)?;
/// # let path = folder.join("log.csv");
/// # use selfosc::{experiment::SimulatedExperiment, nonlinearity::RelayHysteresis, plant::DragAxis};
/// # let axis = DragAxis::quadratic(1.0, 0.5)?;
/// # let simulated = SimulatedExperiment::new(axis, RelayHysteresis::new(1.0, 0.3, 0.0)?, 10.0)?.held().run(60.0)?;
/// # let samples = simulated.time_s().iter().zip(simulated.output()).zip(simulated.input());
/// # let lines: String = samples.map(|((time, output), input)| format!("{time},{output},{input}\n")).collect();
/// # std::fs::write(&path, format!("time_s,output,input\n{lines}"))?;
/// let found = selfosc::identify::Session::default().log(&path)?.identify()?;
/// let answer = found.reported().ok_or("no fit")?;
/// println!("inertia {:.4}, trust: {}", answer.alpha.value, answer.trust.name());
/// # assert!((answer.alpha.value - 1.0).abs() < 0.01);
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Several logs, samples in memory and any reader go into the same session; parameters are common, the disturbance is each
/// record's own:
///
/// ```no_run
/// use selfosc::identify::{Delay, Method, Session, Settings};
/// # let (time_s, output, input, upload) = (vec![], vec![], vec![], std::io::empty());
/// let settings = Settings { method: Method::Fit, delay: Delay::KnownS(0.1), ..Settings::default() };
/// let session = Session::new(settings)
///     .log("weak.csv")?
///     .log("strong.csv")?
///     .reader("upload", upload)?
///     .samples("memory", time_s, output, input)?;
/// let found = session.identify_with(|stage| eprintln!("{stage}"))?;
/// let json = serde_json::to_string(&found.conclusion())?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Session {
    settings: Settings,
    columns: Columns,
    logs: Vec<(String, Log)>,
    validation: Vec<(String, Log)>,
}

impl Session {
    /// Without records.
    #[must_use]
    pub fn new(settings: Settings) -> Self {
        Self { settings, ..Self::default() }
    }

    /// Which columns to read from the logs that follow, and how.
    #[must_use]
    pub fn with_columns(self, columns: Columns) -> Self {
        Self { columns, ..self }
    }

    /// Adds the log in a file.
    ///
    /// # Errors
    /// [`Refusal::File`] where it cannot be read, [`Refusal::Record`] where it holds no record.
    pub fn log(self, path: impl AsRef<Path>) -> Result<Self, Refusal> {
        let input = Input::open(path.as_ref(), Columns::LONGEST)?;
        self.reader(input.name(), input.bytes())
    }

    /// Adds the log in a file to those that are predicted and take no part in the estimate.
    ///
    /// # Errors
    /// As [`log`](Self::log).
    pub fn validation(self, path: impl AsRef<Path>) -> Result<Self, Refusal> {
        let input = Input::open(path.as_ref(), Columns::LONGEST)?;
        self.validation_reader(input.name(), input.bytes())
    }

    /// Adds the log that a reader gives to those that are predicted and take no part in the estimate.
    ///
    /// # Errors
    /// As [`reader`](Self::reader).
    pub fn validation_reader(mut self, name: impl Into<String>, source: impl Read) -> Result<Self, Refusal> {
        let logs = self.logs.len();
        self = self.reader(name, source)?;
        self.validation.extend(self.logs.drain(logs..));
        Ok(self)
    }

    /// Adds the log that a reader gives, under a name for messages.
    ///
    /// # Errors
    /// [`Refusal::Record`] where it cannot be read or holds no record.
    pub fn reader(self, name: impl Into<String>, source: impl Read) -> Result<Self, Refusal> {
        let name = name.into();
        match self.columns.read(source) {
            Ok(log) => Ok(self.record(name, log)),
            Err(source) => Err(Refusal::Record { name, source }),
        }
    }

    /// Adds samples: times in s, outputs (angles in rad), and the command logged with each, under a name for messages.
    ///
    /// # Errors
    /// [`Refusal::Record`] where they make no record.
    pub fn samples(
        self,
        name: impl Into<String>,
        time_s: Vec<f64>,
        output: Vec<f64>,
        input: Vec<f64>,
    ) -> Result<Self, Refusal> {
        let name = name.into();
        match Record::new(time_s, output, input) {
            Ok(record) => Ok(self.record(name, record)),
            Err(source) => Err(Refusal::Record { name, source }),
        }
    }

    /// Adds a record or a log that is there already, under a name for messages.
    #[must_use]
    pub fn record(mut self, name: impl Into<String>, record: impl Into<Log>) -> Self {
        self.logs.push((name.into(), record.into()));
        self
    }

    /// The records as the methods see them: angles in radians, the command in the units wanted.
    ///
    /// # Errors
    /// [`Refusal`] for a record of which no relay level can be read where one is wanted.
    pub fn records(self) -> Result<Vec<Record>, Refusal> {
        let logs = self.logs.into_iter();
        logs.map(|(name, log)| Ok(in_units(&name, log, &self.settings)?.record)).collect()
    }

    /// Identifies the vehicle: by the fit from all records at once, by the other methods from each record.
    ///
    /// # Errors
    /// [`Refusal`] for settings and records that cannot be used; the fit alone takes records without a steady oscillation.
    pub fn identify(self) -> Result<Identification, Refusal> {
        self.identify_with(|_| {})
    }

    /// As [`identify`](Self::identify); `progress` is called before each stage.
    ///
    /// # Errors
    /// As [`identify`](Self::identify).
    pub fn identify_with(self, progress: impl Fn(Stage)) -> Result<Identification, Refusal> {
        self.settings.check()?;
        if let Delay::KnownS(delay_s) = self.settings.delay {
            let shortest_s = self.logs.iter().map(|(_, log)| log.record.duration_s()).fold(f64::MAX, f64::min);
            let limit = Limit::AtMost(domain::three_digits(shortest_s, f64::floor));
            let remedy = "the record is no longer: give it in s, or leave it out to have it estimated";
            domain::require("delay", delay_s, "s", limit, remedy).map_err(SettingsError::from)?;
        }
        progress(Stage::Cycles);
        let mut cautions = Vec::new();
        let mut sources = Vec::with_capacity(self.logs.len());
        let mut failures = Vec::new();
        let mut validation = Vec::with_capacity(self.validation.len());
        for (name, log) in self.validation {
            let log = in_units(&name, log, &self.settings)?;
            validation.push((name, log));
        }
        let several = self.logs.len() > 1;
        for (index, (name, log)) in self.logs.into_iter().enumerate() {
            let (source, failure) = source(name, log, &self.settings)?;
            let warnings = source.features.as_ref().map(Warning::of_features).unwrap_or_default();
            cautions.extend(warnings.into_iter().map(|warning| source.caution(warning, several)));
            cautions.extend(source.same_as_one_of(&sources));
            sources.push(source);
            failures.extend(failure.map(|error| (index, error)));
        }
        let read_as = ReadAs { columns: self.columns, relay_level: self.settings.relay_level };
        let found = Findings::new(&self.settings, sources, cautions).by_all_methods(&failures, validation, progress)?;
        Ok(found.read_as(&read_as))
    }
}

/// The log with its command in the units wanted.
fn in_units(name: &str, mut log: Log, settings: &Settings) -> Result<Log, Refusal> {
    if let Some(level) = settings.relay_level {
        let found =
            RelayLevels::of(&log.record).map_err(|source| Refusal::Features { name: name.to_owned(), source })?;
        let input = log.record.input().iter().map(|command| command * level / found.level).collect();
        log.record = Record::new(log.record.time_s().to_vec(), log.record.output().to_vec(), input)
            .map_err(|source| Refusal::Record { name: name.to_owned(), source })?;
    }
    Ok(log)
}

/// The record in the units wanted, with its features or why it has none.
fn source(name: String, log: Log, settings: &Settings) -> Result<(Source, Option<FeatureError>), Refusal> {
    let log = in_units(&name, log, settings)?;
    let features = RecordFeatures::of(&log.record);
    if let Err(source @ FeatureError::ConstantInput { .. }) = features {
        return Err(Refusal::Features { name, source });
    }
    if settings.method != Method::Bounded
        && !settings.any_input
        && let Some(source) = NotAnExperiment::find(&log.record)
    {
        return Err(Refusal::NoExperiment { name, source });
    }
    match features {
        Ok(features) => Ok((Source { name, log, features: Some(features) }, None)),
        Err(error) => Ok((Source { name, log, features: None }, Some(error))),
    }
}
