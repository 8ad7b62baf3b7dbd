//! How the states, and what is known of them, go over a step.

/// Position, velocity, process force, coloured error, and the filtered position where the sensor filters.
pub(super) type Vector<const N: usize> = [f64; N];
pub(super) type Square<const N: usize> = [[f64; N]; N];
/// Place of the filtered position.
pub(super) const FILTERED: usize = 4;

/// Transition of the states over a step.
#[derive(Clone, Copy)]
pub(super) struct Transition {
    pub(super) motion: [[f64; 2]; 2],
    /// What a unit of process force makes of position and velocity.
    pub(super) by_force: [f64; 2],
    pub(super) force: f64,
    pub(super) colour: f64,
    /// What position, velocity, process force and the filtered position itself make of the filtered position.
    pub(super) filtered: [f64; 4],
}

impl Transition {
    pub(super) fn apply<const N: usize>(&self, v: &Vector<N>) -> Vector<N> {
        let mut next = [0.0; N];
        next[0] = self.motion[0][0] * v[0] + self.motion[0][1] * v[1] + self.by_force[0] * v[2];
        next[1] = self.motion[1][0] * v[0] + self.motion[1][1] * v[1] + self.by_force[1] * v[2];
        next[2] = self.force * v[2];
        next[3] = self.colour * v[3];
        if N > FILTERED {
            let [x, velocity, force, own] = self.filtered;
            next[FILTERED] = x * v[0] + velocity * v[1] + force * v[2] + own * v[FILTERED];
        }
        next
    }

    /// `F P F'`.
    pub(super) fn turn<const N: usize>(&self, p: &Square<N>) -> Square<N> {
        let mut half = [[0.0; N]; N];
        for (row, values) in p.iter().enumerate() {
            half[row] = self.apply(values);
        }
        let mut whole = [[0.0; N]; N];
        for column in 0..N {
            let column_of: Vector<N> = core::array::from_fn(|row| half[row][column]);
            let turned = self.apply(&column_of);
            for row in 0..N {
                whole[row][column] = turned[row];
            }
        }
        whole
    }
}

/// A first-order filter over a step in which the position is the parabola through its beginning, middle and end: what is left
/// of the filtered position, the weights of the three, and the derivatives of all with respect to the filter's time.
#[derive(Clone, Copy)]
pub(super) struct SensorFilter {
    pub(super) kept: f64,
    pub(super) weights: [f64; 3],
    pub(super) kept_by_time: f64,
    pub(super) weights_by_time: [f64; 3],
}

impl SensorFilter {
    pub(super) fn new(time_s: f64, h_s: f64) -> Self {
        let q = h_s / time_s;
        let kept = (-q).exp();
        // Moments of the weight exp(-(h - s) / time) / time over s / h, and their derivatives with respect to q.
        let m0 = -(-q).exp_m1();
        let m1 = 1.0 - m0 / q;
        let m2 = 1.0 - 2.0 * m1 / q;
        let (d0, d1) = (kept, (m0 - q * kept) / (q * q));
        let d2 = -2.0 * (d1 - m1 / q) / q;
        let parabola = |m0: f64, m1: f64, m2: f64| [m0 - 3.0 * m1 + 2.0 * m2, 4.0 * (m1 - m2), 2.0 * m2 - m1];
        let by_time = -q / time_s;
        Self {
            kept,
            weights: parabola(m0, m1, m2),
            kept_by_time: -kept * by_time,
            weights_by_time: parabola(d0, d1, d2).map(|weight| weight * by_time),
        }
    }

    pub(super) fn weighted(weights: &[f64; 3], positions: &[f64; 3]) -> f64 {
        weights.iter().zip(positions).map(|(weight, position)| weight * position).sum()
    }
}

/// `sum += term`.
pub(super) fn add<const N: usize>(sum: &mut Square<N>, term: &Square<N>) {
    for (row, values) in term.iter().enumerate() {
        for (column, value) in values.iter().enumerate() {
            sum[row][column] += value;
        }
    }
}
