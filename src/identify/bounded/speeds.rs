//! Velocities at the samples, from readings and the accelerations besides drag.

use super::bounds::Contradicting;
use super::contract::Model;
use super::field::{Term, cube, shifted_square, signed_square};
use super::monotone::{Even, SPANS};
use crate::numeric::{Interval, Real};

#[cfg(test)]
mod tests;

/// Speeds are enclosed again where they are below this share of the largest that is looked for.
const SLOWER: f64 = 0.7;
/// How often a fall that is certain is looked for, each time twice as deep.
const DOUBLINGS: usize = 6;
/// How often a speed that is certain is made better.
const REFINEMENTS: usize = 3;

/// The largest acceleration besides drag between two samples: forwards and backwards, each zero or more.
#[derive(Clone, Copy, Debug)]
struct Push {
    up: f64,
    down: f64,
    /// The acceleration besides drag.
    force: Interval,
    /// Switchings that have acted, if none can act just now.
    since: Option<usize>,
}

impl Push {
    /// What it adds to a velocity in a duration: at most upwards, at most downwards.
    fn gains(self, lasted: Interval) -> [f64; 2] {
        [self.up, self.down].map(|push| (Interval::point(push) * Interval::point(lasted.upper())).upper())
    }
}

const NONE: Push = Push { up: 0.0, down: 0.0, force: Interval::ZERO, since: None };

/// Velocities at the samples, and between each and the next.
#[derive(Clone, Debug)]
pub(super) struct Speeds {
    pub(super) at_samples: Vec<Interval>,
    pub(super) between: Vec<Interval>,
    /// Accelerations between each sample and the next.
    pub(super) rates: Vec<Interval>,
    /// The first sample at which anything is known; before it the velocity is one that is looked for.
    pub(super) known: usize,
}

impl Speeds {
    /// The largest from the first sample on that is known.
    pub(super) fn fastest(&self) -> f64 {
        self.between.iter().skip(self.known).fold(0.0, |fastest, speed| fastest.max(speed.magnitude()))
    }
}

/// Times of more than one interval between samples in which no switching can act.
fn evens(pushes: &[Push]) -> Vec<Even> {
    let mut evens: Vec<Even> = Vec::new();
    for (interval, push) in pushes.iter().enumerate() {
        match (evens.last_mut(), push.since) {
            (_, None) => {}
            (Some(even), since) if even.last == interval && pushes[interval - 1].since == since => {
                even.last = interval + 1;
            }
            (_, Some(_)) => evens.push(Even { first: interval, last: interval + 1 }),
        }
    }
    evens
}

/// A half-line up to, or from, a number.
fn below(end: f64) -> Interval {
    Interval::new(f64::NEG_INFINITY, end).unwrap_or(Interval::ENTIRE)
}
fn above(end: f64) -> Interval {
    Interval::new(end, f64::INFINITY).unwrap_or(Interval::ENTIRE)
}
fn plus(a: f64, b: f64) -> Interval {
    Interval::point(a) + Interval::point(b)
}

/// The velocity between two samples. Beyond what it is at the first it grows by no more than the push adds, and what it is at the
/// second it was before, less that; drag may brake it at once.
fn between(first: Interval, second: Interval, push: Push, lasted: Interval) -> Interval {
    let [up, down] = push.gains(lasted);
    let ahead = plus(second.lower(), -up).lower();
    let lower = if ahead > 0.0 { ahead } else { plus(first.lower().min(0.0), -down).lower() };
    let behind = plus(second.upper(), down).upper();
    let upper = if behind < 0.0 { behind } else { plus(first.upper().max(0.0), up).upper() };
    Interval::new(lower, upper).unwrap_or(Interval::ENTIRE)
}

/// What a force has become that follows a command with a lag, after so many lags: it leaves the command's range no further than it was.
fn followed(force: Interval, command: Interval, lags: Interval) -> Interval {
    let left = (-lags).exp();
    let from = |force: f64, command: f64| Interval::point(command) + plus(force, -command) * left;
    let (lower, upper) = (from(force.lower(), command.lower()), from(force.upper(), command.upper()));
    Interval::new(lower.lower(), upper.upper()).unwrap_or(force.hull(command))
}

