//! Orbit inversion: the drag axis whose exact limit cycle has the features read off a record.
//!
//! For one drag law, everything dimensionless about an orbit depends on a single number, the shape, once the shares of the
//! period under either command are given; span, speeds at switching and times are closed forms of it. The ratio of
//! switching level to amplitude increases with the shape, so a single equation in a single unknown remains.

use super::answer::{IdentifyError, READ_AGAIN};
use super::iso::Oscillation;
use crate::features::Features;
use crate::numeric::{Limit, Scalar, domain, increasing_root, minus_tanh};
use crate::orbit::quadratic_speeds;
use crate::plant::{DragAxis, OneWay};

/// What orbit inversion reads off a record: means over its cycles.
///
/// The position counts by differences only, so a nonzero reference or an offset of the sensor has no effect; the
/// disturbance comes from the times.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct MeanCycle<T> {
    /// Relay level C, in units of the command.
    pub relay_level: T,
    /// Level x_a* in units of the output: half the distance between the positions at which the command was *given*
    /// upward and downward, `delay_s` before it acts. A continuous relay gives it at its preset half-width. Where the
    /// positions were read at the instants at which the force really reversed, `delay_s` is zero.
    pub switch_level: T,
    /// Amplitude X_m, half the peak-to-peak range, in units of the output.
    pub amplitude: T,
    /// Time t_plus per period with the positive command, in seconds.
    pub time_positive_s: T,
    /// Time t_minus per period with the negative command, in seconds.
    pub time_negative_s: T,
    /// Delay of the whole loop from the switching level to the force, in seconds.
    pub delay_s: T,
}

impl<S: Scalar> MeanCycle<S> {
    /// The means over steady cycles, with the level of the relay and the delay of the loop.
    pub fn of(features: &Features<S>, relay_level: S, delay_s: S) -> Self {
        Self {
            relay_level,
            switch_level: features.switch_level.mean,
            amplitude: features.amplitude.mean,
            time_positive_s: features.time_positive_s.mean,
            time_negative_s: features.time_negative_s.mean,
            delay_s,
        }
    }

    /// The cycle with equal times under both commands, as without a disturbance; the bias is not used.
    pub fn symmetric(oscillation: &Oscillation<S>) -> Self {
        let half_period = oscillation.period_s / S::two();
        Self {
            relay_level: oscillation.relay_level,
            switch_level: oscillation.switch_level,
            amplitude: oscillation.amplitude,
            time_positive_s: half_period,
            time_negative_s: half_period,
            delay_s: oscillation.delay_s,
        }
    }

    /// The axis with linear drag that has this limit cycle: alpha, beta_1, disturbance, and the delay given.
    ///
    /// Exact up to rounding for an exact cycle, with any disturbance and delay. It says nothing of whether drag *is*
    /// linear, and carries no error bars; in dual numbers it carries the derivatives with respect to the features,
    /// accurate to about the square root of the arithmetic's precision. The disturbance is
    /// `-C (t_plus - t_minus)/T`.
    ///
    /// ```
    /// use selfosc::identify::exact::MeanCycle;
    /// use selfosc::{nonlinearity::RelayHysteresis, orbit::limit_cycle, plant::DragAxis};
    /// let axis = DragAxis::linear(2.0f64, 0.7)?.with_disturbance(0.1)?.with_delay_s(0.2)?;
    /// let orbit = limit_cycle(&axis, &RelayHysteresis::new(1.0, 0.3, 0.0)?)?;
    /// let cycle = MeanCycle {
    ///     relay_level: 1.0,
    ///     switch_level: 0.3,
    ///     amplitude: orbit.amplitude,
    ///     time_positive_s: orbit.time_positive_s,
    ///     time_negative_s: orbit.time_negative_s,
    ///     delay_s: 0.2,
    /// };
    /// assert!((cycle.linear_drag()?.linear_drag() - 0.7).abs() < 1e-12);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`IdentifyError::OutOfDomain`] where a feature is not a number of the right kind, [`IdentifyError::NoOrbit`] where no
    /// orbit has this ratio of switching level to amplitude, [`IdentifyError::Unresolved`] where rounding hides the drag.
    pub fn linear_drag(&self) -> Result<DragAxis<S>, IdentifyError> {
        self.invert(|shape, shares| Some(OrbitShape::linear(shape, shares)))
    }

    /// The axis with quadratic drag that has this limit cycle: alpha, beta_2, disturbance, and the delay given. As
    /// [`linear_drag`](Self::linear_drag), but the disturbance is not that formula of the times.
    ///
    /// # Errors
    /// As [`linear_drag`](Self::linear_drag).
    ///
    /// ```
    /// use selfosc::identify::{exact::MeanCycle, iso::Oscillation};
    /// // Row 7 of Table 4, in its own units: degrees and 1e-2 N m.
    /// let row = Oscillation {
    ///     relay_level: 8.23, switch_level: 6.58, amplitude: 26.36, bias: 3.8, period_s: 2.69, delay_s: 0.2,
    /// };
    /// let axis = MeanCycle::symmetric(&row).quadratic_drag()?;
    /// assert!(axis.alpha() > 0.0 && axis.quadratic_drag() > 0.0 && axis.linear_drag() == 0.0);
    /// # Ok::<(), selfosc::identify::IdentifyError>(())
    /// ```
    pub fn quadratic_drag(&self) -> Result<DragAxis<S>, IdentifyError> {
        self.invert(|shape, [positive, negative]| OrbitShape::quadratic(shape, positive - negative))
    }

