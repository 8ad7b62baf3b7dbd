//! Error bound of the sensitivities: how far those over a box are from the point's own within a step.
//!
//! With c a column of the point's and d the difference of the box's column from it, `d' = A d + (A - A_c) c`, where A has the slope of
//! the drag between the two velocities and `A_c` that at the point's velocity. Gronwall's inequality bounds d from bounds of c and of the
//! distance of the two velocities.

use super::sensitivities::{Block, Equation, units};
use super::vector_field::{FORCE, FieldTerm, Fields, StateBox, VELOCITY};
use crate::numeric::{Balls, Interval, Real, Sizes};

/// Bounds of d at the end of a step of the length `h`, of velocity and force.
#[derive(Clone, Debug)]
pub(super) struct SensitivityError {
    h: Interval,
    /// By each component of the initial state.
    by_start: [Sizes; 2],
    /// By the variables of each block, from zero columns.
    by_forcing: Vec<[Sizes; 2]>,
}

/// Bounds of the entries of `A - A_c`.
struct Apart {
    damping: Interval,
    stiffness: Interval,
    gain: Interval,
    lag: Interval,
}

impl Apart {
    /// `(A - A_c) c` of velocity and force, for a column bounded by c.
    fn times(&self, [x, v, f]: [Sizes; 3]) -> [Sizes; 2] {
        let [damping, stiffness, gain, lag] = [self.damping, self.stiffness, self.gain, self.lag].map(Sizes::splat);
        [damping * v + stiffness * x + gain * f, lag * f]
    }
}

impl SensitivityError {
    /// Of a step of the length `h` in which states over the box and of the point begin at `start` and stay `within`. `None` where
    /// Gronwall's inequality gives no bound.
    pub(super) fn of(
        fields: &Fields,
        start: [&StateBox; 2],
        within: [&StateBox; 2],
        u: Interval,
        h: Interval,
        blocks: &[Block],
    ) -> Option<Self> {
        const ZEROS: [Balls; 3] = [Balls::ZERO; 3];
        let Fields { over, at } = fields;
        let slope = over.damping(within[0][VELOCITY], within[1][VELOCITY]);
        let own_slope = at.damping(within[1][VELOCITY], within[1][VELOCITY]);
        let (equation, own) = (Equation::of(over), Equation::of(at));
        let by_term = |term: FieldTerm| Balls::splat(at.by_term(term, within[1], u));
        // |y(theta) - y(c)| from the distance of the starts and of the forces on them.
        let first: StateBox = core::array::from_fn(|k| start[0][k] - start[1][k]);
        let forces = fields.forces_apart(|term| by_term(term).sizes());
        let [_, distance, _] = equation.gronwall(slope, forces, &first.map(Balls::splat), h)?.map(Sizes::interval);
        let apart = fields.apart(within[1][VELOCITY], distance);
        let ends = |forcing: [Sizes; 2], start: &[Balls; 3]| {
            let column = own.gronwall(own_slope, forcing, start, h)?;
            let [_, v, f] = equation.gronwall(slope, apart.times(column), &ZEROS, h)?;
            Some([v, f])
        };
        let by_start = ends([Sizes::ZERO; 2], &units())?;
        let forced = |block: &Block| ends(block.forcing(by_term).map(Balls::sizes), &ZEROS);
        let by_forcing: Option<Vec<_>> = blocks.iter().map(forced).collect();
        Some(Self { h, by_start, by_forcing: by_forcing? })
    }

    /// Adds the bounds after a time t to the point's columns.
    ///
    /// From a unit start c is bounded and d grows at most linearly: `d(t) <= d(h) t/h`, its integral `d(h) t^2/(2 h)`. From zero c
    /// grows at most linearly: `d(t) <= d(h) t^2/(2 h^2)`, its integral `d(h) t^3/(6 h^2)`.
    pub(super) fn add(&self, time: Interval, by_start: &mut [Balls; 3], by_forcing: &mut [[Balls; 3]]) {
        let (share, half) = (time / self.h, Interval::point(0.5));
        let square = half * share * share;
        let from_start = [half * share * time, share, share].map(Sizes::splat);
        let from_zero = [square * time / Interval::point(3.0), square, square].map(Sizes::splat);
        let add = |to: &mut [Balls; 3], [v, f]: [Sizes; 2], shares: [Sizes; 3]| {
            for ((to, end), share) in to.iter_mut().zip([v, v, f]).zip(shares) {
                *to = *to + Balls::within(end * share);
            }
        };
        add(by_start, self.by_start, from_start);
        for (by_forcing, ends) in by_forcing.iter_mut().zip(&self.by_forcing) {
            add(by_forcing, *ends, from_zero);
        }
    }
}

impl Fields {
    /// Bounds of `sum (theta_j - c_j) b_j` of velocity and force, given the derivative by each term along the point's motion.
    fn forces_apart(&self, by_term: impl Fn(FieldTerm) -> Sizes) -> [Sizes; 2] {
        [VELOCITY, FORCE].map(|component| {
            let terms = FieldTerm::of(component).filter(|term| self.over.has(*term));
            Sizes::dot(terms.map(|term| (Sizes::splat(self.over.term(term) - self.at.term(term)), by_term(term))))
        })
    }

    /// `A - A_c` where the point has the velocities v, and those over the box are within a distance of them.
    fn apart(&self, v: Interval, distance: Interval) -> Apart {
        let Self { over, at } = self;
        let apart = |term: FieldTerm| over.term(term) - at.term(term);
        let (three, off) = (Interval::point(3.0), Interval::symmetric(distance.upper()));
        let quadratic = apart(FieldTerm::Quadratic) * (v.abs() + v.abs() - over.twice_middle());
        let cubic = apart(FieldTerm::Cubic) * three * v.square();
        // |w| - |v| <= |w - v|, and w^2 + w v + v^2 - 3 v^2 = 3 v (w - v) + (w - v)^2.
        let faster =
            over.term(FieldTerm::Quadratic) * off + over.term(FieldTerm::Cubic) * (three * v * off + off.square());
        Apart {
            damping: apart(FieldTerm::Linear) + quadratic + cubic + faster,
            stiffness: apart(FieldTerm::Stiffness),
            gain: if over.has(FieldTerm::LagRate) { apart(FieldTerm::Gain) } else { Interval::ZERO },
            lag: apart(FieldTerm::LagRate),
        }
    }
}