/// Drag over a box: linear, quadratic and cubic.
struct Drag([Interval; 3]);

impl Drag {
    /// The least acceleration at any of the velocities.
    fn rate(&self, v: Interval, force: Interval) -> f64 {
        let [linear, quadratic, cubic] = self.0;
        (force - linear * v - quadratic * signed_square(v) - cubic * v * v.square()).lower()
    }

    /// The least velocity during a duration from `v`.
    fn least_within(&self, v: f64, force: Interval, lasted: Interval) -> f64 {
        if self.rate(Interval::point(v), force) >= 0.0 { v } else { self.least(v, force, lasted) }
    }

    /// A velocity that is certainly reached, or not passed downwards, after a duration from `v`.
    fn least(&self, v: f64, force: Interval, lasted: Interval) -> f64 {
        if !v.is_finite() {
            return f64::NEG_INFINITY;
        }
        // What it gains, as slowly as it may between v and another velocity.
        let gained = |end: f64, lasted: f64| {
            let between = Interval::point(v).hull(Interval::point(end));
            Interval::point(self.rate(between, force)) * Interval::point(lasted)
        };
        let after = |end: f64, lasted: f64| (Interval::point(v) + gained(end, lasted)).lower();
        let (soon, late) = (lasted.lower(), lasted.upper());
        if self.rate(Interval::point(v), force) < 0.0 {
            // It does not fall to f within the time, as slowly as it falls on the way there; nor where it rises.
            let holds = |f: f64| after(f, late) >= f || self.rate(Interval::point(f), force) >= 0.0;
            let furthest = gained(v, late).lower();
            let Some(mut sure) = (0..DOUBLINGS).map(|k| v + f64::from(1 << k) * furthest).find(|f| holds(*f)) else {
                return f64::NEG_INFINITY;
            };
            // As it does not fall that far, it falls no faster.
            for _ in 0..REFINEMENTS {
                sure = sure.max(after(sure, late).min(v));
            }
            return sure;
        }
        // It rises to m within the time, even as slowly as it may on the way: the backward Euler step. What it would gain up to a
        // velocity beyond m is no more than what it gains up to m.
        let (mut sure, mut beyond) = (v, (Interval::point(v) + gained(v, soon)).upper());
        for _ in 0..REFINEMENTS {
            sure = after(beyond, soon);
            beyond = after(sure.max(v), soon);
        }
        if plus(sure, -v).upper() <= gained(sure, soon).lower() { sure.max(v) } else { v }
    }
}

