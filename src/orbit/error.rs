//! Why there is no limit cycle.

/// Why a loop has no limit cycle, or none that the arithmetic can resolve. Values are in the caller's units.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OrbitError {
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
}
