//! Why a record has no features.

use crate::numeric::OutOfDomain;
use crate::numeric::domain::{About, Plain};

/// Why a record shows no steady self-oscillation. Values are in the record's units.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FeatureError {
    /// The command never changes.
    #[error("the input is {} throughout and must change; log the relay's command, or choose its column (--input COL)", Plain(*.value))]
    ConstantInput {
        /// The value.
        value: f64,
    },
    /// The command has more than two values, and does not go between them as a rudder does.
    #[error(
        "only {percent:.0} % of the input lie at its two extremes, at least {required:.0} % needed for a relay, and it does not \
         go straight from one to the other at one rate; fit the whole record instead (--method fit)"
    )]
    NotARelay {
        /// Share of samples at either extreme, in percent.
        percent: f64,
        /// Share needed.
        required: f64,
    },
    /// The command stays at one level: the relay has lost the axis.
    #[error(
        "the command stays at {} for the last {} s, {ratio:.1} times a half period, and does not overcome the disturbance; raise \
         the relay level, trim the vehicle, or leave that part out (--to)", Plain(*.level), About(*.duration_s)
    )]
    Saturated {
        /// The level.
        level: f64,
        /// How long, in s.
        duration_s: f64,
        /// In half periods.
        ratio: f64,
    },
    /// Not one cycle.
    #[error("no full cycle: {switchings} changes of the command; log for at least three periods")]
    NoCycle {
        /// Changes of the command.
        switchings: u32,
    },
    /// Not enough steady cycles.
    #[error(
        "{cycles} steady cycles after {start_up} of start-up, at least {required} needed; log longer, until successive \
         cycles are alike"
    )]
    TooFewCycles {
        /// Steady cycles.
        cycles: u32,
        /// Cycles before them.
        start_up: u32,
        /// Steady cycles needed.
        required: u32,
    },
    /// The amplitude grows.
    #[error("the amplitude grows by a factor of {ratio:.2} over the record; wait until it settles, or lower the level")]
    Growing {
        /// Amplitude at the end over that at the beginning.
        ratio: f64,
    },
    /// The amplitude falls.
    #[error("the amplitude falls by a factor of {ratio:.2} over the record; wait until it settles, or widen the relay")]
    Decaying {
        /// Amplitude at the end over that at the beginning.
        ratio: f64,
    },
    /// The middle of the oscillation moves away.
    #[error("the middle drifts by {amplitudes:.2} amplitudes over the record; hold the reference and remove the drift")]
    Drift {
        /// Change of the middle, in amplitudes.
        amplitudes: f64,
    },
    /// A mean or a spread that the arithmetic does not have.
    #[error(transparent)]
    OutOfDomain(#[from] OutOfDomain),
}

crate::numeric::codes! { pub FeatureError {
    ConstantInput => "constant-input", NotARelay => "not-a-relay", Saturated => "saturated", NoCycle => "no-cycle",
    TooFewCycles => "too-few-cycles", Growing => "growing", Decaying => "decaying", Drift => "drift", OutOfDomain.0,
} }
