//! Bounds of the velocity at every sample, over a box: differential inequalities (Walter, *Differential and Integral Inequalities*, 1970)
//! between readings. Drag brakes: `v' <= A` for `v > 0`, where A bounds the acceleration without drag.

mod monotone;
#[cfg(test)]
mod tests;

use super::a_priori_enclosure;
use super::answer::Contradicting;
use super::linear_relaxation::half_line;
use super::problem::Problem;
use super::vector_field::{FieldTerm, StateBox, VELOCITY, cube, shifted_square, signed_square};
use crate::numeric::{Interval, Real};
use monotone::{Constant, SPANS};

/// The acceleration without drag between two samples.
#[derive(Clone, Copy, Debug)]
struct Push {
    /// The largest upwards and downwards, zero or more.
    up: f64,
    down: f64,
    force: Interval,
    /// Switchings that have acted, if none can act in between.
    since: Option<usize>,
}

/// Velocities at the samples, and between each sample and the next.
#[derive(Clone, Debug)]
pub(super) struct Velocities {
    pub(super) at_samples: Vec<Interval>,
    pub(super) between: Vec<Interval>,
    /// Accelerations between each sample and the next.
    pub(super) rates: Vec<Interval>,
    /// The first sample at which the velocity is known; before it commands may act that are not in the log.
    pub(super) known: usize,
}

impl Velocities {
    /// The largest speed from the first known sample on.
    pub(super) fn fastest(&self) -> f64 {
        self.between.iter().skip(self.known).fold(0.0, |fastest, speed| fastest.max(speed.magnitude()))
    }
}

/// Times in which no switching can act.
fn constant_spans(pushes: &[Push]) -> Vec<Constant> {
    let mut spans: Vec<Constant> = Vec::new();
    for (interval, push) in pushes.iter().enumerate() {
        match (spans.last_mut(), push.since) {
            (_, None) => {}
            (Some(span), since) if span.last == interval && pushes[interval - 1].since == since => {
                span.last = interval + 1;
            }
            (_, Some(_)) => spans.push(Constant { first: interval, last: interval + 1 }),
        }
    }
    spans
}

fn plus(a: f64, b: f64) -> Interval {
    Interval::point(a) + Interval::point(b)
}

/// A force behind a lag after so many time constants: `u + (f - u) e^(-t/T)` for the ends of both ranges.
fn lagged(force: Interval, command: Interval, lags: Interval) -> Interval {
    let left = (-lags).exp();
    let from = |force: f64, command: f64| Interval::point(command) + plus(force, -command) * left;
    let (lower, upper) = (from(force.lower(), command.lower()), from(force.upper(), command.upper()));
    Interval::new(lower.lower(), upper.upper()).unwrap_or(force.hull(command))
}

/// Velocities during a time from any of some, under drag and a force.
fn passed([linear, quadratic, cubic]: [Interval; 3], from: Interval, force: Interval, lasted: Interval) -> Interval {
    let rate = |component: usize, state: &StateBox| {
        let v = state[VELOCITY];
        let drag = linear * v + quadratic * signed_square(v) + cubic * cube(v);
        if component == VELOCITY { force - drag } else { Interval::ZERO }
    };
    let states = a_priori_enclosure::enclose(&[Interval::ZERO, from, Interval::ZERO], lasted, rate);
    states.map_or(Interval::ENTIRE, |states| states[VELOCITY])
}

impl Problem {
    /// Coefficients of linear, quadratic and cubic drag over a box.
    fn drag(&self, at: &[Interval]) -> [Interval; 3] {
        let linear =
            if self.unknowns.place_of(FieldTerm::Linear).is_some() { self.linear_drag(at) } else { Interval::ZERO };
        let linear = linear.intersection(half_line(self.least_linear, false)).unwrap_or(linear);
        [linear, self.term(FieldTerm::Quadratic, at), self.term(FieldTerm::Cubic, at)]
    }

    /// The first sample after which every command that acts is in the log, wherever the reading was taken within the jitter.
    fn known(&self, record: usize, at: &[Interval]) -> usize {
        let readings = &self.records[record];
        let begin = plus(readings.acted_s(self.delay_s(at)), readings.jitter_s);
        readings.time_s.partition_point(|time| *time < begin.upper())
    }

