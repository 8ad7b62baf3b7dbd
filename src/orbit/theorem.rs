//! Theorems on every drag axis under a relay, as inequalities that interval arithmetic proves over whole domains.
//!
//! Each theorem follows from its inequalities by the few lines of algebra in its file in `spec/claims`. Some quantities vanish at
//! the border of the domain (weak drag, terminal speed). There the inequality is about the first Taylor coefficient that does not
//! vanish, enclosed from the border on: this covers the open domain, the neighbourhood of its border too.

use super::closed_form::{force_left, quadratic_half_cycle, return_slope};
use crate::numeric::Real;
use crate::proof::inequality::{Inequality, Proof, Refusal};
use crate::proof::margin::Margin;
use crate::proof::margin::VARIABLES;
use crate::proof::{Extent, NotProved, formula};

/// A statement with the inequalities that it rests on.
#[derive(Clone, Copy, Debug)]
pub struct Theorem {
    /// Name, that of its claim.
    pub id: &'static str,
    /// For which parameters, in words.
    pub domain: &'static str,
    /// The inequalities to show by enclosure.
    pub inequalities: &'static [Inequality],
}

/// Boxes allowed for an inequality.
pub const BUDGET: usize = 200_000;

impl Theorem {
    /// Proofs of all inequalities, or the first search that does not end in a proof.
    ///
    /// # Errors
    /// The inequality that is not proved, and why.
    pub fn prove(&self) -> Result<Vec<Proof>, (Inequality, NotProved<VARIABLES>)> {
        let prove = |inequality: &Inequality| inequality.prove(BUDGET).map_err(|why| (*inequality, why));
        self.inequalities.iter().map(prove).collect()
    }

