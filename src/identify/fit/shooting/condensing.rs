//! Condensing of multiple shooting: block QR over a chain of shooting intervals, from the last to the first; the
//! cost grows with the samples only.
//!
//! Each shooting interval has two unknowns of its own, the state at its beginning, and perhaps a third, the instant of an edge. What
//! the shooting intervals after it say about its end is a triangle of rows; these are carried to its beginning by the motion's own
//! derivatives, never against the flow, where they would grow without bound.

use nalgebra::{DMatrix, DMatrixView};

use super::sensitivity::{COMMON, OutputSensitivity, SHARED, UNKNOWNS, UnknownsGradient};
use crate::identify::answer::IdentifyError;

/// Unknowns after the instant is eliminated.
const CARRIED: usize = UNKNOWNS - 1;
/// Unknowns of a record alone: initial state and disturbance.
pub(super) const OWN: usize = CARRIED - SHARED;

/// Rows of a shooting interval, each divided by its standard deviation: unknowns, then right-hand sides.
#[derive(Clone, Debug)]
pub(super) struct Link {
    /// Data and prior of the instant.
    pub(super) rows: DMatrix<f64>,
    /// Position and velocity at the end.
    pub(super) end: [UnknownsGradient; 2],
    /// Matching defect: the end of the shooting interval less the beginning of the next interval.
    pub(super) defect: [f64; 2],
}

/// Normal equations of a record for the common unknowns, and the map from them to its own unknowns.
#[derive(Clone, Debug)]
pub(super) struct CondensedChain {
    /// For each shooting interval the row that gives its instant.
    instants: Vec<DMatrix<f64>>,
    ends: Vec<([UnknownsGradient; 2], [f64; 2])>,
    /// Triangle of the initial state, the disturbance and the common unknowns.
    triangle: DMatrix<f64>,
}

/// Upper triangle of the unknowns in the first `columns` columns, with the right-hand sides turned the same way.
fn triangle(rows: &DMatrix<f64>, columns: usize) -> DMatrix<f64> {
    let sides = rows.ncols() - columns;
    let mut unknowns = rows.columns(0, columns).into_owned();
    let mut right = rows.columns(columns, sides).into_owned();
    if rows.nrows() < columns {
        unknowns.resize_vertically_mut(columns, 0.0);
        right.resize_vertically_mut(columns, 0.0);
    }
    let qr = unknowns.qr();
    if sides == 1 {
        qr.q_tr_mul(&mut right);
    } else {
        // A single product for all right-hand sides takes a quarter of the reflections' time.
        right = qr.q().transpose() * right;
    }
    let mut upper = qr.unpack_r().resize_horizontally(columns + sides, 0.0);
    upper.columns_mut(columns, sides).copy_from(&right.rows(0, columns));
    upper
}

impl CondensedChain {
    /// Eliminates from the last shooting interval to the first. Every link has as many right-hand sides; defects count for the first.
    pub(super) fn new(links: &[Link]) -> Self {
        let mut instants = Vec::with_capacity(links.len());
        let mut carried: Option<DMatrix<f64>> = None;
        for link in links.iter().rev() {
            let own = link.rows.nrows();
            let sides = link.rows.ncols() - UNKNOWNS;
            let after = carried.as_ref().map_or(0, DMatrix::nrows);
            let stacked = DMatrix::from_fn(own + after, UNKNOWNS + sides, |row, column| {
                let Some(row) = row.checked_sub(own) else { return link.rows[(row, column)] };
                let Some(rows) = carried.as_ref() else { return 0.0 };
                let (position, velocity) = (rows[(row, 0)], rows[(row, 1)]);
                match column.checked_sub(UNKNOWNS) {
                    Some(0) => rows[(row, CARRIED)] - position * link.defect[0] - velocity * link.defect[1],
                    Some(side) => rows[(row, CARRIED + side)],
                    None => {
                        let direct = if column > 2 { rows[(row, column - 1)] } else { 0.0 };
                        direct + position * link.end[0][column] + velocity * link.end[1][column]
                    }
                }
            });
            let upper = triangle(&stacked, UNKNOWNS);
            instants.push(upper.rows(0, 1).into_owned());
            carried = Some(upper.view((1, 1), (CARRIED, CARRIED + sides)).into_owned());
        }
        instants.reverse();
        let ends = links.iter().map(|link| (link.end, link.defect)).collect();
        Self { instants, ends, triangle: carried.unwrap_or_else(|| DMatrix::zeros(CARRIED, CARRIED + 1)) }
    }