    /// Period T in seconds.
    fn period_s(&self) -> S {
        self.time_positive_s + self.time_negative_s
    }

    fn invert(&self, shape_of: impl Fn(S, [S; 2]) -> Option<OrbitShape<S>>) -> Result<DragAxis<S>, IdentifyError> {
        let target = self.checked_ratio()?;
        let shares = [self.time_positive_s / self.period_s(), self.time_negative_s / self.period_s()];
        let delay_share = self.delay_s / self.period_s();
        let excess = |shape| shape_of(shape, shares).map(|s| s.given_level(delay_share) / s.amplitude() - target);
        let shape = shape_with(excess).and_then(|shape| shape_of(shape, shares)).ok_or_else(|| self.unresolved())?;
        let time_unit = self.period_s() / (shape.times[0] + shape.times[1]);
        let length_unit = self.amplitude / shape.amplitude();
        let alpha = self.relay_level * time_unit * time_unit / length_unit;
        let axis = DragAxis::mixed(alpha, shape.linear * alpha / time_unit, shape.quadratic * alpha / length_unit);
        let disturbance = self.relay_level * (shape.forces[0] - S::one());
        axis.and_then(|axis| axis.with_disturbance(disturbance)?.with_delay_s(self.delay_s))
            .map_err(|_| self.unresolved())
    }

    fn unresolved(&self) -> IdentifyError {
        IdentifyError::Unresolved { ratio: (self.switch_level / self.amplitude).value() }
    }

    /// Ratio of switching level to amplitude, once every feature is in its domain.
    ///
    /// Strong drag makes the orbit a triangle, along which the command comes `T_d (1/t_plus + 1/t_minus)` of the amplitude
    /// before the turn on the average of both sides; weak drag lets the ratio fall to zero and, with a delay, below.
    fn checked_ratio(&self) -> Result<S, IdentifyError> {
        let zero = S::zero();
        for (feature, value, unit, limit) in [
            ("relay level", self.relay_level, "command units", Limit::Positive),
            ("switching level", self.switch_level, "output units", Limit::NonNegative),
            ("amplitude", self.amplitude, "output units", Limit::Positive),
            ("time with the positive command", self.time_positive_s, "s", Limit::Positive),
            ("time with the negative command", self.time_negative_s, "s", Limit::Positive),
            ("delay", self.delay_s, "s", Limit::NonNegative),
        ] {
            domain::require(feature, value, unit, limit, READ_AGAIN)?;
        }
        let ratio = self.switch_level / self.amplitude;
        let limit = S::one() - self.delay_s * (S::one() / self.time_positive_s + S::one() / self.time_negative_s);
        let driven = self.switch_level > zero || self.delay_s > zero;
        if driven && ratio < limit {
            return Ok(ratio);
        }
        Err(IdentifyError::NoOrbit { ratio: ratio.value(), limit: limit.value() })
    }
}

/// An orbit of one drag law in its natural units: command of level one; time and length such that the coefficient of drag
/// is one too. The first of two is the half cycle with the positive command.
struct OrbitShape<S> {
    /// Coefficients of drag: (1, 0) or (0, 1).
    linear: S,
    quadratic: S,
    /// Force while the command acts, disturbance included: `1 + mu`, `1 - mu`.
    forces: [S; 2],
    /// How long it acts.
    times: [S; 2],
    /// Time from rest until the other command acts.
    approaches: [S; 2],
    /// Speed then.
    speeds: [S; 2],
    /// Distance between the two places where the commands begin to act.
    span: S,
}

impl<S: Scalar> OrbitShape<S> {
    /// Linear drag, from `z = beta T/(4 alpha)` and the shares of the period.
    ///
    /// The command's two halves are given, so the motion is a linear response: with `A`, `B` half of each time, over a half
    /// cycle the speed changes by `4/(coth A + coth B)` and the position by `4 A B/(A + B)` less that.
    fn linear(z: S, shares: [S; 2]) -> Self {
        let two = S::two();
        let [a, b] = shares.map(|share| two * z * share);
        let [tanh_a, tanh_b] = [a.tanh(), b.tanh()];
        let [minus_a, minus_b] = [minus_tanh(a), minus_tanh(b)];
        let products = (a + b) * (tanh_a + tanh_b);
        let mean_speed = two * tanh_a * tanh_b / (tanh_a + tanh_b);
        let shift = two * (a * minus_b - b * minus_a) / products;
        let forces = [two * shares[1], two * shares[0]];
        let speeds = [mean_speed + shift, mean_speed - shift];
        let times = [two * a, two * b];
        let approach = |half: usize| times[half] - (speeds[1 - half] / forces[half]).ln_1p();
        Self {
            linear: S::one(),
            quadratic: S::zero(),
            forces,
            times,
            approaches: [approach(0), approach(1)],
            speeds,
            span: S::from_f64(4.0) * (a * tanh_a * minus_b + b * tanh_b * minus_a) / products,
        }
    }

