//! What a tool answers, and its comparison with the truth.

use std::borrow::Cow;

use crate::kinds::Case;
use crate::truth::Truth;

/// A value with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The value.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// A number without any error.
    #[must_use]
    pub fn exact(value: f64) -> Self {
        Self { value, low: value, high: value }
    }

    /// Whether a number lies within, rounding allowed for.
    #[must_use]
    pub fn holds(&self, number: f64) -> bool {
        let same = 1e-12 * number.abs();
        self.low - same <= number && number <= self.high + same
    }

    /// Half its width.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        0.5 * (self.high - self.low)
    }
}

/// Whether an answer is to be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// No test contradicts the model.
    Good,
    /// A named misfit is paid for in the interval.
    Widened,
    /// A named contradiction: not to be used.
    Doubtful,
    /// No answer at all.
    Refused,
}

impl Trust {
    /// Whether the tool stands by its interval.
    #[must_use]
    pub fn is_trusted(self) -> bool {
        matches!(self, Self::Good | Self::Widened)
    }
}

/// A tool's one answer to a case. `None` is a parameter that the answer is silent about.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Whether to use it.
    pub trust: Trust,
    /// Codes of the reasons, the weightiest first.
    pub reasons: Vec<Cow<'static, str>>,
    /// Inertia.
    pub alpha: Option<Interval>,
    /// Linear drag; [`Interval::exact`] zero where the law has none.
    pub beta: Option<Interval>,
    /// Quadratic drag; [`Interval::exact`] zero where the law has none.
    pub beta_quadratic: Option<Interval>,
    /// Cubic drag.
    pub beta_cubic: Option<Interval>,
    /// Restoring force per output.
    pub stiffness: Option<Interval>,
    /// Time constant of the actuator in s.
    pub lag_s: Option<Interval>,
    /// Delay of the loop in s, where it was not given.
    pub delay_s: Option<Interval>,
    /// Constant force during each record.
    pub delta: Vec<Option<Interval>>,
}

impl Answer {
    /// No answer, for this reason.
    #[must_use]
    pub fn refused(reason: impl Into<Cow<'static, str>>) -> Self {
        Self {
            trust: Trust::Refused,
            reasons: vec![reason.into()],
            alpha: None,
            beta: None,
            beta_quadratic: None,
            beta_cubic: None,
            stiffness: None,
            lag_s: None,
            delay_s: None,
            delta: Vec::new(),
        }
    }

    /// Whether alpha's interval holds the truth of every record; `None` without one.
    #[must_use]
    pub fn holds_alpha(&self, truths: &[Truth]) -> Option<bool> {
        self.alpha.map(|alpha| truths.iter().all(|truth| alpha.holds(truth.alpha)))
    }

    /// For every parameter that has both a truth and an interval: whether the one is in the other.
    #[must_use]
    pub fn coverage(&self, case: &Case) -> Vec<(&'static str, bool)> {
        let truth = &case.truths[0];
        let mut found = vec![
            ("beta", Some(truth.beta), self.beta),
            ("beta_quadratic", Some(truth.beta_quadratic), self.beta_quadratic),
            ("beta_cubic", Some(truth.beta_cubic), self.beta_cubic),
            ("stiffness", Some(truth.stiffness), self.stiffness),
            ("lag_s", truth.lag_s, self.lag_s),
            ("delay_s", Some(truth.delay_s), self.delay_s),
        ];
        found.extend(case.truths.iter().zip(&self.delta).map(|(truth, delta)| ("delta", truth.delta, *delta)));
        let covered = found.into_iter().filter_map(|(name, truth, interval)| Some((name, interval?.holds(truth?))));
        let alpha = self.holds_alpha(&case.truths).map(|held| ("alpha", held));
        alpha.into_iter().chain(covered).collect()
    }
}
