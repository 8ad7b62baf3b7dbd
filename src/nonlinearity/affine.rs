//! A characteristic between linear gains and offsets.

use super::{Branch, Characteristic, NonlinearityError, Sinusoid};
use crate::numeric::{Limit, Real, domain};

/// `output_gain F(input_gain x + input_offset) + output_offset`, F being another characteristic: it scaled, in series with
/// a linear gain, or moved.
///
/// ```
/// use selfosc::describing::ClosedForm;
/// use selfosc::nonlinearity::{Affine, Relay, Sinusoid};
/// let relay = Affine::of(Relay::new(1.0f64)?).scaled(3.0).offset(0.5);
/// let df = relay.describing_function(&Sinusoid::new(0.0, 1.0)?)?;
/// assert!((df.f0 - 0.5).abs() < 1e-15);
/// assert!((df.p - 12.0 / core::f64::consts::PI).abs() < 1e-14);
/// # Ok::<(), selfosc::describing::DescribingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine<T, C> {
    inner: C,
    input_gain: T,
    input_offset: T,
    output_gain: T,
    output_offset: T,
}

impl<T: Real, C: Characteristic<Number = T>> Affine<T, C> {
    /// The characteristic as it is.
    pub fn of(inner: C) -> Self {
        let (zero, one) = (T::zero(), T::one());
        Self { inner, input_gain: one, input_offset: zero, output_gain: one, output_offset: zero }
    }
    /// Its output times `gain`.
    #[must_use]
    pub fn scaled(self, gain: T) -> Self {
        Self { output_gain: self.output_gain * gain, output_offset: self.output_offset * gain, ..self }
    }
    /// Its output plus `constant`, in output units.
    #[must_use]
    pub fn offset(self, constant: T) -> Self {
        Self { output_offset: self.output_offset + constant, ..self }
    }
    /// Its input plus `constant`, in input units.
    #[must_use]
    pub fn shifted(self, constant: T) -> Self {
        Self { input_offset: self.input_offset + self.input_gain * constant, ..self }
    }
    /// Behind a linear gain: its input times `gain`.
    ///
    /// # Errors
    /// [`NonlinearityError::Parameter`] where the gain is zero or not finite.
    pub fn after_gain(self, gain: T) -> Result<Self, NonlinearityError> {
        domain::require("gain", gain, "", Limit::NonZero, "give the gain in front of the characteristic")
            .map_err(|fault| NonlinearityError::Parameter { characteristic: "series connection", fault })?;
        Ok(Self { input_gain: self.input_gain * gain, ..self })
    }

    /// The characteristic inside.
    pub fn inner(&self) -> &C {
        &self.inner
    }
    /// What the characteristic inside sees of a sweep; a negative gain mirrors it about its bias.
    ///
    /// # Errors
    /// [`NonlinearityError::OutOfDomain`] where the product overflows or underflows.
    pub fn inner_sweep(&self, sweep: &Sinusoid<T>) -> Result<Sinusoid<T>, NonlinearityError> {
        Sinusoid::new(self.inner_input(sweep.bias()), sweep.amplitude() * self.input_gain.abs())
    }
    /// `(input gain, output gain, output offset)`.
    pub fn gains(&self) -> (T, T, T) {
        (self.input_gain, self.output_gain, self.output_offset)
    }

    fn inner_input(&self, x: T) -> T {
        self.input_gain * x + self.input_offset
    }
}

impl<T: Real, C: Characteristic<Number = T>> Characteristic for Affine<T, C> {
    type Number = T;

    fn output(&self, x: T, branch: Branch, sweep: &Sinusoid<T>) -> T {
        let branch = match branch {
            _ if self.input_gain.bounds().0 > 0.0 => branch,
            Branch::Rising => Branch::Falling,
            Branch::Falling => Branch::Rising,
        };
        let Ok(inner) = self.inner_sweep(sweep) else { return T::from_f64(f64::NAN) };
        self.output_gain * self.inner.output(self.inner_input(x), branch, &inner) + self.output_offset
    }
    fn has_memory(&self) -> bool {
        self.inner.has_memory()
    }
    fn kinks(&self, sweep: &Sinusoid<T>, report: &mut dyn FnMut(T)) {
        if let Ok(inner) = self.inner_sweep(sweep) {
            self.inner.kinks(&inner, &mut |kink| report((kink - self.input_offset) / self.input_gain));
        }
    }
    fn admits(&self, sweep: &Sinusoid<T>) -> Result<(), NonlinearityError> {
        self.inner.admits(&self.inner_sweep(sweep)?)
    }
}