    /// Of every interval between samples over a box; without meaning before the first known sample.
    fn pushes(&self, record: usize, at: &[Interval]) -> Vec<Push> {
        let readings = &self.records[record];
        let [gain, stiffness] = [FieldTerm::Gain, FieldTerm::Stiffness].map(|term| self.term(term, at));
        let disturbance = at[self.unknowns.disturbance(record)];
        let speed = Interval::symmetric(self.fastest);
        // Negative linear drag drives.
        let [linear, ..] = self.drag(at);
        let driving = Interval::symmetric((-linear.lower()).max(0.0)) * speed;
        let delay_s = self.delay_s(at);
        let command = &readings.command;
        let windows: Vec<Interval> = command.windows(delay_s).collect();
        let (mut done, mut begun) = (0, 0);
        // A force that acted before the log is within the commands of the log.
        let any = Interval::symmetric(command.largest());
        let known = self.known(record, at);
        let lag_rate = self.unknowns.place_of(FieldTerm::LagRate).map(|place| at[place]);
        let mut behind = any;
        let samples = readings.time_s.len();
        let mut pushes = Vec::with_capacity(samples);
        for sample in 0..samples - 1 {
            let stray = readings.jitter_s;
            let from = plus(readings.time_s[sample], -stray).lower();
            let to = plus(readings.time_s[sample + 1], stray).upper();
            while windows.get(done).is_some_and(|window| window.upper() <= from) {
                done += 1;
            }
            begun = begun.max(done);
            while windows.get(begun).is_some_and(|window| window.lower() < to) {
                begun += 1;
            }
            let acts = command.between(done, begun);
            let force = lag_rate.map_or(acts, |rate| {
                let before = behind;
                if sample < known {
                    return any;
                }
                behind = lagged(before, acts, rate * readings.lasted(sample, sample + 1));
                // Stamps may be off by more than the time constant.
                if stray > 0.0 { any } else { before.hull(behind) }
            });
            let mut push = gain * force + disturbance;
            if self.unknowns.place_of(FieldTerm::Stiffness).is_some() {
                let (a, b) = (Interval::point(readings.value[sample]), Interval::point(readings.value[sample + 1]));
                let stray = Interval::symmetric(readings.error) + speed * readings.lasted(sample, sample + 1);
                push -= stiffness * (a.hull(b) + stray);
            }
            pushes.push(Push {
                up: (push + driving).upper().max(0.0),
                down: (driving - push).upper().max(0.0),
                force: push,
                since: (done == begun && sample >= known).then_some(done),
            });
        }
        pushes
    }

    /// Readings between two switchings that no monotone velocity satisfies, with a delay of the box.
    pub(super) fn contradiction(&self, at: &[Interval]) -> Vec<Contradicting> {
        if !self.is_autonomous() {
            return Vec::new();
        }
        let each = (0..self.records.len()).flat_map(|record| {
            let spans = constant_spans(&self.pushes(record, at));
            spans.into_iter().map(move |span| self.records[record].contradiction(record, span))
        });
        each.into_iter().find(|readings| !readings.is_empty()).unwrap_or_default()
    }

    /// Encloses the velocity at every sample of a record over a box. `None` where the box holds no motion.
    pub(super) fn velocities(&self, record: usize, at: &[Interval]) -> Option<Velocities> {
        let speeds = self.on_exact_stamps(record, at)?;
        Some(if self.records[record].jitter_s > 0.0 { self.stamped(record, &speeds) } else { speeds })
    }

    /// The hull over all instants within the jitter of each stamp.
    fn stamped(&self, record: usize, speeds: &Velocities) -> Velocities {
        let readings = &self.records[record];
        let (time, stray) = (&readings.time_s, readings.jitter_s);
        let intervals = speeds.between.len();
        let near = |interval: usize| {
            let (from, to) = (plus(time[interval], -stray).lower(), plus(time[interval + 1], stray).upper());
            let first = time.partition_point(|time| *time < from).saturating_sub(1);
            first..time.partition_point(|time| *time <= to).min(intervals)
        };
        let over = |values: &[Interval], interval: usize| {
            values[near(interval)].iter().copied().fold(values[interval], Interval::hull)
        };
        let stamped = (0..intervals).map(|interval| {
            let (range, rate) = (near(interval), over(&speeds.rates, interval));
            // Beyond the first and the last reading the acceleration goes on.
            let ends = range.start == 0 || range.end == intervals;
            let beyond = if ends { rate * Interval::symmetric(2.0 * stray) } else { Interval::ZERO };
            (rate, over(&speeds.between, interval) + beyond)
        });
        let (rates, between): (Vec<Interval>, Vec<Interval>) = stamped.unzip();
        let at_samples = (0..=intervals)
            .map(|sample| between[sample.saturating_sub(1)].hull(between[sample.min(intervals - 1)]))
            .collect();
        Velocities { at_samples, between, rates, known: speeds.known }
    }

