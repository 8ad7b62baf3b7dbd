//! Oscillations proved to exist, against harmonic balance with 397 harmonics and integration, which share nothing with the proof.

use std::sync::OnceLock;

use selfosc::balance::{
    CannotTell, ExistenceError, HarmonicBalance, HarmonicOrders, LipschitzLoop, OddCharacteristic, Oscillations,
    ProvedOscillation,
};
use selfosc::describing::{Entry, Setting};
use selfosc::numeric::Interval;
use selfosc::plant::TransferFunction;
use serde::Deserialize;
use serde_json::{Value, json};

use crate::tolerance;

/// A loop of `fixtures/oscillations.json` and the oscillations that it has.
#[derive(Deserialize)]
struct Truth {
    name: String,
    num: Vec<f64>,
    den: Vec<f64>,
    delay: f64,
    nonlinearity: String,
    settings: Vec<(String, f64)>,
    /// Of each, by every method: amplitude, frequency, and the relative uncertainty of both.
    oscillations: Vec<Vec<[f64; 3]>>,
}

/// Amplitude up to which the fixture lists all oscillations found.
const LISTED: f64 = 15.0;

impl Truth {
    fn plant(&self) -> TransferFunction {
        TransferFunction::new(&self.num, &self.den).unwrap().with_delay(self.delay).unwrap()
    }

    fn characteristic(&self) -> OddCharacteristic {
        let (entry, values) = self.entry();
        OddCharacteristic::from_catalogue(entry.name, &values).unwrap()
    }

    fn entry(&self) -> (&'static Entry, Vec<f64>) {
        let entry = Entry::find(&self.nonlinearity).unwrap();
        let settings: Vec<(String, Setting)> =
            self.settings.iter().map(|(name, value)| (name.clone(), Setting::Number(*value))).collect();
        let values = entry.values(&settings).unwrap();
        (entry, values)
    }

    fn found(&self) -> Oscillations {
        let (entry, values) = self.entry();
        let (plant, characteristic) = (self.plant(), entry.build::<f64>(&values).unwrap());
        let balance = HarmonicBalance::new(&plant, |sweep| characteristic.describing_function(sweep)).unwrap();
        let intersections = balance.intersections().unwrap();
        let control_loop = LipschitzLoop::new(&plant, self.characteristic()).unwrap();
        let found = control_loop.oscillations(&balance.omega_rad_s(), &intersections);
        assert_eq!(found.at.len(), intersections.len(), "{}", self.name);
        found
    }

    /// Largest relative half-width of the amplitude that the class of the loop is promised.
    fn promised(&self) -> f64 {
        match (self.nonlinearity.as_str(), self.den.len() - self.num.len()) {
            ("tanh" | "polynomial", _) => tolerance::EXISTENCE_SMOOTH,
            (_, 3..) => tolerance::EXISTENCE_KINKED,
            _ => tolerance::EXISTENCE_KINKED_LOW_DEGREE,
        }
    }
}

fn truths() -> &'static [Truth] {
    static TRUTHS: OnceLock<Vec<Truth>> = OnceLock::new();
    TRUTHS.get_or_init(|| serde_json::from_str(include_str!("../../fixtures/oscillations.json")).unwrap())
}

/// Whether the box holds the oscillation as every method has it.
fn holds(proved: &ProvedOscillation, by_methods: &[[f64; 3]]) -> bool {
    by_methods.iter().all(|&[amplitude, omega, uncertainty]| {
        let about = |bounds: Interval, value: f64| {
            bounds.lower() <= value * (1.0 + uncertainty) && value * (1.0 - uncertainty) <= bounds.upper()
        };
        about(proved.amplitude(), amplitude) && about(proved.omega_rad_s(), omega)
    })
}

#[test]
fn every_oscillation_of_thirty_loops_is_held_by_a_narrow_box() {
    assert_eq!(truths().len(), 30);
    for truth in truths() {
        let found = truth.found();
        for oscillation in &truth.oscillations {
            assert!(
                found.proved.iter().any(|one| holds(one, oscillation)),
                "{}: {oscillation:?} is in no box",
                truth.name
            );
        }
        for proved in &found.proved {
            let amplitude = proved.amplitude();
            let relative = amplitude.radius() / amplitude.midpoint();
            assert!(relative <= truth.promised(), "{}: {relative:e}", truth.name);
            let known = truth.oscillations.iter().any(|one| holds(proved, one));
            assert!(known || amplitude.midpoint() > LISTED, "{}: nothing is known at {amplitude}", truth.name);
        }
    }
}

