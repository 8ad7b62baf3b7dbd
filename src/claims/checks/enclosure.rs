//! The common part of the proofs: identities of a single variable, numbers that vanish.

use super::{ClaimPart, ClaimVariable, Distortion, Evidence, Verdict, tolerance};
use crate::describing::DescribingFunction;
use crate::numeric::{Interval, Real};
use crate::proof::identity::{IdentityJet, prove_zero};

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
