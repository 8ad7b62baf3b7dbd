//! Cycles of the loop without dead time as fixed points of its return map, to 60 digits, attracting or not.

use f256::f256;

use super::characteristic::Characteristic;
use super::closed_loop::{ClosedLoop, Return};
use super::first_harmonic::{FirstHarmonic, Segment};
use super::harmonic_balance::Balance;
use crate::crossing::{leading, range};
use crate::linear::{Matrix, solve, spectral_radius};
use crate::plant::Plant;
use crate::scalar::Scalar;

/// A cycle.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// Period in s.
    pub period: f256,
    /// First harmonic of the output.
    pub first: FirstHarmonic<f256>,
    /// Second harmonic: zero to the rounding where the cycle is half-wave symmetric.
    pub second: FirstHarmonic<f256>,
    /// Largest output.
    pub maximum: f64,
    /// Smallest output.
    pub minimum: f64,
    /// Jacobian of the return map.
    pub jacobian: Matrix<f256>,
    /// The motion over the period.
    pub segments: Vec<Segment<f256>>,
    /// State of the plant where the output rises through the level.
    pub z: Vec<f256>,
    /// That level.
    pub level: f64,
    /// Rises through the level in a period.
    pub rises: usize,
}

impl Cycle {
    /// Frequency in rad/s.
    #[must_use]
    pub fn omega(&self) -> f64 {
        std::f64::consts::TAU / self.period.to_f64()
    }

    /// Its odd harmonics up to the 29th.
    #[must_use]
    pub fn balance(&self) -> Balance {
        Balance::of(&self.segments, self.omega())
    }

    /// Largest modulus of a multiplier.
    #[must_use]
    pub fn radius(&self) -> f64 {
        spectral_radius(&self.jacobian)
    }
}

/// Return map of the section on which the output rises through a level.
#[derive(Debug)]
pub struct ReturnMap<S> {
    control_loop: ClosedLoop<S>,
    level: S,
    rises: usize,
    longest: f64,
    /// State that the section determines.
    dependent: usize,
}

impl<S: Scalar> ReturnMap<S> {
    /// The map of a loop without dead time; returns that take longer are none.
    #[must_use]
    pub fn new(plant: &Plant, characteristic: &Characteristic, level: f64, rises: usize, longest: f64) -> Self {
        let control_loop = ClosedLoop::<S>::new(plant, characteristic);
        let dependent = control_loop.numerator.iter().position(|&b| b != S::ZERO).unwrap_or(0);
        Self { control_loop, level: S::from_f64(level), rises, longest, dependent }
    }

    /// The point of the section with these other states.
    fn on_section(&self, mut z: Vec<S>) -> Vec<S> {
        let off = self.level - self.control_loop.output(&z);
        z[self.dependent] = z[self.dependent] + off / self.control_loop.numerator[self.dependent];
        z
    }

    /// The next point of the section.
    #[must_use]
    pub fn next(&self, z: &[S]) -> Option<Return<S>> {
        let z = self.on_section(z.to_vec());
        self.control_loop.rise(self.control_loop.place(z, true), self.level, self.rises, self.longest)
    }

    fn free(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.control_loop.numerator.len()).filter(|&i| i != self.dependent)
    }
}

/// The cycle that Newton's iteration on the return map reaches; `None` where it reaches none.
#[must_use]
pub fn cycle(
    plant: &Plant,
    characteristic: &Characteristic,
    level: f64,
    rises: usize,
    start: &[f64],
    period: f64,
) -> Option<Cycle> {
    // In floats to their limit, then in 71 digits: three iterations.
    let floats = ReturnMap::<f64>::new(plant, characteristic, level, rises, 4.0 * period);
    let (z, _) = fixed_point(&floats, start.to_vec(), 40)?;
    let exact = ReturnMap::<f256>::new(plant, characteristic, level, rises, 4.0 * period);
    let (z, jacobian) = fixed_point(&exact, z.into_iter().map(f256::from).collect(), 12)?;
    let Return { duration, segments, .. } = exact.next(&z)?;
    let (mut minimum, mut maximum) = (f64::INFINITY, f64::NEG_INFINITY);
    for segment in &segments {
        let mut power = f256::ONE;
        let scaled: Vec<f256> = segment
            .output
            .iter()
            .map(|&c| {
                let one = c * power;
                power *= segment.duration;
                one
            })
            .collect();
        let (low, high) = range(&leading(&scaled));
        (minimum, maximum) = (minimum.min(low), maximum.max(high));
    }
    let (first, second) = (FirstHarmonic::of(&segments, 1), FirstHarmonic::of(&segments, 2));
    Some(Cycle { period: duration, first, second, maximum, minimum, jacobian, segments, z, level, rises })
}

