//! Why there is no conclusion.

use super::settings::SettingsError;
use crate::experiment::ExperimentError;
use crate::features::{FeatureError, NotAnExperiment};
use crate::files::FileError;
use crate::identify::answer::IdentifyError;

/// Why there is no model. [`code`](Self::code) is the name that scripts see.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// The settings contradict each other.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
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
    /// The record is of another manoeuvre than a relay experiment.
    #[error("{name} is no relay experiment: {source}, or take the record as it is (--any-input)")]
    NoExperiment {
        /// The record.
        name: String,
        /// What is missing.
        source: NotAnExperiment,
    },
    /// No method gives a model.
    #[error("no model from these records: {0}")]
    Model(#[from] IdentifyError),
}

crate::numeric::codes! { pub Refusal {
    Settings.0, File.0, Record.source, Features.source, NoExperiment => "no-experiment", Model.0,
} }

impl Refusal {
    /// Whether the question was wrong rather than the answer no: settings that contradict each other, or a source that could
    /// not be read to its end.
    #[must_use]
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Settings(_) | Self::File(_) => true,
            Self::Record { source, .. } => source.is_unreadable(),
            Self::Features { .. } | Self::NoExperiment { .. } | Self::Model(_) => false,
        }
    }
}