impl Model<'_> {
    /// Drag over a box.
    fn drag(&self, at: &[Interval]) -> Drag {
        let place = |term: Term| self.layout.place_of(term).map_or(Interval::ZERO, |place| at[place]);
        let quadratic = place(Term::Quadratic);
        let linear = if self.layout.place_of(Term::Linear).is_some() {
            place(Term::Linear) - Interval::point(2.0 * self.middle_speed) * quadratic
        } else {
            Interval::ZERO
        };
        let linear = linear.intersection(above(self.least_linear)).unwrap_or(linear);
        Drag([linear, quadratic, place(Term::Cubic)])
    }

    /// Time between two samples, with what jitter makes of it.
    pub(super) fn lasted(&self, record: usize, first: usize, last: usize) -> Interval {
        let readings = &self.records[record];
        let lasted = Interval::point(readings.time_s[last]) - Interval::point(readings.time_s[first]);
        if readings.jitter_s > 0.0 { lasted + Interval::symmetric(2.0 * readings.jitter_s) } else { lasted }
    }

    /// The first sample from which on every command that acts is in the log, whenever the reading was taken that has this stamp. What
    /// acted before may have been anything.
    fn known(&self, record: usize, at: &[Interval]) -> usize {
        let readings = &self.records[record];
        let begin = plus(readings.acted_s(self.delay_s(at)), readings.jitter_s);
        readings.time_s.partition_point(|time| *time < begin.upper())
    }

    /// For every interval between samples, over a box in which no speed exceeds `fastest`; of no meaning before the first that is known.
    fn pushes(&self, record: usize, at: &[Interval], fastest: f64) -> Vec<Push> {
        let readings = &self.records[record];
        let place = |term: Term| self.layout.place_of(term).map_or(Interval::ZERO, |place| at[place]);
        let (gain, disturbance, stiffness) =
            (place(Term::Gain), at[self.layout.disturbance(record)], place(Term::Stiffness));
        let speed = Interval::symmetric(fastest);
        // Linear drag that drives.
        let Drag([linear, ..]) = self.drag(at);
        let driving = Interval::symmetric((-linear.lower()).max(0.0)) * speed;
        let delay_s = self.delay_s(at);
        let command = &readings.command;
        let windows: Vec<(f64, f64)> = (0..command.edges()).map(|edge| command.window(edge, delay_s)).collect();
        let (mut done, mut begun) = (0, 0);
        // The force, which follows the command with a lag: one that acted before the log was no stronger than those in it.
        let any = Interval::symmetric(command.largest());
        let known = self.known(record, at);
        let lag_rate = self.layout.place_of(Term::LagRate).map(|place| at[place]);
        let mut behind = any;
        let samples = readings.time_s.len();
        let mut pushes = Vec::with_capacity(samples);
        for sample in 0..samples - 1 {
            let stray = readings.jitter_s;
            let from = plus(readings.time_s[sample], -stray).lower();
            let to = plus(readings.time_s[sample + 1], stray).upper();
            while windows.get(done).is_some_and(|(_, close)| *close <= from) {
                done += 1;
            }
            begun = begun.max(done);
            while windows.get(begun).is_some_and(|(open, _)| *open < to) {
                begun += 1;
            }
            let acts = command.between(done, begun);
            let force = lag_rate.map_or(acts, |rate| {
                let before = behind;
                if sample < known {
                    return any;
                }
                behind = followed(before, acts, rate * self.lasted(record, sample, sample + 1));
                // A stamp may be off by more than the force takes to change.
                if stray > 0.0 { any } else { before.hull(behind) }
            });
            let mut push = gain * force + disturbance;
            if self.layout.place_of(Term::Stiffness).is_some() {
                let (a, b) = (Interval::point(readings.value[sample]), Interval::point(readings.value[sample + 1]));
                let stray = Interval::symmetric(readings.error) + speed * self.lasted(record, sample, sample + 1);
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

    /// Readings between two switchings that no motion meets, whatever its parameters, with a delay of the box.
    pub(super) fn clashes(&self, at: &[Interval]) -> Vec<Contradicting> {
        if !self.autonomous() {
            return Vec::new();
        }
        let each = (0..self.records.len()).flat_map(|record| {
            let evens = evens(&self.pushes(record, at, self.fastest));
            evens.into_iter().map(move |even| self.clash(record, even))
        });
        each.into_iter().find(|readings| !readings.is_empty()).unwrap_or_default()
    }

    /// Encloses the velocity at every sample of a record, over a box. `None` where there is none.
    pub(super) fn speeds(&self, record: usize, at: &[Interval]) -> Option<Speeds> {
        let speeds = self.slower(record, at, self.fastest)?;
        let driven = self.least_linear < 0.0 || self.layout.place_of(Term::Stiffness).is_some();
        let fastest = speeds.fastest();
        // What drives in proportion to a speed, or to a way, is less over slower ones.
        let slow = driven && fastest < SLOWER * self.fastest;
        let speeds = if slow { self.slower(record, at, fastest)? } else { speeds };
        Some(if self.records[record].jitter_s > 0.0 { self.stamped(record, &speeds) } else { speeds })
    }

    /// From the instants at which readings were taken to the stamps that they have: what is so at any instant that a stamp may stand for.
    fn stamped(&self, record: usize, speeds: &Speeds) -> Speeds {
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
        let rates: Vec<Interval> = (0..intervals).map(|interval| over(&speeds.rates, interval)).collect();
        let between: Vec<Interval> = (0..intervals)
            .map(|interval| {
                let range = near(interval);
                // Beyond the first and the last reading the acceleration goes on.
                let ends = range.start == 0 || range.end == intervals;
                let beyond = if ends { rates[interval] * Interval::symmetric(2.0 * stray) } else { Interval::ZERO };
                over(&speeds.between, interval) + beyond
            })
            .collect();
        let at_samples = (0..=intervals)
            .map(|sample| between[sample.saturating_sub(1)].hull(between[sample.min(intervals - 1)]))
            .collect();
        Speeds { at_samples, between, rates, known: speeds.known }
    }

    /// Accelerations between samples, over a box, given the velocities and what acts besides drag.
    fn rates(&self, at: &[Interval], pushes: &[Push], between: &[Interval]) -> Vec<Interval> {
        let term = |term: Term| self.layout.place_of(term).map_or(Interval::ZERO, |place| at[place]);
        let [linear, quadratic, cubic] = [Term::Linear, Term::Quadratic, Term::Cubic].map(term);
        let drag = |v: Interval| linear * v + quadratic * shifted_square(v, self.middle_speed) + cubic * cube(v);
        pushes.iter().zip(between).map(|(push, v)| push.force - drag(*v)).collect()
    }

    /// Velocities once more: what the mean over a time is off the velocity at its ends is half of what the acceleration adds.
    pub(super) fn accelerated(&self, record: usize, speeds: &mut Speeds) -> Option<()> {
        let (samples, known) = (speeds.at_samples.len(), speeds.known);
        let half = Interval::point(0.5);
        for span in SPANS {
            for first in known..samples.saturating_sub(span) {
                let last = first + span;
                let rates = speeds.rates[first..last].iter().copied().reduce(Interval::hull)?;
                let lasted = self.lasted(record, first, last);
                let (mean, gained) = (self.mean(record, first, last), half * rates * lasted);
                speeds.at_samples[first] = speeds.at_samples[first].intersection(mean - gained)?;
                speeds.at_samples[last] = speeds.at_samples[last].intersection(mean + gained)?;
            }
        }
        for sample in known + 1..samples {
            let passed = Interval::ZERO.hull(speeds.rates[sample - 1] * self.lasted(record, sample - 1, sample));
            let (before, after) = (speeds.at_samples[sample - 1] + passed, speeds.at_samples[sample] - passed);
            let own = &mut speeds.between[sample - 1];
            *own = own.intersection(before)?.intersection(after)?;
        }
        Some(())
    }

    /// The same where no speed exceeds `fastest`.
    ///
    /// Drag only brakes: with the acceleration besides it at most A, a velocity of v needs a way of `v T - A T^2/2` at least in the
    /// time T before it, whatever the drag; and a vehicle that goes a way in the time T ahead is at least as fast as its mean less `A T/2`.
    fn slower(&self, record: usize, at: &[Interval], fastest: f64) -> Option<Speeds> {
        let pushes = self.pushes(record, at, fastest);
        let readings = &self.records[record];
        let value = &readings.value;
        let half = Interval::point(0.5);
        let drag = self.drag(at);
        let known = self.known(record, at).min(value.len() - 1);
        let mut speeds = vec![Interval::symmetric(self.fastest); known];
        speeds.resize(value.len(), Interval::symmetric(fastest));
        for span in SPANS {
            for first in known..value.len().saturating_sub(span) {
                let last = first + span;
                let lasted = self.lasted(record, first, last);
                if !lasted.is_positive() {
                    continue;
                }
                let mean = self.mean(record, first, last);
                let most = pushes[first..last].iter().fold(NONE, |most, push| Push {
                    up: most.up.max(push.up),
                    down: most.down.max(push.down),
                    ..most
                });
                let [up, down] = most.gains(lasted);
                let [half_up, half_down] = [up, down].map(|gained| half * Interval::point(gained));
                let fast = (mean + half_up).upper().max(up);
                let slow = (mean - half_down).lower().min(-down);
                speeds[last] = speeds[last].intersection(Interval::new(slow, fast)?)?;
                let (least, largest) = ((mean - half_up).lower(), (mean + half_down).upper());
                if least > 0.0 {
                    speeds[first] = speeds[first].intersection(above(least))?;
                }
                if largest < 0.0 {
                    speeds[first] = speeds[first].intersection(below(largest))?;
                }
            }
        }
        let evens = if self.autonomous() { evens(&pushes) } else { Vec::new() };
        for even in &evens {
            self.one_way(record, *even, &mut speeds)?;
        }
        for sample in known + 1..value.len() {
            let [up, down] = pushes[sample - 1].gains(self.lasted(record, sample - 1, sample));
            let before = speeds[sample - 1];
            let fast = below(plus(before.upper().max(0.0), up).upper());
            let slow = above(plus(before.lower().min(0.0), -down).lower());
            speeds[sample] = speeds[sample].intersection(fast)?.intersection(slow)?;
            let lasted = self.lasted(record, sample - 1, sample);
            let force = pushes[sample - 1].force;
            let least = drag.least(before.lower(), force, lasted);
            let largest = -drag.least(-before.upper(), -force, lasted);
            speeds[sample] = speeds[sample].intersection(above(least))?.intersection(below(largest))?;
        }
        for sample in (known + 1..value.len()).rev() {
            // What it is later it was before, less what the push added.
            let [up, down] = pushes[sample - 1].gains(self.lasted(record, sample - 1, sample));
            let (least, largest) =
                (plus(speeds[sample].lower(), -up).lower(), plus(speeds[sample].upper(), down).upper());
            if least > 0.0 {
                speeds[sample - 1] = speeds[sample - 1].intersection(above(least))?;
            }
            if largest < 0.0 {
                speeds[sample - 1] = speeds[sample - 1].intersection(below(largest))?;
            }
        }
        let mut between_samples = vec![Interval::symmetric(self.fastest); known];
        for sample in known + 1..value.len() {
            let (push, lasted) = (pushes[sample - 1], self.lasted(record, sample - 1, sample));
            let (before, after) = (speeds[sample - 1], speeds[sample]);
            let least = drag.least_within(before.lower(), push.force, lasted);
            let largest = -drag.least_within(-before.upper(), -push.force, lasted);
            let range = between(before, after, push, lasted);
            between_samples.push(range.intersection(above(least))?.intersection(below(largest))?);
        }
        for even in &evens {
            self.one_way(record, *even, &mut speeds)?;
            for sample in even.first..even.last {
                let passed = speeds[sample].hull(speeds[sample + 1]);
                between_samples[sample] = between_samples[sample].intersection(passed)?;
            }
        }
        let rates = self.rates(at, &pushes, &between_samples);
        let mut speeds = Speeds { at_samples: speeds, between: between_samples, rates, known };
        self.accelerated(record, &mut speeds)?;
        speeds.rates = self.rates(at, &pushes, &speeds.between);
        Some(speeds)
    }

    /// Whether the ways that the speeds between samples allow are ones that the readings allow, over every span of time.
    pub(super) fn travelled(&self, record: usize, speeds: &Speeds) -> bool {
        let readings = &self.records[record];
        let room = Interval::two() * Interval::point(readings.error);
        // What the least and the largest way are ahead of the readings, and the least of the former so far.
        let (mut least, mut largest) = (Interval::ZERO, Interval::ZERO);
        let (mut lowest, mut highest) = (Interval::ZERO, Interval::ZERO);
        for sample in speeds.known + 1..speeds.at_samples.len() {
            let lasted = self.lasted(record, sample - 1, sample);
            let range = speeds.between[sample - 1];
            let way = Interval::point(readings.value[sample]) - Interval::point(readings.value[sample - 1]);
            least += Interval::point((Interval::point(range.lower()) * lasted).lower()) - way;
            largest += Interval::point((Interval::point(range.upper()) * lasted).upper()) - way;
            if (least - lowest).lower() > room.upper() || (highest - largest).lower() > room.upper() {
                return false;
            }
            if least.upper() < lowest.upper() {
                lowest = least;
            }
            if largest.lower() > highest.lower() {
                highest = largest;
            }
        }
        true
    }
}
