//! What the exact proofs have in common: identities of rational functions, case by case.

use super::{ClaimPart, Distortion, Evidence, Verdict};
use crate::proof::polynomial::{Rational, prove_identity};

/// That functions of the code vanish identically in the cases in which the points lie. They take the variables and what the
/// statement is multiplied by, one where it is to be proved.
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
    use crate::claims::{Budget, Claim, Word};

    /// Proofs that take no subdivision, or one of a second: each holds, covers what is claimed, and no false variant of it holds.
    #[test]
    fn exact_proofs_hold_and_false_ones_do_not() {
        const IDS: [&str; 34] = [
            "fourier-coefficients",
            "odd-harmonics",
            "odd-harmonics-hysteretic",
            "lemma-1",
            "lemma-2",
            "theorem-2",
            "theorem-3",
            "switching-condition",
            "drag-decision",
            "delta-from-times",
            "thruster-bilinear",
            "thruster-affine",
            "thruster-asymmetric",
            "allocation",
            "compensation",
            "pole-placement",
            "relay-ultimate",
            "relay-p",
            "relay-q",
            "relay-f0",
            "relay-noise",
            "sampled-level",
            "second-quadrant",
            "polynomial",
            "method-bias",
            "six-axes",
            "uncoupled-axis",
            "quantisation-zero",
            "table-3",
            "relative-spread",
            "zig-zag",
            "quantisation-alpha",
            "quantisation-beta",
            "quantisation-beta-xx",
        ];
        let failures = IDS.iter().filter_map(|id| {
            let claim = Claim::find(id)?;
            let word = claim.check(Budget { cases: 20, seed: 1 }).word();
            let accepted: Vec<_> = claim.prove_falsehoods().filter(|(_, verdict)| verdict.holds()).collect();
            (word != Word::Proved || !accepted.is_empty()).then(|| format!("{id}: {word}, accepts {accepted:?}"))
        });
        assert_eq!(failures.collect::<Vec<_>>(), Vec::<String>::new());
    }
}
