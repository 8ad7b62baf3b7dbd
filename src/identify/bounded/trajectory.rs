//! The motion along a record over a box of unknowns: enclosures of the output at every sample, and of its slopes about a point.

use super::command::Command;
use super::field::{FORCE, Field, TERMS, Term, Triple, VELOCITY};
use super::mix::Mix;
use super::step::{Arrival, Fields, Pair, Refused, Step};
use crate::numeric::Interval;

/// The most steps between two changes of the command.
const MOST_STEPS: usize = 2000;
/// Length of a step against the equation's fastest rate.
const STEP: f64 = 0.25;
/// The same over a box whose gain's relative width is at most `NARROW`, where the remainders would count.
const POINT_STEP: f64 = 0.12;
const NARROW: f64 = 0.01;
/// The same for a step by the rates' ranges.
const CRUDE: f64 = 0.2;
/// How often a step is made shorter before the motion is given up.
const MOST_SHORTENED: usize = 40;

/// The enclosure at a sample.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Over the box.
    pub(super) over: Triple,
    /// Of the point.
    pub(super) at: Triple,
    /// Of position, velocity and force by each unknown: what they differ by from the point's is the sum of these times what the
    /// unknowns differ.
    pub(super) slopes: Vec<Triple>,
    /// Largest speed since the sample before.
    pub(super) speed: f64,
}

/// What moves: the equation, and its commands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drive<'a> {
    pub(super) fields: Fields,
    pub(super) command: &'a Command,
    pub(super) delay_s: Interval,
    /// The point's own.
    pub(super) command_at: &'a Command,
    pub(super) delay_at_s: f64,
    /// A motion faster than this is given up.
    pub(super) fastest: f64,
}

/// Unknowns of a motion: what each is, and how far from the point it may be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unknowns<'a> {
    pub(super) mixes: &'a [Mix],
    pub(super) deviations: &'a [Interval],
}

/// The state, and its slopes, on the way.
struct Way<'a> {
    drive: &'a Drive<'a>,
    unknowns: Unknowns<'a>,
    state: Pair,
    columns: Vec<Triple>,
    /// Switchings that may have happened, each with what a unit of impulse then may have become since.
    open: Vec<(usize, Triple)>,
    speed: f64,
    nodes: Vec<Node>,
}

/// Advances the motion of one point, of which nothing but the end is wanted; what it passes besides.
fn advance_point(field: &Field, start: Triple, u: Interval, h: Interval) -> Option<[Triple; 2]> {
    let (mut state, mut passed, mut left) = (start, start, h);
    for _ in 0..MOST_STEPS {
        if left.upper() <= 0.0 {
            return Some([state, passed]);
        }
        let mut part = left;
        let longest = POINT_STEP / field.fastest(state[VELOCITY]);
        if longest < part.lower() {
            part = Interval::point(longest);
        }
        // A command that changes on the way is known by its range alone.
        let mut made = if u.is_point() { None } else { field.pass_crude(&state, u, part).ok() };
        for _ in 0..MOST_SHORTENED {
            if made.is_some() {
                break;
            }
            let length = match field.pass(&state, u, part, 1.1 * POINT_STEP) {
                Ok(done) => {
                    made = Some(done);
                    break;
                }
                Err(Refused::TooLong) => 0.5 * part.lower(),
                Err(Refused::Kink) => match to_rest(field, &state, u, part.upper()) {
                    (length, false) => length,
                    (length, true) => {
                        if length < part.lower() {
                            part = Interval::point(length);
                        }
                        made = field.pass_crude(&state, u, part).ok();
                        break;
                    }
                },
            };
            part = Interval::point(length.min(0.9 * part.lower()));
        }
        let [end, within] = made?;
        state = end;
        for (passed, within) in passed.iter_mut().zip(within) {
            *passed = passed.hull(within);
        }
        left = if part == left { Interval::ZERO } else { left - part };
    }
    None
}

