//! Table 3: the identification formulas, printed by evaluating the program's own over symbols.

use super::PaperError;
use crate::identify::iso::{Oscillation, Parameters, disturbance_from_times};
use crate::numeric::{Interval, Real};
use crate::proof::Expression;

/// Table 3 in any arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Table3<T> {
    /// Inertia, either drag law and the disturbance by the one-tone input.
    pub parameters: Parameters<T>,
    /// The disturbance by the times at either command (eq. 32 in this project's signs).
    pub disturbance_from_times: T,
}

/// Table 3 of an oscillation with given times per period at command `+C` and `-C`.
///
/// # Errors
/// As [`Oscillation::identify`].
pub fn evaluate<T: Real>(
    oscillation: &Oscillation<T>,
    time_positive_s: T,
    time_negative_s: T,
) -> Result<Table3<T>, PaperError> {
    Ok(Table3 {
        parameters: oscillation.identify()?,
        disturbance_from_times: disturbance_from_times(oscillation.relay_level, time_positive_s, time_negative_s),
    })
}

/// Table 3 as formulas, with the delay corrected (eq. 34) or, as in the paper's table, without delay.
///
/// They hold where condition 40 does: the symbols lie in intervals (1 to 2 for x_a, -1 to 1 for x_0, 9 to 10 for X_m) in which the
/// sweep passes both switching levels, so that the limits the program puts on breakpoints do not act.
///
/// # Errors
/// None in practice: the intervals are in the formulas' domain.
pub fn formulas(delayed: bool) -> Result<Table3<Expression>, PaperError> {
    let symbol =
        |text, latex, from, to| Expression::symbol(text, latex, Interval::point(from).hull(Interval::point(to)));
    let omega = symbol("w", r"\omega", 1.0, 2.0);
    let oscillation = Oscillation {
        relay_level: symbol("C", "C", 1.0, 2.0),
        switch_level: symbol("x_a", "x_a", 1.0, 2.0),
        amplitude: symbol("X_m", "X_m", 9.0, 10.0),
        bias: symbol("x_0", "x_0", -1.0, 1.0),
        period_s: Expression::two() * Expression::pi() / omega,
        delay_s: if delayed { symbol("T_d", "T_d", 0.0, 1.0) } else { Expression::zero() },
    };
    evaluate(&oscillation, symbol("t_plus", "t_+", 1.0, 2.0), symbol("t_minus", "t_-", 1.0, 2.0))
}
