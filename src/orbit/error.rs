//! Why there is no limit cycle.

use crate::numeric::OutOfDomain;
use crate::numeric::domain::{About, Plain};
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
    /// The relay cannot overcome the constant force: the axis drifts away.
    #[error(
        "disturbance {} plus relay offset {} must be smaller in magnitude than the relay level \
         {}, or the axis drifts away; raise the level or trim the disturbance",
        Plain(*.disturbance), Plain(*.offset), Plain(*.level)
    )]
    Drift {
        /// Disturbance delta of the axis, in force units.
        disturbance: f64,
        /// Offset d of the relay, in force units.
        offset: f64,
        /// Level C of the relay, in force units.
        level: f64,
    },
    /// Nothing takes energy out: the oscillation grows without limit.
    #[error("linear_drag = 0 and quadratic_drag = 0: the oscillation grows without limit; give at least one above 0")]
    NoDrag,
    /// Nothing keeps the relay from switching ever faster, and the axis comes to rest.
    #[error(
        "half_width = 0 and delay_s = 0: the relay switches ever faster and the oscillation dies out; give at least \
         one above 0"
    )]
    NoHysteresis,
    /// A command that does not drive the output past its level.
    #[error(
        "a force of {force} (command and load) does not drive the output past the relay's level {level}; raise the command, \
         or move the level", force = Plain(*.force), level = Plain(*.level)
    )]
    LevelNotPassed {
        /// Command and load, input units.
        force: f64,
        /// The level, output units.
        level: f64,
    },
    /// Rounding hides the limit cycle: drag too weak for the arithmetic, or numbers beyond its range.
    #[error(
        "multiplier differs from one by {}, which rounding hides, or numbers overflow; give more drag or hysteresis, or other \
         units in which the numbers are near 1", About(*.multiplier - 1.0)
    )]
    Unresolved {
        /// Multiplier of the return map where the search ended; NaN after an overflow.
        multiplier: f64,
    },
    /// A reference, disturbance or range of periods outside its domain.
    #[error(transparent)]
    OutOfDomain(#[from] OutOfDomain),
    /// An enclosure that stayed too wide, or a cycle that is none.
    #[error("not proved of the cycle with half-period {} s: {what}; scale time and state to order one", About(*.half_period_s))]
    NotProved {
        /// The statement to prove.
        what: &'static str,
        /// Half the cycle's period, s.
        half_period_s: f64,
    },
    /// Poles that cannot be separated, nor taken as a group.
    #[error(
        "the {order} poles of the plant cannot be enclosed: more than four of them, or two complex pairs, are within a \
         few per cent of each other; move them apart or leave some out"
    )]
    CrowdedPoles {
        /// Order of the plant.
        order: usize,
    },
}

crate::numeric::codes! { pub OrbitError {
    #[cfg(feature = "std")] Plant.0, OutOfDomain.0, Drift => "drifts-away", NoDrag => "no-drag",
    NoHysteresis => "no-hysteresis", LevelNotPassed => "level-not-passed", Unresolved => "orbit-unresolved",
    NotProved => "not-proved", CrowdedPoles => "crowded-poles",
} }
