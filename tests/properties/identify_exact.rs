//! Orbit inversion: the parameters that made an orbit come back from its features.

use proptest::prelude::*;
use selfosc::experiment::SimulatedExperiment;
use selfosc::features::RecordFeatures;
use selfosc::identify::IdentifyError;
use selfosc::identify::exact::MeanCycle;
use selfosc::identify::iso::Oscillation;
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::numeric::Gradient;
use selfosc::numeric::Scalar;
use selfosc::orbit::{LimitCycle, limit_cycle};
use selfosc::plant::DragAxis;

use crate::tolerance;

/// An axis of one drag law with its relay.
#[derive(Clone, Copy, Debug)]
struct Loop {
    quadratic: bool,
    alpha: f64,
    drag: f64,
    level: f64,
    half_width: f64,
    mu: f64,
    delay_s: f64,
}

impl Loop {
    fn axis<S: Scalar>(&self, [alpha, drag, disturbance]: [S; 3]) -> DragAxis<S> {
        let axis = if self.quadratic { DragAxis::quadratic(alpha, drag) } else { DragAxis::linear(alpha, drag) };
        axis.unwrap().with_disturbance(disturbance).unwrap().with_delay_s(S::from_f64(self.delay_s)).unwrap()
    }

    fn parameters(&self) -> [f64; 3] {
        [self.alpha, self.drag, self.mu * self.level]
    }

    fn orbit<S: Scalar>(&self, parameters: [S; 3]) -> LimitCycle<S> {
        let relay = RelayHysteresis::new(S::from_f64(self.level), S::from_f64(self.half_width), S::zero()).unwrap();
        limit_cycle(&self.axis(parameters), &relay).unwrap()
    }

    fn cycle<S: Scalar>(&self, orbit: &LimitCycle<S>) -> MeanCycle<S> {
        MeanCycle {
            relay_level: S::from_f64(self.level),
            switch_level: S::from_f64(self.half_width),
            amplitude: orbit.amplitude,
            time_positive_s: orbit.time_positive_s,
            time_negative_s: orbit.time_negative_s,
            delay_s: S::from_f64(self.delay_s),
        }
    }

    fn invert<S: Scalar>(&self, cycle: &MeanCycle<S>) -> Result<[S; 3], IdentifyError> {
        let axis = if self.quadratic { cycle.quadratic_drag()? } else { cycle.linear_drag()? };
        let drag = if self.quadratic { axis.quadratic_drag() } else { axis.linear_drag() };
        Ok([axis.alpha(), drag, axis.disturbance()])
    }

    /// Largest error of the parameters: relative for inertia and drag, in relay levels for the disturbance.
    fn error(&self, found: [f64; 3]) -> f64 {
        let [alpha, drag, disturbance] = self.parameters();
        let errors =
            [found[0] / alpha - 1.0, found[1] / drag - 1.0, (found[2] - disturbance) / self.level].map(f64::abs);
        errors.into_iter().fold(0.0, |worst, error| if error > worst || error.is_nan() { error } else { worst })
    }
}

