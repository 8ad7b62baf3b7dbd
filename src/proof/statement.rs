//! Statements as objects: written once, evaluated on intervals, on jets and wherever else a proof or its reader needs them.

use crate::numeric::special::Special;

/// `M` functions of `N` variables, which a proof shows to vanish.
///
/// A closure has one arithmetic; a statement has all of them: the formula proved on jets, evaluated on
/// intervals and printed in a file is the same.
pub trait Statement<const N: usize, const M: usize> {
    /// The functions, in any arithmetic.
    fn at<T: Special>(&self, variables: [T; N]) -> [T; M];
}

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
