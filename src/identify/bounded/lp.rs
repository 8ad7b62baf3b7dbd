//! Linear programmes with few unknowns and many inequalities: the dual simplex method, and what its answer is worth.
//!
//! The method is not trusted: what it gives are multipliers, and [`Rows::upper_bound`] makes a bound of any nonnegative ones.

use crate::numeric::Interval;

#[cfg(test)]
mod tests;

/// Pivots before the method gives up; what it has then still gives a bound.
const MOST_PIVOTS: usize = 2000;
/// A row counts as met that is missed by less than this, in units of its scale.
const MET: f64 = 1e-9;
/// Of the objective, against ties.
const PERTURBATION: f64 = 1e-8;
/// Pivots below this are none.
const LEAST_PIVOT: f64 = 1e-9;

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

/// The rows in floating point, each scaled, over the box scaled to `[-1, 1]`.
pub(super) struct Programme {
    /// Which unknowns it has.
    places: Vec<usize>,
    /// Row by row: column and entry.
    entries: Vec<(u32, f64)>,
    /// Where each row begins in the entries, and behind the last.
    begins: Vec<usize>,
    limits: Vec<f64>,
    /// Scale of each row.
    scales: Vec<f64>,
    centre: Vec<f64>,
    radius: Vec<f64>,
}

impl Programme {
    /// Of the midpoints, the rest of each slope's range taken from the limit. The rows have no unknowns but `places`.
    pub(super) fn of(rows: &Rows, deviations: &[Interval], places: &[usize]) -> Self {
        let mut column = vec![u32::MAX; deviations.len()];
        for (index, place) in places.iter().enumerate() {
            column[*place] = index as u32;
        }
        let own = |value: &dyn Fn(Interval) -> f64| places.iter().map(|place| value(deviations[*place])).collect();
        let mut programme = Self {
            places: places.to_vec(),
            entries: Vec::new(),
            begins: vec![0],
            limits: Vec::with_capacity(rows.limits.len()),
            scales: Vec::with_capacity(rows.limits.len()),
            centre: own(&|z| z.midpoint()),
            radius: own(&|z| z.radius().max(f64::MIN_POSITIVE)),
        };
        for (slopes, limit) in rows.slopes.iter().zip(&rows.limits) {
            let mut limit = *limit;
            let mut scale = 0.0f64;
            let begin = programme.entries.len();
            for (unknown, slope) in slopes {
                let index = column[*unknown];
                let Some(radius) = programme.radius.get(index as usize) else { continue };
                // Where the deviation has a sign, one end of the slope is the weakest everywhere.
                let deviation = deviations[*unknown];
                let middle = if deviation.lower() >= 0.0 {
                    slope.lower()
                } else if deviation.upper() <= 0.0 {
                    slope.upper()
                } else {
                    limit += slope.radius() * deviation.magnitude();
                    slope.midpoint()
                };
                limit -= middle * programme.centre[index as usize];
                let entry = middle * radius;
                scale = scale.max(entry.abs());
                programme.entries.push((index, entry));
            }
            let scale = if scale > 0.0 { 1.0 / scale } else { 1.0 };
            for (_, entry) in &mut programme.entries[begin..] {
                *entry *= scale;
            }
            programme.begins.push(programme.entries.len());
            programme.limits.push(limit * scale);
            programme.scales.push(scale);
        }
        programme
    }

    fn row(&self, index: usize) -> &[(u32, f64)] {
        &self.entries[self.begins[index]..self.begins[index + 1]]
    }

    /// Constraint number: a row, or behind them the upper and lower side of each unknown.
    fn constraint(&self, index: usize, into: &mut [f64]) -> f64 {
        let rows = self.limits.len();
        if index < rows {
            into.fill(0.0);
            self.row(index).iter().for_each(|(column, entry)| into[*column as usize] = *entry);
            return self.limits[index];
        }
        into.fill(0.0);
        let (j, lower) = ((index - rows) / 2, (index - rows) % 2 == 1);
        into[j] = if lower { -1.0 } else { 1.0 };
        1.0
    }

