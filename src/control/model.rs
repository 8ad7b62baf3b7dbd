//! An axis with every term that an identification may report.

use super::process::in_order;
use super::uncertain_drag::slope;
use super::{ControlError, LinearProcess};
use crate::numeric::{Interval, runge_kutta};
use crate::plant::{DragAxis, State};

/// `alpha x'' + (1 + skew sgn x')(beta + beta_quadratic |x'| + beta_cubic x'^2) x' + coulomb sgn x' + memory s + stiffness x = a + delta`,
/// `memory_s s' = x' - s`, `lag_s a' = u(t - delay_s) - a`, and a reading `filter_s y' = x - y`.
///
/// `T` is a number, an interval, or whatever else is known of each. Zero stands for a term that is not there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisModel<T> {
    /// Inertia with added mass, F s^2/x.
    pub alpha: T,
    /// Linear drag, F s/x.
    pub beta: T,
    /// Quadratic drag, F s^2/x^2.
    pub beta_quadratic: T,
    /// Cubic drag, F s^3/x^3.
    pub beta_cubic: T,
    /// Share by which drag is larger to the positive side.
    pub skew: T,
    /// Coulomb friction, F.
    pub coulomb: T,
    /// Restoring force, F/x.
    pub stiffness: T,
    /// Drag that follows the speed late, F s/x.
    pub memory: T,
    /// Time constant with which it follows, s.
    pub memory_s: T,
    /// Lag of the actuator, s.
    pub lag_s: T,
    /// Time that an actuator of limited rate takes over the command's range, s.
    pub ramp_s: T,
    /// Time without thrust after the command changes its sign, s.
    pub pause_s: T,
    /// Filter of the sensor, s.
    pub filter_s: T,
    /// Constant force, F.
    pub delta: T,
    /// Delay of the loop, s.
    pub delay_s: T,
}

in_order! {
    pub NAMES[15] of AxisModel: alpha, beta, beta_quadratic, beta_cubic, skew, coulomb, stiffness, memory, memory_s, lag_s, ramp_s,
    pause_s, filter_s, delta, delay_s
}

impl<T> AxisModel<T> {
    /// Something made of each part.
    pub fn map<U>(self, of: impl FnMut(T) -> U) -> AxisModel<U> {
        AxisModel::from_parts(self.parts().map(of))
    }
}

impl From<&DragAxis<f64>> for AxisModel<f64> {
    fn from(axis: &DragAxis<f64>) -> Self {
        let (beta, beta_quadratic) = (axis.linear_drag(), axis.quadratic_drag());
        let (alpha, delta, delay_s) = (axis.alpha(), axis.disturbance(), axis.delay_s());
        Self { alpha, beta, beta_quadratic, delta, delay_s, ..Self::default() }
    }
}

impl AxisModel<f64> {
    /// Whether it is a drag axis with delay and constant force, and nothing else.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        let Self { beta_cubic, skew, coulomb, stiffness, memory, lag_s, ramp_s, pause_s, filter_s, .. } = *self;
        [beta_cubic, skew, coulomb, stiffness, memory, lag_s, ramp_s, pause_s, filter_s].iter().all(|part| *part == 0.0)
            && self.beta >= 0.0
    }

    /// The axis that gains are placed for: drag that drives counts as none, and every lag as delay (a ramp or a pause as half of itself, the
    /// delay of the middle of its step).
    ///
    /// # Errors
    /// [`ControlError::Plant`] unless the inertia is above zero.
    pub fn design_axis(&self) -> Result<DragAxis<f64>, ControlError> {
        let late_s = self.delay_s + self.lag_s + self.filter_s + 0.5 * (self.ramp_s + self.pause_s);
        let axis = DragAxis::mixed(self.alpha, self.beta.max(0.0), self.beta_quadratic.max(0.0))?;
        Ok(axis.with_disturbance(self.delta)?.with_delay_s(late_s)?)
    }

    /// Drag at a speed, memory aside. Coulomb friction is smoothed over a thousandth of `fast`.
    fn drag(&self, speed: f64, fast: f64) -> f64 {
        let side = 1.0 + self.skew * speed.signum();
        let viscous = side * (self.beta + self.beta_quadratic * speed.abs() + self.beta_cubic * speed * speed) * speed;
        viscous + self.coulomb * libm::tanh(speed / (1e-3 * fast))
    }

    /// Rates of position, speed, late speed, force and reading under a command.
    fn rates(&self, [position, speed, late, force, reading]: ModelState, command: f64, fast: f64) -> ModelState {
        let follows = |time_s: f64, target: f64, now: f64| if time_s > 0.0 { (target - now) / time_s } else { 0.0 };
        let force = if self.lag_s > 0.0 { force } else { command };
        let total = force + self.delta - self.drag(speed, fast) - self.memory * late - self.stiffness * position;
        [
            speed,
            total / self.alpha,
            follows(self.memory_s, speed, late),
            follows(self.lag_s, command, force),
            follows(self.filter_s, position, reading),
        ]
    }

    /// The state some time later under a constant command: of a drag axis in closed form, else by four Runge-Kutta steps.
    pub(super) fn motion(&self, fast: f64) -> Result<impl Fn(ModelState, f64, f64) -> ModelState, ControlError> {
        const STEPS: u32 = 4;
        let drag_axis = self.is_plain().then(|| self.design_axis()).transpose()?;
        Ok(move |state: ModelState, command: f64, time_s: f64| match &drag_axis {
            Some(axis) => {
                let moved = axis.advance(State { position: state[0], velocity: state[1] }, command, time_s);
                [moved.position, moved.velocity, 0.0, 0.0, 0.0]
            }
            None => (0..STEPS).fold(state, |state, _| {
                runge_kutta(state, time_s / f64::from(STEPS), |state| self.rates(state, command, fast))
            }),
        })
    }

    /// What the sensor says.
    pub(super) fn reading(&self, state: &ModelState) -> f64 {
        if self.filter_s > 0.0 { state[4] } else { state[0] }
    }
}

/// Position, speed, late speed, force, reading.
pub(super) type ModelState = [f64; 5];

impl AxisModel<Interval> {
    /// Slopes of the mean of both sides' drag at speeds up to `top_speed`: `beta + 2 beta_quadratic |v| + 3 beta_cubic v^2`.
    #[must_use]
    pub fn slopes(&self, top_speed: f64) -> Interval {
        let speeds = Interval::new(0.0, top_speed).unwrap_or(Interval::ENTIRE);
        slope([self.beta, self.beta_quadratic, self.beta_cubic], speeds)
    }

    /// Every linear process that slow signals see where the drag has these slopes, times `1 + skew` to the one side and `1 - skew` to the
    /// other; a limited rate is a delay of up to half the ramp. Coulomb friction has no slope but at rest, where it holds the axis.
    ///
    /// A pause p is a delay of up to p: its describing function at the frequency w has a phase lag below w p. No process has its loss of
    /// gain.
    #[must_use]
    pub fn processes(&self, slopes: Interval) -> LinearProcess<Interval> {
        let sides = (Interval::ONE - self.skew).hull(Interval::ONE + self.skew);
        let [half, all] = [0.5, 1.0].map(|part| Interval::new(0.0, part).unwrap_or(Interval::ENTIRE));
        LinearProcess {
            alpha: self.alpha,
            drag: slopes * sides,
            stiffness: self.stiffness,
            memory: self.memory,
            memory_s: self.memory_s,
            lag_s: self.lag_s,
            filter_s: self.filter_s,
            zero_s: Interval::ZERO,
            delay_s: self.delay_s + half * self.ramp_s + all * self.pause_s,
        }
    }
}
