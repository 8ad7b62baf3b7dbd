//! The flow along a record: enclosures of the motion at every sample over a box, and its sensitivities about a point of the box.

use super::record::Command;
use super::sensitivities::{Block, Variable};
use super::taylor_step::{Arrival, FlowStep, MOST_LENGTH, TooLong};
use super::vector_field::{FORCE, FieldTerm, Fields, StateBox, StatePair, VELOCITY, VectorField, changes_sign};
use super::work::Work;
use crate::numeric::{Balls, Interval, Real};

/// The most steps between two changes of the command.
const MOST_STEPS: usize = 2000;
/// Length of a step by rates against the fastest rate: its error grows with the square of the length.
const BY_RATES: f64 = 0.1;
/// A step is made this much shorter than its limits, and made anew only where it is longer than they allow by more than that.
const SAFETY: f64 = 0.8;
/// How often a step is made shorter before the motion is given up.
const MOST_SHORTENED: usize = 40;

/// The enclosure at a sample.
#[derive(Clone, Debug)]
pub(super) struct SampleEnclosure {
    /// Over the box.
    pub(super) over: StateBox,
    /// Of the point.
    pub(super) at: StateBox,
    /// By each variable: the state over the box is that of the point plus these times the deviations of the variables.
    pub(super) sensitivities: Vec<StateBox>,
    /// Largest speed, and acceleration, since the sample before.
    pub(super) fastest: [f64; 2],
}

/// The equation with its command and delay, over a box and at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct DelayedCommand<'a> {
    pub(super) fields: Fields,
    pub(super) command: &'a Command,
    pub(super) delay_s: Interval,
    pub(super) command_at: &'a Command,
    pub(super) delay_at_s: f64,
    /// A faster motion is given up.
    pub(super) fastest: f64,
    /// The largest uncertainty of the point's velocity after a step.
    pub(super) allowed: f64,
    pub(super) work: &'a Work,
}

/// A switching at an uncertain instant, which may have happened.
struct UncertainSwitching {
    edge: usize,
    /// The states to which a unit impulse at the switching may have brought the motion by now.
    impulse: StateBox,
}

/// The state and its columns on the way.
struct FlowEnclosure<'a> {
    input: &'a DelayedCommand<'a>,
    blocks: &'a [Block],
    state: StatePair,
    columns: Vec<[Balls; 3]>,
    uncertain: Vec<UncertainSwitching>,
    fastest: [f64; 2],
    nodes: Vec<SampleEnclosure>,
}

fn shorten(part: &mut Interval, length: f64) {
    if length < part.lower() {
        *part = Interval::point(length);
    }
}

/// A step of at most the length `part`, which it shortens; `Some(None)` where the velocity is about to change its sign.
fn stride(
    fields: &Fields,
    state: &StatePair,
    u: Interval,
    part: &mut Interval,
    allowed: f64,
    blocks: &[Block],
) -> Option<Option<Box<FlowStep>>> {
    let field = &fields.over;
    // The point need not be in the box.
    let both: StateBox = core::array::from_fn(|k| state.over[k].hull(state.at[k]));
    let v = both[VELOCITY];
    shorten(part, SAFETY * MOST_LENGTH / field.fastest_rate(v));
    let [_, rate, _] = field.rate(&both, u);
    let mut near_rest =
        field.has(FieldTerm::Quadratic) && changes_sign(v.hull(v + rate * Interval::point(part.lower())));
    for _ in 0..MOST_SHORTENED {
        if near_rest {
            let (time_s, passed) = to_rest(field, &both, u, part.upper());
            shorten(part, time_s);
            if passed {
                return Some(None);
            }
        }
        let share = match fields.taylor(state, u, *part, blocks) {
            Ok(step) => {
                let longer = step.could_be_longer(*part, allowed);
                if longer >= 1.0 {
                    return Some(Some(step));
                }
                SAFETY * longer
            }
            Err(TooLong::Share(share)) => share,
            Err(TooLong::Kink) => {
                near_rest = true;
                SAFETY
            }
        };
        *part = Interval::point(share * part.lower());
    }
    None
}

