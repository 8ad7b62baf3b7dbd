//! What can be wrong with a vehicle, a thruster or a demand on them.

use crate::numeric::OutOfDomain;
use crate::numeric::domain::{About, AtLeast, AtMost, Plain};

/// A refusal of the vehicle layer: which number, which limit, what to do.
///
/// Thrusters are counted from 0 in the order of their chain; a thruster used alone is number 0.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VehicleError {
    /// A parameter or an input outside its domain.
    #[error(transparent)]
    OutOfDomain(#[from] OutOfDomain),
    /// Thrust that is negative or falls as the command grows: no inverse.
    #[error(
        "thrust {} N with slope {} at the dead zone {}, slope {} at the limit {}: thrust must not be negative nor fall between \
         them; narrow the range or fit again", About(*.thrust_at_dead_zone_n), About(*.slope_at_dead_zone), Plain(*.dead_zone),
        About(*.slope_at_limit), Plain(*.limit)
    )]
    NotMonotone {
        /// Command magnitude at which the propeller starts.
        dead_zone: f64,
        /// Largest command magnitude.
        limit: f64,
        /// Thrust magnitude at the dead zone's end.
        thrust_at_dead_zone_n: f64,
        /// Thrust per command at the dead zone's end.
        slope_at_dead_zone: f64,
        /// Thrust per command at the limit.
        slope_at_limit: f64,
    },
    /// More thrust than the largest command gives.
    #[error(
        "thruster {thruster}: {} N asked for, {} N is the most on that side; ask for less or clamp",
        Plain(*.thrust_n), AtMost(*.largest_n)
    )]
    Saturated {
        /// Number of the thruster.
        thruster: usize,
        /// Thrust asked for.
        thrust_n: f64,
        /// Thrust at the largest command on that side.
        largest_n: f64,
    },
    /// A thrust between standing still and the slowest rotation.
    #[error(
        "thruster {thruster}: {} N asked for, {} N is the least while turning on that side; bias the thruster out of its dead \
         zone or clamp", Plain(*.thrust_n), AtLeast(*.smallest_n)
    )]
    InDeadZone {
        /// Number of the thruster.
        thruster: usize,
        /// Thrust asked for.
        thrust_n: f64,
        /// Thrust at the dead zone's end on that side.
        smallest_n: f64,
    },
    /// Thrusters that cannot produce every axis independently, or data that cannot tell parameters apart.
    #[error(
        "{what} has rank {rank}, {needed} is needed: columns depend on each other; place or measure them differently"
    )]
    RankDeficient {
        /// The matrix.
        what: &'static str,
        /// Its numerical rank.
        rank: usize,
        /// The rank it must have.
        needed: usize,
    },
    /// A wrong number of items.
    #[error("{count} {what} given, {needed} needed; give that many")]
    Count {
        /// The items.
        what: &'static str,
        /// How many were given.
        count: usize,
        /// How many it takes (the least number, for data).
        needed: usize,
    },
    /// A measured thrust that points against its command.
    #[error(
        "point {index}: command {command} gave {thrust_n} N, against its own sign; check wiring or the scale's sign"
    )]
    ThrustAgainstCommand {
        /// Position of the point in the data.
        index: usize,
        /// Command of the point.
        command: f64,
        /// Thrust of the point.
        thrust_n: f64,
    },
    /// A propeller that turned at a smaller command than one at which it stood.
    #[error(
        "the propeller turned at command {turned_at} and stood at {stood_at}, threshold {threshold_n} N: repeat the points or \
         change the threshold"
    )]
    DeadZoneUnclear {
        /// Smallest command on that side at which thrust was measured.
        turned_at: f64,
        /// Largest command on that side at which none was.
        stood_at: f64,
        /// Thrust below which the propeller counts as standing.
        threshold_n: f64,
    },
    /// Euler angles near pitch = +-90 degrees, where roll and yaw are the same rotation.
    #[error("pitch {} rad: Euler rates need abs(cos(pitch)) >= {limit}; use the quaternion form", About(*.pitch_rad))]
    PitchSingular {
        /// The pitch.
        pitch_rad: f64,
        /// Least cosine.
        limit: f64,
    },
    /// A matrix that is not symmetric, or not positive definite where inertia or drag must be.
    #[error("{matrix} is not {property}: {} is below {}; correct its entries", About(*.value), Plain(*.limit))]
    Indefinite {
        /// The matrix.
        matrix: &'static str,
        /// What it must be.
        property: &'static str,
        /// The offending eigenvalue, or minus the asymmetry.
        value: f64,
        /// The least value allowed.
        limit: f64,
    },
    /// An integration step after which the state is no number.
    #[error("the state is not finite {} s after the start with steps of {} s; take smaller steps", About(*.time_s), Plain(*.step_s))]
    Diverged {
        /// Simulated time.
        time_s: f64,
        /// The step.
        step_s: f64,
    },
    /// An iteration that rounding keeps from its end.
    #[error("{what} did not settle; scale axes and weights to similar size")]
    NoConvergence {
        /// The iteration.
        what: &'static str,
    },
}

crate::numeric::codes! { pub VehicleError {
    OutOfDomain.0, NotMonotone => "thrust-not-monotone", Saturated => "thrust-too-large",
    InDeadZone => "thrust-in-dead-zone", RankDeficient => "rank-deficient", Count => "count",
    ThrustAgainstCommand => "thrust-against-command", DeadZoneUnclear => "dead-zone-unclear",
    PitchSingular => "pitch-singular", Indefinite => "indefinite", Diverged => "diverged",
    NoConvergence => "no-convergence",
} }

impl VehicleError {
    /// The same refusal with the number the thruster has in its chain.
    #[must_use]
    pub(super) fn of_thruster(self, thruster: usize) -> Self {
        match self {
            Self::Saturated { thrust_n, largest_n, .. } => Self::Saturated { thruster, thrust_n, largest_n },
            Self::InDeadZone { thrust_n, smallest_n, .. } => Self::InDeadZone { thruster, thrust_n, smallest_n },
            other => other,
        }
    }
}

/// What a duration in integration steps has to be.
#[cfg(feature = "std")]
pub(super) const WHOLE: crate::numeric::Limit = crate::numeric::Limit::Words("a whole number");
