//! The loop with dead time, integrated by Taylor series: the method of steps.
//!
//! The output of the last dead time is a queue of polynomials. Each step takes one off the front, feeds the characteristic with it
//! and appends the output that follows, so that the plant's input is analytic on every step. A passage through a kink splits the
//! appended polynomial; the split smooths by the plant's relative degree each time it comes round, and is forgotten when only
//! derivatives beyond the series jump.

use std::collections::VecDeque;

use super::characteristic::Characteristic;
use super::first_harmonic::{FirstHarmonic, Segment, shifted};
use super::harmonic_balance::Balance;
use crate::crossing::{Crossing, first_crossing};
use crate::linear::dot;
use crate::plant::Plant;
use crate::scalar::Scalar;

/// A polynomial of the queue.
#[derive(Clone, Debug)]
struct Piece {
    segment: Segment<f64>,
    /// Rounds since its beginning was a passage through a kink; `None` for the grid's own ends.
    rounds: Option<usize>,
}

/// The loop in motion.
#[derive(Debug)]
pub struct LateLoop {
    denominator: Vec<f64>,
    numerator: Vec<f64>,
    characteristic: Characteristic,
    relative_degree: usize,
    state: Vec<f64>,
    queue: VecDeque<Piece>,
}

/// A cycle that the integration has settled on.
#[derive(Clone, Debug)]
pub struct Settled {
    /// Period in s.
    pub period: f64,
    /// Amplitude of the first harmonic.
    pub amplitude: f64,
    /// Largest change of period and amplitude over the last periods, over themselves.
    pub drift: f64,
    /// Mean of the output.
    pub mean: f64,
    /// The last period.
    pub segments: Vec<Segment<f64>>,
}

impl Settled {
    /// Frequency in rad/s.
    #[must_use]
    pub fn omega(&self) -> f64 {
        std::f64::consts::TAU / self.period
    }

    /// Its odd harmonics up to the 29th; `None` where even ones show that it is not half-wave symmetric.
    #[must_use]
    pub fn balance(&self) -> Option<Balance> {
        let even = FirstHarmonic::of(&self.segments, 2).amplitude().max(self.mean.abs());
        (even < 1e-9 * self.amplitude).then(|| Balance::of(&self.segments, self.omega()))
    }
}

/// Steps in a period: high enough that 22 terms reach the rounding for a tanh overdriven ten times.
const STEPS: f64 = 240.0;
/// Periods after which an integration that has not settled is given up.
const PERIODS: usize = 4000;
/// Changes of period and amplitude that count as settled.
const SETTLED: f64 = 4e-15;

impl LateLoop {
    /// The loop on an oscillation of harmonic balance, disturbed by this factor. Harmonics above the ninth are left to the loop.
    #[must_use]
    pub fn on(plant: &Plant, characteristic: &Characteristic, balance: &Balance, factor: f64) -> Self {
        let ascending =
            |coefficients: &[f64]| -> Vec<f64> { coefficients.iter().rev().map(|c| c / plant.den[0]).collect() };
        let mut denominator = ascending(&plant.den);
        denominator.pop();
        let mut numerator = ascending(&plant.num);
        numerator.resize(denominator.len(), 0.0);

        let mut few = balance.clone();
        few.harmonics.truncate(5);
        few.harmonics.iter_mut().for_each(|x| *x *= factor);
        let root = |(i, a): (usize, &f64)| a.abs().powf(1.0 / (i + 1) as f64);
        let rate = denominator.iter().rev().enumerate().map(root).fold(0.0, f64::max);
        let longest = (std::f64::consts::TAU / balance.omega / STEPS).min(0.5 / rate);
        let steps = (plant.delay / longest).ceil().max(1.0);
        let h = plant.delay / steps;
        let mut found = Self {
            denominator,
            numerator,
            characteristic: characteristic.clone(),
            relative_degree: plant.relative_degree(),
            state: few.state(plant, 0.0),
            queue: VecDeque::new(),
        };
        for step in 0..steps as usize {
            let angle = few.omega * (step as f64 * h - plant.delay);
            let output = (0..=f64::ORDER).map(|k| derivative(&few, k, angle)).collect();
            found.append(Segment { duration: h, output }, None);
        }
        found
    }

    /// One step; the output that follows.
    fn step(&mut self) -> Option<Vec<Segment<f64>>> {
        let Piece { segment, rounds } = self.queue.pop_front()?;
        let middle = segment.output.iter().rev().fold(0.0, |sum, c| sum * 0.5 * segment.duration + c);
        let mut fed_back = self.characteristic.series::<f64>(self.characteristic.piece(middle));
        let n = self.state.len();
        let mut series: Vec<Vec<f64>> = self.state.iter().map(|&z| vec![z]).collect();
        for k in 0..f64::ORDER {
            let highest =
                (0..n).fold(-fed_back.push(segment.output[k]), |sum, i| sum - self.denominator[i] * series[i][k]);
            for i in 0..n {
                let rate = if i + 1 < n { series[i + 1][k] } else { highest };
                series[i].push(rate / (k + 1) as f64);
            }
        }
        let h = segment.duration;
        let output = (0..=f64::ORDER)
            .map(|k| dot(&self.numerator, &series.iter().map(|one| one[k]).collect::<Vec<_>>()))
            .collect();
        self.state = series.iter().map(|one| one.iter().rev().fold(0.0, |sum, c| sum * h + c)).collect();
        let finite = self.state.iter().all(|z| z.abs() < 1e6);
        let appended = self.append(Segment { duration: h, output }, rounds.map(|rounds| rounds + 1));
        finite.then_some(appended)
    }

