//! The motion along a record over a box of unknowns: enclosures of the output at every sample, and of its slopes about a point.

use super::bend::{BEND_ORDER, Carried, Pairs};
use super::command::Command;
use super::effort::Effort;
use super::field::{FORCE, Field, POSITION, TERMS, Term, Triple, VELOCITY};
use super::mix::{Bundle, Mix};
use super::series::ORDER;
use super::step::{Arrival, Fields, Manner, Pair, Refused, Step, straddles};
use crate::numeric::{Balls, Interval};
use open::Open;
use point::advance_point;

mod open;
mod point;

/// The most steps between two changes of the command.
const MOST_STEPS: usize = 2000;
/// Steps of a point that is followed by itself.
const FINE: Manner = Manner { length: 0.12, degree: Some(ORDER) };
/// Steps with slopes over a box, and the first of any motion.
const FIRST: Manner = Manner { length: 0.4, degree: Some(8) };
/// Later steps to the second order, and of a point.
const LONG: Manner = Manner { length: 0.5, degree: Some(ORDER) };
// What bends is followed to a degree of its own, by the point's coefficients.
const _: () = assert!(FIRST.reaches(BEND_ORDER) && LONG.reaches(BEND_ORDER));
/// With slopes over a box a remainder may be so many times as large.
const LOOSER: f64 = 10.0;
/// Steps in closed form: over a box, where longer ones leave more in doubt of slopes, and of a point.
const CLOSED: Manner = Manner { length: 0.4, degree: None };
const CLOSED_POINT: Manner = Manner { length: 2.0, degree: None };
const CLOSED_BENT: Manner = Manner { length: 1.2, degree: None };
/// Length against the fastest rate of a step by the rates' ranges.
const CRUDE: f64 = 0.1;
/// A step is made anew where it may be no longer than this share of itself.
const ENOUGH: f64 = 0.8;
/// A step is made no longer than this share of what the remainder of the one before would allow.
const SAFETY: f64 = 0.8;
/// How often the velocity at a step's end is looked at before it is made.
const LOOKS_AHEAD: usize = 3;
/// A step that would pass a change of sign is made shorter by this.
const SHORTER: f64 = 0.7;
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
    /// Of the position: how its slopes bend by each bundle of pairs, and what is left of the third order; with the slopes over the box none.
    pub(super) bends: Vec<Balls>,
    pub(super) rest: Interval,
    /// Largest speed, and acceleration, since the sample before.
    pub(super) fastest: [f64; 2],
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
    /// What a step may leave unsure of the velocity; none for steps by the fastest rate alone.
    pub(super) remainder: Option<f64>,
    pub(super) effort: &'a Effort,
}

/// Unknowns of a motion: what each is, and how far from the point it may be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unknowns<'a> {
    pub(super) mixes: &'a [Mix],
    pub(super) deviations: &'a [Interval],
    /// Whether slopes are the point's, and how they bend over the box is followed besides.
    pub(super) bending: bool,
}

impl Unknowns<'_> {
    pub(super) const NONE: Self = Self { mixes: &[], deviations: &[], bending: false };
}

/// The state, and its slopes, on the way.
struct Way<'a> {
    drive: &'a Drive<'a>,
    /// The unknowns.
    bundles: &'a [Bundle],
    state: Pair,
    /// Slopes by the unknowns of each bundle.
    columns: Vec<[Balls; 3]>,
    pairs: Option<Pairs>,
    /// Whether remainders count: to the second order, and of a point.
    precise: bool,
    bends: Vec<[Balls; 3]>,
    rest: Triple,
    /// Switchings that may have happened, each with what a unit of impulse then may have become since.
    open: Vec<Open>,
    /// Largest speed, and acceleration, since the last sample.
    fastest: [f64; 2],
    nodes: Vec<Node>,
}

fn shorten(part: &mut Interval, length: f64) {
    if length < part.lower() {
        *part = Interval::point(length);
    }
}

/// How long a step may be.
#[derive(Clone, Copy, Debug)]
struct Pace {
    manner: Manner,
    longest_s: f64,
    /// What it may leave unsure of the point's velocity.
    unsure: f64,
}

