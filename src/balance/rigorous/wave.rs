//! A half-wave symmetric trigonometric polynomial `u(theta) = Re sum over odd k of X_k exp(jk theta)`, and where it passes kinks.

use super::error::CannotTell;
use crate::numeric::{Complex, Interval, Real};

/// Cells into which half a turn is divided at first, and bisections of a cell at most.
const CELLS: usize = 64;
const BISECTIONS: u32 = 30;
/// Steps that narrow a passage at most: halvings first, then Newton's, which square the width.
const STEPS: usize = 60;

/// Its harmonics X_1, X_3, X_5, ...
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wave(pub(super) Vec<Complex<f64>>);

/// A passage of the wave through a level, within half a turn.
#[derive(Clone, Copy, Debug)]
pub(super) struct KinkPassage {
    /// Phase, rad.
    pub(super) theta: Interval,
    /// Index of the kink and whether it is the one below zero.
    pub(super) kink: usize,
    /// Whether the magnitude of the wave grows there.
    pub(super) outwards: bool,
    /// Lower bound of the speed, per rad, wherever the wave is within the margin of the level.
    pub(super) speed: Interval,
}

/// The passages of half a turn in order, which begins and ends away from every kink.
#[derive(Clone, Debug)]
pub(super) struct KinkPassages {
    pub(super) all: Vec<KinkPassage>,
    /// Kinks inside the wave's magnitude at the start.
    pub(super) piece: usize,
}

impl Wave {
    /// Highest harmonic.
    pub(super) fn highest(&self) -> usize {
        2 * self.0.len() - 1
    }

