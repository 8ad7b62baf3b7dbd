//! Linear programmes with few unknowns and many inequalities. The simplex method is not trusted: it proposes multipliers, and the safe
//! bound in intervals holds for any nonnegative multipliers.

mod dual_simplex;
mod safe_bound;
#[cfg(test)]
mod tests;

pub(super) use dual_simplex::{Outcome, Programme};
pub(super) use safe_bound::{Inequalities, Multipliers};
