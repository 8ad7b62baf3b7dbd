//! Which drag law a vehicle has.

pub mod pairwise;
