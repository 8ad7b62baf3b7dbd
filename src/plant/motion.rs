//! Motion of a drag axis under a constant input.

use super::{DragAxis, OneWay};
use crate::numeric::{Real, Scalar};

/// Position (m, or rad) and velocity (per s) of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct State<T> {
    /// Position x.
    pub position: T,
    /// Velocity x'.
    pub velocity: T,
}

impl<T: Real> DragAxis<T> {
    /// Motion in one direction under a force along it, disturbance included.
    pub fn one_way(&self, force: T) -> OneWay<T> {
        OneWay {
            drive: force / self.alpha(),
            linear: self.linear_drag() / self.alpha(),
            quadratic: self.quadratic_drag() / self.alpha(),
        }
    }
}

impl<S: Scalar> DragAxis<S> {
    /// The state `duration_s >= 0` after `state`, the force `input` acting all the time. The delay plays no part: `input`
    /// is what acts now.
    ///
    /// Exact up to rounding for every duration, also where the velocity changes sign on the way; in dual numbers it
    /// carries the derivatives with respect to parameters, state, input and duration.
    ///
    /// ```
    /// use selfosc::plant::{DragAxis, State};
    /// let axis = DragAxis::linear(1.0, 1.0)?;
    /// let end = axis.advance(State { position: 0.0, velocity: 0.0 }, 1.0, 1.0);
    /// assert!((end.velocity - (1.0 - (-1f64).exp())).abs() < 1e-15);
    /// # Ok::<(), selfosc::plant::PlantError>(())
    /// ```
    pub fn advance(&self, state: State<S>, input: S, duration_s: S) -> State<S> {
        let (sign, speed, way) = self.departure(state, input);
        let (distance, speed) = match way.time_to_rest(speed) {
            Some(rest) if rest < duration_s => {
                let back = OneWay { drive: -way.drive, ..way }.advance(S::zero(), duration_s - rest);
                (way.advance(speed, rest).distance - back.distance, -back.speed)
            }
            _ => {
                let passage = way.advance(speed, duration_s);
                (passage.distance, passage.speed)
            }
        };
        State { position: state.position + sign * distance, velocity: sign * speed }
    }

    /// Time until the velocity is zero; `None` where the force does not brake.
    pub fn time_to_rest(&self, state: State<S>, input: S) -> Option<S> {
        let (_, speed, way) = self.departure(state, input);
        way.time_to_rest(speed)
    }

    /// Time until the position is first `level`, after a turn too; `None` where it never is.
    pub fn time_to_position(&self, state: State<S>, input: S, level: S) -> Option<S> {
        let (sign, speed, way) = self.departure(state, input);
        let ahead = sign * (level - state.position);
        let Some(rest) = way.time_to_rest(speed) else {
            return way.time_to_distance(speed, ahead);
        };
        let turn = way.advance(speed, rest).distance;
        if ahead > turn {
            return None;
        }
        if ahead >= S::zero() {
            return way.time_to_distance(speed, ahead);
        }
        let back = OneWay { drive: -way.drive, ..way };
        Some(rest + back.time_to_distance(S::zero(), turn - ahead)?)
    }

    /// Direction of the motion, speed, and the motion itself; from rest the force decides the direction.
    fn departure(&self, state: State<S>, input: S) -> (S, S, OneWay<S>) {
        let force = input + self.disturbance();
        let zero = S::zero();
        let backward = state.velocity < zero || (state.velocity == zero && force < zero);
        let sign = if backward { -S::one() } else { S::one() };
        (sign, sign * state.velocity, self.one_way(sign * force))
    }
}