/// How long the velocity certainly keeps its sign; or, where that is nearly over, how long until it has certainly changed it,
/// and `true`. An estimate.
fn to_rest(field: &Field, state: &Triple, u: Interval, left: f64) -> (f64, bool) {
    let v = state[VELOCITY];
    let [_, rate, _] = field.rate(state, u);
    let acceleration = rate.midpoint().abs().max(f64::MIN_POSITIVE);
    let (near, far) = if v.lower() > 0.0 {
        (v.lower() / acceleration, v.upper() / acceleration)
    } else if v.upper() < 0.0 {
        (-v.upper() / acceleration, -v.lower() / acceleration)
    } else if rate.midpoint() < 0.0 {
        (0.0, v.upper() / acceleration)
    } else {
        (0.0, -v.lower() / acceleration)
    };
    if near > 1e-7 * left && near > 0.1 * (far - near) {
        return (0.98 * near, false);
    }
    ((1.05 * far + 1e-9 * left).max(1e-12 * left), true)
}

impl Way<'_> {
    fn carried(&self, arrival: &Arrival) -> Vec<Triple> {
        self.columns.iter().enumerate().map(|(mix, column)| arrival.carry_mix(column, mix)).collect()
    }

    /// Notes a sample.
    fn note(&mut self, over: Triple, at: Triple, columns: &[Triple]) -> Option<()> {
        let slopes: Vec<Triple> = (0..columns.len()).map(|k| self.with_open(k, columns[k])).collect();
        let over = self.met(over, &at, &slopes);
        if !over.iter().chain(slopes.iter().flatten()).all(|value| value.is_bounded()) {
            return None;
        }
        self.nodes.push(Node { over, at, slopes, speed: self.speed });
        Some(())
    }

    /// What is both the state, and the point's state with the slopes.
    fn met(&self, mut over: Triple, at: &Triple, slopes: &[Triple]) -> Triple {
        let components = if self.lagged() { 3 } else { 2 };
        for k in 0..components {
            let pairs = slopes.iter().zip(self.unknowns.deviations).map(|(slope, deviation)| (slope[k], *deviation));
            let mean = at[k] + Interval::dot(pairs);
            // Both enclose the same values, so that they meet.
            over[k] = over[k].intersection(mean).unwrap_or(over[k]);
        }
        over
    }

    fn lagged(&self) -> bool {
        self.drive.fields.over.has(Term::LagRate)
    }

    /// For the duration `h`, the command constant unless it is `uncertain`; notes the samples on the way, `ahead` from here.
    fn advance(&mut self, u: Interval, u_at: Interval, h: Interval, uncertain: bool, ahead: &[Interval]) -> Option<()> {
        if !self.lagged() {
            (self.state.over[FORCE], self.state.at[FORCE]) = (u, u_at);
        }
        let (mut left, mut gone, mut ahead) = (h, Interval::ZERO, ahead);
        for _ in 0..MOST_STEPS {
            if left.upper() <= 0.0 {
                return Some(());
            }
            let mut part = left;
            let longest = self.length() / self.drive.fields.over.fastest(self.state.over[VELOCITY]);
            if longest < part.lower() {
                part = Interval::point(longest);
            }
            let mut step = if uncertain { None } else { self.smooth(u, &mut part)? };
            let mut at_end = None;
            if step.is_none() {
                // The point goes its own way, and the step ends with a sample, that it be known there.
                if let Some(sample) = ahead.first() {
                    let until = *sample - gone;
                    if until.lower() > 0.0 && until.upper() < part.lower() {
                        part = until;
                    }
                }
                let (crude, at, passed) = self.crude(u, u_at, &mut part)?;
                (step, at_end) = (Some(crude), Some((at, passed)));
            }
            let step = step?;
            self.speed = self.speed.max(step.within[VELOCITY].magnitude());
            let (last, noted) = (part == left, self.nodes.len());
            while let Some(sample) = ahead.first() {
                let time = *sample - gone;
                if !(last || time.upper() <= part.upper()) {
                    break;
                }
                let arrival = step.at(time);
                let columns = self.carried(&arrival);
                let at = arrival.at.or(at_end.map(|(at, passed)| if time == part { at } else { passed }))?;
                self.note(arrival.over, at, &columns)?;
                ahead = &ahead[1..];
            }
            if self.nodes.len() > noted {
                self.speed = step.within[VELOCITY].magnitude();
            }
            let arrival = step.at_end(part);
            self.columns = self.carried(&arrival);
            self.state.at = arrival.at.or(at_end.map(|(at, _)| at))?;
            let fresh = self.fresh();
            for (_, impulse) in &mut self.open {
                // The instant of the impulse may also be this very end.
                let carried = arrival.carry(impulse);
                *impulse = core::array::from_fn(|k| carried[k].hull(fresh[k]));
            }
            let slopes: Vec<Triple> = (0..self.columns.len()).map(|k| self.with_open(k, self.columns[k])).collect();
            self.state.over = self.met(arrival.over, &self.state.at, &slopes);
            if self.state.over[VELOCITY].magnitude() > self.drive.fastest {
                return None;
            }
            (left, gone) = if last { (Interval::ZERO, h) } else { (left - part, gone + part) };
        }
        None
    }

    /// Length of a step against the fastest rate.
    fn length(&self) -> f64 {
        let gain = self.drive.fields.over.term(Term::Gain);
        if gain.width() <= NARROW * gain.lower() { POINT_STEP } else { STEP }
    }

    /// One step of at most the duration `part`, which it shortens; none where the velocity is about to change its sign.
    fn smooth(&self, u: Interval, part: &mut Interval) -> Option<Option<Step>> {
        for _ in 0..MOST_SHORTENED {
            let length = match self.drive.fields.smooth(&self.state, u, *part, 1.1 * self.length(), self.unknowns.mixes)
            {
                Ok(step) => return Some(Some(step)),
                Err(Refused::TooLong) => 0.5 * part.lower(),
                Err(Refused::Kink) => match to_rest(&self.drive.fields.over, &self.both(), u, part.upper()) {
                    (length, false) => length,
                    (length, true) => {
                        if length < part.lower() {
                            *part = Interval::point(length);
                        }
                        return Some(None);
                    }
                },
            };
            *part = Interval::point(length.min(0.9 * part.lower()));
        }
        None
    }

    /// All states, the point's among them: it need not be in the box.
    fn both(&self) -> Triple {
        core::array::from_fn(|k| self.state.over[k].hull(self.state.at[k]))
    }

    /// One step by the rates' ranges, where it takes the point, and what that passes.
    fn crude(&self, u: Interval, u_at: Interval, part: &mut Interval) -> Option<(Step, Triple, Triple)> {
        let fields = &self.drive.fields;
        let fastest = fields.over.fastest(self.state.over[VELOCITY]);
        if CRUDE < fastest * part.lower() {
            *part = Interval::point(CRUDE / fastest);
        }
        for _ in 0..MOST_SHORTENED {
            let [at, passed] = advance_point(&fields.at, self.state.at, u_at, *part)?;
            if let Ok(step) = fields.crude(&self.state.over, u, &passed, u_at, *part, self.unknowns.mixes) {
                return Some((step, at, passed));
            }
            *part = Interval::point(0.5 * part.lower());
        }
        None
    }

    /// A column with what open switchings may have added.
    fn with_open(&self, index: usize, mut column: Triple) -> Triple {
        for (edge, impulse) in &self.open {
            let shift = self.unknowns.mixes[index].shift(*edge);
            if shift != Interval::ZERO {
                for (value, impulse) in column.iter_mut().zip(impulse) {
                    *value += shift * self.sized(*edge, *impulse).hull(Interval::ZERO);
                }
            }
        }
        column
    }

    /// An impulse of the size that a later switching has.
    fn sized(&self, edge: usize, impulse: Interval) -> Interval {
        let field = &self.drive.fields.over;
        let factor = field.term(if self.lagged() { Term::LagRate } else { Term::Gain });
        factor * self.drive.command.drop_at(edge) * impulse
    }

    /// A unit impulse just now.
    fn fresh(&self) -> Triple {
        let mut impulse = [Interval::ZERO; 3];
        impulse[if self.lagged() { FORCE } else { VELOCITY }] = Interval::ONE;
        impulse
    }

    fn close(&mut self, edge: usize) {
        let Some(place) = self.open.iter().position(|(open, _)| *open == edge) else { return };
        let (_, impulse) = self.open.swap_remove(place);
        for index in 0..self.columns.len() {
            let shift = self.unknowns.mixes[index].shift(edge);
            if shift != Interval::ZERO {
                for (k, impulse) in impulse.into_iter().enumerate() {
                    let added = shift * self.sized(edge, impulse);
                    self.columns[index][k] += added;
                }
            }
        }
    }
}

