//! Limit cycles of linear plants under a relay: published values, Tsypkin's series, integration.

use core::f64::consts::PI;

use nalgebra::{DMatrix, DVector, RowDVector};
use proptest::prelude::*;
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::integrate::{EventSystem, Integrator, Occurrence, RelayFeedback};
use selfosc::orbit::{OrbitError, RelayLoop, RelayOrbit, tsypkin_locus};
use selfosc::plant::{StateSpace, TransferFunction};

use crate::tolerance;

fn plant(numerator: &[f64], denominator: &[f64], delay_s: f64) -> StateSpace {
    let transfer = TransferFunction::new(numerator, denominator).unwrap().with_delay(delay_s).unwrap();
    StateSpace::realise(&transfer).unwrap()
}

fn relay(half_width: f64, offset: f64) -> RelayHysteresis<f64> {
    RelayHysteresis::new(1.0, half_width, offset).unwrap()
}

/// `k` simple lags with these time constants, and an integrator or not.
fn lags(times: &[f64], integrating: bool, delay_s: f64) -> StateSpace {
    let pole = |plant: TransferFunction, denominator: &[f64]| {
        plant.series(&TransferFunction::new(&[1.0], denominator).unwrap()).unwrap()
    };
    let start = if integrating { [1.0, 0.0].as_slice() } else { [1.0].as_slice() };
    let start = TransferFunction::new(&[1.0], start).unwrap();
    let all = times.iter().fold(start, |plant, &time| pole(plant, &[time, 1.0]));
    StateSpace::realise(&all.with_delay(delay_s).unwrap()).unwrap()
}

/// Integrates the loop from a state and returns the switchings of the relay.
fn simulate(
    plant: &StateSpace,
    relay: RelayHysteresis<f64>,
    reference: f64,
    until_s: f64,
) -> (Vec<Occurrence>, (f64, f64)) {
    let rate = |x: &[f64], u: f64, rate: &mut [f64]| {
        rate.copy_from_slice(plant.rate(&DVector::from_column_slice(x), u).as_slice());
    };
    let output = |x: &[f64]| plant.output(&DVector::from_column_slice(x));
    let mut feedback = RelayFeedback::new(rate, output, relay, reference, plant.delay_s()).unwrap();
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let tail = 0.8 * until_s;
    let events = Integrator::new(1e-12, 1e-13, 2_000_000)
        .unwrap()
        .run(&mut feedback, vec![0.0; plant.order()], until_s, |time, x| {
            if time > tail {
                (low, high) = (low.min(output(x)), high.max(output(x)));
            }
        })
        .unwrap();
    (events.into_iter().filter(|event| event.index == 0).collect(), (low, high))
}

/// The last two times between switchings: with positive and with negative command, in this order.
fn last_times(events: &[Occurrence]) -> (f64, f64) {
    let times: Vec<f64> = events.iter().map(|event| event.time_s).collect();
    let last = times.len() - 1;
    let (a, b) = (times[last] - times[last - 1], times[last - 1] - times[last - 2]);
    // The command starts positive: events 0, 2, ... make it negative.
    if last.is_multiple_of(2) { (a, b) } else { (b, a) }
}

fn agree(orbit: &RelayOrbit, (positive, negative): (f64, f64), tolerance: f64) -> bool {
    (orbit.time_positive_s() - positive).abs() <= tolerance * positive
        && (orbit.time_negative_s() - negative).abs() <= tolerance * negative
}

#[test]
fn published_half_period() {
    let half_period = |half_width: f64| {
        let found = RelayLoop::new(plant(&[1.0], &[1.0, 1.0, 0.0], 0.0), relay(half_width, 0.0));
        let all = found.orbits(0.01..=1000.0).unwrap();
        let symmetric = found.symmetric_orbits(0.01..=1000.0).unwrap();
        assert_eq!((all.len(), symmetric.len()), (1, 1));
        for orbit in [&all[0], &symmetric[0]] {
            assert_eq!(orbit.is_stable(), Some(true));
            // z - tanh z = x_a with z half the half-period (exact-orbits.md, linear drag).
            let z = 0.5 * orbit.time_positive_s();
            assert!((z - z.tanh() - half_width).abs() < 1e-15);
            let amplitude = half_width + z.tanh() - z.tanh().ln_1p();
            assert!((orbit.amplitude() - amplitude).abs() < 1e-14, "{} {amplitude}", orbit.amplitude());
            assert!(orbit.bias().abs() < 1e-14);
        }
        all[0].time_positive_s()
    };
    let published = |value: f64| (value / 1.862_223_721_734_969 - 1.0).abs() < tolerance::PERIOD;
    assert!(published(half_period(0.2)));
    assert!(!published(half_period(0.2 * (1.0 + 1e-12))));
}

