//! Proof that the closed forms of the kernels are the integrals that they stand for, for every ratio u in `[-1, 1]` at once.
//!
//! With `u = cos(phi)` the rising branch is beyond the breakpoint for the angles from `pi/2 - phi` to `pi/2`. So the
//! integral `I(phi)` of a kernel, weighted with 1, sine or cosine, has a derivative that needs no antiderivative of the
//! kernel: the weighted value of the kernel at the moving end, and for a ramp `sin(phi)` times the weights' own integral.
//! At `phi = 0` it is known. The closed form `F(phi)`, the function that computes, is differentiated in Taylor jets, and
//! `abs(F - I)` is bounded by its value at the start plus the integral of `abs(F' - I')`. Near `phi = 0` and `phi = pi`, where `F`
//! has square roots of nearly nothing, the values are compared on small cells instead, `I` by the mean value theorem.

use super::DescribingFunction;
use super::kernel::{Arc, constant};
use crate::nonlinearity::Branches;
use crate::numeric::special::Special;
use crate::numeric::{Interval, Real};
use crate::proof::branch_and_bound::{Subdivision, Visit, subdivide};
use crate::proof::identity::{IdentityJet, magnitude};
use crate::proof::{Bound, Change, NotProved, Proved, Unchanged};

/// Length of either end on which values are compared, in radians: beyond, `cos(phi)` and 1 are distinguishable.
const END: f64 = 3e-8;
/// Error allowed on a cell of an end.
const AT_END: f64 = 8e-12;
/// Error allowed of a derivative: over the whole arc it adds up to three times this.
const SLOPE: f64 = 1e-13;
/// A cell shorter than this, on which no derivative is known, holds a decision of the code between two of its formulas.
const TRAP: f64 = 1e-14;
/// The largest bound that is called a proof.
const LARGEST: f64 = 1e-11;
/// Cells of one kernel; a true closed form takes up to fifteen thousand, nearly all at the ends.
const BUDGET: usize = 60_000;

/// The functions that the closed forms of the piecewise-linear catalogue are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KernelForm {
    /// One beyond the breakpoint, else zero.
    Step,
    /// The distance beyond the breakpoint, else zero.
    Ramp,
    /// `+1` beyond the breakpoint, else `-1`.
    Sign,
    /// The contribution of each end of a band, with the code's own inverse sine: the code rearranges the sum over both ends so
    /// that nothing cancels.
    Band,
}

impl KernelForm {
    /// Bounds closed form less integral, for mean, sine and cosine component and every breakpoint on the sweep: unit height or
    /// slope, unit amplitude. The domain is that of the angle `acos(u)`, in radians.
    ///
    /// Proves the formulas as real functions. Their rounding in floating point is not in the bound.
    ///
    /// ```
    /// use selfosc::describing::KernelForm;
    /// assert!(KernelForm::Ramp.prove()?.bound.value() < 1e-11);
    /// # Ok::<(), selfosc::proof::NotProved<1>>(())
    /// ```
    ///
    /// # Errors
    /// [`NotProved`], if no bound below 1e-11 is found.
    pub fn prove(self) -> Result<Proved<1>, NotProved<1>> {
        self.prove_changed(&Unchanged)
    }

    /// [`prove`](Self::prove) of a changed closed form, as a function of the ratio u: for tests, which hand it a false one.
    ///
    /// # Errors
    /// [`NotProved`].
    #[doc(hidden)]
    pub fn prove_changed(self, change: &impl Change) -> Result<Proved<1>, NotProved<1>> {
        Claimed { form: self, change }.prove()
    }

    /// The closed form by the code that computes.
    fn value<T: Real>(self, arc: Arc<T>) -> [T; 3] {
        let half = T::from_f64(0.5);
        let DescribingFunction { f0, p, q } = match self {
            Self::Step => arc.step(),
            Self::Ramp => arc.ramp(Branches::Rising),
            Self::Sign => arc.sign(),
            // As a ramp on both branches would be; the straight parts cancel between the two ends of a band.
            Self::Band => DescribingFunction {
                f0: (arc.sine + arc.u * arc.asin()) / T::pi() - half * arc.u,
                p: half - (arc.asin() + arc.u * arc.sine) / T::pi(),
                q: T::zero(),
            },
        };
        [f0, p, q]
    }

    /// Derivative of the integral by phi: Leibniz's rule, the weighted kernel at the moving end and the integral of its change.
    #[doc(hidden)]
    pub fn slope<T: Real>(self, phi: T) -> [T; 3] {
        let (sine, cosine, pi) = (phi.sin(), phi.cos(), T::pi());
        let step = [T::one() / (pi + pi), cosine / pi, sine / pi];
        // Of the weights from `pi/2 - phi` to `pi/2`.
        let ramp = [phi / (pi + pi), sine / pi, (T::one() - cosine) / pi].map(|weight| sine * weight);
        match self {
            Self::Step => step,
            Self::Ramp => ramp,
            Self::Sign => step.map(|part| part + part),
            Self::Band => [ramp[0] + ramp[0], ramp[1] + ramp[1], T::zero()],
        }
    }

