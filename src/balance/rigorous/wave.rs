//! A trigonometric polynomial `u(theta) = Re sum of X_k exp(jk theta)` of odd orders, or of all, and where it passes kinks.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::error::CannotTell;
use crate::numeric::{Complex, Interval, Real, scan};

/// Cells into which the wave's span is divided at first, and bisections of a cell at most.
const CELLS: usize = 64;
const BISECTIONS: u32 = 30;

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
    pub(super) fn first(self) -> usize {
        match self {
            Self::Odd => 1,
            Self::All => 0,
        }
    }

    /// From an order to the next.
    pub(super) fn step(self) -> usize {
        self.first() + 1
    }

    /// Harmonics without imaginary part: X_1, which sets the phase, and the mean.
    pub(super) fn reals(self) -> usize {
        2 - self.first()
    }

    pub(super) fn at(self, place: usize) -> usize {
        self.first() + self.step() * place
    }

    pub(super) fn place(self, order: usize) -> Option<usize> {
        let beyond = order.checked_sub(self.first())?;
        beyond.is_multiple_of(self.step()).then_some(beyond / self.step())
    }

    /// The number of orders up to the highest.
    pub(super) fn count(self, highest: usize) -> usize {
        (highest + 1).div_ceil(self.step())
    }

    /// Phases after which the wave repeats itself, with the opposite sign if odd.
    pub(super) fn span(self) -> Interval {
        Interval::PI * Interval::point(2.0) / natural(self.step())
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

/// Highest harmonic of a wave at most: the equations of all of them are solved together.
pub(super) const HIGHEST: usize = 299;

pub(super) fn natural(n: usize) -> Interval {
    Interval::point(n as f64)
}

/// `sqrt(sum of squares)`.
pub(super) fn length(parts: impl Iterator<Item = Interval>) -> Interval {
    parts.fold(Interval::ZERO, |sum, part| sum + part.square()).sqrt()
}

/// The characteristic's input: real and imaginary parts of its harmonics by growing order, `X_1 = a` real.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wave {
    pub(super) omega_rad_s: f64,
    pub(super) orders: HarmonicOrders,
    pub(super) harmonics: Vec<[f64; 2]>,
}

/// A passage of the wave through a kink or its opposite, within its span.
#[derive(Clone, Copy, Debug)]
pub(super) struct KinkPassage {
    /// Phase, rad.
    pub(super) theta: Interval,
    /// The input there.
    pub(super) level: f64,
    /// What the slope grows by.
    pub(super) jump: Interval,
    /// Lower bound of the speed, per rad, wherever the wave is within the margin of the level.
    pub(super) speed: Interval,
}

impl Wave {
    /// Real unknowns: frequency, then the harmonics' parts that are not zero by definition.
    pub(super) fn unknowns(&self) -> DVector<f64> {
        DVector::from_vec(core::iter::once(self.omega_rad_s).chain(self.orders.unknowns(&self.harmonics)).collect())
    }

    /// The wave of new unknowns of the same orders.
    pub(super) fn moved(&self, unknowns: &DVector<f64>) -> Self {
        let (orders, harmonics) = (self.orders, self.orders.pairs(&unknowns.as_slice()[1..]));
        Self { omega_rad_s: unknowns[0], orders, harmonics }
    }

    pub(super) fn amplitude(&self) -> f64 {
        self.harmonics[self.orders.reals() - 1][0]
    }

    pub(super) fn highest(&self) -> usize {
        self.orders.at(self.harmonics.len() - 1)
    }

