//! The names that the five jobs need: describe, predict, identify, tune, verify.
//!
//! ```
//! use selfosc::prelude::*;
//! let axis = DragAxis::quadratic(1.0, 0.5)?;
//! let relay = RelayHysteresis::new(1.0, 0.3, 0.0)?;
//! let cycle = limit_cycle(&axis, &relay)?;
//! let gain = relay.describing_function(&Sinusoid::new(0.0, cycle.amplitude)?)?;
//! assert!(cycle.period_s > 0.0 && gain.p > 0.0);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

#[cfg(feature = "std")]
pub use crate::Error;
#[cfg(feature = "std")]
pub use crate::balance::HarmonicBalance;
#[cfg(feature = "std")]
pub use crate::claims::{CLAIMS, verify};
pub use crate::control::{Controller, FeedForward, Structure, Tuning};
pub use crate::describing::{ClosedForm, DescribingFunction};
#[cfg(feature = "std")]
pub use crate::experiment::Record;
pub use crate::identify::DragLaw;
#[cfg(feature = "std")]
pub use crate::identify::{Identification, Session, Settings};
pub use crate::nonlinearity::*;
pub use crate::orbit::{LimitCycle, limit_cycle};
#[cfg(feature = "std")]
pub use crate::orbit::{TwoLevelRelay, certify, orbits};
pub use crate::plant::DragAxis;
#[cfg(feature = "std")]
pub use crate::plant::{StateSpace, TransferFunction};
