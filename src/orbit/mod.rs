//! Exact limit cycles under a relay, for comparison with harmonic balance and for identification.

mod closed_form;
mod drag_axis;
mod error;
mod half_cycle;

pub use closed_form::{
    linear_amplitude_excess, linear_half_cycle, linear_half_width, quadratic_half_cycle, quadratic_period,
    quadratic_speeds,
};
pub use drag_axis::{LimitCycle, Return, Switching, limit_cycle, return_map};
pub use error::OrbitError;
