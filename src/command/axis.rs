//! The arguments that describe a drag axis and its relay, common to `predict` and `simulate`.

use clap::Args;

use super::CommandError;
use crate::nonlinearity::RelayHysteresis;
use crate::plant::DragAxis;

#[derive(Debug, Args)]
pub(super) struct AxisArguments {
    /// Inertia with added mass, command units per output unit per s^2
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    alpha: f64,
    /// Linear drag, command units per output unit per s
    #[arg(long, value_name = "B", default_value_t = 0.0, allow_negative_numbers = true)]
    beta: f64,
    /// Quadratic drag, command units per (output unit per s)^2
    #[arg(long, value_name = "Q", default_value_t = 0.0, allow_negative_numbers = true)]
    beta_quadratic: f64,
    /// Constant disturbance, command units
    #[arg(long, value_name = "D", default_value_t = 0.0, allow_negative_numbers = true)]
    delta: f64,
    /// Relay level C, command units
    #[arg(long, value_name = "C", allow_negative_numbers = true)]
    relay: f64,
    /// Half-width x_a of the relay's hysteresis, output units
    #[arg(long, value_name = "XA", allow_negative_numbers = true)]
    half_width: f64,
    /// Delay of the whole loop in s
    #[arg(long, value_name = "S", default_value_t = 0.0, allow_negative_numbers = true)]
    delay: f64,
}

impl AxisArguments {
    pub(super) fn axis(&self) -> Result<DragAxis<f64>, CommandError> {
        let axis = DragAxis::mixed(self.alpha, self.beta, self.beta_quadratic)?;
        Ok(axis.with_disturbance(self.delta)?.with_delay_s(self.delay)?)
    }

    pub(super) fn relay(&self) -> Result<RelayHysteresis<f64>, CommandError> {
        Ok(RelayHysteresis::new(self.relay, self.half_width, 0.0)?)
    }
}
