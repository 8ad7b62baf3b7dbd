//! Stages of an identification, for progress reports.

use core::fmt;

/// The current stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Stage {
    /// Cycles are looked for.
    Cycles,
    /// Parameters are enclosed.
    Bounds,
    /// The drag laws are fitted.
    Fit,
    /// Terms of the motion and of its disturbances are tried, in parallel with the fits.
    Terms,
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cycles => "looking for cycles",
            Self::Bounds => "enclosing the parameters",
            Self::Fit => "fitting the drag laws",
            Self::Terms => "looking for what else acts",
        })
    }
}
