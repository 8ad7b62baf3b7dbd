//! A first-order process with dead time, and gains for it by a rule of bounded sensitivity.

use crate::control::{ControlError, Gains, Structure};
use crate::numeric::{Real, Scalar};

/// Derivative time over the time constant of its filter.
const FILTER: f64 = 10.0;

/// `drag y' + stiffness y = u(t - dead_time_s) + load`: a first-order process of gain `1/stiffness` and time constant
/// `drag/stiffness`, or an integrator of gain `1/drag` where `stiffness` is 0.
///
/// ```
/// use selfosc::autotune::FirstOrderProcess;
/// // A heater of 180 K at full power with 110 s and a dead time of 7 s.
/// let heater = FirstOrderProcess::<f64> { drag: 110.0 / 180.0, stiffness: 1.0 / 180.0, dead_time_s: 7.0, reverse: false };
/// let gains = heater.gains(0.5)?;
/// assert!((gains.proportional() - 0.039).abs() < 0.001);
/// # Ok::<(), selfosc::control::ControlError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstOrderProcess<T> {
    /// Time constant over gain, command s/output, above 0.
    pub drag: T,
    /// Inverse of the gain, command/output, 0 or more.
    pub stiffness: T,
    /// Dead time, s, 0 or more.
    pub dead_time_s: T,
    /// Whether the output falls with the command: `drag` and `stiffness` are those of the command with its sign turned.
    pub reverse: bool,
}

impl<T: Real> FirstOrderProcess<T> {
    /// Gain, integral time and derivative time by the rule AMIGO of Astrom and Hagglund (J. Process Control 14, 2004), under a controller
    /// that holds its command for `held_s`: half of that adds to the dead time `L`.
    ///
    /// With `K = 1/stiffness` and `T = drag/stiffness` the formulas are `K k = 0.2 + 0.45 T/L`, `Ti = (0.4 L + 0.8 T) L/(L + 0.1 T)`
    /// and `Td = 0.5 L T/(0.3 L + T)`; here `stiffness` multiplies numerators and denominators, and they hold for the integrator too.
    /// With the derivative filtered at `Td/10` the largest sensitivity is at most 1.5 for every process of this structure: the tests
    /// prove it in intervals.
    pub fn amigo(&self, held_s: T) -> [T; 3] {
        let Self { drag, stiffness, dead_time_s, .. } = *self;
        let number = T::from_f64;
        let late_s = dead_time_s + held_s / T::two();
        let level = stiffness * late_s;
        [
            (number(0.2) * level + number(0.45) * drag) / late_s,
            (number(0.4) * level + number(0.8) * drag) * late_s / (level + number(0.1) * drag),
            number(0.5) * late_s * drag / (number(0.3) * level + drag),
        ]
    }
}

impl<T: Scalar> FirstOrderProcess<T> {
    /// PID gains by [`amigo`](Self::amigo): largest sensitivity at most 1.5. For a process of another structure nothing is proved. A
    /// reverse process takes them with all signs turned.
    ///
    /// # Errors
    /// [`ControlError`] where the numbers are no process, such as one without dead time under a command that is never held.
    pub fn gains(&self, held_s: T) -> Result<Gains<T>, ControlError> {
        let [gain, integral_s, derivative_s] = self.amigo(held_s);
        let filter_s = derivative_s / T::from_f64(FILTER);
        Gains::new(Structure::Pid, gain, gain / integral_s, gain * derivative_s, filter_s)
    }
}
