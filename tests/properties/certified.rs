//! Enclosures of describing functions, and proofs of the kernels' closed forms.

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use selfosc::claims::{CLAIMS, Verdict};
use selfosc::describing::{
    CATALOGUE, DescribingError, DescribingFunction, Entry, KernelForm, band_from_the_middle, band_near_the_maximum,
    certified,
};
use selfosc::nonlinearity::{Custom, NonlinearityError, RelayHysteresis, Saturation, Sinusoid};
use selfosc::numeric::special::Special;
use selfosc::numeric::{Interval, Real};
use selfosc::proof::identity::{IdentityJet, prove_zero_of_two};
use selfosc::proof::rigorous_quadrature::CellJet;
use selfosc::proof::{Change, Unchanged};

use crate::cases::case;
use crate::fourier_oracle::{Big, big, definition, describing_function};
use crate::tolerance;

fn jet(value: f64) -> CellJet {
    CellJet::from_f64(value)
}

fn parts<T: Copy>(df: DescribingFunction<T>) -> [T; 3] {
    [df.f0, df.p, df.q]
}

/// Moderate parameters of each characteristic.
fn moderate(entry: &Entry) -> Vec<f64> {
    match entry.name {
        "relay" => vec![1.5],
        "relay-hysteresis" => vec![1.2, 0.4, 0.3],
        "relay-dead-zone-hysteresis" => vec![1.0, 0.5, 0.2],
        "saturation-asymmetric" => vec![1.3, -0.4, 0.6],
        "gain-changing" => vec![0.5, 2.0, 0.6],
        "dead-zone-saturation" => vec![1.0, 0.2, 0.7],
        "quantizer" => vec![0.25],
        "power" => vec![1.0, 2.0],
        "polynomial" => vec![0.1, 1.0, 0.3, -0.2, 0.0, 0.05, 0.0, 0.0, 0.0, 0.01],
        "absolute" => vec![1.0],
        "piecewise-linear" => vec![0.1, 0.2, -1.0, -0.8, -0.2, 0.0, 0.1, 0.0, 1.0, 1.2],
        "backlash" => vec![1.0, 0.3],
        _ => vec![1.1, 0.5],
    }
}

/// Whether an enclosure contains an exact value, given to the accuracy of the oracle.
fn holds(enclosure: Interval, exact: &Big) -> bool {
    let slack = big(tolerance::POWER_ORACLE * (1.0 + exact.to_f64().value().abs()));
    let (lower, upper) = enclosure.bounds();
    (lower.is_infinite() || big(lower) <= exact + &slack) && (upper.is_infinite() || exact - &slack <= big(upper))
}

/// The definition in 42 digits lies in both enclosures, by quadrature and by the closed form in intervals, and neither is
/// wide. This is where the decomposition into kernels is checked for each member.
#[test]
fn every_member_is_enclosed_within_1e11() {
    for entry in CATALOGUE {
        let values = moderate(entry);
        let characteristic = entry.build(&values.iter().map(|&value| jet(value)).collect::<Vec<_>>()).unwrap();
        let closed = entry.build(&values.iter().map(|&value| Interval::point(value)).collect::<Vec<_>>()).unwrap();
        for (bias, amplitude) in [(0.0, 1.0), (0.15, 1.3), (-0.37, 1.3)] {
            let found = certified(&*characteristic, &Sinusoid::new(jet(bias), jet(amplitude)).unwrap());
            let found = found.unwrap_or_else(|error| panic!("{}: {error}", entry.name)).enclosure;
            let sweep = Sinusoid::new(Interval::point(bias), Interval::point(amplitude)).unwrap();
            let closed = closed.describing_function(&sweep).unwrap();
            let (exact_bias, exact_amplitude) = (big(bias), big(amplitude));
            let definition = definition(entry.name, &values, &exact_bias, &exact_amplitude);
            let exact = describing_function(&definition, &exact_bias, &exact_amplitude);
            for (way, enclosure) in [("quadrature", found), ("closed form", closed)] {
                for (part, exact) in parts(enclosure).into_iter().zip(&exact) {
                    let case = format!("{}, bias {bias}, by {way}", entry.name);
                    assert!(part.width() < tolerance::CERTIFIED_WIDTH, "{case}: {part} is {:e} wide", part.width());
                    assert!(holds(part, exact), "{case}: {exact} not in {part}");
                }
            }
        }
    }
}

