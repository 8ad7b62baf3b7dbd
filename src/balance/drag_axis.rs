//! Harmonic balance of a drag axis under a relay: predictions of the paper's approximation (eqs. 21-34).

use core::f64::consts::PI;

use super::BalanceError;
use crate::describing::ClosedForm;
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
        let balanced = |amplitude: f64| at_amplitude(axis, relay, amplitude);
        let lag = |amplitude: f64| Some(balanced(amplitude)?.1);
        let reach = relay.level() * axis.delay_s() * axis.delay_s() / axis.alpha();
        let least = relay.half_width().max(1e-6 * reach);
        let mut nodes = vec![least];
        while nodes.len() < 1000 && !lag(nodes[nodes.len() - 1]).is_some_and(|lag| lag > 0.0) {
            nodes.push(nodes[nodes.len() - 1] * 1.05);
        }
        let amplitude = scan::roots(&nodes, &mut |amplitude| lag(amplitude)).first().copied();
        let found = amplitude.and_then(balanced).ok_or(BalanceError::NoAxisBalance {
            linear_drag: axis.linear_drag(),
            quadratic_drag: axis.quadratic_drag(),
            constant_force: axis.disturbance() + relay.offset(),
            level: relay.level(),
            half_width: relay.half_width(),
        })?;
        Ok(found.0)
    }
}

/// The sinusoid whose mean relay output cancels the disturbance and at whose frequency the axis resists as strongly as the relay drives;
/// and the angle, rad, by which the axis lags beyond the phase of relay and delay: zero at balance.
fn at_amplitude(axis: &DragAxis<f64>, relay: &RelayHysteresis<f64>, amplitude: f64) -> Option<(AxisOscillation, f64)> {
    let output = |bias| relay.describing_function(&Sinusoid::new(bias, amplitude).ok()?).ok();
    let mean = |bias| output(bias).map(|df| df.f0 + axis.disturbance());
    let limit = (amplitude - relay.half_width()) * (1.0 - 4.0 * f64::EPSILON);
    let balanced = mean(0.0).is_some_and(|mean| mean.abs() <= f64::EPSILON * relay.level());
    let bias = if balanced { 0.0 } else { scan::bracketed(&mut |bias| mean(bias), -limit, limit)? };
    let df = output(bias)?;
    let drive = libm::hypot(df.p, df.q);
    // Inertia and drag over the amplitude, -f_R and f_I.
    let resistance = |omega: f64| {
        let per_speed = axis.linear_drag() + 8.0 / (3.0 * PI) * axis.quadratic_drag() * amplitude * omega;
        (axis.alpha() * omega * omega, per_speed * omega)
    };
    let mut excess = |omega: f64| {
        let (inertia, drag) = resistance(omega);
        Some(libm::hypot(inertia, drag) / drive - 1.0)
    };
    let most = (drive / axis.alpha()).sqrt();
    let omega_rad_s = scan::bracketed(&mut excess, most * 1e-12, most * (1.0 + 1e-9))?;
    let (inertia, drag) = resistance(omega_rad_s);
    let lag = libm::atan2(drag, inertia) - omega_rad_s * axis.delay_s() + libm::atan2(df.q, df.p);
    Some((AxisOscillation { amplitude, bias: -bias, omega_rad_s }, lag))
}
