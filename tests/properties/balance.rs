//! Harmonic balance: published values, closed forms, and convergence to exact orbits with the number of harmonics.

use core::f64::consts::PI;

use nalgebra::DVector;
use proptest::prelude::*;
use selfosc::balance::{BalanceError, Bias, HarmonicBalance, Intersection, negative_inverse_locus, nyquist_locus};
use selfosc::describing::{ClosedForm, by_quadrature};
use selfosc::nonlinearity::{Backlash, Custom, Relay, RelayDeadZone, RelayHysteresis, Saturation, Sinusoid};
use selfosc::numeric::Limit;
use selfosc::orbit::{TwoLevelRelay, orbits};
use selfosc::plant::{StateSpace, TransferFunction};

use crate::event_integrator::{EventSystem, Integrator};
use crate::orbit_linear::tsypkin_locus;
use crate::tolerance;

fn transfer(numerator: &[f64], denominator: &[f64]) -> TransferFunction {
    TransferFunction::new(numerator, denominator).unwrap()
}

fn intersections(plant: &TransferFunction, characteristic: &impl ClosedForm<Number = f64>) -> Vec<Intersection> {
    HarmonicBalance::new(plant, |sweep| characteristic.describing_function(sweep)).unwrap().intersections().unwrap()
}

#[test]
fn published_saturation() {
    let agrees = |gain: f64| {
        let found = intersections(&transfer(&[gain], &[1.0, 2.0, 2.0, 1.0]), &Saturation::new(1.0, 1.0).unwrap());
        found.len() == 1
            && (found[0].amplitude - 3.343_998_730_206).abs() <= tolerance::PUBLISHED_12
            && (found[0].omega_rad_s - 2f64.sqrt()).abs() <= tolerance::PUBLISHED_12
            && found[0].stable == Some(true)
    };
    assert!(agrees(8.0));
    assert!(!agrees(8.0 * (1.0 + 1e-10)));
    // Below the critical gain of 3 there is none.
    assert!(intersections(&transfer(&[2.9], &[1.0, 2.0, 2.0, 1.0]), &Saturation::new(1.0, 1.0).unwrap()).is_empty());
}

#[test]
fn published_backlash() {
    let delay = TransferFunction::pade(5.0, 4).unwrap();
    let plant = transfer(&[4.0], &[1.0, 2.0, 2.0, 1.0]).series(&delay).unwrap();
    let residual = |half_gap: f64, amplitude: f64, omega: f64| {
        let backlash = Backlash::new(1.0, half_gap).unwrap();
        let df = by_quadrature(&backlash, &Sinusoid::new(0.0, amplitude).unwrap()).unwrap();
        (plant.response(omega).unwrap() * nalgebra::Complex::new(df.p, df.q) + 1.0).norm()
    };
    // The second published pair comes from a minimiser that stopped at a residual of 1.4e-6.
    let published =
        [(0.626_015_9, 0.310_262_0, tolerance::PUBLISHED_7), (0.874_193_7, 1.215_641_3, tolerance::MINIMISED)];
    assert!(residual(0.5, published[0].0, published[0].1) < 2e-7);
    assert!(residual(0.5, published[1].0, published[1].1) > 1e-6);
    let agrees = |half_gap: f64| {
        let found = intersections(&plant, &Backlash::new(1.0, half_gap).unwrap());
        assert_eq!(found.len(), 2, "{found:?}");
        found.iter().zip(published).all(|(at, (amplitude, omega, tolerance))| {
            assert!(residual(half_gap, at.amplitude, at.omega_rad_s) < tolerance::BALANCE);
            // Both are thresholds: the loop rests below and, with slope one, runs away above.
            assert_eq!(at.stable, Some(false));
            (at.amplitude - amplitude).abs() <= tolerance && (at.omega_rad_s - omega).abs() <= tolerance
        })
    };
    assert!(agrees(0.5));
    assert!(!agrees(0.5 * (1.0 + 1e-6)));
}

