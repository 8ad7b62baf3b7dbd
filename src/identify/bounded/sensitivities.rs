//! Sensitivities of a motion, four columns side by side, and the linear equation that they obey.
//!
//! With c a point of the box, the difference `e = y(theta) - y(c)` of two motions obeys `e' = A e + sum (theta_j - c_j) b_j`. A has the
//! slope of the drag between the two velocities, and `b_j` is the derivative of the vector field by the j-th parameter along the motion of
//! c alone. So `e = sum (theta_j - c_j) s_j` with `s_j' = A s_j + b_j`: a mean value form in which only the drag's slope has a range
//! (Moore 1979; Neumaier, *Interval Methods for Systems of Equations*, 1990, section 2.3).

use super::vector_field::{FORCE, FieldTerm, POSITION, TERMS, VELOCITY, VectorField};
use crate::numeric::{Balls, Interval, Sizes};

/// The variable of a column of sensitivities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Variable {
    /// A component of the initial state.
    Initial(usize),
    /// A term of the equation.
    FieldTerm(FieldTerm),
    /// The delay, which moves every switching.
    Delay,
    /// The instant of a switching, by its number.
    Switching(usize),
}

/// Up to four columns side by side.
#[derive(Clone, Debug)]
pub(super) struct Block {
    variables: Vec<Variable>,
    /// The columns at the beginning.
    pub(super) initial: [Balls; 3],
    /// How far each variable may be from the point.
    pub(super) deviations: Balls,
    /// Terms of the equation among the variables, and a 1 in the lane of each.
    forcing: Vec<(FieldTerm, Balls)>,
}

impl Block {
    /// All variables, in their order.
    pub(super) fn of(variables: &[Variable], deviations: &[Interval]) -> Vec<Self> {
        let blocks = variables.chunks(Balls::COUNT).zip(deviations.chunks(Balls::COUNT));
        blocks
            .map(|(variables, deviations)| {
                let lanes_of = |own: Variable| {
                    let lane = |lane: usize| if variables.get(lane) == Some(&own) { 1.0 } else { 0.0 };
                    Balls::points(core::array::from_fn(lane))
                };
                let terms = FieldTerm::ALL.into_iter().filter(|term| variables.contains(&Variable::FieldTerm(*term)));
                let deviation = |lane: usize| deviations.get(lane).copied().unwrap_or(Interval::ZERO);
                Self {
                    initial: core::array::from_fn(|component| lanes_of(Variable::Initial(component))),
                    deviations: Balls::new(core::array::from_fn(deviation)),
                    forcing: terms.map(|term| (term, lanes_of(Variable::FieldTerm(term)))).collect(),
                    variables: variables.to_vec(),
                }
            })
            .collect()
    }

    /// Number of columns.
    pub(super) fn count(&self) -> usize {
        self.variables.len()
    }

    /// Whether a term of the equation is among the variables.
    pub(super) fn is_forced(&self) -> bool {
        !self.forcing.is_empty()
    }

    /// `b_j` of velocity and force, given the derivative of the vector field by each term.
    #[inline]
    pub(super) fn forcing(&self, by_term: impl Fn(FieldTerm) -> Balls) -> [Balls; 2] {
        [VELOCITY, FORCE].map(|component| {
            let lanes = |term: FieldTerm| self.forcing.iter().find(|(own, _)| *own == term);
            Balls::dot(FieldTerm::of(component).filter_map(lanes).map(|(term, lanes)| (*lanes, by_term(*term))))
        })
    }

    /// The delay of a switching by each variable; `None` for not at all.
    pub(super) fn shifts(&self, edge: usize) -> Option<Balls> {
        let shift = |variable: &Variable| match variable {
            Variable::Delay => 1.0,
            Variable::Switching(own) if *own == edge => 1.0,
            _ => 0.0,
        };
        let shifts = core::array::from_fn(|lane| self.variables.get(lane).map_or(0.0, shift));
        (shifts != [0.0; Balls::COUNT]).then(|| Balls::points(shifts))
    }
}

