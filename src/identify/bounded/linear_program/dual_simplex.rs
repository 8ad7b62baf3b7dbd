//! The dual simplex method in floating point (Lemke 1954; Chvátal, *Linear Programming*, 1983, chapter 10).
//!
//! It begins at the corner of the box that is best by the objective: there every weight is nonnegative. While the vertex violates a
//! constraint, that constraint enters the basis and the first whose weight reaches zero leaves it.

use super::super::work::Work;
use super::vertex::{Constraint, TOLERANCE, Vertex, side_of};
use super::{Inequalities, Multipliers};
use crate::numeric::Interval;

/// Exchanges before the method gives up; its multipliers then still give a bound.
const MOST_EXCHANGES: usize = 2000;
/// Of the objective, against ties.
const PERTURBATION: f64 = 1e-8;

/// The result of a linear programme.
#[derive(Clone, Debug)]
pub(in super::super) enum Outcome {
    /// Multipliers that bound the objective, and where the relaxed problem reaches the bound.
    Bounded { multipliers: Multipliers, at: Vec<f64> },
    /// A combination of rows that no point of the box satisfies (Farkas).
    Empty { multipliers: Multipliers },
}

/// The coefficients of an unknown, from the first row that has it to the last.
#[derive(Default)]
struct SparseColumn {
    first: usize,
    entries: Vec<f64>,
}

impl SparseColumn {
    fn at(&self, row: usize) -> f64 {
        row.checked_sub(self.first).and_then(|offset| self.entries.get(offset)).copied().unwrap_or(0.0)
    }

    /// Rows are added in their order.
    fn add(&mut self, row: usize, entry: f64) {
        if self.entries.is_empty() {
            self.first = row;
        }
        self.entries.resize(row - self.first + 1, 0.0);
        self.entries[row - self.first] += entry;
    }
}

/// The inequalities in floating point, each scaled, over the box scaled to `[-1, 1]`; without those that hold all over it.
pub(in super::super) struct Programme {
    /// Which unknowns it has.
    places: Vec<usize>,
    /// Of each unknown.
    columns: Vec<SparseColumn>,
    limits: Vec<f64>,
    /// Scale of each row.
    scales: Vec<f64>,
    /// The number of each row among the inequalities.
    numbers: Vec<usize>,
    centre: Vec<f64>,
    radius: Vec<f64>,
    work: Work,
}

impl Programme {
    /// The relaxation with real coefficients: `a z <= b` for some a of `[a]` implies `mid(a) z <= b + rad(a) max |z|`.
    pub(in super::super) fn of(rows: &Inequalities, deviations: &[Interval], places: &[usize], work: &Work) -> Self {
        work.entries(rows.coefficients.iter().map(Vec::len).sum());
        let mut column = vec![usize::MAX; deviations.len()];
        for (index, place) in places.iter().enumerate() {
            column[*place] = index;
        }
        let own = |value: &dyn Fn(Interval) -> f64| places.iter().map(|place| value(deviations[*place])).collect();
        let mut programme = Self {
            places: places.to_vec(),
            columns: places.iter().map(|_| SparseColumn::default()).collect(),
            limits: Vec::with_capacity(rows.limits.len()),
            scales: Vec::with_capacity(rows.limits.len()),
            numbers: Vec::with_capacity(rows.limits.len()),
            centre: own(&|z| z.midpoint()),
            radius: own(&|z| z.radius().max(f64::MIN_POSITIVE)),
            work: work.clone(),
        };
        let mut entries: Vec<(usize, f64)> = Vec::new();
        for (number, (coefficients, limit)) in rows.coefficients.iter().zip(&rows.limits).enumerate() {
            let mut limit = *limit;
            entries.clear();
            for (unknown, coefficient) in coefficients {
                let index = column[*unknown];
                let Some(radius) = programme.radius.get(index) else { continue };
                // Where z has a constant sign, an end of the coefficient gives the weakest inequality, and nothing is lost.
                let deviation = deviations[*unknown];
                let middle = if deviation.lower() >= 0.0 {
                    coefficient.lower()
                } else if deviation.upper() <= 0.0 {
                    coefficient.upper()
                } else {
                    limit += coefficient.radius() * deviation.magnitude();
                    coefficient.midpoint()
                };
                limit -= middle * programme.centre[index];
                entries.push((index, middle * radius));
            }
            if entries.iter().map(|(_, entry)| entry.abs()).sum::<f64>() > limit {
                programme.add(number, &entries, limit);
            }
        }
        programme
    }

    fn add(&mut self, number: usize, entries: &[(usize, f64)], limit: f64) {
        let largest = entries.iter().fold(0.0f64, |largest, (_, entry)| largest.max(entry.abs()));
        let scale = if largest > 0.0 { 1.0 / largest } else { 1.0 };
        for (index, entry) in entries {
            self.columns[*index].add(self.limits.len(), entry * scale);
        }
        self.limits.push(limit * scale);
        self.scales.push(scale);
        self.numbers.push(number);
    }

    /// Number of rows.
    #[cfg(test)]
    pub(in super::super) fn rows(&self) -> usize {
        self.numbers.len()
    }

