//! The equation of motion over boxes of parameters, and its derivatives.

use serde::{Deserialize, Serialize};

use super::answer::Quantity;
use crate::numeric::{Interval, Real};

/// Terms of the acceleration, one parameter each. The equation is linear in every parameter but the rate of the lag.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum FieldTerm {
    /// `1/alpha`, times the force.
    Gain,
    /// Disturbance over alpha.
    Disturbance,
    /// Drag at the middle speed, over alpha: the linear coefficient plus twice the middle speed times the quadratic one.
    Linear,
    /// Quadratic drag over alpha.
    Quadratic,
    /// Cubic drag over alpha.
    Cubic,
    /// Stiffness over alpha.
    Stiffness,
    /// Reciprocal of the time constant with which the force follows the command.
    LagRate,
}

/// Number of [`FieldTerm`]s.
pub(super) const TERMS: usize = 7;

impl FieldTerm {
    pub(super) const ALL: [Self; TERMS] =
        [Self::Gain, Self::Disturbance, Self::Linear, Self::Quadratic, Self::Cubic, Self::Stiffness, Self::LagRate];

    /// The terms in the rate of a component of the state: of the force, or of the velocity.
    pub(super) fn of(component: usize) -> impl Iterator<Item = Self> + Clone {
        Self::ALL.into_iter().filter(move |term| (*term == Self::LagRate) == (component == FORCE))
    }

    /// The coefficient; of the linear term without the share of the quadratic one, of the disturbance in the first record.
    pub(super) fn quantity(self) -> Quantity {
        match self {
            Self::Gain => Quantity::Gain,
            Self::Disturbance => Quantity::DeltaRate(0),
            Self::Linear => Quantity::LinearRate,
            Self::Quadratic => Quantity::QuadraticRate,
            Self::Cubic => Quantity::CubicRate,
            Self::Stiffness => Quantity::StiffnessRate,
            Self::LagRate => Quantity::LagRate,
        }
    }
}

/// Position, velocity, and force over its unit gain.
pub(super) type StateBox = [Interval; 3];
pub(super) const POSITION: usize = 0;
pub(super) const VELOCITY: usize = 1;
pub(super) const FORCE: usize = 2;

/// `v' = gain f + disturbance - linear v - quadratic (|v| - 2 m) v - cubic v^3 - stiffness x`. The force f is the command u, or follows
/// it with a lag: `f' = rate (u - f)`.
///
/// The middle speed m makes the two drags nearly independent: along the set of feasible parameters a larger quadratic coefficient is
/// offset by a smaller linear one, and the drag at the speed m stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct VectorField {
    pub(super) terms: [Interval; TERMS],
    pub(super) active: [bool; TERMS],
    pub(super) middle_speed: f64,
}

/// The equation over a box, and at a point of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fields {
    pub(super) over: VectorField,
    pub(super) at: VectorField,
}

/// The state over a box, and of the point.
#[derive(Clone, Copy, Debug)]
pub(super) struct StatePair {
    pub(super) over: StateBox,
    pub(super) at: StateBox,
}

/// `v |v|` of every element.
pub(super) fn signed_square(v: Interval) -> Interval {
    let square = |end: f64| {
        let square = Interval::point(end).square();
        if end < 0.0 { -square } else { square }
    };
    square(v.lower()).hull(square(v.upper()))
}

/// `(|v| - 2 m) v` of every element: `(v - m)^2 - m^2` forwards, odd in v.
pub(super) fn shifted_square(v: Interval, middle: f64) -> Interval {
    let m = Interval::point(middle);
    let forwards = |v: Interval| (v - m).square() - m.square();
    if v.lower() >= 0.0 {
        return forwards(v);
    }
    if v.upper() <= 0.0 {
        return -forwards(-v);
    }
    let half = |end: f64| forwards(Interval::ZERO.hull(Interval::point(end)));
    half(v.upper()).hull(-half(-v.lower()))
}

/// `v^3` of every element.
pub(super) fn cube(v: Interval) -> Interval {
    let cube = |end: f64| Interval::point(end) * Interval::point(end).square();
    cube(v.lower()).hull(cube(v.upper()))
}

/// `(v |v| - w |w|)/(v - w)`: the sum of the speeds for velocities of one sign, between half of it and all of it for two signs.
fn square_slope(v: Interval, w: Interval) -> Interval {
    let sum = v.abs() + w.abs();
    let one_sign = (v.lower() >= 0.0 && w.lower() >= 0.0) || (v.upper() <= 0.0 && w.upper() <= 0.0);
    if one_sign { sum } else { sum.hull(Interval::point(0.5) * sum) }
}

/// Whether velocities of both signs are possible.
pub(super) fn changes_sign(v: Interval) -> bool {
    v.lower() < 0.0 && v.upper() > 0.0
}

impl VectorField {
    #[inline]
    pub(super) fn term(&self, term: FieldTerm) -> Interval {
        self.terms[term as usize]
    }
    #[inline]
    pub(super) fn has(&self, term: FieldTerm) -> bool {
        self.active[term as usize]
    }
    #[inline]
    pub(super) fn twice_middle(&self) -> Interval {
        Interval::point(2.0 * self.middle_speed)
    }

    /// Time derivatives of position, velocity and force.
    pub(super) fn rate(&self, state: &StateBox, u: Interval) -> StateBox {
        core::array::from_fn(|component| self.rate_of(component, state, u))
    }

    /// The time derivative of one component: position, or the sum of its terms.
    pub(super) fn rate_of(&self, component: usize, state: &StateBox, u: Interval) -> Interval {
        if component == POSITION {
            return state[VELOCITY];
        }
        let terms = FieldTerm::of(component).filter(|term| self.has(*term));
        Interval::dot(terms.map(|term| (self.term(term), self.by_term(term, state, u))))
    }

    /// `(a(v) - a(w))/(v - w)`, the slope of the acceleration between two velocities at the same position and force.
    pub(super) fn damping(&self, v: Interval, w: Interval) -> Interval {
        let mut slope = -self.term(FieldTerm::Linear);
        if self.has(FieldTerm::Quadratic) {
            slope -= self.term(FieldTerm::Quadratic) * (square_slope(v, w) - self.twice_middle());
        }
        if self.has(FieldTerm::Cubic) {
            // v^2 + v w + w^2 >= 0.
            slope -= self.term(FieldTerm::Cubic) * (v.square() + v * w + w.square()).max(Interval::ZERO);
        }
        slope
    }

    /// The derivative of the vector field with respect to a term: of the force's rate for the lag, of the velocity's rate else.
    pub(super) fn by_term(&self, term: FieldTerm, [x, v, f]: &StateBox, u: Interval) -> Interval {
        match term {
            FieldTerm::Gain => *f,
            FieldTerm::Disturbance => Interval::ONE,
            FieldTerm::Linear => -*v,
            FieldTerm::Quadratic => -shifted_square(*v, self.middle_speed),
            FieldTerm::Cubic => -cube(*v),
            FieldTerm::Stiffness => -*x,
            FieldTerm::LagRate => u - *f,
        }
    }

    /// The fastest rate of the linearised equation, in 1/s.
    pub(super) fn fastest_rate(&self, v: Interval) -> f64 {
        let lag = if self.has(FieldTerm::LagRate) { self.term(FieldTerm::LagRate).magnitude() } else { 0.0 };
        let spring =
            if self.has(FieldTerm::Stiffness) { libm::sqrt(self.term(FieldTerm::Stiffness).magnitude()) } else { 0.0 };
        self.damping(v, v).magnitude().max(lag).max(spring)
    }
}