/// One step of at most the duration `part`, which it shortens; none where the velocity is about to change its sign.
fn stride(
    fields: &Fields,
    state: &Pair,
    u: Interval,
    part: &mut Interval,
    pace: Pace,
    carried: &Carried<'_>,
) -> Option<Option<Box<Step>>> {
    let manner = match (fields.closed(), carried.of_point(), carried.pairs) {
        (true, true, _) => CLOSED_POINT,
        (true, false, None) => CLOSED,
        (true, false, Some(_)) => CLOSED_BENT,
        (false, ..) => pace.manner,
    };
    let (field, length) = (&fields.over, manner.length);
    // All states, the point's among them: it need not be in the box.
    let both: Triple = core::array::from_fn(|k| state.over[k].hull(state.at[k]));
    let v = both[VELOCITY];
    let [_, rate, _] = field.rate(&both, u);
    shorten(part, pace.longest_s);
    shorten(part, length / field.fastest(v));
    let mut ahead = v;
    // A closed form is as good where the motion is about to be faster.
    let looks = if manner.degree.is_some() { LOOKS_AHEAD } else { 0 };
    for _ in 0..looks {
        ahead = v.hull(v + rate * Interval::point(part.lower()));
        shorten(part, libm::sqrt(part.lower() * length / field.fastest(ahead)));
    }
    let mut turning = field.has(Term::Quadratic) && straddles(ahead);
    for _ in 0..MOST_SHORTENED {
        if turning {
            let (rest_s, passed) = to_rest(field, &both, u, part.upper());
            shorten(part, rest_s);
            if passed {
                return Some(None);
            }
        }
        let share = match fields.smooth(state, u, *part, manner, carried) {
            Ok(step) => {
                let longer = SAFETY * step.longer(*part, pace.unsure);
                if longer >= ENOUGH {
                    return Some(Some(step));
                }
                longer
            }
            Err(Refused::TooLong(share)) => share,
            Err(Refused::Kink) => {
                turning = true;
                SHORTER
            }
        };
        *part = Interval::point(share * part.lower());
    }
    None
}

/// How long the velocity certainly keeps its sign; or, where that is nearly over, how long until it has certainly changed it,
/// and `true`. An estimate.
fn to_rest(field: &Field, state: &Triple, u: Interval, left: f64) -> (f64, bool) {
    let [x, v, f] = *state;
    let rate = |v: Interval| field.rate(&[x, v, f], u)[VELOCITY];
    let now = rate(v);
    let (first, last) = (now.midpoint(), rate(Interval::ZERO).midpoint());
    // The mean over the way there, if the rate is linear in the velocity.
    let ratio = first / last;
    let mean = if ratio > 0.0 && (ratio - 1.0).abs() > 1e-3 { (first - last) / libm::log(ratio) } else { first };
    let acceleration = mean.abs().max(f64::MIN_POSITIVE);
    // Rates of a box are faster, and slower.
    let spread = 1.0 + now.radius() / first.abs().max(f64::MIN_POSITIVE);
    let (slow, fast) = if v.lower() > 0.0 {
        (v.lower(), v.upper())
    } else if v.upper() < 0.0 {
        (-v.upper(), -v.lower())
    } else if mean < 0.0 {
        (0.0, v.upper())
    } else {
        (0.0, -v.lower())
    };
    let (near, far) = (slow / (acceleration * spread), fast * spread / acceleration);
    if near > 1e-7 * left && near > 0.1 * (far - near) {
        return (0.98 * near, false);
    }
    ((1.05 * far + 1e-9 * left).max(1e-12 * left), true)
}

