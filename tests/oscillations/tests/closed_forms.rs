//! Cycles with a closed form against simulator and orbits, to 60 digits.

use f256::f256;
use selfosc_oscillations::plant::Plant;
use selfosc_oscillations::relay::attraction::{Fate, fate};
use selfosc_oscillations::relay::control_loop::{LoopError, RelayLoop};
use selfosc_oscillations::relay::orbit::{Absent, Orbit, Path};
use selfosc_oscillations::relay::reached::reached;
use selfosc_oscillations::relay::simulation::Simulator;
use selfosc_oscillations::scalar::Scalar;

/// A symmetric relay of level 1.
fn symmetric(num: &[f64], den: &[f64], delay: f64, half_width: f64) -> RelayLoop {
    RelayLoop { plant: Plant::new(num, den, delay), high: 1.0, low: -1.0, half_width, reference: 0.0 }
}

struct Case {
    control_loop: RelayLoop,
    simulator: Simulator<f256>,
    orbit: Orbit,
    path: Path,
}

impl Case {
    fn near(control_loop: RelayLoop, time_high: f64, time_low: f64) -> Self {
        control_loop.check().unwrap();
        let simulator = Simulator::new(&control_loop);
        let orbit = Orbit::near(&simulator, time_high, time_low).unwrap();
        let path = orbit.simulate(&simulator).unwrap();
        Self { control_loop, simulator, orbit, path }
    }

    fn fate(&self) -> Fate {
        fate(&self.simulator, &self.orbit, &self.path)
    }

    fn radius(&self) -> f64 {
        self.orbit.spectral_radius(&self.simulator, &self.path).unwrap()
    }

    /// All thirty starts end on this orbit.
    fn is_where_starts_end(&self) {
        let found = reached(&self.control_loop, 1);
        assert_eq!(found.cycles.len(), 1, "{found:?}");
        assert_eq!(found.cycles[0].starts, 30);
        assert!(
            self.orbit.distance(found.cycles[0].orbit.time_high.to_f64(), found.cycles[0].orbit.time_low.to_f64())
                < 1e-15
        );
    }
}

fn digits(found: f256, exact: f256) {
    assert!(((found - exact) / exact).to_f64().abs() < 1e-60, "{found} instead of {exact}");
}

fn close(found: f64, exact: f64) {
    assert!((found - exact).abs() < 1e-13, "{found} instead of {exact}");
}

#[test]
fn a_lag_with_dead_time_has_one_stable_cycle_and_faster_unstable_ones() {
    let control_loop = symmetric(&[1.0], &[1.0, 1.0], 1.0, 0.0);
    let slow = Case::near(control_loop.clone(), 1.5, 1.5);
    let e = f256::ONE.exp();
    digits(slow.orbit.period(), f256::TWO * (f256::TWO * e - f256::ONE).ln());
    close(slow.path.amplitude().to_f64(), 1.0 - (-1.0_f64).exp());
    assert_eq!(slow.fate(), Fate::Returns);
    slow.is_where_starts_end();
    // The command of a period before: the slow cycle's e^H = 2 e^L - 1 with L - 2 H for L.
    let fast = Case::near(control_loop, 0.39, 0.39);
    let half = fast.orbit.time_high;
    digits(f256::TWO * (f256::ONE - half * f256::TWO).exp(), f256::ONE + half.exp());
    assert_eq!(fast.fate(), Fate::Leaves);
    close(fast.radius(), 1.675_466_396_091_587_7);
}

#[test]
fn an_integrator_with_dead_time() {
    let case = Case::near(symmetric(&[1.0], &[1.0, 0.0], 1.0, 0.0), 2.1, 2.0);
    digits(case.orbit.period(), f256::from(4.0));
    close(case.path.amplitude().to_f64(), 1.0);
    assert_eq!((case.fate(), case.radius()), (Fate::Returns, 0.0));
    case.is_where_starts_end();
    // With two more commands under way the instants of switching satisfy t_(k+1) + t_k = 2 t_(k-2) + 2 L: beside the shift of
    // time, z^2 + 2 z + 2 = 0 for a half-period, so 2 for a period.
    let fast = Case::near(symmetric(&[1.0], &[1.0, 0.0], 1.0, 0.0), 0.41, 0.39);
    digits(fast.orbit.period(), f256::from(4.0) / f256::from(5.0));
    assert_eq!(fast.fate(), Fate::Leaves);
    assert!((fast.radius() - 2.0).abs() < 1e-9, "{}", fast.radius());
}