/// A document with one of its numbers changed.
fn changed(proved: &ProvedOscillation, change: impl Fn(&mut Value)) -> Result<(), ExistenceError> {
    let mut document = serde_json::to_value(proved).unwrap();
    change(&mut document);
    document.to_string().parse::<ProvedOscillation>()?.check()
}

fn scale(value: &mut Value, factor: f64) {
    match value {
        Value::Array(entries) => entries.iter_mut().for_each(|entry| scale(entry, factor)),
        number => *number = json!(number.as_f64().unwrap() * factor),
    }
}

fn add(value: &mut Value, amount: f64) {
    *value = json!(value.as_f64().unwrap() + amount);
}

#[test]
fn a_certificate_is_accepted_and_false_ones_are_refused() {
    for name in [
        "saturation, four lags",
        "tanh, one lag and dead time",
        "cubic x^3 - 2 x, gain 1",
        "dead zone and saturation, at the fold",
    ] {
        let truth = truths().iter().find(|truth| truth.name == name).unwrap();
        for proved in truth.found().proved {
            assert_eq!(changed(&proved, |_| ()), Ok(()), "{name}");
            let (amplitude, omega) = (proved.amplitude().width(), proved.omega_rad_s().width());
            let falsehoods: [(&str, &dyn Fn(&mut Value)); 9] = [
                ("amplitude off by three widths", &|d| add(&mut d["harmonics"][0][0], 3.0 * amplitude)),
                ("frequency off by three widths", &|d| add(&mut d["omega_rad_s"], 3.0 * omega)),
                ("a tenth of the box", &|d| {
                    scale(&mut d["radii"], 0.1);
                    scale(&mut d["omega_radius_rad_s"], 0.1);
                }),
                ("gain off by 0.1 %", &|d| scale(&mut d["plant"]["numerator"], 1.001)),
                ("dead time off by 0.1 ms", &|d| add(&mut d["plant"]["delay_s"], 1e-4)),
                ("third harmonic of the other sign", &|d| scale(&mut d["harmonics"][1], -1.0)),
                ("no remainder", &|d| d["remainder"] = json!(0.0)),
                ("a harmonic without radius", &|d| d["radii"][2] = json!([0.0, 0.0])),
                ("amplitude below zero", &|d| scale(&mut d["harmonics"][0], -1.0)),
            ];
            for (what, falsehood) in falsehoods {
                assert!(changed(&proved, falsehood).is_err(), "{name}: {what}");
            }
        }
    }
}

/// A loop against Theorem 2 or 3 and its oscillation as the judge simulates it with 71 digits (`describing counterexamples` of
/// `tests/oscillations`).
#[derive(Deserialize)]
struct Simulated {
    name: String,
    gain: f64,
    period_s: f64,
    maximum: f64,
    minimum: f64,
    mean: f64,
    first: f64,
    second: f64,
}

/// Of each loop of the fixture: the other coefficients of the plant, the characteristic, and where the search begins.
fn proved_counterexamples() -> Vec<(Simulated, ProvedOscillation)> {
    let text = include_str!("../../fixtures/counterexamples.json");
    let simulated: Vec<Simulated> = serde_json::from_str(text).unwrap();
    let kinked = |kinks: &[f64], slopes: &[f64]| OddCharacteristic::PiecewiseLinear {
        kinks: kinks.to_vec(),
        slopes: slopes.to_vec(),
    };
    let cubic = || OddCharacteristic::from_catalogue("polynomial", &[0.0, -2.0, 0.0, 1.0]).unwrap();
    let lags = [1.0, 2.0, 1.0, 0.0];
    let loops = [
        (lags, kinked(&[0.5, 2.0], &[-1.0, 2.0, 0.0]), [0.7, 0.3, 1.0]),
        (lags, cubic(), [1.3, 0.42, 1.0]),
        (lags, cubic(), [0.0, 1.5, 0.43]),
        // Odd as far as the oscillation reaches.
        ([1.0, 3.0, 2.0, 0.0], kinked(&[1.0], &[1.0, 0.2]), [0.0, 2.5, 1.4]),
    ];
    assert_eq!(simulated.len(), loops.len());
    let proved = |(one, (den, characteristic, [bias, amplitude, omega])): (Simulated, ([f64; 4], _, [f64; 3]))| {
        let plant = TransferFunction::new(&[one.gain], &den).unwrap();
        let control_loop = LipschitzLoop::new(&plant, characteristic).unwrap();
        let found = if bias == 0.0 {
            control_loop.prove_near(amplitude, omega)
        } else {
            control_loop.prove_biased_near(bias, amplitude, omega)
        };
        let found = found.unwrap_or_else(|reason| panic!("{}: {reason}", one.name));
        (one, found)
    };
    simulated.into_iter().zip(loops).map(proved).collect()
}

