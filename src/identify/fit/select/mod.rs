//! Which drag law a vehicle has.

pub mod likelihood;
pub mod pairwise;
