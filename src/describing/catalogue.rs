//! Every characteristic by name, as the command line and the generated pages know it.

use super::ClosedForm;
use crate::nonlinearity::{
    Absolute, Backlash, Catalogued, DeadZone, DeadZoneSaturation, GainChanging, NonlinearityError, Parameter, Power,
    Preload, Quantizer, Relay, RelayDeadZone, RelayDeadZoneHysteresis, RelayHysteresis, Saturation,
    SaturationAsymmetric,
};
use crate::numeric::Scalar;

/// A characteristic of the catalogue, in the arithmetic `T`.
pub type Boxed<T> = Box<dyn ClosedForm<Number = T>>;

/// Why a name and its settings do not make a characteristic.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CatalogueError {
    /// No such name.
    #[error("unknown characteristic `{name}`; known: {known}")]
    UnknownName {
        /// The name given.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A setting that the characteristic does not have.
    #[error("{characteristic} has no parameter `{parameter}`; it has: {known}")]
    UnknownParameter {
        /// Catalogue name.
        characteristic: &'static str,
        /// The name given.
        parameter: String,
        /// The parameters there are.
        known: String,
    },
    /// A parameter without default that was not given.
    #[error("{characteristic} needs {parameter} ({meaning}); add --set {parameter}=VALUE")]
    MissingParameter {
        /// Catalogue name.
        characteristic: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// Its meaning.
        meaning: &'static str,
    },
    /// A parameter outside its domain.
    #[error(transparent)]
    Nonlinearity(#[from] NonlinearityError),
}

/// Name and parameters of a characteristic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Name on the command line.
    pub name: &'static str,
    /// Its parameters, in the order in which [`Entry::build`] takes their values.
    pub parameters: &'static [Parameter],
}

impl Entry {
    /// The entry of that name.
    ///
    /// # Errors
    /// [`CatalogueError::UnknownName`], with the names there are.
    pub fn find(name: &str) -> Result<&'static Self, CatalogueError> {
        CATALOGUE.iter().find(|entry| entry.name == name).ok_or_else(|| CatalogueError::UnknownName {
            name: name.to_owned(),
            known: CATALOGUE.iter().map(|entry| entry.name).collect::<Vec<_>>().join(", "),
        })
    }

    /// One value for each parameter, in order: from the settings, else the default.
    ///
    /// # Errors
    /// [`CatalogueError::UnknownParameter`] and [`CatalogueError::MissingParameter`].
    pub fn values(&self, settings: &[(String, f64)]) -> Result<Vec<f64>, CatalogueError> {
        if let Some((unknown, _)) = settings.iter().find(|(name, _)| self.parameters.iter().all(|p| p.name != name)) {
            return Err(CatalogueError::UnknownParameter {
                characteristic: self.name,
                parameter: unknown.clone(),
                known: self.parameters.iter().map(|p| p.name).collect::<Vec<_>>().join(", "),
            });
        }
        let value = |parameter: &Parameter| {
            let set = settings.iter().rev().find(|(name, _)| name == parameter.name).map(|(_, value)| *value);
            set.or(parameter.default).ok_or(CatalogueError::MissingParameter {
                characteristic: self.name,
                parameter: parameter.name,
                meaning: parameter.meaning,
            })
        };
        self.parameters.iter().map(value).collect()
    }
}

/// One line a characteristic: its type.
macro_rules! catalogue {
    ($($type:ident),+ $(,)?) => {
        /// Every characteristic that has a name.
        pub const CATALOGUE: &[Entry] = &[$(
            Entry {
                name: <$type<f64> as Catalogued<f64>>::NAME,
                parameters: <$type<f64> as Catalogued<f64>>::PARAMETERS,
            }
        ),+];

        impl Entry {
            /// The characteristic with these parameter values, in their arithmetic.
            ///
            /// # Errors
            /// [`CatalogueError::Nonlinearity`] where a value is outside its domain.
            ///
            /// ```
            /// use selfosc::describing::Entry;
            /// use selfosc::nonlinearity::Sinusoid;
            /// let entry = Entry::find("saturation")?;
            /// let saturation = entry.build(&entry.values(&[("breakpoint".into(), 0.5)])?)?;
            /// let df = saturation.describing_function(&Sinusoid::new(0.0, 0.4)?)?;
            /// assert!((df.p - 1.0).abs() < 1e-15);
            /// # Ok::<(), Box<dyn std::error::Error>>(())
            /// ```
            pub fn build<T: Scalar>(&self, values: &[T]) -> Result<Boxed<T>, CatalogueError> {
                $(
                    if self.name == <$type<T> as Catalogued<T>>::NAME {
                        return Ok(Box::new($type::from_values(values)?));
                    }
                )+
                Err(CatalogueError::UnknownName { name: self.name.to_owned(), known: String::new() })
            }
        }
    };
}

catalogue![
    Relay,
    RelayDeadZone,
    RelayHysteresis,
    RelayDeadZoneHysteresis,
    Saturation,
    SaturationAsymmetric,
    DeadZone,
    DeadZoneSaturation,
    GainChanging,
    Preload,
    Quantizer,
    Power,
    Absolute,
    Backlash,
];