/// An estimate of the time for which the velocity keeps its sign, and `false`; or, where that is nearly over, of the time after which
/// it has changed it, and `true`.
fn to_rest(field: &VectorField, state: &StateBox, u: Interval, left: f64) -> (f64, bool) {
    let (v, rate) = (state[VELOCITY], field.rate(state, u)[VELOCITY]);
    let acceleration = rate.midpoint().abs().max(f64::MIN_POSITIVE);
    let spread = 1.0 + rate.radius() / acceleration;
    let fast = if v.lower() > 0.0 || v.upper() < 0.0 {
        v.magnitude()
    } else if rate.midpoint() < 0.0 {
        v.upper()
    } else {
        -v.lower()
    };
    let slow = v.abs().lower();
    let (near, far) = (slow / (acceleration * spread), fast * spread / acceleration);
    if near > 1e-7 * left && near > 0.1 * (far - near) {
        return (0.98 * near, false);
    }
    ((1.05 * far + 1e-9 * left).max(1e-12 * left), true)
}

/// The motion of a point alone: its end, and the states that it passes.
fn advance_point(field: &VectorField, start: StateBox, u: Interval, h: Interval) -> Option<[StateBox; 2]> {
    let (mut state, mut passed, mut left) = (start, start, h);
    let fields = Fields { over: *field, at: *field };
    for _ in 0..MOST_STEPS {
        if left.upper() <= 0.0 {
            return Some([state, passed]);
        }
        let mut part = left;
        let pair = StatePair { over: state, at: state };
        let taylor = if u.is_point() { stride(&fields, &pair, u, &mut part, f64::INFINITY, &[])? } else { None };
        let [end, within] = match taylor {
            Some(step) => [step.at(part).at?, step.within],
            None => {
                shorten(&mut part, BY_RATES / field.fastest_rate(state[VELOCITY]));
                halved(&mut part, |part| field.by_rates(&state, u, part))?
            }
        };
        state = end;
        passed = core::array::from_fn(|k| passed[k].hull(within[k]));
        left = if part == left { Interval::ZERO } else { left - part };
    }
    None
}

/// The first of a step and its successive halves for which there is an enclosure.
fn halved<T>(part: &mut Interval, step: impl Fn(Interval) -> Option<T>) -> Option<T> {
    for _ in 0..MOST_SHORTENED {
        if let Some(made) = step(*part) {
            return Some(made);
        }
        *part = Interval::point(0.5 * part.lower());
    }
    None
}

