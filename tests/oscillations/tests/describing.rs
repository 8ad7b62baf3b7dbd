//! Oscillations of describing-function loops: published and named figures, two methods, and false answers that are caught.

use selfosc_oscillations::describing::answer::Line;
use selfosc_oscillations::describing::counterexamples::{Figures, counterexamples};
use selfosc_oscillations::describing::judge::{Contradiction, judge};
use selfosc_oscillations::describing::loops::{DescribingLoop, loops};
use selfosc_oscillations::describing::truth::{Truth, truth};
use serde_json::{Value, json};

fn named(name: &str) -> DescribingLoop {
    loops().into_iter().find(|one| one.name == name).unwrap()
}

fn known(name: &str) -> Truth {
    truth(&named(name))
}

/// Both methods, and the multiplier and the disturbed motion, agree.
fn agrees(found: &Truth, tolerance: f64) {
    for one in &found.oscillations {
        assert!(one.disagreement().is_none_or(|off| off < tolerance), "{one:?}");
        if let (Some(multiplier), Some(attracting)) = (one.multiplier, one.attracting) {
            assert_eq!(multiplier < 1.0, attracting, "{one:?}");
        }
    }
}

#[test]
fn thirty_loops_of_first_to_fourth_order() {
    let all = loops();
    assert_eq!(all.len(), 30);
    assert!(all.iter().all(|one| one.plant.check().is_ok() && one.plant.order() <= 4));
    let with = |what: fn(&DescribingLoop) -> bool| all.iter().filter(|one| what(one)).count();
    assert!(with(|one| one.plant.delay > 0.0) >= 8);
    assert!(with(|one| one.plant.den.last() == Some(&0.0)) >= 12);
    assert!(with(|one| !one.characteristic.has_kinks()) >= 8);
}

#[test]
fn van_der_pol_has_its_published_period_and_amplitude() {
    let found = known("van der Pol");
    agrees(&found, 1e-14);
    let (_, omega, _) = found.oscillations[0].best();
    assert!((std::f64::consts::TAU / omega - 6.663_286_859_323_13).abs() < 1e-14 * 10.0);
}

#[test]
fn at_the_fold_two_cycles_stand_where_the_first_harmonic_has_none() {
    let control_loop = named("dead zone and saturation, at the fold");
    let found = truth(&control_loop);
    agrees(&found, 1e-12);
    let amplitudes: Vec<f64> = found.oscillations.iter().map(|one| one.amplitude).collect();
    assert!((amplitudes[0] - 0.993_778_3).abs() < 5e-8 && (amplitudes[1] - 1.042_642_8).abs() < 5e-8, "{amplitudes:?}");
    assert_eq!(found.oscillations.iter().map(|one| one.attracting).collect::<Vec<_>>(), [Some(false), Some(true)]);
    // abs(G) = gain/2 at omega = 1, so the first harmonic needs N = 2/gain; the largest N belongs to the gain 2.6714.
    let describing = |amplitude: f64| {
        let ramp = |kink: f64| {
            let u = (kink / amplitude).min(1.0);
            (u.asin() + u * (1.0 - u * u).sqrt()) * 2.0 / std::f64::consts::PI
        };
        ramp(1.0) - ramp(0.2)
    };
    let largest = (500..3000).map(|i| describing(1e-3 * f64::from(i))).fold(0.0, f64::max);
    assert!((2.0 / largest - 2.6714).abs() < 1e-4 && 2.0 / largest > 2.67);
}

#[test]
fn dead_time_by_both_methods() {
    for (name, tolerance) in
        [("tanh, one lag and dead time", 1e-13), ("saturation, integrator, lag and dead time", 2e-12)]
    {
        let found = known(name);
        agrees(&found, tolerance);
        assert_eq!(found.oscillations.len(), 1);
        assert_eq!(found.oscillations[0].attracting, Some(true), "{name}");
    }
}

#[test]
fn a_cycle_far_from_a_sinusoid() {
    let found = known("cubic x^3 - 2 x, gain 1");
    agrees(&found, 1e-13);
    // The peak is 1.96147, the first harmonic 1.48708; the cycle near the first harmonic's 2.309 repels.
    assert!((found.oscillations[0].amplitude - 1.487_080_74).abs() < 1e-8);
    assert_eq!(found.oscillations.iter().map(|one| one.attracting).collect::<Vec<_>>(), [Some(true), Some(false)]);
}

fn close(found: f64, exact: f64, tolerance: f64) {
    assert!((found - exact).abs() <= tolerance, "{found} instead of {exact}");
}