/// A jump beside a turning point: the enclosure is as wide as a rounding of the input makes it, up to the last float before the
/// turning point.
#[test]
fn a_jump_beside_a_turning_point_is_enclosed() {
    let distances = [1e-4, 1e-7, 1e-9, 1e-11, 1e-13, 1e-15, f64::EPSILON / 2.0];
    for (name, below) in distances.iter().flat_map(|below| [("relay-dead-zone", below), ("relay-hysteresis", below)]) {
        let at = 1.0 - below;
        let mut values = vec![1.0, at];
        values.extend((name == "relay-hysteresis").then_some(0.0));
        let entry = CATALOGUE.iter().find(|entry| entry.name == name).unwrap();
        let characteristic = entry.build(&values.iter().map(|&value| jet(value)).collect::<Vec<_>>()).unwrap();
        let found = certified(&*characteristic, &Sinusoid::new(jet(0.0), jet(1.0)).unwrap());
        let found = found.unwrap_or_else(|error| panic!("{name}, {below}: {error}")).enclosure;
        let definition = definition(name, &values, &big(0.0), &big(1.0));
        let exact = describing_function(&definition, &big(0.0), &big(1.0));
        let cosine = (2.0 * below).sqrt();
        for (part, exact) in parts(found).into_iter().zip(&exact) {
            assert!(holds(part, exact), "{name}, {below}: {exact} not in {part}");
            assert!(
                part.width() < tolerance::CERTIFIED_WIDTH + 40.0 * f64::EPSILON / cosine,
                "{name}, {below}: {part}"
            );
        }
    }
}

/// Random parameters, in the arithmetic of intervals: the closed form contains the definition in 42 digits.
#[test]
fn closed_forms_in_intervals_contain_the_exact_values() {
    for entry in CATALOGUE {
        for seed in 0..6 {
            let case = case(entry, &mut Pcg64Mcg::seed_from_u64(seed));
            let number = Interval::point;
            let closed = entry.build(&case.values.iter().map(|&value| number(value)).collect::<Vec<_>>()).unwrap();
            let sweep = Sinusoid::new(number(case.sweep.bias()), number(case.sweep.amplitude())).unwrap();
            let closed = closed.describing_function(&sweep).unwrap();
            let (bias, amplitude) = (big(case.sweep.bias()), big(case.sweep.amplitude()));
            let exact =
                describing_function(&definition(entry.name, &case.values, &bias, &amplitude), &bias, &amplitude);
            for (part, exact) in parts(closed).into_iter().zip(&exact) {
                assert!(holds(part, exact), "{}, seed {seed}: {exact} not in {part}", entry.name);
            }
        }
    }
}

/// Kinks that are not reported cost cells, not truth.
#[test]
fn unreported_kinks_are_found() {
    let sweep = Sinusoid::new(jet(0.2), jet(1.0)).unwrap();
    let reported = certified(&Saturation::new(jet(1.0), jet(0.5)).unwrap(), &sweep).unwrap();
    let hidden = Custom::new(|x: CellJet, _| x.max(jet(-0.5)).min(jet(0.5)), &[]);
    let hidden = certified(&hidden, &sweep).unwrap();
    assert!(hidden.cells > reported.cells);
    for (a, b) in parts(reported.enclosure).into_iter().zip(parts(hidden.enclosure)) {
        assert!(a.intersection(b).is_some(), "{a} {b}");
    }
}

