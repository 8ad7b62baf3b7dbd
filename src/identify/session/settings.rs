//! Settings of an identification: methods, drag law, delay, and the assumptions of the bounds.

use core::num::NonZeroUsize;

use serde::{Deserialize, Serialize};

use crate::identify::answer::{Assumptions, Delay, DragLaw};
use crate::numeric::domain::require;
use crate::numeric::{Limit, OutOfDomain};

/// Ways from records to parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "command", derive(clap::ValueEnum))]
pub enum Method {
    /// The paper's: the first harmonic of the mean cycle.
    Iso,
    /// The exact limit cycle with the mean cycle's features.
    Exact,
    /// Likelihood of every sample: the answer to use, with its terms, and each drag law alone.
    Fit,
    /// Guaranteed bounds: every reading a constraint, and no distribution of errors assumed. It takes seconds, and only who asks for
    /// it by name gets it.
    Bounded,
    /// All of the former but the guaranteed bounds.
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
            Self::Bounded => "bounded",
            Self::All => "all",
        }
    }

    /// Whether `one` is asked for.
    #[must_use]
    pub fn includes(self, one: Self) -> bool {
        self == one || self == Self::All && one != Self::Bounded
    }
}

/// Methods, drag law, delay, and the assumptions of the guaranteed bounds. The default is that of the command: every method, every drag law, the delay
/// estimated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Methods to use.
    pub method: Method,
    /// The drag law, if given; else every law that a method has.
    pub drag: Option<DragLaw>,
    /// Delay of the whole loop. A given delay is tested: the answer reports a record that contradicts it.
    pub delay: Delay,
    /// Relay level in the units wanted, above 0, if the log has the command in others.
    pub relay_level: Option<f64>,
    /// Level at which the command switched, in output units, above 0, if it is not to be read off the record.
    pub half_width: Option<f64>,
    /// Whether a record of another manoeuvre than a relay experiment is taken: its answer is `doubtful`, or `widened` where a
    /// command that is not held moves the vehicle through two cycles. The guaranteed bounds take any record.
    pub any_input: bool,
    /// Sizes of the sources of error that no residual shows, for the practical intervals.
    pub assume: Assumptions,
    /// For the guaranteed bounds: largest error of a reading in addition to half a step of the sensor, in output units, 0 or more.
    pub error: f64,
    /// For the guaranteed bounds: step of the sensor in output units, above 0, if it is not to be read off the record.
    pub quantum: Option<f64>,
    /// For the guaranteed bounds: largest error of a stamp, in s, 0 or more.
    pub jitter_s: f64,
    /// For the guaranteed bounds: readings, of all records together, that may be in error by any amount.
    pub outliers: usize,
    /// For the guaranteed bounds: work that may be spent, in passes over the records, if not as much as
    /// [`BoundedModel::new`](crate::identify::bounded::BoundedModel::new) has. The fewer, the wider the bounds may be; they hold.
    pub budget: Option<NonZeroUsize>,
    /// For the guaranteed bounds: whether the model has a restoring force proportional to the coordinate.
    pub stiffness: bool,
    /// For the guaranteed bounds: whether the force follows the command with a first-order lag.
    pub lag: bool,
    /// For the guaranteed bounds: whether the drag has a part proportional to the cube of speed.
    pub cubic: bool,
    /// For the guaranteed bounds: whether the part of the drag proportional to speed may drive.
    pub either_sign: bool,
    /// For the guaranteed bounds: whether a proof is wanted that is checked without a search.
    pub certificate: bool,
}

/// Settings that contradict each other or lie outside their domains.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingsError {
    /// Mixed drag without the fit.
    #[error("only the fit knows mixed drag; use it (--method fit), or another drag law (--drag)")]
    MixedNeedsFit,
    /// An assumption on the errors, a term or a certificate that only the guaranteed bounds have.
    #[error(
        "--error, --quantum, --jitter, --outliers, --budget, --stiffness, --lag, --cubic, --either-sign and --certificate are of the \
         guaranteed bounds; use these (--method bounded)"
    )]
    NeedsBounded,
    /// A level outside its domain.
    #[error(transparent)]
    OutOfDomain(#[from] OutOfDomain),
}

crate::numeric::codes! { pub SettingsError {
    MixedNeedsFit => "mixed-needs-fit", NeedsBounded => "needs-bounded", OutOfDomain.0,
} }

impl Settings {
    /// Whether a method asked for can do what is asked, and each number is in its domain.
    ///
    /// # Errors
    /// [`SettingsError`] with the remedy.
    pub fn check(&self) -> Result<(), SettingsError> {
        if !self.method.includes(Method::Fit) && self.method != Method::Bounded && self.drag == Some(DragLaw::Mixed) {
            return Err(SettingsError::MixedNeedsFit);
        }
        let doubted = self.error > 0.0 || self.quantum.is_some() || self.jitter_s > 0.0 || self.outliers > 0;
        let terms = [self.stiffness, self.lag, self.cubic, self.either_sign];
        let of_bounded = doubted || terms.contains(&true) || self.budget.is_some() || self.certificate;
        if self.method != Method::Bounded && of_bounded {
            return Err(SettingsError::NeedsBounded);
        }
        let levels = [
            ("relay level", self.relay_level, "command units"),
            ("half-width", self.half_width, "output units"),
            ("step of the sensor", self.quantum, "output units"),
        ];
        for (quantity, level, unit) in levels {
            let remedy = "leave it out to have it read off the record";
            level.map_or(Ok(()), |level| require(quantity, level, unit, Limit::Positive, remedy).map(|_| ()))?;
        }
        let remedy = "give the largest error from the sensor's data sheet, 0 for rounding alone";
        require("largest error of a reading", self.error, "output units", Limit::NonNegative, remedy)?;
        let remedy = "give the largest error of a stamp, 0 for a clock that is right";
        require("largest error of a stamp", self.jitter_s, "s", Limit::NonNegative, remedy)?;
        self.assume.check()?;
        if let Delay::KnownS(delay_s) = self.delay {
            require("delay", delay_s, "s", Limit::NonNegative, "leave it out to have it estimated")?;
        }
        Ok(())
    }
}
