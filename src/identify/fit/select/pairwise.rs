//! The paper's rule for two experiments (eqs. 41-42): the right drag law has the same coefficient in both.

use crate::numeric::Real;

/// Relative spread of two values in percent (eq. 41): their sample standard deviation over their mean.
///
/// The factor `sqrt(2)` belongs to it: with it the paper's Fig. 15 comes out.
///
/// ```
/// use selfosc::identify::fit::select::pairwise::relative_spread_percent;
/// assert!((relative_spread_percent(1.0, 3.0) - 100.0 / 2f64.sqrt()).abs() < 1e-12);
/// ```
pub fn relative_spread_percent<T: Real>(first: T, second: T) -> T {
    T::two().sqrt() * ((first - second) / (first + second)).abs() * T::from_f64(100.0)
}

/// Decision of a pair of experiments on the drag law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Decision {
    /// Force proportional to speed.
    Linear,
    /// Force proportional to speed squared.
    Quadratic,
    /// The spreads differ by no more than the margin.
    Undecided,
}

/// Eq. 42: quadratic where the spread of the linear coefficient exceeds the quadratic coefficient's by more than `margin_percent`,
/// linear in the converse case. All in percent. Gives no confidence in the decision.
///
/// ```
/// use selfosc::identify::fit::select::pairwise::{Decision, decide};
/// assert_eq!(decide(20.0, 5.0, 10.0), Decision::Quadratic);
/// assert_eq!(decide(20.0, 15.0, 10.0), Decision::Undecided);
/// ```
#[must_use]
pub fn decide<T: Real + PartialOrd>(
    spread_linear_percent: T,
    spread_quadratic_percent: T,
    margin_percent: T,
) -> Decision {
    let difference = spread_linear_percent - spread_quadratic_percent;
    if difference > margin_percent {
        Decision::Quadratic
    } else if difference < -margin_percent {
        Decision::Linear
    } else {
        Decision::Undecided
    }
}