    pub(super) fn orders(&self) -> impl Iterator<Item = (usize, Complex<f64>)> + '_ {
        self.0.iter().enumerate().map(|(index, &harmonic)| (2 * index + 1, harmonic))
    }

    /// Upper bound of `sum k^power abs(X_k)`: of the power's derivative, at every phase.
    pub(super) fn sum_of_magnitudes(&self, power: usize) -> Interval {
        self.orders().fold(Interval::ZERO, |sum, (k, harmonic)| {
            let weight = Interval::point((k as f64).powi(power as i32));
            sum + harmonic.enclosed().norm() * weight
        })
    }

    /// Root mean square of the derivative of that order.
    pub(super) fn root_mean_square(&self, power: usize) -> Interval {
        let half = Interval::point(0.5);
        let square = self.orders().fold(Interval::ZERO, |sum, (k, harmonic)| {
            sum + harmonic.enclosed().square_norm() * Interval::point((k as f64).powi(2 * power as i32)) * half
        });
        square.sqrt()
    }

    /// `sum abs(X_k) sinh(k sigma)` and the same with the hyperbolic cosine: bounds of the imaginary and the real part at phases
    /// whose imaginary part is at most `sigma`.
    pub(super) fn strip(&self, sigma: Interval) -> (Interval, Interval) {
        self.orders().fold((Interval::ZERO, Interval::ZERO), |(sinh, cosh), (k, harmonic)| {
            let (size, at) = (harmonic.enclosed().norm(), sigma * Interval::point(k as f64));
            (sinh + size * at.sinh(), cosh + size * at.cosh())
        })
    }

    /// Value and derivative at a phase.
    pub(super) fn at<T: Real>(&self, theta: T) -> (T, T) {
        self.orders().fold((T::zero(), T::zero()), |(value, slope), (k, harmonic)| {
            let order = T::from_f64(k as f64);
            let angle = theta * order;
            let (sin, cos, re, im) = (angle.sin(), angle.cos(), T::from_f64(harmonic.re), T::from_f64(harmonic.im));
            (value + re * cos - im * sin, slope - order * (re * sin + im * cos))
        })
    }

    /// Every passage of half a turn through `kinks` and their opposites.
    ///
    /// A cell is settled where the wave keeps more than `margin` from every level, or where its derivative has one sign. A run of
    /// cells of the second kind lies between two of the first, so it passes each level between its ends once.
    pub(super) fn passages(&self, kinks: &[f64], margin: f64) -> Result<KinkPassages, CannotTell> {
        let levels: Vec<(usize, f64)> =
            kinks.iter().enumerate().flat_map(|(i, &kink)| [(i, kink), (i, -kink)]).collect();
        let bend = self.sum_of_magnitudes(2);
        let distance = |theta: f64| {
            let (value, _) = self.at(theta);
            levels.iter().map(|(_, level)| (value - level).abs()).fold(f64::INFINITY, f64::min)
        };
        let phases = (0..CELLS).map(|i| core::f64::consts::PI * i as f64 / CELLS as f64);
        let start_rad = phases.max_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(0.0);
        let grazing = |theta_rad: f64| CannotTell::Grazing { theta_rad };
        let end = (Interval::point(start_rad) + Interval::PI).upper();

        let mut runs: Vec<MonotoneRun> = Vec::new();
        let mut clear_to = f64::NEG_INFINITY;
        let ends = |i: usize| if i == CELLS { end } else { start_rad + (end - start_rad) * i as f64 / CELLS as f64 };
        let mut open: Vec<(f64, f64, u32)> = (0..CELLS).rev().map(|i| (ends(i), ends(i + 1), BISECTIONS)).collect();
        while let Some((from, to, bisections)) = open.pop() {
            let Some(cell) = Interval::new(from, to) else { return Err(grazing(from)) };
            let middle = Interval::point(cell.midpoint());
            let (value, slope) = self.at(middle);
            let slope = slope + Interval::symmetric((bend * (cell - middle).abs()).upper());
            let value = value + slope * (cell - middle);
            if levels.iter().all(|&(_, level)| (value - Interval::point(level)).abs().lower() > margin) {
                clear_to = to;
            } else if !slope.contains_zero() {
                match runs.last_mut() {
                    // The cell before is settled the same way.
                    Some(run) if run.cell.upper() >= from => {
                        if run.slope.is_positive() != slope.is_positive() {
                            return Err(grazing(from));
                        }
                        *run = MonotoneRun { cell: run.cell.hull(cell), slope: run.slope.hull(slope) };
                    }
                    _ if clear_to >= from => runs.push(MonotoneRun { cell, slope }),
                    _ => return Err(grazing(from)),
                }
            } else if bisections == 0 {
                return Err(grazing(from));
            } else {
                let middle = cell.midpoint();
                open.extend([(middle, to, bisections - 1), (from, middle, bisections - 1)]);
            }
        }
        // The last cell is away from every level, as the first.
        if clear_to < end {
            return Err(grazing(end));
        }
        let mut all = Vec::new();
        for run in runs {
            let (low, high) = (Interval::point(run.cell.lower()), Interval::point(run.cell.upper()));
            let (at_low, at_high) = (self.at(low).0, self.at(high).0);
            let before = all.len();
            for &(kink, level) in &levels {
                let level_at = Interval::point(level);
                let (first, last) = (at_low - level_at, at_high - level_at);
                if first.contains_zero() || last.contains_zero() {
                    return Err(grazing(run.cell.lower()));
                }
                if first.is_positive() == last.is_positive() {
                    continue;
                }
                let theta = self.narrowed(run.cell, level_at, bend).ok_or(grazing(run.cell.lower()))?;
                let outwards = (level > 0.0) == run.slope.is_positive();
                all.push(KinkPassage { theta, kink, outwards, speed: run.slope.abs() });
            }
            all[before..].sort_by(|a, b| a.theta.lower().total_cmp(&b.theta.lower()));
        }
        let (value, _) = self.at(Interval::point(start_rad));
        let piece = kinks.iter().filter(|&&kink| value.abs().lower() > kink).count();
        Ok(KinkPassages { all, piece })
    }

    /// The passage through a level in a cell over which the derivative has one sign, by interval Newton.
    fn narrowed(&self, mut cell: Interval, level: Interval, bend: Interval) -> Option<Interval> {
        for _ in 0..STEPS {
            let middle = Interval::point(cell.midpoint());
            let (value, slope) = self.at(middle);
            let slope = slope + Interval::symmetric((bend * (cell - middle).abs()).upper());
            if slope.contains_zero() {
                // Only the run's parts are known to have one sign: halve towards the passage.
                let (below, above) = cell.bisect();
                let (start, centre) = (self.at(Interval::point(cell.lower())).0 - level, value - level);
                if centre.contains_zero() || start.contains_zero() {
                    return None;
                }
                cell = if start.is_positive() == centre.is_positive() { above } else { below };
                continue;
            }
            let next = cell.intersection(middle - (value - level) / slope)?;
            if next.width() > 0.5 * cell.width() {
                return Some(next);
            }
            cell = next;
        }
        Some(cell)
    }
}

/// Cells side by side over which the derivative has one sign.
struct MonotoneRun {
    cell: Interval,
    slope: Interval,
}
