//! Why there is no orbit.

use crate::plant::PlantError;

/// Why a limit cycle cannot be computed, or why there is none.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OrbitError {
    /// The plant is at fault.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// A reference, disturbance or tolerance that is not usable.
    #[error("{quantity} = {value} must be {required}")]
    Parameter {
        /// What it is.
        quantity: &'static str,
        /// The value given.
        value: f64,
        /// What it has to be.
        required: &'static str,
    },
    /// A range of periods that is empty or not positive.
    #[error("the range of periods from {from_s} s to {to_s} s must be finite, above 0 and ascending")]
    Range {
        /// Lower end, s.
        from_s: f64,
        /// Upper end, s.
        to_s: f64,
    },
    /// A range of periods that takes too many samples.
    #[error("the range of periods from {from_s} s to {to_s} s needs more than {limit} samples; narrow it")]
    TooManySamples {
        /// Lower end, s.
        from_s: f64,
        /// Upper end, s.
        to_s: f64,
        /// The most there may be.
        limit: usize,
    },
    /// An integrating plant is driven one way on average: the constant input is not below the relay's level.
    #[error(
        "no limit cycle: the constant input {constant_input} (offset plus disturbance) drives the integrating plant away; \
         its magnitude must be below the relay level {level}"
    )]
    Drifts {
        /// Relay offset plus disturbance, in input units.
        constant_input: f64,
        /// Relay level C, in input units.
        level: f64,
    },
    /// A constant input or, for a plant without integrator, a reference that rules symmetric orbits out (Theorem 2).
    #[error(
        "no symmetric limit cycle with a constant input of {constant_input} and a reference of {reference}; \
         ask for all limit cycles instead"
    )]
    NotSymmetric {
        /// Relay offset plus disturbance, in input units.
        constant_input: f64,
        /// Reference, in output units.
        reference: f64,
    },
    /// Extrema too close to each other to be told apart.
    #[error("the output between two switchings needs more than {limit} pieces to isolate its extrema")]
    TooManyPieces {
        /// The most there may be.
        limit: usize,
    },
    /// A step size that shrank to nothing.
    #[error("the step at t = {time_s} s fell to {step_s} s; the right side is not smooth there or not finite")]
    StepTooSmall {
        /// Time, s.
        time_s: f64,
        /// The step, s.
        step_s: f64,
    },
    /// More steps or events than allowed.
    #[error("stopped at t = {time_s} s after {steps} steps; raise the limit or the tolerances")]
    TooManySteps {
        /// Time reached, s.
        time_s: f64,
        /// Steps taken.
        steps: usize,
    },
}