    pub(super) fn terms<T: Real>(&self) -> impl Iterator<Item = (usize, Complex<T>)> + '_ {
        let term = |&[re, im]: &[f64; 2]| Complex::new(T::from_f64(re), T::from_f64(im));
        self.harmonics.iter().enumerate().map(move |(place, pair)| (self.orders.at(place), term(pair)))
    }

    /// Upper bound of `sum k^power abs(X_k)`: of the power's derivative, at every phase.
    pub(super) fn sum_of_magnitudes(&self, power: u32) -> Interval {
        self.terms().fold(Interval::ZERO, |sum, (k, harmonic)| sum + harmonic.norm() * natural(k.pow(power)))
    }

    /// `sum abs(X_k) sinh(k sigma)` and the same with the hyperbolic cosine: bounds of the imaginary and the real part at phases
    /// whose imaginary part is at most `sigma`.
    pub(super) fn strip(&self, sigma: Interval) -> (Interval, Interval) {
        self.terms::<Interval>().fold((Interval::ZERO, Interval::ZERO), |(sinh, cosh), (k, harmonic)| {
            let (size, at) = (harmonic.norm(), sigma * natural(k));
            (sinh + size * at.sinh(), cosh + size * at.cosh())
        })
    }

    /// Value and derivative at a phase.
    pub(super) fn at<T: Real>(&self, theta: T) -> (T, T) {
        self.terms().fold((T::zero(), T::zero()), |(value, slope), (k, harmonic): (_, Complex<T>)| {
            let order = T::from_f64(k as f64);
            let turned = harmonic * Complex::turn(theta * order);
            (value + turned.re, slope - order * turned.im)
        })
    }

    /// Every passage of a span through `kinks` and their opposites, and the wave at its start, which is away from every kink.
    ///
    /// A cell is settled where the wave keeps more than `margin` from every level, or where its derivative has a constant sign.
    /// A run of cells of the second kind lies between two of the first, hence it passes each level between its ends once.
    pub(super) fn passages(
        &self,
        kinks: &[f64],
        slopes: &[f64],
        margin: f64,
    ) -> Result<(Vec<KinkPassage>, Interval), CannotTell> {
        // With what the slope of the characteristic grows by on the way up.
        let up = |pair: &[f64]| Interval::point(pair[1]) - Interval::point(pair[0]);
        let both = kinks.iter().zip(slopes.windows(2)).flat_map(|(kink, pair)| [(*kink, up(pair)), (-kink, -up(pair))]);
        let levels: Vec<(f64, Interval)> = both.collect();
        let bend = self.sum_of_magnitudes(2);
        let span = self.orders.span();
        let grazing = |cell: Interval| CannotTell::Grazing { theta_rad: cell.lower() };
        // From the phase that is farthest from every kink.
        let distance = |theta: f64| {
            let (value, _) = self.at(theta);
            levels.iter().map(|(level, _)| (value - level).abs()).fold(f64::INFINITY, f64::min)
        };
        let phases = (0..CELLS).map(|i| span.midpoint() * i as f64 / CELLS as f64);
        let start = phases.max_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(0.0);
        let end = (Interval::point(start) + span).upper();
        // Value and derivative over a cell, by the mean value theorem.
        let over = |cell: Interval| {
            let middle = Interval::point(cell.midpoint());
            let (value, slope) = self.at(middle);
            let slope = slope + Interval::symmetric((bend * (cell - middle).abs()).upper());
            (value + slope * (cell - middle), slope)
        };

        // Cells from left to right, with the slope where a level is near.
        let mut settled: Vec<(Interval, Option<Interval>)> = Vec::new();
        let ends = |i: usize| if i == CELLS { end } else { start + (end - start) * i as f64 / CELLS as f64 };
        let cell = |i: usize| Interval::point(ends(i)).hull(Interval::point(ends(i + 1)));
        let mut open: Vec<(Interval, u32)> = (0..CELLS).rev().map(|i| (cell(i), BISECTIONS)).collect();
        while let Some((cell, bisections)) = open.pop() {
            let (value, slope) = over(cell);
            if levels.iter().all(|&(level, _)| (value - Interval::point(level)).abs().lower() > margin) {
                settled.push((cell, None));
            } else if !slope.contains_zero() {
                settled.push((cell, Some(slope)));
            } else if bisections == 0 {
                return Err(grazing(cell));
            } else {
                let (left, right) = cell.bisect();
                open.extend([(right, bisections - 1), (left, bisections - 1)]);
            }
        }
        let mut all = Vec::new();
        for run in settled.chunk_by(|a, b| a.1.is_some() == b.1.is_some()) {
            let Some(slope) = run.iter().map(|cell| cell.1).reduce(|a, b| Some(a?.hull(b?))).flatten() else {
                continue;
            };
            let cell = run[0].0.hull(run[run.len() - 1].0);
            // The first and the last cell of the span are away from every level.
            if slope.contains_zero() || cell.lower() <= start || cell.upper() >= end {
                return Err(grazing(cell));
            }
            for &(level, jump) in &levels {
                let above = |theta: f64| self.at(Interval::point(theta)).0 - Interval::point(level);
                let ends = [cell.lower(), cell.upper()].map(above);
                if ends.iter().any(|end| end.contains_zero()) {
                    return Err(grazing(cell));
                }
                if ends[0].is_positive() == ends[1].is_positive() {
                    continue;
                }
                // From a guess by the mean value theorem, first over the run, then over what that leaves.
                let guess = scan::bracketed(&mut |theta| Some(self.at(theta).0 - level), cell.lower(), cell.upper());
                let narrowed = guess.and_then(|guess| {
                    let towards = |slope: Interval| Interval::point(guess) - above(guess) / slope;
                    let part = towards(slope).intersection(cell)?;
                    towards(over(part.hull(Interval::point(guess))).1).intersection(part)
                });
                let theta = narrowed.ok_or(grazing(cell))?;
                let jump = if slope.is_positive() { jump } else { -jump };
                all.push(KinkPassage { theta, level, jump, speed: slope.abs() });
            }
        }
        Ok((all, self.at(Interval::point(start)).0))
    }
}
