//! The example that each page gives: parameter values and an amplitude that show what the characteristic does.

use super::{CatalogueError, DescribingError, DescribingFunction, Entry, Setting, over_amplitudes};

/// What a page's line `Sketch: amplitude = 2; slope = 1; ...` says.
#[derive(Clone, Debug, PartialEq)]
pub struct Example {
    /// Amplitude of the sweep that the sketch shows, in input units.
    pub amplitude: f64,
    /// Parameter values, as [`Entry::build`] takes them.
    pub values: Vec<f64>,
}

/// A describing function over amplitude at one bias: `(amplitude, F_0 P Q)`, or why there is none.
pub type Curve = Vec<(f64, Result<DescribingFunction<f64>, DescribingError>)>;

impl Entry {
    /// The example on the page of this characteristic.
    ///
    /// # Errors
    /// [`CatalogueError::Page`] where the line is missing or cannot be read; the errors of [`Entry::values`].
    pub fn example(&self) -> Result<Example, CatalogueError> {
        let fault = |fault| CatalogueError::Page { characteristic: self.name, fault };
        let line = self.page.lines().find_map(|line| line.strip_prefix("Sketch: "));
        let (mut amplitude, mut settings) = (None, Vec::new());
        for item in line.ok_or(fault("no line `Sketch: `"))?.trim_end_matches('.').split(';') {
            let (name, value) = item.split_once('=').ok_or(fault("an item of the sketch is not `name = value`"))?;
            match (name.trim(), value.trim().parse()?) {
                ("amplitude", Setting::Number(number)) => amplitude = Some(number),
                (name, value) => settings.push((name.to_owned(), value)),
            }
        }
        let amplitude = amplitude.ok_or(fault("the sketch has no `amplitude`"))?;
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
