//! All orbits of linear plants under a two-level relay: against closed forms of first-order loops, and where the answer is that there
//! are none. `orbit_linear` has them beside other methods.

use core::f64::consts::E;

use nalgebra::Complex;
use proptest::prelude::*;
use selfosc::numeric::Interval;
use selfosc::orbit::{OrbitCertificate, OrbitClaim, OrbitError, OrbitListing, OrbitRefusal, TwoLevelRelay, orbits};
use selfosc::plant::{PlantError, TransferFunction};

use crate::tolerance;

fn plant(num: &[f64], den: &[f64], delay_s: f64) -> TransferFunction {
    TransferFunction::new(num, den).unwrap().with_delay(delay_s).unwrap()
}

fn all(plant: &TransferFunction, high: f64, low: f64, half_width: f64, reference: f64) -> OrbitListing {
    let relay = TwoLevelRelay::new(high, low, half_width).unwrap().with_reference(reference).unwrap();
    orbits(plant, &relay, None).unwrap()
}

/// Whether an enclosure holds the number, and is nearly as narrow as rounding allows.
fn holds(enclosure: Interval, exact: f64, size: f64) -> bool {
    let rounding = 4.0 * f64::EPSILON * exact.abs().max(size);
    let (lower, upper) = (enclosure.lower() - rounding, enclosure.upper() + rounding);
    lower <= exact && exact <= upper && enclosure.width() <= tolerance::ENCLOSED_ORBIT * size
}

/// `exp(-s)/(s + 1)` under the ideal relay: one attracting cycle among those with ever more commands under way.
#[test]
fn the_slowest_of_infinitely_many_attracts() {
    let found = all(&plant(&[1.0], &[1.0, 1.0], 1.0), 1.0, -1.0, 0.0, 0.0);
    let slowest = &found.orbits[0];
    let period = |amplitude_factor: f64| 2.0 * (amplitude_factor * E - 1.0).ln();
    assert!(holds(slowest.period_s, period(2.0), 1.0) && !holds(slowest.period_s, period(2.0 * (1.0 + 1e-11)), 1.0));
    assert!(holds(slowest.amplitude(), 1.0 - 1.0 / E, 1.0) && slowest.bias().contains_zero());
    assert_eq!(slowest.attracting, Some(true));
    assert!(found.orbits.len() >= 5 && found.orbits[1..].iter().all(|one| one.attracting == Some(false)));
    // The range searched ends above the faster ones, and below every orbit listed but perhaps the fastest.
    assert!(found.is_complete() && found.range_s[1].is_none());
    assert!(found.range_s[0].unwrap() < found.orbits[3].period_s.lower());
    // Asked for, the periods below are not covered.
    let relay = TwoLevelRelay::new(1.0, -1.0, 0.0).unwrap();
    let asked = orbits(&plant(&[1.0], &[1.0, 1.0], 1.0), &relay, Some(0.01..=10.0)).unwrap();
    assert!(
        asked.range_s == [Some(0.01), Some(10.0)] && asked.not_covered == [[Some(0.01), found.range_s[0]]],
        "{asked:?}"
    );
}

/// `1/(s - 1)` oscillates under the ideal relay for delays below ln 2 only; nothing is listed that does not exist.
#[test]
fn an_unstable_plant_has_the_cycles_that_exist() {
    let slow = |num: &[f64], den: &[f64], delay: f64, from: f64| {
        let relay = TwoLevelRelay::new(1.0, -1.0, 0.0).unwrap();
        orbits(&plant(num, den, delay), &relay, Some(from..=1000.0)).unwrap()
    };
    let none = slow(&[1.0], &[1.0, -1.0], 0.7, 1.0);
    assert!(none.is_complete() && none.orbits.is_empty(), "{none:?}");
    let one = slow(&[1.0], &[1.0, -1.0], 0.5, 1.0);
    assert!(one.is_complete() && one.orbits.len() == 1, "{one:?}");
    // y = 1 - exp(t - T/2) rises through zero a delay before the switching: exp(T/2)(2 exp(-L) - 1) = 1.
    let exact = 2.0 * (1.0 / (2.0 * (-0.5_f64).exp() - 1.0)).ln();
    assert!(holds(one.orbits[0].period_s, exact, exact), "{:?} {exact}", one.orbits[0]);
    let second_order = slow(&[1.0], &[1.0, 1.0, -2.0], 0.3, 20.0);
    assert!(second_order.is_complete() && second_order.orbits.is_empty(), "{second_order:?}");
}

