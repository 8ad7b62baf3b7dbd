//! A half cycle: from the turning point across the relay's level to the next turning point.

use super::OrbitError;
use crate::nonlinearity::RelayHysteresis;
use crate::numeric::Scalar;
use crate::plant::{DragAxis, OneWay, Passage};

/// The half cycle that a command drives.
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfCycle<S> {
    /// Motion from rest until the opposite command acts.
    pub(super) drive: OneWay<S>,
    /// Motion after that until rest.
    pub(super) brake: OneWay<S>,
    delay_s: S,
    half_width: S,
}

/// An end of a limit cycle, seen outwards from the middle; every quantity is positive.
#[derive(Clone, Copy, Debug)]
pub(super) struct End<T> {
    /// Way from the relay's level to rest.
    pub(super) excursion: T,
    /// Way from the relay's level to where the opposite command begins to act, and the speed there.
    pub(super) switch_lag: T,
    pub(super) switch_speed: T,
    /// Time from rest at the opposite end to there, and from there to rest at this end.
    pub(super) rise_time_s: T,
    pub(super) stop_time_s: T,
    /// Derivative of the next approach with respect to the approach to this end.
    pub(super) gain: T,
}

/// The half cycle seen from the turning point before it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Swing<S> {
    /// Speed at the relay's level.
    pub(super) level_speed: S,
    /// Acceleration there.
    pub(super) level_acceleration: S,
    /// Way from the turning point to the relay's level.
    pub(super) approach: S,
    pub(super) end: End<S>,
}

impl<S: Scalar> HalfCycle<S> {
    /// The upward half (command positive) and the downward half, or the reason why there is no oscillation.
    pub(super) fn pair(axis: &DragAxis<S>, relay: &RelayHysteresis<S>) -> Result<[Self; 2], OrbitError> {
        let (zero, level) = (S::zero(), relay.level());
        let constant = axis.disturbance() + relay.offset();
        let (upward, downward) = (level + constant, level - constant);
        if !(upward > zero && downward > zero) {
            return Err(OrbitError::Drift {
                disturbance: axis.disturbance().value(),
                offset: relay.offset().value(),
                level: level.value(),
            });
        }
        if axis.linear_drag() <= zero && axis.quadratic_drag() <= zero {
            return Err(OrbitError::NoDrag);
        }
        if relay.half_width() <= zero && axis.delay_s() <= zero {
            return Err(OrbitError::NoHysteresis);
        }
        let (delay_s, half_width) = (axis.delay_s(), relay.half_width());
        let half =
            |drive, brake: S| Self { drive: axis.one_way(drive), brake: axis.one_way(-brake), delay_s, half_width };
        Ok([half(upward, downward), half(downward, upward)])
    }

    /// From rest, `time_s` before the crossing of the level.
    pub(super) fn swing(&self, time_s: S) -> Swing<S> {
        let approach = self.drive.advance(S::zero(), time_s);
        // The speed gain is also the ratio of the accelerations at both ends; no difference cancels in it.
        let acceleration = self.drive.drive * approach.speed_gain;
        let lag = if self.delay_s == S::zero() {
            // First order in the delay: exact, and a dual number keeps its derivative.
            let (speed, distance) = (approach.speed + self.delay_s * acceleration, self.delay_s * approach.speed);
            Passage { distance, speed, speed_gain: S::one(), distance_gain: self.delay_s }
        } else {
            self.drive.advance(approach.speed, self.delay_s)
        };
        // The drive of a brake is negative: there is always a rest.
        let stop_time_s = self.brake.time_to_rest(lag.speed).unwrap_or(S::zero());
        let stop = self.brake.advance(lag.speed, stop_time_s).distance;
        let braking = -self.brake.acceleration(lag.speed);
        let end = End {
            excursion: lag.distance + stop,
            switch_lag: lag.distance,
            switch_speed: lag.speed,
            rise_time_s: time_s + self.delay_s,
            stop_time_s,
            gain: (lag.distance_gain + lag.speed_gain * lag.speed / braking) * acceleration / approach.speed,
        };
        Swing { level_speed: approach.speed, level_acceleration: acceleration, approach: approach.distance, end }
    }

    /// Way from the turning point reached by an overshoot to the opposite level.
    pub(super) fn approach_after(&self, excursion: S) -> S {
        excursion + S::two() * self.half_width
    }

    /// Near the time from rest to the level on the limit cycle: where Newton's method starts.
    pub(super) fn time_guess(&self, mean_drive: S) -> f64 {
        let [linear, quadratic] = [self.drive.linear, self.drive.quadratic].map(Scalar::value);
        let [drive, mean] = [self.drive.drive, mean_drive].map(Scalar::value);
        let (x, t, thrust) = (self.half_width.value(), self.delay_s.value(), mean * mean);
        let terminal = OneWay { drive: mean, linear, quadratic }.terminal_speed();
        // Cubes of the speeds that each drag alone allows. Weak drag: the relay's work in a half cycle is lost to drag
        // over a half cycle of speed nearly linear in time.
        let waiting = libm::sqrt(3.0 * thrust * t / linear);
        let square = libm::sqrt(4.0 * thrust * x / quadratic);
        let linear_alone = (waiting * waiting * waiting).max(3.0 * thrust * x / linear);
        let quadratic_alone = (4.0 * thrust * t / quadratic).max(square * libm::sqrt(square));
        // A drag that is not there sets no limit.
        let inverse = |cube: f64| if cube > 0.0 { 1.0 / cube } else { 0.0 };
        let limits = [terminal * terminal * terminal, linear_alone, quadratic_alone].map(inverse);
        let speed = 1.0 / libm::cbrt(limits[0] + limits[1] + limits[2]);
        let approach = 2.0 * x + speed * t + speed * speed / (2.0 * mean);
        let settled = approach / OneWay { drive, linear, quadratic }.terminal_speed();
        libm::sqrt(2.0 * approach / drive + settled * settled)
    }
}
