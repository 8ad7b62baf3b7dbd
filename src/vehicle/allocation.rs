//! Forces on the vehicle by thrusts of its thrusters, and back.

use super::VehicleError;
use crate::numeric::{Real, Scalar, domain};

/// The allocation `forces = matrix * thrusts` with a right or least-squares inverse, both of fixed size.
///
/// Units are those of the matrix: a row of ones gives N, a row of lever arms in m gives N m.
///
/// ```
/// # use selfosc::vehicle::{Allocation, VehicleError};
/// let pair = Allocation::pair(0.08_f64)?;
/// let [port, starboard] = pair.thrusts(&[1.0, 0.04]); // 1 N ahead, 0.04 N m
/// assert!((port - 0.75).abs() < 1e-15 && (starboard - 0.25).abs() < 1e-15);
/// # Ok::<(), VehicleError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allocation<T, const AXES: usize, const THRUSTERS: usize> {
    matrix: [[T; THRUSTERS]; AXES],
    inverse: [[T; AXES]; THRUSTERS],
}

/// A matrix of rows times a column.
fn product<T: Real, const R: usize, const C: usize>(rows: &[[T; C]; R], column: &[T; C]) -> [T; R] {
    rows.map(|row| row.iter().zip(column).fold(T::zero(), |sum, (&a, &b)| sum + a * b))
}

impl<T: Scalar> Allocation<T, 1, 1> {
    /// One thruster on its own axis.
    #[must_use]
    pub fn single() -> Self {
        Self { matrix: [[T::one()]], inverse: [[T::one()]] }
    }
}

impl<T: Real> Allocation<T, 2, 2> {
    /// Two parallel thrusters at distances `+-arm_m` from the vehicle's axis (eq. 35): `X = tau_1 + tau_2`,
    /// `N = arm (tau_1 - tau_2)`.
    ///
    /// # Errors
    /// An arm that is not positive.
    pub fn pair(arm_m: T) -> Result<Self, VehicleError> {
        domain::positive("lever arm", arm_m, "m")?;
        let (one, half) = (T::one(), T::from_f64(0.5));
        domain::representable("inverse of the lever arm", half / arm_m, "1/m")?;
        Ok(Self { matrix: [[one, one], [arm_m, -arm_m]], inverse: [[half, half / arm_m], [half, -half / arm_m]] })
    }
}

impl<T: Real, const AXES: usize, const THRUSTERS: usize> Allocation<T, AXES, THRUSTERS> {
    /// The matrix, a row for each axis.
    pub fn matrix(&self) -> &[[T; THRUSTERS]; AXES] {
        &self.matrix
    }

    /// The inverse, a row for each thruster.
    pub fn inverse(&self) -> &[[T; AXES]; THRUSTERS] {
        &self.inverse
    }

    /// Forces and moments on the axes from thrusts.
    pub fn forces(&self, thrusts_n: &[T; THRUSTERS]) -> [T; AXES] {
        product(&self.matrix, thrusts_n)
    }

    /// Thrusts for forces and moments on the axes, no limits considered.
    ///
    /// With at least as many thrusters as axes the forces are met exactly by the thrusts of least square sum; with fewer,
    /// they are met in least squares only: compare with [`Self::forces`].
    pub fn thrusts(&self, forces: &[T; AXES]) -> [T; THRUSTERS] {
        product(&self.inverse, forces)
    }
}

#[cfg(feature = "std")]
impl<const AXES: usize, const THRUSTERS: usize> Allocation<f64, AXES, THRUSTERS> {
    /// Smallest pivot, relative to the largest, that still counts as rank.
    const RANK_TOLERANCE: f64 = 1e-10;

    /// The allocation of a matrix, a row for each axis, with its pseudo-inverse.
    ///
    /// # Errors
    /// [`VehicleError::RankDeficient`] when thrusters cannot act on the axes independently (or when, fewer than the axes,
    /// they repeat each other), a matrix without rows or columns, and entries that are not finite.
    pub fn from_matrix(matrix: [[f64; THRUSTERS]; AXES]) -> Result<Self, VehicleError> {
        for &entry in matrix.iter().flatten() {
            domain::finite("entry of the allocation matrix", entry, "")?;
        }
        if AXES == 0 || THRUSTERS == 0 {
            return Err(VehicleError::Count { what: "axes or thrusters", count: 0, needed: 1 });
        }
        // Scaled to 1, so that no square overflows.
        let largest = matrix.iter().flatten().fold(0.0, |largest: f64, entry| largest.max(entry.abs()));
        let size = if largest > 0.0 { largest } else { 1.0 };
        // The tall one of the matrix and its transpose, by QR with column pivoting: `A P = Q R`.
        let wide = AXES < THRUSTERS;
        let needed = AXES.min(THRUSTERS);
        let tall = nalgebra::DMatrix::from_fn(AXES.max(THRUSTERS), needed, |i, j| {
            if wide { matrix[j][i] / size } else { matrix[i][j] / size }
        });
        let (q, r, order) = tall.col_piv_qr().unpack();
        let rank = r.diagonal().iter().filter(|pivot| pivot.abs() > r[(0, 0)].abs() * Self::RANK_TOLERANCE).count();
        let deficient = VehicleError::RankDeficient { what: "the allocation matrix", rank, needed };
        if rank < needed {
            return Err(deficient);
        }
        let mut inverse = r.solve_upper_triangular(&q.transpose()).ok_or(deficient)?;
        order.inv_permute_rows(&mut inverse);
        let entry = |i: usize, j: usize| if wide { inverse[(j, i)] / size } else { inverse[(i, j)] / size };
        for &unscaled in inverse.iter() {
            domain::representable("entry of the allocation's inverse", unscaled / size, "")?;
        }
        Ok(Self { matrix, inverse: core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j))) })
    }
}
