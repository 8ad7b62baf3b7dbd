//! The answer to use.

use serde::{Deserialize, Serialize};

use super::{BudgetEntry, Disturbances, DragCovariance, DragLaw, Estimate, LawEvidence, Reason, Term, Trust};

/// The answer to use. Intervals are those of all models that the records do not refute. Values of a single record are
/// the likeliest model's, which belong together; of several, pooled means over the models, each parameter by itself.
///
/// In the document a drag that the given law excludes is null, and a reason is its code and text: there `Drag` is `Option<Estimate>`, and
/// `Why` is [`Caution`](crate::identify::Caution).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reported<Drag = Estimate, Why = Reason> {
    /// The law that was given, or mixed: the intervals of both drags bound each.
    pub drag: DragLaw,
    /// The likelihood of the records by each law; in the document with the choice of the law.
    #[serde(default, skip_serializing_if = "LawEvidence::is_empty")]
    pub laws: LawEvidence,
    /// Terms of the likeliest model.
    pub terms: Vec<Term>,
    /// Inertia.
    pub alpha: Estimate,
    /// Linear drag, of either sign; without error where no model that counts has it.
    pub beta: Drag,
    /// Quadratic drag.
    pub beta_quadratic: Drag,
    /// Cubic drag, where the likeliest model has it.
    pub beta_cubic: Option<Estimate>,
    /// How the three vary together; `None` where several records do not agree in each of them.
    #[serde(default)]
    pub drag_covariance: Option<DragCovariance>,
    /// Part by which drag is larger to the positive side than the mean of both, where the likeliest model has it.
    pub skew: Option<Estimate>,
    /// Coulomb friction of a model written by hand; no record is fitted with it.
    pub coulomb: Option<Estimate>,
    /// Factor of the drag that follows the speed late, where the likeliest model has it.
    pub memory: Option<Estimate>,
    /// Time constant in s with which it follows, where the likeliest model has it.
    pub memory_s: Option<Estimate>,
    /// Restoring force per output, where the likeliest model has it.
    pub stiffness: Option<Estimate>,
    /// Time constant of the actuator in s, where the likeliest model has it.
    pub lag_s: Option<Estimate>,
    /// Time of the actuator over the command's range in s, where the likeliest model limits its rate.
    pub ramp_s: Option<Estimate>,
    /// Time without thrust after the command changes its sign in s, where the likeliest model has it.
    #[serde(default)]
    pub pause_s: Option<Estimate>,
    /// Time constant of the sensor's filter in s, where the likeliest model has it.
    pub filter_s: Option<Estimate>,
    /// Constant force during each record: in units of the record's own command where two levels leave the law of thrust open.
    #[serde(flatten)]
    pub deltas: Disturbances,
    /// Delay in s.
    pub delay_s: Estimate,
    /// Sources of error that no residual shows, the largest first: the part of the practical intervals beyond the record's scatter.
    #[serde(default)]
    pub budget: Vec<BudgetEntry>,
    /// Whether to use it.
    pub trust: Trust,
    /// Why not simply good, the weightiest first.
    pub reasons: Vec<Why>,
}

impl Reported {
    /// Delay with the mean time by which lag, limited rate and pause make the actuator late, and a filter the sensor, in s.
    #[must_use]
    pub fn mean_delay_s(&self) -> f64 {
        let late = |time_s: Option<Estimate>| time_s.map_or(0.0, |estimate| estimate.value);
        self.delay_s.value + late(self.lag_s) + late(self.filter_s) + 0.5 * (late(self.ramp_s) + late(self.pause_s))
    }

    /// Linear, quadratic and cubic drag.
    pub(crate) fn drags(&self) -> [Option<Estimate>; 3] {
        [Some(self.beta), Some(self.beta_quadratic), self.beta_cubic]
    }

    /// With a further reason.
    pub(crate) fn with_reason(mut self, reason: Reason) -> Self {
        self.reasons.push(reason);
        self.reasons.sort_by_key(|reason| core::cmp::Reverse(reason.trust()));
        Self { trust: self.trust.max(reason.trust()), ..self }
    }

    /// The same in new units of force.
    pub(crate) fn in_units(self, factor: f64) -> Self {
        let drag_covariance = self.drag_covariance.map(|covariance| covariance.in_units(factor));
        Self { drag_covariance, ..self.forces(|estimate| estimate.in_units(factor)) }
    }

    /// With a relative error of the unit of force.
    pub(crate) fn with_error(self, relative: f64) -> Self {
        let values = self.drags().map(|drag| drag.map_or(0.0, |drag| drag.value));
        let drag_covariance = self.drag_covariance.map(|covariance| covariance.with_error(relative, values));
        Self { drag_covariance, ..self.forces(|estimate| estimate.with_error(relative)) }
    }

    fn forces(mut self, change: impl Fn(Estimate) -> Estimate) -> Self {
        let always = [&mut self.alpha, &mut self.beta, &mut self.beta_quadratic];
        let others = [&mut self.beta_cubic, &mut self.memory, &mut self.stiffness];
        let all = always.into_iter().chain(others.into_iter().flatten()).chain(self.deltas.iter_mut());
        all.for_each(|estimate| *estimate = change(*estimate));
        self
    }
}
