//! The common part of the proofs: identities of rational functions, identities of a single variable, numbers that vanish.

use super::{ClaimPart, ClaimVariable, Distortion, Evidence, Verdict, tolerance};
use crate::describing::DescribingFunction;
use crate::numeric::{Interval, Real};
use crate::proof::identity::{IdentityJet, prove_zero};
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
    Rational::from_f64(value)
}

/// Cells of an identity of a single variable.
const CELLS: usize = 5000;

/// That functions of a single variable vanish between the ends of the part's first side. They take the variable and the
/// factor of the statement, 1 where it is to be proved.
pub(super) fn identity<const M: usize>(
    part: ClaimPart,
    distortion: Distortion,
    f: impl Fn(IdentityJet, IdentityJet) -> [IdentityJet; M],
) -> Verdict {
    let Some(&ClaimVariable { from, to, .. }) = part.variables.first() else {
        return Verdict::undecided("no variable");
    };
    match prove_zero(|x| f(x, distortion.at(x, [from, to])), from, to, tolerance::PROOF, CELLS) {
        Ok(proved) => Verdict::Holds(Evidence::identity(part, proved.bound.value(), proved.boxes)),
        Err(_) => Verdict::undecided("an identity of one variable, 5000 cells"),
    }
}

/// That each number enclosed is zero to the tolerance.
pub(super) fn zeros(part: ClaimPart, numbers: &[Interval], boxes: usize) -> Verdict {
    let bound = numbers.iter().map(|number| number.magnitude()).fold(0.0, f64::max);
    if bound <= tolerance::PROOF {
        Verdict::Holds(Evidence::identity(part, bound, boxes))
    } else {
        Verdict::undecided("one enclosure")
    }
}

/// A value that proves nothing, for an argument outside a domain.
pub(super) fn unknown<T: Real>() -> T {
    T::from_f64(f64::NAN)
}

pub(super) fn no_function<T: Real>() -> DescribingFunction<T> {
    DescribingFunction { f0: unknown(), p: unknown(), q: unknown() }
}
