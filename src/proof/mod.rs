//! Proofs over boxes: identities, inequalities, roots and integrals enclosed in interval arithmetic.

#[cfg(feature = "std")]
pub mod branch_and_bound;
pub mod enclosure;
#[cfg(feature = "std")]
pub mod identity;
#[cfg(feature = "std")]
pub mod inequality;
#[cfg(feature = "std")]
pub mod interval_matrix;
#[cfg(feature = "std")]
pub mod margin;
#[cfg(feature = "std")]
mod outcome;
#[cfg(feature = "std")]
pub mod polynomial;
#[cfg(feature = "std")]
pub mod rigorous_quadrature;
mod statement;

/// Enclosures of a value and its partial derivatives over a box: rigorous Jacobians from the formulas themselves.
pub type Gradient<const N: usize> = crate::numeric::Gradient<crate::numeric::Interval, N>;

#[cfg(feature = "std")]
pub use margin::formula;
#[cfg(feature = "std")]
pub use outcome::{Bound, Extent, NotProved, Proved};
pub use statement::{Change, Statement, Unchanged};
