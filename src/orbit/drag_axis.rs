//! Limit cycle of a drag axis under a relay with hysteresis.

use super::OrbitError;
use super::half_cycle::{End, HalfCycle, Swing};
use crate::nonlinearity::RelayHysteresis;
use crate::numeric::{Real, Scalar};
use crate::plant::DragAxis;

/// The moment at which another command begins to act, delay included.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct Switching<T> {
    /// Position x there; beyond the relay's half-width by the way made during the delay.
    pub position: T,
    /// Velocity x' there.
    pub velocity: T,
}

/// A self-oscillation about the reference zero.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct LimitCycle<T> {
    /// Half the peak-to-peak range, X_m.
    pub amplitude: T,
    /// Middle of the range; in general neither the time mean nor the constant term of a Fourier series.
    pub bias: T,
    /// Largest position.
    pub maximum: T,
    /// Smallest position.
    pub minimum: T,
    /// Period T, in s.
    pub period_s: T,
    /// Time per period with the positive command, t_plus, in s.
    pub time_positive_s: T,
    /// Time per period with the negative command, t_minus, in s.
    pub time_negative_s: T,
    /// Where the negative command begins to act: x rises there.
    pub upper_switch: Switching<T>,
    /// Where the positive command begins to act: x falls there.
    pub lower_switch: Switching<T>,
    /// Factor by which a small deviation shrinks in a period: the slope of the return map, in (0, 1).
    pub multiplier: T,
}

impl<T: Real> LimitCycle<T> {
    /// The cycle between two ends.
    pub(super) fn between(half_width: T, above: &End<T>, below: &End<T>) -> Self {
        let half = T::from_f64(0.5);
        let time_positive_s = below.stop_time_s + above.rise_time_s;
        let time_negative_s = above.stop_time_s + below.rise_time_s;
        Self {
            amplitude: half_width + half * (above.excursion + below.excursion),
            bias: half * (above.excursion - below.excursion),
            maximum: half_width + above.excursion,
            minimum: -(half_width + below.excursion),
            period_s: time_positive_s + time_negative_s,
            time_positive_s,
            time_negative_s,
            upper_switch: Switching { position: half_width + above.switch_lag, velocity: above.switch_speed },
            lower_switch: Switching { position: -(half_width + below.switch_lag), velocity: -below.switch_speed },
            multiplier: above.gain * below.gain,
        }
    }
}

/// The limit cycle of `axis` under `relay`, with reference zero.
///
/// Exact up to rounding: the motion between switchings is in closed form (see [`OneWay`](crate::plant::OneWay)), and the
/// two times from rest to the relay's levels solve two equations by Newton's method. The lengths of successive
/// approaches map onto the next by increasing, concave functions: without a delay Newton's method converges from
/// every start.
///
/// A delay of any length is allowed. A half cycle always outlasts it: the axis turns only after a command has acted,
/// and must turn before the next. Hence at most a single command is on its way. A delay longer than the period without
/// delay also admits faster periodic motions, with several commands on their way. They are the limit cycles for the delay less
/// some whole number of their own periods, and are not given here.
///
/// In dual numbers the result carries its derivatives with respect to every parameter.
///
/// ```
/// use selfosc::{nonlinearity::RelayHysteresis, orbit::limit_cycle, plant::DragAxis};
/// let axis = DragAxis::quadratic(1.0, 0.5)?;
/// let cycle = limit_cycle(&axis, &RelayHysteresis::new(1.0, 0.3, 0.0)?)?;
/// let y = (1.0 - (-4.0 * 0.5 * 0.3f64).exp()).sqrt();
/// assert!((cycle.amplitude - (0.3 + (1.0 + y).ln())).abs() < 1e-14);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Errors
/// [`OrbitError::Drift`], [`OrbitError::NoDrag`] and [`OrbitError::NoHysteresis`] where there is no limit cycle,
/// [`OrbitError::Unresolved`] where rounding hides it.
pub fn limit_cycle<S: Scalar>(axis: &DragAxis<S>, relay: &RelayHysteresis<S>) -> Result<LimitCycle<S>, OrbitError> {
    let halves = HalfCycle::pair(axis, relay)?;
    let [upward, downward] = solve(&halves)?;
    let cycle = LimitCycle::between(relay.half_width(), &upward.end, &downward.end);
    let positive = [cycle.amplitude, cycle.time_positive_s, cycle.time_negative_s, cycle.period_s];
    let others = [cycle.bias, cycle.upper_switch.velocity, cycle.lower_switch.velocity, cycle.multiplier];
    let sound = positive.iter().all(|v| *v > S::zero()) && positive.iter().chain(&others).all(|v| v.is_finite());
    if sound { Ok(cycle) } else { Err(OrbitError::Unresolved { multiplier: cycle.multiplier.value() }) }
}

/// Newton steps allowed; about six are needed.
const MAX_STEPS: usize = 60;

/// Both swings of the limit cycle: Newton's method for the lengths of the two approaches, with the times as coordinates. Its own loop:
/// it has two unknowns, derivatives in closed form, any [`Scalar`], and doubles both times where the return map does not contract.
pub(super) fn solve<S: Scalar>(halves: &[HalfCycle<S>; 2]) -> Result<[Swing<S>; 2], OrbitError> {
    let one = S::one();
    let mean_drive = (halves[0].drive.drive + halves[1].drive.drive) / S::two();
    let mut times = [0, 1].map(|half: usize| S::from_f64(halves[half].time_guess(mean_drive)));
    // Convergence is quadratic: the step after a step as small as this is below rounding.
    let tolerance = S::epsilon().sqrt() / S::two();
    let mut multiplier = f64::NAN;
    for _ in 0..MAX_STEPS {
        let swings = [halves[0].swing(times[0]), halves[1].swing(times[1])];
        let [upward, downward] = swings;
        let contraction = one - upward.end.gain * downward.end.gain;
        multiplier = (one - contraction).value();
        if contraction <= S::zero() {
            // Below the times at which the map contracts, which happens only with a delay.
            times = times.map(|time| S::two() * time);
            continue;
        }
        let miss = [
            halves[1].approach_after(upward.end.excursion) - downward.approach,
            halves[0].approach_after(downward.end.excursion) - upward.approach,
        ];
        let steps = [
            upward.prolongation((miss[1] + downward.end.gain * miss[0]) / contraction),
            downward.prolongation((miss[0] + upward.end.gain * miss[1]) / contraction),
        ];
        if !(steps[0].is_finite() && steps[1].is_finite()) {
            break;
        }
        let settled = steps[0].abs() <= tolerance * times[0] && steps[1].abs() <= tolerance * times[1];
        for (time, step) in times.iter_mut().zip(steps) {
            *time = (*time + step).max(*time / S::from_f64(8.0));
        }
        if settled && contraction > S::from_f64(1e3) * S::epsilon() {
            return Ok([halves[0].swing(times[0]), halves[1].swing(times[1])]);
        }
    }
    Err(OrbitError::Unresolved { multiplier })
}

impl<S: Scalar> Swing<S> {
    /// Time that lengthens the approach by `length`, to second order.
    fn prolongation(&self, length: S) -> S {
        let (speed, acceleration) = (self.level_speed, self.level_acceleration);
        let square = speed * speed + S::two() * acceleration * length;
        S::two() * length / (speed + square.max(S::zero()).sqrt())
    }
}
