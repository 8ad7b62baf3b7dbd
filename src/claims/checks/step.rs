//! What the lemmas on the mean output rest on: the mean of a step falls with its breakpoint, strictly so on the sweep.
//!
//! With `s` the unit sinusoid, `B` the bias, `X` the amplitude and the falling branch the rising one's half-turn image,
//! `F_0 = E[F_up(B + X s) - F_up(-B + X s)]/2`. A nondecreasing `F_up` is a constant and a mixture of steps; a step at `a`
//! contributes `h((a - B)/X) - h((a + B)/X)`, with `h` the mean of a step by the place of its breakpoint. So a falling `h` gives
//! the mean the sign of the bias, for the whole class at once.

use super::kernels::{BREAKPOINT, prove_kernel};
use super::single::Single;
use super::{ClaimDomain, ClaimPart, Distortion, Evidence, Verdict};
use crate::describing::{ClosedForm, KernelForm};
use crate::nonlinearity::{Branches, Kernel, Side, Sinusoid};
use crate::numeric::{Interval, Real};
use crate::proof::Gradient;
use crate::proof::branch_and_bound::prove_positive;

/// A breakpoint that rises by a share of the amplitude takes more than this times that share from the mean of a unit step on one
/// branch; the least there is is `1/(2 pi)`.
const RATE: f64 = 1.0 / 7.0;

/// Mean of the two halves of a symmetric pair, in closed form on a unit sweep: the step up on the rising branch, and its
/// half-turn image on the falling one.
fn halves<T: Real>(at: T) -> Option<[T; 2]> {
    let (one, zero) = (T::one(), T::zero());
    let sweep = Sinusoid::new(zero, one).ok()?;
    let mean = |kernel| Single(kernel).describing_function(&sweep).ok().map(|df| df.f0);
    Some([
        mean(Kernel::Step { at, height: one, side: Side::Above, branches: Branches::Rising })?,
        mean(Kernel::Step { at: -at, height: -one, side: Side::Below, branches: Branches::Falling })?,
    ])
}

/// How fast the mean of each half changes with the breakpoint.
fn slopes(at: Interval) -> Option<[Interval; 2]> {
    let [at] = Gradient::variables([at]);
    halves(at).map(|halves| halves.map(|half| half.slopes()[0]))
}

/// How much faster than `rate` the mean falls over places of the breakpoint on the sweep: the lesser of both halves.
fn excess(at: Interval, rate: f64) -> Interval {
    let rate = Interval::point(rate);
    slopes(at).map_or(Interval::ENTIRE, |[rising, falling]| (-rising - rate).min(falling - rate))
}

/// Where the code keeps to one form: the middle half of the sweep, and up to a millionth of the turning points.
const FORMS: [[f64; 2]; 3] = [[-LAST, (-0.5_f64).next_down()], [-0.5, 0.5], [0.5_f64.next_up(), LAST]];
const LAST: f64 = 1.0 - 1e-6;

/// That the mean falls at more than `rate` over each form: the least margin, and the boxes of all.
fn falls(rate: f64) -> Option<(f64, usize)> {
    FORMS.iter().try_fold((f64::INFINITY, 0), |(margin, boxes), &[from, to]| {
        let found = prove_positive(|[at]| excess(*at, rate), [Interval::new(from, to)?], 20_000).ok()?;
        Some((margin.min(found.bound.value()), boxes + found.boxes))
    })
}

/// That a breakpoint beyond a turning point contributes a constant.
fn rests() -> bool {
    let beyond = [[1.0_f64.next_up(), f64::MAX], [-f64::MAX, (-1.0_f64).next_down()]];
    beyond.iter().all(|&[from, to]| {
        let slopes = Interval::new(from, to).and_then(slopes);
        slopes.is_some_and(|slopes| slopes.iter().all(|slope| slope.magnitude() == 0.0))
    })
}

/// The parts that follow from a step's mean: that it is what the code computes, and that it falls.
pub(super) fn by_steps(distortion: Distortion, parts: &'static [ClaimPart]) -> Verdict {
    prove_kernel(KernelForm::Step, distortion, BREAKPOINT).and(|| match falls(RATE).filter(|_| rests()) {
        Some((margin, boxes)) => Verdict::Holds(Evidence::inequality(ClaimDomain::new(parts), margin, boxes)),
        None => Verdict::undecided("20000 boxes for the mean of a step"),
    })
}

#[cfg(test)]
mod tests {
    use super::{RATE, falls, halves, rests};
    use crate::numeric::{Interval, Real};

    #[test]
    fn the_rate_is_below_the_least_and_no_other_is_proved() {
        let least = 0.5 / core::f64::consts::PI;
        assert!(falls(RATE).is_some_and(|(margin, _)| margin > 0.0 && margin <= least - RATE));
        assert!(falls(least - 1e-4).is_some());
        assert!(falls(least + 1e-9).is_none());
        assert!(falls(1.0 / 6.0).is_none());
        assert!(rests());
    }

    /// The mirror image of each half is the other: without bias nothing is left, at whatever breakpoint.
    #[test]
    fn halves_cancel_without_bias() {
        for at in [-3.0, -1.0, -0.4, 0.0, 0.9, 1.0, 7.0] {
            let [rising, falling] = halves(Interval::point(at)).unwrap();
            assert!((rising + falling).magnitude() < 1e-15, "{at}");
            // By the arc that the input is beyond the breakpoint on.
            assert!(
                (rising - Interval::point(at).clamp_unit().acos() / (Interval::two() * Interval::pi())).magnitude()
                    < 1e-15
            );
        }
    }
}
