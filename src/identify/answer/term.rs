//! Terms that a model may have in addition to inertia, linear and quadratic drag and white noise.

use serde::{Deserialize, Serialize};

/// Additional terms of a model, each tried where it makes the record likelier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Term {
    /// First-order lag of the actuator.
    Lag,
    /// Limited rate of the actuator.
    RateLimit,
    /// Time without thrust after the command changes its sign.
    ReversalPause,
    /// Restoring force.
    Stiffness,
    /// Drag proportional to the cube of the speed.
    CubicDrag,
    /// Drag that differs by the sign of the velocity.
    SkewDrag,
    /// Drag that follows the speed late, as of water set in motion before.
    FluidMemory,
    /// First-order filter of the sensor.
    SensorFilter,
    /// A delay that differs from the given delay.
    Delay,
    /// A force that walks at random.
    ProcessForce,
    /// An error of the reading that is alike from sample to sample.
    ColouredNoise,
}

impl Term {
    pub(crate) const ALL: [Self; 11] = [
        Self::Lag,
        Self::RateLimit,
        Self::ReversalPause,
        Self::Stiffness,
        Self::CubicDrag,
        Self::SkewDrag,
        Self::FluidMemory,
        Self::SensorFilter,
        Self::Delay,
        Self::ProcessForce,
        Self::ColouredNoise,
    ];

    /// Name on the command line and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Lag => "lag",
            Self::RateLimit => "rate-limit",
            Self::ReversalPause => "reversal-pause",
            Self::Stiffness => "stiffness",
            Self::CubicDrag => "cubic-drag",
            Self::SkewDrag => "one-sided-drag",
            Self::FluidMemory => "fluid-memory",
            Self::SensorFilter => "sensor-filter",
            Self::Delay => "delay",
            Self::ProcessForce => "process-force",
            Self::ColouredNoise => "coloured-noise",
        }
    }

    /// The observation on a record with the term, as the beginning of a sentence.
    pub(super) fn finding(self) -> &'static str {
        match self {
            Self::Lag => "the actuator follows the command with a lag",
            Self::RateLimit => "the actuator follows the command at a limited rate",
            Self::ReversalPause => "the thrust pauses when the command changes its sign",
            Self::Stiffness => "a restoring force acts",
            Self::CubicDrag => "drag grows with the cube of the speed",
            Self::SkewDrag => "drag is larger to one side than to the other",
            Self::FluidMemory => "a part of the drag follows the speed late",
            Self::SensorFilter => "the sensor follows the motion with a lag",
            Self::Delay => "the delay is another than the one given",
            Self::ProcessForce => "a force acts that changes with time",
            Self::ColouredNoise => "errors of the readings are alike from sample to sample",
        }
    }
}
