//! Linear programmes with few unknowns and many inequalities. The simplex method is not trusted: it proposes multipliers, and the safe
//! bound in intervals holds for any nonnegative multipliers.

mod dual_simplex;
mod safe_bound;

pub use dual_simplex::{Outcome, Programme};
pub use safe_bound::{Inequalities, Multipliers};
