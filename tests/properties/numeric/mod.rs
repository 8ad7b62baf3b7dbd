//! The arithmetics, by the names that they have in the library; [`rounded`] is shared with its own tests.

pub(crate) use selfosc::numeric::*;

mod bounds_of_rounding;
pub(crate) mod rounded;