    /// Maximises the objective.
    pub(super) fn maximise(&self, objective: &[(usize, f64)]) -> Outcome {
        let (n, rows) = (self.places.len(), self.limits.len());
        let mut scaled = vec![0.0; n];
        for (unknown, weight) in objective {
            if let Some(column) = self.places.iter().position(|place| place == unknown) {
                scaled[column] += weight * self.radius[column];
            }
        }
        let largest = scaled.iter().fold(0.0f64, |largest, c| largest.max(c.abs()));
        let truth = scaled.clone();
        // A little of everything else, so that no two vertices are equally good.
        let unit = if largest > 0.0 { largest } else { 1.0 };
        for (j, c) in scaled.iter_mut().enumerate() {
            let odd = 1.0 + ((j * 7919 + 13) % 101) as f64 / 101.0;
            *c += PERTURBATION * unit * if *c < 0.0 { -odd } else { odd };
        }
        let mut basis: Vec<usize> = (0..n).map(|j| rows + 2 * j + usize::from(scaled[j] < 0.0)).collect();
        // Columns of the inverse: z = inverse . limits of the basis.
        let mut inverse = vec![0.0; n * n];
        // Of its rows; without an unknown there are none.
        let across = n.max(1);
        let mut right = vec![1.0; n];
        let mut weights: Vec<f64> = scaled.iter().map(|c| c.abs()).collect();
        for j in 0..n {
            inverse[j * n + j] = if scaled[j] < 0.0 { -1.0 } else { 1.0 };
        }
        let mut z = vec![0.0; n];
        let mut entering = vec![0.0; n];
        let mut shares = vec![0.0; n];
        // Rows that were missed when all were looked at last.
        let mut near: Vec<usize> = Vec::new();
        for _ in 0..MOST_PIVOTS {
            for (z, row) in z.iter_mut().zip(inverse.chunks_exact(across)) {
                *z = row.iter().zip(&right).map(|(entry, right)| entry * right).sum();
            }
            let missed = |index: usize| {
                let row = self.row(index).iter();
                row.map(|(column, entry)| entry * z[*column as usize]).sum::<f64>() - self.limits[index]
            };
            let mut worst = (MET, usize::MAX);
            for &index in &near {
                let by = missed(index);
                if by > worst.0 {
                    worst = (by, index);
                }
            }
            if worst.1 == usize::MAX {
                near.clear();
                for index in 0..rows {
                    let by = missed(index);
                    if by > MET {
                        near.push(index);
                    }
                    if by > worst.0 {
                        worst = (by, index);
                    }
                }
            }
            for (j, z) in z.iter().enumerate() {
                if z.abs() - 1.0 > worst.0 {
                    worst = (z.abs() - 1.0, rows + 2 * j + usize::from(*z < 0.0));
                }
            }
            if worst.1 == usize::MAX {
                break;
            }
            let limit = self.constraint(worst.1, &mut entering);
            shares.fill(0.0);
            for (weight, row) in entering.iter().zip(inverse.chunks_exact(across)).filter(|(weight, _)| **weight != 0.0)
            {
                for (share, entry) in shares.iter_mut().zip(row) {
                    *share += weight * entry;
                }
            }
            let mut leaving = (f64::INFINITY, usize::MAX);
            for k in 0..n {
                if shares[k] > LEAST_PIVOT && weights[k] / shares[k] < leaving.0 {
                    leaving = (weights[k] / shares[k], k);
                }
            }
            let (step, out) = leaving;
            if out == usize::MAX {
                let mut multipliers: Multipliers =
                    if worst.1 < rows { vec![(worst.1, self.scales[worst.1])] } else { Vec::new() };
                for k in 0..n {
                    if basis[k] < rows && shares[k] < 0.0 {
                        multipliers.push((basis[k], -shares[k] * self.scales[basis[k]]));
                    }
                }
                return Outcome::Empty { multipliers };
            }
            for (weight, share) in weights.iter_mut().zip(&shares) {
                *weight = (*weight - step * share).max(0.0);
            }
            weights[out] = step;
            basis[out] = worst.1;
            right[out] = limit;
            let pivot = 1.0 / shares[out];
            for row in inverse.chunks_exact_mut(across) {
                let head = row[out] * pivot;
                for (entry, share) in row.iter_mut().zip(&shares) {
                    *entry -= share * head;
                }
                row[out] = head;
            }
        }
        let multipliers = (0..n)
            .filter(|k| basis[*k] < rows)
            .map(|k| {
                let weight: f64 = (0..n).map(|i| truth[i] * inverse[i * n + k]).sum();
                (basis[k], weight.max(0.0) * self.scales[basis[k]])
            })
            .filter(|(_, weight)| *weight > 0.0)
            .collect();
        let at = (0..n).map(|j| self.centre[j] + self.radius[j] * z[j]).collect();
        Outcome::Bounded { multipliers, at }
    }
}
