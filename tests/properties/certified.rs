//! Enclosures of describing functions, and proofs of the kernels' closed forms.

use selfosc::claims::proof::PROOFS;
use selfosc::claims::{Budget, Claim, Evidence, Verdict};
use selfosc::describing::{CATALOGUE, ClosedForm, DescribingError, DescribingFunction, Entry, KernelForm, certified};
use selfosc::nonlinearity::{
    Absolute, Backlash, Custom, DeadZone, DeadZoneSaturation, GainChanging, NonlinearityError, Polyline, Preload,
    Quantizer, Relay, RelayDeadZone, RelayDeadZoneHysteresis, RelayHysteresis, Saturation, SaturationAsymmetric,
    Sinusoid,
};
use selfosc::numeric::rigorous_quadrature::CellJet;
use selfosc::numeric::{Interval, Real};

use crate::cases::case;
use crate::fourier_oracle::{big, definition, describing_function};
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

/// The high-precision definition lies in the enclosure, and so does the closed form but for its rounding.
#[test]
fn every_member_is_enclosed_within_1e11() {
    for entry in CATALOGUE {
        let values = moderate(entry);
        for (bias, amplitude) in [(0.0, 1.0), (0.15, 1.3)] {
            let jets: Vec<_> = values.iter().map(|&value| jet(value)).collect();
            let sweep = Sinusoid::new(jet(bias), jet(amplitude)).unwrap();
            let found = certified(&*entry.build_output(&jets).unwrap(), &sweep);
            let found = found.unwrap_or_else(|error| panic!("{}: {error}", entry.name));
            let exact_bias = big(bias);
            let exact_amplitude = big(amplitude);
            let exact = describing_function(
                &definition(entry.name, &values, &exact_bias, &exact_amplitude),
                &exact_bias,
                &exact_amplitude,
            );
            for (part, exact) in parts(found.enclosure).into_iter().zip(exact) {
                let name = entry.name;
                assert!(part.width() < tolerance::CERTIFIED_WIDTH, "{name}: {part} is {:e} wide", part.width());
                assert!(big(part.lower()) <= exact && exact <= big(part.upper()), "{name}: {exact} not in {part}");
            }
        }
    }
}

/// A random case in the arithmetic of intervals lies where quadrature puts it: two enclosures of one number meet.
fn meet<C>(name: &str, closed: &C, output: &dyn selfosc::nonlinearity::Characteristic<Number = CellJet>, bias: f64)
where
    C: ClosedForm<Number = Interval>,
{
    let amplitude = 1.3;
    let sweep = Sinusoid::new(Interval::point(bias), Interval::point(amplitude)).unwrap();
    let closed = parts(closed.describing_function(&sweep).unwrap());
    let enclosed = certified(output, &Sinusoid::new(jet(bias), jet(amplitude)).unwrap()).unwrap();
    for (closed, enclosed) in closed.into_iter().zip(parts(enclosed.enclosure)) {
        assert!(closed.intersection(enclosed).is_some(), "{name}, bias {bias}: {closed} does not meet {enclosed}");
        assert!(closed.width() < tolerance::CERTIFIED_WIDTH, "{name}, bias {bias}: {closed} is wide");
    }
}

/// The closed forms that the kernels' proofs carry, against the integrals: this is where the decomposition into kernels
/// is checked for each member.
#[test]
fn closed_forms_in_intervals_meet_the_quadrature() {
    macro_rules! members {
        ($($type:ident($($value:literal),*)),+ $(,)?) => {
            $(
                for bias in [0.0, 0.1, -0.37] {
                    let closed = $type::new($(Interval::point($value)),*).unwrap();
                    let output = $type::new($(jet($value)),*).unwrap();
                    meet(stringify!($type), &closed, &output, bias);
                }
            )+
        };
    }
    members!(
        Relay(1.5),
        RelayDeadZone(1.1, 0.5),
        RelayHysteresis(1.2, 0.4, 0.3),
        RelayDeadZoneHysteresis(1.0, 0.5, 0.2),
        Saturation(1.1, 0.5),
        SaturationAsymmetric(1.3, -0.4, 0.6),
        DeadZone(1.1, 0.5),
        DeadZoneSaturation(1.0, 0.2, 0.7),
        GainChanging(0.5, 2.0, 0.6),
        Preload(1.1, 0.5),
        Quantizer(0.25),
        Absolute(0.7),
        Backlash(1.0, 0.3),
    );
    let points = [(-1.0, -0.8), (-0.2, 0.0), (0.1, 0.0), (1.0, 1.2)];
    for bias in [0.0, 0.1, -0.37] {
        let closed = points.map(|(x, y)| (Interval::point(x), Interval::point(y)));
        let output = points.map(|(x, y)| (jet(x), jet(y)));
        let closed = Polyline::new(closed, Interval::point(0.1), Interval::point(0.2)).unwrap();
        meet("Polyline", &closed, &Polyline::new(output, jet(0.1), jet(0.2)).unwrap(), bias);
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
    use rand::SeedableRng;
    let mut rng = rand_pcg::Pcg64Mcg::seed_from_u64(11);
    for entry in CATALOGUE.iter().filter(|entry| entry.name != "power" && entry.name != "polynomial") {
        let mut compared = 0;
        for _ in 0..12 {
            let drawn = case(entry, &mut rng);
            let jets: Vec<_> = drawn.values.iter().map(|&value| jet(value)).collect();
            let sweep = Sinusoid::new(jet(drawn.sweep.bias()), jet(drawn.sweep.amplitude())).unwrap();
            let Ok(found) = certified(&*entry.build_output(&jets).unwrap(), &sweep) else { continue };
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

#[test]
fn kernels_are_proved_and_false_ones_are_not() {
    for form in [KernelForm::Step, KernelForm::Ramp, KernelForm::Sign, KernelForm::Band] {
        let proof = form.prove(1.0).unwrap_or_else(|| panic!("{form:?} is not proved"));
        assert!(proof.bound <= tolerance::CERTIFIED_WIDTH, "{form:?}: {proof:?}");
        for factor in [1.000_01, 0.999_99] {
            assert_eq!(form.prove(factor), None, "{form:?} times {factor}");
        }
    }
}

#[test]
fn the_proofs_of_false_statements_do_not_succeed() {
    for (id, proof) in PROOFS {
        assert!(matches!(proof(1.0), Verdict::Holds(Evidence::Proved { .. })), "{id}: {:?}", proof(1.0));
        for factor in [1.000_01, 0.999_99] {
            let verdict = proof(factor);
            assert!(matches!(verdict, Verdict::Undecided { .. }), "{id} times {factor}: {verdict:?}");
        }
    }
}

#[test]
fn every_proof_backs_a_claim() {
    for (id, _) in PROOFS {
        let claim = Claim::find(id).unwrap_or_else(|| panic!("no claim {id}"));
        let finding = claim.check(Budget { cases: 20, ..Budget::default() });
        let verdict = finding.corrected.or(finding.printed).unwrap();
        assert_eq!(verdict.word(), "proved", "{id}");
    }
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