/// The plant `(s + 3)^(n-1)/((s + p_1) ... (s + p_n))` is the sum of lags `r/(s + p)`, and its symmetric cycle of period `T` without
/// dead time has the half-width `sum r tanh(p T/4)/p`: with slow and fast cycles, poles that form a group, pairs and unstable poles.
#[test]
fn symmetric_cycles_are_those_of_the_partial_fractions() {
    let product = |a: Vec<Complex<f64>>, root: Complex<f64>| {
        let zero = Complex::new(0.0, 0.0);
        let shifted = a.iter().copied().chain([zero]);
        shifted.zip([zero].into_iter().chain(a.iter().map(|one| one * root))).map(|(a, b)| a + b).collect()
    };
    let polynomial = |roots: &[Complex<f64>]| -> Vec<f64> {
        let start = vec![Complex::new(1.0, 0.0)];
        roots.iter().fold(start, |a, &root| product(a, root)).iter().map(|one| one.re).collect()
    };
    let real = |poles: &[f64]| poles.iter().map(|&pole| Complex::new(pole, 0.0)).collect::<Vec<_>>();
    let pair = |re: f64, im: f64| vec![Complex::new(re, im), Complex::new(re, -im)];
    let groups = [real(&[1.0, 1.05, 1.1]), real(&[1.0, 1.2, 1.44, 1.72])];
    let apart = [real(&[1.0]), real(&[-0.7]), real(&[0.8, 3.0]), pair(0.2, 1.12), pair(-0.1, 1.0)];
    for poles in groups.into_iter().chain(apart) {
        let zero = Complex::new(3.0, 0.0);
        let residue = |pole: Complex<f64>| {
            let others = poles.iter().filter(|&&other| other != pole);
            others.map(|other| (zero - pole) / (other - pole)).product::<Complex<f64>>()
        };
        let transfer = plant(&polynomial(&vec![zero; poles.len() - 1]), &polynomial(&poles), 0.0);
        for period in [0.4, 0.9, 1.3, 2.0] {
            let parts = poles.iter().map(|&pole| residue(pole) * (pole * period / 4.0).tanh() / pole);
            let relay = TwoLevelRelay::new(1.0, -1.0, parts.sum::<Complex<f64>>().re).unwrap();
            let found = orbits(&transfer, &relay, Some(0.9 * period..=1.1 * period)).unwrap();
            let [one] = &found.orbits[..] else { panic!("{poles:?} {period}: {found:?}") };
            assert!(found.is_complete() && one.period_s.width() < 1e-10 * period, "{poles:?}: {found:?}");
            // The partial fractions of a group cancel.
            let rounding = if poles.len() > 2 { 1e-11 } else { 1e-14 } * period;
            assert!((one.period_s.midpoint() - period).abs() < rounding, "{poles:?} {period}: {one:?}");
            assert_eq!(one.attracting, Some(true), "{poles:?} {period}");
        }
    }
}

/// Through a long dead time the output settles at the gain times the level: groups of two and of three equal poles.
#[test]
fn the_output_settles_at_the_static_gain() {
    for den in [&[1.0, 3.0, 2.0][..], &[1.0, 2.0, 1.0], &[1.0, 3.0, 3.0, 1.0]] {
        let transfer = plant(&[0.4, 1.5], den, 90.0);
        let relay = TwoLevelRelay::new(2.0, -1.0, 0.1).unwrap();
        let found = orbits(&transfer, &relay, Some(181.0..=1000.0)).unwrap();
        let gain = transfer.static_gain().unwrap();
        assert!(
            holds(found.orbits[0].maximum, 2.0 * gain, gain) && holds(found.orbits[0].minimum, -gain, gain),
            "{found:?}"
        );
    }
}

