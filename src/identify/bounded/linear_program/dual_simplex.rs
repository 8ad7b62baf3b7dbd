//! The dual simplex method in floating point (Lemke 1954; Chvátal, *Linear Programming*, 1983, chapter 10).
//!
//! It begins at the corner of the box that is best by the objective: there every weight is nonnegative. While the vertex violates a
//! constraint, that constraint enters the basis and the first whose weight reaches zero leaves it.

use std::collections::BTreeSet;

use super::super::work::Work;
use super::{Inequalities, Multipliers};
use crate::numeric::Interval;

/// Exchanges before the method gives up; its multipliers then still give a bound.
const MOST_EXCHANGES: usize = 2000;
/// Of the objective, against ties.
const PERTURBATION: f64 = 1e-8;
/// A smaller pivot, and a smaller violation of a constraint in units of its largest coefficient, counts as zero.
const TOLERANCE: f64 = 1e-9;

/// The result of a linear programme.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// Multipliers that bound the objective, and where the relaxed problem reaches the bound; zero for unknowns that no inequality has.
    Bounded { multipliers: Multipliers, at: Vec<f64> },
    /// A combination of rows that no point of the box satisfies (Farkas).
    Empty { multipliers: Multipliers },
}

/// `entries . z <= limit`, over the box scaled to `[-1, 1]`.
#[derive(Debug)]
struct Constraint {
    entries: Vec<(usize, f64)>,
    limit: f64,
    /// The number of its inequality, and the scale at which it stands here; `None` for a side of the box.
    row: Option<(usize, f64)>,
}

/// The inequalities in floating point, without those that hold all over the box; then the sides of the box.
#[derive(Debug)]
pub struct Programme {
    /// The unknowns that inequalities have.
    places: Vec<usize>,
    constraints: Vec<Constraint>,
    deviations: Vec<Interval>,
    work: Work,
}

/// Half a range; a point is scaled like a range.
fn radius(z: Interval) -> f64 {
    z.radius().max(f64::MIN_POSITIVE)
}

impl Programme {
    /// The relaxation with real coefficients: `a z <= b` for some a of `[a]` implies `mid(a) z <= b + rad(a) max |z|`.
    pub fn of(rows: &Inequalities, deviations: &[Interval], work: &Work) -> Self {
        work.entries(rows.coefficients.iter().map(Vec::len).sum());
        let places: BTreeSet<usize> = rows.coefficients.iter().flatten().map(|(place, _)| *place).collect();
        let places: Vec<usize> = places.into_iter().collect();
        let mut column = vec![usize::MAX; deviations.len()];
        places.iter().enumerate().for_each(|(index, place)| column[*place] = index);
        let mut constraints = Vec::with_capacity(rows.limits.len() + 2 * places.len());
        for (number, (coefficients, limit)) in rows.coefficients.iter().zip(&rows.limits).enumerate() {
            let mut limit = *limit;
            let mut entries: Vec<(usize, f64)> = Vec::with_capacity(coefficients.len());
            for (unknown, coefficient) in coefficients {
                // Where z has a constant sign, an end of the coefficient gives the weakest inequality, and nothing is lost.
                let z = deviations[*unknown];
                let middle = if z.lower() >= 0.0 {
                    coefficient.lower()
                } else if z.upper() <= 0.0 {
                    coefficient.upper()
                } else {
                    limit += coefficient.radius() * z.magnitude();
                    coefficient.midpoint()
                };
                limit -= middle * z.midpoint();
                entries.push((column[*unknown], middle * radius(z)));
            }
            if entries.iter().map(|(_, entry)| entry.abs()).sum::<f64>() > limit {
                let largest = entries.iter().fold(0.0f64, |largest, (_, entry)| largest.max(entry.abs()));
                let scale = if largest > 0.0 { 1.0 / largest } else { 1.0 };
                entries.iter_mut().for_each(|(_, entry)| *entry *= scale);
                constraints.push(Constraint { entries, limit: limit * scale, row: Some((number, scale)) });
            }
        }
        let sides = (0..places.len()).flat_map(|unknown| [1.0, -1.0].map(|sign| (unknown, sign)));
        constraints.extend(sides.map(|side| Constraint { entries: vec![side], limit: 1.0, row: None }));
        Self { places, constraints, deviations: deviations.to_vec(), work: work.clone() }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.constraints.len() - 2 * self.places.len()
    }

    /// The constraint that a point violates most; `None` where it satisfies all.
    fn worst(&self, z: &[f64]) -> Option<usize> {
        let (mut worst, mut found) = (TOLERANCE, None);
        for (index, Constraint { entries, limit, .. }) in self.constraints.iter().enumerate() {
            let violation = entries.iter().map(|(unknown, entry)| entry * z[*unknown]).sum::<f64>() - limit;
            if violation > worst {
                (worst, found) = (violation, Some(index));
            }
        }
        found
    }

    /// Multipliers of the inequalities made of weights of the constraints.
    fn multipliers(&self, weights: impl IntoIterator<Item = (usize, f64)>) -> Multipliers {
        let of_row = |(index, weight): (usize, f64)| {
            let (number, scale) = self.constraints[index].row.filter(|_| weight > 0.0)?;
            Some((number, weight * scale))
        };
        weights.into_iter().filter_map(of_row).collect()
    }

