//! Orbits of linear plants under a relay against other methods: published values, Åström's condition, Tsypkin's series, integration.

use core::f64::consts::PI;

use nalgebra::{Complex, DMatrix, DVector};
use proptest::prelude::*;
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::{ListedOrbit, OrbitListing, TwoLevelRelay, orbits};
use selfosc::plant::{StateSpace, TransferFunction};

use crate::event_integrator::{EventSystem, Integrator, Occurrence, RelayFeedback};
use crate::tolerance;

fn plant(numerator: &[f64], denominator: &[f64], delay_s: f64) -> TransferFunction {
    TransferFunction::new(numerator, denominator).unwrap().with_delay(delay_s).unwrap()
}

/// `sum of Re G(jkw) + j Im G(jkw)/k` over the first `terms` odd k, delay included.
///
/// A symmetric oscillation of frequency w under a relay of level C and half-width x_a has
/// `(4 C/pi) Im = -x_a` and `Re < 0` in the limit of many terms (Tsypkin, *Relay Control Systems*, 1984). The
/// remainder of the imaginary part falls as `terms^-r`, with r the excess of poles over zeros, at least 2 of them.
pub(crate) fn tsypkin_locus(plant: &StateSpace, omega_rad_s: f64, terms: usize) -> Complex<f64> {
    // Smallest first.
    let odd = (0..terms).rev().map(|index| (2 * index + 1) as f64);
    odd.fold(Complex::new(0.0, 0.0), |locus, k| {
        let response = plant.response(k * omega_rad_s).unwrap();
        locus + Complex::new(response.re, response.im / k)
    })
}

fn realised(plant: &TransferFunction) -> StateSpace {
    StateSpace::realise(plant).unwrap()
}

fn relay(half_width: f64, offset: f64) -> RelayHysteresis<f64> {
    RelayHysteresis::new(1.0, half_width, offset).unwrap()
}

/// `k` simple lags with these time constants, and an integrator or not.
fn lags(times: &[f64], integrating: bool, delay_s: f64) -> TransferFunction {
    let pole = |plant: TransferFunction, denominator: &[f64]| {
        plant.series(&TransferFunction::new(&[1.0], denominator).unwrap()).unwrap()
    };
    let start = if integrating { [1.0, 0.0].as_slice() } else { [1.0].as_slice() };
    let start = TransferFunction::new(&[1.0], start).unwrap();
    let all = times.iter().fold(start, |plant, &time| pole(plant, &[time, 1.0]));
    all.with_delay(delay_s).unwrap()
}

/// The orbits of a loop in a range of periods, all of them.
fn listed(
    plant: &TransferFunction,
    relay: impl Into<TwoLevelRelay>,
    period_s: core::ops::RangeInclusive<f64>,
) -> OrbitListing {
    orbits(plant, &relay.into(), Some(period_s)).unwrap()
}

fn is_symmetric(orbit: &ListedOrbit) -> bool {
    orbit.time_high_s.intersection(orbit.time_low_s).is_some()
}

