//! What holds of every drag axis under a relay, as inequalities that interval arithmetic proves over whole domains.
//!
//! Each theorem follows from its inequalities by the few lines of algebra in its file in `spec/claims`. Where a quantity vanishes at
//! the border of the domain (weak drag, terminal speed), the inequality is about the Taylor coefficient of the first order
//! that does not vanish, enclosed from the border on; so the open domain is covered, the neighbourhood of its border too.

use super::closed_form::{force_left, quadratic_half_cycle, return_slope};
use crate::numeric::{Interval, Jet, Real};
use crate::proof::inequality::{Cell, Inequality, Proof, Refusal, VARIABLES};
use crate::proof::{Extent, Gradient, NotProved};

/// A statement with the inequalities that it rests on.
#[derive(Clone, Copy, Debug)]
pub struct Theorem {
    /// Name, that of its claim.
    pub id: &'static str,
    /// For which parameters, in words.
    pub domain: &'static str,
    /// What has to be shown by enclosure.
    pub inequalities: &'static [Inequality],
}

/// Boxes allowed for one inequality.
pub const BUDGET: usize = 200_000;

impl Theorem {
    /// Proofs of all inequalities, or the first search that does not end in one.
    ///
    /// # Errors
    /// The inequality that is not proved, and why.
    pub fn prove(&self) -> Result<Vec<Proof>, (Inequality, NotProved<VARIABLES>)> {
        let prove = |inequality: &Inequality| inequality.prove(BUDGET).map_err(|why| (*inequality, why));
        self.inequalities.iter().map(prove).collect()
    }

    /// Whether `proofs` show every inequality: by [`Inequality::check`], which searches nothing. Proofs of other inequalities
    /// do not matter.
    ///
    /// ```
    /// use selfosc::orbit::theorem::QUADRATIC;
    /// let mut proofs = QUADRATIC.prove().map_err(|(inequality, _)| inequality.id)?;
    /// assert!(QUADRATIC.check(&proofs).is_ok());
    /// proofs.pop();
    /// assert!(QUADRATIC.check(&proofs).is_err());
    /// # Ok::<(), &str>(())
    /// ```
    ///
    /// # Errors
    /// The first [`Refusal`].
    pub fn check(&self, proofs: &[Proof]) -> Result<(), Refusal> {
        self.inequalities.iter().try_for_each(|inequality| {
            let found = proofs.iter().find(|proof| proof.inequality == inequality.id);
            inequality.check(found.ok_or(Refusal::Missing { inequality: inequality.id })?)
        })
    }
}

const NONE: Extent = Extent::NONE;
/// Disturbance over relay level: what the theorems with disturbance cover.
const MU: Extent = Extent::new("mu", -0.95, 0.95);
/// Up to here a multiple zero at zero is divided out.
const NEAR_ZERO: f64 = 0.05;
/// From here on a border at one is treated by itself.
const NEAR_ONE: f64 = 0.9;

/// Denominator less numerator of the return map's slope, over the drag forces.
fn excess(at: &Cell) -> Gradient<2> {
    let [numerator, denominator] = return_slope(Gradient::constant(at[0]), Gradient::variables([at[1], at[2]]));
    denominator - numerator
}

const MU_ALL: Extent = Extent::new("mu", -1.0, 1.0);
const DRAG_1: Extent = Extent::new("d_1", 0.0, 2.0);
const DRAG_2: Extent = Extent::new("d_2", 0.0, 2.0);

/// With no drag the excess is zero, so it is positive where there is drag.
pub const EXCESS_FIRST: Inequality = Inequality {
    id: "excess-first",
    statement: "the excess of the slope's denominator over its numerator grows with the drag at the upper switching",
    variables: [MU_ALL, DRAG_1, DRAG_2],
    margin: |at| excess(at).slopes()[0],
};

/// The same for the other drag.
pub const EXCESS_SECOND: Inequality = Inequality {
    id: "excess-second",
    statement: "the excess of the slope's denominator over its numerator grows with the drag at the lower switching",
    variables: [MU_ALL, DRAG_1, DRAG_2],
    margin: |at| excess(at).slopes()[1],
};

/// Denominator of the slope, the drag forces as shares of the forces that drive.
fn denominator(at: &Cell) -> Interval {
    let [upward, downward] = [Interval::ONE + at[0], Interval::ONE - at[0]];
    return_slope(at[0], [at[1] * upward, at[2] * downward])[1]
}

/// With the excess `2 (d_1 + d_2)` it bounds the multiplier: `1 - m > 0.48 (d_1 + d_2)`.
pub const DENOMINATOR: Inequality = Inequality {
    id: "denominator",
    statement: "the slope's denominator is below 4.1",
    variables: [MU_ALL, Extent::new("d_1 over its force", 0.0, 1.0), Extent::new("d_2 over its force", 0.0, 1.0)],
    margin: |at| Interval::point(4.1) - denominator(at),
};

