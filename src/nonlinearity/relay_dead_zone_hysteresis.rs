use super::parameter::characteristic;
use super::{Branch, Branches, Kernel, PiecewiseLinear, Side, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Three-position relay with hysteresis: the output goes to `level` when the input rises past `on` and back to zero
    /// when it falls past `off`; to `-level` and back likewise on the negative side. A side that the sweep does not switch
    /// on stays off.
    "relay-dead-zone-hysteresis" RelayDeadZoneHysteresis {
        /// Output level C, in output units.
        level: Positive = 1.0,
        /// Input magnitude at which a side switches on, in input units.
        on: Positive,
        /// Input magnitude, below `on`, at which a side switches off, in input units.
        off: NonNegative,
    }
    where off < on
}

impl<T: Real> RelayDeadZoneHysteresis<T> {
    /// The level of the positive and of the negative side on this sweep: zero where a side is never switched on.
    fn reached(&self, sweep: &Sinusoid<T>) -> (T, T) {
        let level_if = |excess: T| excess.select(T::zero, || self.level);
        (level_if(sweep.maximum() - self.on), level_if(-self.on - sweep.minimum()))
    }
}

impl<T: Real> PiecewiseLinear for RelayDeadZoneHysteresis<T> {
    type Number = T;

    fn value(&self, x: T, branch: Branch, sweep: &Sinusoid<T>) -> T {
        let (positive, negative) = self.reached(sweep);
        let (upper, lower) = match branch {
            Branch::Rising => (self.on, -self.off),
            Branch::Falling => (self.off, -self.on),
        };
        (x - upper).select(T::zero, || positive) - (x - lower).select(|| negative, T::zero)
    }

    fn kernels(&self, sweep: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        let (positive, negative) = self.reached(sweep);
        let mut step = |at, height, side, branches| report(Kernel::Step { at, height, side, branches });
        step(self.on, positive, Side::Above, Branches::Rising);
        step(self.off, positive, Side::Above, Branches::Falling);
        step(-self.off, -negative, Side::Below, Branches::Rising);
        step(-self.on, -negative, Side::Below, Branches::Falling);
    }
}
