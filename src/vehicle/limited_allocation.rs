//! Control allocation within thrust limits: bounded weighted least squares by an active-set method.

use crate::numeric::{Limit, domain};
use nalgebra::{DMatrix, DVector};

use super::{Allocation, VehicleError};

/// Weighted least squares within bounds: the thrusts that minimise `|W (B tau - forces)|^2 + effort |tau|^2` subject to
/// `lower <= tau <= upper`.
///
/// The effort term makes the answer unique when thrusters outnumber axes; it also pulls reachable forces short of the demand
/// by a fraction of about `effort / s^2`, `s` the smallest singular value of `W B`.
///
/// ```
/// # use selfosc::vehicle::{Allocation, LimitedAllocation, VehicleError};
/// let pair = Allocation::pair(0.08)?;
/// // Yaw matters more than surge; the propellers push 4 N ahead, 2 N astern.
/// let limited = LimitedAllocation::new(pair, [1.0, 100.0], [(-2.0, 4.0); 2], 1e-9)?;
/// let answer = limited.thrusts(&[0.0, 0.4])?; // 2.5 N each way is too much astern
/// assert!(answer.saturated[1] && (answer.thrusts_n[1] + 2.0).abs() < 1e-12);
/// assert!((answer.forces[1] - 0.4).abs() < 0.02); // heading kept, at the price of surge
/// # Ok::<(), VehicleError>(())
/// ```
#[derive(Debug, Clone)]
pub struct LimitedAllocation<const AXES: usize, const THRUSTERS: usize> {
    allocation: Allocation<f64, AXES, THRUSTERS>,
    weights: [f64; AXES],
    limits_n: [(f64, f64); THRUSTERS],
    /// The weighted matrix over the square root of the effort weight.
    stacked: DMatrix<f64>,
}

/// Thrusts within limits and what they give.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitedThrusts<const AXES: usize, const THRUSTERS: usize> {
    /// Thrusts, N.
    pub thrusts_n: [f64; THRUSTERS],
    /// Forces on the axes from these thrusts.
    pub forces: [f64; AXES],
    /// Thrusters held at a limit.
    pub saturated: [bool; THRUSTERS],
}

/// Where a thruster stands in the search.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    Free,
    Lower,
    Upper,
}

impl<const AXES: usize, const THRUSTERS: usize> LimitedAllocation<AXES, THRUSTERS> {
    /// Exchanges allowed for each thruster; a handful is usual.
    const EXCHANGES: usize = 20;

    /// An allocation with a weight for each axis, limits `(lower, upper)` in N for each thruster and an effort weight.
    ///
    /// Weights balance the units: 1 N m on a short arm deserves more than 1 N. An effort weight of 1e-9 of the squared
    /// weighted matrix entries is a good start.
    ///
    /// # Errors
    /// Weights or effort that are not positive, limits that are not finite or not in order.
    pub fn new(
        allocation: Allocation<f64, AXES, THRUSTERS>,
        weights: [f64; AXES],
        limits_n: [(f64, f64); THRUSTERS],
        effort: f64,
    ) -> Result<Self, VehicleError> {
        for &weight in &weights {
            domain::positive("axis weight", weight, "")?;
        }
        for &(lower, upper) in &limits_n {
            domain::finite("lower thrust limit", lower, "N")?;
            let remedy = "give the limits astern first, then ahead";
            domain::require("upper thrust limit", upper, "N", Limit::Above(lower), remedy)?;
        }
        domain::positive("effort weight", effort, "")?;
        let matrix = allocation.matrix();
        let stacked = DMatrix::from_fn(AXES + THRUSTERS, THRUSTERS, |i, j| match i.checked_sub(AXES) {
            None => weights[i] * matrix[i][j],
            Some(row) if row == j => effort.sqrt(),
            Some(_) => 0.0,
        });
        Ok(Self { allocation, weights, limits_n, stacked })
    }

