//! Static characteristics: values, slopes, and Taylor series of their output along a motion.

use serde::{Deserialize, Serialize};

use crate::scalar::Scalar;

/// A static characteristic.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Characteristic {
    /// Continuous, through the origin.
    PiecewiseLinear {
        /// Inputs at which the slope changes, growing.
        kinks: Vec<f64>,
        /// Slopes before, between and after the kinks.
        slopes: Vec<f64>,
    },
    /// `sum c_j x^j`.
    Polynomial {
        /// Coefficients, ascending.
        coefficients: Vec<f64>,
    },
    /// `gain tanh(scale x)`.
    Tanh {
        /// Largest output.
        gain: f64,
        /// Inverse of the input's unit.
        scale: f64,
    },
}

impl Characteristic {
    /// Odd and piecewise linear: kinks above zero, slopes from zero outwards.
    #[must_use]
    pub fn odd(kinks: &[f64], slopes: &[f64]) -> Self {
        let mirrored = kinks.iter().rev().map(|kink| -kink).chain(kinks.iter().copied());
        let outwards = slopes.iter().rev().chain(&slopes[1..]).copied();
        Self::PiecewiseLinear { kinks: mirrored.collect(), slopes: outwards.collect() }
    }

    /// Inputs at which the slope jumps.
    #[must_use]
    pub fn kinks(&self) -> &[f64] {
        if let Self::PiecewiseLinear { kinks, .. } = self { kinks } else { &[] }
    }

    /// The piece that holds an input.
    #[must_use]
    pub fn piece(&self, input: f64) -> usize {
        self.kinks().iter().filter(|&&kink| input > kink).count()
    }

    /// Slope and constant of a piece: its output is `slope x + constant`. Zeros for a smooth characteristic.
    #[must_use]
    pub fn line<S: Scalar>(&self, piece: usize) -> (S, S) {
        let Self::PiecewiseLinear { kinks, slopes } = self else { return (S::ZERO, S::ZERO) };
        // From the piece of the origin outwards, the constant changes by (slope before - slope after) kink.
        let origin = self.piece(0.0);
        let jump = |kink: usize| S::from_f64(kinks[kink]) * (S::from_f64(slopes[kink]) - S::from_f64(slopes[kink + 1]));
        let sum = |range: std::ops::Range<usize>| range.fold(S::ZERO, |sum, kink| sum + jump(kink));
        let constant = if piece >= origin { sum(origin..piece) } else { -sum(piece..origin) };
        (S::from_f64(slopes[piece]), constant)
    }

    /// Output.
    #[must_use]
    pub fn output(&self, input: f64) -> f64 {
        match self {
            Self::PiecewiseLinear { .. } => {
                let (slope, constant) = self.line::<f64>(self.piece(input));
                slope * input + constant
            }
            Self::Polynomial { coefficients } => coefficients.iter().rev().fold(0.0, |sum, c| sum * input + c),
            Self::Tanh { gain, scale } => gain * (scale * input).tanh(),
        }
    }

    /// Slope.
    #[must_use]
    pub fn slope(&self, input: f64) -> f64 {
        match self {
            Self::PiecewiseLinear { slopes, .. } => slopes[self.piece(input)],
            Self::Polynomial { coefficients } => {
                coefficients.iter().enumerate().skip(1).rev().fold(0.0, |sum, (j, c)| sum * input + j as f64 * c)
            }
            Self::Tanh { gain, scale } => gain * scale * (1.0 - (scale * input).tanh().powi(2)),
        }
    }

    /// Whether the slope jumps somewhere.
    #[must_use]
    pub fn has_kinks(&self) -> bool {
        !self.kinks().is_empty()
    }

    /// The series of the output along a motion in a piece, coefficient by coefficient.
    #[must_use]
    pub fn series<S: Scalar>(&self, piece: usize) -> OutputSeries<S> {
        match self {
            Self::PiecewiseLinear { .. } => {
                let (slope, constant) = self.line(piece);
                OutputSeries::Line { slope, constant: Some(constant) }
            }
            Self::Polynomial { coefficients } => OutputSeries::Polynomial {
                coefficients: coefficients.iter().map(|&c| S::from_f64(c)).collect(),
                powers: vec![Vec::new(); coefficients.len().saturating_sub(1)],
            },
            Self::Tanh { gain, scale } => OutputSeries::Tanh {
                gain: S::from_f64(*gain),
                scale: S::from_f64(*scale),
                argument: Vec::new(),
                tanh: Vec::new(),
                slope: Vec::new(),
            },
        }
    }
}

