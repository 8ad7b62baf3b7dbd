//! Several experiments of one vehicle: Table 4 jointly, made-up vehicles, and what the intervals claim.

use proptest::prelude::*;
use rand::SeedableRng;
use rand_distr::{Distribution, Normal};
use rand_pcg::Pcg64;
use selfosc::identify::answer::AxisParameter;
use selfosc::identify::fit::joint::{FeatureRow, fit_rows};
use selfosc::identify::iso::Oscillation;
use selfosc::identify::{Delay, DragLaw, IdentifyError};
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::limit_cycle;
use selfosc::plant::DragAxis;

use crate::tolerance;

const LAWS: [DragLaw; 3] = [DragLaw::Linear, DragLaw::Quadratic, DragLaw::Mixed];
const PARAMETERS: [AxisParameter; 4] =
    [AxisParameter::Alpha, AxisParameter::LinearDrag, AxisParameter::QuadraticDrag, AxisParameter::DelayS];

/// What is measured in one experiment.
#[derive(Clone, Copy, Debug)]
struct Measured {
    relay_level: f64,
    switch_level: f64,
    amplitude: f64,
    period_s: f64,
}

impl Measured {
    /// The exact features of `axis`, amplitude and period multiplied by the exponentials of `errors`.
    fn of(axis: &DragAxis<f64>, relay_level: f64, switch_level: f64, errors: [f64; 2]) -> Self {
        let orbit = limit_cycle(axis, &RelayHysteresis::new(relay_level, switch_level, 0.0).unwrap()).unwrap();
        let (amplitude, period_s) = (orbit.amplitude * errors[0].exp(), orbit.period_s * errors[1].exp());
        Self { relay_level, switch_level, amplitude, period_s }
    }

    fn row(&self) -> FeatureRow {
        let Self { relay_level, switch_level, amplitude, period_s } = *self;
        FeatureRow::new(&Oscillation { relay_level, switch_level, amplitude, bias: 0.0, period_s, delay_s: 0.0 })
            .unwrap()
    }

    /// Squares of the logarithmic residuals, in plain floating point.
    fn squares(&self, axis: &DragAxis<f64>) -> f64 {
        let exact = Self::of(axis, self.relay_level, self.switch_level, [0.0; 2]);
        (self.amplitude / exact.amplitude).ln().powi(2) + (self.period_s / exact.period_s).ln().powi(2)
    }
}

fn rows(measured: &[Measured]) -> Vec<FeatureRow> {
    measured.iter().map(Measured::row).collect()
}