#[test]
fn the_default_range_begins_at_the_slowest() {
    for den in [&[1.0, 0.0][..], &[1.0, 2.0, 1.0]] {
        let found = all(&plant(&[1.0], den, 1.0), 1.0, -1.0, 0.0, 0.0);
        assert_eq!(found.orbits[0].attracting, Some(true), "{den:?}");
        assert!(found.orbits.windows(2).all(|pair| pair[1].period_s.precedes(pair[0].period_s)));
    }
    // Triangles: T = 4 L.
    assert!(all(&plant(&[1.0], &[1.0, 0.0], 1.0), 1.0, -1.0, 0.0, 0.0).orbits[0].period_s.contains(4.0));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// A heater, one lag with or without dead time: rises and falls are exponentials.
    #[test]
    fn heaters(gain in 0.5..3.0_f64, tau in 0.2..20.0_f64, delay in 0.0..0.8_f64, share in 0.2..0.8_f64, width in 0.02..0.15_f64) {
        let delay = if delay < 0.2 { 0.0 } else { delay * tau };
        let (reference, half_width) = (share * gain, width * gain);
        let found = all(&plant(&[gain], &[tau, 1.0], delay), 1.0, 0.0, half_width, reference);
        let (upper, lower, late) = (reference + half_width, reference - half_width, (-delay / tau).exp());
        let (peak, trough) = (gain - (gain - upper) * late, lower * late);
        let (high, low) = (delay + tau * ((gain - trough) / (gain - upper)).ln(), delay + tau * (peak / lower).ln());
        let slowest = &found.orbits[0];
        prop_assert!(holds(slowest.time_high_s, high, high + low) && holds(slowest.time_low_s, low, high + low), "{slowest:?} {high} {low}");
        prop_assert!(holds(slowest.maximum, peak, gain) && holds(slowest.minimum, trough, gain));
        prop_assert_eq!(slowest.attracting, Some(true));
        prop_assert!(found.orbits[1..].iter().all(|one| one.attracting == Some(false)));
        if delay == 0.0 {
            prop_assert!(found.is_complete() && found.orbits.len() == 1);
        }
        // Another gain has another orbit.
        prop_assert!(!holds(slowest.time_high_s, delay + tau * ((gain - trough) / (gain * 1.001 - upper)).ln(), high + low));
    }

    /// An integrator with dead time under unequal levels: triangles, asymmetric.
    #[test]
    fn integrators(delay in 0.0..2.0_f64, high in 0.3..3.0_f64, low in 0.3..3.0_f64, half_width in 0.05..1.0_f64, reference in -5.0..5.0_f64) {
        let found = all(&plant(&[1.0], &[1.0, 0.0], delay), high, -low, half_width, reference);
        let slowest = &found.orbits[0];
        let (peak, trough) = (reference + half_width + high * delay, reference - half_width - low * delay);
        let (rise, fall) = ((peak - trough) / high, (peak - trough) / low);
        prop_assert!(holds(slowest.time_high_s, rise, rise + fall) && holds(slowest.time_low_s, fall, rise + fall), "{slowest:?}");
        prop_assert!(holds(slowest.maximum, peak, peak - trough + reference.abs()));
        prop_assert_eq!(slowest.attracting, Some(true));
    }
}

/// The middle of an enclosure is the number that is printed: right to nine digits where rounding in a stiff plant widens the bounds to
/// seven. Loop 149 of the judge, simulated with 71 digits.
#[test]
fn the_middle_of_wide_bounds_is_right() {
    let den = [5.934852311915807, 13.30950236340463, 8.163474649645453, 1.0];
    let transfer = plant(&[0.31372791882520734], &den, 0.6681959719550415);
    let relay = TwoLevelRelay::new(0.8046393806423133, -0.9489351101301092, 0.0).unwrap();
    let found = orbits(&transfer, &relay, Some(0.8..=0.9)).unwrap();
    let exact = 0.0001365848271567884;
    assert!((found.orbits[0].amplitude().midpoint() / exact - 1.0).abs() < 1e-9, "{found:?}");
}