/// Taylor series of the output, built from that of the input.
#[derive(Clone, Debug)]
pub enum OutputSeries<S> {
    /// A straight line.
    Line {
        /// Slope.
        slope: S,
        /// Constant, until it has been used.
        constant: Option<S>,
    },
    /// A polynomial.
    Polynomial {
        /// Ascending coefficients.
        coefficients: Vec<S>,
        /// Series of `x, x^2, ...`
        powers: Vec<Vec<S>>,
    },
    /// `w = tanh v` from `w' = (1 - w^2) v'`.
    Tanh {
        /// Largest output.
        gain: S,
        /// Inverse of the input's unit.
        scale: S,
        /// Series of `v = scale x`.
        argument: Vec<S>,
        /// Series of w.
        tanh: Vec<S>,
        /// Series of `1 - w^2`.
        slope: Vec<S>,
    },
}

fn convolution<S: Scalar>(left: &[S], right: &[S], k: usize) -> S {
    (0..=k).fold(S::ZERO, |sum, i| sum + left[i] * right[k - i])
}

impl<S: Scalar> OutputSeries<S> {
    /// Takes the input's next coefficient; the output's of the same order.
    pub fn push(&mut self, input: S) -> S {
        match self {
            Self::Line { slope, constant } => *slope * input + constant.take().unwrap_or(S::ZERO),
            Self::Polynomial { coefficients, powers } => {
                let k = powers.first().map_or(0, Vec::len);
                let mut sum = if k == 0 { coefficients[0] } else { S::ZERO };
                for j in 0..powers.len() {
                    let (lower, upper) = powers.split_at_mut(j);
                    let next = if let (Some(first), Some(before)) = (lower.first(), lower.last()) {
                        convolution(first, before, k)
                    } else {
                        input
                    };
                    upper[0].push(next);
                    sum = sum + coefficients[j + 1] * next;
                }
                sum
            }
            Self::Tanh { gain, scale, argument, tanh, slope } => {
                let k = argument.len();
                argument.push(*scale * input);
                let next = if k == 0 {
                    argument[0].tanh()
                } else {
                    let sum = (1..=k).fold(S::ZERO, |sum, i| sum + S::from_count(i) * argument[i] * slope[k - i]);
                    sum / S::from_count(k)
                };
                tanh.push(next);
                let one = if k == 0 { S::ONE } else { S::ZERO };
                slope.push(one - convolution(tanh, tanh, k));
                *gain * next
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<Characteristic> {
        vec![
            Characteristic::odd(&[0.5, 2.0], &[-1.0, 2.0, 0.0]),
            Characteristic::PiecewiseLinear {
                kinks: vec![-7.0, -1.0, 1.0, 4.0],
                slopes: vec![0.0, 0.2, 1.0, 0.2, 0.0],
            },
            Characteristic::Polynomial { coefficients: vec![-0.1, 1.0, 1.0, -0.3] },
            Characteristic::Tanh { gain: 1.3, scale: 0.7 },
        ]
    }

    #[test]
    fn outputs_are_continuous_and_have_their_slopes() {
        for one in all() {
            for step in -90..90 {
                let input = 0.1 * f64::from(step) + 0.05;
                let difference = (one.output(input + 1e-6) - one.output(input - 1e-6)) / 2e-6;
                assert!((difference - one.slope(input)).abs() < 1e-7, "{one:?} at {input}");
            }
            for &kink in one.kinks() {
                assert!((one.output(kink + 1e-12) - one.output(kink - 1e-12)).abs() < 1e-10);
            }
        }
        assert_eq!(all()[0].output(2.0), 2.5);
        assert_eq!(all()[1].output(-9.0), -2.2);
    }

    #[test]
    fn series_are_those_of_the_output() {
        // Input 0.1 + t - 0.4 t^2 within one piece.
        for one in all() {
            let mut series = one.series::<f64>(one.piece(0.1));
            let coefficients: Vec<f64> =
                (0..30).map(|k| series.push([0.1, 1.0, -0.4].get(k).copied().unwrap_or(0.0))).collect();
            let t = 0.2_f64;
            let sum = coefficients.iter().rev().fold(0.0, |sum, c| sum * t + c);
            assert!((sum - one.output(0.1 + t - 0.4 * t * t)).abs() < 1e-13, "{one:?}");
        }
    }
}
