//! What rounding can do to the closed forms of the catalogue: bounds over boxes of parameters, bias and amplitude, proved by
//! `tests/properties/rounding.rs`.

use super::{DescribingFunction, Entry};

/// Bounds of the distance between the floats and the exact values of `F_0`, `P` and `Q`, over a domain.
#[derive(Clone, Debug, PartialEq)]
pub struct RoundingBounds {
    /// Values of the parameters, as [`Entry::build`] takes them: all floats between two numbers.
    pub parameters: Vec<(f64, f64)>,
    /// Bias of the input.
    pub bias: (f64, f64),
    /// Amplitude of the input.
    pub amplitude: (f64, f64),
    /// In double precision, provided that `libm`'s functions are within a unit in the last place, hyperbolic functions within 2.5.
    pub double: DescribingFunction<f64>,
    /// In single precision.
    pub single: DescribingFunction<f64>,
}

/// Parameters, bias and amplitude, and what was proved over them: `F_0`, `P`, `Q` in double precision, then in single. No breakpoint comes
/// near a turning point of the input, where values are ill conditioned.
type RoundingRow = (&'static str, &'static [(f64, f64)], (f64, f64), (f64, f64), [f64; 3], [f64; 3]);

const GAIN: (f64, f64) = (0.5, 2.0);
const QUARTER: (f64, f64) = (-0.25, 0.25);
const HALF: (f64, f64) = (-0.5, 0.5);
const WIDE: (f64, f64) = (1.0, 4.0);
const BEYOND: (f64, f64) = (1.5, 4.0);

const fn one(value: f64) -> (f64, f64) {
    (value, value)
}

const POLYNOMIAL: [(f64, f64); 10] =
    [HALF, (0.5, 1.0), HALF, HALF, one(0.0), one(0.0), one(0.0), one(0.0), one(0.0), one(0.0)];
const POINTS: [(f64, f64); 10] =
    [(0.5, 1.0), (0.5, 1.0), one(-1.0), one(-0.75), one(-0.25), one(0.0), one(0.25), one(0.0), one(1.0), one(1.25)];

const PROVED: [RoundingRow; 20] = [
    ("relay", &[GAIN], HALF, WIDE, [2.2e-15, 8.6e-15, 0.0], [8.6e-7, 4.4e-6, 0.0]),
    ("relay-dead-zone", &[GAIN, (0.25, 0.5)], QUARTER, WIDE, [2e-15, 3.7e-15, 0.0], [8.6e-7, 1.9e-6, 0.0]),
    (
        "relay-hysteresis",
        &[GAIN, (0.25, 0.5), HALF],
        QUARTER,
        WIDE,
        [2.2e-15, 1e-14, 1.3e-15],
        [9.1e-7, 5.1e-6, 5.8e-7],
    ),
    (
        "relay-dead-zone-hysteresis",
        &[GAIN, (0.5, 0.625), (0.125, 0.25)],
        (-0.125, 0.125),
        WIDE,
        [1.8e-15, 4.8e-15, 2.4e-15],
        [7.8e-7, 2.4e-6, 1.2e-6],
    ),
    ("saturation", &[GAIN, (0.5, 1.0)], QUARTER, BEYOND, [5.3e-15, 5e-15, 0.0], [2.7e-6, 2.7e-6, 0.0]),
    (
        "saturation-asymmetric",
        &[GAIN, (-1.0, -0.5), (0.5, 1.0)],
        QUARTER,
        BEYOND,
        [6.7e-15, 7.5e-15, 0.0],
        [3.5e-6, 3.9e-6, 0.0],
    ),
    ("dead-zone", &[GAIN, (0.25, 0.5)], QUARTER, WIDE, [1.4e-14, 4.1e-15, 0.0], [6.6e-6, 1.9e-6, 0.0]),
    (
        "dead-zone-saturation",
        &[GAIN, (0.25, 0.5), (0.75, 1.0)],
        QUARTER,
        BEYOND,
        [3.5e-15, 3.5e-15, 0.0],
        [1.9e-6, 1.8e-6, 0.0],
    ),
    ("gain-changing", &[GAIN, GAIN, (0.25, 0.5)], QUARTER, WIDE, [1.6e-14, 6.3e-15, 0.0], [7.3e-6, 3.1e-6, 0.0]),
    ("preload", &[GAIN, GAIN], HALF, WIDE, [2.5e-15, 9.3e-15, 0.0], [1.1e-6, 4.8e-6, 0.0]),
    ("quantizer", &[(0.90625, 1.0)], (-0.125, 0.125), (1.75, 2.0), [1.7e-15, 2e-15, 0.0], [7.7e-7, 1.1e-6, 0.0]),
    ("power", &[GAIN, one(2.0)], HALF, WIDE, [1.1e-13, 8.2e-14, 0.0], [1.9e-6, 3.6e-6, 0.0]),
    ("polynomial", &POLYNOMIAL, HALF, (1.0, 2.0), [2.5e-15, 2e-15, 0.0], [1.3e-6, 1.1e-6, 0.0]),
    ("sine", &[GAIN, (0.5, 1.0)], HALF, (0.5, 2.0), [1.5e-15, 1.1e-14, 0.0], [3.5e-7, 1.8e-6, 0.0]),
    ("sinh", &[GAIN, (0.5, 1.0)], HALF, (0.5, 2.0), [7.6e-15, 2.8e-14, 0.0], [3e-6, 9.8e-6, 0.0]),
    ("arctan", &[GAIN, GAIN], HALF, WIDE, [1.2e-15, 3.6e-14, 0.0], [6.2e-7, 2e-5, 0.0]),
    ("tanh", &[GAIN, (0.5, 1.0)], HALF, WIDE, [1.1e-13, 2.1e-13, 0.0], [1.2e-6, 4.3e-5, 0.0]),
    ("absolute", &[GAIN], HALF, WIDE, [1.4e-14, 3.7e-15, 0.0], [6.4e-6, 1.7e-6, 0.0]),
    ("piecewise-linear", &POINTS, (-0.125, 0.125), BEYOND, [7.2e-15, 3.9e-15, 0.0], [3.5e-6, 2e-6, 0.0]),
    ("backlash", &[GAIN, (0.125, 0.25)], QUARTER, (1.0, 2.0), [2.8e-15, 4.4e-15, 9.8e-16], [1.5e-6, 2.3e-6, 4.8e-7]),
];

impl Entry {
    /// What rounding can do to the closed form, in both precisions, over a domain that is part of the answer: the worst case. A test
    /// proves it: the formula runs in an arithmetic that carries the exact value and a bound of the float's error.
    ///
    /// Absolute, in output units for `f0`, in output over input units for `p` and `q`. Nothing is said of inputs that are rounded
    /// before, and nothing outside the domain: where a breakpoint comes near a turning point of the input, the values answer to
    /// their inputs' last digits.
    ///
    /// ```
    /// use selfosc::describing::Entry;
    /// let bounds = Entry::find("relay")?.rounding_bounds().ok_or("no domain")?;
    /// assert!(bounds.double.p < 1e-14 && bounds.single.p < 1e-5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn rounding_bounds(&self) -> Option<RoundingBounds> {
        let &(_, parameters, bias, amplitude, double, single) = PROVED.iter().find(|row| row.0 == self.name)?;
        let [double, single] = [double, single].map(|[f0, p, q]| DescribingFunction { f0, p, q });
        Some(RoundingBounds { parameters: parameters.to_vec(), bias, amplitude, double, single })
    }
}
