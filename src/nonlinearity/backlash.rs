use super::parameter::characteristic;
use super::{Branch, Branches, Kernel, NonlinearityError, PiecewiseLinear, Side, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Backlash, friction-controlled: the output follows the input at `half_gap` behind and stays where it is while the
    /// input crosses the gap.
    ///
    /// An input whose amplitude is below the half-gap does not move the output: that has no periodic output to speak of.
    "backlash" Backlash {
        /// Slope while engaged, output units per input unit.
        slope: Finite = 1.0,
        /// Half the gap, in input units.
        half_gap: NonNegative,
    }
}

impl<T: Real> PiecewiseLinear for Backlash<T> {
    type Number = T;

    fn value(&self, x: T, branch: Branch, sweep: &Sinusoid<T>) -> T {
        self.slope
            * match branch {
                Branch::Rising => (x - self.half_gap).max(sweep.minimum() + self.half_gap),
                Branch::Falling => (x + self.half_gap).min(sweep.maximum() - self.half_gap),
            }
    }

    /// The straight line, minus the half-gap on one branch and plus the half-gap on the other, corrected where the gap is being crossed.
    fn kernels(&self, sweep: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        let (gap, lag) = (T::two() * self.half_gap, self.slope * self.half_gap);
        report(Kernel::Line { slope: self.slope });
        report(Kernel::Constant { value: -lag, branches: Branches::Rising });
        report(Kernel::Constant { value: lag, branches: Branches::Falling });
        let mut crossing = |at, slope, side, branches| report(Kernel::Ramp { at, slope, side, branches });
        crossing(sweep.minimum() + gap, self.slope, Side::Below, Branches::Rising);
        crossing(sweep.maximum() - gap, -self.slope, Side::Above, Branches::Falling);
    }

    fn periodic(&self, sweep: &Sinusoid<T>) -> Result<(), NonlinearityError> {
        if sweep.amplitude().bounds().0 >= self.half_gap.bounds().1 {
            return Ok(());
        }
        Err(NonlinearityError::BelowSwitching {
            characteristic: "backlash",
            amplitude: sweep.amplitude().bounds().0,
            bias: sweep.bias().bounds().0,
            required: self.half_gap.bounds().1,
        })
    }
}