#[test]
fn loops_against_theorems_2_and_3_oscillate_as_simulated() {
    for (simulated, proved) in proved_counterexamples() {
        let Simulated { name, period_s, maximum, minimum, mean, first, second, .. } = &simulated;
        let holds = |bounds: Interval, value: f64| {
            let wide = bounds + Interval::symmetric(tolerance::SIMULATED_71_DIGITS * first);
            wide.contains(value) && bounds.width() < 1e-7 * first
        };
        assert!(holds(proved.mean(), *mean) && holds(proved.amplitude(), *first), "{name}: {proved}");
        assert!(holds(proved.omega_rad_s(), core::f64::consts::TAU / period_s), "{name}: {proved}");
        let [re, im] = proved.harmonic(2).map_or([0.0; 2], |parts| parts.map(Interval::midpoint));
        assert!((re.hypot(im) - second).abs() < 1e-7 * first, "{name}: second harmonic {re} {im}");
        let largest = proved.largest_input().unwrap();
        let simulated_largest = maximum.abs().max(minimum.abs());
        assert!(
            largest >= simulated_largest * (1.0 - 1e-9) && largest < 1.001 * simulated_largest,
            "{name}: {largest}"
        );
        // Biased where the theorem says symmetric, symmetric where it says biased.
        let symmetric = proved.orders() == HarmonicOrders::Odd;
        assert_eq!(proved.mean().contains(0.0), symmetric, "{name}");
    }
}

#[test]
fn false_variants_of_the_counterexamples_are_refused() {
    for (simulated, proved) in proved_counterexamples() {
        let (place, width) = (proved.orders() == HarmonicOrders::All, proved.amplitude().width());
        let first = usize::from(place);
        let falsehoods: [(&str, &dyn Fn(&mut Value)); 5] = [
            ("amplitude off by three widths", &|d| add(&mut d["harmonics"][first][0], 3.0 * width)),
            ("gain off by 0.1 %", &|d| scale(&mut d["plant"]["numerator"], 1.001)),
            ("a tenth of the box", &|d| {
                scale(&mut d["radii"], 0.1);
                scale(&mut d["omega_radius_rad_s"], 0.1);
            }),
            ("no remainder", &|d| d["remainder"] = json!(0.0)),
            // Odd orders for all, all for odd.
            ("other orders", &|d| d["orders"] = json!(if place { "odd" } else { "all" })),
        ];
        assert_eq!(changed(&proved, |_| ()), Ok(()));
        for (what, falsehood) in falsehoods {
            assert!(changed(&proved, falsehood).is_err(), "{}: {what}", simulated.name);
        }
        if place {
            let bias = proved.mean().width();
            assert!(changed(&proved, |d| add(&mut d["harmonics"][0][0], 3.0 * bias)).is_err(), "{}", simulated.name);
            assert!(changed(&proved, |d| d["harmonics"][0][1] = json!(1e-3)).is_err(), "{}", simulated.name);
        }
    }
}

fn attempt(
    num: &[f64],
    den: &[f64],
    delay_s: f64,
    name: &str,
    values: &[f64],
) -> Result<ProvedOscillation, CannotTell> {
    let plant = TransferFunction::new(num, den).unwrap().with_delay(delay_s).unwrap();
    let (entry, characteristic) =
        (Entry::find(name).unwrap(), OddCharacteristic::from_catalogue(name, values).unwrap());
    let describing = entry.build::<f64>(values).unwrap();
    let balance = HarmonicBalance::new(&plant, |sweep| describing.describing_function(sweep)).unwrap();
    let first = balance.intersections().unwrap()[0];
    LipschitzLoop::new(&plant, characteristic).unwrap().prove_near(first.amplitude, first.omega_rad_s)
}

