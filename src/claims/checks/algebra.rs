//! The common part of the exact proofs: identities of rational functions, case by case.

use super::{ClaimPart, Distortion, Evidence, Verdict};
use crate::proof::polynomial::{Rational, prove_identity};

/// That functions of the code vanish identically in the cases in which the points lie. They take the variables and the
/// factor of the statement, 1 where it is to be proved.
pub(super) fn exactly<const N: usize, const M: usize>(
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

#[cfg(test)]
mod tests {
    use crate::claims::{Budget, CLAIMS, Word};

    /// Claims whose proofs take many subdivisions: `tests/properties` tries theirs.
    const LONG: &str = "kernel-step kernel-ramp kernel-sign kernel-band describing-function power-law sine sinh arctan tanh delay-rotation";

    /// The other proofs: each holds, covers the claimed domain, and no false variant of it holds.
    #[test]
    fn exact_proofs_hold_and_false_ones_do_not() {
        let short = CLAIMS.iter().filter(|claim| claim.proof.is_some() && LONG.split(' ').all(|id| id != claim.id));
        let failures = short.filter_map(|claim| {
            let word = claim.check(Budget { cases: 20, seed: 1 }).word();
            let accepted: Vec<_> = claim.prove_falsehoods().filter(|(_, verdict)| verdict.holds()).collect();
            (word != Word::Proved || !accepted.is_empty())
                .then(|| format!("{}: {word}, accepts {accepted:?}", claim.id))
        });
        assert_eq!(failures.collect::<Vec<_>>(), Vec::<String>::new());
    }
}
