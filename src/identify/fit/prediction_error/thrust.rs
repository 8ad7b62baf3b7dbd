//! The law of thrust from records of different levels.
//!
//! A record gives every parameter in units of its own command, so thrust that is not proportional to the command
//! multiplies all of them alike. At level C, thrust beyond a dead zone d is C - d and thrust with exponent p is C^p: either
//! makes a line of the records, `C / alpha` over C and `ln(C / alpha)` over `ln C`. Two levels fix a line; three test it.

use super::candidate::RecordAnswer;
use super::pooling::{known, probability_of_one};
use crate::identify::answer::distribution::chi_square_tail;
use crate::identify::answer::{Estimate, Reason, Reported};

/// Ratio of the commands' ranges from which on their levels are different.
const OTHER_LEVEL: f64 = 1.05;

/// How thrust follows the command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ThrustLaw {
    /// None up to a width, then with unit slope; parameters are in units of the thrust.
    DeadZone {
        /// In units of the command.
        width: f64,
    },
    /// A power of the command; parameters are in units of the command at one level.
    Power {
        /// Its exponent.
        exponent: f64,
        /// The level at which the parameters hold.
        level: f64,
    },
}

impl ThrustLaw {
    /// Factor on the parameters of a record of this level; `None` within the dead zone.
    pub(super) fn factor(self, at: f64) -> Option<f64> {
        match self {
            Self::DeadZone { width } => (at > width).then(|| at / (at - width)),
            Self::Power { exponent, level } => Some(libm::pow(at / level, 1.0 - exponent)),
        }
    }

    /// Width of the dead zone.
    pub(super) fn width(self) -> Option<f64> {
        match self {
            Self::DeadZone { width } => Some(width),
            Self::Power { .. } => None,
        }
    }
}

/// A law drawn through the records.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Drawn {
    pub(super) law: ThrustLaw,
    /// Inertia in the law's units.
    alpha: f64,
    /// Its standard deviation over its value.
    pub(super) relative: f64,
    /// Probability, under the law, of more scatter; 1 without degrees of freedom.
    pub(super) probability: f64,
}

impl Drawn {
    /// Everything of a record of this level, in the law's units.
    pub(super) fn in_its_units(&self, answer: &RecordAnswer) -> Reported {
        let factor = self.law.factor(answer.command_level).map_or(1.0, f64::recip);
        answer.reported.clone().in_units(factor)
    }
}

/// Verdict of the records on the law of thrust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ThrustVerdict {
    /// The records determine this law.
    One(Drawn),
    /// Undetermined: a power fits, and so does the dead zone, if any.
    Open {
        dead_zone: Option<Drawn>,
        exponent: f64,
        /// Where the power has the inertia that was asked about.
        level: f64,
    },
}

/// The line `y = intercept + slope x` of the least weighted squares.
struct RegressionLine {
    intercept: f64,
    slope: f64,
    intercept_std: f64,
    slope_std: f64,
    probability: f64,
}

impl RegressionLine {
    /// Through points `(x, y, standard deviation of y)` at two different x or more.
    fn through(points: &[(f64, f64, f64)]) -> Self {
        let sum =
            |part: &dyn Fn(f64, f64) -> f64| points.iter().map(|&(x, y, std)| part(x, y) / (std * std)).sum::<f64>();
        let weight = sum(&|_, _| 1.0);
        let (mean_x, mean_y) = (sum(&|x, _| x) / weight, sum(&|_, y| y) / weight);
        let square = sum(&|x, _| (x - mean_x).powi(2));
        let slope = sum(&|x, y| (x - mean_x) * (y - mean_y)) / square;
        let intercept = mean_y - slope * mean_x;
        let scatter = sum(&|x, y| (y - intercept - slope * x).powi(2));
        Self {
            intercept,
            slope,
            intercept_std: (1.0 / weight + mean_x * mean_x / square).sqrt(),
            slope_std: square.sqrt().recip(),
            probability: if points.len() > 2 { chi_square_tail(scatter, points.len() - 2) } else { 1.0 },
        }
    }
}

/// Level of the command of every record, and its inertia with the standard deviation.
pub(super) struct CommandLevels(Vec<(f64, f64, f64)>);

impl CommandLevels {
    /// `None` where all levels are equal, or an inertia has no error to judge by.
    pub(super) fn of(answers: &[RecordAnswer]) -> Option<Self> {
        let alphas = known(&answers.iter().map(|answer| answer.reported.alpha).collect::<Vec<_>>())?;
        let levels =
            Self(answers.iter().zip(alphas).map(|(answer, (value, std))| (answer.command_level, value, std)).collect());
        (levels.largest() > OTHER_LEVEL * levels.least()).then_some(levels)
    }

    fn largest(&self) -> f64 {
        self.0.iter().map(|(level, ..)| *level).fold(0.0, f64::max)
    }

    fn least(&self) -> f64 {
        self.0.iter().map(|(level, ..)| *level).fold(f64::INFINITY, f64::min)
    }

    /// How many there are.
    fn count(&self) -> usize {
        let mut levels: Vec<f64> = self.0.iter().map(|(level, ..)| *level).collect();
        levels.sort_unstable_by(f64::total_cmp);
        1 + levels.windows(2).filter(|pair| pair[1] > OTHER_LEVEL * pair[0]).count()
    }

