//! What records of different levels say about the thrust.
//!
//! One record gives every parameter in units of its own command, so that thrust which is not proportional to the command
//! multiplies all of them alike. At level C, thrust beyond a dead zone d is C - d and thrust with exponent p is C^p: either
//! makes a line of the records, `C / alpha` over C and `ln(C / alpha)` over `ln C`, which two levels draw and three can bend.

use super::answer::{Answer, Reason, Reported};
use super::tail::chi_square_tail;
use crate::identify::joint::{ConfidenceInterval, Estimate};

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

impl Drawn {
    /// Everything of a record of this level, in the law's units.
    pub(super) fn in_its_units(&self, answer: &Answer) -> Reported {
        let factor = self.law.factor(answer.level()).map_or(1.0, f64::recip);
        answer.reported.clone().in_units(factor)
    }

    /// The level at which the inertia is this, under a power.
    pub(super) fn level_of(&self, alpha: f64) -> Option<(f64, f64)> {
        let ThrustLaw::Power { exponent, level } = self.law else { return None };
        Some((exponent, level * (alpha / self.alpha).powf((1.0 - exponent).recip())))
    }
}

impl ThrustLaw {
    /// What a record of this level multiplies the parameters by; `None` within the dead zone.
    pub(super) fn factor(self, at: f64) -> Option<f64> {
        match self {
            Self::DeadZone { width } => (at > width).then(|| at / (at - width)),
            Self::Power { exponent, level } => Some((at / level).powf(1.0 - exponent)),
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
    /// Probability that records of it scatter more about it; one where nothing is left to scatter.
    pub(super) probability: f64,
}

/// What the records say of the law of thrust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verdict {
    /// It is this one.
    One(Drawn),
    /// It is not told: a power would do, and a dead zone where there is one.
    Open {
        dead_zone: Option<Drawn>,
        power: Drawn,
    },
}

/// The line `y = intercept + slope x` of the least weighted squares.
struct Line {
    intercept: f64,
    slope: f64,
    intercept_std: f64,
    slope_std: f64,
    probability: f64,
}

impl Line {
    /// Through points `(x, y, standard deviation of y)` at two different x or more.
    fn through(points: &[(f64, f64, f64)]) -> Self {
        let sum = |part: &dyn Fn(f64, f64) -> f64| points.iter().map(|&(x, y, std)| part(x, y) / (std * std)).sum::<f64>();
        let weight = sum(&|_, _| 1.0);
        let (mean_x, mean_y) = (sum(&|x, _| x) / weight, sum(&|_, y| y) / weight);
        let square = sum(&|x, _| (x - mean_x).powi(2));
        let slope = sum(&|x, y| (x - mean_x) * (y - mean_y)) / square;
        let intercept = mean_y - slope * mean_x;
        #[allow(clippy::cast_precision_loss, reason = "a count of records")]
        let freedom = points.len() as f64 - 2.0;
        let scatter = sum(&|x, y| (y - intercept - slope * x).powi(2));
        Self {
            intercept,
            slope,
            intercept_std: (1.0 / weight + mean_x * mean_x / square).sqrt(),
            slope_std: square.sqrt().recip(),
            probability: if freedom > 0.0 { chi_square_tail(scatter, freedom) } else { 1.0 },
        }
    }
}

/// Level of the command of every record, and its inertia with the standard deviation.
pub(super) struct Levels(Vec<(f64, f64, f64)>);

impl Levels {
    /// `None` where the levels are one, or an inertia has no error to judge by.
    pub(super) fn of(answers: &[Answer]) -> Option<Self> {
        let levels: Option<Vec<_>> = answers
            .iter()
            .map(|answer| {
                let Estimate { value, spread } = answer.reported.alpha;
                let std = spread.map(ConfidenceInterval::deviation).filter(|std| *std > 0.0)?;
                Some((answer.level(), value, std))
            })
            .collect();
        let levels = Self(levels?);
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

    /// What may lie behind inertias that differ; `None` where no law of thrust makes them one.
    pub(super) fn verdict(&self, unlikely: f64) -> Option<Verdict> {
        let likely = |drawn: &Drawn| drawn.probability >= unlikely;
        let (dead_zone, power) = (self.dead_zone().filter(likely), self.power().filter(likely));
        match (dead_zone, power) {
            (Some(only), None) | (None, Some(only)) if self.count() > 2 => Some(Verdict::One(only)),
            (_, Some(power)) => Some(Verdict::Open { dead_zone, power }),
            (_, None) => None,
        }
    }

    /// The dead zone through the records; `None` where it would be negative, or swallow a level.
    fn dead_zone(&self) -> Option<Drawn> {
        let points: Vec<_> =
            self.0.iter().map(|(level, alpha, std)| (*level, level / alpha, level * std / (alpha * alpha))).collect();
        let Line { intercept, slope, slope_std, probability, .. } = Line::through(&points);
        let width = -intercept / slope;
        (slope > 0.0 && width > 0.0 && width < self.least()).then(|| Drawn {
            law: ThrustLaw::DeadZone { width },
            alpha: slope.recip(),
            relative: slope_std / slope,
            probability,
        })
    }

    /// The power through the records; `None` where thrust would fall with the command.
    fn power(&self) -> Option<Drawn> {
        let level = self.largest();
        let points: Vec<_> =
            self.0.iter().map(|(at, alpha, std)| ((at / level).ln(), (at / alpha).ln(), std / alpha)).collect();
        let Line { intercept, slope: exponent, intercept_std, probability, .. } = Line::through(&points);
        let (law, alpha) = (ThrustLaw::Power { exponent, level }, level / intercept.exp());
        (exponent > 0.0).then_some(Drawn { law, alpha, relative: intercept_std, probability })
    }

    /// The part of the level that every record's constant force is, where they are not one force; `None` where the records
    /// do not say so.
    pub(super) fn asymmetry(&self, deltas: &[Estimate], unlikely: f64) -> Option<f64> {
        let known: Option<Vec<(f64, f64)>> = deltas
            .iter()
            .map(|delta| Some((delta.value, delta.spread?.deviation())).filter(|(_, std)| *std > 0.0))
            .collect();
        let known = known.filter(|known| known.len() == self.0.len())?;
        let one = probability_of_one(known.iter().copied());
        let parts = known.iter().zip(&self.0).map(|((value, std), (level, ..))| (value / level, std / level));
        let proportional = probability_of_one(parts.clone());
        (one < unlikely && proportional >= unlikely).then(|| mean(parts).0)
    }
}

/// Mean of numbers with their standard deviations, and its own weight.
fn mean(numbers: impl Iterator<Item = (f64, f64)>) -> (f64, f64) {
    let (sum, weight) = numbers.fold((0.0, 0.0), |(sum, weight), (value, std)| {
        let one = (std * std).recip();
        (sum + value * one, weight + one)
    });
    (sum / weight, weight)
}

/// Probability that numbers with these standard deviations scatter more if they are one.
pub(super) fn probability_of_one(numbers: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    let (mean, _) = mean(numbers.clone());
    let (scatter, count) = numbers.fold((0.0, 0.0), |(scatter, count), (value, std)| {
        (scatter + ((value - mean) / std).powi(2), count + 1.0)
    });
    if count > 1.0 { chi_square_tail(scatter, count - 1.0) } else { 1.0 }
}

impl Reported {
    /// The same vehicle in other units of force; what it is pushed by stays in units of the command.
    fn in_units(mut self, factor: f64) -> Self {
        let times = |estimate: &mut Estimate| {
            estimate.value *= factor;
            if let Some(spread) = &mut estimate.spread {
                for number in [&mut spread.std, &mut spread.low, &mut spread.high] {
                    *number *= factor;
                }
            }
        };
        [&mut self.alpha, &mut self.beta, &mut self.beta_quadratic].into_iter().for_each(times);
        let others = [&mut self.beta_cubic, &mut self.coulomb, &mut self.memory, &mut self.stiffness];
        others.into_iter().flatten().for_each(times);
        self
    }

    /// The law of the thrust that the records showed, or that agrees with them.
    pub(super) fn thrust(&self) -> Option<ThrustLaw> {
        self.reasons.iter().find_map(|reason| match *reason {
            Reason::ThrustDeadZone { width } => Some(ThrustLaw::DeadZone { width }),
            Reason::ThrustPower { exponent, level } | Reason::ThrustNotProportional { exponent, level, .. } => {
                Some(ThrustLaw::Power { exponent, level })
            }
            _ => None,
        })
    }
}
