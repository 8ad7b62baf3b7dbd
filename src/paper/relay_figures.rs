//! Figs. 5-7: the relay with hysteresis and level offset, its output under a biased sinusoid, and its late switching when
//! sampled.

use super::PaperError;
use crate::nonlinearity::{Branch, Characteristic, RelayHysteresis, Sinusoid};

/// A curve as (x, y).
pub type Curve = Vec<(f64, f64)>;

const LEVEL: f64 = 1.0;
/// The level at which the relay of Figs. 5 and 6 switches.
pub const HALF_WIDTH: f64 = 1.0;
const OFFSET: f64 = 0.3;

fn relay() -> Result<RelayHysteresis<f64>, PaperError> {
    Ok(RelayHysteresis::new(LEVEL, HALF_WIDTH, OFFSET)?)
}

/// Regenerates Fig. 5: the output of a relay with `C = 1`, `x_a = 1`, `d = 0.3` while the input rises, and while it falls.
///
/// # Errors
/// None in practice: the parameters are in their domains.
pub fn figure5() -> Result<[Curve; 2], PaperError> {
    let (relay, sweep) = (relay()?, Sinusoid::new(0.0, 2.5 * HALF_WIDTH)?);
    Ok([Branch::Rising, Branch::Falling].map(|branch| {
        let inputs = (-250..=250).map(|i| f64::from(i) / 100.0 * HALF_WIDTH);
        inputs.map(|x| (x, relay.output(x, branch, &sweep))).collect()
    }))
}

/// Regenerates Fig. 6: two periods of the input `0.4 + 2 sin` and of the same relay's output, over time in periods. The output is
/// longer at the upper level, as the input's mean is positive.
///
/// # Errors
/// None in practice: the parameters are in their domains.
pub fn figure6() -> Result<[Curve; 2], PaperError> {
    let (relay, sweep) = (relay()?, Sinusoid::new(0.4, 2.0)?);
    let times = || (0..=1000).map(|i| f64::from(i) / 500.0);
    let input = |time: f64| sweep.bias() + sweep.amplitude() * libm::sin(core::f64::consts::TAU * time);
    let output = |time: f64| {
        let rising = libm::cos(core::f64::consts::TAU * time) > 0.0;
        relay.output(input(time), if rising { Branch::Rising } else { Branch::Falling }, &sweep)
    };
    Ok([times().map(|time| (time, input(time))).collect(), times().map(|time| (time, output(time))).collect()])
}

/// Fig. 7: a relay that should switch at 3 sees 2.15 and, a step later, 6.57, and switches there.
#[derive(Clone, Debug, PartialEq)]
pub struct LateSwitching7 {
    /// The input between samples, over time in steps.
    pub input: Curve,
    /// What is sampled.
    pub samples: Curve,
    /// The level at which it should switch.
    pub preset_level: f64,
    /// The sample at which it does.
    pub switching: (f64, f64),
}

/// Regenerates Fig. 7: the two printed samples fix a sinusoid of amplitude 10.
#[must_use]
pub fn figure7() -> LateSwitching7 {
    let (before, after, step, amplitude, preset_level) = (2.15_f64, 6.57_f64, 5.0, 10.0, 3.0);
    let (first, second) = (libm::asin(before / amplitude), libm::asin(after / amplitude));
    let input = |time: f64| amplitude * libm::sin(first + (second - first) * (time - step));
    let samples: Curve = (0..=11).map(|i| (f64::from(i), input(f64::from(i)))).collect();
    let late = samples.windows(2).find(|pair| pair[0].1 < preset_level && pair[1].1 >= preset_level);
    LateSwitching7 {
        input: (0..=220).map(|i| f64::from(i) / 20.0).map(|time| (time, input(time))).collect(),
        switching: late.map_or((step + 1.0, after), |pair| pair[1]),
        samples,
        preset_level,
    }
}
