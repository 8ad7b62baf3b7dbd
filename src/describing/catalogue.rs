//! Every characteristic by name, as the command line and the generated pages know it.

use super::{ClosedForm, Setting};
use crate::files::{LONGEST_WORD, cut};
use crate::nonlinearity::{self, Catalogued, NonlinearityError, ParameterDomain, ParameterSpec, every_characteristic};
use crate::numeric::special::Special;

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
    /// A number where points are wanted, or the other way round.
    #[error("{characteristic}: {parameter} = {value} must be {required}; give it in that form")]
    Kind {
        /// Catalogue name.
        characteristic: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// What was given.
        value: Setting,
        /// What the parameter has to be.
        required: &'static str,
    },
    /// A setting that is neither a number nor points.
    #[error("`{part}` in `{text}` is no number; write a number, or points as x0:y0,x1:y1,...")]
    Setting {
        /// What was given.
        text: String,
        /// The part that is no number.
        part: String,
    },
    /// A parameter outside its domain.
    #[error(transparent)]
    Nonlinearity(#[from] NonlinearityError),
}

crate::numeric::codes! { pub CatalogueError {
    UnknownName => "unknown-characteristic", UnknownParameter => "unknown-parameter",
    MissingParameter => "missing-parameter", Kind => "parameter-kind", Setting => "unreadable-setting",
    Nonlinearity.0,
} }

/// Name, parameters and page of a characteristic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Name on the command line.
    pub name: &'static str,
    /// Its parameters, in the order in which [`Entry::build`] takes their values.
    pub parameters: &'static [ParameterSpec],
    /// Pairs of parameters of which the first has to be below the second.
    pub ordered: &'static [(&'static str, &'static str)],
    /// Its page, Markdown: formula, domain, limits, source.
    pub page: &'static str,
}

impl Entry {
    /// The entry of that name.
    ///
    /// # Errors
    /// [`CatalogueError::UnknownName`], with the names there are.
    pub fn find(name: &str) -> Result<&'static Self, CatalogueError> {
        CATALOGUE.iter().find(|entry| entry.name == name).ok_or_else(|| CatalogueError::UnknownName {
            name: cut(name, LONGEST_WORD),
            known: CATALOGUE.iter().map(|entry| entry.name).collect::<Vec<_>>().join(", "),
        })
    }

    /// The values of the parameters, in order: from the settings (the last one of a name counts), else the default. Points
    /// take two values each.
    ///
    /// # Errors
    /// [`CatalogueError::UnknownParameter`], [`CatalogueError::MissingParameter`], [`CatalogueError::Kind`].
    pub fn values<S>(&self, settings: &[(String, S)]) -> Result<Vec<f64>, CatalogueError>
    where
        S: Clone + Into<Setting>,
    {
        if let Some((unknown, _)) = settings.iter().find(|(name, _)| self.parameters.iter().all(|p| p.name != name)) {
            return Err(CatalogueError::UnknownParameter {
                characteristic: self.name,
                parameter: cut(unknown, LONGEST_WORD),
                known: self.parameters.iter().map(|p| p.name).collect::<Vec<_>>().join(", "),
            });
        }
        let mut values = Vec::new();
        for parameter in self.parameters {
            let set =
                settings.iter().rev().find(|(name, _)| name == parameter.name).map(|(_, value)| value.clone().into());
            let value = set.or(parameter.default.map(Setting::Number)).ok_or(CatalogueError::MissingParameter {
                characteristic: self.name,
                parameter: parameter.name,
                meaning: parameter.meaning,
            })?;
            if matches!(value, Setting::Points(_)) != (parameter.domain == ParameterDomain::Points) {
                let (characteristic, required) = (self.name, parameter.domain.words());
                return Err(CatalogueError::Kind { characteristic, parameter: parameter.name, value, required });
            }
            values.extend(value.numbers());
        }
        Ok(values)
    }

    /// The opposite of [`values`](Self::values): each parameter with its setting.
    #[must_use]
    pub fn settings(&self, values: &[f64]) -> Vec<(&'static str, Setting)> {
        let setting = |(place, parameter): (usize, &ParameterSpec)| {
            let values = values.get(place..)?;
            let setting = match parameter.domain {
                ParameterDomain::Points => {
                    Setting::Points(values.chunks_exact(2).map(|point| (point[0], point[1])).collect())
                }
                _ => Setting::Number(*values.first()?),
            };
            Some((parameter.name, setting))
        };
        self.parameters.iter().enumerate().filter_map(setting).collect()
    }
}

/// One line a characteristic: its type.
macro_rules! catalogue {
    ($($module:ident::$type:ident),+ $(,)?) => {
        /// Every characteristic that has a name.
        pub const CATALOGUE: &[Entry] = &[$(
            Entry {
                name: <$type<f64> as Catalogued<f64>>::NAME,
                parameters: <$type<f64> as Catalogued<f64>>::PARAMETERS,
                ordered: <$type<f64> as Catalogued<f64>>::ORDERED,
                page: <$type<f64> as Catalogued<f64>>::SPEC,
            }
        ),+];

        impl Entry {
            /// The characteristic with these parameter values, in their arithmetic: floats, dual numbers, intervals, jets.
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
            pub fn build<T: Special>(&self, values: &[T]) -> Result<Boxed<T>, CatalogueError> {
                $(
                    if self.name == <$type<T> as Catalogued<T>>::NAME {
                        return Ok(Box::new(<$type<T>>::from_values(values)?));
                    }
                )+
                Err(CatalogueError::UnknownName { name: self.name.to_owned(), known: String::new() })
            }
        }
    };
}

use nonlinearity::*;
/// Points in the catalogue are owned.
type Polyline<T> = nonlinearity::Polyline<T, Vec<(T, T)>>;

every_characteristic!(catalogue);
