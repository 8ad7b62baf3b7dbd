//! The kernels that the piecewise-linear catalogue is made of: closed form equals integral.

use super::algebra::no_function;
use super::band::as_coded;
use super::family::closed_is_integral;
use super::{Case, ClaimPart, ClaimVariable, Distortion, Draw, Evidence, Verdict, claim};
use crate::describing::{ClosedForm, DescribingFunction, KernelForm};
use crate::nonlinearity::{Branches, Kernel, Side, Sinusoid};
use crate::numeric::Real;
use crate::proof::{NotProved, Proved};
use std::sync::LazyLock;

/// Makes a kernel with a single breakpoint from that, its height, slope or level, its side and its branches.
pub(in crate::claims) type KernelMaker<T> = fn(T, T, Side, Branches) -> Kernel<T>;

pub(in crate::claims) fn step<T>(at: T, height: T, side: Side, branches: Branches) -> Kernel<T> {
    Kernel::Step { at, height, side, branches }
}

pub(in crate::claims) fn ramp<T>(at: T, slope: T, side: Side, branches: Branches) -> Kernel<T> {
    Kernel::Ramp { at, slope, side, branches }
}

pub(in crate::claims) fn sign<T>(at: T, level: T, _: Side, branches: Branches) -> Kernel<T> {
    Kernel::Sign { at, level, branches }
}

pub(in crate::claims) const SIDES: [Side; 2] = [Side::Above, Side::Below];
pub(in crate::claims) const BRANCHES: [Branches; 3] = [Branches::Both, Branches::Rising, Branches::Falling];

/// Closed form times `factor` against quadrature, both sides, each branch, breakpoints on the sweep and beyond.
fn kernel_is_integral(draw: &mut Draw, form: KernelForm, factor: f64) -> Option<Case> {
    let (bias, amplitude) = (draw.uniform("bias", -1.0, 1.0), draw.uniform("amplitude", 0.5, 2.0));
    let at = draw.uniform("at", -3.0, 3.0);
    let upper = at + draw.uniform("width", 0.01, 3.0);
    let (side, branches) = (SIDES[draw.index("side", 2)], BRANCHES[draw.index("branches", 3)]);
    let kernel = match form {
        KernelForm::Step => step(at, 1.0, side, branches),
        KernelForm::Ramp => ramp(at, 1.0, side, branches),
        KernelForm::Sign => sign(at, 1.0, side, branches),
        KernelForm::Band => Kernel::Band { origin: 0.3, lower: at, upper, slope: 1.0 },
    };
    closed_is_integral(draw, &kernel, &Sinusoid::new(bias, amplitude).ok()?, 10.0, factor)
}

/// Every ratio on the sweep.
pub(super) const BREAKPOINT: ClaimPart = ClaimPart::over(
    "closed-form",
    "every breakpoint on the sweep, mean, sine and cosine component, both sides and branches",
    const { &[ClaimVariable::number("u", -1.0, 1.0)] },
);

/// One line a claim: constant, id, statement, kernel, and a further proof.
macro_rules! kernels {
    ($($constant:ident = $id:literal $statement:literal, $form:ident $(and $further:ident)?;)+) => {
        $(
            claim! {
                $constant = $id Identity $statement;
                corrected kernel_is_integral(KernelForm::$form, 1.0);
                false kernel_is_integral(KernelForm::$form, 1.000_01);
                proof |distortion| {
                    prove_kernel(KernelForm::$form, distortion, BREAKPOINT)$(.and(|| $further(distortion)))?
                };
            }
        )+
    };
}

kernels! {
    KERNEL_STEP = "kernel-step"
        "Mean, sine and cosine component of a step are acos(u)/(2 pi), sqrt(1 - u^2)/pi and (1 - u)/pi on a branch", Step;
    KERNEL_RAMP = "kernel-ramp"
        "Mean, sine and cosine component of a ramp are the closed forms in u for every breakpoint", Ramp;
    KERNEL_SIGN = "kernel-sign"
        "Mean, sine and cosine component of a sign are -asin(u)/pi, 2 sqrt(1 - u^2)/pi and -2 u/pi on a branch", Sign;
    // Each end of a band; and the code's rearranged sum over both ends.
    KERNEL_BAND = "kernel-band"
        "Mean and sine component of a held input are differences of one function of each end", Band and as_coded;
}

pub(super) fn prove_kernel(form: KernelForm, distortion: Distortion, part: ClaimPart) -> Verdict {
    static PROVED: [LazyLock<Result<Proved<1>, NotProved<1>>>; 4] = [
        LazyLock::new(|| KernelForm::Step.prove()),
        LazyLock::new(|| KernelForm::Ramp.prove()),
        LazyLock::new(|| KernelForm::Sign.prove()),
        LazyLock::new(|| KernelForm::Band.prove()),
    ];
    let verdict = |proved: &Result<Proved<1>, _>| match proved {
        Ok(proved) => Verdict::Holds(Evidence::identity(part.clone(), proved.bound.value(), proved.boxes)),
        Err(_) => Verdict::undecided("60000 cells at most"),
    };
    if distortion == Distortion::None {
        verdict(&PROVED[form as usize])
    } else {
        verdict(&form.prove_changed(&distortion))
    }
}

/// Closed form of a kernel under a unit sinusoid.
pub(super) fn on_unit<T: Real>(kernel: Kernel<T>) -> DescribingFunction<T> {
    let sweep = Sinusoid::new(T::zero(), T::one()).ok();
    sweep.and_then(|sweep| kernel.describing_function(&sweep).ok()).unwrap_or_else(no_function)
}