    /// A constraint's row, and its limit.
    fn constraint(&self, constraint: Constraint, row: &mut [f64]) -> f64 {
        match constraint {
            Constraint::Row(index) => {
                row.iter_mut().zip(&self.columns).for_each(|(entry, column)| *entry = column.at(index));
                self.limits[index]
            }
            Constraint::Side { unknown, lower } => {
                row.fill(0.0);
                row[unknown] = side_of(lower);
                1.0
            }
        }
    }

    /// The objective in units of the box.
    fn scaled(&self, objective: &[(usize, f64)]) -> Vec<f64> {
        let mut scaled = vec![0.0; self.places.len()];
        for (unknown, weight) in objective {
            if let Some(column) = self.places.iter().position(|place| place == unknown) {
                scaled[column] += weight * self.radius[column];
            }
        }
        scaled
    }

    /// Multipliers of the rows made of weights of the constraints.
    fn multipliers(&self, weights: impl IntoIterator<Item = (Constraint, f64)>) -> Multipliers {
        let of_row = |(constraint, weight): (Constraint, f64)| match constraint {
            Constraint::Row(index) if weight > 0.0 => Some((self.numbers[index], weight * self.scales[index])),
            _ => None,
        };
        weights.into_iter().filter_map(of_row).collect()
    }

    /// Maximises the objective.
    pub(in super::super) fn maximise(&self, objective: &[(usize, f64)]) -> Outcome {
        let objective = self.scaled(objective);
        let mut vertex = Vertex::of_box(&perturbed(&objective));
        let mut violations = Violations::of(self);
        let mut row = vec![0.0; objective.len()];
        let mut shares = row.clone();
        for _ in 0..MOST_EXCHANGES {
            let Some(worst) = violations.worst(&vertex.z) else { break };
            let limit = self.constraint(worst, &mut row);
            vertex.shares(&row, &mut shares);
            let Some(exchange) = vertex.exchange(&shares) else {
                let against = vertex.basis.iter().copied().zip(shares.iter().map(|share| -share));
                return Outcome::Empty { multipliers: self.multipliers(against.chain([(worst, 1.0)])) };
            };
            vertex.put(exchange, worst, limit, &shares);
            self.work.entries(self.columns.len());
        }
        let weights = vertex.weights(&objective);
        let multipliers = self.multipliers(vertex.basis.iter().copied().zip(weights));
        let at = vertex.z.iter().zip(&self.centre).zip(&self.radius).map(|((z, centre), radius)| centre + radius * z);
        Outcome::Bounded { multipliers, at: at.collect() }
    }
}

/// An objective with a little of everything else, by which no two vertices are equally good.
fn perturbed(objective: &[f64]) -> Vec<f64> {
    let largest = objective.iter().fold(0.0f64, |largest, weight| largest.max(weight.abs()));
    let unit = PERTURBATION * if largest > 0.0 { largest } else { 1.0 };
    let odd = |index: usize| 1.0 + ((index * 7919 + 13) % 101) as f64 / 101.0;
    objective.iter().enumerate().map(|(index, weight)| weight + unit * side_of(*weight < 0.0) * odd(index)).collect()
}

/// A point's violation of each row, updated as the point moves.
struct Violations<'a> {
    programme: &'a Programme,
    by: Vec<f64>,
    /// The point.
    z: Vec<f64>,
    /// Whether it has not moved since all was evaluated.
    exact: bool,
}

impl<'a> Violations<'a> {
    /// By the middle of the box.
    fn of(programme: &'a Programme) -> Self {
        let z = vec![0.0; programme.columns.len()];
        Self { programme, by: programme.limits.iter().map(|limit| -limit).collect(), z, exact: false }
    }

    /// Moves to another point: a vertex differs from the vertex before in few unknowns.
    fn follow(&mut self, z: &[f64]) {
        for ((column, z), own) in self.programme.columns.iter().zip(z).zip(&mut self.z) {
            let moved = z - *own;
            if moved != 0.0 {
                *own = *z;
                let rows = &mut self.by[column.first..];
                rows.iter_mut().zip(&column.entries).for_each(|(by, entry)| *by += entry * moved);
            }
        }
    }

    /// The constraint that a point violates most; `None` where it satisfies all.
    fn worst(&mut self, z: &[f64]) -> Option<Constraint> {
        loop {
            self.follow(z);
            let row = largest(&self.by);
            let mut worst = row.max(TOLERANCE);
            let mut found = self.by.iter().position(|by| *by > TOLERANCE && *by >= row).map(Constraint::Row);
            for (unknown, z) in z.iter().enumerate() {
                if z.abs() - 1.0 > worst {
                    worst = z.abs() - 1.0;
                    found = Some(Constraint::Side { unknown, lower: *z < 0.0 });
                }
            }
            if found.is_some() || self.exact {
                self.exact = false;
                return found;
            }
            // Rounding errors of the updates have added up: evaluate all rows once more.
            *self = Self { exact: true, ..Self::of(self.programme) };
        }
    }
}

/// The largest of some numbers, four at a time.
fn largest(values: &[f64]) -> f64 {
    let larger = |a: f64, b: f64| if b > a { b } else { a };
    let (fours, rest) = values.as_chunks::<4>();
    let most = |most: [f64; 4], four: &[f64; 4]| core::array::from_fn(|lane| larger(most[lane], four[lane]));
    let lanes = fours.iter().fold([f64::NEG_INFINITY; 4], most);
    lanes.iter().chain(rest).copied().fold(f64::NEG_INFINITY, larger)
}