/// The second multiplier of a double integrator with lag from the formula for no delay, half a period:
/// `(I - x' c/(c x')) exp(a h)`.
#[test]
fn multiplier_of_the_half_period_map() {
    let plant = lags(&[1.0, 0.4], true, 0.0);
    let orbit = RelayLoop::new(plant.clone(), relay(0.3, 0.0)).symmetric_orbits(0.1..=100.0).unwrap().remove(0);
    let flow = plant.flow(orbit.time_positive_s());
    let identity = DMatrix::<f64>::identity(3, 3);
    let start = (&identity + &flow.state).lu().solve(&-flow.input).unwrap();
    let rate = plant.rate(&-start, 1.0);
    let map = (identity - &rate * plant.c() / plant.output(&rate)) * flow.state;
    let mut half: Vec<f64> = map.complex_eigenvalues().iter().map(|value| value.norm()).collect();
    half.sort_by(|a, b| b.total_cmp(a));
    let found = orbit.multipliers();
    assert!((found[0].norm() - half[0] * half[0]).abs() < 1e-12, "{found:?} {half:?}");
    assert!((found[0].norm() - half[0]).abs() > 1e-3);
}

#[test]
fn integrating_plants_keep_symmetry_and_shift_with_the_reference() {
    let plant = lags(&[1.0, 0.5], true, 0.3);
    let base = RelayLoop::new(plant.clone(), relay(0.1, 0.0));
    let shifted = base.clone().with_reference(2.5).unwrap();
    let (a, b) = (base.orbits(0.1..=100.0).unwrap(), shifted.orbits(0.1..=100.0).unwrap());
    assert_eq!((a.len(), b.len()), (1, 1));
    assert!((b[0].bias() - a[0].bias() - 2.5).abs() < 1e-12);
    assert!((a[0].time_positive_s() - a[0].time_negative_s()).abs() < 1e-13);
    // A disturbance makes it asymmetric by exactly what balances it: delta = -C (t_plus - t_minus)/T.
    let disturbed = base.clone().with_disturbance(0.3).unwrap();
    let orbit = disturbed.orbits(0.1..=100.0).unwrap().remove(0);
    let estimate = -(orbit.time_positive_s() - orbit.time_negative_s()) / orbit.period_s();
    assert!((estimate - 0.3).abs() < 1e-14);
    assert!(matches!(disturbed.symmetric_orbits(0.1..=100.0), Err(OrbitError::NotSymmetric { .. })));
    // Too much of it drives the plant away.
    let away = base.with_disturbance(-1.0).unwrap().orbits(0.1..=100.0);
    assert!(matches!(away, Err(OrbitError::Drift { .. })));
}

#[test]
fn a_delay_longer_than_half_a_period() {
    // At the resonance the delay adds a turn and a quarter to the plant's quarter.
    let plant = plant(&[1.0], &[1.0, 0.1, 1.0], 2.5 * PI);
    let relay = relay(0.1, 0.0);
    let orbits = RelayLoop::new(plant.clone(), relay).symmetric_orbits(1.0..=60.0).unwrap();
    let (events, _) = simulate(&plant, relay, 0.0, 600.0);
    let times = last_times(&events);
    let attracting: Vec<&RelayOrbit> = orbits.iter().filter(|orbit| orbit.is_stable() == Some(true)).collect();
    assert!(attracting.iter().any(|orbit| agree(orbit, times, tolerance::ORBIT_INTEGRATION)), "{times:?} {orbits:#?}");
    let there = attracting.iter().find(|orbit| agree(orbit, times, tolerance::ORBIT_INTEGRATION)).unwrap();
    assert!(plant.delay_s() > there.time_positive_s(), "{}", there.time_positive_s());
}