    /// Accelerations between samples over a box, given the velocities.
    fn rates(&self, at: &[Interval], pushes: &[Push], between: &[Interval]) -> Vec<Interval> {
        let [linear, quadratic, cubic] =
            [FieldTerm::Linear, FieldTerm::Quadratic, FieldTerm::Cubic].map(|term| self.term(term, at));
        let drag = |v: Interval| linear * v + quadratic * shifted_square(v, self.middle_speed) + cubic * cube(v);
        pushes.iter().zip(between).map(|(push, v)| push.force - drag(*v)).collect()
    }

    /// Velocities by accelerations: a mean over the time T is within `T a/2` of the velocity at its ends.
    pub(super) fn accelerated(&self, record: usize, speeds: &mut Velocities) -> Option<()> {
        let (readings, samples, known) = (&self.records[record], speeds.at_samples.len(), speeds.known);
        let half = Interval::point(0.5);
        for span in SPANS {
            for first in known..samples.saturating_sub(span) {
                let last = first + span;
                let rates = speeds.rates[first..last].iter().copied().reduce(Interval::hull)?;
                let lasted = readings.lasted(first, last);
                let (mean, gained) = (readings.mean_velocity(first, last), half * rates * lasted);
                speeds.at_samples[first] = speeds.at_samples[first].intersection(mean - gained)?;
                speeds.at_samples[last] = speeds.at_samples[last].intersection(mean + gained)?;
            }
        }
        for sample in known + 1..samples {
            let passed = Interval::ZERO.hull(speeds.rates[sample - 1] * readings.lasted(sample - 1, sample));
            let (before, after) = (speeds.at_samples[sample - 1] + passed, speeds.at_samples[sample] - passed);
            let own = &mut speeds.between[sample - 1];
            *own = own.intersection(before)?.intersection(after)?;
        }
        Some(())
    }

    /// The same where every stamp is exact.
    ///
    /// Drag brakes: with an acceleration without drag of at most A, a velocity v > 0 needs a way of at least `v T - A T^2/2` in the time T
    /// before it, or began in T; and ahead of a mean velocity m > 0 over T it was at least `m - A T/2`.
    fn on_exact_stamps(&self, record: usize, at: &[Interval]) -> Option<Velocities> {
        let pushes = self.pushes(record, at);
        let readings = &self.records[record];
        let value = &readings.value;
        let (half, drag) = (Interval::point(0.5), self.drag(at));
        let known = self.known(record, at).min(value.len() - 1);
        let mut speeds = vec![Interval::symmetric(self.fastest); value.len()];
        for span in SPANS {
            for first in known..value.len().saturating_sub(span) {
                let last = first + span;
                let lasted = readings.lasted(first, last);
                if !lasted.is_positive() {
                    continue;
                }
                let mean = readings.mean_velocity(first, last);
                let most = pushes[first..last]
                    .iter()
                    .fold([0.0f64; 2], |[up, down], push| [up.max(push.up), down.max(push.down)]);
                let [up, down] = most.map(|push| (Interval::point(push) * Interval::point(lasted.upper())).upper());
                let [half_up, half_down] = [up, down].map(|gained| half * Interval::point(gained));
                let fast = (mean + half_up).upper().max(up);
                let slow = (mean - half_down).lower().min(-down);
                speeds[last] = speeds[last].intersection(Interval::new(slow, fast)?)?;
                let (least, largest) = ((mean - half_up).lower(), (mean + half_down).upper());
                let least = if least > 0.0 { least } else { f64::NEG_INFINITY };
                let largest = if largest < 0.0 { largest } else { f64::INFINITY };
                speeds[first] = speeds[first].intersection(Interval::new(least, largest)?)?;
            }
        }
        let spans = if self.is_autonomous() { constant_spans(&pushes) } else { Vec::new() };
        for span in &spans {
            readings.monotone(*span, &mut speeds)?;
        }
        let mut between_samples = vec![Interval::symmetric(self.fastest); known];
        for sample in known + 1..value.len() {
            let lasted = readings.lasted(sample - 1, sample);
            let passed = passed(drag, speeds[sample - 1], pushes[sample - 1].force, lasted);
            speeds[sample] = speeds[sample].intersection(passed)?;
            between_samples.push(passed);
        }
        for span in &spans {
            for sample in span.first..span.last {
                let passed = speeds[sample].hull(speeds[sample + 1]);
                between_samples[sample] = between_samples[sample].intersection(passed)?;
            }
        }
        let rates = self.rates(at, &pushes, &between_samples);
        let mut speeds = Velocities { at_samples: speeds, between: between_samples, rates, known };
        self.accelerated(record, &mut speeds)?;
        speeds.rates = self.rates(at, &pushes, &speeds.between);
        Some(speeds)
    }
}