/// The motion at `times` (the first is where it starts). `None` where it cannot be enclosed.
pub(super) fn follow(drive: &Drive<'_>, start: Pair, times: &[f64], unknowns: Unknowns<'_>) -> Option<Vec<Node>> {
    let columns: Vec<Triple> = unknowns.mixes.iter().map(|mix| mix.start().map(Interval::point)).collect();
    let mut way = Way { drive, unknowns, state: start, columns, open: Vec::new(), speed: 0.0, nodes: Vec::new() };
    let (begin, end) = (*times.first()?, *times.last()?);
    // Switchings that have certainly, and perhaps, happened; and the point's own, of which at most the order is in doubt.
    let command = drive.command;
    let instants: Vec<(f64, f64)> =
        (0..command.edges()).map(|edge| drive.command_at.window(edge, Interval::point(drive.delay_at_s))).collect();
    let windows: Vec<(f64, f64)> = (0..command.edges())
        .map(|edge| {
            let (open, close) = command.window(edge, drive.delay_s);
            (open.min(instants[edge].0), close.max(instants[edge].1))
        })
        .collect();
    let mut done = windows.iter().take_while(|(_, close)| *close <= begin).count();
    let mut begun = windows.iter().take_while(|(open, _)| *open <= begin).count();
    let mut done_at = instants.iter().take_while(|(_, close)| *close <= begin).count();
    let mut begun_at = instants.iter().take_while(|(open, _)| *open <= begin).count();
    let fresh = way.fresh();
    for edge in done..begun {
        // What happened before the beginning is in the state there.
        way.open.push((edge, fresh.map(|value| value.hull(Interval::ZERO))));
    }
    way.speed = way.state.over[VELOCITY].magnitude();
    let first = way.columns.clone();
    way.note(start.over, start.at, &first)?;
    let mut now = begin;
    loop {
        let next = |list: &[(f64, f64)], index: usize, close: bool| {
            list.get(index).map_or(f64::INFINITY, |window| if close { window.1 } else { window.0 })
        };
        let (close, open) = (next(&windows, done, true), next(&windows, begun, false));
        let (close_at, open_at) = (next(&instants, done_at, true), next(&instants, begun_at, false));
        let until = end.min(close).min(open).min(close_at).min(open_at);
        if until > now {
            let from = way.nodes.len();
            let to = from + times[from..].partition_point(|time| *time <= until);
            let ahead: Vec<Interval> =
                times[from..to].iter().map(|time| Interval::point(*time) - Interval::point(now)).collect();
            let h = Interval::point(until) - Interval::point(now);
            let uncertain = begun > done || begun_at > done_at || done_at != done;
            way.advance(
                command.between(done, begun),
                drive.command_at.between(done_at, begun_at),
                h,
                uncertain,
                &ahead,
            )?;
            now = until;
        }
        if open <= now {
            way.open.push((begun, fresh));
            begun += 1;
        } else if open_at <= now {
            begun_at += 1;
        } else if close_at <= now {
            done_at += 1;
        } else if close <= now {
            way.close(done);
            done += 1;
        } else if now >= end {
            break;
        }
    }
    (way.nodes.len() == times.len()).then_some(way.nodes)
}

/// Terms that are in the model, for a field whose terms are `terms`.
pub(super) fn active(terms: &[Term]) -> [bool; TERMS] {
    let mut active = [false; TERMS];
    for term in terms {
        active[*term as usize] = true;
    }
    active
}
