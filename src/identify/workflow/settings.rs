//! What to find, and what is known beforehand.

use serde::{Deserialize, Serialize};

use crate::identify::DragLaw;
use crate::identify::joint::Delay;

/// Ways from records to parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The paper's: the first harmonic of the mean cycle.
    Iso,
    /// The exact limit cycle with the mean cycle's features.
    Exact,
    /// Maximum likelihood on every sample, with intervals.
    Fit,
    /// All of them.
    #[default]
    All,
}

impl Method {
    /// Name on the command line and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Iso => "iso",
            Self::Exact => "exact",
            Self::Fit => "fit",
            Self::All => "all",
        }
    }

    /// Whether `one` is asked for.
    #[must_use]
    pub fn includes(self, one: Self) -> bool {
        self == one || self == Self::All
    }
}

/// What to find, and what is known beforehand. The default is that of the command: every method, every drag law, no delay.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Methods to use.
    pub method: Method,
    /// The drag law, if it is known; else every law that a method has.
    pub drag: Option<DragLaw>,
    /// Delay of the whole loop.
    pub delay: Delay,
    /// Relay level in the units wanted, above 0, if the log has the command in others.
    pub relay_level: Option<f64>,
    /// Level at which the command switched, in output units, above 0, if it is not to be read off the record.
    pub half_width: Option<f64>,
}

/// Settings that contradict each other or are no numbers of the right kind.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingsError {
    /// Mixed drag without the fit.
    #[error("only the fit knows mixed drag; use the method fit, or another drag law")]
    MixedNeedsFit,
    /// An estimated delay without the fit.
    #[error("only the fit estimates a delay; use the method fit or all, or give the delay in seconds")]
    DelayNeedsFit,
    /// A level that is none.
    #[error("{setting} = {value} must be a finite number above 0; leave it out to have it read off the record")]
    Level {
        /// The setting with its unit.
        setting: &'static str,
        /// The value given.
        value: f64,
    },
}

impl SettingsError {
    /// Short name for scripts; it does not change with the wording of the message.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::MixedNeedsFit => "mixed-needs-fit",
            Self::DelayNeedsFit => "delay-needs-fit",
            Self::Level { .. } => "level",
        }
    }
}

impl Settings {
    /// Whether a method asked for can do what is asked. The delay's own value is checked by the methods.
    ///
    /// # Errors
    /// [`SettingsError`] with the remedy.
    pub fn check(&self) -> Result<(), SettingsError> {
        if !self.method.includes(Method::Fit) {
            if self.drag == Some(DragLaw::Mixed) {
                return Err(SettingsError::MixedNeedsFit);
            }
            if self.delay == Delay::Estimated {
                return Err(SettingsError::DelayNeedsFit);
            }
        }
        for (setting, level) in
            [("relay level in command units", self.relay_level), ("half-width in output units", self.half_width)]
        {
            if let Some(value) = level.filter(|level| !(level.is_finite() && *level > 0.0)) {
                return Err(SettingsError::Level { setting, value });
            }
        }
        Ok(())
    }
}
