//! The loop: plant, relay and reference.

use serde::{Deserialize, Serialize};

use crate::plant::{Plant, PlantError};

/// A plant in negative feedback with a two-level relay.
///
/// The command becomes `low` when the output rises past `reference + half_width` and `high` when it falls past
/// `reference - half_width`. It reaches the plant a dead time later.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RelayLoop {
    /// Plant with dead time.
    #[serde(flatten)]
    pub plant: Plant,
    /// Upper level of the command.
    pub high: f64,
    /// Lower level of the command.
    pub low: f64,
    /// Half the hysteresis, in units of the output.
    pub half_width: f64,
    /// Reference, in units of the output.
    #[serde(default)]
    pub reference: f64,
}

/// Level of the command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// The upper one.
    High,
    /// The lower one.
    Low,
}

impl Level {
    /// The other level.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::High => Self::Low,
            Self::Low => Self::High,
        }
    }
}

/// A loop that the judge does not simulate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LoopError {
    /// The plant.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// Levels.
    #[error("relay: levels {high} and {low} must be finite, the upper one first")]
    Levels {
        /// Upper level.
        high: f64,
        /// Lower level.
        low: f64,
    },
    /// Half-width, reference.
    #[error("relay: half-width {half_width} must not be negative, reference {reference} must be finite")]
    Thresholds {
        /// Half-width.
        half_width: f64,
        /// Reference.
        reference: f64,
    },
    /// Neither hysteresis nor dead time.
    #[error(
        "relay: without hysteresis and dead time it may switch infinitely often in a finite time; give one of them"
    )]
    Sliding,
}

impl RelayLoop {
    /// Checks plant and relay.
    ///
    /// # Errors
    /// A plant, level, half-width or reference that is not simulated, or a relay with neither hysteresis nor dead time.
    pub fn check(&self) -> Result<(), LoopError> {
        self.plant.check()?;
        let Self { high, low, half_width, reference, .. } = *self;
        if !(high.is_finite() && low.is_finite() && high > low) {
            return Err(LoopError::Levels { high, low });
        }
        if !(half_width >= 0.0 && half_width.is_finite() && reference.is_finite()) {
            return Err(LoopError::Thresholds { half_width, reference });
        }
        if half_width == 0.0 && self.plant.delay == 0.0 { Err(LoopError::Sliding) } else { Ok(()) }
    }

    /// Value of a level.
    #[must_use]
    pub fn command(&self, level: Level) -> f64 {
        match level {
            Level::High => self.high,
            Level::Low => self.low,
        }
    }
}