#[test]
fn refusals_carry_numbers() {
    let relay = RelayHysteresis::new(jet(1.0), jet(0.5), jet(0.0)).unwrap();
    let below = certified(&relay, &Sinusoid::new(jet(0.1), jet(0.4)).unwrap());
    assert!(matches!(
        below,
        Err(DescribingError::Nonlinearity(NonlinearityError::BelowSwitching { amplitude: 0.4, .. }))
    ));
    let pole = Custom::new(|x: CellJet, _| CellJet::one() / x, &[]);
    let unbounded = certified(&pole, &Sinusoid::new(jet(0.1), jet(0.4)).unwrap());
    assert!(matches!(unbounded, Err(DescribingError::NotFinite { .. })), "{unbounded:?}");
    let wide = CellJet::constant(Interval::new(0.4, 0.6).unwrap());
    let vague = certified(&Saturation::new(jet(1.0), wide).unwrap(), &Sinusoid::new(jet(0.1), jet(1.0)).unwrap());
    assert!(matches!(vague, Err(DescribingError::Quadrature { estimate, tolerance, .. }) if estimate > tolerance));
}

/// Random cases of the whole catalogue: an enclosure, where there is one, contains the floating-point closed form but for
/// its rounding.
#[test]
fn random_cases_agree_with_the_closed_form() {
    let mut rng = Pcg64Mcg::seed_from_u64(11);
    for entry in CATALOGUE.iter().filter(|entry| entry.name != "power" && entry.name != "polynomial") {
        let mut compared = 0;
        for _ in 0..12 {
            let drawn = case(entry, &mut rng);
            let jets: Vec<_> = drawn.values.iter().map(|&value| jet(value)).collect();
            let sweep = Sinusoid::new(jet(drawn.sweep.bias()), jet(drawn.sweep.amplitude())).unwrap();
            let Ok(found) = certified(&*entry.build(&jets).unwrap(), &sweep) else { continue };
            compared += 1;
            let floating = parts(drawn.characteristic.describing_function(&drawn.sweep).unwrap());
            for (enclosed, floating) in parts(found.enclosure).into_iter().zip(floating) {
                let size = parts(found.enclosure)[0].magnitude().max(enclosed.magnitude());
                let away = (enclosed.lower() - floating).max(floating - enclosed.upper());
                assert!(
                    drawn.on_edge() || away <= 1e-11 * (1.0 + size),
                    "{}: {floating} not in {enclosed}",
                    entry.name
                );
            }
        }
        assert!(compared >= 4, "{}: only {compared} of 12 enclosed", entry.name);
    }
}

/// A false closed form.
struct Times(f64);

impl Change for Times {
    fn apply<T: Special, const N: usize, const M: usize>(&self, _: [T; N], values: [T; M]) -> [T; M] {
        values.map(|value| value * T::from_f64(self.0))
    }
}

/// False by 1e-9 near one breakpoint only.
struct Bump;

impl Change for Bump {
    fn apply<T: Special, const N: usize, const M: usize>(&self, at: [T; N], values: [T; M]) -> [T; M] {
        let distance = (at[0] - T::from_f64(0.3)) * T::from_f64(50.0);
        let bump = T::from_f64(1e-9) / (T::one() + distance.square());
        values.map(|value| value + bump)
    }
}

#[test]
fn a_local_falsehood_is_not_proved() {
    for form in [KernelForm::Step, KernelForm::Ramp, KernelForm::Sign, KernelForm::Band] {
        assert!(form.prove_changed(&Bump).is_err(), "{form:?}");
    }
    assert!(band_is_proved(&Unchanged) && !band_is_proved(&Bump));
}

/// Where the code takes one and the same formula for an angle; together `[-0.95, 0.95]` but for two gaps.
const BREAKPOINTS: [[f64; 2]; 3] = [[-0.95, -0.5 - 1e-9], [-0.5, 0.5], [0.5 + 1e-9, 0.95]];

