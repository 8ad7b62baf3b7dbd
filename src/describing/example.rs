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

/// The example on the page `spec/characteristics/<name>.md`: parameters with their numbers, points as input and output in turn.
struct Page {
    name: &'static str,
    amplitude: f64,
    settings: &'static [(&'static str, &'static [f64])],
}

/// The line `Sketch: ` of each page; a test compares the two.
const PAGES: &[Page] = &[
    Page { name: "absolute", amplitude: 1.0, settings: &[("gain", &[1.0])] },
    Page { name: "arctan", amplitude: 5.0, settings: &[("gain", &[1.0]), ("scale", &[1.0])] },
    Page { name: "backlash", amplitude: 1.0, settings: &[("slope", &[1.0]), ("half_gap", &[0.3])] },
    Page {
        name: "dead-zone-saturation",
        amplitude: 1.0,
        settings: &[("slope", &[1.0]), ("half_width", &[0.25]), ("breakpoint", &[0.7])],
    },
    Page { name: "dead-zone", amplitude: 1.0, settings: &[("slope", &[1.0]), ("half_width", &[0.35])] },
    Page {
        name: "gain-changing",
        amplitude: 1.0,
        settings: &[("inner_slope", &[1.0]), ("outer_slope", &[0.3]), ("breakpoint", &[0.4])],
    },
    Page {
        name: "piecewise-linear",
        amplitude: 1.0,
        settings: &[
            ("points", &[-0.6, -0.8, -0.2, -0.1, 0.1, 0.1, 0.5, 0.3, 0.7, 0.9]),
            ("left_slope", &[0.0]),
            ("right_slope", &[0.5]),
        ],
    },
    Page { name: "polynomial", amplitude: 1.3, settings: &[("c1", &[-1.0]), ("c3", &[1.0])] },
    Page { name: "power", amplitude: 1.0, settings: &[("gain", &[1.0]), ("exponent", &[2.0])] },
    Page { name: "preload", amplitude: 1.0, settings: &[("slope", &[0.6]), ("level", &[0.4])] },
    Page { name: "quantizer", amplitude: 1.0, settings: &[("step", &[0.4])] },
    Page {
        name: "relay-dead-zone-hysteresis",
        amplitude: 1.0,
        settings: &[("level", &[1.0]), ("on", &[0.6]), ("off", &[0.3])],
    },
    Page { name: "relay-dead-zone", amplitude: 1.0, settings: &[("level", &[1.0]), ("dead_zone", &[0.3])] },
    Page {
        name: "relay-hysteresis",
        amplitude: 1.0,
        settings: &[("level", &[1.0]), ("half_width", &[0.4]), ("offset", &[0.0])],
    },
    Page { name: "relay", amplitude: 1.0, settings: &[("level", &[1.0])] },
    Page {
        name: "saturation-asymmetric",
        amplitude: 1.0,
        settings: &[("slope", &[1.0]), ("lower", &[-0.3]), ("upper", &[0.7])],
    },
    Page { name: "saturation", amplitude: 1.0, settings: &[("slope", &[1.0]), ("breakpoint", &[0.5])] },
    Page { name: "sine", amplitude: 4.0, settings: &[("gain", &[1.0]), ("frequency", &[1.0])] },
    Page { name: "sinh", amplitude: 2.0, settings: &[("gain", &[1.0]), ("scale", &[1.0])] },
    Page { name: "tanh", amplitude: 3.0, settings: &[("gain", &[1.0]), ("scale", &[1.0])] },
];

/// A describing function over amplitude at one bias: `(amplitude, F_0 P Q)`, or why there is none.
pub type Curve = Vec<(f64, Result<DescribingFunction<f64>, DescribingError>)>;

impl Entry {
    /// The example on the page of this characteristic.
    ///
    /// # Errors
    /// [`CatalogueError::UnknownName`] for an entry that is not of the catalogue; [`CatalogueError::MissingParameter`].
    pub fn example(&self) -> Result<Example, CatalogueError> {
        let page = PAGES.iter().find(|page| page.name == self.name).ok_or_else(|| CatalogueError::UnknownName {
            name: self.name.to_owned(),
            known: PAGES.iter().map(|page| page.name).collect::<Vec<_>>().join(", "),
        })?;
        let setting = |&(name, numbers): &(&str, &[f64])| {
            let setting = match numbers {
                [number] => Setting::Number(*number),
                points => Setting::Points(points.chunks_exact(2).map(|point| (point[0], point[1])).collect()),
            };
            (name.to_owned(), setting)
        };
        let settings: Vec<_> = page.settings.iter().map(setting).collect();
        Ok(Example { amplitude: page.amplitude, values: self.values(&settings)? })
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