impl FlowEnclosure<'_> {
    fn lagged(&self) -> bool {
        self.input.fields.over.has(FieldTerm::LagRate)
    }

    fn carried(&self, arrival: &Arrival) -> Vec<[Balls; 3]> {
        self.columns.iter().enumerate().map(|(block, columns)| arrival.carry_block(columns, block)).collect()
    }

    /// Columns with uncertain switchings, and the state over the box: the intersection of its enclosure with the mean value form.
    fn mean_value(&self, mut over: StateBox, at: &StateBox, columns: &[[Balls; 3]]) -> (StateBox, Vec<[Balls; 3]>) {
        let blocks = self.blocks.iter().zip(columns);
        let columns: Vec<[Balls; 3]> = blocks.map(|(block, columns)| self.with_uncertain(block, *columns)).collect();
        for k in 0..if self.lagged() { 3 } else { 2 } {
            let parts = self.blocks.iter().zip(&columns).map(|(block, columns)| (columns[k], block.deviations));
            let form = at[k] + Balls::dot(parts).total();
            // Two enclosures of the same values intersect.
            over[k] = over[k].intersection(form).unwrap_or(over[k]);
        }
        (over, columns)
    }

    /// Notes a sample.
    fn note(&mut self, over: StateBox, at: StateBox, columns: &[[Balls; 3]]) -> Option<()> {
        let (over, columns) = self.mean_value(over, &at, columns);
        let sensitivities: Vec<StateBox> = (self.blocks.iter().zip(&columns))
            .flat_map(|(block, columns)| {
                let components = columns.map(Balls::intervals);
                (0..block.count()).map(move |lane| components.map(|values| values[lane]))
            })
            .collect();
        if !over.iter().chain(sensitivities.iter().flatten()).all(|value| value.is_bounded()) {
            return None;
        }
        self.nodes.push(SampleEnclosure { over, at, sensitivities, fastest: self.fastest });
        Some(())
    }

    /// For the duration `h`, the command constant unless it is `uncertain`; notes the samples on the way, `ahead` from here.
    fn advance(
        &mut self,
        [u, u_at]: [Interval; 2],
        h: Interval,
        uncertain: bool,
        mut ahead: &[Interval],
    ) -> Option<()> {
        let fields = self.input.fields;
        if !self.lagged() {
            (self.state.over[FORCE], self.state.at[FORCE]) = (u, u_at);
        }
        let (mut left, mut gone, mut longest) = (h, Interval::ZERO, f64::INFINITY);
        for _ in 0..MOST_STEPS {
            if left.upper() <= 0.0 {
                return Some(());
            }
            let mut part = left;
            shorten(&mut part, longest);
            let allowed = self.input.allowed;
            let taylor =
                if uncertain { None } else { stride(&fields, &self.state, u, &mut part, allowed, self.blocks)? };
            let (step, point) = match taylor {
                Some(step) => {
                    longest = part.upper() * SAFETY * step.could_be_longer(part, allowed);
                    (step, None)
                }
                None => {
                    // The point moves by itself, and is known at the end of the step alone: the step ends with a sample.
                    if let Some(sample) = ahead.first() {
                        let until = *sample - gone;
                        if until.lower() > 0.0 && until.upper() < part.lower() {
                            part = until;
                        }
                    }
                    let (step, at, passed) = self.by_rates(u, u_at, &mut part)?;
                    (step, Some([at, passed]))
                }
            };
            self.input.work.step(self.blocks.len());
            let acceleration = fields.over.rate_of(VELOCITY, &step.within, u);
            let own = [step.within[VELOCITY], acceleration].map(|range| range.magnitude());
            self.fastest = core::array::from_fn(|k| self.fastest[k].max(own[k]));
            let last = part == left;
            let reached = ahead.iter().take_while(|sample| last || (**sample - gone).upper() <= part.upper()).count();
            let (within, beyond) = ahead.split_at(reached);
            for sample in within {
                let time = *sample - gone;
                let arrival = step.at(time);
                let columns = self.carried(&arrival);
                let at = arrival.at.or(point.map(|[at, passed]| if time == part { at } else { passed }))?;
                self.note(arrival.over, at, &columns)?;
                self.fastest = own;
            }
            ahead = beyond;
            let end = step.end(part);
            self.columns = self.carried(&end);
            self.state.at = end.at.or(point.map(|[at, _]| at))?;
            let fresh = self.unit_impulse();
            for UncertainSwitching { impulse, .. } in &mut self.uncertain {
                // The switching may also be at this very end.
                let carried = end.carry(&impulse.map(Balls::splat));
                *impulse = core::array::from_fn(|k| carried[k].interval_at(0).hull(fresh[k]));
            }
            (self.state.over, _) = self.mean_value(end.over, &self.state.at, &self.columns);
            if self.state.over[VELOCITY].magnitude() > self.input.fastest {
                return None;
            }
            (left, gone) = if last { (Interval::ZERO, h) } else { (left - part, gone + part) };
        }
        None
    }

    /// A step by rates, the end of the point's motion, and the states that it passes.
    fn by_rates(
        &self,
        u: Interval,
        u_at: Interval,
        part: &mut Interval,
    ) -> Option<(Box<FlowStep>, StateBox, StateBox)> {
        let fields = &self.input.fields;
        shorten(part, BY_RATES / fields.over.fastest_rate(self.state.over[VELOCITY]));
        halved(part, |part| {
            let [at, passed] = advance_point(&fields.at, self.state.at, u_at, part)?;
            Some((fields.by_rates(&self.state.over, u, &passed, u_at, part, self.blocks)?, at, passed))
        })
    }
}

/// Switchings in their order: how many have certainly happened, and how many may have.
struct Passed {
    windows: Vec<Interval>,
    done: usize,
    begun: usize,
}

impl Passed {
    fn at(windows: Vec<Interval>, time: f64) -> Self {
        let done = windows.iter().take_while(|window| window.upper() <= time).count();
        let begun = windows.iter().take_while(|window| window.lower() <= time).count();
        Self { windows, done, begun }
    }
    fn next_end(&self) -> f64 {
        self.windows.get(self.done).map_or(f64::INFINITY, |window| window.upper())
    }
    fn next_begin(&self) -> f64 {
        self.windows.get(self.begun).map_or(f64::INFINITY, |window| window.lower())
    }
}