/// Up to half the terminal speed.
pub const FORCE_SLOW: Inequality = Inequality {
    id: "force-slow",
    statement: "drag leaves force up to half the terminal speed",
    variables: [Extent::new("speed", 0.0, 0.5), Extent::new("linear share", 0.0, 1.0), NONE],
    margin: |at| force_left(at[0], at[1]),
};

/// None is left at terminal speed, so some is left below.
pub const FORCE_FAST: Inequality = Inequality {
    id: "force-fast",
    statement: "the force that drag leaves falls from half the terminal speed to all of it",
    variables: [Extent::new("speed", 0.5, 1.0), Extent::new("linear share", 0.0, 1.0), NONE],
    margin: |at| {
        let [speed] = Gradient::variables([at[0]]);
        -force_left(speed, Gradient::constant(at[1])).slopes()[0]
    },
};

/// After a switching the command and the drag brake together.
pub const BRAKING: Inequality = Inequality {
    id: "braking",
    statement: "the other command brakes at every speed",
    variables: [MU, Extent::new("drag", 0.0, 2.0), NONE],
    margin: |at| Interval::ONE - at[0] + at[1],
};

/// At `gap = 1` the next speed is the terminal one, so it lies below for every finite g.
pub const QUADRATIC_NEXT: Inequality = Inequality {
    id: "quadratic-next",
    statement: "quadratic drag: the next switching speed grows with the gap 1 - exp(-4 g)",
    variables: [MU, Extent::new("y", 0.0, 2.0), Extent::new("gap", 0.0, 1.0)],
    margin: |at| {
        let [gap] = Gradient::variables([at[2]]);
        quadratic_half_cycle(Gradient::constant(at[1]), gap, Gradient::constant(Interval::ONE + at[0])).slopes()[0]
    },
};

/// Taylor coefficient `N - 1` of a function, at every point between zero and those of `at`.
fn last_coefficient<const N: usize>(at: Interval, function: impl Fn(Jet<N>) -> Jet<N>) -> Interval {
    function(Jet::variable(at.hull(Interval::ZERO))).coefficients()[N - 1]
}

/// `w ln(1/w) < sqrt w`: bounds the term of a logarithm at its singularity, `w = 1 - at`.
fn logarithmic_term(at: Interval) -> Interval {
    (Interval::ONE - at).max(Interval::ZERO).sqrt() * Interval::UNIT.max(Interval::ZERO)
}

/// The equation of the period has a triple zero at zero.
pub const LINEAR_WIDTH_SHORT: Inequality = Inequality {
    id: "linear-width-short",
    statement: "linear drag: z - tanh z over z^3 is positive for z <= 1/2",
    variables: [Extent::new("z", 0.0, 0.5), NONE, NONE],
    margin: |at| last_coefficient(at[0], |z: Jet<4>| z - z.tanh()),
};

/// Its derivative for all longer periods.
pub const LINEAR_WIDTH_LONG: Inequality = Inequality {
    id: "linear-width-long",
    statement: "linear drag: z - tanh z grows for z >= 1/2",
    variables: [Extent::new("z", 0.5, f64::INFINITY), NONE, NONE],
    margin: |at| at[0].tanh().square(),
};

/// `(1 + r) ln(1 + r) + (1 - r) ln(1 - r)`: positive where the relative overshoot falls with g, `r = y*`.
fn quadratic_overshoot<T: Real>(r: T) -> T {
    (T::one() + r) * r.ln_1p() + (T::one() - r) * (-r).ln_1p()
}

/// A double zero at zero.
pub const QUADRATIC_OVERSHOOT_WEAK: Inequality = Inequality {
    id: "quadratic-overshoot-weak",
    statement: "quadratic drag: the derivative of the relative overshoot, over y*^2 near zero, keeps its sign for y* <= 0.9",
    variables: [Extent::new("y*", 0.0, NEAR_ONE), NONE, NONE],
    margin: |at| {
        if at[0].upper() > NEAR_ZERO {
            quadratic_overshoot(at[0])
        } else {
            last_coefficient(at[0], quadratic_overshoot::<Jet<3>>)
        }
    },
};

/// Up to the strongest drag.
pub const QUADRATIC_OVERSHOOT_STRONG: Inequality = Inequality {
    id: "quadratic-overshoot-strong",
    statement: "quadratic drag: the derivative of the relative overshoot keeps its sign for y* >= 0.9",
    variables: [Extent::new("y*", NEAR_ONE, 1.0), NONE, NONE],
    margin: |at| (Interval::ONE + at[0]) * at[0].ln_1p() - logarithmic_term(at[0]),
};

/// `t (t - ln(1 + t)) - (1 - t)(atanh t - t)`: positive where the relative overshoot falls with g, `t = tanh z`.
fn linear_overshoot<T: Real>(t: T) -> T {
    t * (t - t.ln_1p()) - (T::one() - t) * (t.atanh() - t)
}

