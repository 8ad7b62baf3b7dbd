//! Why there is no controller.

use super::{RobustCriterion, Tuning};
use crate::numeric::OutOfDomain;
use crate::numeric::domain::{About, AtLeast, AtMost, Plain};
use crate::plant::PlantError;

/// A refusal of the control layer: which number, which limit, what to do.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ControlError {
    /// A parameter outside its domain.
    #[error(transparent)]
    OutOfDomain(#[from] OutOfDomain),
    /// A plant that is none.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// The axis' own drag damps more than the closed loop asked for.
    #[error(
        "bandwidth = {} rad/s is below {} rad/s, under which the drag of the axis alone \
         damps more than the design and the derivative gain would be negative; ask for at least {} rad/s",
        Plain(*.bandwidth_rad_s), AtLeast(*.least_rad_s), AtLeast(*.least_rad_s)
    )]
    Overdamped {
        /// The bandwidth asked for, rad/s.
        bandwidth_rad_s: f64,
        /// The least one the design has gains for, rad/s.
        least_rad_s: f64,
    },
    /// The delay leaves too little margin.
    #[error(
        "bandwidth = {} rad/s with a delay of {} s leaves less than a gain margin of {} \
         and a phase margin of {} degrees; ask for at most {} rad/s or shorten the delay",
        Plain(*.bandwidth_rad_s), About(*.delay_s), Tuning::<f64>::LEAST_GAIN_MARGIN, Tuning::<f64>::LEAST_PHASE_MARGIN_DEG,
        AtMost(*.most_rad_s)
    )]
    TooFast {
        /// The bandwidth asked for, rad/s.
        bandwidth_rad_s: f64,
        /// The delay of the loop, s.
        delay_s: f64,
        /// The largest bandwidth that leaves them, rad/s, to 1 %.
        most_rad_s: f64,
    },
    /// No bandwidth is both above what drag damps and below what the delay allows.
    #[error(
        "with a delay of {} s the bandwidth may be {} rad/s at most, and drag wants {} \
         rad/s at least; shorten the delay",
        About(*.delay_s), AtMost(*.most_rad_s), AtLeast(*.least_rad_s)
    )]
    NoBandwidth {
        /// The delay of the loop, s.
        delay_s: f64,
        /// Below this the drag alone damps more than the design, rad/s.
        least_rad_s: f64,
        /// Above this the delay leaves too little margin, rad/s.
        most_rad_s: f64,
    },
    /// No bandwidth keeps a limit for every axis of the intervals.
    #[error(
        "no bandwidth from {} to {} rad/s is proved to keep the limit for every axis of the intervals; {}{}",
        AtLeast(*.least_rad_s), AtMost(*.most_rad_s), Allowed(*.within_reach), NARROWER
    )]
    OutOfReach {
        /// Where gains begin, rad/s.
        least_rad_s: f64,
        /// Where they end, rad/s.
        most_rad_s: f64,
        /// A limit of the same kind that is proved of some gains.
        within_reach: Option<RobustCriterion>,
    },
    /// Nothing bounds the bandwidth of a loop without delay.
    #[error(
        "the limit is met up to {} rad/s, the largest bandwidth tried: without a delay nothing bounds the bandwidth; give the delay of \
         the loop (--delay) or the bandwidth (--bandwidth)", AtMost(*.kept_rad_s)
    )]
    NothingBounds {
        /// The largest bandwidth tried, rad/s.
        kept_rad_s: f64,
    },
    /// A process of a box that is not proved to be stable under the gains.
    #[error(
        "the closed loop must be stable for every process of the intervals, and is not proved to be at inertia {}, drag {}, delay {} s; \
         {}",
        About(*.alpha), About(*.drag), About(*.delay_s), Remedy(*.stabilised_rad_s)
    )]
    NotStabilised {
        /// Inertia of the process.
        alpha: f64,
        /// Slope of its drag.
        drag: f64,
        /// Delay of the loop, s.
        delay_s: f64,
        /// A bandwidth whose gains are proved to stabilise all, rad/s, where one was found.
        stabilised_rad_s: Option<f64>,
    },
    /// A loop that is not stable has no margins.
    #[error(
        "the closed loop has {poles} poles that do not decay (inertia {}, drag {}, delay {} s), all \
         must decay for margins; lower the gains or shorten the delay",
        About(*.alpha), About(*.drag), About(*.delay_s)
    )]
    Unstable {
        /// Poles in the right half plane or, as far as rounding tells, on its edge.
        poles: u32,
        /// Inertia of the axis.
        alpha: f64,
        /// Slope of its drag.
        drag: f64,
        /// Delay of the loop, s.
        delay_s: f64,
    },
    /// An oscillation that no relay with this half-width makes.
    #[error(
        "amplitude = {} with bias {} does not pass both levels at +-{}: condition 40 fails; repeat the experiment with a smaller \
         half-width or a higher relay level", About(*.amplitude), About(*.bias), Plain(*.half_width)
    )]
    BelowSwitching {
        /// Amplitude of the oscillation.
        amplitude: f64,
        /// Its bias.
        bias: f64,
        /// Half-width of the hysteresis.
        half_width: f64,
    },
    /// Two oscillations at one phase do not tell where another phase is.
    #[error(
        "both experiments are at a phase of {} degrees; repeat one with another half-width, so that the critical point can be \
         found from the two", About(*.phase_deg)
    )]
    OnePhase {
        /// Phase of both, degrees.
        phase_deg: f64,
    },
    /// A process whose phase does not reach -180 degrees.
    #[error(
        "the phase does not pass -180 degrees between {} and {} rad/s: no ultimate gain there; widen the range or choose a rule \
         that needs none", Plain(*.from_rad_s), Plain(*.to_rad_s)
    )]
    NoCriticalPoint {
        /// Where the search began, rad/s.
        from_rad_s: f64,
        /// Where it ended, rad/s.
        to_rad_s: f64,
    },
}

/// The remedy for intervals that hold too many axes.
const NARROWER: &str = "narrow the intervals, by a longer record or by hand (--alpha-interval, --beta-interval, --delay-interval, --top-speed)";

/// Which limit to ask for, where one is known.
struct Allowed(Option<RobustCriterion>);

impl core::fmt::Display for Allowed {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.0 {
            Some(RobustCriterion::Sensitivity(most)) => {
                write!(f, "allow a sensitivity of {} (--ms) or ", AtLeast(most))
            }
            Some(RobustCriterion::PhaseRad(least)) => {
                write!(f, "allow a phase margin of {} degrees (--phase-margin) or ", AtMost(least.to_degrees()))
            }
            _ => Ok(()),
        }
    }
}

/// What helps where gains do not stabilise every process.
struct Remedy(Option<f64>);

impl core::fmt::Display for Remedy {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.0 {
            Some(bandwidth) => {
                write!(f, "ask for a bandwidth of {} rad/s (--bandwidth), at which it is", Plain(bandwidth))
            }
            None => f.write_str(NARROWER),
        }
    }
}

crate::numeric::codes! { pub ControlError {
    OutOfDomain.0, Plant.0, Overdamped => "overdamped", TooFast => "too-fast", NoBandwidth => "no-bandwidth",
    OutOfReach => "out-of-reach", NothingBounds => "nothing-bounds", Unstable => "unstable", NotStabilised => "unstable",
    BelowSwitching => "below-switching", OnePhase => "one-phase", NoCriticalPoint => "no-critical-point",
} }
