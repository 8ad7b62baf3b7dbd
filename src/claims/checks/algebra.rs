//! The common part of the exact proofs: identities of rational functions, case by case.

use super::{ClaimPart, Distortion, Evidence, Verdict};
use crate::proof::polynomial::{Rational, prove_identity};

/// That functions of the code vanish identically in the cases in which the points lie. They take the variables and the
/// factor of the statement, 1 where it is to be proved.
pub(in crate::claims) fn exactly<const N: usize, const M: usize>(
    part: ClaimPart,
    distortion: Distortion,
    points: &[[f64; N]],
    functions: impl Fn([Rational; N], Rational) -> Option<[Rational; M]>,
) -> Verdict {
    let changed = |at: [Rational; N]| {
        let factor =
            at.first().map_or_else(|| distortion.at(number(0.0), [-1.0, 1.0]), |&x| distortion.at(x, [0.0, 1.0]));
        functions(at, factor)
    };
    match prove_identity(points.iter().copied(), changed) {
        Ok(cases) => Verdict::Holds(Evidence::identity(part, 0.0, cases.decisions.len())),
        Err(_) => Verdict::undecided("an identity of rational functions"),
    }
}

pub(super) fn number(value: f64) -> Rational {
    crate::numeric::Real::from_f64(value)
}

/// An equation: its name, its sides, and the scale of their rounding.
pub(super) type Equation<T> = (&'static str, T, T, T);

/// That the sides of equations are equal, in the same sense.
pub(in crate::claims) fn equal<const N: usize, const M: usize>(
    part: ClaimPart,
    distortion: Distortion,
    points: &[[f64; N]],
    equations: impl Fn([Rational; N], Rational) -> Option<[Equation<Rational>; M]>,
) -> Verdict {
    let differences = |at, factor| Some(equations(at, factor)?.map(|(_, left, right, _)| left - right));
    exactly(part, distortion, points, differences)
}
