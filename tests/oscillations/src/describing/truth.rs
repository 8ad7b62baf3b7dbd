//! What oscillates in a loop: by harmonic balance, by the return map in 71 digits, by integration.

use serde::{Deserialize, Serialize};

use super::characteristic::Characteristic;
use super::cycle::{attracts, cycle, settle};
use super::harmonic_balance::{Balance, HIGHEST, balances};
use super::late_loop::LateLoop;
use super::loops::DescribingLoop;
use super::spectrum::input;
use crate::plant::Plant;

/// An oscillation with its first harmonic.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Oscillation {
    /// Amplitude of the first harmonic by harmonic balance.
    pub amplitude: f64,
    /// Frequency in rad/s by harmonic balance.
    pub omega_rad_s: f64,
    /// Amplitude less that with half the harmonics.
    pub amplitude_change: f64,
    /// Frequency less that with half the harmonics.
    pub omega_change: f64,
    /// Third harmonic over the first.
    pub third: f64,
    /// By the other method; `None` where that has none: loops with dead time from which the motion departs.
    pub integrated: Option<Integrated>,
    /// Whether a small disturbance dies out; `None` where that is not known.
    pub attracting: Option<bool>,
    /// Largest modulus of a multiplier; `None` with dead time.
    pub multiplier: Option<f64>,
}

/// The same oscillation by integration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Integrated {
    /// Amplitude of the first harmonic.
    pub amplitude: f64,
    /// Frequency in rad/s.
    pub omega_rad_s: f64,
    /// Its own uncertainty, relative: rounding in 71 digits, last changes of the settling motion.
    pub uncertainty: f64,
}

/// Loop and oscillations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// The loop.
    #[serde(rename = "loop")]
    pub control_loop: DescribingLoop,
    /// Half-wave symmetric oscillations, by growing amplitude.
    pub oscillations: Vec<Oscillation>,
}

/// Amplitudes of the first harmonic that are scanned.
pub const AMPLITUDES: [f64; 2] = [0.15, 15.0];

impl Oscillation {
    /// The best amplitude and frequency known, and how far either may be off, relative.
    #[must_use]
    pub fn best(&self) -> (f64, f64, f64) {
        match self.integrated {
            Some(one) => (one.amplitude, one.omega_rad_s, one.uncertainty),
            None => {
                let off =
                    (self.amplitude_change / self.amplitude).abs().max((self.omega_change / self.omega_rad_s).abs());
                (self.amplitude, self.omega_rad_s, off.max(1e-14))
            }
        }
    }

    /// Relative difference of the two methods; `None` with one alone.
    #[must_use]
    pub fn disagreement(&self) -> Option<f64> {
        let one = self.integrated?;
        Some((one.amplitude / self.amplitude - 1.0).abs().max((one.omega_rad_s / self.omega_rad_s - 1.0).abs()))
    }
}

/// The oscillations of a loop.
#[must_use]
pub fn truth(control_loop: &DescribingLoop) -> Truth {
    let DescribingLoop { plant, characteristic, .. } = control_loop;
    let mut found = balances(plant, characteristic, AMPLITUDES);
    // Cycles far from a sinusoid are not found from one: simulation finds the attracting ones.
    if plant.delay > 0.0 {
        add_settled(&mut found, plant, characteristic);
    } else {
        add_simulated(&mut found, plant, characteristic);
    }
    found.sort_by(|a, b| a.amplitude().total_cmp(&b.amplitude()));
    let oscillations = found.iter().map(|balance| oscillation(control_loop, balance)).collect();
    Truth { control_loop: control_loop.clone(), oscillations }
}

/// Adds the half-wave symmetric cycles on which simulations from six starts settle.
fn add_simulated(found: &mut Vec<Balance>, plant: &Plant, characteristic: &Characteristic) {
    let first = plant.num.iter().rev().position(|&b| b != 0.0).unwrap_or(0);
    for output in [0.1, 0.3, 1.0, 2.0, 4.0, 8.0] {
        let mut z = vec![0.0; plant.order()];
        z[first] = output * plant.den[0] / plant.num[plant.num.len() - 1 - first];
        let Some(settled) = settle(plant, characteristic, &z, 400.0) else { continue };
        let omega = std::f64::consts::TAU / settled.period;
        if found.iter().any(|one| (one.omega / omega - 1.0).abs() < 1e-5) {
            continue;
        }
        let cycle = cycle(plant, characteristic, settled.level, settled.rises, &settled.z, settled.period);
        let symmetric = cycle.filter(|one| one.second.amplitude() < 1e-12 * one.first.amplitude());
        found.extend(symmetric.and_then(|one| one.balance().refined(plant, characteristic, HIGHEST)));
    }
}