impl Way<'_> {
    fn carried(&self, arrival: &Arrival) -> Vec<[Balls; 3]> {
        self.columns.iter().enumerate().map(|(bundle, columns)| arrival.carry_bundle(columns, bundle)).collect()
    }

    fn all(&self) -> Carried<'_> {
        Carried {
            bundles: self.bundles,
            columns: &self.columns,
            pairs: self.pairs.as_ref(),
            bends: &self.bends,
            rest: self.rest,
        }
    }

    /// What slopes leave out.
    fn left_out(&self, bends: &[[Balls; 3]], rest: &Triple) -> Triple {
        core::array::from_fn(|k| self.pairs.as_ref().map_or(Interval::ZERO, |pairs| pairs.total(bends, k) + rest[k]))
    }

    /// Notes a sample.
    fn note(
        &mut self,
        over: Triple,
        at: Triple,
        columns: &[[Balls; 3]],
        bends: &[[Balls; 3]],
        rest: &Triple,
    ) -> Option<()> {
        let columns: Vec<[Balls; 3]> =
            self.bundles.iter().zip(columns).map(|(bundle, columns)| self.with_open(bundle, *columns)).collect();
        let bend = self.left_out(bends, rest);
        let over = self.met(over, &at, &columns, &bend);
        let slopes: Vec<Triple> = (self.bundles.iter().zip(&columns))
            .flat_map(|(bundle, columns)| {
                let components = columns.map(Balls::intervals);
                (0..bundle.count()).map(move |place| components.map(|values| values[place]))
            })
            .collect();
        if !over.iter().chain(slopes.iter().flatten()).chain(&bend).all(|value| value.is_bounded()) {
            return None;
        }
        let bends = bends.iter().map(|bend| bend[POSITION]).collect();
        self.drive.effort.node(self.pairs.is_some());
        self.nodes.push(Node { over, at, slopes, bends, rest: rest[POSITION], fastest: self.fastest });
        Some(())
    }

    /// What is both the state, and the point's state with the slopes.
    fn met(&self, mut over: Triple, at: &Triple, columns: &[[Balls; 3]], bend: &Triple) -> Triple {
        let components = if self.lagged() { 3 } else { 2 };
        for k in 0..components {
            let parts = self.bundles.iter().zip(columns).map(|(bundle, columns)| (columns[k], bundle.deviations));
            let mean = at[k] + Balls::dot(parts).total() + bend[k];
            // Both enclose the same values, so that they meet.
            over[k] = over[k].intersection(mean).unwrap_or(over[k]);
        }
        over
    }

    fn lagged(&self) -> bool {
        self.drive.fields.over.has(Term::LagRate)
    }

    /// For the duration `h`, the command constant unless it is `uncertain`; notes those samples on the way, `ahead` from here, that are
    /// heard.
    fn advance(
        &mut self,
        u: Interval,
        u_at: Interval,
        h: Interval,
        uncertain: bool,
        ahead: &[(Interval, bool)],
    ) -> Option<()> {
        if !self.lagged() {
            (self.state.over[FORCE], self.state.at[FORCE]) = (u, u_at);
        }
        let (mut left, mut gone, mut ahead) = (h, Interval::ZERO, ahead);
        let looser = if self.precise { 1.0 } else { LOOSER };
        let unsure = self.drive.remainder.map_or(f64::INFINITY, |remainder| looser * remainder);
        let mut pace = Pace { manner: FIRST, longest_s: f64::INFINITY, unsure };
        for _ in 0..MOST_STEPS {
            if left.upper() <= 0.0 {
                return Some(());
            }
            let mut part = left;
            let mut step = if uncertain {
                None
            } else {
                stride(&self.drive.fields, &self.state, u, &mut part, pace, &self.all())?
            };
            if let (Some(step), true) = (&step, unsure.is_finite()) {
                pace.longest_s = part.upper() * SAFETY * step.longer(part, unsure);
                if self.precise {
                    pace.manner = LONG;
                }
            }
            let mut at_end = None;
            if step.is_none() {
                // The point goes its own way, and the step ends with a sample, that it be known there.
                if let Some((sample, _)) = ahead.first() {
                    let until = *sample - gone;
                    if until.lower() > 0.0 && until.upper() < part.lower() {
                        part = until;
                    }
                }
                let (crude, at, passed) = self.crude(u, u_at, &mut part)?;
                (step, at_end) = (Some(crude), Some((at, passed)));
            }
            let mut step = step?;
            if self.bundles.is_empty() {
                self.drive.effort.point();
            } else {
                self.drive.effort.step(self.bends.len(), uncertain || self.drive.fields.closed());
            }
            let rate = self.drive.fields.over.rate_of(VELOCITY, &step.within, u);
            let own = [step.within[VELOCITY], rate].map(|range| range.magnitude());
            self.fastest = core::array::from_fn(|k| self.fastest[k].max(own[k]));
            let last = part == left;
            let reached =
                ahead.iter().take_while(|(sample, _)| last || (*sample - gone).upper() <= part.upper()).count();
            let (within, beyond) = ahead.split_at(reached);
            let heard = within.iter().filter(|(_, heard)| *heard);
            let times: Vec<Interval> = heard.map(|(sample, _)| *sample - gone).collect();
            let (arrivals, arrival) = step.arrivals(&times, part)?;
            for (arrival, time) in arrivals.iter().zip(&times) {
                let columns = self.carried(arrival);
                let at = arrival.at.or(at_end.map(|(at, passed)| if *time == part { at } else { passed }))?;
                let (bends, rest) = (arrival.carry_bends(&self.bends), arrival.carry_rest(&self.rest));
                self.note(arrival.over, at, &columns, &bends, &rest)?;
            }
            if !arrivals.is_empty() {
                self.fastest = own;
            }
            ahead = beyond;
            self.columns = self.carried(&arrival);
            (self.bends, self.rest) = (arrival.carry_bends(&self.bends), arrival.carry_rest(&self.rest));
            self.state.at = arrival.at.or(at_end.map(|(at, _)| at))?;
            let fresh = self.fresh();
            let passed = at_end.map_or(self.state.at[VELOCITY], |(_, passed): (Triple, Triple)| passed[VELOCITY]);
            for Open { impulse, damping, .. } in &mut self.open {
                let own = self.drive.fields.over.damping(step.within[VELOCITY], passed);
                *damping = Some(damping.map_or(own, |damping| damping.hull(own)));
                // The instant of the impulse may also be this very end.
                let carried = arrival.carry(&impulse.map(Balls::splat));
                *impulse = core::array::from_fn(|k| carried[k].interval_at(0).hull(fresh[k]));
            }
            let columns: Vec<[Balls; 3]> = (self.bundles.iter().zip(&self.columns))
                .map(|(bundle, columns)| self.with_open(bundle, *columns))
                .collect();
            let bend = self.left_out(&self.bends, &self.rest);
            self.state.over = self.met(arrival.over, &self.state.at, &columns, &bend);
            if self.state.over[VELOCITY].magnitude() > self.drive.fastest {
                return None;
            }
            (left, gone) = if last { (Interval::ZERO, h) } else { (left - part, gone + part) };
        }
        None
    }

    /// One step by the rates' ranges, where it takes the point, and what that passes.
    fn crude(&self, u: Interval, u_at: Interval, part: &mut Interval) -> Option<(Box<Step>, Triple, Triple)> {
        let fields = &self.drive.fields;
        let fastest = fields.over.fastest(self.state.over[VELOCITY]);
        shorten(part, CRUDE / fastest);
        for _ in 0..MOST_SHORTENED {
            let [at, passed] = advance_point(&fields.at, self.state.at, u_at, *part)?;
            if let Ok(step) = fields.crude(&self.state.over, u, &passed, u_at, *part, self.bundles) {
                return Some((step, at, passed));
            }
            *part = Interval::point(0.5 * part.lower());
        }
        None
    }
}

