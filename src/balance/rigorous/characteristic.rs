//! Odd characteristics of bounded slope: the data of them for the proof.

use serde::{Deserialize, Serialize};

use super::error::ExistenceError;
use crate::numeric::{Component, Gradient, Interval, Jet, Real};

/// Kinks at most: each costs a search of passages.
const MOST_KINKS: usize = 64;

/// An odd characteristic whose slope is bounded, on the sweep at least.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum OddCharacteristic {
    /// Continuous, odd and piecewise linear.
    PiecewiseLinear {
        /// Inputs above zero at which the slope changes, growing, in input units.
        kinks: Vec<f64>,
        /// Slopes from zero outwards, 1 more than kinks, output units per input unit.
        slopes: Vec<f64>,
    },
    /// `sum c_j x^j` over odd j.
    Polynomial {
        /// Coefficients of x, x^3, x^5, ..., in output units over input units to the power.
        odd_coefficients: Vec<f64>,
    },
    /// `gain tanh(scale x)`.
    Tanh {
        /// Limit of the output, in output units.
        gain: f64,
        /// Argument per input unit.
        scale: f64,
    },
}

impl OddCharacteristic {
    /// From a name of the [catalogue](crate::describing::CATALOGUE) and the values of its parameters, in the catalogue's order.
    ///
    /// # Errors
    /// [`ExistenceError::Characteristic`] for a characteristic that is not odd, jumps, has memory, or has no slope for the proof.
    pub fn from_catalogue(name: &str, values: &[f64]) -> Result<Self, ExistenceError> {
        let piecewise = |kinks: &[f64], slopes: &[f64]| {
            Some(Self::PiecewiseLinear { kinks: kinks.to_vec(), slopes: slopes.to_vec() })
        };
        let found = match (name, values) {
            ("saturation", &[slope, breakpoint]) => piecewise(&[breakpoint], &[slope, 0.0]),
            ("dead-zone", &[slope, half_width]) => piecewise(&[half_width], &[0.0, slope]),
            ("dead-zone-saturation", &[slope, half_width, breakpoint]) => {
                piecewise(&[half_width, breakpoint], &[0.0, slope, 0.0])
            }
            ("gain-changing", &[inner, outer, breakpoint]) => piecewise(&[breakpoint], &[inner, outer]),
            ("tanh", &[gain, scale]) => Some(Self::Tanh { gain, scale }),
            ("polynomial", coefficients) if coefficients.iter().step_by(2).all(|&even| even == 0.0) => {
                let mut odd: Vec<f64> = coefficients.iter().skip(1).step_by(2).copied().collect();
                while odd.last() == Some(&0.0) {
                    odd.pop();
                }
                Some(Self::Polynomial { odd_coefficients: odd })
            }
            _ => None,
        };
        let checked = found.and_then(|found| found.checked().ok());
        checked.ok_or_else(|| ExistenceError::Characteristic { name: name.to_owned() })
    }

    /// The same, if its numbers are finite and in order.
    pub(super) fn checked(self) -> Result<Self, ExistenceError> {
        let (numbers, sound) = match &self {
            Self::PiecewiseLinear { kinks, slopes } => {
                let ordered = [0.0].iter().chain(kinks).is_sorted_by(|a, b| a < b);
                ([&kinks[..], slopes].concat(), ordered && slopes.len() == kinks.len() + 1 && kinks.len() <= MOST_KINKS)
            }
            Self::Polynomial { odd_coefficients } => {
                (odd_coefficients.clone(), (1..=5).contains(&odd_coefficients.len()))
            }
            Self::Tanh { gain, scale } => (vec![*gain, *scale], *scale > 0.0),
        };
        if sound && numbers.iter().all(|number| number.is_finite()) {
            Ok(self)
        } else {
            Err(ExistenceError::Characteristic { name: format!("{self:?}") })
        }
    }

    /// Output and slope at an input; of a kink the slope beyond it.
    pub(super) fn output_and_slope(&self, x: f64) -> (f64, f64) {
        let Some((kinks, slopes)) = self.kinks() else { return self.smooth(x) };
        let inside = kinks.iter().take_while(|&&kink| kink < x.abs()).count();
        let passed = kinks.iter().zip(slopes.windows(2)).take(inside);
        let size =
            passed.fold(slopes[0] * x.abs(), |output, (kink, pair)| output + (pair[1] - pair[0]) * (x.abs() - kink));
        (x.signum() * size, slopes[inside])
    }

    /// Output and slope where there are no kinks.
    pub(super) fn smooth<T: Component>(&self, x: T) -> (T, T) {
        let [x] = Gradient::variables([x]);
        let constant = |number: f64| Gradient::constant(T::from_f64(number));
        let output = match self {
            Self::PiecewiseLinear { slopes, .. } => constant(slopes[0]) * x,
            Self::Polynomial { odd_coefficients } => odd_polynomial(odd_coefficients, x),
            Self::Tanh { gain, scale } => constant(*gain) * (constant(*scale) * x).tanh(),
        };
        (output.value(), output.slopes()[0])
    }

    /// Kinks, and the slopes between them; none of a smooth characteristic.
    pub(super) fn kinks(&self) -> Option<(&[f64], &[f64])> {
        match self {
            Self::PiecewiseLinear { kinks, slopes } => Some((kinks, slopes)),
            _ => None,
        }
    }

