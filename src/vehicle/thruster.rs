//! Thrust by command in still water, with dead zone, saturation and a propeller that differs forward and backward.

use super::VehicleError;
use crate::numeric::{Limit, Scalar, domain};

/// One direction of rotation: thrust `a n^2 + b n` for command magnitudes `n` from the dead zone to the limit.
///
/// Below the dead zone friction holds the propeller and there is no thrust; above the limit thrust stays what it is there.
/// The command is in whatever unit the map was measured (revolutions per second, volt, a byte).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThrustSide<T> {
    quadratic: T,
    linear: T,
    dead_zone: T,
    limit: T,
}

impl<T: Scalar> ThrustSide<T> {
    /// A side with `thrust = quadratic * n^2 + linear * n` for `dead_zone <= n <= limit`.
    ///
    /// # Errors
    /// Numbers that are not finite, `dead_zone < 0`, `limit <= dead_zone`, and thrust that is negative or falls anywhere
    /// between them: `linear < 0` is right only with a dead zone that hides it, `quadratic < 0` only with a limit that ends
    /// before the vertex.
    pub fn new(quadratic: T, linear: T, dead_zone: T, limit: T) -> Result<Self, VehicleError> {
        domain::finite("quadratic thrust coefficient", quadratic, "N per squared command")?;
        domain::finite("linear thrust coefficient", linear, "N per command")?;
        domain::non_negative("dead zone", dead_zone, "command units")?;
        let remedy = "give magnitudes, the dead zone first";
        domain::require("largest command", limit, "command units", Limit::Above(dead_zone.value()), remedy)?;
        let side = Self { quadratic, linear, dead_zone, limit };
        domain::finite("thrust at the largest command", side.curve(limit), "N")?;
        // No less than the square of any slope, each part of it as well: what inverts the curve stays finite.
        domain::finite("squared slope at the largest command", side.squared_slope(side.curve(limit)), "")?;
        // The slope is linear in the command, so its ends decide.
        let (first, last) = (side.slope(dead_zone), side.slope(limit));
        let forward = quadratic * dead_zone + linear >= T::zero() && side.curve(dead_zone) <= side.curve(limit);
        if !(forward && first >= T::zero() && last >= T::zero() && first + last > T::zero()) {
            return Err(VehicleError::NotMonotone {
                dead_zone: dead_zone.value(),
                limit: limit.value(),
                thrust_at_dead_zone_n: side.curve(dead_zone).value(),
                slope_at_dead_zone: first.value(),
                slope_at_limit: last.value(),
            });
        }
        Ok(side)
    }

    /// Coefficient of the squared command, N per squared command.
    pub fn quadratic(&self) -> T {
        self.quadratic
    }
    /// Coefficient of the command, N per command.
    pub fn linear(&self) -> T {
        self.linear
    }
    /// Command magnitude at which the propeller starts.
    pub fn dead_zone(&self) -> T {
        self.dead_zone
    }
    /// Largest command magnitude.
    pub fn limit(&self) -> T {
        self.limit
    }
    /// Thrust magnitude of the slowest rotation, N: what is smaller, apart from none, cannot be had.
    pub fn smallest_thrust_n(&self) -> T {
        self.curve(self.dead_zone)
    }
    /// Thrust magnitude at the limit, N.
    pub fn largest_thrust_n(&self) -> T {
        self.curve(self.limit)
    }

    fn curve(&self, command: T) -> T {
        (self.quadratic * command + self.linear) * command
    }

    fn slope(&self, command: T) -> T {
        T::two() * self.quadratic * command + self.linear
    }

    /// Square of the slope where the curve reaches a thrust.
    fn squared_slope(&self, thrust: T) -> T {
        self.linear.square() + T::two() * self.quadratic * (T::two() * thrust)
    }

    fn thrust(&self, magnitude: T) -> T {
        if magnitude < self.dead_zone { T::zero() } else { self.curve(magnitude.min(self.limit)) }
    }

    /// The command for a thrust between the smallest and the largest.
    fn command(&self, thrust: T) -> T {
        let root = self.squared_slope(thrust).max(T::zero()).sqrt();
        // The form without cancellation for the sign of the linear coefficient.
        let command = if self.linear < T::zero() {
            (root - self.linear) / (T::two() * self.quadratic)
        } else if thrust > T::zero() {
            T::two() * thrust / (self.linear + root)
        } else {
            T::zero()
        };
        // Rounding must not push a reachable thrust into the dead zone or past the limit.
        command.max(self.dead_zone).min(self.limit)
    }
}

/// A command and the thrust it gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Delivered<T> {
    /// Command to the thruster, in the unit of its map.
    pub command: T,
    /// Thrust that command gives, N.
    pub thrust_n: T,
}