/// Table 4 in its own units: degrees and 1e-2 N m.
fn table_4() -> Vec<Measured> {
    let mut reader = csv::Reader::from_path(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/table4.csv")).unwrap();
    let headers = reader.headers().unwrap().clone();
    let places = ["c_1e-2_n_m", "x_a_star_deg", "x_m_deg", "period_s"]
        .map(|name| headers.iter().position(|header| header == name).unwrap());
    let measured = |record: csv::StringRecord| {
        let [relay_level, switch_level, amplitude, period_s] = places.map(|place| record[place].parse().unwrap());
        Measured { relay_level, switch_level, amplitude, period_s }
    };
    reader.records().map(|record| measured(record.unwrap())).collect()
}

/// Residual rms in percent and, where it was estimated, delay, to one and two decimals.
type Figure = (&'static str, Option<&'static str>);

/// The figures of each law: known from an independent computation.
const FIGURES: [(Delay, [Figure; 3]); 2] = [
    (Delay::KnownS(0.2), [("12.8", None), ("5.8", None), ("4.3", None)]),
    (Delay::Estimated, [("10.0", None), ("4.0", Some("0.30")), ("3.7", Some("0.28"))]),
];

#[test]
fn table_4_jointly() {
    let rows = rows(&table_4());
    assert_eq!(rows.len(), 19);
    for (delay, figures) in FIGURES {
        for (law, (rms, delay_s)) in LAWS.into_iter().zip(figures) {
            let joint = fit_rows(&rows, law, delay).unwrap();
            assert_eq!(format!("{:.1}", 100.0 * joint.residual_rms()), rms, "{law:?} {delay:?}");
            if let Some(expected) = delay_s {
                assert_eq!(format!("{:.2}", joint.estimate(AxisParameter::DelayS).value), expected, "{law:?}");
            }
        }
    }
}

/// The switching level is where the command was given: taken as the place where it acted, so that no delay is left, it gives
/// none of the figures, and the wrong drag law.
#[test]
fn the_level_as_the_acting_one_does_not_give_the_figures() {
    let rows = rows(&table_4());
    let rms = |law, delay| fit_rows(&rows, law, delay).unwrap().residual_rms();
    for law in LAWS {
        assert!((rms(law, Delay::KnownS(0.0)) / rms(law, Delay::KnownS(0.2)) - 1.0).abs() > 0.1, "{law:?}");
    }
    assert!(rms(DragLaw::Linear, Delay::KnownS(0.0)) < rms(DragLaw::Quadratic, Delay::KnownS(0.0)));
}

/// Sum of squares by another path than the fit's, at the fit and around it.
#[test]
fn no_neighbour_fits_table_4_better() {
    let measured = table_4();
    for (delay, _) in FIGURES {
        for law in LAWS {
            let joint = fit_rows(&rows(&measured), law, delay).unwrap();
            let squares = |factors: [f64; 4]| {
                let [alpha, linear, quadratic, delay_s] =
                    std::array::from_fn(|i| joint.estimate(PARAMETERS[i]).value * factors[i]);
                let axis = DragAxis::mixed(alpha, linear, quadratic).unwrap().with_delay_s(delay_s).unwrap();
                measured.iter().map(|row| row.squares(&axis)).sum::<f64>()
            };
            let best = squares([1.0; 4]);
            let claimed = joint.residual_rms().powi(2) * joint.degrees_of_freedom() as f64;
            assert!((best / claimed - 1.0).abs() < tolerance::INVERSION);
            for index in (0..4).filter(|&index| joint.estimate(PARAMETERS[index]).spread.is_some()) {
                for factor in [0.999, 1.001] {
                    let mut factors = [1.0; 4];
                    factors[index] = factor;
                    assert!(squares(factors) > best, "{law:?} {delay:?} {:?}", PARAMETERS[index]);
                }
            }
        }
    }
}

/// Relay levels over a factor of eight and half-widths over a factor of four, as a careful engineer would choose.
const PLAN: [(f64, f64); 6] = [(2.0, 10.0), (4.0, 20.0), (8.0, 8.0), (8.0, 30.0), (16.0, 15.0), (16.0, 30.0)];

proptest! {
    #![proptest_config(crate::sampling::config(200))]

    #[test]
    fn exact_rows_return_the_vehicle(
        alpha in 0.03..0.1f64, linear in 0.01..0.1f64, quadratic in 5e-4..5e-3f64, delay_s in 0.02..0.3f64,
        law in 0..3usize, estimated: bool,
    ) {
        let law = LAWS[law];
        let truth = [
            alpha,
            if law == DragLaw::Quadratic { 0.0 } else { linear },
            if law == DragLaw::Linear { 0.0 } else { quadratic },
            delay_s,
        ];
        let axis = DragAxis::mixed(truth[0], truth[1], truth[2]).unwrap().with_delay_s(delay_s).unwrap();
        let measured = PLAN.map(|(level, half_width)| Measured::of(&axis, level, half_width, [0.0; 2]));
        let delay = if estimated { Delay::Estimated } else { Delay::KnownS(delay_s) };
        let joint = fit_rows(&rows(&measured), law, delay).unwrap();
        for (parameter, expected) in PARAMETERS.into_iter().zip(truth) {
            let found = joint.estimate(parameter).value;
            prop_assert!((found - expected).abs() <= tolerance::JOINT * expected, "{parameter:?}: {found} for {expected}");
        }
        // Another law does not fit the same rows.
        if law != DragLaw::Mixed {
            let other = if law == DragLaw::Linear { DragLaw::Quadratic } else { DragLaw::Linear };
            prop_assert!(!fit_rows(&rows(&measured), other, Delay::KnownS(delay_s)).is_ok_and(|fit| fit.residual_rms() < 1e-3));
        }
    }
}

/// Rows of `axis` with independent errors of 2 % in amplitude and period.
fn noisy(axis: &DragAxis<f64>, random: &mut Pcg64) -> Vec<FeatureRow> {
    let noise = Normal::new(0.0, 0.02).unwrap();
    let measured = |&(level, half_width): &(f64, f64)| {
        Measured::of(axis, level, half_width, [noise.sample(random), noise.sample(random)]).row()
    };
    PLAN.iter().map(measured).collect()
}

#[test]
fn intervals_cover_the_truth_as_often_as_they_say() {
    const EXPERIMENTS: usize = 500;
    let truth = [0.05, 0.06, 2e-3, 0.2];
    let axis = DragAxis::mixed(truth[0], truth[1], truth[2]).unwrap().with_delay_s(truth[3]).unwrap();
    let mut random = Pcg64::seed_from_u64(1);
    let (mut covered, mut covered_half, mut variance) = ([0; 3], [0; 3], 0.0);
    for _ in 0..EXPERIMENTS {
        let joint = fit_rows(&noisy(&axis, &mut random), DragLaw::Mixed, Delay::KnownS(truth[3])).unwrap();
        variance += joint.residual_rms().powi(2) / EXPERIMENTS as f64;
        for index in 0..3 {
            let estimate = joint.estimate(PARAMETERS[index]);
            let spread = estimate.spread.unwrap();
            let error = (estimate.value - truth[index]).abs();
            covered[index] += usize::from(spread.low <= truth[index] && truth[index] <= spread.high);
            covered_half[index] += usize::from(error <= 0.5 * (spread.high - estimate.value));
        }
    }
    let within = |count: usize, low: f64, high: f64| (low..high).contains(&(count as f64 / EXPERIMENTS as f64));
    assert!(covered.iter().all(|&count| within(count, 0.92, 0.98)), "{covered:?} of {EXPERIMENTS}");
    // Intervals half as wide must fail the same test.
    assert!(covered_half.iter().all(|&count| !within(count, 0.92, 0.98)), "{covered_half:?} of {EXPERIMENTS}");
    assert!((variance.sqrt() / 0.02 - 1.0).abs() < 0.03, "rms {} for 0.02", variance.sqrt());
}

/// Where the errors ask for a negative drag, the drag ends at zero and the fit is that of the other law.
#[test]
fn drag_stays_zero_or_more() {
    let axis = DragAxis::quadratic(0.05, 2e-3).unwrap().with_delay_s(0.2).unwrap();
    let mut random = Pcg64::seed_from_u64(2);
    let mut on_bound = 0;
    for _ in 0..40 {
        let rows = noisy(&axis, &mut random);
        let fit = |law| fit_rows(&rows, law, Delay::KnownS(0.2)).unwrap();
        let (mixed, quadratic) = (fit(DragLaw::Mixed), fit(DragLaw::Quadratic));
        let linear_drag = mixed.estimate(AxisParameter::LinearDrag);
        if linear_drag.value == 0.0 {
            on_bound += 1;
            assert!(
                linear_drag.spread.is_none()
                    && mixed.correlation(AxisParameter::Alpha, AxisParameter::LinearDrag).is_none()
            );
            let ratio = mixed.axis().quadratic_drag() / quadratic.axis().quadratic_drag();
            assert!((ratio - 1.0).abs() < tolerance::JOINT, "{ratio}");
        } else {
            assert!(linear_drag.value > 0.0);
            let squares =
                |joint: &selfosc::identify::fit::joint::Joint| joint.residuals().iter().map(|r| r * r).sum::<f64>();
            assert!(squares(&mixed) <= squares(&quadratic));
        }
    }
    // Without noise on its side, half of all vehicles would want it negative.
    assert!((8..=32).contains(&on_bound), "{on_bound} of 40");
}

#[test]
fn delay_and_inertia_are_confounded_and_said_to_be() {
    let rows = rows(&table_4());
    let joint = fit_rows(&rows, DragLaw::Quadratic, Delay::Estimated).unwrap();
    let correlation = joint.correlation(AxisParameter::Alpha, AxisParameter::DelayS).unwrap();
    assert!((-1.0..-0.8).contains(&correlation), "{correlation}");
    assert_eq!(joint.correlation(AxisParameter::Alpha, AxisParameter::Alpha), Some(1.0));
    assert_eq!(joint.correlation(AxisParameter::Alpha, AxisParameter::LinearDrag), None);
}

#[test]
fn what_cannot_be_told_is_refused() {
    let measured = table_4();
    let fit = |measured: &[Measured], law, delay| fit_rows(&rows(measured), law, delay);
    let known = Delay::KnownS(0.2);
    let few = |result| matches!(result, Err(IdentifyError::TooFewEquations { .. }));
    assert!(few(fit(&[], DragLaw::Linear, known)));
    assert!(few(fit(&measured[..1], DragLaw::Linear, known)));
    assert!(few(fit(&measured[..2], DragLaw::Mixed, Delay::Estimated)));
    let same = [measured[6]; 5];
    assert!(fit(&same, DragLaw::Quadratic, known).is_ok());
    let refused = fit(&same, DragLaw::Mixed, known);
    assert!(matches!(refused, Err(IdentifyError::Confounded { .. })), "{refused:?}");
    let refused = fit(&measured, DragLaw::Linear, Delay::KnownS(5.0));
    assert!(matches!(refused, Err(IdentifyError::NoOrbit { .. })), "{refused:?}");
    let refused = fit(&measured, DragLaw::Linear, Delay::KnownS(f64::NAN));
    assert!(matches!(refused, Err(IdentifyError::OutOfDomain { .. })), "{refused:?}");
    let row = |amplitude| Oscillation {
        relay_level: 1.0,
        switch_level: 1.0,
        amplitude,
        bias: 0.0,
        period_s: 1.0,
        delay_s: 0.0,
    };
    assert!(FeatureRow::new(&row(2.0)).is_ok());
    assert!(matches!(FeatureRow::new(&row(f64::NAN)), Err(IdentifyError::OutOfDomain { .. })));
}
