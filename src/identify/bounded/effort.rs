//! What a search takes, counted and not measured: the same on every machine and every time.

use core::cell::Cell;
use std::rc::Rc;

/// What counts as one pass takes at most, in about microseconds of one core: by itself, and for each sample.
const PASS_US: f64 = 2000.0;
const PASS_SAMPLE_US: f64 = 2.4;
/// A step of a point; with slopes; and for each bundle of pairs by which slopes bend. With polynomials it takes so many times as long.
const POINT_US: f64 = 1.0;
const STEP_US: f64 = 6.9;
const BEND_US: f64 = 1.87;
const SERIES: f64 = 2.0;
/// The motion at a sample, without bends and with them.
const NODE_US: f64 = 1.6;
const BENT_NODE_US: f64 = 2.0;
/// A sample under hats.
const WEIGHED_US: f64 = 8.0;
/// A slope in an inequality of a linear programme; and from one vertex to the next, for each unknown.
const SLOPE_US: f64 = 0.037;
const PIVOT_US: f64 = 0.028;

#[cfg(test)]
mod tests;

/// What has been taken so far: clones count together.
#[derive(Clone, Debug, Default)]
pub(super) struct Effort {
    us: Rc<Cell<f64>>,
}

impl Effort {
    fn take(&self, us: f64) {
        self.us.set(self.us.get() + us);
    }

    /// A step of a point.
    pub(super) fn point(&self) {
        self.take(POINT_US);
    }

    /// A step with slopes, and so many bundles of pairs by which they bend; in closed form or not.
    pub(super) fn step(&self, bends: usize, closed: bool) {
        let longer = if closed { 1.0 } else { SERIES };
        self.take(longer * (STEP_US + BEND_US * bends as f64));
    }

    /// The motion at a sample.
    pub(super) fn node(&self, bent: bool) {
        self.take(if bent { BENT_NODE_US } else { NODE_US });
    }

    /// Hats over so many samples.
    pub(super) fn weighed(&self, samples: usize) {
        self.take(WEIGHED_US * samples as f64);
    }

    /// Inequalities that have so many slopes, for a linear programme.
    pub(super) fn slopes(&self, count: usize) {
        self.take(SLOPE_US * count as f64);
    }

    /// From one vertex of it to the next, with so many unknowns.
    pub(super) fn pivot(&self, unknowns: usize) {
        self.take(PIVOT_US * unknowns as f64);
    }

    /// What has been taken, in about microseconds.
    pub(super) fn us(&self) -> f64 {
        self.us.get()
    }

    /// The same in passes over so many samples.
    pub(super) fn passes(&self, samples: usize) -> f64 {
        self.us() / (PASS_US + PASS_SAMPLE_US * samples as f64)
    }
}