/// Integrates the loop from a state and returns the switchings of the relay.
fn simulate(
    plant: &TransferFunction,
    relay: RelayHysteresis<f64>,
    reference: f64,
    until_s: f64,
) -> (Vec<Occurrence>, (f64, f64)) {
    let plant = realised(plant);
    let rate = |x: &[f64], u: f64, rate: &mut [f64]| {
        rate.copy_from_slice(plant.rate(&DVector::from_column_slice(x), u).as_slice());
    };
    let output = |x: &[f64]| plant.output(&DVector::from_column_slice(x));
    let mut feedback = RelayFeedback::new(rate, output, relay, reference, plant.delay_s());
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let tail = 0.8 * until_s;
    let integrator = Integrator { relative: 1e-12, absolute: 1e-13, steps: 2_000_000 };
    let events = integrator.run(&mut feedback, vec![0.0; plant.order()], until_s, |time, x| {
        if time > tail {
            (low, high) = (low.min(output(x)), high.max(output(x)));
        }
    });
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

fn agree(orbit: &ListedOrbit, (high, low): (f64, f64), tolerance: f64) -> bool {
    (orbit.time_high_s.midpoint() - high).abs() <= tolerance * high
        && (orbit.time_low_s.midpoint() - low).abs() <= tolerance * low
}

#[test]
fn published_half_period() {
    let half_period = |half_width: f64| {
        let found = listed(&plant(&[1.0], &[1.0, 1.0, 0.0], 0.0), relay(half_width, 0.0), 0.01..=1000.0);
        assert!(found.is_complete() && found.orbits.len() == 1, "{found:?}");
        let orbit = &found.orbits[0];
        assert_eq!(orbit.attracting, Some(true));
        // z - tanh z = x_a with z half the half-period (exact-orbits.md, linear drag).
        let half_period = orbit.time_high_s.midpoint();
        let z = 0.5 * half_period;
        assert!((z - z.tanh() - half_width).abs() < 2e-14 * (1.0 + half_width));
        let amplitude = half_width + z.tanh() - z.tanh().ln_1p();
        assert!((orbit.amplitude().midpoint() / amplitude - 1.0).abs() < 1e-12, "{} {amplitude}", orbit.amplitude());
        assert!(orbit.bias().contains(0.0), "{}", orbit.bias());
        half_period
    };
    let published = |value: f64| (value / 1.862_223_721_734_969 - 1.0).abs() < tolerance::PERIOD;
    assert!(published(half_period(0.2)));
    assert!(half_period(1e-3) < half_period(0.2) && half_period(0.2) < half_period(5.0));
    assert!(!published(half_period(0.2 * (1.0 + 1e-12))));
}

/// The state when the plant's input becomes 1, for half a period after which it is the opposite (Åström).
fn start_of_half_period(plant: &StateSpace, half_period_s: f64) -> Option<DVector<f64>> {
    let flow = plant.flow(half_period_s);
    (DMatrix::identity(plant.order(), plant.order()) + flow.state).lu().solve(&-flow.input)
}

/// Half-periods of a range, longer than the delay, at whose ends the output passes the half-width; and whether it has not passed it
/// earlier. By the matrix exponential at samples.
fn half_periods(plant: &StateSpace, half_width: f64, range: core::ops::Range<f64>) -> Vec<(f64, bool)> {
    let output = |start: &DVector<f64>, time: f64| plant.output(&plant.flow(time).apply(start, 1.0));
    let miss = |half: f64| {
        let start = start_of_half_period(plant, half);
        start.map_or(f64::NAN, |start| output(&start, half - plant.delay_s()) - half_width)
    };
    let nodes: Vec<f64> = (0..=6000).map(|k| range.start + (range.end - range.start) * f64::from(k) / 6000.0).collect();
    let mut found = Vec::new();
    for pair in nodes.windows(2) {
        let (mut low, mut high) = (pair[0], pair[1]);
        if low <= plant.delay_s() || !(miss(low) * miss(high) <= 0.0) {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if miss(low) * miss(middle) <= 0.0 { high = middle } else { low = middle }
        }
        let passage = low - plant.delay_s();
        let start = start_of_half_period(plant, low).unwrap();
        let in_time = (0..3000).map(|k| low * f64::from(k) / 3000.0).all(|time| {
            let value = output(&start, time);
            if time < passage { value <= half_width + 1e-9 } else { value >= -half_width - 1e-9 }
        });
        found.push((low, in_time));
    }
    found
}

/// The symmetric orbits are the half-periods of Åström's condition at which the relay has not switched before; multiple poles are among
/// the plants', and lightly damped ones with many half-periods that are none.
#[test]
fn symmetric_orbits_are_those_of_astroms_condition() {
    let cases: [(&[f64], &[f64], f64, f64); 9] = [
        (&[1.0], &[1.0, 2.0, 1.0], 0.3, 0.05),
        (&[1.0], &[1.0, 3.0, 3.0, 1.0], 0.0, 0.1),
        (&[2.0], &[1.0, 2.0, 1.0, 0.0], 0.2, 0.1),
        (&[1.0], &[1.0, 0.4, 1.0], 0.0, 0.2),
        (&[-0.3, 1.0], &[1.0, 1.5, 0.7], 0.1, 0.1),
        (&[1.0], &[1.0, 1.02, 0.0202, 0.0], 0.0, 0.3),
        (&[1.0], &[1.0, 0.1, 1.0], 0.0, 0.3),
        (&[1.0], &[1.0, 0.05, 1.0], 0.0, 0.5),
        // A resonance at 12 rad/s above the cycle: 1/(s + 1)^2 + 20/(s^2 + 0.24 s + 144).
        (&[21.0, 40.24, 164.0], &[1.0, 2.24, 145.48, 288.24, 144.0], 0.0, 0.2),
    ];
    let (mut orbits, mut early) = (0, 0);
    for (num, den, delay, half_width) in cases {
        let transfer = plant(num, den, delay);
        let condition = half_periods(&realised(&transfer), half_width, 0.15..24.0);
        let found = listed(&transfer, relay(half_width, 0.0), 0.3..=48.0);
        let symmetric: Vec<&ListedOrbit> = found.orbits.iter().filter(|one| is_symmetric(one)).collect();
        let near = |half: f64| symmetric.iter().any(|one| (0.5 * one.period_s.midpoint() / half - 1.0).abs() < 1e-9);
        let within = |half: f64, [from, to]: &[Option<f64>; 2]| {
            from.is_none_or(|from| 2.0 * half >= from) && to.is_none_or(|to| 2.0 * half <= to)
        };
        let covered = |half: f64| !found.not_covered.iter().any(|range| within(half, range));
        let condition: Vec<(f64, bool)> = condition.into_iter().filter(|&(half, _)| covered(half)).collect();
        for &(half, in_time) in &condition {
            assert_eq!(near(half), in_time, "{den:?}: half-period {half} of {found:?}");
            orbits += usize::from(in_time);
            early += usize::from(!in_time);
        }
        // Half-periods shorter than the delay are not looked at.
        let halves = symmetric.iter().map(|one| 0.5 * one.period_s.midpoint());
        let slow = halves.filter(|&half| half > delay.max(0.15) && covered(half)).count();
        assert_eq!(slow, condition.iter().filter(|(_, in_time)| *in_time).count(), "{den:?}: {found:?}");
    }
    assert!(orbits >= 6 && early >= 6, "{orbits} orbits, {early} that switched before");
}

/// The multipliers of a double integrator with lag from the formula for no delay, half a period:
/// `(I - x' c/(c x')) exp(a h)`.
#[test]
fn multiplier_of_the_half_period_map() {
    let transfer = lags(&[1.0, 0.4], true, 0.0);
    let orbit = listed(&transfer, relay(0.3, 0.0), 0.1..=100.0).orbits.remove(0);
    let (plant, half_period) = (realised(&transfer), orbit.time_high_s.midpoint());
    let start = start_of_half_period(&plant, half_period).unwrap();
    let rate = plant.rate(&-start, 1.0);
    let identity = DMatrix::<f64>::identity(3, 3);
    let map = (identity - &rate * plant.c() / plant.output(&rate)) * plant.flow(half_period).state;
    let mut half: Vec<f64> = map.complex_eigenvalues().iter().map(|value| value.norm()).collect();
    half.sort_by(|a, b| b.total_cmp(a));
    let found = &orbit.multipliers;
    assert!((found[0].norm() - half[0] * half[0]).abs() < 1e-12, "{found:?} {half:?}");
    assert!((found[0].norm() - half[0]).abs() > 1e-3);
}

#[test]
fn integrating_plants_keep_symmetry_and_shift_with_the_reference() {
    let plant = lags(&[1.0, 0.5], true, 0.3);
    let one = |relay: TwoLevelRelay| {
        let mut found = listed(&plant, relay, 2.0..=100.0);
        assert_eq!(found.orbits.len(), 1);
        found.orbits.remove(0)
    };
    let base = TwoLevelRelay::from(relay(0.1, 0.0));
    let (a, b) = (one(base), one(base.with_reference(2.5).unwrap()));
    assert!(((b.bias() - a.bias()).midpoint() - 2.5).abs() < 1e-12);
    assert!((a.time_high_s - a.time_low_s).contains(0.0) && a.time_high_s.width() < 1e-12);
    // A constant input makes it asymmetric by exactly what balances it: delta = -C (t_plus - t_minus)/T.
    let disturbed = one(relay(0.1, 0.3).into());
    let estimate = -((disturbed.time_high_s - disturbed.time_low_s) / disturbed.period_s).midpoint();
    assert!((estimate - 0.3).abs() < 1e-12);
    // Too much of it drives the plant away.
    assert!(listed(&plant, TwoLevelRelay::new(0.0, -2.0, 0.1).unwrap(), 0.1..=100.0).orbits.is_empty());
}

/// Three integrators and two zeros are stable only where the gain is high, and a relay's gain falls with the amplitude.
#[test]
fn a_repelling_cycle_is_not_called_attracting() {
    let found = listed(&plant(&[1.0, 2.0, 1.0], &[1.0, 0.0, 0.0, 0.0], 0.0), relay(0.05, 0.0), 0.5..=50.0);
    assert!(found.orbits.iter().any(|orbit| orbit.attracting == Some(false)), "{found:?}");
}

#[test]
fn a_delay_longer_than_half_a_period() {
    // At the resonance the delay adds a turn and a quarter to the plant's quarter.
    let plant = plant(&[1.0], &[1.0, 0.1, 1.0], 2.5 * PI);
    let relay = relay(0.1, 0.0);
    let found = listed(&plant, relay, 1.0..=60.0);
    let (events, _) = simulate(&plant, relay, 0.0, 600.0);
    let times = last_times(&events);
    let there = found.orbits.iter().find(|orbit| agree(orbit, times, tolerance::ORBIT_INTEGRATION));
    let there = there.unwrap_or_else(|| panic!("{times:?} {found:#?}"));
    assert_eq!(there.attracting, Some(true));
    assert!(plant.delay_s() > there.time_high_s.upper(), "{}", there.time_high_s);
}

/// `y' = y + u` is bounded only within `|y| < 1`: one cycle, from `2 exp(h - T_d)/(1 + exp h) = 1 + x_a`.
#[test]
fn an_unstable_plant() {
    let (half_width, delay) = (0.2f64, 0.1f64);
    let found = listed(&plant(&[1.0], &[1.0, -1.0], delay), relay(half_width, 0.0), 0.05..=100.0);
    assert!(found.is_complete() && found.orbits.len() == 1, "{found:#?}");
    let half_period = -(2.0 * (-delay).exp() / (1.0 + half_width) - 1.0).ln();
    assert!((found.orbits[0].time_high_s.midpoint() - half_period).abs() < 1e-13, "{half_period}");
}

/// Fifty switchings of 1/(s(s + 1)) from a state on the cycle, against multiples of the exact half-period.
#[test]
fn switching_times_of_the_integrator() {
    let half_period = 1.862_223_721_734_969f64;
    let worst = |relative: f64| {
        let rate = |x: &[f64], u: f64, rate: &mut [f64]| (rate[0], rate[1]) = (x[1], u - x[1]);
        let mut feedback = RelayFeedback::new(rate, |x: &[f64]| x[0], relay(0.2, 0.0), 0.0, 0.0);
        let start = vec![-0.2, -(0.5 * half_period).tanh()];
        let integrator = Integrator { relative, absolute: 0.01 * relative, steps: 1_000_000 };
        let events = integrator.run(&mut feedback, start, 50.5 * half_period, |_, _| {});
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
        let integrator = Integrator { relative: 1e-8, absolute: 1e-10, steps: 10_000 };
        let events = integrator.run(&mut Cosine(excess), start, 6.0, |_, _| {});
        assert_eq!(events.len(), 1, "{excess}");
        let exact = 1.5 * PI - (1.0 - excess).acos();
        assert!((events[0].time_s - exact).abs() < 1e-4, "{} {exact}", events[0].time_s);
    }
}

/// Time constants 2 to 15 % apart, whose shares of the output cancel: the orbit is found, to the last digits, where integration ends.
#[test]
fn poles_near_each_other_are_no_hindrance() {
    for (times, half_width) in [([1.659, 1.706, 1.955], 0.155), ([1.0, 1.05, 1.1], 0.1), ([1.0, 1.02, 1.04], 0.1)] {
        let plant = lags(&times, true, 0.0);
        let found = listed(&plant, relay(half_width, 0.0), 0.05..=400.0);
        assert!(found.is_complete(), "{times:?} {:?}", found.not_covered);
        let [orbit] = &found.orbits[..] else { panic!("{times:?}: {} orbits", found.orbits.len()) };
        assert!(orbit.period_s.width() < 1e-12 * orbit.period_s.midpoint(), "{times:?} {}", orbit.period_s);
        assert_eq!(orbit.attracting, Some(true));
        let (events, _) = simulate(&plant, relay(half_width, 0.0), 0.0, 250.0);
        assert!(agree(orbit, last_times(&events), tolerance::ORBIT_INTEGRATION), "{times:?}");
    }
}

/// Five poles in a row, each 15 % from the next, are too many for one group, and no reason to refuse.
#[test]
fn poles_in_a_row_are_divided() {
    let times: Vec<f64> = (0..5).map(|at| 1.15_f64.powi(at)).collect();
    let found = orbits(&lags(&times, false, 0.0), &relay(0.1, 0.0).into(), Some(20.0..=40.0));
    assert!(found.is_ok_and(|found| found.is_complete()));
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
        let found = listed(&plant, relay(half_width, 0.0), 0.05..=400.0).orbits;
        prop_assert!(!found.is_empty());
        for orbit in found.iter().filter(|orbit| is_symmetric(orbit)) {
            let locus = |omega: f64| tsypkin_locus(&realised(&plant), omega, 4000);
            let omega = 2.0 * PI / orbit.period_s.midpoint();
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
        let two_level = TwoLevelRelay::from(relay).with_reference(reference).unwrap();
        let orbits = listed(&plant, two_level, 0.1..=60.0).orbits;
        let (events, (low, high)) = simulate(&plant, relay, reference, 250.0);
        let measured = last_times(&events);
        let found = orbits.iter().find(|orbit| agree(orbit, measured, tolerance::ORBIT_INTEGRATION));
        prop_assert!(found.is_some(), "{:?} not among {:#?}", measured, orbits);
        if let Some(orbit) = found {
            prop_assert!(orbit.attracting != Some(false));
            prop_assert!(orbit.minimum.lower() <= low + 1e-9 && orbit.maximum.upper() >= high - 1e-9);
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
        let orbit = listed(&plant, relay, 0.1..=60.0).orbits.remove(0);
        let (events, _) = simulate(&plant, relay, 0.0, 12.0 * orbit.period_s.midpoint());
        let deviations: Vec<f64> = events
            .windows(2)
            .map(|pair| pair[1].time_s - pair[0].time_s - orbit.time_high_s.midpoint())
            .step_by(2)
            .collect();
        let ratio = deviations
            .windows(2)
            .find(|pair| pair[0].abs() < 1e-4 && pair[1].abs() > 1e-9)
            .map(|pair| pair[1] / pair[0]);
        let largest = orbit.multipliers[0];
        let next = orbit.multipliers.get(1).map_or(0.0, |next| next.norm());
        prop_assume!(ratio.is_some() && largest.im == 0.0 && largest.re.abs() > 5.0 * next);
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
