//! Safe bounds of linear programmes (Neumaier and Shcherbina, *Mathematical Programming* 99, 2004; Jansson, *SIAM Journal on Optimization*
//! 14, 2004).

use crate::numeric::Interval;

/// Inequalities `sum_j a_kj z_j <= b_k`, each for some element of its interval coefficients, about deviations z within a box.
#[derive(Clone, Debug, Default)]
pub struct Inequalities {
    /// By row: the unknowns that it has, with their coefficients.
    pub coefficients: Vec<Vec<(usize, Interval)>>,
    /// Upper bounds b of the right-hand sides.
    pub limits: Vec<f64>,
}

/// Nonnegative multipliers by the number of the row.
pub type Multipliers = Vec<(usize, f64)>;

impl Inequalities {
    /// An upper bound of `c . z` over the z of the box that satisfy the inequalities. For any `y >= 0`
    /// `c . z <= sum_k y_k b_k + sum_j (c_j - sum_k y_k a_kj) z_j`, evaluated in intervals. With c = 0 a negative bound proves that no z
    /// does.
    pub fn upper_bound(&self, objective: &[(usize, f64)], multipliers: &Multipliers, deviations: &[Interval]) -> f64 {
        let mut reduced = vec![Interval::ZERO; deviations.len()];
        for (unknown, weight) in objective {
            reduced[*unknown] += Interval::point(*weight);
        }
        let mut bound = Interval::ZERO;
        for (row, y) in multipliers.iter().filter(|(_, y)| *y > 0.0) {
            let y = Interval::point(*y);
            bound += y * Interval::point(self.limits[*row]);
            for (unknown, coefficient) in &self.coefficients[*row] {
                reduced[*unknown] -= y * *coefficient;
            }
        }
        for (reduced, deviation) in reduced.into_iter().zip(deviations) {
            if reduced != Interval::ZERO {
                bound += reduced * *deviation;
            }
        }
        bound.upper()
    }
}
