//! What can be wrong with a characteristic or its input.

use crate::numeric::OutOfDomain;
use crate::numeric::domain::{About, Plain};

/// Why a characteristic cannot be built or has no periodic output. Values are in the caller's input and output units.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NonlinearityError {
    /// A parameter outside its domain.
    #[error("{characteristic}: {fault}")]
    Parameter {
        /// Catalogue name of the characteristic.
        characteristic: &'static str,
        /// The parameter, its value and its domain.
        fault: OutOfDomain,
    },
    /// An amplitude or bias outside its domain.
    #[error(transparent)]
    OutOfDomain(#[from] OutOfDomain),
    /// Two parameters in the wrong order.
    #[error(
        "{characteristic}: {lesser} = {} must be below {greater} = {}; exchange or separate them",
        Plain(*.lesser_value), Plain(*.greater_value)
    )]
    Order {
        /// Catalogue name of the characteristic.
        characteristic: &'static str,
        /// Name of the parameter that has to be the smaller one.
        lesser: &'static str,
        /// Its value.
        lesser_value: f64,
        /// Name of the parameter that has to be the larger one.
        greater: &'static str,
        /// Its value.
        greater_value: f64,
    },
    /// The input never reaches a switching level, so that the output does not oscillate (the paper's condition 40).
    #[error(
        "{characteristic}: amplitude = {} with bias = {} does not switch both ways; \
         it needs an amplitude of at least {} (half-width plus magnitude of the bias)",
        Plain(*.amplitude), Plain(*.bias), Plain(*.required)
    )]
    BelowSwitching {
        /// Catalogue name of the characteristic.
        characteristic: &'static str,
        /// Amplitude of the input.
        amplitude: f64,
        /// Bias of the input.
        bias: f64,
        /// The smallest amplitude that switches.
        required: f64,
    },
    /// A sweep over more treads of a quantizer than are summed.
    #[error(
        "quantizer: amplitude = {} with bias = {} sweeps {} treads; at most {limit} are summed, \
         treat a finer step as a straight line",
        Plain(*.amplitude), Plain(*.bias), About(*.treads)
    )]
    Treads {
        /// Amplitude of the input.
        amplitude: f64,
        /// Bias of the input.
        bias: f64,
        /// Treads swept.
        treads: f64,
        /// The limit.
        limit: f64,
    },
}

crate::numeric::codes! { pub NonlinearityError {
    Parameter.fault, OutOfDomain.0, Order => "parameter-order", BelowSwitching => "below-switching",
    Treads => "too-many-treads",
} }
