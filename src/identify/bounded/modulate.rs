//! The equation of motion weighed with a modulating function (Shinbrot 1957): one inequality, linear in the terms, good over any box.
//!
//! K is piecewise linear between samples and zero at both ends, so that `int K x''` is a sum of positions at the samples, which
//! the readings give to within their errors. The equation makes it a combination of the terms. Drag is weighed by its tangent in every
//! interval between samples, and what the tangent leaves out by how far the velocity goes there. A reading's error counts
//! once for all that it enters into: with a K that solves the adjoint equation about the centre, few readings count at all.

use super::contract::{Linear, Model, Origin};
use super::field::{Term, cube, signed_square};
use super::speeds::Speeds;
use crate::numeric::{Interval, Real};

/// A modulating function: its values at successive samples of one record, the first and the last of them zero.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Weight {
    pub(super) record: usize,
    pub(super) first: usize,
    pub(super) nodes: Vec<f64>,
}

/// What `int f(v)`, or `int x`, is between two samples: a constant, and a multiple of the way between them or of their mean position;
/// and the same of its first moment about the middle, over the time between the samples.
#[derive(Clone, Copy, Debug)]
struct Part {
    whole: Interval,
    moment: Interval,
    by_way: Interval,
    by_place: Interval,
    moment_by_way: Interval,
}

const NOTHING: Part = Part {
    whole: Interval::ZERO,
    moment: Interval::ZERO,
    by_way: Interval::ZERO,
    by_place: Interval::ZERO,
    moment_by_way: Interval::ZERO,
};

/// One interval between samples over a box.
#[derive(Clone, Copy, Debug)]
struct Passage {
    lasted: Interval,
    /// Velocities, and the acceleration.
    speed: Interval,
    rate: Interval,
    /// `int (t - middle) v` over the time: a twelfth of the acceleration times its square.
    bend: Interval,
    /// About this velocity the drag is linearised.
    point: f64,
    /// `int (v - point)^2`.
    spread: Interval,
}

fn twelfth() -> Interval {
    Interval::ONE / Interval::point(12.0)
}

impl Passage {
    fn of(lasted: Interval, speed: Interval, ends: [Interval; 2], rate: Interval) -> Self {
        let half = Interval::point(0.5);
        let square = lasted.square();
        // The mean velocity, from either end.
        let gained = half * rate * lasted;
        let mean = [speed, ends[0] + gained, ends[1] - gained];
        let mean = mean.into_iter().reduce(|a, b| a.intersection(b).unwrap_or(a)).unwrap_or(speed);
        let point = mean.midpoint();
        let off = (mean - Interval::point(point)).magnitude();
        // Between the least and the largest acceleration, and none where it may change its sign.
        let variance = twelfth() * lasted * square * rate.abs().square();
        let spread = variance + lasted * Interval::ZERO.hull(Interval::point(off).square());
        Self { lasted, speed, rate, bend: twelfth() * rate * square, point, spread }
    }

    fn way(self) -> Part {
        Part { by_way: Interval::ONE, moment: self.bend, ..NOTHING }
    }

    /// `value + slope (v - point)`, and what that leaves out.
    fn tangent(self, value: Interval, slope: f64, left: Interval, largest: f64) -> Part {
        let (slope, point, half) = (Interval::point(slope), Interval::point(self.point), Interval::point(0.5));
        Part {
            whole: (value - slope * point) * self.lasted + left,
            moment: slope * self.bend + half * Interval::symmetric((self.spread * Interval::point(largest)).upper()),
            by_way: slope,
            ..NOTHING
        }
    }

    /// `v |v| - 2 middle v`: its second derivative is two, with the sign of v.
    fn square(self, middle: f64) -> Part {
        let point = Interval::point(self.point);
        let value = signed_square(point) - Interval::point(2.0 * middle) * point;
        let left = if self.speed.lower() >= 0.0 {
            self.spread
        } else if self.speed.upper() <= 0.0 {
            -self.spread
        } else {
            Interval::symmetric(self.spread.upper())
        };
        self.tangent(value, 2.0 * (self.point.abs() - middle), left, 1.0)
    }

    /// `v^3 = p^3 + 3 p^2 (v - p) + (v - p)^2 (v + 2 p)`.
    fn cube(self) -> Part {
        let point = Interval::point(self.point);
        let factor = self.speed + Interval::two() * point;
        self.tangent(cube(point), 3.0 * self.point * self.point, self.spread * factor, factor.magnitude())
    }

    /// The chord exceeds the output by half the acceleration times the times from both ends.
    fn place(self) -> Part {
        let sagged = self.bend * self.lasted;
        Part {
            whole: -sagged,
            moment: Interval::point(0.5) * Interval::symmetric(sagged.magnitude()),
            by_place: self.lasted,
            moment_by_way: twelfth() * self.lasted,
            ..NOTHING
        }
    }
}

