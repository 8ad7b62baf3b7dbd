//! The inverse problem: the amplitude that has a given gain.

use core::ops::RangeInclusive;

use super::{ClosedForm, DescribingError, DescribingFunction, over_amplitudes};
use crate::nonlinearity::{NonlinearityError, Sinusoid, checked_amplitude};
use crate::numeric::{domain, golden_section};

/// Amplitudes at which a range is sampled, evenly in their logarithm.
const SAMPLES: u32 = 1000;
/// Steps of bisection: more than a float has bits.
const STEPS: u32 = 80;
/// Difference, over the value or what the crossing started from, at which it counts as one, not as a jump over the value.
const CROSSED: f64 = 1e-9;

/// An amplitude and what the characteristic does there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// Amplitude of the input, in input units.
    pub amplitude: f64,
    /// `F_0`, `P`, `Q` at this amplitude.
    pub df: DescribingFunction<f64>,
}

/// Every amplitude of `range` found at which `P` has the value `p`, growing. A gain often has two (a relay with dead zone).
///
/// The range is sampled at 1000 amplitudes, and where P turns between two samples its extremum is looked for; solutions
/// closer together than that can be missed. Amplitudes without describing function are passed over.
///
/// # Errors
/// [`NonlinearityError::OutOfDomain`](crate::nonlinearity::NonlinearityError::OutOfDomain) unless both ends of the range are positive and finite.
///
/// ```
/// use selfosc::describing::amplitudes;
/// use selfosc::nonlinearity::RelayDeadZone;
/// let relay = RelayDeadZone::new(1.0, 0.5)?;
/// let found = amplitudes(&relay, 0.0, 1.0, 0.1..=10.0)?;
/// assert_eq!(found.len(), 2);
/// assert!(found.iter().all(|solution| (solution.df.p - 1.0).abs() < 1e-12));
/// # Ok::<(), selfosc::describing::DescribingError>(())
/// ```
pub fn amplitudes(
    characteristic: &(impl ClosedForm<Number = f64> + ?Sized),
    bias: f64,
    p: f64,
    range: RangeInclusive<f64>,
) -> Result<Vec<Solution>, DescribingError> {
    domain::finite("bias", bias, "input units").map_err(NonlinearityError::from)?;
    domain::finite("gain", p, "output units per input unit").map_err(NonlinearityError::from)?;
    let excess = |solution: Solution| solution.df.p - p;
    let solve = |amplitude| at(characteristic, bias, amplitude);
    let samples = sampled(characteristic, bias, range)?;
    let mut found = Vec::new();
    // `reach`: the difference that a crossing may start from.
    let mut bracket = |low: Solution, high: Solution, reach: f64| {
        let (mut low, mut high) = (low, high);
        for _ in 0..STEPS {
            let Ok(middle) = solve(0.5 * (low.amplitude + high.amplitude)) else { return };
            if (excess(middle) < 0.0) == (excess(low) < 0.0) { low = middle } else { high = middle }
        }
        let nearer = if excess(low).abs() < excess(high).abs() { low } else { high };
        if excess(nearer).abs() <= CROSSED * p.abs().max(reach) {
            found.push(nearer);
        }
    };
    for (place, pair) in samples.windows(2).enumerate() {
        let (low, high) = (pair[0], pair[1]);
        if (excess(low) < 0.0) != (excess(high) < 0.0) {
            bracket(low, high, excess(low).abs().max(excess(high).abs()));
            continue;
        }
        // A turn towards the value, with the sample after these two farther away again.
        let Some(&beyond) = samples.get(place + 2) else { continue };
        let distance = |solution: Solution| excess(solution).abs();
        if (excess(beyond) < 0.0) == (excess(low) < 0.0) && distance(high) < distance(low).min(distance(beyond)) {
            let nearest = minimum(low, beyond, &solve, distance);
            let signed = |solution: Solution| if excess(low) < 0.0 { -excess(solution) } else { excess(solution) };
            let turn = minimum(low, beyond, &solve, signed);
            if (excess(turn) < 0.0) == (excess(low) < 0.0) {
                if distance(nearest) <= CROSSED * p.abs().max(distance(low)) {
                    bracket(nearest, nearest, distance(low));
                }
            } else {
                bracket(low, turn, distance(low));
                bracket(turn, beyond, distance(beyond));
            }
        }
    }
    Ok(found)
}

fn at(
    characteristic: &(impl ClosedForm<Number = f64> + ?Sized),
    bias: f64,
    amplitude: f64,
) -> Result<Solution, DescribingError> {
    let df = characteristic.describing_function(&Sinusoid::new(bias, amplitude)?)?;
    Ok(Solution { amplitude, df })
}

/// The range sampled evenly in the logarithm, without the amplitudes that have no describing function.
fn sampled(
    characteristic: &(impl ClosedForm<Number = f64> + ?Sized),
    bias: f64,
    range: RangeInclusive<f64>,
) -> Result<Vec<Solution>, DescribingError> {
    let (from, to) = range.into_inner();
    for amplitude in [from, to] {
        checked_amplitude(amplitude)?;
    }
    let amplitude = |k: u32| {
        let share = f64::from(k) / f64::from(SAMPLES);
        let ratio = to / from;
        if ratio.is_finite() {
            from * libm::pow(ratio, share)
        } else {
            libm::pow(from, 1.0 - share) * libm::pow(to, share)
        }
    };
    let grid = (0..=SAMPLES).map(amplitude);
    let results = over_amplitudes(characteristic, bias, grid.clone());
    Ok(grid.zip(results).filter_map(|(amplitude, df)| Some(Solution { amplitude, df: df.ok()? })).collect())
}

/// Golden-section search for the least `cost` between two solutions.
fn minimum(
    low: Solution,
    high: Solution,
    solve: &impl Fn(f64) -> Result<Solution, DescribingError>,
    cost: impl Fn(Solution) -> f64,
) -> Solution {
    let mut best = if cost(low) < cost(high) { low } else { high };
    let seen = |amplitude| {
        let solution = solve(amplitude).ok()?;
        if cost(solution) < cost(best) {
            best = solution;
        }
        Some(cost(solution))
    };
    golden_section(seen, low.amplitude, high.amplitude, 0.0);
    best
}
