//! From a jump of the reference to a motion that the vehicle can follow, and the force that it takes.

use super::ControlError;
use crate::numeric::{Scalar, domain};
use crate::plant::DragAxis;

/// A reference model with two equal poles and a top speed, and the feed-forward of inertia, drag and disturbance along
/// it.
///
/// The force `alpha r'' + beta_1 r' + beta_2 |r'| r' - delta` moves the identified axis along the reference all by
/// itself; feedback is left with what the model does not know. The delay stays in: the vehicle is that much behind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeedForward<T> {
    axis: DragAxis<T>,
    pace_rad_s: T,
    top_speed: Option<T>,
}

/// Where the reference is on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Guided<T> {
    pub(super) position: T,
    pub(super) speed: T,
    pub(super) acceleration: T,
    /// How far the vehicle is behind, for the delay.
    pub(super) behind: T,
}

impl<T: Scalar> Guided<T> {
    /// At rest at a place.
    pub(super) fn at_rest(position: T) -> Self {
        Self { position, speed: T::zero(), acceleration: T::zero(), behind: T::zero() }
    }
}

impl<T: Scalar> FeedForward<T> {
    /// Along the answer of `pace^2/(s + pace)^2` to the reference, `pace_rad_s` in rad/s; `top_speed` (per s) bounds
    /// its speed.
    ///
    /// # Errors
    /// [`ControlError::OutOfDomain`] unless pace and top speed are positive and finite.
    pub fn new(axis: &DragAxis<T>, pace_rad_s: T, top_speed: Option<T>) -> Result<Self, ControlError> {
        domain::positive("pace of the reference", pace_rad_s, "rad/s")?;
        if let Some(speed) = top_speed {
            domain::positive("top speed of the reference", speed, "output units per s")?;
        }
        Ok(Self { axis: *axis, pace_rad_s, top_speed })
    }

    /// The reference's place after `dt_s`, coming from `from`; `ahead` is how far it has still to go. Exact for a
    /// constant reference below the top speed.
    pub(super) fn advance(&self, from: &Guided<T>, ahead: T, dt_s: T) -> Guided<T> {
        let (w, decay) = (self.pace_rad_s, (-(self.pace_rad_s * dt_s)).exp());
        let mixed = from.speed - w * ahead;
        let mut speed = (from.speed - w * mixed * dt_s) * decay;
        let mut position = from.position + ahead + (mixed * dt_s - ahead) * decay;
        if let Some(top) = self.top_speed
            && speed.abs() > top
        {
            speed = if speed > T::zero() { top } else { -top };
            position = from.position + speed * dt_s;
        }
        let (delay_s, way) = (self.axis.delay_s(), position - from.position);
        let mut behind = T::zero();
        if delay_s > T::zero() {
            let left = (-(dt_s / delay_s)).exp();
            behind = from.behind * left + (T::one() - left) * delay_s * way / dt_s;
        }
        Guided { position, speed, acceleration: (speed - from.speed) / dt_s, behind }
    }

    /// The speed at which the vehicle should be, for the delay.
    pub(super) fn expected_speed(&self, guided: &Guided<T>) -> T {
        let delay_s = self.axis.delay_s();
        if delay_s > T::zero() { guided.behind / delay_s } else { guided.speed }
    }

    /// The force that moves the axis so.
    pub(super) fn force(&self, guided: &Guided<T>) -> T {
        let axis = &self.axis;
        let drag = axis.linear_drag() + axis.quadratic_drag() * guided.speed.abs();
        axis.alpha() * guided.acceleration + drag * guided.speed - axis.disturbance()
    }
}