/// A record over a box, ready to be weighed.
pub(super) struct Motion {
    passages: Vec<Passage>,
    parts: Vec<(usize, Vec<Part>)>,
}

impl Motion {
    /// Drag per speed about the middle of every interval, and stiffness: what a K is the adjoint to.
    pub(super) fn slope(&self, unknown: usize, interval: usize) -> (f64, f64) {
        let part = self.parts.iter().find(|(own, _)| *own == unknown).map_or(NOTHING, |(_, parts)| parts[interval]);
        (part.by_way.midpoint(), part.by_place.midpoint())
    }

    /// The constant part of a term between two samples.
    pub(super) fn whole(&self, unknown: usize, interval: usize) -> f64 {
        self.parts.iter().find(|(own, _)| *own == unknown).map_or(0.0, |(_, parts)| parts[interval].whole.midpoint())
    }
}

/// K with its integral up to every node.
struct Shape<'a> {
    weight: &'a Weight,
    time_s: &'a [f64],
    areas: Vec<Interval>,
}

impl<'a> Shape<'a> {
    fn of(weight: &'a Weight, time_s: &'a [f64]) -> Self {
        let time_s = &time_s[weight.first..weight.first + weight.nodes.len()];
        let half = Interval::point(0.5);
        let mut areas = vec![Interval::ZERO];
        for index in 1..time_s.len() {
            let lasted = Interval::point(time_s[index]) - Interval::point(time_s[index - 1]);
            let ends = Interval::point(weight.nodes[index - 1]) + Interval::point(weight.nodes[index]);
            areas.push(areas[index - 1] + half * ends * lasted);
        }
        Self { weight, time_s, areas }
    }

    fn area(&self) -> Interval {
        self.areas[self.areas.len() - 1]
    }

    /// The interval that holds an instant; `None` outside.
    fn interval(&self, t: f64) -> Option<usize> {
        let index = self.time_s.partition_point(|time| *time <= t);
        (index > 0 && index < self.time_s.len()).then(|| index - 1)
    }

    fn rise(&self, index: usize) -> Interval {
        (Interval::point(self.weight.nodes[index + 1]) - Interval::point(self.weight.nodes[index]))
            / (Interval::point(self.time_s[index + 1]) - Interval::point(self.time_s[index]))
    }

    fn height_at(&self, t: f64) -> Interval {
        self.interval(t).map_or(Interval::ZERO, |index| {
            let since = Interval::point(t) - Interval::point(self.time_s[index]);
            Interval::point(self.weight.nodes[index]) + self.rise(index) * since
        })
    }

    /// All heights from one instant to another.
    fn height(&self, from: f64, to: f64) -> Interval {
        let (first, last) =
            (self.time_s.partition_point(|time| *time <= from), self.time_s.partition_point(|time| *time < to));
        let within = self.weight.nodes[first.min(last)..last].iter().map(|node| Interval::point(*node));
        within.fold(self.height_at(from).hull(self.height_at(to)), Interval::hull)
    }

    /// The integral up to an instant.
    fn area_to(&self, t: f64) -> Interval {
        let Some(index) = self.interval(t) else {
            return if t < self.time_s[0] { Interval::ZERO } else { self.area() };
        };
        let since = Interval::point(t) - Interval::point(self.time_s[index]);
        let ramp = Interval::point(0.5) * self.rise(index) * since;
        self.areas[index] + since * (Interval::point(self.weight.nodes[index]) + ramp)
    }
}

