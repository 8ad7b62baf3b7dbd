//! A trigonometric polynomial `u(theta) = Re sum of X_k exp(jk theta)` of odd orders, or of all, and where it passes kinks.

use serde::{Deserialize, Serialize};

use super::error::CannotTell;
use crate::numeric::{Complex, Interval, Real};

/// Cells into which the wave's span is divided at first, and bisections of a cell at most.
const CELLS: usize = 64;
const BISECTIONS: u32 = 30;
/// Steps that narrow a passage at most: halvings first, then Newton's, which square the width.
const STEPS: usize = 60;

/// Orders of the harmonics that an oscillation may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HarmonicOrders {
    /// 1, 3, 5, ...: half-wave symmetric, `x(t + T/2) = -x(t)`.
    Odd,
    /// 0, 1, 2, ...: the mean is order 0.
    All,
}

impl HarmonicOrders {
    /// The least order.
    pub(super) fn first(self) -> usize {
        match self {
            Self::Odd => 1,
            Self::All => 0,
        }
    }

    /// From an order to the next.
    pub(super) fn step(self) -> usize {
        match self {
            Self::Odd => 2,
            Self::All => 1,
        }
    }

    /// Harmonics without imaginary part: X_1, which sets the phase, and the mean.
    pub(super) fn reals(self) -> usize {
        match self {
            Self::Odd => 1,
            Self::All => 2,
        }
    }

    pub(super) fn step_enclosed(self) -> Interval {
        Interval::point(self.step() as f64)
    }

    /// The order at a place.
    pub(super) fn at(self, place: usize) -> usize {
        self.first() + self.step() * place
    }

    /// The place of an order.
    pub(super) fn place(self, order: usize) -> Option<usize> {
        let beyond = order.checked_sub(self.first())?;
        beyond.is_multiple_of(self.step()).then_some(beyond / self.step())
    }

    /// All after an order up to the last.
    pub(super) fn between(self, after: usize, last: usize) -> impl Iterator<Item = usize> {
        (after + self.step()..=last).step_by(self.step())
    }

    /// Phases after which the wave repeats itself, with the opposite sign if odd.
    pub(super) fn span(self) -> Interval {
        Interval::PI * Interval::point(2.0) / self.step_enclosed()
    }

    /// The real unknowns among pairs of real and imaginary parts.
    pub(super) fn unknowns(self, pairs: &[[f64; 2]]) -> impl Iterator<Item = f64> + '_ {
        let parts = move |(place, pair): (usize, &[f64; 2])| pair[..if place < self.reals() { 1 } else { 2 }].to_vec();
        pairs.iter().enumerate().flat_map(parts)
    }

    /// The pairs of those unknowns.
    pub(super) fn pairs(self, unknowns: &[f64]) -> Vec<[f64; 2]> {
        let (reals, rest) = unknowns.split_at(self.reals());
        reals.iter().map(|&real| [real, 0.0]).chain(rest.chunks_exact(2).map(|pair| [pair[0], pair[1]])).collect()
    }
}

/// Its harmonics, by growing order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wave {
    pub(super) orders: HarmonicOrders,
    pub(super) harmonics: Vec<Complex<f64>>,
}

/// A passage of the wave through a level, within its span.
#[derive(Clone, Copy, Debug)]
pub(super) struct KinkPassage {
    /// Phase, rad.
    pub(super) theta: Interval,
    /// Index of the kink, and the input there: that kink or its opposite.
    pub(super) kink: usize,
    pub(super) level: f64,
    /// Whether the magnitude of the wave grows there.
    pub(super) outwards: bool,
    /// Lower bound of the speed, per rad, wherever the wave is within the margin of the level.
    pub(super) speed: Interval,
}

/// The passages of a span in order, which begins and ends away from every kink.
#[derive(Clone, Debug)]
pub(super) struct KinkPassages {
    pub(super) all: Vec<KinkPassage>,
    /// Kinks inside the wave's magnitude at the start, and whether the wave is below zero there.
    pub(super) piece: usize,
    pub(super) below_zero: bool,
}

impl Wave {
    /// Highest harmonic.
    pub(super) fn highest(&self) -> usize {
        self.orders.at(self.harmonics.len() - 1)
    }

