//! Thirty loops of first to fourth order with an odd characteristic.

use serde::{Deserialize, Serialize};

use super::characteristic::Characteristic;
use crate::plant::{Plant, multiply};

/// A loop, and how the command names its characteristic.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DescribingLoop {
    /// Short name.
    pub name: String,
    /// Plant, loop gain included.
    #[serde(flatten)]
    pub plant: Plant,
    /// Characteristic.
    pub characteristic: Characteristic,
    /// The same as a name of the catalogue.
    pub nonlinearity: String,
    /// Its parameters.
    pub settings: Vec<(String, f64)>,
}

/// A characteristic by its catalogue name.
struct Named {
    characteristic: Characteristic,
    nonlinearity: &'static str,
    settings: Vec<(&'static str, f64)>,
}

fn saturation() -> Named {
    Named {
        characteristic: Characteristic::odd(&[1.0], &[1.0, 0.0]),
        nonlinearity: "saturation",
        settings: vec![("breakpoint", 1.0)],
    }
}

fn dead_zone(half_width: f64) -> Named {
    Named {
        characteristic: Characteristic::odd(&[half_width], &[0.0, 1.0]),
        nonlinearity: "dead-zone",
        settings: vec![("half_width", half_width)],
    }
}

/// No output within 0.2, none more beyond 1.
fn dead_zone_saturation() -> Named {
    Named {
        characteristic: Characteristic::odd(&[0.2, 1.0], &[0.0, 1.0, 0.0]),
        nonlinearity: "dead-zone-saturation",
        settings: vec![("half_width", 0.2), ("breakpoint", 1.0)],
    }
}

fn gain_changing(inner: f64, outer: f64) -> Named {
    Named {
        characteristic: Characteristic::odd(&[1.0], &[inner, outer]),
        nonlinearity: "gain-changing",
        settings: vec![("inner_slope", inner), ("outer_slope", outer), ("breakpoint", 1.0)],
    }
}

fn tanh(scale: f64) -> Named {
    Named {
        characteristic: Characteristic::Tanh { gain: 1.0, scale },
        nonlinearity: "tanh",
        settings: vec![("scale", scale)],
    }
}

fn cubic(linear: f64, cubic: f64) -> Named {
    Named {
        characteristic: Characteristic::Polynomial { coefficients: vec![0.0, linear, 0.0, cubic] },
        nonlinearity: "polynomial",
        settings: vec![("c1", linear), ("c3", cubic)],
    }
}

/// `gain prod(num)/prod(den) exp(-delay s)`.
fn plant(gain: f64, num: &[&[f64]], den: &[&[f64]], delay: f64) -> Plant {
    let product = |factors: &[&[f64]]| factors.iter().fold(vec![1.0], |product, factor| multiply(&product, factor));
    Plant { num: multiply(&[gain], &product(num)), den: product(den), delay }
}

const INTEGRATOR: &[f64] = &[1.0, 0.0];
const LAG: &[f64] = &[1.0, 1.0];

/// The loops.
#[must_use]
pub fn loops() -> Vec<DescribingLoop> {
    let third = |gain| plant(gain, &[], &[INTEGRATOR, LAG, LAG], 0.0);
    let two_lags = |gain| plant(gain, &[], &[INTEGRATOR, LAG, &[1.0, 2.0]], 0.0);
    let fourth = |gain| plant(gain, &[], &[LAG, LAG, LAG, LAG], 0.0);
    let conditional = |gain| plant(gain, &[LAG, LAG], &[INTEGRATOR, INTEGRATOR, INTEGRATOR], 0.0);
    // A mode of damping 0.03 at the third harmonic of the oscillation.
    let resonance =
        |gain, mode: f64| plant(gain * mode * mode, &[], &[INTEGRATOR, LAG, &[1.0, 0.06 * mode, mode * mode]], 0.6);
    [
        ("saturation, resonant third order", plant(8.0, &[], &[&[1.0, 1.0], &[1.0, 1.0, 1.0]], 0.0), saturation()),
        ("saturation, integrator and two lags", two_lags(10.0), saturation()),
        ("saturation, integrator and equal lags", third(3.0), saturation()),
        ("saturation, overdriven five times", third(10.0), saturation()),
        ("saturation, four lags", fourth(8.0), saturation()),
        ("saturation, conditionally stable", conditional(2.0), saturation()),
        (
            "saturation, conditionally stable, fourth order",
            plant(5.0, &[LAG, LAG], &[INTEGRATOR, INTEGRATOR, INTEGRATOR, &[0.1, 1.0]], 0.0),
            saturation(),
        ),
        ("saturation, integrator, lag and dead time", plant(4.0, &[], &[INTEGRATOR, LAG], 0.5), saturation()),
        ("saturation, one lag and dead time", plant(3.0, &[], &[LAG], 1.0), saturation()),
        (
            "saturation, relative degree one and dead time",
            plant(6.0, &[&[1.0, 2.0]], &[LAG, &[1.0, 3.0]], 0.5),
            saturation(),
        ),
        ("saturation, resonance at the third harmonic", resonance(2.5, 3.45), saturation()),
        ("dead zone, integrator and equal lags", third(2.5), dead_zone(0.5)),
        ("dead zone, four lags", fourth(6.0), dead_zone(0.5)),
        ("dead zone and saturation, at the fold", third(2.67), dead_zone_saturation()),
        ("dead zone and saturation, above the fold", third(3.0), dead_zone_saturation()),
        ("dead zone and saturation, dead time", plant(4.0, &[], &[INTEGRATOR, LAG], 0.5), dead_zone_saturation()),
        ("gain falling, integrator and equal lags", third(4.0), gain_changing(1.0, 0.2)),
        ("gain falling, integrator and two lags", two_lags(15.0), gain_changing(1.0, 0.1)),
        ("gain rising, integrator and equal lags", third(3.0), gain_changing(0.3, 1.0)),
        ("gain falling, one lag and dead time", plant(4.0, &[], &[LAG], 0.8), gain_changing(1.0, 0.3)),
        ("tanh, integrator and equal lags", third(5.0), tanh(1.0)),
        ("tanh, four lags", fourth(10.0), tanh(2.0)),
        ("tanh, integrator, lag and dead time", plant(3.0, &[], &[INTEGRATOR, LAG], 1.0), tanh(1.0)),
        ("tanh, one lag and dead time", plant(4.0, &[], &[LAG], 1.0), tanh(1.0)),
        ("tanh, resonance at the third harmonic", resonance(2.5, 3.45), tanh(1.0)),
        ("tanh, non-minimum phase", plant(3.0, &[&[-1.0, 1.0]], &[LAG, LAG, LAG], 0.0), tanh(1.0)),
        ("van der Pol", plant(1.0, &[INTEGRATOR], &[&[1.0, -1.0, 1.0]], 0.0), cubic(0.0, 1.0 / 3.0)),
        ("cubic x^3 - 2 x, gain 1", third(1.0), cubic(-2.0, 1.0)),
        ("cubic x + x^3, integrator and equal lags", third(1.0), cubic(1.0, 1.0)),
        ("cubic 5 x - x^3, two lags and dead time", plant(1.0, &[], &[LAG, &[0.5, 1.0]], 0.5), cubic(5.0, -1.0)),
    ]
    .into_iter()
    .map(|(name, plant, Named { characteristic, nonlinearity, settings })| DescribingLoop {
        name: name.to_owned(),
        plant,
        characteristic,
        nonlinearity: nonlinearity.to_owned(),
        settings: settings.into_iter().map(|(key, value)| (key.to_owned(), value)).collect(),
    })
    .collect()
}
