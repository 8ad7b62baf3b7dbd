//! Table 2: the parameters of the uncoupled axes (eq. 6), in the terms of the six-axis model.

use crate::numeric::{Expression, Interval, Real};
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

/// Table 2 as formulas, axis by axis.
#[must_use]
pub fn formulas() -> Vec<(Axis, Terms<Expression>)> {
    let symbol = |text, latex| Expression::symbol(text, latex, Interval::ENTIRE);
    let (mass, weight, buoyancy) = (symbol("m", "m"), symbol("W", "W"), symbol("B", "B"));
    let formula = |axis| {
        let (inertia, by_acceleration, by_speed, by_speed_magnitude, external, speed) = match axis {
            Axis::Surge => (
                mass,
                symbol("X_udot", r"X_{\dot u}"),
                symbol("X_u", "X_u"),
                symbol("X_uu", r"X_{u|u|}"),
                symbol("tau_XE", r"\tau_{XE}"),
                symbol("u", "u"),
            ),
            Axis::Sway => (
                mass,
                symbol("Y_vdot", r"Y_{\dot v}"),
                symbol("Y_v", "Y_v"),
                symbol("Y_vv", r"Y_{v|v|}"),
                symbol("tau_YE", r"\tau_{YE}"),
                symbol("v", "v"),
            ),
            Axis::Heave => (
                mass,
                symbol("Z_wdot", r"Z_{\dot w}"),
                symbol("Z_w", "Z_w"),
                symbol("Z_ww", r"Z_{w|w|}"),
                symbol("tau_ZE", r"\tau_{ZE}"),
                symbol("w", "w"),
            ),
            Axis::Yaw => (
                symbol("I_z", "I_z"),
                symbol("N_rdot", r"N_{\dot r}"),
                symbol("N_r", "N_r"),
                symbol("N_rr", r"N_{r|r|}"),
                symbol("tau_NE", r"\tau_{NE}"),
                symbol("r", "r"),
            ),
        };
        let terms = Coefficients { inertia, by_acceleration, by_speed, by_speed_magnitude, external, weight, buoyancy };
        (axis, uncoupled(axis, &terms, speed))
    };
    Axis::ALL.map(formula).into()
}
