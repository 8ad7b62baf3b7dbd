//! How the variables of a proof become parameters of a process.

use crate::control::LinearProcess;
use crate::control::process::PARAMETERS;
use crate::numeric::{Interval, Real};

/// Axes of an ellipsoid, some of which may be zero.
pub(super) const AXES: usize = 5;

#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "a copy is nothing beside the boxes of a proof")]
pub(super) enum Shape {
    /// The variables are the parameters.
    Box,
    /// They are coordinates with `sum z_k^2 <= 1`: `centre + sum z_k axes_k`.
    Ellipsoid { centre: [f64; PARAMETERS], axes: [[f64; PARAMETERS]; AXES] },
}

impl Shape {
    /// The range of each variable; `process` has those of the parameters.
    pub(super) fn sides(&self, process: &LinearProcess<Interval>) -> [Interval; PARAMETERS] {
        match self {
            Self::Box => process.parts(),
            Self::Ellipsoid { axes, .. } => core::array::from_fn(|k| {
                let there = axes.get(k).is_some_and(|axis| axis.iter().any(|part| *part != 0.0));
                if there { Interval::symmetric(1.0) } else { Interval::ZERO }
            }),
        }
    }

    pub(super) fn process<T: Real>(&self, variables: [T; PARAMETERS]) -> LinearProcess<T> {
        LinearProcess::from_parts(match self {
            Self::Box => variables,
            Self::Ellipsoid { centre, axes } => core::array::from_fn(|part| {
                let moves = axes.iter().zip(variables).filter(|(axis, _)| axis[part] != 0.0);
                moves.fold(T::from_f64(centre[part]), |sum, (axis, z)| sum + T::from_f64(axis[part]) * z)
            }),
        })
    }

    /// Whether a box of variables has no process of the set.
    pub(super) fn misses(&self, variables: &[Interval]) -> bool {
        let least = |side: &Interval| if side.contains(0.0) { Interval::ZERO } else { side.abs() };
        let square = variables.iter().map(least).fold(Interval::ZERO, |sum, side| sum + side.square());
        matches!(self, Self::Ellipsoid { .. }) && square.lower() > 1.0
    }

    /// The numbers at coordinates from -1 to 1.
    pub(super) fn at(&self, process: &LinearProcess<Interval>, coordinates: [f64; PARAMETERS]) -> LinearProcess<f64> {
        match self {
            Self::Box => LinearProcess::from_parts(core::array::from_fn(|k| {
                let (side, z) = (process.parts()[k], coordinates[k]);
                match z {
                    -1.0 => side.lower(),
                    1.0 => side.upper(),
                    _ => (side.midpoint() + 0.5 * z * side.width()).clamp(side.lower(), side.upper()),
                }
            })),
            Self::Ellipsoid { .. } => self.process(coordinates),
        }
    }
}

/// Intervals of the parameters of all processes of an ellipsoid: inertia, times and delay are not negative.
pub(super) fn hull(centre: [f64; PARAMETERS], axes: [[f64; PARAMETERS]; AXES]) -> LinearProcess<Interval> {
    LinearProcess::from_parts(core::array::from_fn(|part| {
        // |sum z_k a_k| <= |z| |a|, by Cauchy and Schwarz.
        let reach = length(&axes.map(|axis| Interval::point(axis[part])));
        let hull = Interval::point(centre[part]) + Interval::symmetric(reach);
        let least = if is_time_or_inertia(part) { hull.lower().max(0.0) } else { hull.lower() };
        Interval::new(least, hull.upper()).unwrap_or(hull)
    }))
}

/// An upper bound of a vector's length.
pub(super) fn length(parts: &[Interval]) -> f64 {
    let square = parts.iter().map(|part| Interval::point(part.magnitude()).square());
    square.fold(Interval::ZERO, |sum, part| sum + part).sqrt().upper()
}

/// Inertia, the time constants but for the zero's, and the delay.
pub(super) fn is_time_or_inertia(part: usize) -> bool {
    part == 0 || (4..=6).contains(&part) || part == 8
}