/// The motion at the `times`, at the first of which it starts; with sensitivities by variables, and their deviations from the point. `None` where it cannot be enclosed.
pub(super) fn follow(
    input: &DelayedCommand<'_>,
    start: StatePair,
    times: &[f64],
    variables: &[Variable],
    deviations: &[Interval],
) -> Option<Vec<SampleEnclosure>> {
    let blocks = Block::of(variables, deviations);
    let columns: Vec<_> = blocks.iter().map(|block| block.initial).collect();
    let fastest = [start.over[VELOCITY].magnitude(), 0.0];
    let mut flow = FlowEnclosure {
        input,
        blocks: &blocks,
        state: start,
        columns,
        uncertain: Vec::new(),
        fastest,
        nodes: Vec::new(),
    };
    let (begin, end) = (*times.first()?, *times.last()?);
    let command = input.command;
    // The point's own switchings, of which rounding alone is uncertain, are inside those over the box.
    let own: Vec<_> = input.command_at.windows(Interval::point(input.delay_at_s)).collect();
    let windows = command.windows(input.delay_s).zip(&own).map(|(window, own)| window.hull(*own));
    let (mut over, mut at) = (Passed::at(windows.collect(), begin), Passed::at(own, begin));
    let fresh = flow.unit_impulse();
    for edge in over.done..over.begun {
        // A switching before the beginning is in the initial state.
        flow.uncertain.push(UncertainSwitching { edge, impulse: fresh.map(|value| value.hull(Interval::ZERO)) });
    }
    let first = flow.columns.clone();
    flow.note(start.over, start.at, &first)?;
    let (mut now, mut from) = (begin, 1);
    loop {
        let changes = [over.next_end(), over.next_begin(), at.next_end(), at.next_begin()];
        let until = changes.into_iter().fold(end, f64::min);
        if until > now {
            let to = from + times[from..].partition_point(|time| *time <= until);
            let ahead: Vec<Interval> =
                times[from..to].iter().map(|time| Interval::point(*time) - Interval::point(now)).collect();
            from = to;
            let commands = [command.between(over.done, over.begun), input.command_at.between(at.done, at.begun)];
            let uncertain = over.begun > over.done || at.begun > at.done || at.done != over.done;
            flow.advance(commands, Interval::point(until) - Interval::point(now), uncertain, &ahead)?;
            now = until;
        }
        if over.next_begin() <= now {
            flow.uncertain.push(UncertainSwitching { edge: over.begun, impulse: fresh });
            over.begun += 1;
        } else if at.next_begin() <= now {
            at.begun += 1;
        } else if at.next_end() <= now {
            at.done += 1;
        } else if over.next_end() <= now {
            flow.settle(over.done);
            over.done += 1;
        } else if now >= end {
            break;
        }
    }
    (flow.nodes.len() == times.len()).then_some(flow.nodes)
}

// Moving a switching later by z subtracts its jump during z: an impulse at the switching of the size `gain (u_before - u_after) z`, which
// the motion carries on. While the instant is uncertain the impulse may have happened at any time since the earliest instant.
impl FlowEnclosure<'_> {
    /// Columns with the contributions that uncertain switchings may have made.
    fn with_uncertain(&self, block: &Block, mut columns: [Balls; 3]) -> [Balls; 3] {
        for UncertainSwitching { edge, impulse } in &self.uncertain {
            if let Some(shifts) = block.shifts(*edge) {
                for (values, impulse) in columns.iter_mut().zip(impulse) {
                    *values = *values + shifts * Balls::splat(self.scaled(*edge, *impulse).hull(Interval::ZERO));
                }
            }
        }
        columns
    }

    /// A unit impulse times the size that a later switching gives it.
    fn scaled(&self, edge: usize, impulse: Interval) -> Interval {
        let field = &self.input.fields.over;
        let factor = field.term(if self.lagged() { FieldTerm::LagRate } else { FieldTerm::Gain });
        factor * self.input.command.drop_at(edge) * impulse
    }

    /// A unit impulse at this instant.
    fn unit_impulse(&self) -> StateBox {
        let mut impulse = [Interval::ZERO; 3];
        impulse[if self.lagged() { FORCE } else { VELOCITY }] = Interval::ONE;
        impulse
    }

    /// At the latest instant of a switching its contribution is certain.
    fn settle(&mut self, edge: usize) {
        let Some(place) = self.uncertain.iter().position(|own| own.edge == edge) else { return };
        let UncertainSwitching { impulse, .. } = self.uncertain.swap_remove(place);
        let added = impulse.map(|impulse| Balls::splat(self.scaled(edge, impulse)));
        for (block, columns) in self.blocks.iter().zip(&mut self.columns) {
            if let Some(shifts) = block.shifts(edge) {
                for (values, added) in columns.iter_mut().zip(added) {
                    *values = *values + shifts * added;
                }
            }
        }
    }
}
