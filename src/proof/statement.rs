//! Changes of a statement: written once, evaluated on intervals, on jets and wherever else a proof needs them.

use crate::numeric::special::Special;

/// A change of a formula's value: a test hands the engine a false statement by it, and the engine must not prove that.
pub trait Change {
    /// Value of the changed formula at `variables`; `values` are the true formula's.
    fn apply<T: Special, const N: usize, const M: usize>(&self, variables: [T; N], values: [T; M]) -> [T; M];
}

/// The formula as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unchanged;

impl Change for Unchanged {
    fn apply<T: Special, const N: usize, const M: usize>(&self, _: [T; N], values: [T; M]) -> [T; M] {
        values
    }
}
