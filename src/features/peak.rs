//! Turning points between samples.

use crate::numeric::Scalar;

/// Samples remembered around a turning point, on either side.
const REACH: usize = 4;
const WINDOW: usize = 2 * REACH + 1;

/// The largest value of a sampled signal, interpolated by the parabola of least squares through its neighbours.
///
/// Up to four samples on either side take part, as far as they lie within `share` of the time since the search began: so
/// that noise and rounding average out where the sampling is fast, and a slowly sampled peak keeps its shape.
#[derive(Clone, Copy, Debug)]
pub(super) struct Peak<S> {
    recent: [(S, S); WINDOW],
    count: usize,
    around: [(S, S); WINDOW],
    /// Index of the largest sample in `around`, and number of valid ones; zero valid ones before the first sample.
    top: usize,
    valid: usize,
    largest: Option<S>,
    began: S,
}

impl<S: Scalar> Peak<S> {
    pub(super) fn new(began: S) -> Self {
        let empty = [(S::zero(), S::zero()); WINDOW];
        Self { recent: empty, count: 0, around: empty, top: 0, valid: 0, largest: None, began }
    }

    pub(super) fn push(&mut self, time: S, value: S) {
        self.recent.rotate_left(1);
        self.recent[WINDOW - 1] = (time, value);
        self.count = (self.count + 1).min(WINDOW);
        if self.largest.is_none_or(|largest| value > largest) {
            self.largest = Some(value);
            let before = (self.count - 1).min(REACH);
            self.around[..=before].copy_from_slice(&self.recent[WINDOW - 1 - before..]);
            (self.top, self.valid) = (before, before + 1);
        } else if self.valid > 0 && self.valid <= self.top + REACH {
            self.around[self.valid] = (time, value);
            self.valid += 1;
        }
    }

    /// Value of the peak; `None` before the first sample. Samples further than `reach_s` from the largest are left out.
    pub(super) fn value(&self, reach_s: S) -> Option<S> {
        let largest = self.largest?;
        let samples = &self.around[..self.valid];
        let origin = samples[self.top].0;
        let near = |index: &usize| (samples[*index].0 - origin).abs() <= reach_s;
        // The nearest neighbours always count.
        let first = (0..self.top).find(near).unwrap_or(self.top).min(self.top.saturating_sub(1));
        let last =
            (self.top + 1..self.valid).rev().find(near).unwrap_or(self.top).max((self.top + 1).min(self.valid - 1));
        Some(vertex(&samples[first..=last], largest).unwrap_or(largest))
    }

    /// When the search began.
    pub(super) fn began(&self) -> S {
        self.began
    }
}

/// Height of the parabola of least squares at its vertex; `None` where it has none among the samples.
fn vertex<S: Scalar>(samples: &[(S, S)], offset: S) -> Option<S> {
    if samples.len() < 3 {
        return None;
    }
    let width = (samples[samples.len() - 1].0 - samples[0].0) / S::two();
    let middle = samples[0].0 + width;
    // Moments of the scaled times and values; the middle makes the odd ones small.
    let (mut t, mut m) = ([S::zero(); 5], [S::zero(); 3]);
    for &(time, value) in samples {
        let s = (time - middle) / width;
        let mut power = S::one();
        for k in 0..5 {
            t[k] = t[k] + power;
            if k < 3 {
                m[k] = m[k] + power * (value - offset);
            }
            power = power * s;
        }
    }
    let determinant = |a: [S; 3], b: [S; 3], c: [S; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let columns = [[t[0], t[1], t[2]], [t[1], t[2], t[3]], [t[2], t[3], t[4]]];
    let whole = determinant(columns[0], columns[1], columns[2]);
    let constant = determinant(m, columns[1], columns[2]) / whole;
    let slope = determinant(columns[0], m, columns[2]) / whole;
    let curvature = determinant(columns[0], columns[1], m) / whole;
    let at = -slope / (S::two() * curvature);
    let peaked = curvature < S::zero() && at.abs() <= S::one();
    peaked.then(|| offset + constant + slope * at / S::two())
}
