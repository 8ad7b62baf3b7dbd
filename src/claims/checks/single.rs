//! A characteristic made of a single kernel, for the claims and proofs of kernels.

use crate::nonlinearity::{Branch, Branches, Kernel, PiecewiseLinear, Side, Sinusoid};
use crate::numeric::Real;

/// A kernel, by itself a characteristic; only its values are written here.
#[derive(Debug)]
pub struct SingleKernel<T>(pub Kernel<T>);

impl<T: Real> PiecewiseLinear for SingleKernel<T> {
    type Number = T;

    fn value(&self, x: T, branch: Branch, _: &Sinusoid<T>) -> T {
        let beyond = |at: T, side| if side == Side::Above { x - at } else { at - x };
        let on = |branches, value: T| match (branches, branch) {
            (Branches::Rising, Branch::Falling) | (Branches::Falling, Branch::Rising) => T::zero(),
            _ => value,
        };
        match self.0 {
            Kernel::Constant { value, branches } => on(branches, value),
            Kernel::Line { slope } => slope * x,
            Kernel::Step { at, height, side, branches } => on(branches, beyond(at, side).select(T::zero, || height)),
            Kernel::Ramp { at, slope, side, branches } => on(branches, slope * beyond(at, side).max(T::zero())),
            Kernel::Sign { at, level, branches } => on(branches, (x - at).select(|| -level, || level)),
            Kernel::Band { origin, lower, upper, slope } => slope * (x.max(lower).min(upper) - origin),
        }
    }
    fn kernels(&self, _: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        report(self.0);
    }
}
