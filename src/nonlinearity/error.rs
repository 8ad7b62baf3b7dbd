//! What can be wrong with a characteristic or its input.

/// Why a characteristic cannot be built or has no periodic output. Values are in the caller's input and output units.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NonlinearityError {
    /// A parameter outside its domain.
    #[error("{characteristic}: {parameter} = {value} must be {required}; give it such a value")]
    Parameter {
        /// Catalogue name of the characteristic.
        characteristic: &'static str,
        /// Name of the parameter.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// What the parameter has to be.
        required: &'static str,
    },
    /// Two parameters in the wrong order.
    #[error(
        "{characteristic}: {lesser} = {lesser_value} must be below {greater} = {greater_value}; exchange or separate them"
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
    /// An amplitude that is not a positive number.
    #[error("amplitude = {amplitude} must be a finite number above 0; give the amplitude X of x = B + X sin(theta)")]
    Amplitude {
        /// The amplitude given.
        amplitude: f64,
    },
    /// A bias that is not a number.
    #[error("bias = {bias} must be a finite number; give the bias B of x = B + X sin(theta)")]
    Bias {
        /// The bias given.
        bias: f64,
    },
    /// The input never reaches a switching level, so that the output does not oscillate (the paper's condition 40).
    #[error(
        "{characteristic}: amplitude = {amplitude} with bias = {bias} does not switch both ways; \
         it needs an amplitude of at least {required} (half-width plus magnitude of the bias)"
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
        "quantizer: amplitude = {amplitude} with bias = {bias} sweeps {treads} treads; at most {limit} are summed, \
         treat a finer step as a straight line"
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
