//! Thrust and torque of a propeller in moving water.

use super::VehicleError;
use crate::numeric::{Real, Scalar, domain};

/// A propeller in water that moves along its axis (eq. 1): `T = T_nn abs(n) n - T_nu abs(n) u_a`, torque alike.
///
/// `n` is the rate of revolution, `u_a` the ambient water speed in m/s, positive when the propeller advances into the water
/// in the direction of positive thrust. Thrust grows with `n` except where the propeller turns with the flow more slowly
/// than half of `T_nu abs(u_a)/T_nn`, below which it brakes; the inverse never answers from there.
///
/// ```
/// # use selfosc::vehicle::{BilinearThruster, VehicleError};
/// let propeller = BilinearThruster::new((0.01_f64, 0.02), (2.0e-4, 3.0e-4), 40.0)?;
/// let rate = propeller.rate(5.0, 0.5)?;
/// assert!((propeller.thrust(rate, 0.5) - 5.0).abs() < 1e-12);
/// # Ok::<(), VehicleError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BilinearThruster<T> {
    thrust: [T; 2],
    torque: [T; 2],
    largest_rate: T,
}

/// Eq. 1, for thrust and torque alike.
pub(crate) fn bilinear<T: Real>([by_rate, by_speed]: [T; 2], rate: T, ambient_speed: T) -> T {
    by_rate * rate.abs() * rate - by_speed * rate.abs() * ambient_speed
}

impl<T: Scalar> BilinearThruster<T> {
    /// A propeller from its pairs `(T_nn, T_nu)` and `(Q_nn, Q_nu)` and its largest rate of revolution.
    ///
    /// # Errors
    /// `T_nn`, `Q_nn` or the largest rate not positive; `T_nu` or `Q_nu` negative; numbers that are not finite.
    pub fn new(thrust: (T, T), torque: (T, T), largest_rate: T) -> Result<Self, VehicleError> {
        for (name, value) in [("T_nn", thrust.0), ("Q_nn", torque.0), ("largest rate of revolution", largest_rate)] {
            domain::positive(name, value, "")?;
        }
        for (name, value) in [("T_nu", thrust.1), ("Q_nu", torque.1)] {
            domain::non_negative(name, value, "")?;
        }
        Ok(Self { thrust: thrust.into(), torque: torque.into(), largest_rate })
    }

    /// Thrust in N.
    ///
    /// Rounding: for all floats with `T_nn` 2^-7 to 2^-6, `T_nu` 2^-6 to 2^-4, rates to 32 and speeds to 1 either way, the thrust is
    /// within 6.1e-15 of the exact one in f64 and within 3.3e-6 in f32. Assumptions: `spec/rounding.md`.
    pub fn thrust(&self, rate: T, ambient_speed_m_s: T) -> T {
        bilinear(self.thrust, rate, ambient_speed_m_s)
    }

    /// Torque in N m.
    pub fn torque(&self, rate: T, ambient_speed_m_s: T) -> T {
        bilinear(self.torque, rate, ambient_speed_m_s)
    }

    /// The rate that gives a thrust in N, turning in the direction of that thrust; no thrust is rate zero.
    ///
    /// Rounding: for these coefficients and speeds, a largest rate of 64, and thrusts 0.5 to 8 either way, the rate is within 1.8e-14 of the
    /// exact one in f64 and within 9.7e-6 in f32.
    ///
    /// As thrust vanishes the rate tends to `T_nu abs(u_a)/T_nn` when the flow goes the same way, not to zero.
    ///
    /// # Errors
    /// [`VehicleError::Saturated`] when the rate would exceed the largest; inputs that are not finite.
    pub fn rate(&self, thrust_n: T, ambient_speed_m_s: T) -> Result<T, VehicleError> {
        domain::finite("thrust", thrust_n, "N")?;
        domain::finite("ambient water speed", ambient_speed_m_s, "m/s")?;
        let sign = if thrust_n < T::zero() {
            -T::one()
        } else if thrust_n > T::zero() {
            T::one()
        } else {
            return Ok(T::zero());
        };
        let with_flow = sign * self.thrust[1] * ambient_speed_m_s;
        let four_product = T::from_f64(4.0) * self.thrust[0] * thrust_n.abs();
        let root = (with_flow.square() + four_product).sqrt();
        // The form without cancellation for the sign of the flow.
        let rate = (-with_flow).prefer(
            || (with_flow + root) / (T::two() * self.thrust[0]),
            || T::two() * thrust_n.abs() / (root - with_flow),
        );
        if rate <= self.largest_rate {
            return Ok(sign * rate);
        }
        let largest_n = self.thrust(sign * self.largest_rate, ambient_speed_m_s).value();
        Err(VehicleError::Saturated { thruster: 0, thrust_n: thrust_n.value(), largest_n })
    }
}
