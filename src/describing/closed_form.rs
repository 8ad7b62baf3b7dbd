//! Describing functions in closed form.

use super::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Affine, Characteristic, PiecewiseLinear, Sinusoid, Sum};
use crate::numeric::Real;

/// A characteristic whose describing function is known in closed form.
pub trait ClosedForm: Characteristic {
    /// `F_0`, `P`, `Q` on the input `sweep` (eqs. 13-15; eqs. 30-32 for a relay with hysteresis). Exact for the
    /// one-tone input; does not say how far a loop's oscillation is from one tone.
    ///
    /// # Errors
    /// [`DescribingError::Nonlinearity`] below the switching amplitude; [`DescribingError::NotFinite`] where it overflows.
    ///
    /// ```
    /// use selfosc::describing::ClosedForm;
    /// use selfosc::nonlinearity::{RelayHysteresis, Sinusoid};
    /// let relay = RelayHysteresis::new(1.0, 0.5, 0.0)?;
    /// let df = relay.describing_function(&Sinusoid::new(0.0, 1.0)?)?;
    /// assert!((df.q + 2.0 / core::f64::consts::PI).abs() < 1e-15);
    /// // Half the half-width does not switch it:
    /// assert!(relay.describing_function(&Sinusoid::new(0.0, 0.25)?).is_err());
    /// # Ok::<(), selfosc::describing::DescribingError>(())
    /// ```
    fn describing_function(
        &self,
        sweep: &Sinusoid<Self::Number>,
    ) -> Result<DescribingFunction<Self::Number>, DescribingError>;
}

impl<C: PiecewiseLinear> ClosedForm for C {
    fn describing_function(
        &self,
        sweep: &Sinusoid<C::Number>,
    ) -> Result<DescribingFunction<C::Number>, DescribingError> {
        self.periodic(sweep)?;
        finite(over_kernels(self, sweep), sweep)
    }
}

/// The sum over the kernels, whatever comes out.
#[inline(always)]
pub(super) fn over_kernels<C: PiecewiseLinear>(
    characteristic: &C,
    sweep: &Sinusoid<C::Number>,
) -> DescribingFunction<C::Number> {
    let mut sum = DescribingFunction::zero();
    characteristic.kernels(
        sweep,
        #[inline(always)]
        |kernel| sum = sum + DescribingFunction::of(kernel, sweep),
    );
    sum
}

impl<T: Real, A: ClosedForm<Number = T>, B: ClosedForm<Number = T>> ClosedForm for Sum<A, B> {
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        finite(self.0.describing_function(sweep)? + self.1.describing_function(sweep)?, sweep)
    }
}

impl<T: Real, C: ClosedForm<Number = T>> ClosedForm for Affine<T, C> {
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let inner = self.inner().describing_function(&self.inner_sweep(sweep)?)?;
        let (input_gain, output_gain, output_offset) = self.gains();
        let gain = output_gain * input_gain;
        let f0 = output_gain * inner.f0 + output_offset;
        finite(DescribingFunction { f0, p: gain * inner.p, q: gain * inner.q }, sweep)
    }
}

/// The describing functions at a bias and several amplitudes, in turn; nothing is allocated.
///
/// ```
/// use selfosc::describing::over_amplitudes;
/// use selfosc::nonlinearity::Tanh;
/// let tanh = Tanh::new(1.0, 1.0)?;
/// let mut gains = over_amplitudes(&tanh, 0.0, [0.5, 1.0, 2.0]).map(|df| df.map(|df| df.p));
/// assert!(gains.all(|gain| gain.is_ok_and(|gain| gain < 1.0)));
/// # Ok::<(), selfosc::describing::DescribingError>(())
/// ```
pub fn over_amplitudes<C: ClosedForm + ?Sized>(
    characteristic: &C,
    bias: C::Number,
    amplitudes: impl IntoIterator<Item = C::Number>,
) -> impl Iterator<Item = Result<DescribingFunction<C::Number>, DescribingError>> {
    amplitudes.into_iter().map(move |amplitude| characteristic.describing_function(&Sinusoid::new(bias, amplitude)?))
}

/// The describing function, unless a number in it overflowed or is none. An unbounded interval is neither.
#[inline]
pub(super) fn finite<T: Real>(
    df: DescribingFunction<T>,
    sweep: &Sinusoid<T>,
) -> Result<DescribingFunction<T>, DescribingError> {
    let undefined = |part: &T| {
        let (low, high) = part.bounds();
        !low.is_finite() && !(low < high)
    };
    match [df.f0, df.p, df.q].into_iter().find(undefined) {
        None => Ok(df),
        Some(output) => Err(not_finite(output, sweep)),
    }
}

#[cold]
#[inline(never)]
fn not_finite<T: Real>(output: T, sweep: &Sinusoid<T>) -> DescribingError {
    let input = if sweep.bias().bounds().0 < 0.0 { sweep.minimum() } else { sweep.maximum() };
    DescribingError::NotFinite { input: input.bounds().0, output: output.bounds().0 }
}