/// Of the relay's infinitely many intersections with a dead time one is stable, or none: where the loop with the gain N has further roots
/// in the right half plane the slope of -1/N alone says nothing.
#[test]
fn further_roots_make_an_intersection_unstable() {
    let relay = Relay::new(1.0).unwrap();
    let found = intersections(&transfer(&[1.0], &[1.0, 1.0]).with_delay(1.0).unwrap(), &relay);
    let expected = |place: usize| (Some(place == 0), Some(2 * place));
    assert!(found.len() > 10);
    assert!(found.iter().enumerate().all(|(place, at)| (at.stable, at.unstable_roots) == expected(place)), "{found:?}");
    // No gain stabilises exp(-1.2 s)/(s - 1).
    let found = intersections(&transfer(&[1.0], &[1.0, -1.0]).with_delay(1.2).unwrap(), &relay);
    assert!(!found.is_empty() && found.iter().all(|at| at.stable == Some(false)), "{found:?}");
}

/// `(s^2 + 1) factor(s)` less one is a denominator: with the gain 1 the loop has the roots of the factor besides the pair at 1 rad/s.
#[test]
fn further_roots_are_counted_as_factors_say() {
    for (factor, roots) in [
        (&[1.0, 2.0][..], 0),
        (&[1.0, -2.0], 1),
        (&[1.0, 3.0, 1.0], 0),
        (&[1.0, -0.2, 1.0], 2),
        // On the axis is not beyond it.
        (&[1.0, 1.0, 4.0, 4.0], 0),
        (&[1.0, -3.0, 2.0], 2),
    ] {
        let order = factor.len() + 1;
        let coefficient = |place: usize| factor.get(place).copied().unwrap_or(0.0);
        let product = |place: usize| coefficient(place) + if place < 2 { 0.0 } else { coefficient(place - 2) };
        let denominator: Vec<f64> =
            (0..=order).map(|place| product(place) - if place == order { 1.0 } else { 0.0 }).collect();
        let found = intersections(&transfer(&[1.0], &denominator), &Relay::new(1.0).unwrap());
        let at =
            found.iter().find(|at| (at.amplitude * PI / 4.0 - 1.0).abs() < 1e-9 && (at.omega_rad_s - 1.0).abs() < 1e-9);
        assert_eq!(at.unwrap().unstable_roots, Some(roots), "{factor:?}: {found:?}");
    }
}

/// A relay with dead zone has two amplitudes for each gain below its largest: `P = 4 C/(pi X) sqrt(1 - (d/X)^2)`.
#[test]
fn both_amplitudes_of_a_gain_that_rises_and_falls() {
    let (level, dead_zone) = (1.0, 0.3);
    let found = intersections(&transfer(&[2.0], &[1.0, 2.0, 2.0, 1.0]), &RelayDeadZone::new(level, dead_zone).unwrap());
    let amplitude = |sign: f64| {
        let k = PI / (4.0 * level) * 1.5;
        ((1.0 + sign * (1.0 - (2.0 * k * dead_zone).powi(2)).sqrt()) / (2.0 * k * k)).sqrt()
    };
    assert_eq!(found.len(), 2, "{found:?}");
    for (at, (sign, stable)) in found.iter().zip([(-1.0, false), (1.0, true)]) {
        assert!((at.amplitude / amplitude(sign) - 1.0).abs() < tolerance::BALANCE, "{at:?} {}", amplitude(sign));
        assert_eq!(at.stable, Some(stable));
    }
}

/// The phase of `exp(-s)/s` under an ideal relay: `w = pi/2 + 2 pi k`, `X = 4 C/(pi w)`, every one of them.
#[test]
fn every_turn_of_a_delay() {
    let plant = transfer(&[1.0], &[1.0, 0.0]).with_delay(1.0).unwrap();
    let relay = Relay::new(1.0).unwrap();
    let balance = HarmonicBalance::new(&plant, |sweep| relay.describing_function(sweep)).unwrap();
    let found = balance.within(1e-3..=10.0, 0.1..=50.0).unwrap().intersections().unwrap();
    assert_eq!(found.len(), 8);
    for (k, at) in found.iter().enumerate() {
        let omega = PI / 2.0 + 2.0 * PI * k as f64;
        assert!((at.omega_rad_s / omega - 1.0).abs() < tolerance::BALANCE);
        assert!((at.amplitude * PI * omega / 4.0 - 1.0).abs() < tolerance::BALANCE);
    }
}

