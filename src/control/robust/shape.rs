//! How the variables of a proof become parameters of a process.

use crate::control::LinearProcess;
use crate::control::process::PARAMETERS;
use crate::numeric::{Interval, Real};

#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "a copy is nothing beside the boxes of a proof")]
pub(super) enum Shape {
    /// The variables are the parameters.
    Box,
    /// They are coordinates from -1 to 1: `centre + sum z_k directions_k`.
    Along { centre: [f64; PARAMETERS], directions: [[f64; PARAMETERS]; PARAMETERS] },
}

impl Shape {
    /// The range of each variable; `process` has those of the parameters.
    pub(super) fn sides(&self, process: &LinearProcess<Interval>) -> [Interval; PARAMETERS] {
        match self {
            Self::Box => process.parts(),
            Self::Along { directions, .. } => directions.map(|direction| {
                let there = direction.iter().any(|part| *part != 0.0);
                if there { Interval::symmetric(1.0) } else { Interval::ZERO }
            }),
        }
    }

    pub(super) fn process<T: Real>(&self, variables: [T; PARAMETERS]) -> LinearProcess<T> {
        LinearProcess::from_parts(match self {
            Self::Box => variables,
            Self::Along { centre, directions } => core::array::from_fn(|part| {
                let moves = directions.iter().zip(variables).filter(|(direction, _)| direction[part] != 0.0);
                moves.fold(T::from_f64(centre[part]), |sum, (direction, z)| sum + T::from_f64(direction[part]) * z)
            }),
        })
    }

    /// Intervals of the parameters of all processes: inertia, times and delay are not negative.
    pub(super) fn hull(&self) -> LinearProcess<Interval> {
        let none = LinearProcess::from_parts([Interval::ZERO; PARAMETERS]);
        let mut parts = self.process(self.sides(&none)).parts();
        for (part, hull) in parts.iter_mut().enumerate() {
            if is_time_or_inertia(part) {
                *hull = Interval::new(hull.lower().max(0.0), hull.upper()).unwrap_or(*hull);
            }
        }
        LinearProcess::from_parts(parts)
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
            Self::Along { .. } => self.process(coordinates),
        }
    }
}

/// Inertia, the time constants but for the zero's, and the delay.
pub(super) fn is_time_or_inertia(part: usize) -> bool {
    part == 0 || (4..=6).contains(&part) || part == 8
}
