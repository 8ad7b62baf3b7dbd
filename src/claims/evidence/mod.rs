//! Evidence as data: the finding, on which part of a claim's domain, by which numbers.

mod domain;
mod verdict;
mod witness;

pub use domain::{ClaimDomain, ClaimPart, ClaimVariable};
pub use verdict::{Evidence, Verdict, Word};
pub use witness::Witness;
