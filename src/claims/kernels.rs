//! The kernels that the piecewise-linear catalogue is made of: closed form equals integral.

use super::claim::claim;
use super::single::Single;
use super::{Budget, Case, Printed, Verdict, proof, sample, tolerance};
use crate::describing::{ClosedForm, by_quadrature};
use crate::nonlinearity::{Branches, Kernel, Side, Sinusoid};

/// Makes a kernel from a breakpoint, a second one above it, a side and branches.
type Make = fn(f64, f64, Side, Branches) -> Kernel<f64>;

/// Closed form times `factor` against quadrature, both sides, each branch, breakpoints on the sweep and beyond.
fn closed_is_integral(budget: Budget, make: Make, factor: f64) -> Verdict {
    sample(budget, |draw| {
        let (bias, amplitude) = (draw.uniform("bias", -1.0, 1.0), draw.uniform("amplitude", 0.5, 2.0));
        let at = draw.uniform("at", -3.0, 3.0);
        let upper = at + draw.uniform("width", 0.01, 3.0);
        let side = [Side::Above, Side::Below][draw.index("side", 2)];
        let branches = [Branches::Both, Branches::Rising, Branches::Falling][draw.index("branches", 3)];
        let single = Single(make(at, upper, side, branches));
        let Ok(sweep) = Sinusoid::new(bias, amplitude) else { return Case::Skipped };
        let (Ok(closed), Ok(integral)) = (single.describing_function(&sweep), by_quadrature(&single, &sweep)) else {
            return Case::Skipped;
        };
        let scale = 10.0;
        let mut equal =
            |name, closed: f64, integral| draw.equal((name, factor * closed), integral, scale, tolerance::QUADRATURE);
        equal("f0", closed.f0, integral.f0).and(equal("p", closed.p, integral.p)).and(equal("q", closed.q, integral.q))
    })
}

const STEP: Make = |at, _, side, branches| Kernel::Step { at, height: 1.0, side, branches };
const RAMP: Make = |at, _, side, branches| Kernel::Ramp { at, slope: 1.0, side, branches };
const SIGN: Make = |at, _, _, branches| Kernel::Sign { at, level: 1.0, branches };
const BAND: Make = |lower, upper, _, _| Kernel::Band { origin: 0.3, lower, upper, slope: 1.0 };

claim! {
    KERNEL_STEP = "kernel-step" "10" Identity
    "Mean, sine and cosine component of a step are acos(u)/(2 pi), sqrt(1 - u^2)/pi and (1 - u)/pi on a branch" {
        printed: Printed::Absent,
        corrected: Some(|budget| closed_is_integral(budget, STEP, 1.0).backed_by(proof::kernel_step)),
        falsified: |budget| closed_is_integral(budget, STEP, 1.000_01),
        hypotheses: &[],
        depends: &["fourier-coefficients"],
    }
}

claim! {
    KERNEL_RAMP = "kernel-ramp" "10" Identity
    "Mean, sine and cosine component of a ramp are the closed forms in u for every breakpoint" {
        printed: Printed::Absent,
        corrected: Some(|budget| closed_is_integral(budget, RAMP, 1.0).backed_by(proof::kernel_ramp)),
        falsified: |budget| closed_is_integral(budget, RAMP, 1.000_01),
        hypotheses: &[],
        depends: &["kernel-step"],
    }
}

claim! {
    KERNEL_SIGN = "kernel-sign" "10" Identity
    "Mean, sine and cosine component of a sign are -asin(u)/pi, 2 sqrt(1 - u^2)/pi and -2 u/pi on a branch" {
        printed: Printed::Absent,
        corrected: Some(|budget| closed_is_integral(budget, SIGN, 1.0).backed_by(proof::kernel_sign)),
        falsified: |budget| closed_is_integral(budget, SIGN, 1.000_01),
        hypotheses: &[],
        depends: &["kernel-step"],
    }
}

claim! {
    KERNEL_BAND = "kernel-band" "10" Identity
    "Mean and sine component of a held input are differences of one function of each end" {
        printed: Printed::Absent,
        corrected: Some(|budget| closed_is_integral(budget, BAND, 1.0).backed_by(proof::kernel_band)),
        falsified: |budget| closed_is_integral(budget, BAND, 1.000_01),
        hypotheses: &[],
        depends: &["kernel-ramp"],
    }
}
