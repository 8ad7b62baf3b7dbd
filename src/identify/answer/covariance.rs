//! How the coefficients of the drag vary together.

use serde::{Deserialize, Serialize};

use super::Estimate;
use super::distribution::NORMAL_95;

/// Covariances in the order of linear, quadratic and cubic drag.
type DragMatrix = [[f64; 3]; 3];

/// Covariance of linear, quadratic and cubic drag, in this order. It is that of all models averaged: rows of the cubic drag count where
/// some of them have it, whether or not it is reported.
///
/// A record shows the force of the drag. Where more of one coefficient makes up for less of another, their intervals are far wider than
/// that force's. A function `f` of the coefficients with derivatives `J` has the standard deviation `sqrt(J C J^T)` (JCGM 100:2008, eq. 13).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DragCovariance {
    /// Of the record's scatter, the choice among the models included: on the diagonal the squares of [`std`](super::ConfidenceInterval::std).
    pub statistical: [[f64; 3]; 3],
    /// Of the practical intervals: on the diagonal the squares of their `std`, to be taken twice (JCGM 100:2008, 6.2). `None` outside of
    /// [`Reported`](super::Reported).
    pub combined: Option<[[f64; 3]; 3]>,
}

impl DragCovariance {
    /// With the deviations of the estimates' intervals and the correlations of a matrix. `None` where it is no finite matrix.
    pub(crate) fn of(correlated: DragMatrix, drags: [Option<Estimate>; 3]) -> Option<Self> {
        let std = drags.map(|drag| Some(drag?.spread?.std));
        Some(Self::statistical(scaled(correlated, std))).filter(Self::is_finite)
    }

    /// Of the record's scatter alone.
    pub(crate) fn statistical(statistical: DragMatrix) -> Self {
        Self { statistical, combined: None }
    }

    fn is_finite(&self) -> bool {
        self.statistical.iter().flatten().all(|entry| entry.is_finite())
    }

    /// In new units of force.
    pub(crate) fn in_units(self, factor: f64) -> Self {
        Self::statistical(matrix(|i, j| factor * factor * self.statistical[i][j]))
    }

    /// With a relative error that the coefficients share.
    pub(crate) fn with_error(self, relative: f64, values: [f64; 3]) -> Self {
        let shared = |i: usize, j: usize| relative * relative * values[i] * values[j];
        Self::statistical(matrix(|i, j| self.statistical[i][j] + shared(i, j)))
    }

    /// With the practical covariance: `(2 h)^2 + declared^2` is four times its diagonal, with `h` the half-width of a normal interval; on its
    /// diagonal the practical intervals' own.
    pub(super) fn with_declared(self, declared: DragMatrix, drags: [Option<Estimate>; 3]) -> Self {
        let half_width = NORMAL_95 * NORMAL_95;
        let combined = matrix(|i, j| half_width * self.statistical[i][j] + 0.25 * declared[i][j]);
        Self { combined: Some(scaled(combined, drags.map(|drag| Some(drag?.combined?.std)))), ..self }
    }
}

/// With these deviations and the correlations of a covariance; as it is where there is no deviation.
fn scaled(covariance: DragMatrix, std: [Option<f64>; 3]) -> DragMatrix {
    let scale = |i: usize| {
        let own = covariance[i][i];
        std[i].filter(|_| own > 0.0).map_or(1.0, |std| std / own.sqrt())
    };
    matrix(|i, j| scale(i) * scale(j) * covariance[i][j])
}

/// The matrix of these entries.
pub(crate) fn matrix(entry: impl Fn(usize, usize) -> f64) -> DragMatrix {
    core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j)))
}
