//! Proofs over boxes: identities, inequalities, roots and integrals enclosed in interval arithmetic.

#[cfg(feature = "std")]
pub mod branch_and_bound;
pub mod enclosure;
mod gradient;
#[cfg(feature = "std")]
pub mod identity;
#[cfg(feature = "std")]
pub mod inequality;
#[cfg(feature = "std")]
pub mod interval_matrix;
#[cfg(feature = "std")]
mod outcome;
#[cfg(feature = "std")]
pub mod rigorous_quadrature;
mod statement;

pub use gradient::Gradient;
#[cfg(feature = "std")]
pub use outcome::{Bound, NotProved, Proved, Variable};
pub use statement::{Change, Statement, Unchanged};
