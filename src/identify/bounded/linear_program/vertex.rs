//! A vertex of the dual simplex method: as many constraints as unknowns, each satisfied with equality.

/// A smaller pivot, and a smaller violation of a row in units of its largest coefficient, counts as zero.
pub(super) const TOLERANCE: f64 = 1e-9;

/// A constraint of a programme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Constraint {
    /// A row.
    Row(usize),
    /// A side of the box `[-1, 1]`, the lower or the upper side, of an unknown.
    Side { unknown: usize, lower: bool },
}

/// The constraint that another replaces at the vertex, by its place, and the weight of the new constraint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exchange {
    out: usize,
    weight: f64,
}

/// The intersection of the constraints of a basis. The objective is the sum of their rows with nonnegative weights: dual feasibility.
pub(super) struct Vertex {
    pub(super) basis: Vec<Constraint>,
    limits: Vec<f64>,
    weights: Vec<f64>,
    /// By rows, a row for each unknown: `z = inverse . limits`.
    inverse: Vec<f64>,
    /// Unknowns at a side of the box, and its place: the only entry of their rows.
    sided: Vec<Option<usize>>,
    pub(super) z: Vec<f64>,
}

/// Where a side of the box is.
pub(super) fn side_of(lower: bool) -> f64 {
    if lower { -1.0 } else { 1.0 }
}

impl Vertex {
    /// The corner of the box that is best by the objective.
    pub(super) fn of_box(objective: &[f64]) -> Self {
        let n = objective.len();
        let z: Vec<f64> = objective.iter().map(|weight| side_of(*weight < 0.0)).collect();
        let mut inverse = vec![0.0; n * n];
        for (unknown, side) in z.iter().enumerate() {
            inverse[unknown * n + unknown] = *side;
        }
        let side = |(unknown, side): (usize, &f64)| Constraint::Side { unknown, lower: *side < 0.0 };
        Self {
            basis: z.iter().enumerate().map(side).collect(),
            limits: vec![1.0; n],
            weights: objective.iter().map(|weight| weight.abs()).collect(),
            inverse,
            sided: (0..n).map(Some).collect(),
            z,
        }
    }

    /// Each unknown's row of the inverse.
    fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.inverse.chunks_exact(self.z.len().max(1))
    }

    /// A row as a combination of those of the basis.
    pub(super) fn shares(&self, row: &[f64], shares: &mut [f64]) {
        shares.fill(0.0);
        for ((entry, own), sided) in row.iter().zip(self.rows()).zip(&self.sided) {
            match sided {
                Some(place) => shares[*place] += entry * own[*place],
                None => shares.iter_mut().zip(own).for_each(|(share, own)| *share += entry * own),
            }
        }
    }

    /// The ratio test: the constraint that is replaced in the basis. `None` where the row contradicts the basis.
    pub(super) fn exchange(&self, shares: &[f64]) -> Option<Exchange> {
        let mut least = f64::INFINITY;
        let mut found = None;
        for (out, (share, weight)) in shares.iter().zip(&self.weights).enumerate() {
            if *share > TOLERANCE && weight / share < least {
                least = weight / share;
                found = Some(Exchange { out, weight: least });
            }
        }
        found
    }

    /// Puts a constraint, with its limit and its shares, in the place of another.
    pub(super) fn put(&mut self, exchange: Exchange, constraint: Constraint, limit: f64, shares: &[f64]) {
        let Exchange { out, weight: step } = exchange;
        for (weight, share) in self.weights.iter_mut().zip(shares) {
            *weight = (*weight - step * share).max(0.0);
        }
        self.weights[out] = step;
        if let Constraint::Side { unknown, .. } = self.basis[out] {
            self.sided[unknown] = None;
        }
        self.basis[out] = constraint;
        self.limits[out] = limit;
        let across = self.z.len().max(1);
        for (row, _) in self.inverse.chunks_exact_mut(across).zip(&self.sided).filter(|(_, sided)| sided.is_none()) {
            let head = row[out] / shares[out];
            for (entry, share) in row.iter_mut().zip(shares) {
                *entry -= share * head;
            }
            row[out] = head;
        }
        if let Constraint::Side { unknown, lower } = constraint {
            let row = &mut self.inverse[unknown * across..][..across];
            row.fill(0.0);
            row[out] = side_of(lower);
            self.sided[unknown] = Some(out);
        }
        self.meet();
    }

    /// The point of the basis.
    fn meet(&mut self) {
        let across = self.z.len().max(1);
        for ((z, row), sided) in self.z.iter_mut().zip(self.inverse.chunks_exact(across)).zip(&self.sided) {
            *z = match sided {
                Some(place) => row[*place],
                None => row.iter().zip(&self.limits).map(|(entry, limit)| entry * limit).sum(),
            };
        }
    }

    /// Weights of the constraints that make up an objective.
    pub(super) fn weights(&self, objective: &[f64]) -> Vec<f64> {
        let mut weights = vec![0.0; objective.len()];
        self.shares(objective, &mut weights);
        weights
    }
}