/// A resonance above the cycle makes the output pass the level early: the candidate of Tsypkin's condition is no cycle.
#[test]
fn earlier_switching_is_seen() {
    // 1/(s + 1)^2 beside a resonance at 12 rad/s with damping 0.01.
    let candidate_count = |gain: f64| {
        let a = DMatrix::from_row_slice(
            4,
            4,
            &[-1.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, -0.24, -144.0, 0.0, 0.0, 1.0, 0.0],
        );
        let b = DVector::from_column_slice(&[1.0, 0.0, 1.0, 0.0]);
        let c = RowDVector::from_row_slice(&[0.0, 1.0, 0.0, gain]);
        let plant = StateSpace::new(a, b, c).unwrap();
        let orbits = RelayLoop::new(plant.clone(), relay(0.2, 0.0)).symmetric_orbits(0.3..=20.0).unwrap();
        let condition = |period: f64| 4.0 / PI * tsypkin_locus(&plant, 2.0 * PI / period, 100).unwrap().im + 0.2;
        let periods: Vec<f64> = (0..4000).map(|index| 0.3 + 19.7 * f64::from(index) / 4000.0).collect();
        let candidates = periods.windows(2).filter(|pair| condition(pair[0]) * condition(pair[1]) < 0.0).count();
        (orbits.len(), candidates)
    };
    let (orbits, candidates) = candidate_count(0.0);
    assert_eq!((orbits, candidates), (1, 1));
    let (orbits, candidates) = candidate_count(20.0);
    assert!(orbits < candidates, "{orbits} of {candidates}");
}

/// `y' = y + u` is bounded only within `|y| < 1`: one cycle, from `2 exp(h - T_d)/(1 + exp h) = 1 + x_a`.
#[test]
fn an_unstable_plant() {
    let (half_width, delay) = (0.2f64, 0.1f64);
    let orbits =
        RelayLoop::new(plant(&[1.0], &[1.0, -1.0], delay), relay(half_width, 0.0)).orbits(0.05..=100.0).unwrap();
    assert_eq!(orbits.len(), 1, "{orbits:#?}");
    let half_period = -(2.0 * (-delay).exp() / (1.0 + half_width) - 1.0).ln();
    assert!((orbits[0].time_positive_s() - half_period).abs() < 1e-13, "{half_period}");
}

/// Fifty switchings of 1/(s(s + 1)) from a state on the cycle, against multiples of the exact half-period.
#[test]
fn switching_times_of_the_integrator() {
    let half_period = 1.862_223_721_734_969f64;
    let worst = |relative: f64| {
        let rate = |x: &[f64], u: f64, rate: &mut [f64]| (rate[0], rate[1]) = (x[1], u - x[1]);
        let mut feedback = RelayFeedback::new(rate, |x: &[f64]| x[0], relay(0.2, 0.0), 0.0, 0.0).unwrap();
        let start = vec![-0.2, -(0.5 * half_period).tanh()];
        let events = Integrator::new(relative, 0.01 * relative, 1_000_000)
            .unwrap()
            .run(&mut feedback, start, 50.5 * half_period, |_, _| {})
            .unwrap();
        assert_eq!(events.len(), 50);
        let error = |(k, event): (usize, &Occurrence)| (event.time_s - (k + 1) as f64 * half_period).abs();
        events.iter().enumerate().map(error).fold(0.0, f64::max)
    };
    let (coarse, fine) = (worst(1e-6), worst(1e-12));
    assert!(fine < 1e-10 && coarse < 1e-4 && fine < 1e-4 * coarse, "{coarse:e} {fine:e}");
}

/// A cosine is above `1 - 10^-k` for a time that is shorter than a step: the passage is seen all the same.
#[test]
fn short_excursions_past_a_guard() {
    struct Cosine(f64);
    impl EventSystem for Cosine {
        fn rate(&self, _: f64, x: &[f64], rate: &mut [f64]) {
            (rate[0], rate[1]) = (x[1], -x[0]);
        }
        fn guards(&self) -> usize {
            1
        }
        fn guard(&self, _: usize, _: f64, x: &[f64]) -> f64 {
            x[0] - (1.0 - self.0)
        }
        fn event(&mut self, _: usize, _: f64, _: &mut [f64]) {}
    }
    for excess in [1e-2, 1e-3, 1e-4, 1e-5] {
        let start = vec![0.0, -1.0];
        let events =
            Integrator::new(1e-8, 1e-10, 10_000).unwrap().run(&mut Cosine(excess), start, 6.0, |_, _| {}).unwrap();
        assert_eq!(events.len(), 1, "{excess}");
        let exact = 1.5 * PI - (1.0 - excess).acos();
        assert!((events[0].time_s - exact).abs() < 1e-4, "{} {exact}", events[0].time_s);
    }
}

#[test]
fn bad_ranges_are_refused() {
    let base = RelayLoop::new(lags(&[1.0, 1.0], false, 0.0), relay(0.1, 0.0));
    assert!(matches!(base.orbits(1.0..=1.0), Err(OrbitError::OutOfDomain(_))));
    assert!(matches!(base.orbits(-1.0..=1.0), Err(OrbitError::OutOfDomain(_))));
    let delayed = RelayLoop::new(lags(&[1.0, 1.0], false, 1e6), relay(0.1, 0.0));
    assert!(matches!(delayed.orbits(1e-3..=1.0), Err(OrbitError::TooManySamples { .. })));
}