impl Model<'_> {
    /// A record over a box.
    pub(super) fn passing(&self, record: usize, speeds: &Speeds) -> Motion {
        let readings = &self.records[record];
        let passages: Vec<Passage> = (0..readings.value.len() - 1)
            .map(|k| {
                let lasted = Interval::point(readings.time_s[k + 1]) - Interval::point(readings.time_s[k]);
                let ends = [speeds.at_samples[k], speeds.at_samples[k + 1]];
                Passage::of(lasted, speeds.between[k], ends, speeds.rates[k])
            })
            .collect();
        let part = |term: Term, passage: &Passage| match term {
            Term::Linear => Some(passage.way()),
            Term::Quadratic => Some(passage.square(self.middle_speed)),
            Term::Cubic => Some(passage.cube()),
            Term::Stiffness => Some(passage.place()),
            Term::Gain | Term::Disturbance | Term::LagRate => None,
        };
        let parts = self.layout.terms().iter().enumerate().filter_map(|(unknown, term)| {
            let parts: Option<Vec<Part>> = passages.iter().map(|passage| part(*term, passage)).collect();
            Some((unknown, parts?))
        });
        let parts = parts.collect();
        Motion { passages, parts }
    }

    /// `int K u` for the delay in the middle of `delay_s`, and its slope by the delay.
    fn pushed_by(&self, shape: &Shape<'_>, delay_s: Interval) -> [Interval; 2] {
        let command = &self.records[shape.weight.record].command;
        let middle = Interval::point(delay_s.midpoint());
        let (begin, end) = (shape.time_s[0], shape.time_s[shape.time_s.len() - 1]);
        let mut sum = Interval::point(command.levels()[0]) * shape.area();
        let mut slope = Interval::ZERO;
        for edge in 0..command.edges() {
            let (open, close) = command.window(edge, delay_s);
            if open >= end {
                break;
            }
            if close <= begin {
                sum -= command.drop_at(edge) * shape.area();
                continue;
            }
            let (first, last) = command.window(edge, middle);
            let after = (shape.area() - shape.area_to(first)).hull(shape.area() - shape.area_to(last));
            sum -= command.drop_at(edge) * after;
            slope += command.drop_at(edge) * shape.height(open, close);
        }
        [sum, slope]
    }

    /// Adds the inequality of a K, with the number `index`, about the centre of `linear`; `motion` is its record's over the box `at`.
    pub(super) fn modulate(&self, weight: &Weight, index: usize, at: &[Interval], motion: &Motion, linear: &mut Linear) {
        let readings = &self.records[weight.record];
        let shape = Shape::of(weight, &readings.time_s);
        let delay_s = self.delay_s(at);
        let centre: Vec<Interval> = linear.centre.iter().map(|value| Interval::point(*value)).collect();
        let half = Interval::point(0.5);
        let count = weight.nodes.len();
        let terms = motion.parts.len();
        // Of every term the integral as the readings have it, and how each reading enters.
        let mut sums = vec![Interval::ZERO; terms];
        let mut entered = vec![vec![Interval::ZERO; count]; terms];
        let mut second = Interval::ZERO;
        let mut curved = vec![Interval::ZERO; count];
        for offset in 0..count - 1 {
            let sample = weight.first + offset;
            let (here, next) = (Interval::point(weight.nodes[offset]), Interval::point(weight.nodes[offset + 1]));
            let (mean, rise) = (half * (here + next), next - here);
            let (a, b) = (Interval::point(readings.value[sample]), Interval::point(readings.value[sample + 1]));
            let way = b - a;
            // Of `int K x''` the slopes of K, in parts.
            let slope = rise / motion.passages[sample].lasted;
            second -= slope * way;
            curved[offset] += slope;
            curved[offset + 1] -= slope;
            for (term, (_, parts)) in motion.parts.iter().enumerate() {
                let part = &parts[sample];
                let by_way = mean * part.by_way + rise * part.moment_by_way;
                let by_place = half * mean * part.by_place;
                sums[term] += mean * part.whole + rise * part.moment + by_way * way + by_place * (a + b);
                entered[term][offset] += by_place - by_way;
                entered[term][offset + 1] += by_place + by_way;
            }
        }
        let error = Interval::point(readings.error);
        let error = if readings.jitter_s > 0.0 {
            let fastest = motion.passages.iter().fold(0.0f64, |fastest, own| fastest.max(own.speed.magnitude()));
            error + Interval::point(readings.jitter_s) * Interval::point(fastest)
        } else {
            error
        };
        let [force, by_delay] = self.pushed_by(&shape, delay_s);
        let mut slopes: Vec<(usize, Interval)> = Vec::with_capacity(terms + 3);
        let mut residual = second;
        for (term, (unknown, _)) in motion.parts.iter().enumerate() {
            let total = entered[term].iter().fold(Interval::ZERO, |sum, own| sum + own.abs());
            slopes.push((*unknown, sums[term] + Interval::symmetric((error * total).upper())));
            residual += centre[*unknown] * sums[term];
            for (curved, entered) in curved.iter_mut().zip(&entered[term]) {
                *curved += centre[*unknown] * *entered;
            }
        }
        if let Some(gain) = self.layout.place_of(Term::Gain) {
            slopes.push((gain, -force));
            residual -= centre[gain] * force;
        }
        let disturbance = self.layout.disturbance(weight.record);
        slopes.push((disturbance, -shape.area()));
        residual -= centre[disturbance] * shape.area();
        slopes.extend(self.layout.delay().map(|delay| (delay, -at[0] * by_delay)));
        let total = curved.iter().fold(Interval::ZERO, |sum, own| sum + own.abs());
        linear.pair(slopes.into_iter(), residual, error * total, |above| Origin::Weight { index, above });
    }
}
