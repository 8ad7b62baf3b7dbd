//! What rounding can do to the closed forms of the catalogue: bounds over boxes of parameters, bias and amplitude, as each
//! page states them and `tests/properties/rounding.rs` proves them.

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

/// `0.5 to 2`, a single number, or the numbers of points, as ranges.
fn ranges(text: &str) -> Option<Vec<(f64, f64)>> {
    let single = |number: &str| number.parse().ok().map(|number| (number, number));
    match text.split_once(" to ") {
        Some((from, to)) => Some(vec![(from.parse().ok()?, to.parse().ok()?)]),
        None => text.split([':', ',']).map(single).collect(),
    }
}

/// Three numbers with commas.
fn parts(text: &str) -> Option<DescribingFunction<f64>> {
    let numbers: Vec<f64> = text.split(", ").map(|number| number.parse().ok()).collect::<Option<_>>()?;
    let &[f0, p, q] = numbers.as_slice() else { return None };
    Some(DescribingFunction { f0, p, q })
}

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
        let (_, text) = self.page.split_once("For all floats with ")?;
        let (domain, bounds) = text.split_once(", the computed `F_0`, `P`, `Q` are within ")?;
        let (domain, amplitude) = domain.split_once(" and amplitude ")?;
        let (parameters, bias) = domain.split_once(", bias ")?;
        let values = parameters.split(", ").map(|parameter| ranges(parameter.split_once("` ")?.1));
        let (double, single) = bounds.split_once(" of the exact values in f64 and within ")?;
        let [bias, amplitude] = [ranges(bias)?[0], ranges(amplitude)?[0]];
        Some(RoundingBounds {
            parameters: values.collect::<Option<Vec<_>>>()?.concat(),
            bias,
            amplitude,
            double: parts(double)?,
            single: parts(single.split_once(" in f32")?.0)?,
        })
    }
}
