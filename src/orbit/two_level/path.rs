//! The output over a period of a solution: whether the relay switches earlier, and the extremes.

use super::kernel::{Moment, Periodic};
use super::search::HalfPeriods;
use super::switching::{Change, Conditions, Place, Times};
use crate::numeric::Interval;
use crate::proof::branch_and_bound::{Visit, subdivide};

/// Cells of an arc on which an earlier switching is ruled out.
const CELLS: usize = 3000;
/// Share of the width of a value at a point that its cell may add: the middle of an extreme's bounds is off by half of it.
const CELL_SHARE: f64 = 1e-6;

/// Whether a solution of the switching conditions is an orbit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Genuine {
    Yes,
    /// The output passes a level earlier, or the wrong way.
    No,
    Open,
}

/// A solution with the places of its changes.
#[derive(Debug)]
pub(super) struct Path<'a> {
    conditions: &'a Conditions,
    periodic: Periodic<'a>,
    pub(super) times: Times<2>,
    pub(super) on: Place,
    pub(super) off: Place,
    /// The output's constant where it is free by a pole at zero; zero otherwise.
    constant: Interval,
}

/// A stretch of the period, in times since the input's rise, on which input and command are constant.
#[derive(Clone, Copy, Debug)]
struct OutputArc {
    from: Interval,
    to: Interval,
    input_high: bool,
    command_high: bool,
    /// Whether the command changes where it begins and ends.
    begins: bool,
    ends: bool,
}

impl<'a> Path<'a> {
    /// `None` where the order of the changes is not decided.
    pub(super) fn new(conditions: &'a Conditions, at: &HalfPeriods) -> Option<Self> {
        let times = conditions.times(at);
        let periodic = Periodic::new(&conditions.modes, times.period.value())?;
        let on = conditions.place(&times, Change::On)?;
        let off = conditions.place(&times, Change::Off)?;
        let constant = match conditions.share {
            Some(_) => conditions.lower - conditions.output_at(&periodic, &times, &on)?.value(),
            None => Interval::ZERO,
        };
        Some(Self { conditions, periodic, times, on, off, constant })
    }

    fn moments(&self, time: Interval, input_high: bool) -> [Moment; 2] {
        let (high, low) = (self.times.high.value(), self.times.low.value());
        let period = self.periodic.period();
        let moment = |time: Interval, rest: Interval| Moment { time, rest, share: time / period };
        let since_fall =
            if input_high { moment(time + low, high - time) } else { moment(time - high, period - time + high) };
        [moment(time, period - time), since_fall].map(|Moment { time, rest, share }| {
            let not_negative = |value: Interval| Interval::new(value.lower().max(0.0), value.upper().max(0.0));
            let unit = |value: Interval| Interval::new(value.lower().clamp(0.0, 1.0), value.upper().clamp(0.0, 1.0));
            Moment {
                time: not_negative(time).unwrap_or(time),
                rest: not_negative(rest).unwrap_or(rest),
                share: unit(share).unwrap_or(share),
            }
        })
    }

    /// Output and its slope over a stretch of time with the input at a level.
    fn output(&self, time: Interval, input_high: bool) -> (Interval, Interval) {
        let Conditions { high, low, .. } = *self.conditions;
        let [since_rise, since_fall] = self.moments(time, input_high).map(|moment| self.periodic.answer(&moment));
        let (present, mean) = self.periodic.gains();
        let share = self.times.high.value() / self.periodic.period();
        let input = if input_high { high } else { low };
        let mean_input = if self.conditions.share.is_some() { Interval::ZERO } else { low + (high - low) * share };
        let constant = present * input + mean * mean_input + self.constant;
        let step = high - low;
        ((since_rise.value - since_fall.value) * step + constant, (since_rise.by_time - since_fall.by_time) * step)
    }

    /// The output over a cell, by its middle and its slope.
    fn over(&self, cell: Interval, input_high: bool) -> (Interval, Interval) {
        let (natural, slope) = self.output(cell, input_high);
        if cell.is_point() {
            return (natural, slope);
        }
        let middle = Interval::point(cell.midpoint());
        let by_slope = self.output(middle, input_high).0 + slope * (cell - middle);
        (natural.intersection(by_slope).unwrap_or(natural), slope)
    }

    /// Rates of all states where the command becomes high, just before.
    pub(super) fn rates(&self) -> Vec<super::algebra::Element> {
        let time = self.conditions.time(&self.times, &self.on);
        let [since_rise, since_fall] =
            self.moments(time, self.on.input_high).map(|moment| self.periodic.rates(&moment));
        let step = self.conditions.high - self.conditions.low;
        let difference = |(a, b): (&super::algebra::Element, &super::algebra::Element)| {
            core::array::from_fn(|at| (a[at] - b[at]) * step)
        };
        since_rise.iter().zip(&since_fall).map(difference).collect()
    }

    /// Slopes of the output where the command becomes high and where it becomes low, just before.
    pub(super) fn slopes(&self) -> [Interval; 2] {
        [self.on, self.off].map(|place| {
            let time = self.conditions.time(&self.times, &place);
            self.output(time, place.input_high).1
        })
    }

