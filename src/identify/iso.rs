//! The paper's method: parameters from the first harmonic of one oscillation (eqs. 26-34, Table 3, the procedure).
//!
//! It takes the oscillation for a sinusoid. The error that this makes depends on the plant and is not in the result; the
//! exact orbits give it.

use super::answer::{IdentifyError, READ_AGAIN};
use crate::describing::{ClosedForm, DescribingFunction};
use crate::features::Features;
use crate::nonlinearity::{RelayHysteresis, Sinusoid};
use crate::numeric::{Limit, Real, Scalar, domain};

/// What the method reads off a record: means over its cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct Oscillation<T> {
    /// Relay level C, in units of the command.
    pub relay_level: T,
    /// Level x_a* at which the command really switched, in units of the output: in discrete time beyond the preset one.
    pub switch_level: T,
    /// Amplitude X_m, in units of the output.
    pub amplitude: T,
    /// Bias x_0, in units of the output.
    pub bias: T,
    /// Period T in seconds.
    pub period_s: T,
    /// Delay of the whole loop in seconds.
    pub delay_s: T,
}

/// Parameters of one axis under each drag law. The output in radians gives SI units of moment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct Parameters<T> {
    /// Inertia with added mass, command units per output unit per second squared; the same under either law.
    pub alpha: T,
    /// Linear drag, command units per output unit per second.
    pub beta: T,
    /// Quadratic drag, command units per (output unit per second) squared.
    pub beta_quadratic: T,
    /// Disturbance by the one-tone input's own mean output, in command units.
    pub disturbance: T,
}

impl<S: Scalar> Oscillation<S> {
    /// The means over steady cycles (steps 1 to 3 of the paper's procedure), with the level of the relay and the delay of the
    /// loop, which a record alone does not show. Condition 40 (step 4) is checked when parameters are asked for (step 5).
    ///
    /// ```
    /// use selfosc::experiment::SimulatedExperiment;
    /// use selfosc::features::RecordFeatures;
    /// use selfosc::identify::iso::Oscillation;
    /// use selfosc::{nonlinearity::RelayHysteresis, plant::DragAxis};
    /// let axis = DragAxis::quadratic(1.0, 0.5)?;
    /// let record = SimulatedExperiment::new(axis, RelayHysteresis::new(1.0, 0.3, 0.0)?, 100.0)?.run(60.0)?;
    /// let found = RecordFeatures::of(&record)?;
    /// let parameters = Oscillation::of(&found.features, found.relay.level, 0.0).identify()?;
    /// assert!((parameters.alpha - 1.0).abs() < 0.05);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn of(features: &Features<S>, relay_level: S, delay_s: S) -> Self {
        Self {
            relay_level,
            switch_level: features.switch_level.mean,
            amplitude: features.amplitude.mean,
            bias: features.bias.mean,
            period_s: features.period_s.mean,
            delay_s,
        }
    }
}

impl<T: Real> Oscillation<T> {
    /// Angular frequency `w = 2 pi / T` in rad/s.
    pub fn omega_rad_s(&self) -> T {
        T::two() * T::pi() / self.period_s
    }

    /// Describing function of the relay at this oscillation (eqs. 30-32), turned by the delay (eq. 34).
    ///
    /// # Errors
    /// [`IdentifyError::Describing`] where condition 40 is not met: repeat the experiment with a smaller half-width or a
    /// higher level. [`IdentifyError::OutOfDomain`] where period or delay is not a number of the right kind.
    pub fn describing_function(&self) -> Result<DescribingFunction<T>, IdentifyError> {
        domain::require("period", self.period_s, "s", Limit::Positive, READ_AGAIN)?;
        domain::non_negative("delay", self.delay_s, "s")?;
        let relay = RelayHysteresis::new(self.relay_level, self.switch_level, T::zero())?;
        let sweep = Sinusoid::new(self.bias, self.amplitude)?;
        let df = relay.describing_function(&sweep)?.delayed(self.omega_rad_s() * self.delay_s);
        let sound = |part| domain::representable("describing function with the delay", part, "");
        [df.f0, df.p, df.q].into_iter().try_for_each(|part| sound(part).map(drop))?;
        Ok(df)
    }