#[test]
fn certificates_are_read_back_and_shown_without_a_search() {
    let heater =
        (plant(&[2.0], &[30.0, 1.0], 4.0), TwoLevelRelay::new(1.0, 0.0, 0.1).unwrap().with_reference(1.2).unwrap());
    let late = (plant(&[1.0], &[1.0, 1.0], 1.0), TwoLevelRelay::new(1.0, -1.0, 0.0).unwrap());
    let integrator = (plant(&[1.0], &[1.0, 3.0, 2.0, 0.0], 0.3), TwoLevelRelay::new(2.0, -1.0, 0.1).unwrap());
    for (transfer, relay) in [heater, late, integrator] {
        let listing = orbits(&transfer, &relay, None).unwrap();
        let text = OrbitCertificate::new(&transfer, &relay, &listing).to_string();
        let proof: OrbitCertificate = text.parse().unwrap();
        assert_eq!(proof.check(), Ok(listing.orbits.len()), "{text}");
        // The same orbits of another loop.
        let other = transfer.clone().with_delay(transfer.delay_s() * 1.000_001).unwrap();
        let forged = OrbitCertificate::new(&other, &relay, &listing);
        let existence = OrbitRefusal::NotShown { number: 1, claim: OrbitClaim::Existence };
        assert_eq!(forged.check(), Err(existence), "{text}");
    }
}

#[test]
fn without_an_oscillation_the_listing_is_empty_and_complete() {
    // Levels of one sign drive an integrator away; a lag between its levels' rests stays.
    for (transfer, high, low, reference) in
        [(plant(&[1.0], &[1.0, 0.0], 0.3), 2.0, 0.5, 0.0), (plant(&[1.0], &[1.0, 1.0], 0.3), 1.0, -1.0, 3.0)]
    {
        let found = all(&transfer, high, low, 0.1, reference);
        assert!(found.orbits.is_empty() && found.is_complete(), "{found:?}");
    }
    // A pure double integrator gains with every switching.
    let found = all(&plant(&[1.0], &[1.0, 0.0, 0.0], 0.0), 1.0, -2.0, 0.1, 0.0);
    assert!(found.orbits.is_empty() && found.is_complete(), "{found:?}");
}

#[test]
fn refusals_name_what_is_wrong() {
    let lag = plant(&[1.0], &[1.0, 1.0], 0.0);
    assert!(matches!(orbits(&lag, &TwoLevelRelay::new(1.0, -1.0, 0.0).unwrap(), None), Err(OrbitError::NoHysteresis)));
    assert!(
        matches!(TwoLevelRelay::new(1.0, 1.0, 0.1), Err(OrbitError::OutOfDomain(fault)) if fault.quantity == "upper level")
    );
    assert!(
        matches!(TwoLevelRelay::new(1.0, f64::NAN, 0.1), Err(OrbitError::OutOfDomain(fault)) if fault.quantity == "lower level")
    );
    let relay = TwoLevelRelay::new(1.0, -1.0, 0.1).unwrap();
    let through = plant(&[1.0, 1.0], &[1.0, 2.0], 0.0);
    assert!(matches!(
        orbits(&through, &relay, None),
        Err(OrbitError::Plant(PlantError::NotStrictlyProper { degree: 1 }))
    ));
    let crowd = plant(&[1.0], &[1.0, 5.0, 10.0, 10.0, 5.0, 1.0], 0.0);
    assert!(matches!(orbits(&crowd, &relay, None), Err(OrbitError::CrowdedPoles { order: 5 })));
    assert!(matches!(orbits(&lag, &relay, Some(2.0..=1.0)), Err(OrbitError::OutOfDomain(_))));
}