/// Without an intersection to begin from, an oscillation far beyond the least bend and within reach of the largest.
#[test]
fn the_scan_reaches_from_the_least_bend_to_beyond_the_largest() {
    let plant = TransferFunction::new(&[4.0], &[1.0, 2.0, 1.0, 0.0]).unwrap();
    let limited = OddCharacteristic::from_catalogue("dead-zone-saturation", &[1.0, 0.001, 1.0]).unwrap();
    let found = LipschitzLoop::new(&plant, limited).unwrap().oscillations(&(0.1..=10.0), &[]);
    // The describing function 1/2 of a saturation at 1 is that of an amplitude of 2.475.
    assert!(found.proved.iter().any(|one| (one.amplitude().midpoint() - 2.475).abs() < 0.1), "{found:?}");
}

#[test]
fn what_the_proof_does_not_know_is_refused_by_name() {
    let plant = TransferFunction::new(&[1.0, 1.0], &[1.0, 2.0]).unwrap();
    let saturation = OddCharacteristic::from_catalogue("saturation", &[1.0, 1.0]).unwrap();
    assert!(matches!(LipschitzLoop::new(&plant, saturation), Err(ExistenceError::Feedthrough { degree: 1 })));
    for (name, values) in
        [("relay", &[1.0][..]), ("preload", &[1.0, 1.0]), ("absolute", &[1.0]), ("polynomial", &[0.0, 1.0, 1.0, 1.0])]
    {
        let refused = OddCharacteristic::from_catalogue(name, values);
        assert!(matches!(refused, Err(ExistenceError::Characteristic { .. })), "{name}");
    }
    // Far beyond saturation a first-order plant damps the high harmonics too little.
    let reason = attempt(&[1e4], &[1.0, 1.0], 1.0, "saturation", &[1.0, 1.0]).unwrap_err();
    assert!(matches!(reason, CannotTell::Rho { rho, slope_radius } if rho < slope_radius), "{reason}");
}

/// A limit at the largest input of the oscillation itself: the wave touches the kink. Elsewhere it is proved.
#[test]
fn a_wave_that_touches_a_kink_is_refused_by_name() {
    let plant = TransferFunction::new(&[10.0], &[1.0, 3.0, 2.0, 0.0]).unwrap();
    let near = |limit: f64| {
        let kinks = vec![1.0, limit];
        let characteristic = OddCharacteristic::PiecewiseLinear { kinks, slopes: vec![1.0, 0.2, 0.0] };
        LipschitzLoop::new(&plant, characteristic).unwrap().prove_near(2.5, 1.4)
    };
    // The maximum of fixtures/counterexamples.json.
    let touching = near(2.508_982_023_104_093_4).unwrap_err();
    assert!(matches!(touching, CannotTell::Grazing { .. }), "{touching}");
    assert!(near(2.4).is_ok() && near(2.6).is_ok());
}

/// The slopes of a polynomial are bounded up to 1 % beyond the wave's own range. A box of few harmonics and wide sides is mapped into
/// itself, but allows larger inputs.
#[test]
fn an_input_beyond_the_range_of_the_slopes_is_refused_by_name() {
    let mu = 0.4;
    let plant = TransferFunction::new(&[mu, 0.0], &[1.0, -mu, 1.0]).unwrap();
    let cubic = OddCharacteristic::from_catalogue("polynomial", &[0.0, 0.0, 0.0, 1.0 / 3.0]).unwrap();
    let proved = LipschitzLoop::new(&plant, cubic).unwrap().prove_near(2.0, 1.0).unwrap();
    let with_sides = |side: f64| {
        changed(&proved, |document| {
            document["harmonics"].as_array_mut().unwrap().truncate(4);
            document["radii"] = json!([[side, 0.0], [side, side], [side, side], [side, side]]);
            document["omega_radius_rad_s"] = json!(side);
            document["remainder"] = json!(1.0);
        })
    };
    assert_eq!(with_sides(0.001), Ok(()));
    let beyond = with_sides(0.01).unwrap_err();
    assert!(
        matches!(beyond, ExistenceError::NotShown(CannotTell::Range { reach, limit }) if reach > limit),
        "{beyond}"
    );
}
