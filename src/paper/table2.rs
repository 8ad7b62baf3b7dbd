//! Table 2: the parameters of the uncoupled axes (eq. 6), in the terms of the six-axis model.

use crate::numeric::{Interval, Real};
use crate::proof::Expression;
use crate::vehicle::Axis;

/// The terms of the six-axis model that act on a single axis. Derivatives are those of the hydrodynamic force, so that drag and
/// added mass make them negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients<T> {
    /// Mass, or moment of inertia for yaw: kg or kg m^2.
    pub inertia: T,
    /// Derivative by acceleration, `X_udot`: kg or kg m^2.
    pub by_acceleration: T,
    /// Derivative by speed, `X_u`: N/(m/s) or N m/(rad/s).
    pub by_speed: T,
    /// Derivative by speed times its magnitude, `X_uu`: N/(m/s)^2 or N m/(rad/s)^2.
    pub by_speed_magnitude: T,
    /// External force `tau_XE`: N or N m.
    pub external: T,
    /// Weight W, N: acts on heave.
    pub weight: T,
    /// Buoyancy B, N: acts on heave.
    pub buoyancy: T,
}

/// A column of Table 2: the axis `alpha nu' + beta(nu) nu = delta + tau` at speed `nu`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Terms<T> {
    /// Inertia with added mass.
    pub alpha: T,
    /// `-beta(nu)`: the column of drag in Table 2.
    pub minus_beta: T,
    /// Constant force.
    pub delta: T,
}

/// Table 2 for an axis at `speed`, in any arithmetic.
pub fn uncoupled<T: Real>(axis: Axis, coefficients: &Coefficients<T>, speed: T) -> Terms<T> {
    let c = coefficients;
    Terms {
        alpha: c.inertia - c.by_acceleration,
        minus_beta: c.by_speed + c.by_speed_magnitude * speed.abs(),
        delta: match axis {
            Axis::Heave => c.external + c.weight - c.buoyancy,
            Axis::Surge | Axis::Sway | Axis::Yaw => c.external,
        },
    }
}

/// Inertia, its share of the water, both drags, disturbance and speed of each axis, as text and as LaTeX.
#[rustfmt::skip]
const SYMBOLS: [(Axis, [(&str, &str); 6]); 4] = [
    (Axis::Surge, [("m", "m"), ("X_udot", r"X_{\dot u}"), ("X_u", "X_u"),
        ("X_uu", r"X_{u|u|}"), ("tau_XE", r"\tau_{XE}"), ("u", "u")]),
    (Axis::Sway, [("m", "m"), ("Y_vdot", r"Y_{\dot v}"), ("Y_v", "Y_v"),
        ("Y_vv", r"Y_{v|v|}"), ("tau_YE", r"\tau_{YE}"), ("v", "v")]),
    (Axis::Heave, [("m", "m"), ("Z_wdot", r"Z_{\dot w}"), ("Z_w", "Z_w"),
        ("Z_ww", r"Z_{w|w|}"), ("tau_ZE", r"\tau_{ZE}"), ("w", "w")]),
    (Axis::Yaw, [("I_z", "I_z"),
        ("N_rdot", r"N_{\dot r}"), ("N_r", "N_r"), ("N_rr", r"N_{r|r|}"), ("tau_NE", r"\tau_{NE}"), ("r", "r")]),
];

/// Table 2 as formulas, axis by axis.
#[must_use]
pub fn formulas() -> Vec<(Axis, Terms<Expression>)> {
    let symbol = |(text, latex)| Expression::symbol(text, latex, Interval::ENTIRE);
    let [weight, buoyancy] = ["W", "B"].map(|name| symbol((name, name)));
    let formula = |(axis, symbols): (Axis, [(&'static str, &'static str); 6])| {
        let [inertia, by_acceleration, by_speed, by_speed_magnitude, external, speed] = symbols.map(symbol);
        let terms = Coefficients { inertia, by_acceleration, by_speed, by_speed_magnitude, external, weight, buoyancy };
        (axis, uncoupled(axis, &terms, speed))
    };
    SYMBOLS.map(formula).into()
}