/// The same with dead time, from the balances found, smaller and larger.
fn add_settled(found: &mut Vec<Balance>, plant: &Plant, characteristic: &Characteristic) {
    for balance in found.clone() {
        for factor in [0.3, 0.7, 1.4, 3.0] {
            let Some(settled) = LateLoop::on(plant, characteristic, &balance, factor).settle() else { continue };
            if found.iter().any(|one| (one.omega / settled.omega() - 1.0).abs() < 1e-5) {
                continue;
            }
            found.extend(settled.balance().and_then(|one| one.refined(plant, characteristic, HIGHEST)));
        }
    }
}

/// What is known of the oscillation of a balance.
#[must_use]
pub fn oscillation(control_loop: &DescribingLoop, balance: &Balance) -> Oscillation {
    let DescribingLoop { plant, characteristic, .. } = control_loop;
    let half = balance.refined(plant, characteristic, HIGHEST / 2);
    let change = |of: fn(&Balance) -> f64| half.as_ref().map_or(f64::NAN, |half| of(balance) - of(half));
    let mut found = Oscillation {
        amplitude: balance.amplitude(),
        omega_rad_s: balance.omega,
        amplitude_change: change(Balance::amplitude),
        omega_change: change(|one| one.omega),
        third: balance.harmonics[1].norm() / balance.amplitude(),
        integrated: None,
        attracting: None,
        multiplier: None,
    };
    if plant.delay > 0.0 {
        found.integrate(control_loop, balance);
    } else {
        found.return_map(control_loop, balance);
    }
    found
}

/// Farthest that the motion may settle from the balance it started on.
const SAME: f64 = 1e-3;

impl Oscillation {
    fn is_near(&self, amplitude: f64, omega: f64) -> bool {
        (amplitude / self.amplitude - 1.0).abs() < SAME && (omega / self.omega_rad_s - 1.0).abs() < SAME
    }

    fn integrate(&mut self, control_loop: &DescribingLoop, balance: &Balance) {
        let DescribingLoop { plant, characteristic, .. } = control_loop;
        let settled = LateLoop::on(plant, characteristic, balance, 1.01).settle();
        let near = settled.filter(|one| self.is_near(one.amplitude, one.omega()));
        self.attracting = Some(near.is_some());
        self.integrated = near.map(|one| Integrated {
            amplitude: one.amplitude,
            omega_rad_s: one.omega(),
            uncertainty: one.drift.max(1e-14),
        });
    }

    fn return_map(&mut self, control_loop: &DescribingLoop, balance: &Balance) {
        let DescribingLoop { plant, characteristic, .. } = control_loop;
        let (theta, rises) = rises(balance);
        let period = std::f64::consts::TAU / balance.omega;
        let Some(found) = cycle(plant, characteristic, 0.0, rises, &balance.state(plant, theta), period) else {
            return;
        };
        if self.is_near(found.first.amplitude(), found.omega()) {
            self.attracting = attracts(plant, characteristic, &found);
            self.multiplier = Some(found.radius());
            let (amplitude, omega_rad_s) = (found.first.amplitude(), found.omega());
            self.integrated = Some(Integrated { amplitude, omega_rad_s, uncertainty: 4.0 * f64::EPSILON });
        }
    }
}

/// An angle at which the output of a balance rises through zero, and the number of such angles in a turn.
fn rises(balance: &Balance) -> (f64, usize) {
    const SAMPLES: usize = 4000;
    let theta = |i: usize| std::f64::consts::TAU * i as f64 / SAMPLES as f64;
    let values: Vec<f64> = (0..=SAMPLES).map(|i| input(&balance.harmonics, theta(i))).collect();
    let rising: Vec<usize> = (0..SAMPLES).filter(|&i| values[i] <= 0.0 && values[i + 1] > 0.0).collect();
    (rising.first().map_or(0.0, |&i| theta(i)), rising.len().max(1))
}
