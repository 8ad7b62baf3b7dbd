//! The proofs of the claims part by part: each holds, and no false statement next to it does.

use selfosc::claims::band::{by_ramps, by_tangents};
use selfosc::claims::decomposition::{MEMBERS, beyond, decomposition, is_sum, scaling};
use selfosc::claims::power_law::{most_within, steepest_beyond};
use selfosc::claims::step::{RATE, falls};
use selfosc::claims::vehicle_proofs::table_2_entries;
use selfosc::claims::{Budget, CLAIMS, Distortion, Word};
use selfosc::describing::{CATALOGUE, KernelForm, by_quadrature};
use selfosc::nonlinearity::{
    Branch, Branches, Catalogued, DeadZone, Kernel, NonlinearityError, ParameterSpec, PiecewiseLinear, Side, Sinusoid,
};
use selfosc::numeric::power::{INNER, OUTER};
use selfosc::numeric::{Interval, Real};
use selfosc::proof::polynomial::Rational;

/// Claims whose proofs take many subdivisions: `certified` tries theirs.
const LONG: &str = "kernel-step kernel-ramp kernel-sign kernel-band describing-function power-law sine sinh arctan tanh delay-rotation";

/// The other proofs: each holds, covers the claimed domain, and no false variant of it holds.
#[test]
fn exact_proofs_hold_and_false_ones_do_not() {
    let short = CLAIMS.iter().filter(|claim| LONG.split(' ').all(|id| id != claim.id) && claim.prove().is_some());
    let failures = short.filter_map(|claim| {
        let word = claim.check(Budget { cases: 20, seed: 1 }).word();
        let accepted: Vec<_> = claim.prove_falsehoods().filter(|(_, verdict)| verdict.holds()).collect();
        (word != Word::Proved || !accepted.is_empty()).then(|| format!("{}: {word}, accepts {accepted:?}", claim.id))
    });
    assert_eq!(failures.collect::<Vec<_>>(), Vec::<String>::new());
}

#[test]
fn every_form_is_the_difference_of_two_ramps() {
    assert!(by_ramps(Distortion::None).holds());
    assert!(by_tangents(Distortion::None).holds());
    for false_one in Distortion::FALSE {
        assert!(!by_ramps(false_one).holds() && !by_tangents(false_one).holds(), "{false_one:?}");
    }
}

/// A dead zone whose kernels are off by a millionth: each in its place, or a single kernel in its slope.
struct Off<const SLOPE: bool>(DeadZone<Rational>);

impl<const SLOPE: bool> Catalogued<Rational> for Off<SLOPE> {
    const NAME: &'static str = "off";
    const PARAMETERS: &'static [ParameterSpec] = DeadZone::<Rational>::PARAMETERS;
    const ORDERED: &'static [(&'static str, &'static str)] = &[];
    const SPEC: &'static str = "";

    fn from_values(values: &[Rational]) -> Result<Self, NonlinearityError> {
        DeadZone::from_values(values).map(Self)
    }
}

impl<const SLOPE: bool> PiecewiseLinear for Off<SLOPE> {
    type Number = Rational;

    fn value(&self, x: Rational, branch: Branch, sweep: &Sinusoid<Rational>) -> Rational {
        self.0.value(x, branch, sweep)
    }
    fn kernels(&self, sweep: &Sinusoid<Rational>, mut report: impl FnMut(Kernel<Rational>)) {
        let off = Rational::from_f64(1.000_001);
        self.0.kernels(sweep, |kernel| {
            report(match kernel {
                Kernel::Ramp { at, slope, side, branches } if SLOPE => {
                    Kernel::Ramp { at, slope: slope * off, side, branches }
                }
                Kernel::Ramp { at, slope, side, branches } => Kernel::Ramp { at: at * off, slope, side, branches },
                other => other,
            })
        });
    }
}

#[test]
fn a_millionth_is_seen() {
    let settings: [&[f64]; 1] = [&[0.7, 1.3]];
    for branch in [Branch::Rising, Branch::Falling] {
        assert!(is_sum::<DeadZone<_>>(Distortion::None, branch, &settings).holds());
        assert!(!is_sum::<Off<false>>(Distortion::None, branch, &settings).holds());
        assert!(!is_sum::<Off<true>>(Distortion::None, branch, &settings).holds());
    }
}

#[test]
fn every_piecewise_linear_member_is_decomposed() {
    const SMOOTH: [&str; 6] = ["power", "polynomial", "sine", "sinh", "arctan", "tanh"];
    let names: Vec<_> = CATALOGUE.iter().map(|entry| entry.name).filter(|name| !SMOOTH.contains(name)).collect();
    let mut proved = MEMBERS.map(|(name, _)| name).to_vec();
    proved.sort_by_key(|name| names.iter().position(|known| known == name));
    assert_eq!(proved, names);
    for (name, proof) in MEMBERS {
        for branch in [Branch::Rising, Branch::Falling] {
            assert!(proof(Distortion::None, branch).holds(), "{name}, {branch:?}");
            for false_one in Distortion::FALSE {
                assert!(!proof(false_one, branch).holds(), "{name}, {branch:?}, {false_one:?}");
            }
        }
    }
    assert!(decomposition(Distortion::None).holds());
}

