//! Random parameter sets and sweeps for any characteristic of the catalogue, drawn from what its entry says of itself.

use rand::{Rng, RngExt};
use selfosc::describing::{Boxed, Entry};
use selfosc::nonlinearity::{ParameterDomain, Sinusoid};

/// A characteristic on a sweep that it admits.
pub(crate) struct Case {
    pub(crate) values: Vec<f64>,
    pub(crate) characteristic: Boxed<f64>,
    pub(crate) sweep: Sinusoid<f64>,
}

impl Case {
    /// The sweep ends next to a kink, just inside or just outside of it, where its last bits decide.
    pub(crate) fn on_edge(&self) -> bool {
        let mut on_edge = false;
        let (low, high) = (self.sweep.minimum(), self.sweep.maximum());
        // A characteristic reports the kinks within a sweep only: a wider one has those outside.
        let margin = 3e-5 * (low.abs() + high.abs());
        let wider = Sinusoid::new(self.sweep.bias(), self.sweep.amplitude() + margin);
        for sweep in [Some(self.sweep), wider.ok()].into_iter().flatten() {
            self.characteristic.kinks(&sweep, &mut |kink| {
                let near = 1e-5 * (low.abs() + high.abs() + kink.abs());
                on_edge |= (kink - low).abs() < near || (kink - high).abs() < near;
            });
        }
        on_edge
    }
}

fn sign(rng: &mut impl Rng) -> f64 {
    if rng.random() { 1.0 } else { -1.0 }
}

/// Between 10^-low and 10^-high.
fn small(rng: &mut impl Rng, low: f64, high: f64) -> f64 {
    10f64.powf(-rng.random_range(low..high))
}

/// Parameter values inside their domains, in the order asked for.
pub(crate) fn values(entry: &Entry, rng: &mut impl Rng) -> Vec<f64> {
    let mut values = Vec::new();
    for parameter in entry.parameters {
        let size = small(rng, -1.5, 1.5);
        match parameter.domain {
            ParameterDomain::Positive => values.push(size),
            // An exponent is dimensionless: within what drag laws and springs have, and somewhat beyond.
            ParameterDomain::Exponent => {
                let exponent = rng.random_range(0.05..12.0);
                let near: f64 = rng.random_range(0..=24).into();
                let near = 0.5 * near + sign(rng) * small(rng, 2.0, 16.0);
                values.push(match rng.random_range(0..4) {
                    0 => exponent,
                    1 => rng.random_range(0.05..3.0),
                    2 => near.abs().max(0.05),
                    _ => rng.random_range(1..=24u32) as f64 / 2.0,
                });
            }
            ParameterDomain::NonNegative => values.push(if rng.random_range(0..20) == 0 { 0.0 } else { size }),
            ParameterDomain::Finite => values.push(sign(rng) * size),
            ParameterDomain::Points => {
                let mut x = -rng.random_range(0.0..3.0);
                for _ in 0..rng.random_range(1..7) {
                    values.extend([x, rng.random_range(-2.0..2.0)]);
                    x += small(rng, -0.5, 2.0);
                }
            }
        }
    }
    let place = |name: &str| entry.parameters.iter().position(|parameter| parameter.name == name).unwrap();
    for (lesser, greater) in entry.ordered {
        let (lesser, greater) = (place(lesser), place(greater));
        if values[lesser] >= values[greater] {
            values.swap(lesser, greater);
        }
    }
    values
}

/// One case in three near an end: the amplitude just above a kink, or the bias near the amplitude.
pub(crate) fn case(entry: &Entry, rng: &mut impl Rng) -> Case {
    loop {
        let values = values(entry, rng);
        let Ok(characteristic) = entry.build(&values) else { continue };
        let mut amplitude = small(rng, -2.0, 2.0);
        let mut bias = match rng.random_range(0..4) {
            0 => 0.0,
            1 => sign(rng) * amplitude * (1.0 + sign(rng) * small(rng, 0.0, 15.0)),
            2 => sign(rng) * amplitude * small(rng, 0.0, 8.0),
            _ => sign(rng) * small(rng, -1.5, 2.0),
        };
        if rng.random_range(0..3) == 0 {
            let mut kinks = Vec::new();
            characteristic.kinks(&Sinusoid::new(bias, amplitude).unwrap(), &mut |kink| kinks.push(kink));
            if !kinks.is_empty() {
                let kink = kinks[rng.random_range(0..kinks.len())];
                let near = 1.0 + sign(rng) * small(rng, 0.5, 14.0);
                if rng.random() && kink != 0.0 {
                    bias = sign(rng) * amplitude + kink * near;
                } else if kink != bias {
                    amplitude = (kink - bias).abs() * near;
                }
            }
        }
        let (span, first) = (amplitude + bias.abs(), values[0]);
        // Where the output overflows, or a test takes too long.
        let excessive = match entry.name {
            "quantizer" => span / first > 60.0,
            "sinh" => span * values[1] > 600.0,
            "sine" => span * values[1] > 300.0,
            _ => false,
        };
        if excessive || bias + amplitude == bias {
            continue;
        }
        let Ok(sweep) = Sinusoid::new(bias, amplitude) else { continue };
        if characteristic.admits(&sweep).is_ok() {
            return Case { values, characteristic, sweep };
        }
    }
}