    /// Rows about the common unknowns.
    pub(super) fn shared(&self) -> DMatrixView<'_, f64> {
        self.triangle.view((OWN, OWN), (SHARED, self.triangle.ncols() - OWN))
    }

    /// Sum over the shooting intervals of the logarithm of the instant's information, as a standard deviation's inverse.
    pub(super) fn log_information(&self) -> impl Iterator<Item = f64> {
        self.instants.iter().map(|row| libm::log(row[(0, 0)].abs()))
    }

    /// The record's own unknowns (position, velocity, disturbance), given the common unknowns, for a right-hand side.
    pub(super) fn own(&self, shared: &[f64; SHARED], side: usize) -> Result<[f64; OWN], IdentifyError> {
        let mut own = [0.0; OWN];
        for row in (0..OWN).rev() {
            let known: f64 = (row + 1..OWN).map(|column| self.triangle[(row, column)] * own[column]).sum();
            let common: f64 = (0..SHARED).map(|k| self.triangle[(row, OWN + k)] * shared[k]).sum();
            let value = (self.triangle[(row, CARRIED + side)] - known - common) / self.triangle[(row, row)];
            if !value.is_finite() {
                return Err(IdentifyError::Confounded { ratio: 0.0 });
            }
            own[row] = value;
        }
        Ok(own)
    }

    /// Inverse triangle of the record's own unknowns, for their covariance: rows own, columns own then common.
    pub(super) fn own_triangle(&self) -> DMatrixView<'_, f64> {
        self.triangle.view((0, 0), (OWN, CARRIED))
    }

    /// All unknowns of every shooting interval, from the record's own and the common unknowns.
    pub(super) fn unfold(&self, own: [f64; OWN], shared: &[f64; SHARED]) -> Vec<UnknownsGradient> {
        let mut unknowns: UnknownsGradient = [0.0; UNKNOWNS];
        unknowns[1..COMMON].copy_from_slice(&own);
        unknowns[COMMON..].copy_from_slice(shared);
        let mut all = Vec::with_capacity(self.instants.len());
        for (row, (end, defect)) in self.instants.iter().zip(&self.ends) {
            let rest: f64 = (1..UNKNOWNS).map(|column| row[(0, column)] * unknowns[column]).sum();
            unknowns[0] = (row[(0, UNKNOWNS)] - rest) / row[(0, 0)];
            all.push(unknowns);
            let next = [0, 1].map(|k| {
                defect[k] + end[k].iter().zip(&unknowns).map(|(derivative, step)| derivative * step).sum::<f64>()
            });
            unknowns[1..3].copy_from_slice(&next);
        }
        all
    }
}

/// Solution for the common unknowns of all records' rows; `fixed` unknowns keep the given value. A column per right-hand side.
pub(super) fn solve_shared(
    rows: &DMatrix<f64>,
    fixed: &[Option<f64>; SHARED],
) -> Result<(Vec<[f64; SHARED]>, DMatrix<f64>), IdentifyError> {
    let free: Vec<usize> = (0..SHARED).filter(|k| fixed[*k].is_none()).collect();
    let (count, sides) = (free.len(), rows.ncols() - SHARED);
    let reduced = DMatrix::from_fn(rows.nrows(), count + sides, |row, column| match column.checked_sub(count) {
        None => rows[(row, free[column])],
        Some(side) => {
            let taken: f64 = (0..SHARED).filter_map(|k| Some(rows[(row, k)] * fixed[k]?)).sum();
            rows[(row, SHARED + side)] - taken
        }
    });
    let upper = triangle(&reduced, count);
    let mut solutions = Vec::with_capacity(sides);
    for side in 0..sides {
        let mut solution = fixed.map(|value| value.unwrap_or(0.0));
        for row in (0..count).rev() {
            let known: f64 = (row + 1..count).map(|column| upper[(row, column)] * solution[free[column]]).sum();
            let value = (upper[(row, count + side)] - known) / upper[(row, row)];
            if !value.is_finite() {
                return Err(IdentifyError::Confounded { ratio: 0.0 });
            }
            solution[free[row]] = value;
        }
        solutions.push(solution);
    }
    Ok((solutions, upper.view((0, 0), (count, count)).into_owned()))
}

/// A row of a link.
pub(super) fn weighted(sensitive: &OutputSensitivity, weight: f64) -> UnknownsGradient {
    sensitive.gradient.map(|derivative| derivative * weight)
}
