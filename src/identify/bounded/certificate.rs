//! Certificates: a proof of bounds, or of a refutation, in a file that is checked without a search.
//!
//! The file has the tree of branch and prune. Each step contracts the box at hand, divides it, excludes it, or keeps it
//! as a part of the remainder. Contractions and exclusions have nonnegative multipliers of inequalities, of the weak
//! form or of multiple shooting. The check encloses the motion over the boxes that the file names, and adds.

mod check;
mod format;
mod multipliers;
mod prove;
mod statement;
mod unproved;
mod walk;

pub use check::Shown;
pub use format::{Certificate, ReadAs};
pub use unproved::Unproved;