#[test]
fn loops_against_theorems_2_and_3_have_their_figures() {
    let figures: Vec<Figures> = counterexamples().iter().map(|one| one.figures().unwrap()).collect();
    let [kinks, cubic, symmetric, limits, parabola] = figures.as_slice() else { panic!("{figures:?}") };
    assert!(figures.iter().all(|one| one.attracting == Some(true)));
    close(kinks.minimum, 0.3772, 5e-5);
    close(kinks.maximum, 1.0739, 5e-5);
    assert_eq!(kinks.escaped, 0);
    close(cubic.minimum, 0.7844, 5e-5);
    close(cubic.maximum, 1.8058, 5e-5);
    close(cubic.period_s, 6.4934, 5e-5);
    close(cubic.multipliers[0], 0.51, 5e-3);
    close(cubic.multipliers[1], 4e-6, 6e-7);
    assert!(cubic.escaped > 0);
    close(symmetric.maximum, 1.96147, 5e-6);
    close(limits.maximum, 2.5090, 5e-5);
    assert!(limits.second < 1e-60 && limits.mean.abs() < 1e-60);
    close(parabola.gain, 1.904_899, 5e-7);
    assert!(parabola.mean.abs() < 1e-13);
    close(parabola.second / parabola.first, 0.05, 5e-3);
}

/// A right answer about the loop at the fold, and about one with an intersection.
fn right(found: &Truth) -> Value {
    let width = 1e-10;
    let bounds = |value: f64| json!([value - width, value + width]);
    let proved: Vec<Value> = found
        .oscillations
        .iter()
        .map(|one| json!({ "shown": true, "amplitude": bounds(one.best().0), "omega_rad_s": bounds(one.best().1) }))
        .collect();
    let intersections: Vec<Value> = found
        .oscillations
        .iter()
        .zip(&proved)
        .map(|(one, existence)| {
            json!({ "amplitude": 1.01 * one.amplitude, "omega_rad_s": one.omega_rad_s, "stable": one.attracting,
                    "stability_by": "loeb", "existence": existence })
        })
        .collect();
    json!({ "intersections": intersections, "proved": proved })
}

fn contradictions(control_loop: &DescribingLoop, answer: Value) -> Vec<Contradiction> {
    judge(&Line { control_loop: control_loop.clone(), seconds: None, answer: Some(answer), refused: None })
        .contradictions
}

#[test]
fn right_answers_pass_and_false_ones_are_caught() {
    let control_loop = named("dead zone and saturation, at the fold");
    let found = truth(&control_loop);
    let answer = right(&found);
    assert_eq!(contradictions(&control_loop, answer.clone()), []);

    // Centre off by three widths.
    let mut off = answer.clone();
    for bound in off["proved"][1]["amplitude"].as_array_mut().unwrap() {
        *bound = json!(bound.as_f64().unwrap() + 6e-10);
    }
    let caught = contradictions(&control_loop, off);
    assert!(matches!(caught.as_slice(), [Contradiction::Empty { .. }]), "{caught:?}");

    // Boxes of a gain that is off by 0.1 %.
    let mut other = control_loop.clone();
    other.plant.num[0] *= 1.001;
    let caught = contradictions(&other, answer.clone());
    assert_eq!(caught.iter().filter(|one| matches!(one, Contradiction::Empty { .. })).count(), 2, "{caught:?}");

    let mut unstable = answer.clone();
    unstable["intersections"][0]["stable"] = json!(true);
    let caught = contradictions(&control_loop, unstable);
    assert!(
        matches!(caught.as_slice(), [Contradiction::Stability { listed: true, attracting: false, .. }]),
        "{caught:?}"
    );

    let mut wide = answer.clone();
    for place in ["/proved/0/amplitude/1", "/intersections/0/existence/amplitude/1"] {
        let bound = wide.pointer_mut(place).unwrap();
        *bound = json!(bound.as_f64().unwrap() + 1e-5);
    }
    let caught = contradictions(&control_loop, wide);
    assert!(matches!(caught.as_slice(), [Contradiction::Wide { .. }]), "{caught:?}");

    let mut silent = answer.clone();
    silent["intersections"][0]["existence"] = json!({ "shown": false, "reason": null });
    let caught = contradictions(&control_loop, silent);
    assert!(matches!(caught.as_slice(), [Contradiction::Silent { .. }]), "{caught:?}");
    let mut told = answer;
    told["intersections"][0]["existence"] = json!({ "shown": false, "reason": "rho" });
    assert_eq!(contradictions(&control_loop, told), []);
}
