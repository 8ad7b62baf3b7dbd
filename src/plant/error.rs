//! What can be wrong with a plant.

use crate::numeric::OutOfDomain;
use crate::numeric::domain::About;

/// Why a plant cannot be built. Values are in the caller's units.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlantError {
    /// A parameter outside its domain.
    #[error(transparent)]
    OutOfDomain(#[from] OutOfDomain),
    /// A polynomial without coefficients.
    #[error("the {polynomial} has no coefficients; give them in descending powers of s")]
    NoCoefficients {
        /// Numerator or denominator.
        polynomial: &'static str,
    },
    /// An entry that is not a finite number.
    #[error("entry {index} of the {part} is {value}: must be finite; give numbers")]
    NotFinite {
        /// Polynomial or matrix.
        part: &'static str,
        /// Its place, from zero, column by column in a matrix.
        index: usize,
        /// The value given.
        value: f64,
    },
    /// A polynomial whose first coefficient is zero: its degree is less than its length implies.
    #[error("the {polynomial} must begin with a coefficient other than 0; leave out the zeros before it")]
    LeadingZero {
        /// Numerator or denominator.
        polynomial: &'static str,
    },
    /// Numerator and denominator both vanish at s = 0.
    #[error("numerator and denominator share the factor s; cancel it")]
    CommonFactor,
    /// A numerator of higher degree than the denominator.
    #[error(
        "numerator of degree {numerator} over denominator of degree {denominator} is improper; \
         the numerator's degree may be {denominator} at most; add the lags that the plant has"
    )]
    Improper {
        /// Degree of the numerator.
        numerator: usize,
        /// Degree of the denominator.
        denominator: usize,
    },
    /// A plant that passes its input straight through, where a state space without feedthrough is asked for.
    #[error(
        "numerator and denominator both have degree {degree}: the numerator's must be lower; add the lag that the plant has"
    )]
    NotStrictlyProper {
        /// The common degree.
        degree: usize,
    },
    /// An order of Padé approximant that is not available.
    #[error("a Pade approximant of order {order} is not available; use 1 to {limit}")]
    PadeOrder {
        /// The order asked for.
        order: usize,
        /// The highest there is.
        limit: usize,
    },
    /// Matrices that do not fit together.
    #[error(
        "a is {rows} by {columns}, b has {inputs} rows, c has {outputs} columns; all four must be equal and above 0"
    )]
    Shape {
        /// Rows of a.
        rows: usize,
        /// Columns of a.
        columns: usize,
        /// Rows of b.
        inputs: usize,
        /// Columns of c.
        outputs: usize,
    },
    /// The frequency response at a pole on the imaginary axis.
    #[error("the plant has a pole at s = {}j: no frequency response there; choose another frequency", About(*.omega_rad_s))]
    PoleAt {
        /// The frequency, rad/s.
        omega_rad_s: f64,
    },
    /// The eigenvalue iteration did not converge.
    #[error("the eigenvalues of a matrix of order {order} did not converge; scale the plant's time unit")]
    Eigenvalues {
        /// Order of the matrix.
        order: usize,
    },
}

crate::numeric::codes! { pub PlantError {
    OutOfDomain.0, NoCoefficients => "no-coefficients", NotFinite => "entry-not-finite",
    LeadingZero => "leading-zero", CommonFactor => "common-factor", Improper => "improper",
    NotStrictlyProper => "not-strictly-proper", PadeOrder => "pade-order", Shape => "matrix-shape",
    PoleAt => "pole-at-frequency", Eigenvalues => "eigenvalues",
} }
