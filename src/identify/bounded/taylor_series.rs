//! Taylor coefficients in time of the motion of a point and of its sensitivities, by automatic differentiation (Moore 1966; Berz and
//! Makino, *Reliable Computing* 4, 1998). The coefficient of the highest degree is an enclosure over the whole step: Lagrange's remainder.

use super::sensitivities::{Block, Equation};
use super::vector_field::{FORCE, FieldTerm, POSITION, StateBox, VELOCITY, VectorField};
use crate::numeric::{Balls, Interval, Sizes};

/// Degree of a step's polynomials, the remainder included: at rates of `h lambda = 0.4` it is `0.4^8/8!`, a unit in the eighth digit.
pub(super) const DEGREE: usize = 8;

type TaylorCoefficients<T> = [T; DEGREE + 1];
type Series = TaylorCoefficients<Balls>;
/// Polynomials of position, velocity and force.
pub(super) type TaylorPath = [Series; 3];

const ZEROS: Series = [Balls::ZERO; DEGREE + 1];
pub(super) const NO_PATH: TaylorPath = [ZEROS; 3];

/// Lanes of a point's series: from the middle of its start, from its whole start, and from all states of the step.
const MIDDLE: usize = 0;
const START: usize = 1;
const WITHIN: usize = 2;

/// `sum_i a_i b_(k - i)`, the k-th coefficient of a product.
#[inline]
fn product(a: &Series, b: &Series, k: usize) -> Balls {
    Balls::dot(a[..=k].iter().copied().zip(b[..=k].iter().rev().copied()))
}

/// Values of polynomials of a degree after a time; without a lag the force stays.
pub(super) fn values(path: &TaylorPath, time: Interval, degree: usize, lagged: bool) -> [Balls; 3] {
    let time = Balls::splat(time);
    let mut powers = ZEROS;
    powers[0] = Balls::ONE;
    for k in 1..=degree {
        powers[k] = powers[k - 1] * time;
    }
    let value = |series: &Series| Balls::dot(series.iter().copied().zip(powers[..=degree].iter().copied()));
    core::array::from_fn(|k| if k == FORCE && !lagged { path[k][0] } else { value(&path[k]) })
}

/// Degree of [`line`].
pub(super) const LINE: usize = 2;

/// Velocity and force on a straight line, the position on its integral.
pub(super) fn line(start: &[Balls; 3], rate: &[Balls; 3]) -> TaylorPath {
    let mut path = NO_PATH;
    for k in [POSITION, VELOCITY, FORCE] {
        (path[k][0], path[k][1]) = (start[k], rate[k]);
    }
    path[POSITION][1] = start[VELOCITY];
    path[POSITION][2] = rate[VELOCITY].share(2);
    path
}

/// The motion of a point during a step in which its velocity has one sign: its coefficients, and those of the terms' derivatives.
pub(super) struct PointSeries {
    equation: Equation,
    state: TaylorPath,
    /// `(|v| - 2 m) v`, `v^3` and `u - f`.
    drag: Series,
    cube: Series,
    lag_input: Series,
    /// The drag's slope along the motion: from the start, and its bound from all states.
    damping: Series,
    damping_bound: TaylorCoefficients<Sizes>,
    /// Over the whole step.
    damping_range: Interval,
    h: Interval,
}

impl PointSeries {
    /// From the middle of a start, all of it, and the states `within` a step of the length `h`, all velocities `backwards` or none.
    pub(super) fn of(
        field: &VectorField,
        [middle, start, within]: [&StateBox; 3],
        u: Interval,
        backwards: bool,
        h: Interval,
    ) -> Self {
        let (u, twice_middle) = (Balls::splat(u), Balls::splat(field.twice_middle()));
        let mut own = Self {
            equation: Equation::of(field),
            state: core::array::from_fn(|component| {
                let [middle, start, within] = [middle, start, within].map(|state| state[component]);
                let mut series = ZEROS;
                series[0] = Balls::new([middle, start, within, within]);
                series
            }),
            drag: ZEROS,
            cube: ZEROS,
            lag_input: ZEROS,
            damping: ZEROS,
            damping_bound: [Sizes::ZERO; DEGREE + 1],
            damping_range: field.damping(within[VELOCITY], within[VELOCITY]),
            h,
        };
        let [linear, quadratic, cubic] =
            [FieldTerm::Linear, FieldTerm::Quadratic, FieldTerm::Cubic].map(|term| own.equation.term(term));
        let (mut shifted, mut square) = (ZEROS, ZEROS);
        for k in 0..=DEGREE {
            let constant = |value: Balls| if k == 0 { value } else { Balls::ZERO };
            let v = &own.state[VELOCITY];
            let mut damping = -constant(linear);
            if field.has(FieldTerm::Quadratic) {
                let speed = if backwards { -v[k] } else { v[k] };
                shifted[k] = speed - constant(twice_middle);
                own.drag[k] = product(&shifted, v, k);
                // d/dv (|v| - 2 m) v = 2 |v| - 2 m.
                damping = damping - quadratic * (speed + shifted[k]);
            }
            if field.has(FieldTerm::Cubic) {
                square[k] = product(v, v, k);
                own.cube[k] = product(&square, v, k);
                damping = damping - cubic * (square[k] + square[k] + square[k]);
            }
            (own.damping[k], own.damping_bound[k]) = (damping.spread(START), damping.sizes().spread(WITHIN));
            own.lag_input[k] = constant(u) - own.state[FORCE][k];
            if k == DEGREE {
                break;
            }
            // (k + 1) y_(k + 1) is the k-th coefficient of the vector field along y.
            own.state[POSITION][k + 1] = v[k].share(k + 1);
            let moved = if field.has(FieldTerm::LagRate) { &[VELOCITY, FORCE][..] } else { &[VELOCITY] };
            for &component in moved {
                let terms = FieldTerm::of(component).filter(|term| field.has(*term));
                let rate = Balls::dot(terms.map(|term| (own.equation.term(term), own.by_term(term, k))));
                own.state[component][k + 1] = rate.share(k + 1);
            }
        }
        own
    }