    /// Orders and harmonics.
    pub(super) fn terms(&self) -> impl Iterator<Item = (usize, Complex<f64>)> + '_ {
        self.harmonics.iter().enumerate().map(|(place, &harmonic)| (self.orders.at(place), harmonic))
    }

    /// Upper bound of `sum k^power abs(X_k)`: of the power's derivative, at every phase.
    pub(super) fn sum_of_magnitudes(&self, power: usize) -> Interval {
        self.terms().fold(Interval::ZERO, |sum, (k, harmonic)| {
            let weight = Interval::point((k as f64).powi(power as i32));
            sum + harmonic.enclosed().norm() * weight
        })
    }

    /// Root mean square of the derivative of that order, above zero.
    pub(super) fn root_mean_square(&self, power: usize) -> Interval {
        let half = Interval::point(0.5);
        let square = self.terms().fold(Interval::ZERO, |sum, (k, harmonic)| {
            sum + harmonic.enclosed().square_norm() * Interval::point((k as f64).powi(2 * power as i32)) * half
        });
        square.sqrt()
    }

    /// `sum abs(X_k) sinh(k sigma)` and the same with the hyperbolic cosine: bounds of the imaginary and the real part at phases
    /// whose imaginary part is at most `sigma`.
    pub(super) fn strip(&self, sigma: Interval) -> (Interval, Interval) {
        self.terms().fold((Interval::ZERO, Interval::ZERO), |(sinh, cosh), (k, harmonic)| {
            let (size, at) = (harmonic.enclosed().norm(), sigma * Interval::point(k as f64));
            (sinh + size * at.sinh(), cosh + size * at.cosh())
        })
    }

    /// Value and derivative at a phase.
    pub(super) fn at<T: Real>(&self, theta: T) -> (T, T) {
        self.terms().fold((T::zero(), T::zero()), |(value, slope), (k, harmonic)| {
            let order = T::from_f64(k as f64);
            let angle = theta * order;
            let (sin, cos, re, im) = (angle.sin(), angle.cos(), T::from_f64(harmonic.re), T::from_f64(harmonic.im));
            (value + re * cos - im * sin, slope - order * (re * sin + im * cos))
        })
    }

    /// Every passage of a span through `kinks` and their opposites.
    ///
    /// A cell is settled where the wave keeps more than `margin` from every level, or where its derivative has a constant sign.
    /// A run of cells of the second kind lies between two of the first, hence it passes each level between its ends once.
    pub(super) fn passages(&self, kinks: &[f64], margin: f64) -> Result<KinkPassages, CannotTell> {
        let levels: Vec<(usize, f64)> =
            kinks.iter().enumerate().flat_map(|(i, &kink)| [(i, kink), (i, -kink)]).collect();
        let bend = self.sum_of_magnitudes(2);
        let distance = |theta: f64| {
            let (value, _) = self.at(theta);
            levels.iter().map(|(_, level)| (value - level).abs()).fold(f64::INFINITY, f64::min)
        };
        let span = self.orders.span();
        let phases = (0..CELLS).map(|i| span.midpoint() * i as f64 / CELLS as f64);
        let start_rad = phases.max_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(0.0);
        let grazing = |theta_rad: f64| CannotTell::Grazing { theta_rad };
        let end = (Interval::point(start_rad) + span).upper();

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
                all.push(KinkPassage { theta, kink, level, outwards, speed: run.slope.abs() });
            }
            all[before..].sort_by(|a, b| a.theta.lower().total_cmp(&b.theta.lower()));
        }
        let (value, _) = self.at(Interval::point(start_rad));
        let piece = kinks.iter().filter(|&&kink| value.abs().lower() > kink).count();
        Ok(KinkPassages { all, piece, below_zero: value.is_negative() })
    }

    /// The passage through a level in a cell over which the derivative has a constant sign, by interval Newton.
    fn narrowed(&self, mut cell: Interval, level: Interval, bend: Interval) -> Option<Interval> {
        for _ in 0..STEPS {
            let middle = Interval::point(cell.midpoint());
            let (value, slope) = self.at(middle);
            let slope = slope + Interval::symmetric((bend * (cell - middle).abs()).upper());
            if slope.contains_zero() {
                // Only the run's parts are shown to have a constant sign: halve towards the passage.
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

/// Cells side by side over which the derivative has a constant sign.
struct MonotoneRun {
    cell: Interval,
    slope: Interval,
}
