//! How far a loop is from instability.

use super::{ControlError, OpenLoop};
use crate::numeric::{Scalar, domain};

/// What a stable loop stands before it is critical. Each margin is for a change of that one kind alone.
///
/// All crossovers count, and the worst is given. They belong to the linear loop; they say nothing of saturation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct Margins<T> {
    /// The gain may grow by less than this factor, above 1; `None` where any growth is borne.
    pub gain: Option<T>,
    /// The gain may be divided by less than this factor, above 1; `None` where any cut is borne. Loops that integrate
    /// twice or more have such a limit.
    pub gain_reduction: Option<T>,
    /// The phase may lag or lead by less than this more, rad.
    pub phase_rad: T,
    /// The delay may grow by less than this, s.
    pub delay_s: T,
    /// The frequency at which `|L| = 1` and the delay margin is met, rad/s.
    pub crossover_rad_s: T,
}

impl<T: Scalar> OpenLoop<T> {
    /// Gain, phase and delay margin of the loop with its delay.
    ///
    /// Every crossover of gain and every crossover of phase that can matter is found: the first are the roots of a
    /// polynomial, the second are looked for between the turns of the phase, until `|L|` is too small for good.
    ///
    /// ```
    /// use selfosc::control::{Gains, OpenLoop, Structure};
    /// use selfosc::plant::DragAxis;
    /// // L = exp(-0.5 s)/s: crossover at 1 rad/s, phase margin pi/2 - 0.5, gain margin pi/(2 0.5).
    /// let gains = Gains::new(Structure::Pd, 1.0, 0.0, 1.0, 0.0)?;
    /// let axis = DragAxis::linear(1.0, 1.0)?.with_delay_s(0.5)?;
    /// let margins = OpenLoop::new(&axis, &gains, 0.0)?.margins()?;
    /// let half_pi = core::f64::consts::FRAC_PI_2;
    /// assert!((margins.phase_rad - (half_pi - 0.5)).abs() < 1e-14);
    /// assert!((margins.delay_s - (half_pi - 0.5)).abs() < 1e-14);
    /// assert!((margins.gain.unwrap() - half_pi / 0.5).abs() < 1e-14);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ControlError::Unstable`].
    pub fn margins(&self) -> Result<Margins<T>, ControlError> {
        let poles = self.unstable_poles();
        if poles > 0 {
            return Err(self.unstable(poles));
        }
        let turn = T::two() * T::pi();
        let mut margins: Option<Margins<T>> = None;
        for y in self.gain_crossovers_squared().into_iter().flatten() {
            let omega = y.sqrt();
            let angle = self.angle_above_critical(omega);
            let above = angle - (angle / turn).floor() * turn;
            let (phase_rad, delay_s) = (above.min(turn - above), above / omega);
            let found = margins.get_or_insert(Margins {
                gain: None,
                gain_reduction: None,
                phase_rad,
                delay_s,
                crossover_rad_s: omega,
            });
            found.phase_rad = found.phase_rad.min(phase_rad);
            if delay_s < found.delay_s {
                (found.delay_s, found.crossover_rad_s) = (delay_s, omega);
            }
        }
        let mut margins = margins.ok_or_else(|| self.unstable(1))?;
        let better = |known: Option<T>, new: T| Some(known.map_or(new, |known| known.min(new)));
        self.phase_crossovers(|omega| {
            let size = self.magnitude(omega);
            // Too small for the arithmetic: no limit worth the name. Too large: none either.
            let gain = T::one() / size;
            if !gain.is_finite() {
                return false;
            }
            if size < T::one() {
                margins.gain = better(margins.gain, gain);
            } else if size.is_finite() {
                margins.gain_reduction = better(margins.gain_reduction, size);
            }
            margins.gain.is_none_or(|gain| self.magnitude_bound(omega) * gain > T::one())
        });
        for (margin, value) in [("phase margin", margins.phase_rad), ("delay margin", margins.delay_s)] {
            domain::representable(margin, value, "rad or s")?;
        }
        Ok(margins)
    }
}