#[test]
fn data_of_the_nyquist_plot_cross_at_the_intersection() {
    let plant = transfer(&[8.0], &[1.0, 2.0, 2.0, 1.0]);
    let saturation = Saturation::new(1.0, 1.0).unwrap();
    let response = nyquist_locus(&plant, 0.01..=100.0).unwrap();
    let inverse = negative_inverse_locus(|sweep| saturation.describing_function(sweep), 0.0, 0.1..=10.0).unwrap();
    let near = |points: &[(f64, nalgebra::Complex<f64>)]| {
        points.iter().map(|(_, z)| (z - nalgebra::Complex::new(-8.0 / 3.0, 0.0)).norm()).fold(f64::INFINITY, f64::min)
    };
    assert!(near(&response) < 0.3 && near(&inverse) < 0.3);
    assert!(inverse.iter().all(|(_, z)| z.im == 0.0 && z.re <= -1.0 + 1e-12));
}

#[test]
fn errors_have_their_numbers() {
    let plant = transfer(&[1.0], &[1.0, 1.0, 0.0]);
    let relay = RelayHysteresis::new(1.0, 0.2, 0.0).unwrap();
    let balance = || HarmonicBalance::new(&plant, |sweep| relay.describing_function(sweep)).unwrap();
    let Err(BalanceError::OutOfDomain(fault)) = balance().within(1.0..=0.5, 0.1..=1.0) else { panic!("accepted") };
    assert_eq!((fault.quantity, fault.value, fault.limit), ("highest amplitude", 0.5, Limit::Above(1.0)));
    assert!(matches!(balance().with_bias(Bias::Fixed(f64::NAN)), Err(BalanceError::OutOfDomain(_))));
    let first = balance().intersections().unwrap()[0];
    assert!(matches!(balance().with_harmonics(&relay, &first, 0), Err(BalanceError::Order { order: 0, .. })));
    // A describing function that fails other than below switching is not taken for an empty answer.
    let noisy = Custom::new(|x: f64, _| (1e6 * x * x).sin(), &[]);
    let failing = HarmonicBalance::new(&plant, |sweep| by_quadrature(&noisy, sweep)).unwrap();
    let failing = failing.within(1.0..=2.0, 0.1..=1.0).unwrap().intersections();
    assert!(matches!(failing, Err(BalanceError::Describing(_))), "{failing:?}");
}

/// The half-period that n harmonics give a relay, from Tsypkin's sum cut after the n-th.
fn cut_tsypkin(plant: &StateSpace, half_width: f64, order: usize, near: f64) -> f64 {
    let miss = |omega: f64| 4.0 / PI * tsypkin_locus(plant, omega, order.div_ceil(2)).im + half_width;
    let (mut low, mut high) = (0.8 * near, 1.2 * near);
    assert!(miss(low) * miss(high) < 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if miss(low) * miss(middle) <= 0.0 { high = middle } else { low = middle }
    }
    low
}

#[test]
fn harmonics_converge_to_the_orbit_of_a_relay() {
    let plant = transfer(&[1.0], &[1.0, 1.0, 0.0]);
    let state_space = StateSpace::realise(&plant).unwrap();
    let relay = RelayHysteresis::new(1.0, 0.2, 0.0).unwrap();
    let exact = orbits(&plant, &relay.into(), Some(0.1..=100.0)).unwrap().orbits.remove(0);
    let balance = HarmonicBalance::new(&plant, |sweep| relay.describing_function(sweep)).unwrap();
    let first = balance.intersections().unwrap()[0];
    let mut last = f64::INFINITY;
    for order in [1, 3, 7, 15, 31] {
        let many = balance.with_harmonics(&relay, &first, order).unwrap();
        let cut = cut_tsypkin(&state_space, 0.2, order, first.omega_rad_s);
        assert!((many.omega_rad_s / cut - 1.0).abs() < tolerance::BALANCE, "{order}: {} {cut}", many.omega_rad_s);
        let error = (2.0 * PI / many.omega_rad_s / exact.period_s.midpoint() - 1.0).abs();
        // The term left out is of the order of n^-3 and the tail of n^-2.
        assert!(error < 0.4 * last && error < 0.1 / (order * order) as f64, "{order}: {error}");
        assert!((many.amplitude() / exact.amplitude().midpoint() - 1.0).abs() < 0.1 / order as f64);
        last = error;
    }
    assert!(last > 1e-9, "the first harmonics alone cannot be exact: {last}");
}