/// The motion at those of the `times` that are heard, the first, where it starts, among them. `None` where it cannot be enclosed.
pub(super) fn follow(
    drive: &Drive<'_>,
    start: Pair,
    times: &[(f64, bool)],
    unknowns: Unknowns<'_>,
) -> Option<Vec<Node>> {
    let bundles = Bundle::of(unknowns.mixes, unknowns.deviations);
    let columns = bundles.iter().map(|bundle| bundle.start).collect();
    let pairs = unknowns.bending.then(|| Pairs::of(unknowns.mixes, unknowns.deviations));
    let bends = vec![[Balls::ZERO; 3]; pairs.as_ref().map_or(0, Pairs::count)];
    let rest = [Interval::ZERO; 3];
    let mut way = Way {
        drive,
        bundles: &bundles,
        state: start,
        columns,
        precise: pairs.is_some() || unknowns.deviations.iter().all(|deviation| deviation.is_point()),
        pairs,
        bends,
        rest,
        open: Vec::new(),
        fastest: [0.0; 2],
        nodes: Vec::new(),
    };
    let (begin, end) = (times.first()?.0, times.last()?.0);
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
        let impulse = fresh.map(|value| value.hull(Interval::ZERO));
        way.open.push(Open { edge, impulse, whole: false, damping: None });
    }
    way.fastest[0] = way.state.over[VELOCITY].magnitude();
    let first = way.columns.clone();
    let bends = way.bends.clone();
    way.note(start.over, start.at, &first, &bends, &rest)?;
    let (mut now, mut from) = (begin, 1);
    loop {
        let next = |list: &[(f64, f64)], index: usize, close: bool| {
            list.get(index).map_or(f64::INFINITY, |window| if close { window.1 } else { window.0 })
        };
        let (close, open) = (next(&windows, done, true), next(&windows, begun, false));
        let (close_at, open_at) = (next(&instants, done_at, true), next(&instants, begun_at, false));
        let until = end.min(close).min(open).min(close_at).min(open_at);
        if until > now {
            let to = from + times[from..].partition_point(|(time, _)| *time <= until);
            let ahead = times[from..to].iter();
            let ahead: Vec<(Interval, bool)> =
                ahead.map(|(time, heard)| (Interval::point(*time) - Interval::point(now), *heard)).collect();
            from = to;
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
            way.open.push(Open { edge: begun, impulse: fresh, whole: true, damping: None });
            begun += 1;
        } else if open_at <= now {
            begun_at += 1;
        } else if close_at <= now {
            done_at += 1;
        } else if close <= now {
            way.close(done, windows[done], instants[done]);
            done += 1;
        } else if now >= end {
            break;
        }
    }
    let heard = times[1..].iter().filter(|(_, heard)| *heard).count();
    (way.nodes.len() == 1 + heard).then_some(way.nodes)
}

/// Terms that are in the model, for a field whose terms are `terms`.
pub(super) fn active(terms: &[Term]) -> [bool; TERMS] {
    let mut active = [false; TERMS];
    for term in terms {
        active[*term as usize] = true;
    }
    active
}