    /// The best thrusts within the limits.
    ///
    /// An active-set search: solve for the free thrusters, stop at the first limit reached, and release a thruster at its limit whose
    /// multiplier is negative, until none remains.
    ///
    /// # Errors
    /// Forces that are not finite or whose weighted square is not; [`VehicleError::NoConvergence`] when rounding makes the
    /// search cycle.
    pub fn thrusts(&self, forces: &[f64; AXES]) -> Result<LimitedThrusts<AXES, THRUSTERS>, VehicleError> {
        for (&force, &weight) in forces.iter().zip(&self.weights) {
            let squares = |f: f64| (weight * f).powi(2).is_finite();
            let limit = Limit::Words("small enough for its weighted square");
            domain::require_that(squares(force), "force or moment", force, "N, N m", limit, "ask for less")?;
        }
        let target =
            DVector::from_fn(AXES + THRUSTERS, |i, _| if i < AXES { self.weights[i] * forces[i] } else { 0.0 });
        // Gradients below this are rounding.
        let negligible = 1e-12 * (self.stacked.amax() * (target.amax() + self.stacked.amax() * self.largest_limit_n()));
        let mut places = [Place::Free; THRUSTERS];
        let mut thrusts = DVector::from_fn(THRUSTERS, |j, _| 0.0_f64.clamp(self.limits_n[j].0, self.limits_n[j].1));
        for _ in 0..Self::EXCHANGES * (THRUSTERS + 1) {
            let step = self.free_step(&places, &target, &thrusts)?;
            if let Some((fraction, blocked, place)) = self.first_limit(&places, &thrusts, &step) {
                thrusts += step * fraction;
                thrusts[blocked] =
                    if place == Place::Lower { self.limits_n[blocked].0 } else { self.limits_n[blocked].1 };
                places[blocked] = place;
                continue;
            }
            thrusts += step;
            let gradient = self.stacked.tr_mul(&(&self.stacked * &thrusts - &target));
            // Minus the Lagrange multiplier of a thruster's limit: above zero if releasing it lowers the cost.
            let gain = |j: usize| match places[j] {
                Place::Free => 0.0,
                Place::Lower => -gradient[j],
                Place::Upper => gradient[j],
            };
            match (0..THRUSTERS).max_by(|&i, &j| gain(i).total_cmp(&gain(j))).filter(|&j| gain(j) > negligible) {
                Some(released) => places[released] = Place::Free,
                None => return Ok(self.answer(&thrusts, places)),
            }
        }
        Err(VehicleError::NoConvergence { what: "the search for thrusts within limits" })
    }

    fn largest_limit_n(&self) -> f64 {
        self.limits_n.iter().fold(0.0, |largest, &(lower, upper)| lower.abs().max(upper.abs()).max(largest))
    }

    /// The step to the least-squares optimum of the free thrusters, with the rest at their limits.
    fn free_step(
        &self,
        places: &[Place; THRUSTERS],
        target: &DVector<f64>,
        thrusts: &DVector<f64>,
    ) -> Result<DVector<f64>, VehicleError> {
        let free: Vec<usize> = (0..THRUSTERS).filter(|&j| places[j] == Place::Free).collect();
        let mut step = DVector::zeros(THRUSTERS);
        if free.is_empty() {
            return Ok(step);
        }
        let residual = target - &self.stacked * thrusts;
        let columns = self.stacked.select_columns(&free);
        let qr = columns.qr();
        let solved = qr.r().solve_upper_triangular(&qr.q().tr_mul(&residual)).ok_or(VehicleError::RankDeficient {
            what: "the weighted allocation of the free thrusters",
            rank: free.len() - 1,
            needed: free.len(),
        })?;
        for (&j, &value) in free.iter().zip(solved.iter()) {
            step[j] = value;
        }
        Ok(step)
    }

    /// The first limit a free thruster meets along a step, as a fraction of the step.
    fn first_limit(
        &self,
        places: &[Place; THRUSTERS],
        thrusts: &DVector<f64>,
        step: &DVector<f64>,
    ) -> Option<(f64, usize, Place)> {
        (0..THRUSTERS)
            .filter(|&j| places[j] == Place::Free)
            .filter_map(|j| {
                let (lower, upper) = self.limits_n[j];
                let end = thrusts[j] + step[j];
                if end < lower {
                    Some(((lower - thrusts[j]) / step[j], j, Place::Lower))
                } else if end > upper {
                    Some(((upper - thrusts[j]) / step[j], j, Place::Upper))
                } else {
                    None
                }
            })
            .min_by(|a, b| a.0.total_cmp(&b.0))
    }

    fn answer(&self, thrusts: &DVector<f64>, places: [Place; THRUSTERS]) -> LimitedThrusts<AXES, THRUSTERS> {
        let thrusts_n = core::array::from_fn(|j| thrusts[j]);
        LimitedThrusts {
            thrusts_n,
            forces: self.allocation.forces(&thrusts_n),
            saturated: places.map(|place| place != Place::Free),
        }
    }
}