    fn arcs(&self) -> Option<Vec<OutputArc>> {
        let period = self.periodic.period();
        let high = self.times.high.value();
        let [on, off] = [self.on, self.off].map(|place| self.conditions.time(&self.times, &place));
        let undelayed = self.conditions.delay.upper() == 0.0;
        // (time, whether the command changes there)
        let mut borders = vec![(Interval::ZERO, undelayed), (high, undelayed), (period, undelayed)];
        if !undelayed {
            borders.extend([(on, true), (off, true)]);
        }
        borders.sort_by(|a, b| a.0.midpoint().total_cmp(&b.0.midpoint()));
        if borders.windows(2).any(|pair| !pair[0].0.precedes(pair[1].0)) {
            return None;
        }
        let arc = |pair: &[(Interval, bool)]| {
            let [(from, begins), (to, ends)] = [pair[0], pair[1]];
            let middle = 0.5 * (from.midpoint() + to.midpoint());
            let (since_on, length) = ((middle - on.midpoint()).rem_euclid(period.midpoint()), high.midpoint());
            OutputArc { from, to, input_high: middle < high.midpoint(), command_high: since_on < length, begins, ends }
        };
        Some(borders.windows(2).map(arc).collect())
    }

    /// Whether the relay switches where the solution has it and nowhere else.
    pub(super) fn genuine(&self) -> Genuine {
        let Some(arcs) = self.arcs() else { return Genuine::Open };
        let [falling, rising] = self.slopes();
        if falling.is_positive() || rising.is_negative() {
            return Genuine::No;
        }
        let mut verdict = Genuine::Yes;
        for arc in &arcs {
            match self.keeps(arc) {
                Genuine::No => return Genuine::No,
                Genuine::Open => verdict = Genuine::Open,
                Genuine::Yes => {}
            }
        }
        verdict
    }

    /// Whether the output stays on the side of the level that the command looks at.
    fn keeps(&self, arc: &OutputArc) -> Genuine {
        let Conditions { upper, lower, .. } = *self.conditions;
        // The distance from the level, positive before it is passed, and its slope.
        let left = |cell: Interval| {
            let (value, slope) = self.over(cell, arc.input_high);
            if arc.command_high { (upper - value, -slope) } else { (value - lower, slope) }
        };
        let (from, to) = (arc.from.lower(), arc.to.upper());
        let lengths = || (1..40).map(|halvings| (to - from) * 0.5_f64.powi(halvings));
        let mut start = from;
        if arc.begins && upper.lower() <= lower.upper() {
            // Without hysteresis it begins at the level.
            let leaves =
                |&length: &f64| Interval::new(from, from + length).is_some_and(|cell| left(cell).1.is_positive());
            let Some(length) = lengths().find(leaves) else { return Genuine::Open };
            start = from + length;
        }
        let mut end = to;
        if arc.ends {
            let arrives = |&length: &f64| Interval::new(to - length, to).is_some_and(|cell| left(cell).1.is_negative());
            let Some(length) = lengths().find(arrives) else { return Genuine::Open };
            end = to - length;
        }
        let Some(between) = Interval::new(start, end) else { return Genuine::Yes };
        let mut past = false;
        let found = subdivide([between], CELLS, |&[cell]| {
            let distance = left(cell).0;
            past |= distance.is_negative();
            if past { Visit::Stop } else { Visit::settled(distance.is_positive()) }
        });
        match (past, found.unsettled) {
            (true, _) => Genuine::No,
            (false, None) => Genuine::Yes,
            (false, Some(_)) => Genuine::Open,
        }
    }

    /// Bounds of the least and the largest output.
    pub(super) fn extremes(&self) -> Option<[Interval; 2]> {
        let arcs = self.arcs()?;
        Some([-self.largest(&arcs, -Interval::ONE)?, self.largest(&arcs, Interval::ONE)?])
    }

    /// Bounds of the largest output times `sign`: where the slope keeps its sign it is at an end of the cell; the
    /// remaining cells are halved until the value at a point is nearly as wide as that over the cell.
    fn largest(&self, arcs: &[OutputArc], sign: Interval) -> Option<Interval> {
        let (mut reached, mut top) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for arc in arcs {
            let over = |cell: Interval| {
                let (value, slope) = self.over(cell, arc.input_high);
                (sign * value, sign * slope)
            };
            let mut open = vec![Interval::new(arc.from.lower(), arc.to.upper())?];
            while let Some(cell) = open.pop() {
                let (value, slope) = over(cell);
                if value.upper() <= reached {
                    continue;
                }
                // An end of the arc has an enclosure only.
                let end = if slope.is_positive() {
                    Some(if cell.upper() == arc.to.upper() { arc.to } else { Interval::point(cell.upper()) })
                } else if slope.is_negative() {
                    Some(if cell.lower() == arc.from.lower() { arc.from } else { Interval::point(cell.lower()) })
                } else {
                    None
                };
                let at = over(end.unwrap_or(Interval::point(cell.midpoint()))).0;
                reached = reached.max(at.lower());
                if end.is_some() {
                    top = top.max(at.upper());
                } else if value.width() <= (1.0 + CELL_SHARE) * at.width() + 8.0 * f64::EPSILON * at.magnitude() {
                    top = top.max(value.upper());
                } else if value.upper() > reached {
                    let (first, second) = cell.bisect();
                    open.extend([first, second]);
                }
            }
        }
        Interval::new(reached, top.max(reached))
    }
}