    /// Whether `proofs` show every inequality: by [`Inequality::check`], which searches nothing. Further proofs do not matter.
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
/// Up to here a multiple zero at zero is divided out.
const NEAR_ZERO: f64 = 0.05;
/// From here on a border at 1 is treated by itself.
const NEAR_ONE: f64 = 0.9;

/// Denominator less numerator of the return map's slope, over the drag forces, less a rate of growth.
fn excess<T: Real>([mu, upper, lower]: [T; VARIABLES]) -> T {
    let [numerator, denominator] = return_slope(mu, [upper, lower]);
    denominator - numerator - T::from_f64(GROWTH) * (upper + lower)
}

/// The excess grows with either drag force at more than this rate.
const GROWTH: f64 = 1.99;
/// The multiplier falls short of 1 by more than this share of the drag forces.
const RATE: f64 = 0.48;

const MU_ALL: Extent = Extent::new("mu", -1.0, 1.0);
const DRAG_1: Extent = Extent::new("d_1", 0.0, 2.0);
const DRAG_2: Extent = Extent::new("d_2", 0.0, 2.0);

/// With no drag the excess is zero, hence it is positive where there is drag.
pub const EXCESS_FIRST: Inequality = Inequality {
    id: "excess-first",
    statement: "the excess of the slope's denominator over its numerator grows with the drag at the upper switching, at a rate above 1.99",
    variables: [MU_ALL, DRAG_1, DRAG_2],
    margin: Margin::Slope { of: formula!(excess), by: 1 },
};

/// The same for the second drag.
pub const EXCESS_SECOND: Inequality = Inequality {
    id: "excess-second",
    statement: "the excess of the slope's denominator over its numerator grows with the drag at the lower switching, at a rate above 1.99",
    margin: Margin::Slope { of: formula!(excess), by: 2 },
    ..EXCESS_FIRST
};

/// The growth of the excess less the rate times the slope's denominator, the drag forces as shares of the forces
/// that drive.
fn rate_left<T: Real>([mu, first, second]: [T; VARIABLES]) -> T {
    let [upward, downward] = [T::one() + mu, T::one() - mu];
    let [_, denominator] = return_slope(mu, [first * upward, second * downward]);
    T::from_f64(GROWTH) - T::from_f64(RATE) * denominator
}

/// With an excess above `1.99 (d_1 + d_2)` it bounds the multiplier: `1 - m > 0.48 (d_1 + d_2)`.
pub const DENOMINATOR: Inequality = Inequality {
    id: "denominator",
    statement: "0.48 times the slope's denominator is below 1.99",
    variables: [MU_ALL, Extent::new("s_1", 0.0, 1.0), Extent::new("s_2", 0.0, 1.0)],
    margin: Margin::Value(formula!(rate_left)),
};

/// Up to half the terminal speed.
pub const FORCE_SLOW: Inequality = Inequality {
    id: "force-slow",
    statement: "drag leaves force up to half the terminal speed",
    variables: [Extent::new("speed", 0.0, 0.5), Extent::new("linear_share", 0.0, 1.0), NONE],
    margin: Margin::Value(formula!(|[speed, linear, _]| force_left(speed, linear))),
};

/// The force is zero at terminal speed, hence positive below.
pub const FORCE_FAST: Inequality = Inequality {
    id: "force-fast",
    statement: "the force that drag leaves falls from half the terminal speed to all of it",
    variables: [Extent::new("speed", 0.5, 1.0), Extent::new("linear_share", 0.0, 1.0), NONE],
    margin: Margin::Slope { of: formula!(|[speed, linear, _]| -force_left(speed, linear)), by: 0 },
};

/// The force that brakes after a switching: the opposite command's, less the disturbance, and the drag.
pub(crate) fn brake<T: Real>([mu, drag, _]: [T; VARIABLES]) -> T {
    T::one() - mu + drag
}

/// Under a disturbance as large as the level the drag brakes alone; a smaller disturbance adds to it.
pub const BRAKING: Inequality = Inequality {
    id: "braking",
    statement: "the force that brakes after a switching falls as the disturbance grows, up to that of the relay's level",
    variables: [MU_ALL, Extent::new("drag", 0.0, 2.0), NONE],
    margin: Margin::Slope { of: formula!(|at| -brake(at)), by: 0 },
};

/// It is zero for a disturbance as large as the level at rest, hence zero or more there at every speed.
pub const BRAKING_DRAG: Inequality = Inequality {
    id: "braking-drag",
    statement: "the force that brakes after a switching grows with the drag",
    margin: Margin::Slope { of: formula!(brake), by: 1 },
    ..BRAKING
};

fn quadratic_next<T: Real>([y, gap, _]: [T; VARIABLES]) -> T {
    quadratic_half_cycle(y, gap, T::one())
}

/// At `gap = 1` the next speed is the terminal speed, hence it lies below for every finite g.
pub const QUADRATIC_NEXT: Inequality = Inequality {
    id: "quadratic-next",
    statement: "quadratic drag: the next switching speed grows with the gap 1 - exp(-4 g)",
    variables: [Extent::new("y", 0.0, 1.0), Extent::new("gap", 0.0, 1.0), NONE],
    margin: Margin::Slope { of: formula!(quadratic_next), by: 1 },
};

/// The equation of the period has a triple zero at zero.
pub const LINEAR_WIDTH_SHORT: Inequality = Inequality {
    id: "linear-width-short",
    statement: "linear drag: z - tanh z over z^3 is positive for z <= 1/2",
    variables: [Extent::new("z", 0.0, 0.5), NONE, NONE],
    margin: Margin::OverPower { of: formula!(|[z, ..]| z - z.tanh()), order: 3, near: 0.5 },
};

/// Its derivative for all longer periods.
pub const LINEAR_WIDTH_LONG: Inequality = Inequality {
    id: "linear-width-long",
    statement: "linear drag: z - tanh z grows for z >= 1/2",
    variables: [Extent::new("z", 0.5, f64::INFINITY), NONE, NONE],
    margin: Margin::Slope { of: formula!(|[z, ..]| z - z.tanh()), by: 0 },
};

/// `(1 + r) ln(1 + r) + (1 - r) ln(1 - r)`: positive where the relative overshoot falls with g, `r = y*`.
pub fn quadratic_overshoot<T: Real>([r, _, _]: [T; VARIABLES]) -> T {
    (T::one() + r) * r.ln_1p() + (T::one() - r) * (-r).ln_1p()
}

/// A double zero at zero.
pub const QUADRATIC_OVERSHOOT_WEAK: Inequality = Inequality {
    id: "quadratic-overshoot-weak",
    statement: "quadratic drag: the derivative of the relative overshoot, over y*^2 near zero, keeps its sign for y* <= 0.9",
    variables: [Extent::new("r", 0.0, NEAR_ONE), NONE, NONE],
    margin: Margin::OverPower { of: formula!(quadratic_overshoot), order: 2, near: NEAR_ZERO },
};

/// A lower bound of [`quadratic_overshoot`]: `w ln(1/w) < sqrt w` with `w = 1 - r` (`logarithm-low`, `logarithm-high`).
fn quadratic_overshoot_bound<T: Real>([r, _, _]: [T; VARIABLES]) -> T {
    (T::one() + r) * r.ln_1p() - (T::one() - r).sqrt()
}

/// Up to the strongest drag.
pub const QUADRATIC_OVERSHOOT_STRONG: Inequality = Inequality {
    id: "quadratic-overshoot-strong",
    statement: "quadratic drag: the derivative of the relative overshoot keeps its sign for y* >= 0.9",
    variables: [Extent::new("r", NEAR_ONE, 1.0), NONE, NONE],
    margin: Margin::Value(formula!(quadratic_overshoot_bound)),
};

/// `t (t - ln(1 + t)) - (1 - t)(atanh t - t)`: positive where the relative overshoot falls with g, `t = tanh z`.
pub fn linear_overshoot<T: Real>([t, _, _]: [T; VARIABLES]) -> T {
    t * (t - t.ln_1p()) - (T::one() - t) * (t.atanh() - t)
}

/// A triple zero at zero.
pub const LINEAR_OVERSHOOT_WEAK: Inequality = Inequality {
    id: "linear-overshoot-weak",
    statement: "linear drag: the derivative of the relative overshoot, over tanh^3 z near zero, keeps its sign for tanh z <= 0.9",
    variables: [Extent::new("t", 0.0, NEAR_ONE), NONE, NONE],
    margin: Margin::OverPower { of: formula!(linear_overshoot), order: 3, near: NEAR_ZERO },
};

/// A lower bound of [`linear_overshoot`], by `(1 - t) atanh t = (1 - t) ln(1 + t)/2 - (1 - t) ln(1 - t)/2` and the logarithm's
/// bound.
fn linear_overshoot_bound<T: Real>([t, _, _]: [T; VARIABLES]) -> T {
    let rest = T::one() - t;
    let inverse = (rest * t.ln_1p() + rest.sqrt()) / T::two();
    t * (t - t.ln_1p()) - (inverse - rest * t)
}

/// Up to the strongest drag.
pub const LINEAR_OVERSHOOT_STRONG: Inequality = Inequality {
    id: "linear-overshoot-strong",
    statement: "linear drag: the derivative of the relative overshoot keeps its sign for tanh z >= 0.9",
    variables: [Extent::new("t", NEAR_ONE, 1.0), NONE, NONE],
    margin: Margin::Value(formula!(linear_overshoot_bound)),
};

/// Of `w = exp(-2 v)`: positive where `w ln(1/w) < sqrt w`.
fn logarithm<T: Real>([v, _, _]: [T; VARIABLES]) -> T {
    v.exp() - T::two() * v
}

/// For `w` from `exp(-2)` to 1.
pub const LOGARITHM_LOW: Inequality = Inequality {
    id: "logarithm-low",
    statement: "exp(v) exceeds 2 v for v <= 1",
    variables: [Extent::new("v", 0.0, 1.0), NONE, NONE],
    margin: Margin::Value(formula!(logarithm)),
};

/// For all smaller `w`.
pub const LOGARITHM_HIGH: Inequality = Inequality {
    id: "logarithm-high",
    statement: "exp(v) - 2 v grows for v >= 1",
    variables: [Extent::new("v", 1.0, f64::INFINITY), NONE, NONE],
    margin: Margin::Slope { of: formula!(logarithm), by: 0 },
};

/// Quadratic drag: a single limit cycle, attracting.
pub const QUADRATIC: Theorem = Theorem {
    id: "orbit-quadratic",
    domain: "every alpha, beta, C, x_a > 0, as exp(-4 g) in (0, 1); every start",
    inequalities: &[EXCESS_FIRST, EXCESS_SECOND, DENOMINATOR, FORCE_SLOW, FORCE_FAST, QUADRATIC_NEXT],
};

/// Linear drag: a single limit cycle, attracting.
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

/// Quadratic drag with a disturbance: a single limit cycle, attracting.
pub const QUADRATIC_DISTURBED: Theorem = Theorem {
    id: "orbit-quadratic-disturbed",
    domain: "every alpha, beta, C, x_a > 0 with |delta| < C; every start",
    inequalities: &[EXCESS_FIRST, EXCESS_SECOND, DENOMINATOR, FORCE_SLOW, FORCE_FAST, BRAKING, BRAKING_DRAG],
};

/// Linear drag with a disturbance: a single limit cycle, attracting, by the same inequalities.
pub const LINEAR_DISTURBED: Theorem = Theorem { id: "orbit-linear-disturbed", ..QUADRATIC_DISTURBED };

/// No switching earlier than in the formulas.
pub const NO_EARLY_SWITCHING: Theorem = Theorem {
    id: "orbit-no-early-switching",
    domain: "every mix of linear and quadratic drag, |delta| < C, every speed below the terminal one",
    inequalities: &[FORCE_SLOW, FORCE_FAST, BRAKING, BRAKING_DRAG],
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
    inequalities: &[QUADRATIC_OVERSHOOT_WEAK, QUADRATIC_OVERSHOOT_STRONG, LOGARITHM_LOW, LOGARITHM_HIGH],
};

/// Linear drag: the relative overshoot identifies g.
pub const LINEAR_OVERSHOOT: Theorem = Theorem {
    id: "orbit-amplitude-monotone-linear",
    domain: "every g > 0, as tanh z in (0, 1)",
    inequalities: &[
        LINEAR_OVERSHOOT_WEAK,
        LINEAR_OVERSHOOT_STRONG,
        LOGARITHM_LOW,
        LOGARITHM_HIGH,
        LINEAR_WIDTH_SHORT,
        LINEAR_WIDTH_LONG,
    ],
};
