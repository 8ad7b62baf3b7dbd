//! The piecewise-linear catalogue as sums of kernels, and the kernels' describing functions wherever the breakpoint is.

use super::algebra::{exactly, number};
use super::kernels::{BRANCHES, KernelMaker, SIDES, ramp, sign, step};
use super::{ClaimPart, Distortion, Verdict};
use crate::describing::ClosedForm;
use crate::nonlinearity::{
    Absolute, Backlash, Branch, Branches, Catalogued, DeadZone, DeadZoneSaturation, GainChanging, Kernel,
    PiecewiseLinear, Polyline, Preload, Quantizer, Relay, RelayDeadZone, RelayDeadZoneHysteresis, RelayHysteresis,
    Saturation, SaturationAsymmetric, Side, Sinusoid,
};
use crate::numeric::Real;
use crate::proof::polynomial::Rational;

pub(super) const DECOMPOSITION: ClaimPart = ClaimPart::named("decomposition");
pub(super) const SCALING: ClaimPart = ClaimPart::named("scaling");
pub(super) const BEYOND: ClaimPart = ClaimPart::named("beyond-the-sweep");

/// Most parameters of a member, two for each point of a polyline.
const PARAMETERS: usize = 10;
/// With bias, amplitude and place on the sweep.
const VARIABLES: usize = PARAMETERS + 3;

/// A member's output less the sum of its kernels, on one branch, at these settings and at sweeps and places that lie on every
/// side of all breakpoints.
pub fn is_sum<C>(distortion: Distortion, branch: Branch, settings: &[&[f64]]) -> Verdict
where
    C: Catalogued<Rational> + PiecewiseLinear<Number = Rational>,
{
    const SWEEPS: [[f64; 2]; 4] = [[0.11, 0.37], [0.13, 5.3], [3.1, 2.9], [-3.3, 2.7]];
    const PLACES: [f64; 10] = [-0.97, -0.79, -0.58, -0.41, -0.17, 0.06, 0.29, 0.47, 0.68, 0.91];
    let each = |setting: &&[f64]| {
        let count = setting.len();
        let points = SWEEPS.iter().flat_map(|&[bias, amplitude]| {
            PLACES.map(|place| {
                let mut point = [0.0; VARIABLES];
                point[..count].copy_from_slice(setting);
                point[PARAMETERS..].copy_from_slice(&[bias, amplitude, place]);
                point
            })
        });
        let points: Vec<_> = points.collect();
        exactly(DECOMPOSITION, distortion, &points, |at: [Rational; VARIABLES], factor: Rational| {
            let member = C::from_values(&at[..count]).ok()?;
            let [bias, amplitude, place] = [at[PARAMETERS], at[PARAMETERS + 1], at[PARAMETERS + 2]];
            let (sweep, x) = (Sinusoid::new(bias, amplitude).ok()?, bias + amplitude * place);
            let mut sum = number(0.0);
            member.kernels(&sweep, |kernel| sum = sum + kernel.value(x, branch, &sweep));
            Some([member.value(x, branch, &sweep) - factor * sum])
        })
    };
    Verdict::all(settings.iter().map(each))
}

/// The proof of a member on a branch.
pub type MemberProof = fn(Distortion, Branch) -> Verdict;

/// Rows: a member, and settings of its parameters.
macro_rules! members {
    ($($member:ident $(of $points:ty)?: $($setting:expr),+;)+) => {
        [$((<$member<Rational $(, $points)?>>::NAME, |distortion, branch| {
            is_sum::<$member<Rational $(, $points)?>>(distortion, branch, &[$(&$setting),+])
        })),+]
    };
}

/// Each member with settings in every order that its parameters can have; a polyline of up to four points, the bias in each of
/// its segments.
pub const MEMBERS: [(&str, MemberProof); 14] = members! {
    Relay: [0.7];
    RelayDeadZone: [0.7, 1.3];
    RelayHysteresis: [0.7, 1.3, 0.2];
    RelayDeadZoneHysteresis: [0.7, 1.3, 0.5], [0.7, 0.25, 0.05];
    Saturation: [0.7, 1.3], [0.7, 0.2];
    SaturationAsymmetric: [0.7, -0.6, 1.3], [0.7, 0.6, 1.3], [0.7, -1.3, -0.6];
    DeadZone: [0.7, 1.3], [0.7, 0.2];
    DeadZoneSaturation: [0.7, 0.6, 1.7];
    GainChanging: [2.0, 0.7, 1.3], [0.7, 2.0, 1.3], [-0.7, 2.0, 1.3], [-0.7, -2.0, 1.3], [-2.0, -0.7, 1.3];
    Preload: [0.7, 0.4];
    Quantizer: [0.9], [2.3];
    Absolute: [0.7];
    Polyline of Vec<(Rational, Rational)>:
        [0.7, -0.3, 0.2, 0.5],
        [0.7, -0.3, -1.2, 0.5, 1.1, 0.9],
        [0.7, -0.3, 1.2, 0.5, 2.1, 0.9],
        [0.7, -0.3, -1.2, 0.5, 1.1, 0.9, 2.2, -0.4],
        [0.7, -0.3, -2.2, 0.5, -1.1, 0.9, 0.7, -0.4, 2.3, 0.1],
        [0.7, -0.3, -3.2, 0.5, -2.1, 0.9, -1.2, -0.4, -0.3, 0.1];
    Backlash: [0.7, 0.2], [0.7, 1.1];
};