#[test]
fn kernels_scale_and_end() {
    assert!(scaling(Distortion::None).holds());
    assert!(beyond(Distortion::None).holds());
    for false_one in Distortion::FALSE {
        assert!(!scaling(false_one).holds() && !beyond(false_one).holds(), "{false_one:?}");
    }
}

/// Values and slopes of a solution between two arguments, by the classical Runge-Kutta method.
fn solution(bend: impl Fn(f64, [f64; 2]) -> f64, from: f64, to: f64, start: [f64; 2]) -> Vec<[f64; 2]> {
    const STEPS: u32 = 20_000;
    let h = (to - from) / f64::from(STEPS);
    let step = |state: &mut [f64; 2], index: u32| {
        let at = |share: f64, slopes: [f64; 2]| {
            let [y, slope] = core::array::from_fn(|i| state[i] + share * h * slopes[i]);
            [slope, bend(from + (f64::from(index) + share) * h, [y, slope])]
        };
        let first = at(0.0, [0.0; 2]);
        let (second, third) = (at(0.5, first), at(0.5, at(0.5, first)));
        let last = at(1.0, third);
        *state = core::array::from_fn(|i| state[i] + h / 6.0 * (first[i] + 2.0 * second[i] + 2.0 * third[i] + last[i]));
        Some(*state)
    };
    (0..STEPS).scan(start, step).collect()
}

const STARTS: [[f64; 2]; 4] = [[1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, -1.0]];

/// The steps by hand: solutions, integrated, stay below their bounds, and not below bounds without the growth.
#[test]
fn growth_is_bounded() {
    let mut grown = 0;
    for p in [0.5, 1.5, 2.5, 4.0] {
        for start in STARTS {
            let (from, to) = (INNER.asin(), core::f64::consts::FRAC_PI_2 - 1e-3);
            let found = solution(|phi, [d, slope]| p * p * d - 2.0 * p * phi.tan() * slope, from, to, start);
            let largest = found.iter().fold(0.0_f64, |most, y| most.max(y[0].abs()));
            let [value, slope] = start.map(|x| Interval::point(x.abs()));
            let room = Interval::point(INNER.acos());
            assert!(largest <= most_within(Interval::point(p), value, slope, room).upper(), "{p} {start:?}: {largest}");
            grown += usize::from(largest > (value + slope * room).upper());

            let from = OUTER.acosh();
            let found = solution(|psi, [d, slope]| 2.0 * p * slope / psi.tanh() - p * p * d, from, 1e-3, start);
            let steepest = found.iter().fold(0.0_f64, |most, y| most.max(y[1].abs()));
            let bound = steepest_beyond(Interval::point(p), value, slope).upper();
            assert!(steepest <= bound * (1.0 + 1e-9), "{p} {start:?}: {steepest} {bound}");
            grown += usize::from(steepest > slope.upper());
        }
    }
    assert!(grown > 4, "{grown}");
}

#[test]
fn the_rate_is_below_the_least_and_no_other_is_proved() {
    let least = 0.5 / core::f64::consts::PI;
    assert!(falls(RATE).is_some_and(|(margin, _)| margin > 0.0 && margin <= least - RATE));
    assert!(falls(least - 1e-4).is_some());
    assert!(falls(least + 1e-9).is_none());
    assert!(falls(1.0 / 6.0).is_none());
}

/// The slope that the proof takes for the integral's, against differences of the integral by quadrature.
#[test]
fn the_slope_is_that_of_the_integral() {
    let mean = |phi: f64| {
        let kernel = Kernel::Step { at: phi.cos(), height: 1.0, side: Side::Above, branches: Branches::Rising };
        by_quadrature(&kernel, &Sinusoid::new(0.0, 1.0).unwrap()).unwrap().f0
    };
    for phi in [0.1, 0.7, 1.5, 2.9] {
        let slope: [f64; 3] = KernelForm::Step.slope(phi);
        assert!(((mean(phi + 1e-3) - mean(phi - 1e-3)) / 2e-3 - slope[0]).abs() < 1e-9, "{phi}");
    }
}

#[test]
fn yaw_takes_no_other_moment_of_inertia() {
    let largest = |turning| {
        let residuals = table_2_entries(1.0, turning).unwrap();
        residuals.into_iter().map(f64::abs).fold(0.0, f64::max)
    };
    assert_eq!([0, 1, 2].map(|turning| largest(turning) == 0.0), [false, false, true]);
}
