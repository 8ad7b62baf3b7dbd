//! Margins of inequalities: by a formula in every arithmetic that a proof or its reader needs.

use serde::{Deserialize, Serialize};

use super::{Expression, Gradient};
use crate::numeric::{Interval, Jet};

/// Unknowns of an inequality, used or not.
pub const VARIABLES: usize = 3;

/// A box: an interval for each unknown.
pub type VariableBox = [Interval; VARIABLES];

/// Taylor coefficients up to the third.
pub type TaylorJet = Jet<4>;

/// Partial derivatives with their own partial derivatives.
pub type Curvature = crate::numeric::Gradient<Gradient<VARIABLES>, VARIABLES>;

/// A formula, as each arithmetic evaluates it; by [`formula!`](crate::proof::formula) from a single generic function or closure.
#[derive(Clone, Copy, Debug)]
pub struct Formula {
    /// Over a box.
    pub interval: fn([Interval; VARIABLES]) -> Interval,
    /// With its partial derivatives.
    pub gradient: fn([Gradient<VARIABLES>; VARIABLES]) -> Gradient<VARIABLES>,
    /// With its second derivatives.
    pub curvature: fn([Curvature; VARIABLES]) -> Curvature,
    /// In powers of a single variable.
    pub series: fn([TaylorJet; VARIABLES]) -> TaylorJet,
    /// The formula itself, to print.
    pub expression: fn([Expression; VARIABLES]) -> Expression,
}

/// The [`Formula`] of a function, or of a closure, generic over [`Real`](crate::numeric::Real), of an array of three variables.
#[macro_export]
#[doc(hidden)]
macro_rules! formula {
    ($function:expr) => {
        $crate::proof::margin::Formula {
            interval: $function,
            gradient: $function,
            curvature: $function,
            series: $function,
            expression: $function,
        }
    };
}
pub use formula;

/// The quantity that an inequality claims positive, and the form of its enclosure.
#[derive(Clone, Copy, Debug)]
pub enum Margin {
    /// The formula's value.
    Value(Formula),
    /// Its derivative by a variable: the formula grows with it.
    Slope {
        /// What grows.
        of: Formula,
        /// The variable's place.
        by: usize,
    },
    /// Its value beyond `near`; on a cell that reaches no further, its value over the power `order` of the first variable: it
    /// has a zero of that order at zero, which is checked.
    OverPower {
        /// What is positive.
        of: Formula,
        /// At most three.
        order: usize,
        /// Where the power is divided out.
        near: f64,
    },
    /// An enclosure in intervals that no single formula gives.
    Enclosed(fn(&VariableBox) -> Interval),
    /// An enclosure in intervals of a formula that is 0/0 at an end of its range, where its limit is enclosed.
    Curve {
        /// The enclosure.
        over: fn(&VariableBox) -> Interval,
        /// The formula beside that end, to print.
        expression: fn([Expression; VARIABLES]) -> Option<Expression>,
    },
}

/// A [`Margin`] without its formula.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Form {
    /// [`Margin::Value`].
    Value,
    /// [`Margin::Slope`].
    Slope {
        /// The variable's place.
        by: usize,
    },
    /// [`Margin::OverPower`].
    OverPower {
        /// The power.
        order: usize,
        /// Where it is divided out.
        near: f64,
    },
    /// [`Margin::Enclosed`] or [`Margin::Curve`].
    Enclosed,
}

impl Margin {
    /// An enclosure over a box.
    #[must_use]
    pub fn over(&self, at: &VariableBox) -> Interval {
        match *self {
            Self::Value(formula) => (formula.interval)(*at),
            Self::Slope { of, by } => slope(of, by, at),
            Self::OverPower { of, order, near } if at[0].upper() <= near => over_power(of, order, at),
            Self::OverPower { of, .. } => (of.interval)(*at),
            Self::Enclosed(enclosure) | Self::Curve { over: enclosure, .. } => enclosure(at),
        }
    }

    /// How the formula makes the margin, in a certificate's words.
    #[must_use]
    pub fn form(&self) -> Form {
        match *self {
            Self::Value(_) => Form::Value,
            Self::Slope { by, .. } => Form::Slope { by },
            Self::OverPower { order, near, .. } => Form::OverPower { order, near },
            Self::Enclosed(_) | Self::Curve { .. } => Form::Enclosed,
        }
    }

    /// The formula in every arithmetic, if there is one.
    #[must_use]
    pub fn formula(&self) -> Option<Formula> {
        match *self {
            Self::Value(of) | Self::Slope { of, .. } | Self::OverPower { of, .. } => Some(of),
            Self::Enclosed(_) | Self::Curve { .. } => None,
        }
    }

    /// The formula of these quantities, to print, if there is one.
    #[must_use]
    pub fn expression(&self, at: [Expression; VARIABLES]) -> Option<Expression> {
        match *self {
            Self::Curve { expression, .. } => expression(at),
            _ => self.formula().map(|formula| (formula.expression)(at)),
        }
    }
}

/// By the derivative over the box, and by that at its middle with the mean value theorem, whichever is narrower at either end.
fn slope(of: Formula, by: usize, at: &VariableBox) -> Interval {
    let direct = (of.gradient)(Gradient::variables(*at)).slopes()[by];
    let middle = at.map(|side| Interval::point(side.midpoint()));
    let at_middle = (of.gradient)(Gradient::variables(middle)).slopes()[by];
    let bends = (of.curvature)(Curvature::variables(Gradient::variables(*at))).slopes()[by].slopes();
    let offsets = at.iter().zip(middle).map(|(side, middle)| *side - middle);
    let centred = bends.into_iter().zip(offsets).fold(at_middle, |sum, (bend, offset)| sum + bend * offset);
    direct.intersection(centred).unwrap_or(direct)
}

/// By Taylor's theorem at zero, the last coefficient between zero and the points of `at`; no bound unless the lower coefficients
/// are zero.
fn over_power(of: Formula, order: usize, at: &VariableBox) -> Interval {
    let mut at_zero = *at;
    at_zero[0] = Interval::ZERO;
    // Derivatives, whose operations keep an exact zero; sums of products in a jet round.
    let zero = (of.curvature)(Curvature::variables(Gradient::variables(at_zero)));
    let lower = [zero.value().value(), zero.slopes()[0].value(), zero.slopes()[0].slopes()[0]];
    let mut variables = at.map(TaylorJet::constant);
    variables[0] = TaylorJet::variable(at[0].hull(Interval::ZERO));
    match (lower.get(..order), (of.series)(variables).coefficients().get(order)) {
        (Some(lower), Some(&last)) if lower.iter().all(|value| *value == Interval::ZERO) => last,
        _ => Interval::ENTIRE,
    }
}