#[test]
fn an_unstable_lag_has_a_cycle_below_ln_2_only() {
    // A half-period from the threshold: e^L - 1 is reached, then back in -ln(2 - e^L).
    let delay = f256::from(0.5);
    let case = Case::near(symmetric(&[1.0], &[1.0, -1.0], 0.5, 0.0), 1.6, 1.6);
    digits(case.orbit.time_low, delay - (f256::TWO - delay.exp()).ln());
    assert_eq!(case.fate(), Fate::Returns);
    let late = reached(&symmetric(&[1.0], &[1.0, -1.0], 0.7, 0.0), 1);
    assert_eq!(late.escaped, 30);
    // The false cycles of field case 21.
    let simulator = Simulator::new(&symmetric(&[1.0], &[1.0, -1.0], 0.5, 0.0));
    assert!(matches!(Orbit::at(&simulator, 35.63, 35.63), Err(Absent::NoSolution | Absent::Elsewhere { .. })));
}

#[test]
fn unequal_levels_hysteresis_dead_time_and_reference_of_a_lag() {
    // Levels 0 and 2, thresholds 0.3 -+ 0.1, dead time 0.4, time constant 1.
    let control_loop =
        RelayLoop { plant: Plant::new(&[1.0], &[1.0, 1.0], 0.4), high: 2.0, low: 0.0, half_width: 0.1, reference: 0.3 };
    let case = Case::near(control_loop, 0.6, 2.0);
    let [upper, lower, high, delay] = [case.simulator.upper, case.simulator.lower, f256::TWO, f256::from(0.4)];
    let (maximum, minimum) = (high - (high - upper) * (-delay).exp(), lower * (-delay).exp());
    digits(case.orbit.time_low, delay + (maximum / lower).ln());
    digits(case.orbit.time_high, delay + ((high - minimum) / (high - upper)).ln());
    close(case.path.maximum.to_f64(), maximum.to_f64());
    close(case.path.minimum.to_f64(), minimum.to_f64());
    case.is_where_starts_end();
}

#[test]
fn a_lag_and_an_integrator_with_hysteresis() {
    // z - tanh z = half_width with z = T/4; return map of the switching speed.
    let case = Case::near(symmetric(&[1.0], &[1.0, 1.0, 0.0], 0.0, 0.2), 1.8, 1.8);
    let z = case.orbit.period() / f256::from(4.0);
    let tanh = f256::ONE - f256::TWO / ((f256::TWO * z).exp() + f256::ONE);
    digits(z - tanh, f256::from(0.2));
    assert_eq!(case.fate(), Fate::Returns);
    case.is_where_starts_end();
}

/// The digits of a motion are those of the motion, wherever it is.
#[test]
fn a_motion_about_a_large_constant_keeps_its_digits() {
    let about = |reference: f64| {
        let control_loop = RelayLoop { reference, ..symmetric(&[1.0], &[1.0, 1.0, 0.0], 0.0, 1e-5) };
        Case::near(control_loop, 0.0495, 0.0495).path.amplitude().to_f64()
    };
    let (near, far) = (about(0.0), about(4096.0));
    assert!((far / near - 1.0).abs() < 1e-12, "{far} {near}");
}

#[test]
fn double_integrators_diverge() {
    for (delay, half_width) in [(0.0, 0.3), (0.5, 0.0), (0.5, 0.3)] {
        let found = reached(&symmetric(&[1.0], &[1.0, 0.0, 0.0], delay, half_width), 1);
        assert_eq!((found.cycles.len(), found.long_cycles.len()), (0, 0), "{found:?}");
    }
    // Commands that are late by a whole period: the conservative cycle of the loop without dead time, which repels.
    let case = Case::near(symmetric(&[1.0], &[1.0, 0.0, 0.0], 1.0, 0.0), 0.5, 0.5);
    digits(case.orbit.period(), f256::ONE);
    close(case.path.amplitude().to_f64(), 0.5 * 0.25 * 0.25);
    assert_eq!(case.fate(), Fate::Leaves);
}

#[test]
fn a_level_out_of_reach_is_rest() {
    let found = reached(&RelayLoop { reference: 3.0, ..symmetric(&[1.0], &[1.0, 1.0], 0.5, 0.1) }, 1);
    assert_eq!(found.stuck, 30);
}

#[test]
fn loops_that_are_not_simulated_are_refused() {
    assert_eq!(symmetric(&[1.0], &[1.0, 1.0], 0.0, 0.0).check(), Err(LoopError::Sliding));
    assert!(matches!(symmetric(&[1.0, 0.0], &[1.0, 1.0], 1.0, 0.0).check(), Err(LoopError::Plant(_))));
    assert!(matches!(
        RelayLoop { low: 1.0, ..symmetric(&[1.0], &[1.0, 1.0], 1.0, 0.0) }.check(),
        Err(LoopError::Levels { .. })
    ));
}
