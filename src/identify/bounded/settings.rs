//! What is assumed: the model, the sensor, and where parameters are looked for.

use serde::{Deserialize, Serialize};

use crate::identify::DragLaw;

/// Prior knowledge of the whole delay of the loop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DelayBound {
    /// It is this, in s.
    KnownS(f64),
    /// It lies between these two, in s.
    WithinS([f64; 2]),
    /// Nothing but that it is shorter than the mean time between switchings of the command.
    Unknown,
}

/// When a logged change of the command happened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SwitchedWhen {
    /// At the sample with which the new value is logged.
    #[default]
    AtSamples,
    /// Anywhere since the sample before, each for itself.
    Anywhere,
}

/// A model and a sensor, for [`enclose`](super::enclose).
///
/// ```
/// use selfosc::identify::bounded::{DelayBound, BoundedModel};
/// use selfosc::identify::DragLaw;
/// let settings = BoundedModel { error: 0.01, ..BoundedModel::new(DragLaw::Mixed, DelayBound::Unknown) };
/// assert!(!settings.cubic);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoundedModel {
    /// The drag law.
    pub law: DragLaw,
    /// Whether the part of the drag proportional to speed may be negative, as a fit over a small range of speeds may have it.
    pub either_sign: bool,
    /// A force `beta_3 v^3` besides.
    pub cubic: bool,
    /// A restoring force proportional to the coordinate.
    pub stiffness: bool,
    /// The force follows the command with a first-order lag, of at most a quarter of the mean time between switchings. When the record
    /// is first followed it is taken to be among the commands of the log, for any earlier command.
    pub lag: bool,
    /// Prior knowledge of the delay.
    pub delay: DelayBound,
    /// When the command changed.
    pub switching: SwitchedWhen,
    /// Step of the sensor, zero for none; found in the record if not given.
    pub quantum: Option<f64>,
    /// Largest error of a reading in addition to half a step, in units of the output.
    pub error: f64,
    /// Largest error of a stamp, in s.
    pub jitter_s: f64,
    /// Readings, of all records together, that may be in error by any amount, whichever they are.
    pub outliers: usize,
    /// Factor by which inertia, and drag upwards, are looked for on either side of their order of magnitude in the record.
    pub reach: f64,
    /// Work that may be spent, in passes of 300 integration steps or as many samples under modulating functions. It is counted and not
    /// timed: the answer is the same on every machine.
    pub budget: usize,
}

impl BoundedModel {
    /// Usual [`reach`](Self::reach): inertia over four decades.
    const REACH: f64 = 100.0;

    /// Whether nothing narrower or wider than usual is searched.
    pub(super) fn usual_reach(&self) -> bool {
        self.reach.total_cmp(&Self::REACH).is_eq()
    }

    /// A drag law and a bound of the delay; a perfect sensor but for its step, which is found in the record; the command
    /// switched at samples; inertia over four decades.
    #[must_use]
    pub fn new(law: DragLaw, delay: DelayBound) -> Self {
        Self {
            law,
            either_sign: false,
            cubic: false,
            stiffness: false,
            lag: false,
            delay,
            switching: SwitchedWhen::AtSamples,
            quantum: None,
            error: 0.0,
            jitter_s: 0.0,
            outliers: 0,
            reach: Self::REACH,
            budget: 3000,
        }
    }
}