fn log_uniform(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

/// Any units, four decades of shape, the disturbance up to four fifths of the level, the delay up to one and a half of the
/// time unit of the plant.
fn loops() -> impl Strategy<Value = Loop> {
    loops_with(prop_oneof![Just(0.0), log_uniform(1e-3, 1.5)])
}

fn loops_with(delay: impl Strategy<Value = f64>) -> impl Strategy<Value = Loop> {
    let scales = (log_uniform(1e-3, 1e3), log_uniform(1e-3, 1e3), log_uniform(1e-3, 1e3), log_uniform(1e-3, 1e1));
    let disturbance = prop_oneof![Just(0.0), -0.8..0.8f64, log_uniform(1e-20, 1e-2)];
    (any::<bool>(), scales, disturbance, delay).prop_map(|(quadratic, (alpha, drag, level, g), mu, delay)| {
        let (half_width, time_unit) = if quadratic {
            (g * alpha / drag, alpha / (drag * level).sqrt())
        } else {
            (g * level * alpha / (drag * drag), alpha / drag)
        };
        Loop { quadratic, alpha, drag, level, half_width, mu, delay_s: delay * time_unit }
    })
}

proptest! {
    #![proptest_config(crate::sampling::config(2000))]

    #[test]
    fn inversion_returns_the_parameters(case in loops()) {
        let found = case.invert(&case.cycle(&case.orbit(case.parameters()))).unwrap();
        prop_assert!(case.error(found) <= tolerance::INVERSION, "{case:?} gave {found:?}: {:e}", case.error(found));
    }

    #[test]
    fn a_constant_added_to_the_position_has_no_effect(case in loops(), shift in -1.0..1.0f64) {
        let orbit = case.orbit(case.parameters());
        let (maximum, minimum) = (orbit.maximum + shift * case.half_width, orbit.minimum + shift * case.half_width);
        let cycle = MeanCycle { amplitude: 0.5 * (maximum - minimum), ..case.cycle(&orbit) };
        prop_assert!(case.error(case.invert(&cycle).unwrap()) <= tolerance::INVERSION);
    }

    /// Where the command acted is as good as where it was given: with that level there is no delay left.
    #[test]
    fn the_acting_level_needs_no_delay(case in loops()) {
        let orbit = case.orbit(case.parameters());
        let acting = 0.5 * (orbit.upper_switch.position - orbit.lower_switch.position);
        let cycle = MeanCycle { switch_level: acting, delay_s: 0.0, ..case.cycle(&orbit) };
        prop_assert!(case.error(case.invert(&cycle).unwrap()) <= tolerance::INVERSION);
    }

    /// The acting level taken together with the delay counts the delay twice.
    #[test]
    fn the_acting_level_with_the_delay_is_wrong(case in loops_with(log_uniform(1e-3, 1.5))) {
        let orbit = case.orbit(case.parameters());
        let acting = 0.5 * (orbit.upper_switch.position - orbit.lower_switch.position);
        let cycle = MeanCycle { switch_level: acting, ..case.cycle(&orbit) };
        let wrong = case.invert(&cycle).map(|found| case.error(found));
        prop_assert!(wrong.is_err() || wrong.unwrap() > 1e3 * tolerance::INVERSION);
    }

    /// The derivatives of the inversion undo those of the orbit: their product is the unit matrix.
    #[test]
    fn derivatives_are_inverse_to_the_orbits(case in loops()) {
        let parameters = case.parameters();
        for seed in 0..3 {
            let scale = if seed == 2 { case.level } else { parameters[seed] };
            let mut duals = parameters.map(Gradient::<f64, 1>::constant);
            duals[seed] = Gradient::new(parameters[seed], [scale]);
            let found = case.invert(&case.cycle(&case.orbit(duals))).unwrap();
            for (index, found) in found.into_iter().enumerate() {
                let scale = if index == 2 { case.level } else { parameters[index] };
                let expected = if index == seed { 1.0 } else { 0.0 };
                let error = (found.slopes()[0] / scale - expected).abs();
                prop_assert!(error <= tolerance::INVERSION_DERIVATIVE, "{case:?}: {seed} to {index} off by {error:e}");
            }
        }
    }

    /// Every ratio of switching level to amplitude below the limit belongs to an orbit, no other does.
    #[test]
    fn the_domain_is_sharp(
        quadratic: bool, level in 0.1..10.0f64, amplitude in 0.1..10.0f64, period in 0.1..10.0f64,
        share in 0.2..0.8f64, delay_share in 0.0..0.1f64, part in 0.01..0.99f64,
    ) {
        let times = [share * period, (1.0 - share) * period];
        let limit = 1.0 - delay_share / share - delay_share / (1.0 - share);
        let with = |ratio: f64| MeanCycle {
            relay_level: level, switch_level: ratio * amplitude, amplitude,
            time_positive_s: times[0], time_negative_s: times[1], delay_s: delay_share * period,
        };
        let invert = |cycle: MeanCycle<f64>| if quadratic { cycle.quadratic_drag() } else { cycle.linear_drag() };
        let cycle = with(part * limit);
        let axis = invert(cycle).unwrap();
        let orbit = limit_cycle(&axis, &RelayHysteresis::new(level, cycle.switch_level, 0.0).unwrap()).unwrap();
        prop_assert!((orbit.amplitude / amplitude - 1.0).abs() <= tolerance::INVERSION);
        prop_assert!((orbit.time_positive_s / times[0] - 1.0).abs() <= tolerance::INVERSION);
        prop_assert!((orbit.time_negative_s / times[1] - 1.0).abs() <= tolerance::INVERSION);
        let beyond = invert(with(limit + part * (1.0 - limit) + 1e-9));
        let refused = matches!(beyond, Err(IdentifyError::NoOrbit { .. }));
        prop_assert!(refused, "{:?}", beyond);
    }

    /// Without delay and disturbance the features satisfy the published closed forms, written here by themselves.
    #[test]
    fn closed_forms_of_the_symmetric_orbit(
        level in 0.1..10.0f64, half_width in 0.1..10.0f64, ratio in 0.1..10.0f64, period in 0.1..10.0f64,
    ) {
        let cycle = MeanCycle::symmetric(&Oscillation {
            relay_level: level, switch_level: half_width, amplitude: half_width * (1.0 + ratio), bias: 0.0,
            period_s: period, delay_s: 0.0,
        });
        let axis = cycle.quadratic_drag().unwrap();
        let (alpha, beta) = (axis.alpha(), axis.quadratic_drag());
        let y = (1.0 - (-4.0 * beta * half_width / alpha).exp()).sqrt();
        let excess = alpha / (2.0 * beta) * (1.0 + y).ln();
        prop_assert!((excess / (ratio * half_width) - 1.0).abs() <= tolerance::INVERSION);
        let time = 2.0 * alpha / (beta * level).sqrt() * (y.sqrt().atan() + y.sqrt().atanh());
        prop_assert!((time / period - 1.0).abs() <= tolerance::INVERSION);

        let axis = cycle.linear_drag().unwrap();
        let (alpha, beta) = (axis.alpha(), axis.linear_drag());
        let z = beta * period / (4.0 * alpha);
        let unit = level * alpha / (beta * beta);
        prop_assert!((unit * (z - z.tanh()) / half_width - 1.0).abs() <= tolerance::INVERSION);
        let excess = unit * (z.tanh() - (1.0 + z.tanh()).ln());
        prop_assert!((excess / (ratio * half_width) - 1.0).abs() <= tolerance::INVERSION);
    }
}

proptest! {
    #![proptest_config(crate::sampling::config(64))]

    /// From a dense record, simulated, through its features: both laws, with and without disturbance and delay, whether the relay is
    /// held or watches all the time.
    #[test]
    fn dense_records_give_the_parameters_within_a_percent(
        quadratic: bool, alpha in 0.3..3.0f64, half_width in 0.1..0.5f64, g in 0.1..2.0f64,
        mu in prop_oneof![Just(0.0), -0.3..0.3f64], delay_s in prop_oneof![Just(0.0), 0.0..0.3f64], held: bool,
    ) {
        let drag = if quadratic { g * alpha / half_width } else { (g * alpha / half_width).sqrt() };
        let case = Loop { quadratic, alpha, drag, level: 1.0, half_width, mu, delay_s };
        let axis = case.axis(case.parameters());
        let relay = RelayHysteresis::new(1.0, half_width, 0.0).unwrap();
        let period_s = limit_cycle(&axis, &relay).unwrap().period_s;
        let experiment = SimulatedExperiment::new(axis, relay, 4000.0 / period_s).unwrap();
        let record = if held { experiment.held() } else { experiment }.run(25.0 * period_s).unwrap();
        let found = RecordFeatures::of(&record).unwrap();
        let cycle = MeanCycle::of(&found.features, found.relay.level, delay_s);
        let error = case.error(case.invert(&cycle).unwrap());
        prop_assert!(error < tolerance::DENSE_EXACT, "{case:?}: {error}");
    }
}

#[test]
fn single_precision() {
    let case = Loop { quadratic: true, alpha: 6.0, drag: 0.2, level: 8.0, half_width: 12.0, mu: 0.1, delay_s: 0.2 };
    for case in [case, Loop { quadratic: false, drag: 3.0, ..case }] {
        let found = case.invert(&case.cycle(&case.orbit(case.parameters().map(|x| x as f32)))).unwrap();
        let error = case.error(found.map(f64::from));
        assert!(error < tolerance::INVERSION_SINGLE, "{case:?} gave {found:?}");
    }
}

#[test]
fn refusals_name_the_feature() {
    let good = MeanCycle {
        relay_level: 1.0,
        switch_level: 0.3,
        amplitude: 1.0,
        time_positive_s: 2.0,
        time_negative_s: 2.0,
        delay_s: 0.0,
    };
    assert!(good.linear_drag().is_ok() && good.quadratic_drag().is_ok());
    let named = |cycle: MeanCycle<f64>| match cycle.quadratic_drag() {
        Err(IdentifyError::OutOfDomain(fault)) => fault.quantity.split(' ').next().unwrap().to_owned(),
        other => panic!("{other:?}"),
    };
    assert_eq!(named(MeanCycle { relay_level: 0.0, ..good }), "relay");
    assert_eq!(named(MeanCycle { switch_level: -0.1, ..good }), "switching");
    assert_eq!(named(MeanCycle { amplitude: f64::NAN, ..good }), "amplitude");
    assert_eq!(named(MeanCycle { time_positive_s: 0.0, ..good }), "time");
    assert_eq!(named(MeanCycle { time_negative_s: f64::INFINITY, ..good }), "time");
    assert_eq!(named(MeanCycle { delay_s: -0.1, ..good }), "delay");
    let no_orbit = |cycle: MeanCycle<f64>| matches!(cycle.linear_drag(), Err(IdentifyError::NoOrbit { .. }));
    assert!(no_orbit(MeanCycle { switch_level: 0.0, ..good }));
    assert!(no_orbit(MeanCycle { switch_level: 1.0, ..good }));
    assert!(no_orbit(MeanCycle { delay_s: 0.8, ..good }));
    let hidden = MeanCycle { switch_level: 1e-30, ..good };
    assert!(matches!(hidden.quadratic_drag(), Err(IdentifyError::Unresolved { .. })));
}
