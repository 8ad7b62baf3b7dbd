//! Describing functions in closed form.

use super::harmonics::Harmonics;
use super::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Affine, Characteristic, PiecewiseLinear, Sinusoid, Sum};
use crate::numeric::Real;

/// A characteristic whose describing function is known in closed form.
pub trait ClosedForm: Characteristic {
    /// `F_0`, `P`, `Q` on the input `sweep` (eqs. 13-15; eqs. 30-32 for a relay with hysteresis). Exact for the
    /// one-tone input; does not say how far a loop's oscillation is from one tone.
    ///
    /// # Errors
    /// [`DescribingError::Nonlinearity`] below the switching amplitude; [`DescribingError::NoClosedForm`] where none is
    /// known.
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
        let mut sum = Harmonics::zero();
        self.kernels(sweep, &mut |kernel| sum = sum + Harmonics::of(kernel, sweep));
        let amplitude = sweep.amplitude();
        Ok(DescribingFunction { f0: sum.mean, p: sum.sine / amplitude, q: sum.cosine / amplitude })
    }
}

impl<T: Real, A: ClosedForm<Number = T>, B: ClosedForm<Number = T>> ClosedForm for Sum<A, B> {
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let (a, b) = (self.0.describing_function(sweep)?, self.1.describing_function(sweep)?);
        Ok(DescribingFunction { f0: a.f0 + b.f0, p: a.p + b.p, q: a.q + b.q })
    }
}

impl<T: Real, C: ClosedForm<Number = T>> ClosedForm for Affine<T, C> {
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let inner = self.inner().describing_function(&self.inner_sweep(sweep)?)?;
        let (input_gain, output_gain, output_offset) = self.gains();
        let gain = output_gain * input_gain;
        Ok(DescribingFunction { f0: output_gain * inner.f0 + output_offset, p: gain * inner.p, q: gain * inner.q })
    }
}

/// The describing functions at one bias and many amplitudes, one after the other; nothing is allocated.
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

/// The describing function, unless a number in it overflowed or is none.
pub(super) fn finite<T: Real>(
    df: DescribingFunction<T>,
    sweep: &Sinusoid<T>,
) -> Result<DescribingFunction<T>, DescribingError> {
    let fault = [df.f0, df.p, df.q].into_iter().map(|part| part.bounds()).find(|(low, high)| !(high - low).is_finite());
    match fault {
        None => Ok(df),
        Some((output, _)) => {
            let input = if sweep.bias().bounds().0 < 0.0 { sweep.minimum() } else { sweep.maximum() };
            Err(DescribingError::NotFinite { input: input.bounds().0, output })
        }
    }
}
