//! Why there is no describing function.

use crate::nonlinearity::NonlinearityError;
use crate::numeric::OutOfDomain;
use crate::numeric::domain::{About, Plain};

/// Why a describing function cannot be given. Values are in the caller's input and output units.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DescribingError {
    /// The characteristic or its input is at fault.
    #[error(transparent)]
    Nonlinearity(#[from] NonlinearityError),
    /// Quadrature ran out of cells before the error estimate met the tolerance.
    #[error(
        "quadrature stopped at an estimated error of {} (limit {}) after {cells} cells; give the input values at which the \
         characteristic has kinks, a smaller amplitude, or a smoother characteristic", About(*.estimate), About(*.tolerance)
    )]
    Quadrature {
        /// Estimated error of the integral.
        estimate: f64,
        /// The error asked for.
        tolerance: f64,
        /// Cells used.
        cells: usize,
    },
    /// The output is not a number somewhere on the sweep.
    #[error("the output is {} at input {}; restrict amplitude and bias to where the function is finite", Plain(*.output), Plain(*.input))]
    NotFinite {
        /// The input.
        input: f64,
        /// The output there.
        output: f64,
    },
    /// No closed form for this case.
    #[error(
        "{characteristic}: no closed form with bias = {} and exponent = {}; give a bias of 0, an exponent with a closed form, or \
         compute by quadrature (--method quadrature)", Plain(*.bias), Plain(*.exponent)
    )]
    NoClosedForm {
        /// Catalogue name of the characteristic.
        characteristic: &'static str,
        /// Bias of the input.
        bias: f64,
        /// Exponent of the power law.
        exponent: f64,
    },
}

crate::numeric::codes! { pub DescribingError {
    Nonlinearity.0, Quadrature => "quadrature", NotFinite => "output-not-finite", NoClosedForm => "no-closed-form",
} }

impl From<OutOfDomain> for DescribingError {
    fn from(fault: OutOfDomain) -> Self {
        Self::Nonlinearity(fault.into())
    }
}