/// Fixed point and Jacobian there.
fn fixed_point<S: Scalar>(map: &ReturnMap<S>, start: Vec<S>, iterations: usize) -> Option<(Vec<S>, Matrix<S>)> {
    let mut z = map.on_section(start);
    let free: Vec<usize> = map.free().collect();
    let mut before = f64::INFINITY;
    for _ in 0..iterations {
        let next = map.next(&z)?.z;
        let size = z.iter().fold(S::from_f64(1e-3), |most, z| if z.abs() > most { z.abs() } else { most });
        let difference = S::from_f64(S::ROUNDING.sqrt()) * size;
        let mut jacobian = vec![Vec::new(); free.len()];
        for &column in &free {
            let shifted = |by: S| {
                let mut moved = z.clone();
                moved[column] = moved[column] + by;
                map.next(&moved)
            };
            let (up, down) = (shifted(difference)?.z, shifted(-difference)?.z);
            for (row, &i) in jacobian.iter_mut().zip(&free) {
                row.push((up[i] - down[i]) / (difference + difference));
            }
        }
        let mut system = jacobian.clone();
        (0..free.len()).for_each(|i| system[i][i] = system[i][i] - S::ONE);
        let step = solve(system, free.iter().map(|&i| next[i] - z[i]).collect())?;
        let moved = step.iter().fold(0.0, |most: f64, one| most.max((*one / size).to_f64().abs()));
        // Far off, a full step may leave the neighbourhood.
        let share = S::from_f64((0.5 / moved).min(1.0));
        for (&i, &change) in free.iter().zip(&step) {
            z[i] = z[i] - share * change;
        }
        z = map.on_section(z);
        // Steps of rounding size grow no smaller.
        if moved < S::ROUNDING.powf(0.85) || (moved < S::ROUNDING.powf(0.6) && moved > 0.1 * before) {
            return Some((z, jacobian));
        }
        before = moved;
    }
    None
}

/// Whether a disturbance of 1e-3 dies out: followed in floats over 400 returns. `None` where it does neither.
#[must_use]
pub fn attracts(plant: &Plant, characteristic: &Characteristic, cycle: &Cycle) -> Option<bool> {
    let map = ReturnMap::<f64>::new(plant, characteristic, cycle.level, cycle.rises, 4.0 * cycle.period.to_f64());
    let rest: Vec<f64> = cycle.z.iter().map(|z| z.to_f64()).collect();
    let size = rest.iter().fold(0.0, |most: f64, z| most.max(z.abs()));
    let mut z: Vec<f64> =
        rest.iter().enumerate().map(|(i, z)| z + 1e-3 * size * [1.0, -0.7, 0.4, -0.9][i % 4]).collect();
    for count in 0..400 {
        let Some(next) = map.next(&z) else { return Some(false) };
        z = next.z;
        let off = z.iter().zip(&rest).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())) / size;
        if count >= 3 && off < 1e-5 {
            return Some(true);
        }
        if off > 0.1 {
            return Some(false);
        }
    }
    None
}

/// The cycle on which a simulation in floats settles from a start: its level, rises and state for [`cycle`].
#[derive(Clone, Debug)]
pub struct Settled {
    /// Middle of the output's extremes.
    pub level: f64,
    /// Rises through it in a period.
    pub rises: usize,
    /// State where it is risen through.
    pub z: Vec<f64>,
    /// Period in s.
    pub period: f64,
}

/// Follows a start for a time, then looks for a period; `None` where the motion escapes, comes to rest or does not repeat.
#[must_use]
pub fn settle(plant: &Plant, characteristic: &Characteristic, start: &[f64], duration: f64) -> Option<Settled> {
    let control_loop = ClosedLoop::<f64>::new(plant, characteristic);
    let segments = control_loop.run(control_loop.place(start.to_vec(), false), duration)?;
    let late = &segments[segments.len() - segments.len() / 4..];
    let values = late.iter().map(|segment| segment.output[0]);
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    if high - low < 1e-6 * high.abs().max(low.abs()) {
        return None;
    }
    let level = 0.5 * (low + high);
    // From the state at the end of the run, section by section.
    let end = control_loop.rise(control_loop.place(start.to_vec(), false), level, 1, duration)?;
    let mut points: Vec<(Vec<f64>, f64)> = Vec::new();
    let mut z = end.z;
    let map = ReturnMap::<f64>::new(plant, characteristic, level, 1, duration);
    let mut elapsed = 0.0;
    while elapsed < duration {
        let next = map.next(&z)?;
        elapsed += next.duration;
        z = next.z;
        points.push((z.clone(), elapsed));
    }
    let (last, now) = points.last()?.clone();
    let size = last.iter().fold(0.0, |most: f64, z| most.max(z.abs()));
    (1..6.min(points.len())).find_map(|rises| {
        let (earlier, then) = &points[points.len() - 1 - rises];
        let off = last.iter().zip(earlier).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        (off < 1e-4 * size).then(|| Settled { level, rises, z: last.clone(), period: now - then })
    })
}
