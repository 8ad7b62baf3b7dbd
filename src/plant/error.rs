//! What can be wrong with a plant.

/// Why a plant cannot be built. Values are in the caller's units.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlantError {
    /// A parameter outside its domain.
    #[error("{parameter} = {value} {unit} must be {required}; give it such a value")]
    Parameter {
        /// Name of the parameter.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// Its unit, for a force F or torque acting on a coordinate x.
        unit: &'static str,
        /// What the parameter has to be.
        required: &'static str,
    },
}
