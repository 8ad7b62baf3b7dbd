//! The building blocks of piecewise-linear characteristics.

use super::{Branch, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

/// The branches of the sweep on which a kernel counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branches {
    /// Both: the characteristic has no memory here.
    Both,
    /// Only while the input grows.
    Rising,
    /// Only while the input falls.
    Falling,
}

/// The side of a breakpoint on which a step or ramp is not zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Where the input is larger.
    Above,
    /// Where the input is smaller.
    Below,
}

/// A function of the input whose Fourier integrals are elementary.
///
/// The set is redundant so that a characteristic can be written without cancellation: a dead zone is a ramp above and a
/// ramp below, not a line less a saturation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kernel<T> {
    /// The constant `value`.
    Constant {
        /// Output units.
        value: T,
        /// Where it counts.
        branches: Branches,
    },
    /// The straight line `slope x`.
    Line {
        /// Output units per input unit.
        slope: T,
    },
    /// `level sgn(x - at)`.
    Sign {
        /// Input units.
        at: T,
        /// Output units.
        level: T,
        /// Where it counts.
        branches: Branches,
    },
    /// `height` on one side of `at`, zero on the other.
    Step {
        /// Input units.
        at: T,
        /// Output units.
        height: T,
        /// Where it is not zero.
        side: Side,
        /// Where it counts.
        branches: Branches,
    },
    /// `slope abs(x - at)` on one side of `at`, zero on the other.
    Ramp {
        /// Input units.
        at: T,
        /// Output units per input unit, away from `at`.
        slope: T,
        /// Where it is not zero.
        side: Side,
        /// Where it counts.
        branches: Branches,
    },
    /// `slope (x - origin)` with the input held between `lower` and `upper`.
    Band {
        /// Input at which the band gives zero, in input units: zero, or the end from which it counts.
        origin: T,
        /// Input units.
        lower: T,
        /// Input units, above `lower`.
        upper: T,
        /// Output units per input unit.
        slope: T,
    },
}

impl<T> Kernel<T> {
    /// A constant on both branches.
    pub fn constant(value: T) -> Self {
        Self::Constant { value, branches: Branches::Both }
    }
    /// A step on both branches, `height` above `at`.
    pub fn step_above(at: T, height: T) -> Self {
        Self::Step { at, height, side: Side::Above, branches: Branches::Both }
    }
    /// A step on both branches, `height` below `at`.
    pub fn step_below(at: T, height: T) -> Self {
        Self::Step { at, height, side: Side::Below, branches: Branches::Both }
    }
    /// A ramp on both branches, `slope (x - at)` above `at`.
    pub fn ramp_above(at: T, slope: T) -> Self {
        Self::Ramp { at, slope, side: Side::Above, branches: Branches::Both }
    }
    /// A ramp on both branches, `slope (at - x)` below `at`.
    pub fn ramp_below(at: T, slope: T) -> Self {
        Self::Ramp { at, slope, side: Side::Below, branches: Branches::Both }
    }

    /// Reports the input values at which it is not smooth.
    pub fn kinks(self, report: &mut dyn FnMut(T)) {
        match self {
            Self::Constant { .. } | Self::Line { .. } => {}
            Self::Sign { at, .. } | Self::Step { at, .. } | Self::Ramp { at, .. } => report(at),
            Self::Band { lower, upper, .. } => {
                report(lower);
                report(upper);
            }
        }
    }
}

/// A kernel is a characteristic by itself.
impl<T: Real> PiecewiseLinear for Kernel<T> {
    type Number = T;

    fn value(&self, x: T, branch: Branch, _: &Sinusoid<T>) -> T {
        let beyond = |at: T, side| if side == Side::Above { x - at } else { at - x };
        let on = |branches, value: T| match (branches, branch) {
            (Branches::Rising, Branch::Falling) | (Branches::Falling, Branch::Rising) => T::zero(),
            _ => value,
        };
        match *self {
            Self::Constant { value, branches } => on(branches, value),
            Self::Line { slope } => slope * x,
            Self::Step { at, height, side, branches } => on(branches, beyond(at, side).select(T::zero, || height)),
            Self::Ramp { at, slope, side, branches } => on(branches, slope * beyond(at, side).max(T::zero())),
            Self::Sign { at, level, branches } => on(branches, (x - at).select(|| -level, || level)),
            Self::Band { origin, lower, upper, slope } => slope * (x.max(lower).min(upper) - origin),
        }
    }
    fn kernels(&self, _: &Sinusoid<T>, mut report: impl FnMut(Self)) {
        report(*self);
    }
}
