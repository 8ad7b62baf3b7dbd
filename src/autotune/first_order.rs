//! A first-order process with dead time, and gains for it by a rule of bounded sensitivity.

use crate::control::{ControlError, Gains, Structure};
#[cfg(feature = "std")]
use crate::numeric::domain;
use crate::numeric::{Real, Scalar};
#[cfg(feature = "std")]
use crate::orbit::{OrbitError, TwoLevelRelay};

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

/// An oscillation under a two-level relay with one switching each way.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelayCycle {
    /// Time per period with the upper command, s.
    pub time_high_s: f64,
    /// Time per period with the lower command, s.
    pub time_low_s: f64,
    /// The least output.
    pub minimum: f64,
    /// The largest output.
    pub maximum: f64,
}

#[cfg(feature = "std")]
impl FirstOrderProcess<f64> {
    /// The oscillation that follows once a command has stood for a dead time before the output passes its level (claim
    /// `relay-first-order`), under a constant load at the input. A reverse process is taken with its command's sign turned.
    ///
    /// With a dead time the loop has faster oscillations besides: [`orbits`](crate::orbit::orbits) lists them.
    ///
    /// ```
    /// use selfosc::{autotune::FirstOrderProcess, orbit::TwoLevelRelay};
    /// // exp(-s)/s under an ideal relay: a triangle of period 4 s and amplitude 1.
    /// let process = FirstOrderProcess { drag: 1.0, stiffness: 0.0, dead_time_s: 1.0, reverse: false };
    /// let cycle = process.relay_cycle(&TwoLevelRelay::new(1.0, -1.0, 0.0)?, 0.0)?;
    /// assert_eq!((cycle.time_high_s, cycle.time_low_s, cycle.maximum), (2.0, 2.0, 1.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`OrbitError::LevelNotPassed`] where the output settles before a level, or drifts away from it; [`OrbitError::NoHysteresis`] with
    /// neither hysteresis nor dead time; [`OrbitError::OutOfDomain`] for numbers that are no process.
    pub fn relay_cycle(&self, relay: &TwoLevelRelay, load: f64) -> Result<RelayCycle, OrbitError> {
        let Self { drag, stiffness, dead_time_s, .. } = *self;
        domain::positive("drag", drag, "input s/output")?;
        domain::non_negative("stiffness", stiffness, "input/output")?;
        domain::non_negative("dead time", dead_time_s, "s")?;
        domain::finite("load", load, "input units")?;
        if relay.half_width == 0.0 && dead_time_s == 0.0 {
            return Err(OrbitError::NoHysteresis);
        }
        let [lower, upper] = [-relay.half_width, relay.half_width].map(|side| relay.reference + side);
        let [low, high] = [relay.low, relay.high].map(|command| command + load);
        for (force, level, towards) in [(high, upper, 1.0), (low, lower, -1.0)] {
            if !((force - stiffness * level) * towards > 0.0) {
                return Err(OrbitError::LevelNotPassed { force, level });
            }
        }
        // (1 - exp(-rate t))/stiffness, which is t/drag without stiffness, and its inverse.
        let rate = stiffness / drag;
        let settle = |time_s: f64| if rate > 0.0 { -libm::expm1(-rate * time_s) / stiffness } else { time_s / drag };
        let time_to = |share: f64| if rate > 0.0 { -libm::log1p(-stiffness * share) / rate } else { drag * share };
        // On beyond a level for a dead time, then to the level on the other side.
        let beyond = |level: f64, force: f64| level + (force - stiffness * level) * settle(dead_time_s);
        let back = |from: f64, level: f64, force: f64| time_to((level - from) / (force - stiffness * from));
        let (minimum, maximum) = (beyond(lower, low), beyond(upper, high));
        let time_high_s = dead_time_s + back(minimum, upper, high);
        let time_low_s = dead_time_s + back(maximum, lower, low);
        Ok(RelayCycle { time_high_s, time_low_s, minimum, maximum })
    }
}
