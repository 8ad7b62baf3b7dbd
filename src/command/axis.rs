//! The arguments that describe a drag axis, common to `predict`, `simulate`, `design` and `tune`, and its relay.

use clap::Args;

use super::CommandError;
use super::number::number;
use crate::nonlinearity::RelayHysteresis;
use crate::plant::{DragAxis, PlantError};

/// What resists motion.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct MotionArguments {
    /// Inertia with added mass, command units per output unit per s^2
    #[arg(long, value_parser = number, value_name = "A", allow_negative_numbers = true)]
    pub(super) alpha: f64,
    /// Linear drag, command units per output unit per s
    #[arg(long, value_parser = number, value_name = "B", default_value_t = 0.0, allow_negative_numbers = true)]
    pub(super) beta: f64,
    /// Quadratic drag, command units per (output unit per s)^2
    #[arg(long, value_parser = number, value_name = "Q", default_value_t = 0.0, allow_negative_numbers = true)]
    pub(super) beta_quadratic: f64,
}

impl MotionArguments {
    pub(super) fn axis(&self) -> Result<DragAxis<f64>, PlantError> {
        DragAxis::mixed(self.alpha, self.beta, self.beta_quadratic)
    }
}

#[derive(Debug, Args)]
pub(super) struct AxisArguments {
    #[command(flatten)]
    pub(super) motion: MotionArguments,
    /// Constant disturbance, command units
    #[arg(long, value_parser = number, value_name = "D", default_value_t = 0.0, allow_negative_numbers = true)]
    pub(super) delta: f64,
    /// Delay of the whole loop in s
    #[arg(long, value_parser = number, value_name = "S", default_value_t = 0.0, allow_negative_numbers = true)]
    pub(super) delay: f64,
}

impl AxisArguments {
    pub(super) fn axis(&self) -> Result<DragAxis<f64>, CommandError> {
        Ok(self.motion.axis()?.with_disturbance(self.delta)?.with_delay_s(self.delay)?)
    }
}

/// A relay with hysteresis about zero.
#[derive(Debug, Args)]
pub(super) struct RelayArguments {
    /// Relay level C, command units
    #[arg(long, value_parser = number, value_name = "C", allow_negative_numbers = true)]
    pub(super) relay: f64,
    /// Half-width x_a of the relay's hysteresis, which switches at x_a and at -x_a; output units (with --degrees still radians)
    #[arg(long, value_parser = number, value_name = "XA", allow_negative_numbers = true)]
    pub(super) half_width: f64,
}

impl RelayArguments {
    pub(super) fn relay(&self) -> Result<RelayHysteresis<f64>, CommandError> {
        RelayHysteresis::new(self.relay, self.half_width, 0.0).map_err(|error| {
            let of_level = error.out_of_domain().is_some_and(|fault| fault.quantity == "level");
            CommandError::Given { flag: if of_level { "--relay" } else { "--half-width" }, error: error.into() }
        })
    }
}
