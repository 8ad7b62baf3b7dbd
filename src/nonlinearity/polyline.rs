use super::{Branch, Kernel, NonlinearityError, PiecewiseLinear, Sinusoid};
#[cfg(feature = "std")]
use super::{Catalogued, ParameterDomain, ParameterSpec};
use crate::numeric::{Limit, Real, domain};

#[doc = super::parameter::document!("piecewise-linear")]
///
/// The points are an array, a slice, or a vector: nothing is allocated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polyline<T, S> {
    points: S,
    left_slope: T,
    right_slope: T,
}

impl<T: Real, S: AsRef<[(T, T)]>> Polyline<T, S> {
    /// Through the points `(input, output)`, with `left_slope` before the first and `right_slope` after the last, in output
    /// units per input unit.
    ///
    /// # Errors
    /// [`NonlinearityError::Parameter`] where there is no point or a number is not finite, [`NonlinearityError::Order`]
    /// where an input is not above the one before it.
    ///
    /// ```
    /// use selfosc::describing::ClosedForm;
    /// use selfosc::nonlinearity::{Polyline, Sinusoid};
    /// let thruster = Polyline::new([(-1.0f64, -0.8), (-0.2, 0.0), (0.1, 0.0), (1.0, 1.2)], 0.0, 0.0)?;
    /// let df = thruster.describing_function(&Sinusoid::new(0.0, 0.1)?)?;
    /// assert!(df.p.abs() < 1e-15);
    /// # Ok::<(), selfosc::describing::DescribingError>(())
    /// ```
    pub fn new(points: S, left_slope: T, right_slope: T) -> Result<Self, NonlinearityError> {
        let characteristic = "piecewise-linear";
        let fault = |fault| NonlinearityError::Parameter { characteristic, fault };
        let all = points.as_ref();
        let given = T::from_f64(all.len() as f64);
        domain::require("number of points", given, "", Limit::AtLeast(1.0), "give one point x:y or more")
            .map_err(fault)?;
        let slopes = [("left_slope", left_slope), ("right_slope", right_slope)];
        let coordinates = all.iter().flat_map(|&(x, y)| [("points", x), ("points", y)]);
        for (parameter, number) in slopes.into_iter().chain(coordinates) {
            domain::finite(parameter, number, "").map_err(fault)?;
        }
        for pair in all.windows(2) {
            let (previous, next) = (("an input of points", pair[0].0), ("the next input", pair[1].0));
            super::parameter::ordered(characteristic, previous, next)?;
        }
        Ok(Self { points, left_slope, right_slope })
    }

    /// Measured points, the output constant outside their range.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn measured(points: S) -> Result<Self, NonlinearityError> {
        Self::new(points, T::zero(), T::zero())
    }

    /// The points `(input, output)`.
    pub fn points(&self) -> &[(T, T)] {
        self.points.as_ref()
    }
    /// Slope before the first point, output units per input unit.
    pub fn left_slope(&self) -> T {
        self.left_slope
    }
    /// Slope after the last point, output units per input unit.
    pub fn right_slope(&self) -> T {
        self.right_slope
    }
}

#[cfg(feature = "std")]
impl<T: Real> Catalogued<T> for Polyline<T, Vec<(T, T)>> {
    const NAME: &'static str = "piecewise-linear";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec {
            name: "left_slope",
            meaning: "Slope before the first point, output units per input unit.",
            domain: ParameterDomain::Finite,
            default: None,
        },
        ParameterSpec {
            name: "right_slope",
            meaning: "Slope after the last point, output units per input unit.",
            domain: ParameterDomain::Finite,
            default: None,
        },
        ParameterSpec {
            name: "points",
            meaning: "Points input:output, separated by commas, in input and output units.",
            domain: ParameterDomain::Points,
            default: None,
        },
    ];
    const ORDERED: &'static [(&'static str, &'static str)] = &[];
    const SPEC: &'static str = super::parameter::specification!("piecewise-linear");

    fn from_values(values: &[T]) -> Result<Self, NonlinearityError> {
        let mut slopes = values.iter().copied().chain(core::iter::repeat(T::from_f64(f64::NAN)));
        let mut slope = || slopes.next().unwrap_or_else(T::zero);
        let (left, right) = (slope(), slope());
        let points = values.get(2..).unwrap_or_default().chunks_exact(2).map(|point| (point[0], point[1])).collect();
        Self::new(points, left, right)
    }
}

/// Slope of the straight line through two points.
fn slope<T: Real>(from: (T, T), to: (T, T)) -> T {
    (to.1 - from.1) / (to.0 - from.0)
}

impl<T: Real, S: AsRef<[(T, T)]>> PiecewiseLinear for Polyline<T, S> {
    type Number = T;

    fn value(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        let points = self.points();
        let (Some(&first), Some(&last)) = (points.first(), points.last()) else { return T::zero() };
        let before = first.1 + self.left_slope * (x - first.0);
        let inside = points.windows(2).fold(before, |value, pair| {
            (x - pair[0].0).select(|| value, || pair[0].1 + slope(pair[0], pair[1]) * (x - pair[0].0))
        });
        (x - last.0).select(|| inside, || last.1 + self.right_slope * (x - last.0))
    }

    /// Each segment is a band that counts from its end nearer the bias, so that a segment out of reach adds nothing and
    /// takes no accuracy. A level one is not reported.
    fn kernels(&self, sweep: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        let points = self.points();
        let (Some(&first), Some(&last)) = (points.first(), points.last()) else { return };
        let middle = sweep.bias().bounds().0;
        let anchor = points.iter().rev().find(|point| point.0.bounds().0 <= middle).unwrap_or(&first);
        report(Kernel::constant(anchor.1));
        if !self.left_slope.vanishes() {
            report(Kernel::ramp_below(first.0, -self.left_slope));
        }
        if !self.right_slope.vanishes() {
            report(Kernel::ramp_above(last.0, self.right_slope));
        }
        for pair in points.windows(2) {
            let slope = slope(pair[0], pair[1]);
            if !slope.vanishes() {
                let nearer = if pair[0].0.bounds().0 < anchor.0.bounds().0 { pair[1].0 } else { pair[0].0 };
                report(Kernel::Band { origin: nearer, lower: pair[0].0, upper: pair[1].0, slope });
            }
        }
    }
}
