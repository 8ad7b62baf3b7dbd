//! Propagation of the state estimate and its covariance over a step.

use crate::identify::fit::prediction_error::motion::MotionStep;

/// Position, velocity, process force, coloured error, then the filtered position where the sensor filters, and the late speed where
/// drag follows it.
pub(super) type Vector<const N: usize> = [f64; N];
pub(super) type Square<const N: usize> = [[f64; N]; N];
/// Place of the filtered position.
pub(super) const FILTERED: usize = 4;
/// Place of the speed that late drag follows.
pub(super) const LATE: usize = 5;

/// Transition of the states over a step.
#[derive(Clone, Copy)]
pub(super) struct Transition {
    pub(super) motion: [[f64; 2]; 2],
    /// Weights of the process force in position and velocity.
    pub(super) by_force: [f64; 2],
    pub(super) colour: f64,
    /// Weights of position, velocity, process force and filtered position in the filtered position.
    pub(super) filtered: [f64; 4],
    /// Weights of the late speed in position and velocity.
    pub(super) by_late: [f64; 2],
    /// Weights of the late speed, and of the velocity at beginning and end, in the late speed.
    pub(super) late: [f64; 3],
}

impl Transition {
    /// Of position and velocity alone: further states become zero.
    pub(super) fn new(step: &MotionStep, alpha: f64) -> Self {
        let gained = |axis: usize| step.begin_weight[axis] + step.middle_weight[axis];
        Self {
            motion: step.transition,
            by_force: [gained(0) / alpha, (gained(1) + step.end_weight) / alpha],
            colour: 0.0,
            filtered: [0.0; 4],
            by_late: [0.0; 2],
            late: [0.0; 3],
        }
    }

    /// The sensor filters the position.
    pub(super) fn filter(&mut self, sensor: &LowPass, step: &MotionStep, h_s: f64, alpha: f64) {
        let [first, middle, last] = sensor.weights;
        self.filtered = [
            first + middle * step.half[0] + last * step.transition[0][0],
            middle * step.half[1] + last * step.transition[0][1],
            middle * 0.125 * h_s * h_s / alpha + last * self.by_force[0],
            sensor.kept,
        ];
    }

    /// Drag follows the late speed, to which the velocity adds as if it were constant over the step.
    pub(super) fn remember(&mut self, late: &LateSpeed, low_pass: &LowPass, step: &MotionStep, memory_over_alpha: f64) {
        let [_, middle, end] = late.kept;
        for axis in 0..2 {
            let at_end = if axis == 1 { step.end_weight } else { 0.0 };
            let (first, half_way) = (step.begin_weight[axis], step.middle_weight[axis]);
            self.by_late[axis] = -memory_over_alpha * (first + half_way * middle + at_end * end);
            self.motion[axis][1] -= memory_over_alpha * (half_way * (1.0 - middle) + at_end * (1.0 - end));
        }
        let [first, half_way, last] = low_pass.weights;
        self.late = [low_pass.kept, first + 0.5 * half_way, 0.5 * half_way + last];
    }

    pub(super) fn apply<const N: usize>(&self, v: &Vector<N>) -> Vector<N> {
        let mut next = [0.0; N];
        next[0] = self.motion[0][0] * v[0] + self.motion[0][1] * v[1] + self.by_force[0] * v[2];
        next[1] = self.motion[1][0] * v[0] + self.motion[1][1] * v[1] + self.by_force[1] * v[2];
        next[2] = v[2];
        next[3] = self.colour * v[3];
        if N > FILTERED {
            let [x, velocity, force, own] = self.filtered;
            next[FILTERED] = x * v[0] + velocity * v[1] + force * v[2] + own * v[FILTERED];
        }
        if N > LATE {
            next[0] += self.by_late[0] * v[LATE];
            next[1] += self.by_late[1] * v[LATE];
            let [own, first, last] = self.late;
            next[LATE] = own * v[LATE] + first * v[1] + last * next[1];
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

/// A first-order low pass over a step in which its input is the parabola through its beginning, middle and end: the decay
/// of its output, the three weights, and the derivatives of all with respect to the time constant.
#[derive(Clone, Copy)]
pub(super) struct LowPass {
    pub(super) kept: f64,
    pub(super) weights: [f64; 3],
    pub(super) kept_by_time: f64,
    pub(super) weights_by_time: [f64; 3],
}

impl LowPass {
    pub(super) fn new(time_s: f64, h_s: f64) -> Self {
        let q = h_s / time_s;
        let kept = libm::exp(-q);
        // Moments of the weight exp(-(h - s) / time) / time over s / h, and their derivatives with respect to q.
        let m0 = -libm::expm1(-q);
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

    /// The output after the step.
    pub(super) fn after(&self, before: f64, inputs: &[f64; 3]) -> f64 {
        self.kept * before + dot(&self.weights, inputs)
    }

    /// Its derivative with respect to the time of the low pass.
    pub(super) fn after_by_time(&self, before: f64, inputs: &[f64; 3]) -> f64 {
        self.kept_by_time * before + dot(&self.weights_by_time, inputs)
    }
}

fn dot(weights: &[f64; 3], values: &[f64; 3]) -> f64 {
    weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
}

/// The late speed at the beginning, in the middle and at the end of a step over which the velocity is a line, and the weight
/// of its initial value at each.
#[derive(Clone, Copy)]
pub(super) struct LateSpeed {
    pub(super) values: [f64; 3],
    pub(super) by_time: [f64; 3],
    pub(super) kept: [f64; 3],
}

impl LateSpeed {
    pub(super) fn along(time_s: f64, h_s: f64, before: f64, velocity: f64, acceleration: f64) -> Self {
        let since = [0.0, 0.5 * h_s, h_s];
        let behind = before - velocity + acceleration * time_s;
        let kept = since.map(|t| libm::exp(-t / time_s));
        let at = |k: usize| velocity + acceleration * (since[k] - time_s) + behind * kept[k];
        let by_time = |k: usize| acceleration * (kept[k] - 1.0) + behind * kept[k] * since[k] / (time_s * time_s);
        Self { values: [at(0), at(1), at(2)], by_time: [by_time(0), by_time(1), by_time(2)], kept }
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
