//! False statements for the proofs: a proof that accepts any is wrong.

use crate::numeric::Real;
use crate::numeric::special::Special;
use crate::proof::Change;

/// The factor of a formula before its proof.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Distortion {
    /// One: the statement itself.
    None,
    /// The same factor everywhere.
    Everywhere(f64),
    /// `1 + size` at a share of the domain, and 1 but for a thousandth of the domain about it.
    Near {
        /// Share of the domain, from 0 at its lower end to 1 at its upper end.
        share: f64,
        /// Relative size.
        size: f64,
    },
}

impl Distortion {
    /// The distortions that no proof may survive.
    pub const FALSE: [Self; 4] = [
        Self::Everywhere(1.000_01),
        Self::Everywhere(0.999_99),
        Self::Near { share: 0.381_966, size: 1e-6 },
        Self::Near { share: 0.763_932, size: -1e-6 },
    ];

    /// The factor where the statement has no variable.
    pub(crate) fn factor(self) -> f64 {
        match self {
            Self::None => 1.0,
            Self::Everywhere(factor) => factor,
            Self::Near { size, .. } => 1.0 + size,
        }
    }

    /// The factor at a place between two ends: near a share of the domain a bell, whose width is a thousandth of the domain.
    pub(crate) fn at<T: Real>(self, place: T, [from, to]: [f64; 2]) -> T {
        match self {
            Self::Near { share, size } => {
                let (centre, width) = (from + share * (to - from), (to - from) / 4000.0);
                let away = (place - T::from_f64(centre)) / T::from_f64(width);
                T::one() + T::from_f64(size) * (-away.square()).exp()
            }
            everywhere => T::from_f64(everywhere.factor()),
        }
    }
}

/// Of functions of ratios between -1 and 1: near a share of the first one's range.
impl Change for Distortion {
    fn apply<T: Special, const N: usize, const M: usize>(&self, variables: [T; N], values: [T; M]) -> [T; M] {
        let factor = variables.first().map_or_else(T::one, |&first| self.at(first, [-1.0, 1.0]));
        values.map(|value| value * factor)
    }
}
