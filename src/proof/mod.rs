//! Proofs over boxes: identities, inequalities, roots and integrals enclosed in interval arithmetic.

#[cfg(feature = "std")]
pub mod branch_and_bound;
pub mod enclosure;
#[cfg(feature = "std")]
mod expression;
#[cfg(feature = "std")]
pub mod identity;
#[cfg(feature = "std")]
pub mod inequality;
#[cfg(feature = "std")]
pub mod interval_matrix;
#[cfg(feature = "std")]
pub mod margin;
#[cfg(feature = "std")]
mod outcome;
#[cfg(feature = "std")]
pub mod polynomial;
#[cfg(feature = "std")]
pub mod rigorous_quadrature;
mod statement;

/// A certificate as text and from text, by a function of `serde_json`; a refusal says where reading failed.
#[cfg(feature = "std")]
macro_rules! document {
    ($certificate:ident, $refusal:ident, $written:ident) => {
        impl core::fmt::Display for $certificate {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.write_str(&serde_json::$written(self).map_err(|_| core::fmt::Error)?)
            }
        }

        impl core::str::FromStr for $certificate {
            type Err = $refusal;

            fn from_str(text: &str) -> Result<Self, $refusal> {
                serde_json::from_str(text).map_err(|error| $refusal::Malformed { text: error.to_string() })
            }
        }
    };
}
#[cfg(feature = "std")]
pub(crate) use document;

/// Enclosures of a value and its partial derivatives over a box: rigorous Jacobians from the formulas themselves.
pub type Gradient<const N: usize> = crate::numeric::Gradient<crate::numeric::Interval, N>;

#[cfg(feature = "std")]
pub use expression::Expression;
#[cfg(feature = "std")]
pub use margin::formula;
#[cfg(feature = "std")]
pub use outcome::{Bound, Extent, NotProved, Proved};
pub use statement::{Change, Unchanged};