    /// Maximises the objective.
    pub fn maximise(&self, objective: &[(usize, f64)]) -> Outcome {
        let column = |unknown: usize| self.places.binary_search(&unknown).ok();
        let scaled =
            |(unknown, weight): &(usize, f64)| Some((column(*unknown)?, weight * radius(self.deviations[*unknown])));
        let objective: Vec<(usize, f64)> = objective.iter().filter_map(scaled).collect();
        let mut vertex = Vertex::of_box(&perturbed(&objective, self.places.len()), &self.constraints);
        for _ in 0..MOST_EXCHANGES {
            let Some(worst) = self.worst(&vertex.z) else { break };
            let shares = vertex.shares(&self.constraints[worst].entries);
            let Some(out) = vertex.leaving(&shares) else {
                let against = vertex.basis.iter().copied().zip(shares.iter().map(|share| -share));
                return Outcome::Empty { multipliers: self.multipliers(against.chain([(worst, 1.0)])) };
            };
            vertex.exchange(out, worst, &shares, &self.constraints);
            self.work.entries(self.places.len());
        }
        let multipliers = self.multipliers(vertex.basis.iter().copied().zip(vertex.shares(&objective)));
        let mut at = vec![0.0; self.deviations.len()];
        for (place, z) in self.places.iter().zip(&vertex.z) {
            at[*place] = self.deviations[*place].midpoint() + radius(self.deviations[*place]) * z;
        }
        Outcome::Bounded { multipliers, at }
    }
}

/// An objective with a little of everything else, by which no two vertices are equally good.
fn perturbed(objective: &[(usize, f64)], unknowns: usize) -> Vec<f64> {
    let mut weights = vec![0.0; unknowns];
    objective.iter().for_each(|(unknown, weight)| weights[*unknown] += weight);
    let largest = weights.iter().fold(0.0f64, |largest, weight| largest.max(weight.abs()));
    let unit = PERTURBATION * if largest > 0.0 { largest } else { 1.0 };
    for (index, weight) in weights.iter_mut().enumerate() {
        let odd = unit * (1.0 + ((index * 7919 + 13) % 101) as f64 / 101.0);
        *weight += if *weight < 0.0 { -odd } else { odd };
    }
    weights
}

/// The intersection of the constraints of a basis, as many as unknowns, each satisfied with equality. The objective is the sum of their
/// rows with nonnegative weights: dual feasibility.
struct Vertex {
    basis: Vec<usize>,
    weights: Vec<f64>,
    /// A row for each unknown: `z = inverse . limits`.
    inverse: Vec<Vec<f64>>,
    z: Vec<f64>,
}

impl Vertex {
    /// The corner of the box, whose sides are the last constraints, that is best by the objective.
    fn of_box(objective: &[f64], constraints: &[Constraint]) -> Self {
        let (unknowns, sides) = (objective.len(), constraints.len() - 2 * objective.len());
        let basis: Vec<usize> =
            objective.iter().enumerate().map(|(k, weight)| sides + 2 * k + usize::from(*weight < 0.0)).collect();
        let z: Vec<f64> = objective.iter().map(|weight| if *weight < 0.0 { -1.0 } else { 1.0 }).collect();
        let mut inverse = vec![vec![0.0; unknowns]; unknowns];
        z.iter().enumerate().for_each(|(unknown, side)| inverse[unknown][unknown] = *side);
        Self { basis, weights: objective.iter().map(|weight| weight.abs()).collect(), inverse, z }
    }

    /// A row as a combination of those of the basis.
    fn shares(&self, row: &[(usize, f64)]) -> Vec<f64> {
        let mut shares = vec![0.0; self.z.len()];
        for (unknown, entry) in row {
            shares.iter_mut().zip(&self.inverse[*unknown]).for_each(|(share, own)| *share += entry * own);
        }
        shares
    }

    /// The ratio test: the place in the basis whose weight reaches zero first. `None` where the row contradicts the basis.
    fn leaving(&self, shares: &[f64]) -> Option<usize> {
        let ratio = |out: &usize| self.weights[*out] / shares[*out];
        (0..shares.len()).filter(|out| shares[*out] > TOLERANCE).min_by(|a, b| ratio(a).total_cmp(&ratio(b)))
    }

    /// Puts a constraint, with its shares, in a place of the basis.
    fn exchange(&mut self, out: usize, constraint: usize, shares: &[f64], constraints: &[Constraint]) {
        let step = self.weights[out] / shares[out];
        for (weight, share) in self.weights.iter_mut().zip(shares) {
            *weight = (*weight - step * share).max(0.0);
        }
        self.weights[out] = step;
        self.basis[out] = constraint;
        let limits: Vec<f64> = self.basis.iter().map(|index| constraints[*index].limit).collect();
        for (row, z) in self.inverse.iter_mut().zip(&mut self.z) {
            let head = row[out] / shares[out];
            if head != 0.0 {
                row.iter_mut().zip(shares).for_each(|(entry, share)| *entry -= share * head);
                row[out] = head;
            }
            *z = row.iter().zip(&limits).map(|(entry, limit)| entry * limit).sum();
        }
    }
}