#[test]
fn harmonics_converge_to_an_asymmetric_orbit() {
    let plant = transfer(&[2.0], &[0.5, 1.5, 1.0]).with_delay(0.2).unwrap();
    let relay = RelayHysteresis::new(1.0, 0.1, 0.15).unwrap();
    let disturbed = TwoLevelRelay::from(RelayHysteresis::new(1.0, 0.1, 0.15 + 0.1).unwrap());
    let orbits = orbits(&plant, &disturbed.with_reference(0.4).unwrap(), Some(0.1..=30.0)).unwrap().orbits;
    let balance = HarmonicBalance::new(&plant, |sweep| relay.describing_function(sweep))
        .unwrap()
        .with_bias(Bias::Loop { reference: 0.4, disturbance: 0.1 })
        .unwrap()
        .within(1e-2..=10.0, 0.2..=60.0)
        .unwrap();
    let found = balance.intersections().unwrap();
    assert_eq!((orbits.len(), found.len()), (1, 1), "{found:?}");
    let error = |order: usize| {
        let many = balance.with_harmonics(&relay, &found[0], order).unwrap();
        (2.0 * PI / many.omega_rad_s / orbits[0].period_s.midpoint() - 1.0).abs()
    };
    let errors = [1, 4, 16, 48].map(error);
    assert!(errors.windows(2).all(|pair| pair[1] < 0.5 * pair[0]) && errors[3] < 1e-4, "{errors:?}");
}

/// A linear plant with a saturated input; the one guard marks the output's passages through zero.
struct Saturated<'a>(&'a StateSpace, Saturation<f64>);

impl EventSystem for Saturated<'_> {
    fn rate(&self, _: f64, state: &[f64], rate: &mut [f64]) {
        let state = DVector::from_column_slice(state);
        let limit = self.1.breakpoint();
        let input = self.1.slope() * (-self.0.output(&state)).clamp(-limit, limit);
        rate.copy_from_slice(self.0.rate(&state, input).as_slice());
    }
    fn guards(&self) -> usize {
        1
    }
    fn guard(&self, _: usize, _: f64, state: &[f64]) -> f64 {
        self.0.output(&DVector::from_column_slice(state))
    }
    fn event(&mut self, _: usize, _: f64, _: &mut [f64]) {}
}

#[test]
fn harmonics_converge_to_the_integrated_orbit_of_a_saturation() {
    let plant = transfer(&[8.0], &[1.0, 2.0, 2.0, 1.0]);
    let state_space = StateSpace::realise(&plant).unwrap();
    let saturation = Saturation::new(1.0, 1.0).unwrap();
    let mut system = Saturated(&state_space, saturation);
    let integrator = Integrator { relative: 1e-11, absolute: 1e-12, steps: 1_000_000 };
    let events = integrator.run(&mut system, vec![0.1, 0.0, 0.0], 200.0, |_, _| {});
    let period = events[events.len() - 1].time_s - events[events.len() - 2].time_s;
    let balance = HarmonicBalance::new(&plant, |sweep| saturation.describing_function(sweep)).unwrap();
    let first = balance.intersections().unwrap()[0];
    let error = |order: usize| {
        let many = balance.with_harmonics(&saturation, &first, order).unwrap();
        (2.0 * PI / many.omega_rad_s / period - 1.0).abs()
    };
    // Kinks in the output make its harmonics fall as k^-2, the plant as k^-3.
    let errors = [1, 5, 21].map(error);
    let rate = |a: f64, b: f64| (a / b).powi(4);
    assert!(errors[1] < rate(1.0, 5.0) * 10.0 * errors[0] && errors[2] < rate(5.0, 21.0) * errors[1], "{errors:?}");
    assert!(errors[0] > 1e-3);
}

