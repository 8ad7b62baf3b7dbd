//! Why an experiment was not accepted, or was broken off.

use crate::numeric::domain::{About, AtLeast, AtMost, Plain};

/// Why a running experiment was broken off. Values are in the units of the [`Protocol`](super::Protocol), as f64 in every arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// A reading or a time that is no number.
    #[error("{quantity} = {value}, a finite number needed; check the sensor's driver")]
    NotFinite {
        /// Reading, time, or the integral of the readings.
        quantity: &'static str,
        /// The value: NaN or infinite, in f32 too.
        value: f32,
    },
    /// A time that is not after its predecessor.
    #[error("time {} s after {} s; samples must be in order and each given once", Plain(*.time_s), Plain(*.previous_s))]
    TimeOrder {
        /// Time of this sample.
        time_s: f64,
        /// Time of the sample before.
        previous_s: f64,
    },
    /// A clock too far on for the arithmetic, as the time since power-up in f32 is after hours.
    #[error(
        "at {} s no {} s can be told; give the time in s since the start of the experiment, or use f64",
        About(*.time_s), Plain(*.interval_s)
    )]
    CoarseTime {
        /// Time at which the experiment would be over.
        time_s: f64,
        /// Time between samples as planned.
        interval_s: f64,
    },
    /// No sample for too long.
    #[error("{} s without a sample, limit {} s; speed up the loop or plan a longer interval", AtLeast(*.gap_s), AtMost(*.limit_s))]
    Gap {
        /// Time between two samples.
        gap_s: f64,
        /// The limit.
        limit_s: f64,
    },
    /// A reading further from its predecessor than the vehicle can have moved.
    #[error("the reading jumped by {}, limit {}; check the sensor or allow a higher rate", About(*.change), AtMost(*.limit))]
    Jump {
        /// Change of the reading, for a heading the short way round.
        change: f64,
        /// The limit over this interval.
        limit: f64,
    },
    /// A heading of more turns than any sensor counts.
    #[error("the heading reads {}, limit {} either way; check the sensor and its units", About(*.reading), AtMost(*.limit))]
    Range {
        /// The reading.
        reading: f64,
        /// The limit.
        limit: f64,
    },
    /// The coordinate is outside the space given to the experiment.
    #[error(
        "{} from the reference, limit {}; check the actuator's sign and the disturbance, or give more room",
        AtLeast(*.distance), AtMost(*.limit)
    )]
    Excursion {
        /// Distance from the reference.
        distance: f64,
        /// The limit.
        limit: f64,
    },
    /// The first command drives the vehicle away from the reference.
    #[error(
        "under the first command the reading moved {} away from the reference, limit {}; check the signs of actuator and \
         sensor, or trim", AtLeast(*.moved), AtMost(*.limit)
    )]
    WrongWay {
        /// Way in the wrong direction.
        moved: f64,
        /// The limit.
        limit: f64,
    },
    /// The reading flickers, but goes nowhere: for four times the longest half-period before the last, or the patience.
    #[error(
        "the reading stays within {} for {} s under a relay that drives; check the sensor, the thrusters and the trim",
        About(*.range), About(*.unchanged_s)
    )]
    NoMotion {
        /// How far it may be from where it was: half a half-width, or more for a coarse sensor.
        range: f64,
        /// For how long.
        unchanged_s: f64,
    },
    /// The sensor's noise switches the relay, in the last attempt either.
    #[error(
        "noise would switch the relay within {} s of the switching before, at half-width {}; quieten the sensor or allow a \
         wider relay", About(*.dwell_s), About(*.half_width)
    )]
    Noise {
        /// Half-width of the last attempt.
        half_width: f64,
        /// Least time between switchings.
        dwell_s: f64,
    },
    /// A reading that does not move.
    #[error(
        "the reading is {} for {} s under a relay that drives; check the sensor and the thrusters",
        About(*.reading), About(*.unchanged_s)
    )]
    Stuck {
        /// The reading.
        reading: f64,
        /// For how long it has not changed.
        unchanged_s: f64,
    },
    /// The relay did not switch, in the last attempt either.
    #[error(
        "no switching at relay level {}; it does not overcome the disturbance: raise the limits or trim", About(*.relay_level)
    )]
    NoOscillation {
        /// Level of the last attempt.
        relay_level: f64,
    },
    /// The cycles did not repeat, in the last attempt either.
    #[error(
        "cycles not alike at half-width {}; allow more cycles or a larger spread, or quieten the water", About(*.half_width)
    )]
    NotConverged {
        /// Half-width of the last attempt.
        half_width: f64,
    },
    /// Condition 40 failed, in the last attempt too.
    #[error(
        "x_a + |x_0| above X_m (condition 40) at relay level {}, half-width {}; trim or raise the limits",
        About(*.relay_level), About(*.half_width)
    )]
    Condition40 {
        /// Level of the last attempt.
        relay_level: f64,
        /// Half-width of the last attempt.
        half_width: f64,
    },
    /// The whole experiment took too long.
    #[error("not done after {} s; plan for longer or for fewer attempts", Plain(*.duration_s))]
    Overtime {
        /// The time planned.
        duration_s: f64,
    },
}

crate::numeric::codes! { pub Fault {
    NotFinite => "not-finite", TimeOrder => "time-order", CoarseTime => "coarse-time", Gap => "gap", Jump => "jump",
    Range => "range", Excursion => "excursion", WrongWay => "wrong-way", NoMotion => "no-motion", Noise => "noise",
    Stuck => "stuck", NoOscillation => "no-oscillation", NotConverged => "not-converged",
    Condition40 => "condition-40", Overtime => "overtime",
} }
