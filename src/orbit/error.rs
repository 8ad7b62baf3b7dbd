//! Why there is no limit cycle.

#[cfg(feature = "std")]
use crate::plant::PlantError;

/// Why a loop has no limit cycle, or none that the arithmetic can resolve. Values are in the caller's units.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OrbitError {
    /// The plant is at fault.
    #[cfg(feature = "std")]
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// The relay cannot overcome the constant force, so that the axis drifts away.
    #[error(
        "disturbance {disturbance} plus relay offset {offset} must be smaller in magnitude than the relay level \
         {level}, or the axis drifts away; raise the level or trim the disturbance"
    )]
    Drift {
        /// Disturbance delta of the axis, in force units.
        disturbance: f64,
        /// Offset d of the relay, in force units.
        offset: f64,
        /// Level C of the relay, in force units.
        level: f64,
    },
    /// Nothing takes energy out, so that the oscillation grows without limit.
    #[error("linear_drag = 0 and quadratic_drag = 0: the oscillation grows without limit; give at least one above 0")]
    NoDrag,
    /// Nothing keeps the relay from switching ever faster, and the axis comes to rest.
    #[error(
        "half_width = 0 and delay_s = 0: the relay switches ever faster and the oscillation dies out; give at least \
         one above 0"
    )]
    NoHysteresis,
    /// Rounding hides the limit cycle: drag too weak for the arithmetic, or numbers beyond its range.
    #[error(
        "multiplier {multiplier} is one within rounding, or numbers overflow: this arithmetic cannot resolve the limit \
         cycle; use a wider one, scale the units, or give more drag or hysteresis"
    )]
    Unresolved {
        /// Multiplier of the return map where the search ended; NaN after an overflow.
        multiplier: f64,
    },
    /// A speed at which the axis cannot cross a switching level.
    #[error(
        "speed = {speed} must be a finite number, 0 or more; give the magnitude of the speed at the switching level"
    )]
    Speed {
        /// The speed given, in position units per second.
        speed: f64,
    },
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
    /// A delay for which no certificate is built.
    #[error(
        "delay_s = {delay_s} must be below the half-period of {half_period_s} s for a certificate: with more than one \
         switching on its way there is none yet"
    )]
    LongDelay {
        /// The plant's delay, s.
        delay_s: f64,
        /// Half the cycle's period, s.
        half_period_s: f64,
    },
    /// An enclosure that stayed too wide, or a cycle that is none.
    #[error("not proved of the cycle with half-period {half_period_s} s: {what}; scale time and state to order one")]
    NotProved {
        /// What was to be proved.
        what: &'static str,
        /// Half the cycle's period, s.
        half_period_s: f64,
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