    /// Quadratic drag, from `g = beta x_s/alpha` (x_s half the span) and the difference of the shares of the period.
    fn quadratic(g: S, share_difference: S) -> Option<Self> {
        // A force up shortens the time with the positive command.
        let excess = |force| {
            let [positive, negative] = Self::quadratic_disturbed(g, force).times;
            Some(share_difference - (positive - negative) / (positive + negative))
        };
        let two = S::two();
        let step = |force: S| S::epsilon().sqrt() * force * (two - force);
        let force = increasing_root(with_slope(excess, step), S::zero(), two, S::one() - share_difference)?;
        Some(Self::quadratic_disturbed(g, force))
    }

    /// Quadratic drag, from g and the force `1 + mu` that acts with the positive command.
    fn quadratic_disturbed(g: S, force: S) -> Self {
        let (one, two) = (S::one(), S::two());
        let squares = quadratic_speeds(-(-S::from_f64(4.0) * g).exp_m1(), force - one);
        let forces = [force, two - force];
        let half_cycle = |half: usize| {
            let (force, after, before) = (forces[half], squares[half], squares[1 - half]);
            let fraction = (after / force).sqrt();
            // atanh(p) = ln(1 + p) - ln(1 - p^2)/2, where 1 - p^2 = exp(-4 g)/(1 + before/force)
            let rise = if g > S::from_f64(0.1) {
                fraction.ln_1p() + two * g + (before / force).ln_1p() / two
            } else {
                fraction.atanh()
            };
            let root = force.sqrt();
            (rise / root, (before / force).sqrt().atan() / root)
        };
        let [positive, negative] = [half_cycle(0), half_cycle(1)];
        Self {
            linear: S::zero(),
            quadratic: one,
            forces,
            times: [positive.0 + positive.1, negative.0 + negative.1],
            approaches: [positive.0, negative.0],
            speeds: squares.map(S::sqrt),
            span: two * g,
        }
    }

    fn way(&self, drive: S) -> OneWay<S> {
        OneWay { drive, linear: self.linear, quadratic: self.quadratic }
    }

    /// Half the peak-to-peak range.
    fn amplitude(&self) -> S {
        let overshoot = |half: usize| {
            let brake = self.way(-self.forces[1 - half]);
            // The drive of a brake is negative, so there is always a rest.
            brake.advance(self.speeds[half], brake.time_to_rest(self.speeds[half]).unwrap_or(S::zero())).distance
        };
        (self.span + overshoot(0) + overshoot(1)) / S::two()
    }

    /// Half the distance between the places where the commands were given, the delay being a share of the period.
    fn given_level(&self, delay_share: S) -> S {
        let delay = delay_share * (self.times[0] + self.times[1]);
        let lag = |half: usize| {
            let (way, approach) = (self.way(self.forces[half]), self.approaches[half]);
            // A command given before the turning point belongs to no orbit; the whole approach then makes the level negative.
            let before = (approach - delay).max(S::zero());
            way.advance(way.advance(S::zero(), before).speed, delay.min(approach)).distance
        };
        (self.span - lag(0) - lag(1)) / S::two()
    }
}

/// Factors of four tried on either side of one: shapes from 1e-24 to 1e24, as far as the arithmetic reaches.
const MAX_FACTORS: usize = 40;

/// The positive root of an increasing function; `None` where rounding hides it.
fn shape_with<S: Scalar>(excess: impl Fn(S) -> Option<S>) -> Option<S> {
    let (four, mut guess) = (S::from_f64(4.0), S::one());
    let rising = excess(guess)? < S::zero();
    let factor = if rising { four } else { S::one() / four };
    for _ in 0..MAX_FACTORS {
        let next = guess * factor;
        if (excess(next)? < S::zero()) != rising {
            let (lower, upper) = if rising { (guess, next) } else { (next, guess) };
            return increasing_root(with_slope(excess, |x: S| S::epsilon().sqrt() * x), lower, upper, S::two() * lower);
        }
        guess = next;
    }
    None
}

/// Value and difference quotient. Newton's method loses no accuracy by a slope that is off by 1e-8.
fn with_slope<S: Scalar>(function: impl Fn(S) -> Option<S>, step: impl Fn(S) -> S) -> impl Fn(S) -> (S, S) {
    move |x| {
        let step = S::from_f64(step(x).value());
        match (function(x), function(x + step)) {
            (Some(value), Some(ahead)) => (value, (ahead - value) / step),
            _ => (S::zero(), S::zero()),
        }
    }
}
