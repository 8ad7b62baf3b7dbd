//! Work, counted and not measured: a search that ends by its budget gives the same answer on every machine.

use core::cell::Cell;
use std::rc::Rc;

/// One pass, in units of a step of the flow with one block of sensitivities: a record of some hundred samples takes as many steps.
const PASS: f64 = 300.0;
/// One entry of an inequality, and one unknown of an exchange of the simplex method.
const ENTRY: f64 = 0.004;

/// Work done so far; clones count together.
#[derive(Clone, Debug, Default)]
pub struct Work {
    steps: Rc<Cell<f64>>,
}

impl Work {
    fn add(&self, steps: f64) {
        self.steps.set(self.steps.get() + steps);
    }

    /// A step of the flow with so many blocks of sensitivities.
    pub fn step(&self, blocks: usize) {
        self.add(0.5 + 0.5 * blocks as f64);
    }

    /// Modulating functions over so many samples, each as much as a step.
    pub fn weighted(&self, samples: usize) {
        self.add(samples as f64);
    }

    /// Entries of inequalities, or unknowns of an exchange.
    pub fn entries(&self, count: usize) {
        self.add(ENTRY * count as f64);
    }

    /// Work in passes.
    pub fn passes(&self) -> usize {
        (self.steps.get() / PASS) as usize
    }
}