#[test]
fn a_memory_that_would_have_to_know_more_is_an_error() {
    // A resonance at the fifth harmonic makes the input turn inside the gap of a backlash.
    let plant = transfer(&[4.0], &[1.0, 2.0, 2.0, 1.0]).series(&TransferFunction::pade(5.0, 4).unwrap()).unwrap();
    let backlash = Backlash::new(1.0, 0.5).unwrap();
    let balance = HarmonicBalance::new(&plant, |sweep| backlash.describing_function(sweep)).unwrap();
    for at in balance.intersections().unwrap() {
        match balance.with_harmonics(&backlash, &at, 9) {
            Ok(many) => assert!((many.omega_rad_s / at.omega_rad_s - 1.0).abs() < 0.2),
            Err(error) => assert!(matches!(error, BalanceError::TurnsInMemory { .. }), "{error}"),
        }
    }
}

proptest! {
    #![proptest_config(crate::sampling::config(48))]

    /// Against the phase crossovers of the plant, found by counting signs on a fine grid, and the inverse of the gain.
    #[test]
    fn a_saturation_oscillates_at_every_crossover_beyond_minus_one(
        zeros in prop::collection::vec(0.2..3.0f64, 0..3),
        poles in prop::collection::vec(0.1..4.0f64, 4..6),
        gain in 1.0..60.0f64,
    ) {
        let factor = |plant: TransferFunction, root: f64, up: bool| {
            let part = if up { transfer(&[1.0 / root, 1.0], &[0.01, 1.0]) } else { transfer(&[1.0], &[1.0 / root, 1.0]) };
            plant.series(&part).unwrap()
        };
        let plant = zeros.iter().fold(transfer(&[gain], &[1.0]), |plant, &zero| factor(plant, zero, true));
        let plant = poles.iter().fold(plant, |plant, &pole| factor(plant, pole, false));
        let found = intersections(&plant, &Saturation::new(1.0, 1.0).unwrap());
        let grid: Vec<f64> = (0..40_000).map(|index| 1e-3 * 10f64.powf(f64::from(index) / 5000.0)).collect();
        let count = grid
            .windows(2)
            .filter(|pair| {
                let (a, b) = (plant.response(pair[0]).unwrap(), plant.response(pair[1]).unwrap());
                a.im * b.im < 0.0 && a.re < -1.0 - 1e-3
            })
            .count();
        let margin = found.iter().all(|at| at.amplitude > 1.05);
        prop_assume!(margin);
        prop_assert_eq!(found.len(), count);
        for at in &found {
            let df = by_quadrature(&Saturation::new(1.0, 1.0).unwrap(), &Sinusoid::new(0.0, at.amplitude).unwrap()).unwrap();
            let balance = plant.response(at.omega_rad_s).unwrap() * df.p + 1.0;
            prop_assert!(balance.norm() < tolerance::BALANCE);
        }
    }

    /// Under a relay with hysteresis the first harmonic gives the amplitude from the frequency (eqs. 30, 31): |N| = 4C/(pi X).
    #[test]
    fn a_relay_with_hysteresis_on_an_integrating_plant(
        time in 0.1..5.0f64,
        half_width in 0.02..0.5f64,
        delay in 0.0..1.0f64,
    ) {
        let plant = transfer(&[1.0], &[time, 1.0, 0.0]).with_delay(delay).unwrap();
        let found = intersections(&plant, &RelayHysteresis::new(1.0, half_width, 0.0).unwrap());
        prop_assert!(!found.is_empty());
        for at in &found {
            let response = plant.response(at.omega_rad_s).unwrap();
            prop_assert!((response.norm() * 4.0 / (PI * at.amplitude) - 1.0).abs() < tolerance::BALANCE);
            prop_assert!((response.im * 4.0 / PI + half_width).abs() < tolerance::BALANCE);
            prop_assert!(response.re < 0.0);
        }
        // The slowest one is the stable one.
        prop_assert_eq!(found[0].stable, Some(true));
    }
}