    /// The integral where the breakpoint is at the maximum: nothing of the branch is beyond it.
    fn start(self) -> [Interval; 3] {
        let none = match self {
            Self::Sign => constant(Interval::ONE) * -Interval::ONE,
            Self::Step | Self::Ramp | Self::Band => DescribingFunction::zero(),
        };
        [none.f0, none.p, none.q]
    }
}

/// A closed form and its change, of which the proof is made.
struct Claimed<'a, C> {
    form: KernelForm,
    change: &'a C,
}

impl<C: Change> Claimed<'_, C> {
    /// By the arc of half-width phi; its distances from the turning points without cancellation.
    fn value<T: Special>(&self, phi: T) -> [T; 3] {
        let half = phi / T::two();
        let (near, far) = (T::two() * half.sin().square(), T::two() * half.cos().square());
        self.change.apply([phi.cos()], self.form.value(Arc::new(phi.cos(), near, far, T::one())))
    }

    fn prove(&self) -> Result<Proved<1>, NotProved<1>> {
        let begin = Interval::point(END);
        let end = Interval::point(core::f64::consts::PI - END);
        let (near_bound, near) = self.end(self.form.start(), Interval::ZERO, Interval::ZERO.hull(begin))?;
        // At the seam itself, where nothing is as wide as a cell.
        let seam = self.error(self.form.start(), Interval::ZERO, begin);
        let (between_bound, between) = self.between(begin.hull(end))?;
        let (far_bound, far) = self.end(self.value(end), end, end.hull(Interval::PI))?;
        // The breakpoint at the minimum: the kernel is then the constant one.
        let whole = match self.form {
            KernelForm::Step => {
                let DescribingFunction { f0, p, q } = constant(Interval::ONE);
                largest(difference(self.value(Interval::PI), [f0, p, q]))
            }
            _ => 0.0,
        };
        let up = |sum: f64| sum.next_up();
        let bound = near_bound.max(up(up(up(seam + between_bound) + far_bound) + whole));
        let boxes = near.boxes + between.boxes + far.boxes;
        let domain = [Interval::ZERO.hull(Interval::PI)];
        if !(bound <= LARGEST) {
            return Err(NotProved::Undecided { at: domain, boxes });
        }
        let parts = [near.parts, between.parts, far.parts].concat();
        Ok(Proved { bound: Bound::Residual(bound), domain, parts, boxes })
    }

    /// Closed form less integral on a cell, from the integral's value at an anchor.
    fn error(&self, anchor: [Interval; 3], at: Interval, cell: Interval) -> f64 {
        let grown = self.form.slope(at.hull(cell)).map(|slope| slope * (cell - at));
        largest(difference(difference(self.value(cell), anchor), grown))
    }

    fn end(
        &self,
        anchor: [Interval; 3],
        at: Interval,
        domain: Interval,
    ) -> Result<(f64, Subdivision<1>), NotProved<1>> {
        let mut bound = 0.0_f64;
        let found = subdivide([domain], BUDGET, |&[cell]| {
            let error = self.error(anchor, at, cell);
            if error <= AT_END {
                bound = bound.max(error);
            }
            Visit::settled(error <= AT_END)
        });
        Ok((bound, found.complete()?))
    }

    /// The integral of the derivatives' difference.
    fn between(&self, domain: Interval) -> Result<(f64, Subdivision<1>), NotProved<1>> {
        let mismatch =
            |phi: IdentityJet| difference(self.value(phi).map(|part| part.derivative()), self.form.slope(phi));
        let mut sum = Interval::ZERO;
        let found = subdivide([domain], BUDGET, |&[cell]| {
            let length = Interval::point(cell.upper()) - Interval::point(cell.lower());
            let Some(slope) = magnitude(&mismatch, cell) else { return Visit::Stop };
            let settled = slope <= SLOPE;
            if settled {
                sum += Interval::point(slope) * length;
            } else if cell.width() < TRAP {
                // Neither side can change by more on so short a cell.
                let closed = self.value(cell).map(|part| part.width()).into_iter().fold(0.0, f64::max);
                sum = sum + Interval::point(closed) + length * Interval::point(largest(self.form.slope(cell)));
            }
            Visit::settled(settled || cell.width() < TRAP)
        });
        Ok((sum.upper(), found.complete()?))
    }
}

fn difference<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    core::array::from_fn(|i| a[i] - b[i])
}

fn largest(parts: [Interval; 3]) -> f64 {
    parts.into_iter().map(Interval::magnitude).fold(0.0, f64::max)
}