    /// The law of thrust that explains differing inertias by a common inertia; `None` where no law of thrust makes
    /// them equal.
    pub(super) fn verdict(&self, alpha: f64, unlikely: f64) -> Option<ThrustVerdict> {
        let likely = |drawn: &Drawn| drawn.probability >= unlikely;
        let line = self.logarithms();
        let (dead_zone, power) = (self.dead_zone().filter(likely), self.power(&line).filter(likely));
        match (dead_zone, power) {
            (Some(only), None) | (None, Some(only)) if self.count() > 2 => Some(ThrustVerdict::One(only)),
            (dead_zone, Some(power)) => {
                let exponent = line.slope;
                let level = self.largest() * libm::pow(alpha / power.alpha, (1.0 - exponent).recip());
                (level.is_finite() && level > 0.0).then_some(ThrustVerdict::Open { dead_zone, exponent, level })
            }
            (_, None) => None,
        }
    }

    /// The dead zone through the records; `None` where it would be negative, or swallow a level.
    fn dead_zone(&self) -> Option<Drawn> {
        let points: Vec<_> =
            self.0.iter().map(|(level, alpha, std)| (*level, level / alpha, level * std / (alpha * alpha))).collect();
        let RegressionLine { intercept, slope, slope_std, probability, .. } = RegressionLine::through(&points);
        let width = -intercept / slope;
        (slope > 0.0 && width > 0.0 && width < self.least()).then(|| Drawn {
            law: ThrustLaw::DeadZone { width },
            alpha: slope.recip(),
            relative: slope_std / slope,
            probability,
        })
    }

    /// The line of the logarithms, that of the largest level being zero.
    fn logarithms(&self) -> RegressionLine {
        let level = self.largest();
        let points: Vec<_> =
            self.0.iter().map(|(at, alpha, std)| (libm::log(at / level), libm::log(at / alpha), std / alpha)).collect();
        RegressionLine::through(&points)
    }

    /// The power through the records; `None` where thrust would fall with the command.
    fn power(&self, line: &RegressionLine) -> Option<Drawn> {
        let RegressionLine { intercept, slope: exponent, intercept_std: relative, probability, .. } = *line;
        let level = self.largest();
        let (law, alpha) = (ThrustLaw::Power { exponent, level }, level / libm::exp(intercept));
        (exponent > 0.0).then_some(Drawn { law, alpha, relative, probability })
    }

    /// Slope of the constant force over the level; `None` where the records show none.
    pub(super) fn asymmetry(&self, deltas: &[Estimate], unlikely: f64) -> Option<f64> {
        let deltas = known(deltas).filter(|deltas| deltas.len() == self.0.len())?;
        let points: Vec<_> =
            self.0.iter().zip(&deltas).map(|((level, ..), (value, std))| (*level, *value, *std)).collect();
        let RegressionLine { slope, probability, .. } = RegressionLine::through(&points);
        (probability_of_one(&deltas) < unlikely && probability >= unlikely).then_some(slope)
    }
}

impl Reported {
    /// The same in units of a record's command of this level, by the law of thrust that the records determined; `None` where
    /// the command never leaves the dead zone.
    pub(crate) fn at_level(&self, level: f64) -> Option<Self> {
        let factor = self.thrust().map_or(Some(1.0), |law| law.factor(level))?;
        Some(self.clone().in_units(factor))
    }

    /// The law of the thrust that the records showed, or that agrees with them.
    fn thrust(&self) -> Option<ThrustLaw> {
        self.reasons.iter().find_map(|reason| match *reason {
            Reason::ThrustDeadZone { width } => Some(ThrustLaw::DeadZone { width }),
            Reason::ThrustPower { exponent, level } | Reason::ThrustNotProportional { exponent, level, .. } => {
                Some(ThrustLaw::Power { exponent, level })
            }
            _ => None,
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix2, Vector2};

    use super::RegressionLine;

    /// The normal equations, solved by another's decomposition.
    #[test]
    fn a_line_is_that_of_the_normal_equations() {
        let points = [(0.3, 1.0, 0.2), (0.9, 2.5, 0.1), (1.4, 2.2, 0.4), (2.0, 4.1, 0.3)];
        let (normal, right) =
            points.iter().fold((Matrix2::zeros(), Vector2::zeros()), |(normal, right), (x, y, std)| {
                let row = Vector2::new(1.0, *x) / *std;
                (normal + row * row.transpose(), right + row * (y / std))
            });
        let covariance = normal.try_inverse().unwrap();
        let solution = covariance * right;
        let line = RegressionLine::through(&points);
        for (found, expected) in [
            (line.intercept, solution[0]),
            (line.slope, solution[1]),
            (line.intercept_std, covariance[(0, 0)].sqrt()),
            (line.slope_std, covariance[(1, 1)].sqrt()),
        ] {
            approx::assert_relative_eq!(found, expected, max_relative = 1e-12);
        }
        let scatter: f64 = points.iter().map(|(x, y, std)| ((y - solution[0] - solution[1] * x) / std).powi(2)).sum();
        // Two degrees of freedom: the tail is exponential.
        approx::assert_relative_eq!(line.probability, (-0.5 * scatter).exp(), max_relative = 1e-9);
    }
}