proptest! {
    #![proptest_config(crate::sampling::config(24))]

    #[test]
    fn symmetric_orbits_meet_tsypkins_condition(
        times in prop::collection::vec(0.05..2.0f64, 2..4),
        integrating: bool,
        half_width in 0.01..0.4f64,
        delay in prop::option::of(0.05..2.0f64),
    ) {
        let plant = lags(&times, integrating, delay.unwrap_or(0.0));
        let orbits = RelayLoop::new(plant.clone(), relay(half_width, 0.0)).symmetric_orbits(0.05..=400.0).unwrap();
        prop_assert!(!orbits.is_empty());
        for orbit in &orbits {
            let locus = |omega: f64| tsypkin_locus(&plant, omega, 4000).unwrap();
            let omega = 2.0 * PI / orbit.period_s();
            let meets = |omega: f64| {
                let scale = plant.response(omega).unwrap().norm();
                (4.0 / PI * locus(omega).im + half_width).abs() <= tolerance::TSYPKIN * scale
            };
            prop_assert!(meets(omega));
            prop_assert!(!meets(omega * 1.001));
        }
    }

    #[test]
    fn orbits_are_where_integration_ends(
        times in prop::collection::vec(0.3..2.0f64, 2..4),
        integrating: bool,
        half_width in 0.02..0.3f64,
        offset in -0.4..0.4f64,
        reference in -0.2..0.2f64,
        delay in prop::option::of(0.05..1.0f64),
    ) {
        let plant = lags(&times, integrating, delay.unwrap_or(0.0));
        let relay = relay(half_width, offset);
        let orbits =
            RelayLoop::new(plant.clone(), relay).with_reference(reference).unwrap().orbits(0.1..=60.0).unwrap();
        let (events, (low, high)) = simulate(&plant, relay, reference, 250.0);
        let measured = last_times(&events);
        let found = orbits.iter().find(|orbit| agree(orbit, measured, tolerance::ORBIT_INTEGRATION));
        prop_assert!(found.is_some(), "{:?} not among {:#?}", measured, orbits);
        if let Some(orbit) = found {
            prop_assert!(orbit.is_stable() != Some(false));
            prop_assert!(orbit.minimum() <= low + 1e-9 && orbit.maximum() >= high - 1e-9);
            prop_assert!(!agree(orbit, (measured.0 * 1.0001, measured.1), tolerance::ORBIT_INTEGRATION));
        }
    }

    #[test]
    fn deviations_decay_with_the_largest_multiplier(
        times in prop::collection::vec(0.5..2.0f64, 2..3),
        half_width in 0.05..0.3f64,
        delay in prop::option::of(0.05..0.6f64),
    ) {
        let plant = lags(&times, true, delay.unwrap_or(0.0));
        let relay = relay(half_width, 0.0);
        let orbit = RelayLoop::new(plant.clone(), relay).orbits(0.1..=60.0).unwrap().remove(0);
        let (events, _) = simulate(&plant, relay, 0.0, 12.0 * orbit.period_s());
        let deviations: Vec<f64> = events
            .windows(2)
            .map(|pair| pair[1].time_s - pair[0].time_s - orbit.time_positive_s())
            .step_by(2)
            .collect();
        let ratio = deviations
            .windows(2)
            .find(|pair| pair[0].abs() < 1e-4 && pair[1].abs() > 1e-9)
            .map(|pair| pair[1] / pair[0]);
        let largest = orbit.multipliers()[0];
        prop_assume!(ratio.is_some() && largest.im == 0.0 && largest.re.abs() > 5.0 * orbit.multipliers()[1].norm());
        let decays = |multiplier: f64| (ratio.unwrap_or(0.0) / multiplier - 1.0).abs() < tolerance::DECAY;
        prop_assert!(decays(largest.re), "{ratio:?} {largest}");
        prop_assert!(!decays(1.1 * largest.re));
    }
}

/// Chains of integrators have no size on their diagonal for the QR algorithm to measure by.
#[test]
fn integrators_have_their_eigenvalues_at_zero() {
    for order in 1..=5 {
        let mut denominator = vec![0.0; order + 1];
        denominator[0] = 1.0;
        let poles = TransferFunction::new(&[1.0], &denominator).unwrap().poles().unwrap();
        // A defect of order n turns rounding into its n-th root.
        let rounding = (16.0 * f64::EPSILON).powf(1.0 / order as f64);
        assert!(poles.len() == order && poles.iter().all(|pole| pole.norm() < rounding), "{poles:?}");
    }
}
