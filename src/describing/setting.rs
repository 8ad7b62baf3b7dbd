//! The value of a parameter as a user writes it.

use core::fmt::{Display, Formatter, Result as Written};
use core::str::FromStr;

use super::CatalogueError;
use crate::files::{LONGEST_WORD, cut};

/// A number, or the points of a graph.
///
/// ```
/// use selfosc::describing::Setting;
/// assert_eq!("0.5".parse(), Ok(Setting::Number(0.5)));
/// assert_eq!("0:1,2:3".parse(), Ok(Setting::Points(vec![(0.0, 1.0), (2.0, 3.0)])));
/// assert!("0;1".parse::<Setting>().is_err());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Setting {
    /// In the units of the parameter.
    Number(f64),
    /// `(input, output)`, in input and output units.
    Points(Vec<(f64, f64)>),
}

impl Setting {
    /// The numbers in it, in order.
    pub(super) fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Number(number) => vec![*number],
            Self::Points(points) => points.iter().flat_map(|&(x, y)| [x, y]).collect(),
        }
    }
}

impl From<f64> for Setting {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<&Setting> for Setting {
    fn from(setting: &Setting) -> Self {
        setting.clone()
    }
}

impl FromStr for Setting {
    type Err = CatalogueError;

    fn from_str(text: &str) -> Result<Self, CatalogueError> {
        let number = |part: &str| {
            part.trim()
                .parse()
                .map_err(|_| CatalogueError::Setting { text: cut(text, LONGEST_WORD), part: cut(part, LONGEST_WORD) })
        };
        if !text.contains(':') {
            return number(text).map(Self::Number);
        }
        let point = |pair: &str| {
            let (x, y) = pair.split_once(':').unwrap_or((pair, ""));
            Ok((number(x)?, number(y)?))
        };
        text.split(',').map(point).collect::<Result<_, _>>().map(Self::Points)
    }
}

impl Display for Setting {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Written {
        match self {
            Self::Number(number) => write!(formatter, "{number}"),
            Self::Points(points) => {
                for (place, (x, y)) in points.iter().enumerate() {
                    write!(formatter, "{}{x}:{y}", if place == 0 { "" } else { "," })?;
                }
                Ok(())
            }
        }
    }
}
