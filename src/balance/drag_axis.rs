//! Harmonic balance of a drag axis under a relay: predictions of the paper's approximation (eqs. 21-34).

use core::f64::consts::PI;

use super::BalanceError;
use crate::describing::{ClosedForm, DescribingFunction};
use crate::nonlinearity::{RelayHysteresis, Sinusoid};
use crate::numeric::scan;
use crate::plant::DragAxis;

/// The sinusoid that balances a drag axis: an approximation of its limit cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisOscillation {
    /// Amplitude X_m of the position.
    pub amplitude: f64,
    /// Mean x_0 of the position, with reference zero.
    pub bias: f64,
    /// Frequency, rad/s.
    pub omega_rad_s: f64,
}

impl AxisOscillation {
    /// Period in seconds.
    #[must_use]
    pub fn period_s(&self) -> f64 {
        2.0 * PI / self.omega_rad_s
    }

    /// The balance `f_R = -P*`, `f_I = -Q*`, `F_0 = delta` (eq. 25 with eq. 34) of `axis` under `relay`, with the smallest
    /// amplitude if there are several.
    ///
    /// Its distance from the exact limit cycle is not bounded here: [`limit_cycle`](crate::orbit::limit_cycle) has that.
    ///
    /// # Errors
    /// [`BalanceError::NoAxisBalance`] where no sinusoid balances: constant forces that reach the relay's level, no drag,
    /// or neither hysteresis nor delay.
    ///
    /// ```
    /// use selfosc::{balance::AxisOscillation, nonlinearity::RelayHysteresis, orbit::limit_cycle, plant::DragAxis};
    /// let (axis, relay) = (DragAxis::linear(1.0, 1.0)?, RelayHysteresis::new(1.0, 0.2, 0.0)?);
    /// let (approximate, exact) = (AxisOscillation::predict(&axis, &relay)?, limit_cycle(&axis, &relay)?);
    /// let error = approximate.amplitude / exact.amplitude - 1.0;
    /// assert!(error.abs() > 1e-3 && error.abs() < 0.1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn predict(axis: &DragAxis<f64>, relay: &RelayHysteresis<f64>) -> Result<Self, BalanceError> {
        let balance = AxisBalance { axis, relay };
        let reach = relay.level() * axis.delay_s() * axis.delay_s() / axis.alpha();
        let least = relay.half_width().max(1e-6 * reach);
        let mut nodes = vec![least];
        while nodes.len() < 1000 && !balance.lag(nodes[nodes.len() - 1]).is_some_and(|lag| lag > 0.0) {
            nodes.push(nodes[nodes.len() - 1] * 1.05);
        }
        let amplitude = scan::roots(&nodes, |amplitude| balance.lag(amplitude)).first().copied();
        amplitude.and_then(|amplitude| balance.at(amplitude)).ok_or(BalanceError::NoAxisBalance {
            linear_drag: axis.linear_drag(),
            quadratic_drag: axis.quadratic_drag(),
            constant_force: axis.disturbance() + relay.offset(),
            level: relay.level(),
            half_width: relay.half_width(),
        })
    }
}

struct AxisBalance<'a> {
    axis: &'a DragAxis<f64>,
    relay: &'a RelayHysteresis<f64>,
}

impl AxisBalance<'_> {
    /// Mean of the relay's input and gain at an amplitude: the mean output cancels the disturbance.
    fn relay(&self, amplitude: f64) -> Option<(f64, DescribingFunction<f64>)> {
        let at = |bias| self.relay.describing_function(&Sinusoid::new(bias, amplitude).ok()?).ok();
        let mean = |bias| at(bias).map(|df| df.f0 + self.axis.disturbance());
        let limit = (amplitude - self.relay.half_width()) * (1.0 - 4.0 * f64::EPSILON);
        let bias = if mean(0.0) == Some(0.0) { 0.0 } else { scan::bracketed(mean, -limit, limit)? };
        Some((bias, at(bias)?))
    }

    /// Inertia and drag over the amplitude, `-f_R` and `f_I`, at a frequency.
    fn resistance(&self, amplitude: f64, omega: f64) -> (f64, f64) {
        let per_speed = self.axis.linear_drag() + 8.0 / (3.0 * PI) * self.axis.quadratic_drag() * amplitude * omega;
        (self.axis.alpha() * omega * omega, per_speed * omega)
    }

    /// The frequency at which the axis resists as strongly as the relay drives.
    fn omega(&self, amplitude: f64, gain: f64) -> Option<f64> {
        let most = (gain / self.axis.alpha()).sqrt();
        let excess = |omega: f64| {
            let (inertia, drag) = self.resistance(amplitude, omega);
            Some(libm::hypot(inertia, drag) / gain - 1.0)
        };
        scan::bracketed(excess, most * 1e-12, most * (1.0 + 1e-9))
    }

    fn at(&self, amplitude: f64) -> Option<AxisOscillation> {
        let (input_bias, df) = self.relay(amplitude)?;
        let omega_rad_s = self.omega(amplitude, libm::hypot(df.p, df.q))?;
        Some(AxisOscillation { amplitude, bias: -input_bias, omega_rad_s })
    }

    /// Angle by which the axis lags beyond the phase of relay and delay, in radians: zero at balance.
    fn lag(&self, amplitude: f64) -> Option<f64> {
        let (_, df) = self.relay(amplitude)?;
        let omega = self.omega(amplitude, libm::hypot(df.p, df.q))?;
        let (inertia, drag) = self.resistance(amplitude, omega);
        Some(libm::atan2(drag, inertia) - omega * self.axis.delay_s() + libm::atan2(df.q, df.p))
    }
}
