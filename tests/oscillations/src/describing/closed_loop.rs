//! The loop without dead time, integrated by Taylor series in either arithmetic, with kinks as events.

use super::characteristic::Characteristic;
use super::first_harmonic::Segment;
use crate::crossing::{Crossing, first_crossing};
use crate::linear::dot;
use crate::plant::Plant;
use crate::scalar::Scalar;

/// Equations `z^(n) = -sum a_i z^(i) - n(y)`, `y = sum b_i z^(i)`.
#[derive(Clone, Debug)]
pub struct ClosedLoop<S> {
    denominator: Vec<S>,
    /// Numerator, ascending.
    pub numerator: Vec<S>,
    characteristic: Characteristic,
    kinks: Vec<S>,
    /// Longest step in s.
    longest: f64,
}

/// State of the plant, and where the input of the characteristic stands among its kinks.
#[derive(Clone, Debug)]
pub struct Place<S> {
    /// `z, z', ...`
    pub z: Vec<S>,
    piece: usize,
    on: Option<Threshold>,
}

/// A value of the output that ends a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Threshold {
    Kink(usize),
    Level,
}

/// A motion from a section back to it.
#[derive(Clone, Debug)]
pub struct Return<S> {
    /// State of the plant at the end.
    pub z: Vec<S>,
    /// Time taken in s.
    pub duration: S,
    /// The output on the way.
    pub segments: Vec<Segment<S>>,
}

/// Output beyond which a motion has escaped, in its units.
const ESCAPED: f64 = 1e4;

impl<S: Scalar> ClosedLoop<S> {
    /// The loop of a plant without dead time.
    #[must_use]
    pub fn new(plant: &Plant, characteristic: &Characteristic) -> Self {
        let leading = S::from_f64(plant.den[0]);
        let ascending = |coefficients: &[f64]| -> Vec<S> {
            coefficients.iter().rev().map(|&value| S::from_f64(value) / leading).collect()
        };
        let mut denominator = ascending(&plant.den);
        denominator.pop();
        let mut numerator = ascending(&plant.num);
        numerator.resize(denominator.len(), S::ZERO);
        let root = |(i, a): (usize, &S)| a.to_f64().abs().powf(1.0 / (i + 1) as f64);
        let rate = denominator.iter().rev().enumerate().map(root).fold(0.1, f64::max);
        let kinks = characteristic.kinks().iter().map(|&kink| S::from_f64(kink)).collect();
        Self { denominator, numerator, characteristic: characteristic.clone(), kinks, longest: 1.0 / rate }
    }

    /// Output of a state.
    #[must_use]
    pub fn output(&self, z: &[S]) -> S {
        dot(&self.numerator, z)
    }

    /// A start; `on_level` where its output stands on the section.
    #[must_use]
    pub fn place(&self, z: Vec<S>, on_level: bool) -> Place<S> {
        let piece = self.characteristic.piece(self.output(&z).to_f64());
        Place { z, piece, on: on_level.then_some(Threshold::Level) }
    }

    /// Follows the motion until the output has risen through the level this many times.
    ///
    /// `None` where it escapes, or does not come back within the time, or grazes a kink or the level beyond the arithmetic.
    #[must_use]
    pub fn rise(&self, place: Place<S>, level: S, times: usize, longest: f64) -> Option<Return<S>> {
        let mut place = place;
        let mut duration = S::ZERO;
        let mut segments = Vec::new();
        let mut risen = 0;
        while risen < times {
            let (segment, reached) = self.step(&mut place, level)?;
            duration = duration + segment.duration;
            segments.push(segment);
            risen += usize::from(reached);
            let size = place.z.iter().fold(0.0, |most: f64, z| most.max(z.to_f64().abs()));
            if !(duration.to_f64() < longest && size < ESCAPED) {
                return None;
            }
        }
        Some(Return { z: place.z, duration, segments })
    }

    /// Follows the motion for a time.
    #[must_use]
    pub fn run(&self, place: Place<S>, duration: f64) -> Option<Vec<Segment<S>>> {
        let mut place = place;
        let mut segments = Vec::new();
        let mut elapsed = 0.0;
        while elapsed < duration {
            let (segment, _) = self.step(&mut place, S::from_f64(ESCAPED * 10.0))?;
            elapsed += segment.duration.to_f64();
            segments.push(segment);
            if !(place.z.iter().all(|z| z.to_f64().abs() < ESCAPED)) {
                return None;
            }
        }
        Some(segments)
    }

