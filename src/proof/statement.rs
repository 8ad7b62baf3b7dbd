//! Statements as objects: written once, evaluated on intervals, on jets and wherever else a proof or its reader needs them.

use crate::numeric::special::Special;

/// `M` functions of `N` variables, of which a proof says that they vanish.
///
/// A closure has one arithmetic; a statement has all of them, so that what is proved on jets is what was evaluated on
/// intervals and what a file prints.
pub trait Statement<const N: usize, const M: usize> {
    /// The functions, in any arithmetic.
    fn at<T: Special>(&self, variables: [T; N]) -> [T; M];
}

/// A change of what a formula gives: a test hands the engine a false statement by it, and the engine must not prove that.
pub trait Change {
    /// What the changed formula gives at `variables`, where the true one gives `values`.
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