    /// Appends an output, split where it passes kinks.
    fn append(&mut self, segment: Segment<f64>, rounds: Option<usize>) -> Vec<Segment<f64>> {
        let Segment { duration, output } = segment;
        let mut cuts: Vec<f64> = Vec::new();
        for &kink in self.characteristic.kinks() {
            let mut scaled = Vec::with_capacity(output.len());
            let mut power = 1.0;
            for &c in &output {
                scaled.push(c * power);
                power *= duration;
            }
            scaled[0] -= kink;
            if scaled[0] < 0.0 {
                scaled.iter_mut().for_each(|c| *c = -*c);
            }
            // A step is short beside the period: at most one passage through a kink.
            if let Crossing::At(at) = first_crossing(&scaled)
                && at > 1e-9
                && at < 1.0 - 1e-9
            {
                cuts.push(at * duration);
            }
        }
        cuts.sort_by(f64::total_cmp);
        let ends: Vec<f64> = cuts.iter().copied().chain([duration]).collect();
        let mut begin = 0.0;
        let mut segments = Vec::new();
        for (index, end) in ends.into_iter().enumerate() {
            let segment = Segment { duration: end - begin, output: shifted(&output, begin) };
            segments.push(segment.clone());
            self.push(Piece { segment, rounds: if index == 0 { rounds } else { Some(0) } });
            begin = end;
        }
        segments
    }

    /// Puts a piece at the end of the queue, or lengthens the last one where only derivatives beyond the series jump.
    fn push(&mut self, piece: Piece) {
        let smooth = piece.rounds.is_some_and(|rounds| rounds * self.relative_degree > f64::ORDER);
        match self.queue.back_mut() {
            Some(last) if smooth => last.segment.duration += piece.segment.duration,
            _ => self.queue.push_back(piece),
        }
    }

    /// Integrates until period and amplitude stand still; `None` where the motion escapes, dies out or never stands still.
    #[must_use]
    pub fn settle(mut self) -> Option<Settled> {
        // The least change of the last periods: rounding keeps it from falling for ever.
        let mut settled: Option<Settled> = None;
        let mut since_rise: Vec<Segment<f64>> = Vec::new();
        let mut begun = false;
        let mut quiet = 0;
        for _ in 0..PERIODS {
            let now = self.period(&mut since_rise, &mut begun)?;
            if let Some(before) = &settled {
                let drift =
                    (now.period / before.period - 1.0).abs().max((now.amplitude / before.amplitude - 1.0).abs());
                quiet = if drift < SETTLED { quiet + 1 } else { 0 };
                settled = Some(Settled { drift, ..now });
                // A slow decay moves less than this each period and still has far to go: several quiet periods in a row.
                if quiet >= 5 {
                    return settled;
                }
            } else {
                settled = Some(now);
            }
        }
        settled.filter(|settled| settled.drift < 1e-12)
    }

    /// The motion to the next rise through zero.
    fn period(&mut self, since_rise: &mut Vec<Segment<f64>>, begun: &mut bool) -> Option<Settled> {
        let most = 40 * self.queue.len() + 40_000;
        for _ in 0..most {
            for Segment { duration, output } in self.step()? {
                let mut scaled = Vec::with_capacity(output.len());
                let mut power = 1.0;
                for &c in &output {
                    scaled.push(-c * power);
                    power *= duration;
                }
                let end = -scaled.iter().sum::<f64>();
                // Rising: below at the beginning, not below at the end.
                let rises = output[0] < 0.0 && end >= 0.0;
                let Crossing::At(at) = (if rises { first_crossing(&scaled) } else { Crossing::None }) else {
                    since_rise.push(Segment { duration, output });
                    continue;
                };
                since_rise.push(Segment { duration: at * duration, output: output.clone() });
                let whole = std::mem::take(since_rise);
                since_rise.push(Segment { duration: (1.0 - at) * duration, output: shifted(&output, at * duration) });
                if std::mem::replace(begun, true) {
                    let first = FirstHarmonic::of(&whole, 1);
                    let period = whole.iter().map(|segment| segment.duration).sum();
                    let (amplitude, mean) = (first.amplitude(), first.mean);
                    return (amplitude > 1e-9).then_some(Settled {
                        period,
                        amplitude,
                        drift: f64::INFINITY,
                        mean,
                        segments: whole,
                    });
                }
            }
        }
        None
    }
}

/// Taylor coefficient of the output of a balance at an angle.
fn derivative(balance: &Balance, k: usize, angle: f64) -> f64 {
    use num_complex::Complex64;
    let factorial: f64 = (1..=k).map(|i| i as f64).product();
    super::spectrum::odd(&balance.harmonics)
        .map(|(j, x)| (x * Complex64::new(0.0, j * balance.omega).powu(k as u32) * Complex64::cis(j * angle)).re)
        .sum::<f64>()
        / factorial
}
