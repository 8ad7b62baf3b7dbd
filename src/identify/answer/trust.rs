//! Whether to trust an answer, and why not.

use serde::{Deserialize, Serialize};

use super::{Estimate, Term};
use crate::features::NotAnExperiment;
use crate::numeric::domain::About;
use crate::numeric::significant;

/// Whether an answer is to be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Trust {
    /// No test contradicts the model, and the interval is as usual.
    Good,
    /// A named misfit is paid for in the interval.
    Widened,
    /// A named contradiction that no term removes: not to be used.
    Doubtful,
}

impl Trust {
    /// Name in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Widened => "widened",
            Self::Doubtful => "doubtful",
        }
    }
}

/// Why an answer is not simply good.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Reason {
    /// The record has this term in addition to inertia, drag and white noise.
    Term(Term),
    /// The record contradicts the delay given: it has another.
    DelayContradicted {
        /// Given, in s.
        given_s: f64,
        /// Found, in s.
        found_s: f64,
    },
    /// The two halves of the record want parameters that differ by more than chance allows; the interval of the inertia holds both.
    HalvesDisagree {
        /// Probability of a statistic at least as large by chance.
        probability: f64,
    },
    /// Readings far from the rest were excluded.
    Outliers {
        /// How many.
        count: usize,
    },
    /// The interval of the inertia is too wide to be of use.
    TooWide {
        /// Half the interval's width over the value; infinite where there is no interval.
        #[serde(with = "crate::identify::answer::any_float")]
        relative: f64,
    },
    /// The record is of another manoeuvre than a relay experiment.
    NoExperiment(NotAnExperiment),
    /// The search ended before it came to rest.
    NotSettled,
    /// The search for terms reached its limit of work.
    SearchEnded {
        /// Terms still joined: further terms were not looked for. Else other models in place of the model found were not.
        joining: bool,
    },
    /// A record that took no part in the estimate is predicted badly.
    DoesNotPredict {
        /// Part of the variance of its output that the answer explains, the least of all such records; `None` where the motion diverges.
        explained: Option<f64>,
    },
    /// Several records want inertias that differ by more than chance allows.
    RecordsDisagree {
        /// Standard deviation between records over the mean.
        relative: f64,
    },
    /// The same of records whose commands have different levels, as thrust that is not proportional to the command makes them
    /// differ; which law it follows is not told.
    ThrustNotProportional {
        /// Standard deviation between records over the mean.
        relative: f64,
        /// Width of the dead zone that would explain it, in units of the command; `None` where none would.
        dead_zone: Option<f64>,
        /// The exponent of the command that would.
        exponent: f64,
        /// Level of the command at which the values hold under that exponent; there, thrust is the command.
        level: f64,
    },
    /// Records of three levels or more have a dead zone, and no power of the command explains them.
    ThrustDeadZone {
        /// In units of the command.
        width: f64,
    },
    /// Records of three levels or more have a power of the command, and no dead zone explains them.
    ThrustPower {
        /// Its exponent.
        exponent: f64,
        /// Level of the command at which thrust is the command.
        level: f64,
    },
    /// The constant force grows with the level, as it does where the thrust's two sides differ.
    ForceFollowsLevel {
        /// By this part of it: half the sides' difference over their mean.
        share: f64,
    },
}

/// Half the interval's width over the value from which on an answer is of no use.
const TOO_WIDE: f64 = 0.5;
/// Least explained part of the variance, the efficiency of Nash and Sutcliffe (1970): satisfactory above by Moriasi et al. (2007), Trans.
/// ASABE 50, table 4.
const LEAST_EXPLAINED: f64 = 0.5;

impl Reason {
    /// Whether this inertia is too wide to be of use, by its practical interval where it has that.
    pub(crate) fn too_wide(alpha: Estimate) -> Option<Self> {
        let interval = alpha.combined.or(alpha.spread);
        let relative = interval.map(|interval| 0.5 * (interval.high - interval.low) / alpha.value.abs());
        match relative {
            Some(relative) if relative < TOO_WIDE => None,
            relative => Some(Self::TooWide { relative: relative.unwrap_or(f64::INFINITY) }),
        }
    }

    /// Whether a record that took no part in the estimate is predicted worse than is satisfactory.
    pub(crate) fn does_not_predict(explained: Option<f64>) -> Option<Self> {
        let enough = explained.is_some_and(|part| part >= LEAST_EXPLAINED);
        (!enough).then_some(Self::DoesNotPredict { explained: explained.filter(|part| part.is_finite()) })
    }