    /// One step: to its end, to a kink, or to the level, risen through.
    fn step(&self, place: &mut Place<S>, level: S) -> Option<(Segment<S>, bool)> {
        let n = place.z.len();
        let mut series: Vec<Vec<S>> = place.z.iter().map(|&z| vec![z]).collect();
        let mut fed_back = self.characteristic.series::<S>(place.piece);
        let mut output = Vec::with_capacity(S::ORDER + 1);
        for k in 0..=S::ORDER {
            let y = (0..n).fold(S::ZERO, |sum, i| sum + self.numerator[i] * series[i][k]);
            output.push(y);
            if k == S::ORDER {
                break;
            }
            let highest = (0..n).fold(-fed_back.push(y), |sum, i| sum - self.denominator[i] * series[i][k]);
            let next = S::from_count(k + 1);
            for i in 0..n {
                let rate = if i + 1 < n { series[i + 1][k] } else { highest };
                series[i].push(rate / next);
            }
        }
        let h = S::from_f64(step_size::<S>(&series).min(self.longest));
        let mut power = S::ONE;
        let mut scaled: Vec<S> = Vec::with_capacity(output.len());
        for &c in &output {
            scaled.push(c * power);
            power = power * h;
        }
        let mut end: Option<(S, Threshold)> = None;
        let piece = place.piece;
        let above = self.kinks.get(piece).map(|&kink| (kink, false, Threshold::Kink(piece)));
        let below = piece.checked_sub(1).map(|index| (self.kinks[index], true, Threshold::Kink(index)));
        // Falling through the level is no event, but a start on it has to leave it first.
        for (value, falls, threshold) in [above, below, Some((level, false, Threshold::Level))].into_iter().flatten() {
            match self.passing(&scaled, value, falls, place.on == Some(threshold)) {
                Crossing::At(at) if end.is_none_or(|(earlier, _)| at < earlier) => end = Some((at, threshold)),
                Crossing::Unclear => return None,
                _ => {}
            }
        }
        let duration = end.map_or(h, |(at, _)| at * h);
        place.z = series.iter().map(|one| one.iter().rev().fold(S::ZERO, |sum, &c| sum * duration + c)).collect();
        place.on = end.map(|(_, threshold)| threshold);
        if let Some(Threshold::Kink(index)) = place.on {
            place.piece = if index == piece { piece + 1 } else { piece - 1 };
        }
        Some((Segment { duration, output }, place.on == Some(Threshold::Level)))
    }

    /// Where the output passes a value in one direction, in units of the step.
    fn passing(&self, scaled: &[S], value: S, falls: bool, on: bool) -> Crossing<S> {
        let mut distance: Vec<S> = scaled.iter().map(|&c| if falls { c } else { -c }).collect();
        distance[0] = distance[0] + if falls { -value } else { value };
        if !on {
            // Above the level the next rise is behind a fall: look for that first.
            return if distance[0] < S::ZERO { after_a_return(&distance) } else { first_crossing(&distance) };
        }
        // From the value itself the distance is t times a polynomial. It grows first where the value was passed backwards.
        let from_here = &distance[1..];
        if from_here[0] < S::ZERO { after_a_return(from_here) } else { first_crossing(from_here) }
    }
}

/// First change to negative of a polynomial that begins negative: it has to become positive before.
fn after_a_return<S: Scalar>(distance: &[S]) -> Crossing<S> {
    let negated: Vec<S> = distance.iter().map(|&c| -c).collect();
    match first_crossing(&negated) {
        Crossing::At(back) if back > S::ZERO => {
            // The rest of the step, from a little after the return.
            let from = back + S::from_f64(1e6 * S::ROUNDING);
            if from >= S::ONE {
                return Crossing::None;
            }
            let shifted = crate::describing::first_harmonic::shifted(distance, from);
            match first_crossing(&shifted) {
                Crossing::At(at) if from + at <= S::ONE => Crossing::At(from + at),
                Crossing::At(_) => Crossing::None,
                other => other,
            }
        }
        Crossing::At(_) | Crossing::None => Crossing::None,
        Crossing::Unclear => Crossing::Unclear,
    }
}

/// Step in s after which the last terms of the series are below the rounding.
pub(super) fn step_size<S: Scalar>(series: &[Vec<S>]) -> f64 {
    let mut step = f64::INFINITY;
    let size = series.iter().flat_map(|one| one.first()).fold(0.0, |most: f64, z| most.max(z.to_f64().abs()));
    for one in series {
        for order in [S::ORDER - 1, S::ORDER] {
            let last = one[order].to_f64().abs();
            if last > 0.0 {
                step = step.min((0.1 * S::ROUNDING * size / last).powf(1.0 / order as f64));
            }
        }
    }
    step
}
