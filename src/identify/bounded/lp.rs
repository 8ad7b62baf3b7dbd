//! Linear programmes with few unknowns and many inequalities: the dual simplex method, and what its answer is worth.
//!
//! The method is not trusted: what it gives are multipliers, and [`Rows::upper_bound`] makes a bound of any nonnegative ones.

use crate::numeric::Interval;

pub(super) use programme::Programme;

mod programme;
#[cfg(test)]
mod tests;
mod vertex;

/// Inequalities `sum_j slopes_j z_j <= limit` for every element of the slopes, about deviations z within a box.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows {
    /// For each row the unknowns it has, with the slope.
    pub(super) slopes: Vec<Vec<(usize, Interval)>>,
    /// Upper bounds of the right-hand sides.
    pub(super) limits: Vec<f64>,
}

/// A nonnegative combination of rows.
pub(super) type Multipliers = Vec<(usize, f64)>;

/// What a linear programme gave.
#[derive(Clone, Debug)]
pub(super) enum Outcome {
    /// Multipliers that bound the objective, and where the relaxed problem reaches the bound.
    Bounded { multipliers: Multipliers, at: Vec<f64> },
    /// A combination of rows that no point of the box satisfies.
    Empty { multipliers: Multipliers },
}

impl Rows {
    /// An upper bound of `objective . z` over all z in the `deviations` that meet the rows for some element of their slopes:
    /// `sum y_k limit_k + sum_j (objective_j - sum_k y_k slopes_kj) z_j` for whatever multipliers `y >= 0` are given (Neumaier and Shcherbina 2004).
    /// With the objective zero, a negative bound says that there are none.
    pub(super) fn upper_bound(
        &self,
        objective: &[(usize, f64)],
        multipliers: &Multipliers,
        deviations: &[Interval],
    ) -> f64 {
        let mut rest = vec![Interval::ZERO; deviations.len()];
        for (unknown, weight) in objective {
            rest[*unknown] += Interval::point(*weight);
        }
        let mut bound = Interval::ZERO;
        for (row, y) in multipliers.iter().filter(|(_, y)| *y > 0.0) {
            let y = Interval::point(*y);
            bound += y * Interval::point(self.limits[*row]);
            for (unknown, slope) in &self.slopes[*row] {
                rest[*unknown] -= y * *slope;
            }
        }
        for (rest, deviation) in rest.into_iter().zip(deviations) {
            if rest != Interval::ZERO {
                bound += rest * *deviation;
            }
        }
        bound.upper()
    }
}
