//! The example that each page gives: parameter values and an amplitude that show what the characteristic does.

use super::{CatalogueError, DescribingError, DescribingFunction, Entry, Setting, over_amplitudes};

/// Amplitude and parameter values that show what a characteristic does.
#[derive(Clone, Debug, PartialEq)]
pub struct Example {
    /// Amplitude of the sweep that the figure shows, in input units.
    pub amplitude: f64,
    /// Parameter values, as [`Entry::build`] takes them.
    pub values: Vec<f64>,
}

/// A describing function over amplitude at one bias: `(amplitude, F_0 P Q)`, or why there is none.
pub type Curve = Vec<(f64, Result<DescribingFunction<f64>, DescribingError>)>;

impl Entry {
    /// The example on the page of this characteristic, its line `Sketch: amplitude = 1; level = 1; half_width = 0.4.`
    ///
    /// # Errors
    /// As [`Entry::values`], of a page whose line does not give the amplitude and every parameter.
    pub fn example(&self) -> Result<Example, CatalogueError> {
        let line = self.page.lines().find_map(|line| line.strip_prefix("Sketch: ")).unwrap_or_default();
        let setting = |item: &str| {
            let (name, value) = item.split_once(" = ").unwrap_or((item, ""));
            Ok((name.to_owned(), value.parse()?))
        };
        let items = line.trim_end_matches('.').split("; ").map(setting);
        let (amplitude, settings): (Vec<_>, Vec<_>) = items
            .collect::<Result<Vec<(String, Setting)>, CatalogueError>>()?
            .into_iter()
            .partition(|(name, _)| name == "amplitude");
        let [(_, Setting::Number(amplitude))] = amplitude[..] else {
            let meaning = "of the page's sketch";
            return Err(CatalogueError::MissingParameter {
                characteristic: self.name,
                parameter: "amplitude",
                meaning,
            });
        };
        Ok(Example { amplitude, values: self.values(&settings)? })
    }

    /// `F_0`, `P`, `Q` of the characteristic with these parameter values over `amplitudes` at one bias.
    ///
    /// # Errors
    /// As [`Entry::build`]. An amplitude without describing function keeps its own error.
    ///
    /// ```
    /// use selfosc::describing::CATALOGUE;
    /// for entry in CATALOGUE {
    ///     let example = entry.example()?;
    ///     let amplitudes: Vec<f64> = (1..=50).map(|step| example.amplitude * f64::from(step) / 25.0).collect();
    ///     let curve = entry.curve(&example.values, 0.0, &amplitudes)?;
    ///     assert!(curve.last().is_some_and(|(_, df)| df.is_ok()));
    /// }
    /// # Ok::<(), selfosc::describing::CatalogueError>(())
    /// ```
    pub fn curve(&self, values: &[f64], bias: f64, amplitudes: &[f64]) -> Result<Curve, CatalogueError> {
        let characteristic = self.build(values)?;
        let results = over_amplitudes(&*characteristic, bias, amplitudes.iter().copied());
        Ok(amplitudes.iter().copied().zip(results).collect())
    }
}