/// A triple zero at zero.
pub const LINEAR_OVERSHOOT_WEAK: Inequality = Inequality {
    id: "linear-overshoot-weak",
    statement: "linear drag: the derivative of the relative overshoot, over tanh^3 z near zero, keeps its sign for tanh z <= 0.9",
    variables: [Extent::new("tanh z", 0.0, NEAR_ONE), NONE, NONE],
    margin: |at| {
        if at[0].upper() > NEAR_ZERO {
            linear_overshoot(at[0])
        } else {
            last_coefficient(at[0], linear_overshoot::<Jet<4>>)
        }
    },
};

/// Up to the strongest drag: `(1 - t) atanh t = (1 - t) ln(1 + t)/2 - (1 - t) ln(1 - t)/2`.
pub const LINEAR_OVERSHOOT_STRONG: Inequality = Inequality {
    id: "linear-overshoot-strong",
    statement: "linear drag: the derivative of the relative overshoot keeps its sign for tanh z >= 0.9",
    variables: [Extent::new("tanh z", NEAR_ONE, 1.0), NONE, NONE],
    margin: |at| {
        let (t, rest) = (at[0], Interval::ONE - at[0]);
        let inverse = (rest * t.ln_1p() + logarithmic_term(t)) / Interval::two();
        t * (t - t.ln_1p()) - (inverse - rest * t)
    },
};

/// Quadratic drag: one attracting limit cycle.
pub const QUADRATIC: Theorem = Theorem {
    id: "orbit-quadratic",
    domain: "every alpha, beta, C, x_a > 0, as exp(-4 g) in (0, 1); every start",
    inequalities: &[EXCESS_FIRST, EXCESS_SECOND, DENOMINATOR, FORCE_SLOW, FORCE_FAST, QUADRATIC_NEXT],
};

/// Linear drag: one attracting limit cycle.
pub const LINEAR: Theorem = Theorem {
    id: "orbit-linear",
    domain: "every alpha, beta, C, x_a > 0, as z in (0, inf); every start",
    inequalities: &[
        EXCESS_FIRST,
        EXCESS_SECOND,
        DENOMINATOR,
        FORCE_SLOW,
        FORCE_FAST,
        LINEAR_WIDTH_SHORT,
        LINEAR_WIDTH_LONG,
    ],
};

/// Quadratic drag with a disturbance: one attracting limit cycle.
pub const QUADRATIC_DISTURBED: Theorem = Theorem {
    id: "orbit-quadratic-disturbed",
    domain: "every alpha, beta, C, x_a > 0 with |delta| <= 0.95 C, as exp(-4 g) in (0, 1); every start",
    inequalities: &[EXCESS_FIRST, EXCESS_SECOND, DENOMINATOR, FORCE_SLOW, FORCE_FAST, BRAKING, QUADRATIC_NEXT],
};

/// Linear drag with a disturbance: one attracting limit cycle.
pub const LINEAR_DISTURBED: Theorem = Theorem {
    id: "orbit-linear-disturbed",
    domain: "every alpha, beta, C, x_a > 0 with |delta| <= 0.95 C; every start",
    inequalities: &[EXCESS_FIRST, EXCESS_SECOND, DENOMINATOR, FORCE_SLOW, FORCE_FAST, BRAKING],
};

/// No switching earlier than the one that the formulas assume.
pub const NO_EARLY_SWITCHING: Theorem = Theorem {
    id: "orbit-no-early-switching",
    domain: "every mix of linear and quadratic drag, |delta| <= 0.95 C, every speed below the terminal one",
    inequalities: &[FORCE_SLOW, FORCE_FAST, BRAKING],
};

/// How fast deviations die out.
pub const MULTIPLIER: Theorem = Theorem {
    id: "orbit-multiplier",
    domain: "every mix of linear and quadratic drag, |delta| < C, no delay",
    inequalities: &[EXCESS_FIRST, EXCESS_SECOND, DENOMINATOR],
};

/// Quadratic drag: the relative overshoot identifies g.
pub const QUADRATIC_OVERSHOOT: Theorem = Theorem {
    id: "orbit-amplitude-monotone-quadratic",
    domain: "every g > 0, as y* = sqrt(1 - exp(-4 g)) in (0, 1)",
    inequalities: &[QUADRATIC_OVERSHOOT_WEAK, QUADRATIC_OVERSHOOT_STRONG],
};

/// Linear drag: the relative overshoot identifies g.
pub const LINEAR_OVERSHOOT: Theorem = Theorem {
    id: "orbit-amplitude-monotone-linear",
    domain: "every g > 0, as tanh z in (0, 1)",
    inequalities: &[LINEAR_OVERSHOOT_WEAK, LINEAR_OVERSHOOT_STRONG, LINEAR_WIDTH_SHORT, LINEAR_WIDTH_LONG],
};