/// The band, by the formula for the middle less that by ramps: mean and sine component. The change is of the former.
fn band_less_ramps<T: Special>(change: &impl Change, [lower, upper]: [T; 2]) -> [T; 2] {
    let sweep = Sinusoid::new(T::zero(), T::one()).unwrap();
    let middle = band_from_the_middle(T::zero(), lower, upper, &sweep);
    let [mean, sine] = change.apply([lower, upper], [middle.f0, middle.p]);
    let ramps = band_near_the_maximum(T::zero(), lower, upper, &sweep);
    [mean - ramps.f0, sine - ramps.p]
}

/// Whether the formula for a band from the middle is the difference of two ramps, to 1e-11: for every pair of breakpoints within
/// 0.95 of the bias, in units of the amplitude, but those from 0.5 to 0.5 + 1e-9 away from it. A proof for each of the nine
/// rectangles on which the code uses a single formula.
fn band_is_proved(change: &impl Change) -> bool {
    let by_values = |a: Interval, b| band_less_ramps(change, [a, b]);
    let by_series = |a: IdentityJet, b| band_less_ramps(change, [a, b]);
    let mut pairs = BREAKPOINTS.into_iter().flat_map(|lower| BREAKPOINTS.map(|upper| [lower, upper]));
    pairs.all(|domain| prove_zero_of_two(by_values, by_series, domain, 1e-11, 60_000).is_ok())
}

#[test]
fn kernels_are_proved_and_false_ones_are_not() {
    for form in [KernelForm::Step, KernelForm::Ramp, KernelForm::Sign, KernelForm::Band] {
        let proof = form.prove().unwrap_or_else(|why| panic!("{form:?}: {why}"));
        assert!(proof.bound.value() <= tolerance::CERTIFIED_WIDTH, "{form:?}: {:?}", proof.bound);
        for factor in [1.000_01, 0.999_99] {
            assert!(form.prove_changed(&Times(factor)).is_err(), "{form:?} times {factor}");
        }
    }
}

/// A false formula is not proved, be it off everywhere or by a millionth on a thousandth of the domain.
#[test]
fn the_proofs_of_false_statements_do_not_succeed() {
    let proved: Vec<_> = CLAIMS.par_iter().filter_map(|claim| Some((claim, claim.prove()?))).collect();
    assert!(proved.len() >= 27, "{} proofs", proved.len());
    let accepted = proved.par_iter().flat_map_iter(|(claim, proof)| {
        assert!(proof.holds(), "{}: {proof:?}", claim.id);
        let wrong = claim.prove_falsehoods().filter(|(_, verdict)| !matches!(verdict, Verdict::Undecided { .. }));
        wrong.map(|(falsehood, verdict)| format!("{} with {falsehood}: {verdict:?}", claim.id)).collect::<Vec<_>>()
    });
    assert_eq!(accepted.collect::<Vec<_>>(), Vec::<String>::new());
}

/// A jet's derivative, its power by the recurrence, and products with constants against the general ways.
#[test]
fn shortcuts_of_jets_meet_the_general_formulas() {
    let x = CellJet::variable(Interval::point(0.7));
    let general = (jet(1.7) * x.ln()).exp();
    for (a, b) in x.pow(jet(1.7)).coefficients().iter().zip(general.coefficients()) {
        assert!(a.intersection(*b).is_some(), "{a} {b}");
    }
    for (a, b) in x.exp().derivative().coefficients().iter().zip(x.exp().coefficients()) {
        assert!(a.intersection(*b).is_some(), "{a} {b}");
    }
    for (a, b) in (x.sin() * jet(3.0)).coefficients().iter().zip((x.sin() + x.sin() + x.sin()).coefficients()) {
        assert!(a.intersection(*b).is_some(), "{a} {b}");
    }
}