/// The unit columns of the three components of a state.
pub(super) fn units() -> [Balls; 3] {
    core::array::from_fn(|component| {
        Balls::points(core::array::from_fn(|lane| if lane == component { 1.0 } else { 0.0 }))
    })
}

/// The coefficients of the equation, the same in every lane.
pub(super) struct Equation {
    terms: [Balls; TERMS],
    active: [bool; TERMS],
}

impl Equation {
    pub(super) fn of(field: &VectorField) -> Self {
        Self { terms: field.terms.map(Balls::splat), active: field.active }
    }

    #[inline]
    pub(super) fn term(&self, term: FieldTerm) -> Balls {
        self.terms[term as usize]
    }
    #[inline]
    pub(super) fn has(&self, term: FieldTerm) -> bool {
        self.active[term as usize]
    }

    /// `A s + b`, given the drag's slope times the velocity of the columns.
    #[inline]
    pub(super) fn rates(&self, damped: Balls, [x, v, f]: [Balls; 3], forcing: [Balls; 2]) -> [Balls; 3] {
        let (mut acceleration, mut force) = (damped + forcing[0], forcing[1]);
        if self.has(FieldTerm::Stiffness) {
            acceleration = acceleration - self.term(FieldTerm::Stiffness) * x;
        }
        if self.has(FieldTerm::LagRate) {
            acceleration = acceleration + self.term(FieldTerm::Gain) * f;
            force = force - self.term(FieldTerm::LagRate) * f;
        }
        [v, acceleration, force]
    }

    /// Bounds of columns during a step of the length `h`. Gronwall: `|s|' <= lambda |s| + |b|` leaves
    /// `|s| <= (|s_0| + h |b|)/(1 - h lambda)` for `h lambda < 1`; a negative lambda counts as zero.
    ///
    /// `None` for `h lambda >= 1`.
    pub(super) fn gronwall(
        &self,
        damping: Interval,
        forcing: [Sizes; 2],
        start: &[Balls; 3],
        h: Interval,
    ) -> Option<[Sizes; 3]> {
        let magnitude = |value: Interval| Interval::point(value.magnitude());
        let own = |term: FieldTerm| if self.has(term) { self.term(term).interval_at(0) } else { Interval::ZERO };
        let (h, stiffness) = (magnitude(h), magnitude(own(FieldTerm::Stiffness)));
        let growing = |rate: Interval| Interval::point(rate.upper().max(0.0));
        // The position adds h |s_v| to |s_x|, hence h stiffness to lambda.
        let denominators =
            [growing(damping) + h * stiffness, growing(-own(FieldTerm::LagRate))].map(|rate| Interval::ONE - h * rate);
        if denominators.iter().any(|denominator| denominator.lower() <= 0.0) {
            return None;
        }
        let [grown, grown_force] = denominators.map(|denominator| Sizes::splat(Interval::ONE / denominator));
        let gain = if self.has(FieldTerm::LagRate) { self.term(FieldTerm::Gain).sizes() } else { Sizes::ZERO };
        let (h, [x, v, f], [on_velocity, on_force]) = (Sizes::splat(h), start.map(Balls::sizes), forcing);
        let f = (f + h * on_force) * grown_force;
        let v = (v + h * (Sizes::splat(stiffness) * x + gain * f + on_velocity)) * grown;
        Some([x + h * v, v, f])
    }

    /// Rates of columns during a step of the length `h`, the drag's slope anywhere in a range.
    pub(super) fn rates_within(
        &self,
        damping: Interval,
        forcing: [Balls; 2],
        start: &[Balls; 3],
        h: Interval,
    ) -> Option<[Balls; 3]> {
        let mut within = self.gronwall(damping, forcing.map(Balls::sizes), start, h)?.map(Balls::within);
        let (damping, passed) = (Balls::splat(damping), Balls::splat(Interval::ZERO.hull(h)));
        let rates = |within: [Balls; 3]| self.rates(damping * within[VELOCITY], within, forcing);
        // Picard iterations, each inside its predecessor.
        for _ in 0..2 {
            let rates = rates(within);
            within = [POSITION, VELOCITY, FORCE].map(|k| start[k] + passed * rates[k]);
        }
        Some(rates(within))
    }
}
