//! The a-priori compensation (Fig. 11): what makes allocation, thruster map and dead zone vanish for the controller.

use super::{Allocation, Thruster, VehicleError};
use crate::numeric::{Limit, Scalar, domain};

/// Inverse allocation, a constant thrust offset, inverse thruster maps, in this order.
///
/// Through the same thrusters and allocation, the produced forces are the requested forces plus [`Self::bias_forces`], exactly up to
/// rounding, as long as no thruster saturates or enters its dead zone; [`Self::commands`] reports either. Nothing is
/// promised when there are fewer thrusters than axes, or when the real thrusters differ from the ones given here.
///
/// ```
/// # use selfosc::vehicle::{Allocation, Compensation, Thruster, VehicleError};
/// let thruster = Thruster::affine(1.5e-4_f64, 0.01, 15.0, 200.0)?;
/// // A yaw experiment up to 0.1 N m: both propellers turn ahead all the time.
/// let chain = Compensation::against_dead_zone(Allocation::pair(0.08)?, [thruster; 2], [1.0, 1.0], [0.0, 0.1])?;
/// let [ahead, turning] = chain.delivered(&chain.commands(&[0.0, 0.003])?, &[thruster; 2]);
/// assert!((turning - 0.003).abs() < 1e-12);
/// assert!((ahead - chain.bias_forces()[0]).abs() < 1e-12 && ahead > 1.0); // the price is a push ahead
/// # Ok::<(), VehicleError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compensation<T, const AXES: usize, const THRUSTERS: usize> {
    allocation: Allocation<T, AXES, THRUSTERS>,
    thrusters: [Thruster<T>; THRUSTERS],
    offset_n: [T; THRUSTERS],
}

impl<T: Scalar, const AXES: usize, const THRUSTERS: usize> Compensation<T, AXES, THRUSTERS> {
    /// A chain without offset: forces that ask a thruster for less than its slowest rotation gives are refused.
    pub fn new(allocation: Allocation<T, AXES, THRUSTERS>, thrusters: [Thruster<T>; THRUSTERS]) -> Self {
        Self { allocation, thrusters, offset_n: [T::zero(); THRUSTERS] }
    }

    /// A chain with the smallest offset along `direction` (a number per thruster) for which no thruster leaves its side
    /// of the dead zone while the forces stay within `+-largest_forces`.
    ///
    /// A direction that the allocation maps to zero, two thrusters that push against each other, costs nothing but power;
    /// else the vehicle feels [`Self::bias_forces`].
    ///
    /// # Errors
    /// [`VehicleError::Saturated`] when some thruster cannot give offset and largest force together; a direction with a
    /// zero in it; numbers that are not finite, largest forces below zero.
    pub fn against_dead_zone(
        allocation: Allocation<T, AXES, THRUSTERS>,
        thrusters: [Thruster<T>; THRUSTERS],
        direction: [T; THRUSTERS],
        largest_forces: [T; AXES],
    ) -> Result<Self, VehicleError> {
        for &force in &largest_forces {
            domain::non_negative("largest force of the compensation", force, "N, N m")?;
        }
        // What the forces can ask of a thruster, either way.
        let swing = allocation.inverse().map(|row| {
            row.iter().zip(&largest_forces).fold(T::zero(), |sum, (&weight, &force)| sum + weight.abs() * force)
        });
        let mut scale = T::zero();
        for ((thruster, &along), &swing) in thrusters.iter().zip(&direction).zip(&swing) {
            domain::require(
                "offset direction",
                along,
                "N",
                Limit::NonZero,
                "choose a direction that turns every thruster",
            )?;
            let side = if along < T::zero() { thruster.backward() } else { thruster.forward() };
            scale = scale.max((swing + side.smallest_thrust_n()) / along.abs());
        }
        // Rounding at the extreme force must not fall back into the dead zone.
        scale = scale * (T::one() + T::from_f64(16.0) * T::epsilon());
        let offset_n = direction.map(|along| scale * along);
        for (index, ((thruster, &offset), &swing)) in thrusters.iter().zip(&offset_n).zip(&swing).enumerate() {
            let extreme = if offset < T::zero() { offset - swing } else { offset + swing };
            thruster.command(extreme).map_err(|refusal| refusal.of_thruster(index))?;
        }
        Ok(Self { allocation, thrusters, offset_n })
    }

    /// The constant thrusts added, N.
    pub fn offset_n(&self) -> &[T; THRUSTERS] {
        &self.offset_n
    }

    /// The constant forces the offset exerts on the axes.
    pub fn bias_forces(&self) -> [T; AXES] {
        self.allocation.forces(&self.offset_n)
    }

    /// Thruster commands for forces on the axes.
    ///
    /// # Errors
    /// [`VehicleError::Saturated`] and [`VehicleError::InDeadZone`] with the thruster's number; forces that are not finite.
    pub fn commands(&self, forces: &[T; AXES]) -> Result<[T; THRUSTERS], VehicleError> {
        self.each_thruster(forces, Thruster::command)
    }

    /// Thruster commands for forces on the axes, each thruster clamped to what it can do; what then arrives is
    /// [`Self::delivered`] of the commands.
    ///
    /// # Errors
    /// Forces that are not finite.
    pub fn commands_clamped(&self, forces: &[T; AXES]) -> Result<[T; THRUSTERS], VehicleError> {
        self.each_thruster(forces, |thruster, thrust_n| Ok(thruster.command_clamped(thrust_n)?.command))
    }

    /// Forces on the axes when `actual` thrusters receive these commands.
    pub fn delivered(&self, commands: &[T; THRUSTERS], actual: &[Thruster<T>; THRUSTERS]) -> [T; AXES] {
        self.allocation.forces(&core::array::from_fn(|i| actual[i].thrust(commands[i])))
    }

    fn each_thruster(
        &self,
        forces: &[T; AXES],
        invert: impl Fn(&Thruster<T>, T) -> Result<T, VehicleError>,
    ) -> Result<[T; THRUSTERS], VehicleError> {
        for &force in forces {
            domain::finite("force or moment", force, "N, N m")?;
        }
        let thrusts_n = self.allocation.thrusts(forces);
        let mut commands = [T::zero(); THRUSTERS];
        for (index, command) in commands.iter_mut().enumerate() {
            let thrust_n = thrusts_n[index] + self.offset_n[index];
            *command = invert(&self.thrusters[index], thrust_n).map_err(|refusal| refusal.of_thruster(index))?;
        }
        Ok(commands)
    }
}