    /// The motion from the middle of the start, with its remainder.
    pub(super) fn path(&self) -> TaylorPath {
        self.state
            .each_ref()
            .map(|own| core::array::from_fn(|k| own[k].spread(if k == DEGREE { WITHIN } else { MIDDLE })))
    }

    /// The k-th coefficient of the vector field's derivative by a term, along the motion.
    #[inline]
    fn by_term(&self, term: FieldTerm, k: usize) -> Balls {
        let [x, v, f] = &self.state;
        match term {
            FieldTerm::Gain => f[k],
            FieldTerm::Disturbance if k == 0 => Balls::ONE,
            FieldTerm::Disturbance => Balls::ZERO,
            FieldTerm::Linear => -v[k],
            FieldTerm::Quadratic => -self.drag[k],
            FieldTerm::Cubic => -self.cube[k],
            FieldTerm::Stiffness => -x[k],
            FieldTerm::LagRate => self.lag_input[k],
        }
    }

    /// Columns of sensitivities from their start, forced by the terms of a block. `None` where Gronwall's inequality gives no bound.
    pub(super) fn columns(&self, block: Option<&Block>, start: &[Balls; 3]) -> Option<TaylorPath> {
        let forcing = |k: usize, lane: usize| {
            block.map_or([Balls::ZERO; 2], |block| block.forcing(|term| self.by_term(term, k).spread(lane)))
        };
        let mut path = NO_PATH;
        for (series, start) in path.iter_mut().zip(start) {
            series[0] = *start;
        }
        let components = if self.equation.has(FieldTerm::LagRate) { 3 } else { 2 };
        for k in 0..DEGREE - 1 {
            let own = path.each_ref().map(|series| series[k]);
            let rates = self.equation.rates(product(&self.damping, &path[VELOCITY], k), own, forcing(k, START));
            for (series, rate) in path.iter_mut().zip(rates).take(components) {
                series[k + 1] = rate.share(k + 1);
            }
        }
        // The remainder: the same recursion from bounds over the whole step.
        let bound = |k: usize| forcing(k, WITHIN).map(Balls::sizes);
        let mut within = self.equation.gronwall(self.damping_range, bound(0), start, self.h)?.map(|size| {
            let mut series = [Sizes::ZERO; DEGREE + 1];
            series[0] = size;
            series
        });
        let size = |term: FieldTerm| {
            let moves =
                self.equation.has(FieldTerm::LagRate) || term == FieldTerm::Stiffness && self.equation.has(term);
            if moves { self.equation.term(term).sizes() } else { Sizes::ZERO }
        };
        let [stiffness, gain, lag] = [FieldTerm::Stiffness, FieldTerm::Gain, FieldTerm::LagRate].map(size);
        for k in 0..DEGREE {
            let [x, v, f] = within.each_ref().map(|series| series[k]);
            let damping = self.damping_bound[..=k].iter().copied();
            let damped = Sizes::dot(damping.zip(within[VELOCITY][..=k].iter().rev().copied()));
            let [on_velocity, on_force] = bound(k);
            let rates = [v, damped + on_velocity + stiffness * x + gain * f, on_force + lag * f];
            for (series, rate) in within.iter_mut().zip(rates) {
                series[k + 1] = rate.share(k + 1);
            }
        }
        for (series, within) in path.iter_mut().zip(&within).take(components) {
            series[DEGREE] = Balls::within(within[DEGREE]);
        }
        Some(path)
    }
}
