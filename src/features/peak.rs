//! Turning points between samples.

use crate::numeric::Scalar;

/// Samples remembered around a turning point, on either side.
const REACH: usize = 4;
const WINDOW: usize = 2 * REACH + 1;

/// The last samples: time and value, the newest at the end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Recent<S>([(S, S); REACH + 1]);

impl<S: Scalar> Recent<S> {
    pub(super) fn new() -> Self {
        Self([(S::zero(), S::zero()); REACH + 1])
    }

    pub(super) fn push(&mut self, time: S, value: S) {
        self.0.rotate_left(1);
        self.0[REACH] = (time, value);
    }
}

/// The largest value of a sampled signal, interpolated by the parabola of least squares through its neighbours.
///
/// Up to four samples on either side take part, as far as they lie within `share` of the time since the search began: so
/// that noise and rounding average out where the sampling is fast, and a slowly sampled peak keeps its shape.
#[derive(Clone, Copy, Debug)]
pub(super) struct Peak<S> {
    around: [(S, S); WINDOW],
    /// Samples since the search began, as far as they are remembered.
    count: u8,
    /// Index of the largest sample in `around`, and number of valid ones; zero valid ones before the first sample.
    top: u8,
    valid: u8,
}

impl<S: Scalar> Peak<S> {
    pub(super) fn new() -> Self {
        Self { around: [(S::zero(), S::zero()); WINDOW], count: 0, top: 0, valid: 0 }
    }

    /// Takes a sample, times `sign`, that follows the recent ones.
    pub(super) fn push(&mut self, time: S, value: S, recent: &Recent<S>, sign: S) {
        let newest = (time, sign * value);
        self.count = (self.count + 1).min(WINDOW as u8);
        let top = self.around.get(usize::from(self.top)).filter(|_| self.valid > 0);
        if top.is_none_or(|top| newest.1 > top.1) {
            self.top = (self.count - 1).min(REACH as u8);
            self.valid = self.top + 1;
            if let Some(place) = self.around.get_mut(usize::from(self.top)) {
                *place = newest;
            }
        } else if self.valid <= self.top + REACH as u8 {
            self.settle(recent, sign);
            if let Some(place) = self.around.get_mut(usize::from(self.valid)) {
                *place = newest;
                self.valid += 1;
            }
        }
    }

    /// Fetches the samples before the largest, where that is the newest of the recent ones: while the signal rises nobody asks.
    fn settle(&mut self, recent: &Recent<S>, sign: S) {
        if self.valid == self.top + 1 {
            let before = self.around.iter_mut().take(usize::from(self.top)).rev();
            for (place, (time, value)) in before.zip(recent.0.iter().rev().skip(1)) {
                *place = (*time, sign * *value);
            }
        }
    }

    /// Value of the peak, the recent samples and the sign being those of the last sample; `None` before the first. Samples further
    /// than `reach_s` from the largest are left out.
    pub(super) fn value(&mut self, recent: &Recent<S>, sign: S, reach_s: S) -> Option<S> {
        self.settle(recent, sign);
        let (top, valid) = (usize::from(self.top), usize::from(self.valid));
        let samples = self.around.get(..valid)?;
        let &(origin, largest) = samples.get(top)?;
        let near = |index: &usize| samples.get(*index).is_some_and(|(time, _)| (*time - origin).abs() <= reach_s);
        // The nearest neighbours always count.
        let first = (0..top).find(near).unwrap_or(top).min(top.saturating_sub(1));
        let last = (top + 1..valid).rev().find(near).unwrap_or(top).max((top + 1).min(valid - 1));
        Some(samples.get(first..=last).and_then(|near| vertex(near, largest)).unwrap_or(largest))
    }
}

/// Height of the parabola of least squares at its vertex; `None` where it has none among the samples.
fn vertex<S: Scalar>(samples: &[(S, S)], offset: S) -> Option<S> {
    let [(begin, _), _, .., (end, _)] = samples else { return None };
    let width = (*end - *begin) / S::two();
    let middle = *begin + width;
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

#[cfg(test)]
mod tests;