/// A thruster in still water (eqs. 2 and 3): thrust that never falls as the command grows, and its inverse.
///
/// ```
/// # use selfosc::vehicle::{ThrustSide, Thruster, VehicleError};
/// let thruster = Thruster::asymmetric(
///     ThrustSide::new(1.5e-4_f64, 0.01, 15.0, 200.0)?,
///     ThrustSide::new(1.0e-4, 0.01, 15.0, 200.0)?,
/// );
/// let command = thruster.command(-2.0)?;
/// assert!((thruster.thrust(command) + 2.0).abs() < 1e-12);
/// assert_eq!(thruster.thrust(10.0), 0.0); // friction holds the propeller
/// assert!(matches!(thruster.command(9.0), Err(VehicleError::Saturated { .. })));
/// assert_eq!(thruster.command_clamped(9.0)?.command, 200.0);
/// # Ok::<(), VehicleError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thruster<T> {
    forward: ThrustSide<T>,
    backward: ThrustSide<T>,
}

impl<T: Scalar> Thruster<T> {
    /// The same map both ways: `thrust = quadratic * abs(n) n + linear * n` (eq. 2).
    ///
    /// # Errors
    /// Those of [`ThrustSide::new`].
    pub fn affine(quadratic: T, linear: T, dead_zone: T, limit: T) -> Result<Self, VehicleError> {
        let side = ThrustSide::new(quadratic, linear, dead_zone, limit)?;
        Ok(Self { forward: side, backward: side })
    }

    /// A map for positive and a map for negative commands (eq. 3), the latter given by magnitudes.
    pub fn asymmetric(forward: ThrustSide<T>, backward: ThrustSide<T>) -> Self {
        Self { forward, backward }
    }

    /// The map of positive commands.
    pub fn forward(&self) -> &ThrustSide<T> {
        &self.forward
    }
    /// The map of negative commands, by magnitudes.
    pub fn backward(&self) -> &ThrustSide<T> {
        &self.backward
    }

    /// Thrust in N at a command; a command past the limit gives the thrust at the limit.
    ///
    /// Rounding: for all floats with quadratic coefficients 2^-13 to 2^-12, linear ones 2^-7 to 2^-6, dead zones 8 to 16, limits 192
    /// to 256 and commands to 256 either way, the thrust is within 6.3e-15 of the exact one in f64 and within 3.4e-6 in f32: at the
    /// ends of the dead zone and at the limit too, for these decide without rounding. Assumptions: `spec/rounding.md`.
    pub fn thrust(&self, command: T) -> T {
        if command < T::zero() { -self.backward.thrust(-command) } else { self.forward.thrust(command) }
    }

    /// The command that gives a thrust in N; no thrust is command zero.
    ///
    /// Rounding: for the coefficients, dead zones and limits of [`thrust`](Self::thrust), and thrusts 0.375 to 5 either way, which none of
    /// these thrusters refuses, the command is within 8.5e-14 of the exact one in f64 and within 4.4e-5 in f32.
    ///
    /// # Errors
    /// [`VehicleError::Saturated`] above the largest thrust of that side, [`VehicleError::InDeadZone`] between none and the
    /// smallest, and a thrust that is not finite.
    pub fn command(&self, thrust_n: T) -> Result<T, VehicleError> {
        domain::finite("thrust", thrust_n, "N")?;
        let (side, sign) = self.side(thrust_n);
        let magnitude = thrust_n.abs();
        if magnitude > side.largest_thrust_n() {
            let largest_n = (sign * side.largest_thrust_n()).value();
            return Err(VehicleError::Saturated { thruster: 0, thrust_n: thrust_n.value(), largest_n });
        }
        if magnitude <= T::zero() {
            return Ok(T::zero());
        }
        if magnitude < side.smallest_thrust_n() {
            let smallest_n = (sign * side.smallest_thrust_n()).value();
            return Err(VehicleError::InDeadZone { thruster: 0, thrust_n: thrust_n.value(), smallest_n });
        }
        Ok(sign * side.command(magnitude))
    }

    /// The command whose thrust is nearest to the one asked for, on its side; halfway inside the dead zone it stands still.
    ///
    /// # Errors
    /// A thrust that is not finite.
    pub fn command_clamped(&self, thrust_n: T) -> Result<Delivered<T>, VehicleError> {
        domain::finite("thrust", thrust_n, "N")?;
        let (side, sign) = self.side(thrust_n);
        let magnitude = thrust_n.abs();
        let (smallest, largest) = (side.smallest_thrust_n(), side.largest_thrust_n());
        let stands = magnitude <= T::zero() || T::two() * magnitude <= smallest;
        let reached = if stands { T::zero() } else { magnitude.max(smallest).min(largest) };
        let command = if stands { T::zero() } else { side.command(reached) };
        Ok(Delivered { command: sign * command, thrust_n: sign * reached })
    }

    fn side(&self, thrust: T) -> (&ThrustSide<T>, T) {
        if thrust < T::zero() { (&self.backward, -T::one()) } else { (&self.forward, T::one()) }
    }
}