/// Every member on both branches.
pub fn decomposition(distortion: Distortion) -> Verdict {
    let both =
        |(_, proof): &(&str, MemberProof)| proof(distortion, Branch::Rising).and(|| proof(distortion, Branch::Falling));
    Verdict::all(MEMBERS.iter().map(both))
}

/// The three components of a kernel's output, that is `[F_0, P X, Q X]`.
fn output(kernel: Kernel<Rational>, bias: Rational, amplitude: Rational) -> Option<[Rational; 3]> {
    let df = kernel.describing_function(&Sinusoid::new(bias, amplitude).ok()?).ok()?;
    Some([df.f0, df.p * amplitude, df.q * amplitude])
}

/// Every height, bias and amplitude from a unit kernel on the unit sweep, on the rising branch and above: the falling
/// branch turns the cosine component round, a kernel below is the kernel above its mirror image with the sine component
/// turned round, and a kernel on both branches is the sum.
pub fn scaling(distortion: Distortion) -> Verdict {
    let one = |make: KernelMaker<Rational>, side: Side, branches: Branches| {
        let points = [0.25, -0.25, 0.75, -0.75].map(|u| [u, 0.3, 2.0, 0.7]);
        exactly(SCALING, distortion, &points, |[u, bias, amplitude, height]: [Rational; 4], factor: Rational| {
            let (zero, unit) = (number(0.0), number(1.0));
            let kernel = make(bias + amplitude * u, height, side, branches);
            let found = output(kernel, bias, amplitude)?;
            // A sign is odd itself.
            let (mirrored, turned) = match side {
                Side::Above => (u, unit),
                Side::Below => (-u, -unit),
            };
            let [mean, sine, cosine] = output(make(mirrored, unit, Side::Above, Branches::Rising), zero, unit)?;
            let size = factor * height * if matches!(kernel, Kernel::Ramp { .. }) { amplitude } else { unit };
            let (both, cosine) = match branches {
                Branches::Both => (number(2.0), zero),
                Branches::Rising => (unit, cosine),
                Branches::Falling => (unit, -cosine),
            };
            let expected = [mean * both, turned * sine * both, cosine];
            Some(core::array::from_fn::<_, 3, _>(|i| found[i] - size * expected[i]))
        })
    };
    let kernels = SIDES
        .iter()
        .flat_map(|&side| BRANCHES.map(|branches| one(step, side, branches).and(|| one(ramp, side, branches))));
    Verdict::all(kernels.chain(BRANCHES.map(|branches| one(sign, Side::Above, branches))))
}

/// With its breakpoint beyond the sweep a kernel is a straight line `c + s x` on each branch that counts, with mean `c + s B`,
/// sine component `s X` and, on a branch alone, cosine component `4 (c + s B)/pi` of either sign: half of each on a branch.
pub fn beyond(distortion: Distortion) -> Verdict {
    let one = |make: KernelMaker<Rational>, side: Side, branches: Branches| {
        let points = [[4.0, 0.3, 2.0, 0.7], [-4.0, 0.3, 2.0, 0.7]];
        exactly(BEYOND, distortion, &points, |[at, bias, amplitude, height]: [Rational; 4], factor: Rational| {
            let kernel = make(at, height, side, branches);
            let found = output(kernel, bias, amplitude)?;
            let (share, turned, branch) = match branches {
                Branches::Both => (number(1.0), number(0.0), Branch::Rising),
                Branches::Rising => (number(0.5), number(1.0), Branch::Rising),
                Branches::Falling => (number(0.5), number(-1.0), Branch::Falling),
            };
            let sweep = Sinusoid::new(bias, amplitude).ok()?;
            let mean = kernel.value(bias, branch, &sweep);
            let sine = kernel.value(bias + amplitude, branch, &sweep) - mean;
            let expected = [share * mean, share * sine, turned * number(2.0) * mean / Rational::pi()];
            Some(core::array::from_fn::<_, 3, _>(|i| found[i] - factor * expected[i]))
        })
    };
    let all = SIDES.iter().flat_map(|&side| {
        BRANCHES
            .iter()
            .flat_map(move |&branches| [step as KernelMaker<_>, ramp, sign].map(|make| one(make, side, branches)))
    });
    Verdict::all(all)
}