    /// The name that scripts see.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::Term(term) => term.name(),
            Self::DelayContradicted { .. } => "delay-contradicted",
            Self::HalvesDisagree { .. } => "halves-disagree",
            Self::Outliers { .. } => "outliers",
            Self::TooWide { .. } => "too-wide",
            Self::NoExperiment(_) => "no-experiment",
            Self::NotSettled => "not-settled",
            Self::SearchEnded { .. } => "search-ended",
            Self::DoesNotPredict { .. } => "does-not-predict",
            Self::RecordsDisagree { .. } => "records-disagree",
            Self::ThrustNotProportional { .. } => "thrust-not-proportional",
            Self::ThrustDeadZone { .. } => "thrust-dead-zone",
            Self::ThrustPower { .. } => "thrust-exponent",
            Self::ForceFollowsLevel { .. } => "force-follows-level",
        }
    }

    /// Its effect on the trust.
    #[must_use]
    pub fn trust(self) -> Trust {
        match self {
            Self::TooWide { .. }
            | Self::NotSettled
            | Self::SearchEnded { joining: true }
            | Self::DoesNotPredict { .. } => Trust::Doubtful,
            // A command of any shape separates the parameters if it moves the vehicle for two cycles.
            Self::NoExperiment(NotAnExperiment::NotHeld { .. }) => Trust::Widened,
            Self::NoExperiment(_) => Trust::Doubtful,
            Self::ForceFollowsLevel { .. } => Trust::Good,
            _ => Trust::Widened,
        }
    }
}

impl core::fmt::Display for Reason {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match *self {
            Self::Term(term) => {
                write!(f, "{}; it is estimated with the rest, and the intervals allow for the choice", term.finding())
            }
            Self::DelayContradicted { given_s, found_s } => write!(
                f,
                "the record has a delay of {found_s:.3} s, not the {given_s} s given{}: the estimates are those with the delay found",
                if found_s < given_s {
                    " (the log may hold the command as it acted, behind a part of the delay)"
                } else {
                    ""
                }
            ),
            Self::HalvesDisagree { probability } => write!(
                f,
                "the two halves of the record want different parameters (by chance once in {:.0} records): the vehicle \
                 changed, or a structure is at work that no term has; the interval of the inertia holds both",
                1.0 / probability.max(1e-9)
            ),
            Self::Outliers { count } => write!(f, "{count} readings far from all others were left out"),
            Self::TooWide { relative } if relative >= 1.0 => write!(
                f,
                "the record does not show whether there is an inertia; for a process without one, such as a heater, use \
                 `selfosc autotune`, otherwise `selfosc design` computes which experiment determines it"
            ),
            Self::TooWide { relative } => write!(
                f,
                "the inertia is known to within {:.0} % only; `selfosc design` computes which experiment determines it better",
                100.0 * relative
            ),
            Self::NoExperiment(missing) => write!(f, "the record is no relay experiment: {missing}"),
            Self::NotSettled => write!(
                f,
                "the search for the best parameters did not come to rest; leave out the start-up (--from), or give the delay (--delay) \
                 or the drag law (--drag)"
            ),
            Self::SearchEnded { joining } => write!(
                f,
                "the search for terms reached its limit of work, about a second of processor time: {} were not looked for; give a part of \
                 the record (--from, --to)",
                if joining { "further terms" } else { "other terms in place of those found" }
            ),
            Self::DoesNotPredict { explained } => {
                match explained {
                    Some(part) => write!(f, "the answer explains {} % of the variance", About(100.0 * part))?,
                    None => write!(f, "the motion diverges under the command")?,
                }
                write!(
                    f,
                    " of a record that it should predict (--validate), at least {} % needed: vehicle, load or unit of the command \
                     differ, or the model lacks a structure; check these, or fit all records together",
                    100.0 * LEAST_EXPLAINED
                )
            }
            Self::RecordsDisagree { relative } => write!(
                f,
                "the records want inertias that scatter by {:.1} % beyond chance; the interval holds their scatter",
                100.0 * relative
            ),
            Self::ThrustNotProportional { relative, dead_zone, exponent, level } => {
                write!(
                    f,
                    "records of different levels want inertias that scatter by {:.1} % beyond chance: thrust is not \
                     proportional to the command, or the vehicles differ. The command to the power of {exponent:.2} would explain \
                     them (the values hold where the level is {})",
                    100.0 * relative,
                    significant(level, 4)
                )?;
                if let Some(width) = dead_zone {
                    write!(
                        f,
                        ", a dead zone of {} would as well (another level can tell them apart)",
                        significant(width, 4)
                    )?;
                }
                write!(f, "; the intervals hold every record's own{}", dead_zone.map_or("", |_| " and the dead zone's"))
            }
            Self::ThrustDeadZone { width } => write!(
                f,
                "the records agree on a dead zone of the thrust of {}, in units of the command, and on no power of the command: \
                 the values are in units of the thrust beyond it",
                significant(width, 4)
            ),
            Self::ThrustPower { exponent, level } => write!(
                f,
                "the records agree on thrust as the command to the power of {exponent:.2}, and on no dead zone: the values hold \
                 where the level is {}",
                significant(level, 4)
            ),
            Self::ForceFollowsLevel { share } => write!(
                f,
                "the constant force grows with the level by {:.1} % of it: the thrust is that much stronger to the {} side than \
                 the mean of both, or the force changed between the records; the values are in units of the mean",
                100.0 * share.abs(),
                if share > 0.0 { "positive" } else { "negative" }
            ),
        }
    }
}
