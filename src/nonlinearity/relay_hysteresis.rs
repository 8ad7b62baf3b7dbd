use super::parameter::characteristic;
use super::{Branch, Branches, Kernel, NonlinearityError, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Two-position relay with hysteresis (the paper's Fig. 5): the output becomes `offset + level` when the input rises
    /// past `half_width` and `offset - level` when it falls past `-half_width`.
    ///
    /// It oscillates only where the sweep passes both levels: `amplitude >= half_width + abs(bias)`, condition 40.
    ///
    /// ```
    /// use selfosc::nonlinearity::RelayHysteresis;
    /// let relay = RelayHysteresis::new(1.0, 0.2, 0.0)?;
    /// assert_eq!(relay.half_width(), 0.2);
    /// # Ok::<(), selfosc::nonlinearity::NonlinearityError>(())
    /// ```
    "relay-hysteresis" RelayHysteresis {
        /// Output level C, in output units.
        level: Positive = 1.0,
        /// Input level x_a at which it switches, in input units.
        half_width: NonNegative,
        /// Constant d added to both output levels, in output units.
        offset: Finite = 0.0,
    }
}

impl<T: Real> RelayHysteresis<T> {
    /// The inputs at which it switches up and down.
    pub(crate) fn switching_levels(&self) -> [T; 2] {
        [self.half_width, -self.half_width]
    }

    /// The least amplitude that switches both ways, with a bias (condition 40).
    pub(crate) fn least_amplitude(&self, bias: T) -> T {
        self.half_width + bias.abs()
    }
}

impl<T: Real> PiecewiseLinear for RelayHysteresis<T> {
    type Number = T;

    fn value(&self, x: T, branch: Branch, _: &Sinusoid<T>) -> T {
        let [rising, falling] = self.switching_levels();
        let threshold = match branch {
            Branch::Rising => rising,
            Branch::Falling => falling,
        };
        self.offset + (x - threshold).select(|| -self.level, || self.level)
    }

    fn kernels(&self, _: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        report(Kernel::constant(self.offset));
        report(Kernel::Sign { at: self.half_width, level: self.level, branches: Branches::Rising });
        report(Kernel::Sign { at: -self.half_width, level: self.level, branches: Branches::Falling });
    }

    fn periodic(&self, sweep: &Sinusoid<T>) -> Result<(), NonlinearityError> {
        let required = self.least_amplitude(sweep.bias());
        if sweep.amplitude().bounds().0 >= required.bounds().1 {
            return Ok(());
        }
        Err(NonlinearityError::BelowSwitching {
            characteristic: "relay-hysteresis",
            amplitude: sweep.amplitude().bounds().0,
            bias: sweep.bias().bounds().0,
            required: required.bounds().1,
        })
    }
}