    /// An interval that holds the slope at every input up to `reach` in magnitude; only a polynomial's depends on it.
    pub(super) fn slopes(&self, reach: f64) -> Interval {
        let hull =
            |slopes: &mut dyn Iterator<Item = Interval>| slopes.reduce(Interval::hull).unwrap_or(Interval::ENTIRE);
        match self {
            Self::PiecewiseLinear { slopes, .. } => hull(&mut slopes.iter().map(|&slope| Interval::point(slope))),
            Self::Tanh { gain, scale } => Interval::ZERO.hull(Interval::point(*gain) * Interval::point(*scale)),
            Self::Polynomial { .. } => {
                // In parts: the terms of a polynomial cancel.
                let end = |i: u32| Interval::point(reach * f64::from(i) / 256.0);
                hull(&mut (0..256).map(|i| self.smooth(end(i).hull(end(i + 1))).1))
            }
        }
    }

    /// An upper bound of half the second derivative's magnitude at inputs up to `reach`, between kinks.
    pub(super) fn half_curvature(&self, reach: f64) -> Interval {
        match self {
            Self::PiecewiseLinear { .. } => Interval::ZERO,
            // The largest of tanh (1 - tanh^2) is 2/(3 sqrt 3) < 0.38495.
            Self::Tanh { gain, scale } => {
                (Interval::point(*gain) * Interval::point(*scale).square()).abs() * Interval::point(0.38495)
            }
            Self::Polynomial { odd_coefficients } => {
                let [_, _, half] =
                    *odd_polynomial(&magnitudes(odd_coefficients), Jet::<3>::variable(Interval::point(reach)))
                        .coefficients();
                half
            }
        }
    }

    /// Upper bounds of output and slope at every complex input of real part at most `real` and imaginary part at most `imaginary` in
    /// magnitude; none where the characteristic may have a singularity there.
    pub(super) fn complex_bounds(&self, real: Interval, imaginary: Interval) -> Option<(Interval, Interval)> {
        match self {
            Self::PiecewiseLinear { .. } => None,
            Self::Polynomial { odd_coefficients } => {
                Some(Self::Polynomial { odd_coefficients: magnitudes(odd_coefficients) }.smooth(real + imaginary))
            }
            // abs(tanh(x + j y))^2 = (sinh^2 x + sin^2 y)/(sinh^2 x + cos^2 y) <= 1 for abs(y) <= pi/4.
            Self::Tanh { gain, scale } => {
                let (gain, scale) = (Interval::point(*gain).abs(), Interval::point(*scale));
                let quarter = Interval::PI * Interval::point(0.25);
                (scale * imaginary).precedes(quarter).then(|| (gain, gain * scale * Interval::point(2.0)))
            }
        }
    }

    /// The least and the largest input at which the characteristic bends: of a polynomial where two terms are equal, or where the only term
    /// is as large as its input.
    pub(super) fn bends(&self) -> Option<[f64; 2]> {
        let bends: Vec<f64> = match self {
            Self::PiecewiseLinear { kinks, .. } => kinks.clone(),
            Self::Tanh { scale, .. } => vec![1.0 / scale],
            Self::Polynomial { odd_coefficients } => {
                let terms = || odd_coefficients.iter().zip(0_i32..).filter(|(coefficient, _)| **coefficient != 0.0);
                let equal = |(a, i): (&f64, i32), (b, j): (&f64, i32)| libm::pow((a / b).abs(), 0.5 / f64::from(j - i));
                let pairs = terms()
                    .flat_map(|low| terms().filter(move |high| high.1 > low.1).map(move |high| equal(low, high)));
                let alone = terms().last().map(|leading| equal((&1.0, 0), leading));
                let bends: Vec<f64> = pairs.collect();
                if bends.is_empty() { alone.into_iter().collect() } else { bends }
            }
        };
        Some([bends.iter().copied().reduce(f64::min)?, bends.into_iter().reduce(f64::max)?])
    }
}

/// `sum c_j x^j` over odd j.
fn odd_polynomial<T: Real>(odd_coefficients: &[f64], x: T) -> T {
    let square = x.square();
    odd_coefficients.iter().rev().fold(T::zero(), |sum, &c| sum * square + T::from_f64(c)) * x
}

fn magnitudes(coefficients: &[f64]) -> Vec<f64> {
    coefficients.iter().map(|c| c.abs()).collect()
}

#[cfg(test)]
mod tests {
    use super::OddCharacteristic;

    /// Against the largest of `abs(n'')/2` over a grid: never below it, and not a thousandth above.
    #[test]
    fn half_the_curvature_bounds_taylor_s_remainder() {
        let half = |n: &dyn Fn(f64) -> f64, x: f64| 0.5 * (n(x + 1e-3) - 2.0 * n(x) + n(x - 1e-3)).abs() * 1e6;
        let largest = |n: &dyn Fn(f64) -> f64| (0..=3000).map(|i| half(n, 1e-3 * f64::from(i))).fold(0.0, f64::max);
        let cases: [(OddCharacteristic, &dyn Fn(f64) -> f64); 2] = [
            (OddCharacteristic::Tanh { gain: -2.0, scale: 3.0 }, &|x| -2.0 * libm::tanh(3.0 * x)),
            (OddCharacteristic::Polynomial { odd_coefficients: vec![1.0, 2.0] }, &|x| x + 2.0 * x * x * x),
        ];
        for (characteristic, n) in cases {
            let (bound, largest) = (characteristic.half_curvature(3.0).upper(), largest(n));
            assert!((1.0 - 1e-5..1.001).contains(&(bound / largest)), "{bound} {largest}");
        }
    }
}
