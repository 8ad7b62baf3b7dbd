//! Odd characteristics of bounded slope: the data of them for the proof.

use serde::{Deserialize, Serialize};

use super::error::ExistenceError;
use crate::numeric::{Interval, Real, Scalar};

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
        let found = match (name, values) {
            ("saturation", &[slope, breakpoint]) => Self::piecewise(&[breakpoint], &[slope, 0.0]),
            ("dead-zone", &[slope, half_width]) if half_width > 0.0 => Self::piecewise(&[half_width], &[0.0, slope]),
            ("dead-zone-saturation", &[slope, half_width, breakpoint]) if half_width > 0.0 => {
                Self::piecewise(&[half_width, breakpoint], &[0.0, slope, 0.0])
            }
            ("gain-changing", &[inner, outer, breakpoint]) => Self::piecewise(&[breakpoint], &[inner, outer]),
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
        let found = found.ok_or_else(|| ExistenceError::Characteristic { name: name.to_owned() })?;
        found.checked()
    }

    fn piecewise(kinks: &[f64], slopes: &[f64]) -> Option<Self> {
        Some(Self::PiecewiseLinear { kinks: kinks.to_vec(), slopes: slopes.to_vec() })
    }

    /// The same, if its numbers are finite and in order.
    pub(super) fn checked(self) -> Result<Self, ExistenceError> {
        let (numbers, sound): (Vec<f64>, bool) = match &self {
            Self::PiecewiseLinear { kinks, slopes } => {
                let ordered =
                    kinks.windows(2).all(|pair| pair[0] < pair[1]) && kinks.first().is_none_or(|&kink| kink > 0.0);
                (
                    kinks.iter().chain(slopes).copied().collect(),
                    ordered && slopes.len() == kinks.len() + 1 && kinks.len() <= MOST_KINKS,
                )
            }
            Self::Polynomial { odd_coefficients } => {
                (odd_coefficients.clone(), !odd_coefficients.is_empty() && odd_coefficients.len() <= 5)
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
    pub(super) fn output_and_slope<S: Scalar>(&self, x: S) -> (S, S) {
        match self {
            Self::PiecewiseLinear { kinks, slopes } => {
                let size = x.abs();
                let line = kinks.iter().zip(slopes.windows(2)).fold(
                    (S::from_f64(slopes[0]) * size, S::from_f64(slopes[0])),
                    |(output, slope), (&kink, pair)| {
                        let beyond = size - S::from_f64(kink);
                        if beyond > S::zero() {
                            (output + S::from_f64(pair[1] - pair[0]) * beyond, S::from_f64(pair[1]))
                        } else {
                            (output, slope)
                        }
                    },
                );
                (if x < S::zero() { -line.0 } else { line.0 }, line.1)
            }
            _ => self.smooth(x),
        }
    }

    /// Output and slope where there are no kinks.
    pub(super) fn smooth<T: Real>(&self, x: T) -> (T, T) {
        match self {
            Self::PiecewiseLinear { slopes, .. } => (T::from_f64(slopes[0]) * x, T::from_f64(slopes[0])),
            Self::Polynomial { odd_coefficients } => {
                let square = x.square();
                let horner = |factor: fn(usize) -> f64| {
                    let terms = odd_coefficients.iter().enumerate().rev();
                    terms.fold(T::zero(), |sum, (j, &c)| sum * square + T::from_f64(factor(j)) * T::from_f64(c))
                };
                (horner(|_| 1.0) * x, horner(|j| (2 * j + 1) as f64))
            }
            Self::Tanh { gain, scale } => {
                let (gain, scale) = (T::from_f64(*gain), T::from_f64(*scale));
                let tanh = (scale * x).tanh();
                (gain * tanh, gain * scale * (T::one() - tanh.square()))
            }
        }
    }

    /// Kinks, and the slopes between them; none of a smooth characteristic.
    pub(super) fn kinks(&self) -> Option<(&[f64], &[f64])> {
        match self {
            Self::PiecewiseLinear { kinks, slopes } => Some((kinks, slopes)),
            _ => None,
        }
    }

    /// Whether the bounds of slope and curvature hold on the sweep alone.
    pub(super) fn is_bounded_on_the_sweep_alone(&self) -> bool {
        matches!(self, Self::Polynomial { .. })
    }

    /// An interval that holds the slope at every input up to `reach` in magnitude.
    pub(super) fn slopes(&self, reach: f64) -> Interval {
        match self {
            Self::PiecewiseLinear { slopes, .. } => {
                slopes.iter().map(|&slope| Interval::point(slope)).reduce(Interval::hull).unwrap_or(Interval::ZERO)
            }
            Self::Tanh { gain, scale } => {
                Interval::point(*gain) * Interval::point(*scale) * Interval::new(0.0, 1.0).unwrap_or(Interval::ENTIRE)
            }
            Self::Polynomial { .. } => {
                // In parts: the terms of a polynomial cancel.
                let part = |i: u32| Interval::new(reach * f64::from(i) / 256.0, reach * f64::from(i + 1) / 256.0);
                let parts = (0..256).map(|i| part(i).map_or(Interval::ENTIRE, |part| self.smooth(part).1));
                parts.reduce(Interval::hull).unwrap_or(Interval::ENTIRE)
            }
        }
    }

    /// An upper bound of the second derivative's magnitude at inputs up to `reach`, between kinks.
    pub(super) fn curvature(&self, reach: f64) -> Interval {
        match self {
            Self::PiecewiseLinear { .. } => Interval::ZERO,
            // The largest of 2 tanh (1 - tanh^2) is 4/(3 sqrt 3) < 0.7699.
            Self::Tanh { gain, scale } => {
                (Interval::point(*gain) * Interval::point(*scale).square()).abs() * Interval::point(0.7699)
            }
            Self::Polynomial { odd_coefficients } => {
                let reach = Interval::point(reach);
                odd_coefficients.iter().enumerate().skip(1).fold(Interval::ZERO, |sum, (j, &c)| {
                    let (power, factor) = (2 * j - 1, ((2 * j + 1) * 2 * j) as f64);
                    sum + Interval::point(c).abs() * Interval::point(factor) * natural_power(reach, power)
                })
            }
        }
    }

    /// Upper bounds of output and slope at every complex input of real part at most `real` and imaginary part at most `imaginary` in
    /// magnitude; `None` where the characteristic may have a singularity there.
    pub(super) fn complex_bounds(&self, real: Interval, imaginary: Interval) -> Option<(Interval, Interval)> {
        match self {
            Self::PiecewiseLinear { .. } => None,
            Self::Polynomial { odd_coefficients } => {
                let reach = real + imaginary;
                let sum = |factor: fn(usize) -> f64, less: usize| {
                    odd_coefficients.iter().enumerate().fold(Interval::ZERO, |sum, (j, &c)| {
                        sum + Interval::point(c).abs()
                            * Interval::point(factor(j))
                            * natural_power(reach, 2 * j + 1 - less)
                    })
                };
                Some((sum(|_| 1.0, 0), sum(|j| (2 * j + 1) as f64, 1)))
            }
            // abs(tanh(x + j y))^2 = (sinh^2 x + sin^2 y)/(sinh^2 x + cos^2 y) <= 1 for abs(y) <= pi/4.
            Self::Tanh { gain, scale } => {
                let (gain, scale) = (Interval::point(*gain).abs(), Interval::point(*scale));
                let quarter = Interval::PI * Interval::point(0.25);
                (scale * imaginary).precedes(quarter).then(|| (gain, gain * scale * Interval::point(2.0)))
            }
        }
    }

    /// Smallest and largest input at which the characteristic bends.
    pub(super) fn bends(&self) -> (f64, f64) {
        match self {
            Self::PiecewiseLinear { kinks, .. } => {
                (kinks.first().copied().unwrap_or(1.0), kinks.last().copied().unwrap_or(1.0))
            }
            Self::Tanh { scale, .. } => (1.0 / scale, 1.0 / scale),
            Self::Polynomial { odd_coefficients } => {
                // Where two terms are equal.
                let mut bends = Vec::new();
                for (i, a) in odd_coefficients.iter().enumerate() {
                    for (j, b) in odd_coefficients.iter().enumerate().skip(i + 1) {
                        bends.extend(
                            Some(libm::pow((a / b).abs(), 0.5 / (j - i) as f64))
                                .filter(|&one| one.is_finite() && one > 0.0),
                        );
                    }
                }
                let leading = odd_coefficients.last().map_or(1.0, |c| libm::pow(c.abs(), -0.5));
                let at = |of: fn(f64, f64) -> f64| bends.iter().copied().reduce(of).unwrap_or(leading);
                (at(f64::min), at(f64::max))
            }
        }
    }
}

fn natural_power(base: Interval, power: usize) -> Interval {
    (0..power).fold(Interval::ONE, |product, _| product * base)
}