    /// Parameters under each drag law (Table 3 with eq. 34): step 5 of the paper's procedure, after condition 40.
    ///
    /// # Errors
    /// As [`describing_function`](Self::describing_function); [`IdentifyError::Unphysical`] where inertia or drag comes out
    /// negative, as with a delay that is a large part of the period; [`IdentifyError::OutOfDomain`] too for a parameter that the
    /// arithmetic cannot represent.
    ///
    /// Rounding: for all floats with levels 0.5 to 2, switching levels 0.25 to 0.5, amplitudes and periods 1 to 4, biases to a quarter either
    /// way and delays up to a quarter, each parameter is within 1e-14 in f64 and 5e-6 in f32 of its exact value.
    ///
    /// ```
    /// use selfosc::identify::iso::Oscillation;
    /// // Row 7 of Table 4, in its own units: degrees and 1e-2 N m.
    /// let row = Oscillation {
    ///     relay_level: 8.23f64, switch_level: 6.58, amplitude: 26.36, bias: 3.8, period_s: 2.69, delay_s: 0.2,
    /// };
    /// let parameters = row.identify()?;
    /// assert!((parameters.beta * 100.0 - 11.11).abs() < 0.02);
    /// assert!((parameters.beta_quadratic * 1000.0 - 2.12).abs() < 0.01);
    /// # Ok::<(), selfosc::identify::IdentifyError>(())
    /// ```
    pub fn identify(&self) -> Result<Parameters<T>, IdentifyError> {
        let found = parameters(self.describing_function()?, self.amplitude, self.omega_rad_s());
        for (parameter, value) in [
            ("inertia", found.alpha),
            ("linear drag", found.beta),
            ("quadratic drag", found.beta_quadratic),
            ("disturbance", found.disturbance),
        ] {
            domain::representable(parameter, value, "")?;
        }
        for (parameter, value) in [("inertia", found.alpha), ("drag", found.beta)] {
            if value.bounds().1 <= 0.0 {
                let (value, delay_s) = (value.bounds().1, self.delay_s.bounds().1);
                let period_s = self.period_s.bounds().0;
                return Err(IdentifyError::Unphysical { parameter, value, delay_s, period_s });
            }
        }
        Ok(found)
    }
}

/// Eqs. 27 and 29: parameters from a (delay-corrected) describing function, an amplitude and an angular frequency.
pub fn parameters<T: Real>(df: DescribingFunction<T>, amplitude: T, omega_rad_s: T) -> Parameters<T> {
    let square = omega_rad_s.square();
    let sine_abs_sine = T::from_f64(8.0) / (T::from_f64(3.0) * T::pi());
    Parameters {
        alpha: df.p / square,
        beta: -df.q / omega_rad_s,
        beta_quadratic: -df.q / (sine_abs_sine * amplitude * square),
        disturbance: df.f0,
    }
}

/// Disturbance `delta = -C (t_plus - t_minus)/T` from the times per period at command `+C` and `-C` (eq. 32 in this
/// project's signs), in command units. Exact for any waveform when drag is linear; not so when it is quadratic.
pub(crate) fn disturbance_from_times<T: Real>(relay_level: T, time_positive_s: T, time_negative_s: T) -> T {
    -crate::describing::bias_of_output(relay_level, time_positive_s, time_negative_s)
}

/// Relative errors of the parameters per relative error of the amplitude (eqs. 37-39), for an unbiased oscillation without
/// delay.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct AmplitudeSensitivity<T> {
    /// `(2 - r^2)/(r^2 - 1)` with `r = X_m/x_a` (eq. 37): zero at `r = sqrt(2)`, without bound as `r` falls to 1.
    pub alpha: T,
    /// -2 (eq. 38).
    pub beta: T,
    /// -3 (eq. 39).
    pub beta_quadratic: T,
}

/// Eqs. 37-39 at `amplitude_ratio = X_m/x_a`, which must be above 1.
///
/// ```
/// use selfosc::identify::iso::amplitude_sensitivity;
/// assert!(amplitude_sensitivity(2f64.sqrt()).alpha.abs() < 1e-15);
/// ```
pub fn amplitude_sensitivity<T: Real>(amplitude_ratio: T) -> AmplitudeSensitivity<T> {
    let square = amplitude_ratio.square();
    AmplitudeSensitivity {
        alpha: (T::two() - square) / (square - T::one()),
        beta: T::from_f64(-2.0),
        beta_quadratic: T::from_f64(-3.0),
    }
}
