//! The basis of the lemmas on the mean output: the mean of a step falls with its breakpoint, strictly on the sweep.
//!
//! With `s` the unit sinusoid, `B` the bias, `X` the amplitude and the falling branch the rising one's half-turn image,
//! `F_0 = E[F_up(B + X s) - F_up(-B + X s)]/2`. A nondecreasing `F_up` is a constant and a mixture of steps; a step at
//! `a` contributes `h((a - B)/X) - h((a + B)/X)`, with `h` the mean of a step by the place of its breakpoint. A falling
//! `h` gives the mean the sign of the bias, for the whole class at once.
//!
//! `h` is the integral itself, not its closed form: with the breakpoint at `u = cos(phi)`, `dh/du = -(dh/dphi)/sin(phi)` needs
//! no antiderivative: the sign is strict however small the bias is.

use super::kernels::{BREAKPOINT, prove_kernel};
use super::{ClaimDomain, ClaimPart, Distortion, Evidence, Verdict};
use crate::describing::KernelForm;
use crate::numeric::{Interval, Real};
use crate::proof::branch_and_bound::prove_positive;

/// A breakpoint that rises by a share of the amplitude takes more than this times that share from the mean of a unit
/// step on a branch; the least there is is `1/(2 pi)`.
pub const RATE: f64 = 1.0 / 7.0;

/// That the integral falls at more than `rate` everywhere on the sweep, `dh/dphi > rate sin(phi)`: margin and boxes.
pub fn falls(rate: f64) -> Option<(f64, usize)> {
    let excess = |&[phi]: &[Interval; 1]| KernelForm::Step.slope(phi)[0] - Interval::point(rate) * phi.sin();
    let found = prove_positive(excess, [Interval::ZERO.hull(Interval::PI)], 20_000).ok()?;
    Some((found.bound.value(), found.boxes))
}

/// The parts that follow from a step's mean: that the code computes the integral, and that the integral falls.
pub(super) fn by_steps(distortion: Distortion, parts: &'static [ClaimPart]) -> Verdict {
    prove_kernel(KernelForm::Step, distortion, BREAKPOINT).and(|| match falls(RATE) {
        Some((margin, boxes)) => Verdict::Holds(Evidence::inequality(ClaimDomain::new(parts), margin, boxes)),
        None => Verdict::undecided("20000 boxes for the mean of a step"),
    })
}
