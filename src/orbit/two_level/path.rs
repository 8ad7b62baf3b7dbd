//! The output over a period of a solution: whether the relay switches earlier, and the extremes.

use super::Undecided;
use super::kernel::Periodic;
use super::modes::Mode;
use super::search::HalfPeriods;
use super::switching::{OFF, ON, Place, SwitchedLoop, Times};
use crate::numeric::{Component, Interval};
use crate::proof::Gradient;
use crate::proof::branch_and_bound::{Visit, subdivide};

/// Cells of an arc on which an earlier switching is ruled out.
const CELLS: usize = 3000;
/// Share of the width of a value at a point that its cell may add: the middle of an extreme's bounds is off by half of it.
const CELL_SHARE: f64 = 1e-6;

/// A solution of the switching conditions, its output a function of the time since the input's rise.
#[derive(Debug)]
pub(super) struct Path<'a> {
    switched: &'a SwitchedLoop,
    periodic: Periodic<'a>,
    pub(super) times: Times<1>,
    /// When the command becomes high and low, with the input just before.
    changes: [(Interval, bool); 2],
    arcs: Vec<OutputArc>,
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

/// The stretches of a period; `None` where the order of the changes is not decided.
fn arcs(switched: &SwitchedLoop, times: &Times<1>, [on, off]: [Interval; 2]) -> Option<Vec<OutputArc>> {
    let [period, high] = [times.period, times.high].map(|time| time.value());
    let undelayed = switched.delay.upper() == 0.0;
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

impl<'a> Path<'a> {
    /// Undecided where the order of the changes is.
    pub(super) fn new(switched: &'a SwitchedLoop, at: &HalfPeriods) -> Result<Self, Undecided> {
        let [high, low] = at.map(Gradient::constant);
        let times = Times::free(high, low);
        let periodic = Periodic::new(&switched.modes, times.period.value()).ok_or(Undecided)?;
        let [on, off] = [ON, OFF].map(|change| {
            let place = switched.place(&times, change)?;
            Some((times.time(&place).value(), place.input_high))
        });
        let changes = [on.ok_or(Undecided)?, off.ok_or(Undecided)?];
        let arcs = arcs(switched, &times, changes.map(|(time, _)| time)).ok_or(Undecided)?;
        let path = Self { switched, periodic, times, changes, arcs, constant: Interval::ZERO };
        let (time, input_high) = changes[0];
        let constant =
            switched.share.map_or(Interval::ZERO, |_| switched.lower - path.output(time, input_high).value());
        Ok(Self { constant, ..path })
    }

    /// The output with its slope over a stretch of time with the input at a level.
    fn output(&self, time: Interval, input_high: bool) -> Gradient<1> {
        self.reading(&self.periodic, time, input_high) + Gradient::constant(self.constant)
    }

    fn reading(&self, periodic: &Periodic<'_>, time: Interval, input_high: bool) -> Gradient<1> {
        let [shift] = Gradient::variables([time]);
        let place = Place { rises: 0.0, falls: 0.0, shift, input_high };
        self.switched.output_at(periodic, &self.times, &place).unwrap_or(Gradient::UNKNOWN)
    }

    /// The output over a cell, by its middle and its slope.
    fn over(&self, cell: Interval, input_high: bool) -> Gradient<1> {
        let natural = self.output(cell, input_high);
        if cell.is_point() {
            return natural;
        }
        let middle = Interval::point(cell.midpoint());
        let by_slope = self.output(middle, input_high).value() + natural.slopes()[0] * (cell - middle);
        Gradient::new(natural.value().intersection(by_slope).unwrap_or(natural.value()), natural.slopes())
    }

    /// Rates of all states where the command becomes high, just before.
    pub(super) fn rates(&self) -> Vec<Interval> {
        let (time, input_high) = self.changes[0];
        let rate = |state: Mode| {
            let periodic = Periodic::new(core::slice::from_ref(&state), self.times.period.value());
            periodic.map_or(Interval::ENTIRE, |periodic| self.reading(&periodic, time, input_high).slopes()[0])
        };
        self.switched.modes.iter().flat_map(Mode::states).map(rate).collect()
    }

    /// Slopes of the output where the command becomes high and where it becomes low, just before.
    pub(super) fn slopes(&self) -> [Interval; 2] {
        self.changes.map(|(time, input_high)| self.output(time, input_high).slopes()[0])
    }

    /// Whether the relay switches where the solution has it and nowhere else.
    pub(super) fn genuine(&self) -> Result<bool, Undecided> {
        let [falling, rising] = self.slopes();
        if falling.is_positive() || rising.is_negative() {
            return Ok(false);
        }
        let mut verdict = Ok(true);
        for arc in &self.arcs {
            match self.keeps(arc) {
                Ok(true) => {}
                Ok(false) => return Ok(false),
                undecided => verdict = undecided,
            }
        }
        verdict
    }

    /// Whether the output stays on the side of the level that the command looks at.
    fn keeps(&self, arc: &OutputArc) -> Result<bool, Undecided> {
        let [upper, lower] = [self.switched.upper, self.switched.lower];
        // The distance from the level, positive before it is passed.
        let left = |cell: Interval| {
            let output = self.over(cell, arc.input_high);
            if arc.command_high { Gradient::constant(upper) - output } else { output - Gradient::constant(lower) }
        };
        let (from, to) = (arc.from.lower(), arc.to.upper());
        // The longest of ever shorter cells at an end on which the distance's slope has a sign.
        let at_an_end = |cell: &dyn Fn(f64) -> Option<Interval>, has_sign: fn(Interval) -> bool| {
            let mut cells = (1..40).filter_map(|halvings| cell((to - from) * 0.5_f64.powi(halvings)));
            cells.find(|&cell| has_sign(left(cell).slopes()[0])).ok_or(Undecided)
        };
        let (mut start, mut end) = (from, to);
        if arc.begins && upper.lower() <= lower.upper() {
            // Without hysteresis it begins at the level.
            start = at_an_end(&|length| Interval::new(from, from + length), Interval::is_positive)?.upper();
        }
        if arc.ends {
            end = at_an_end(&|length| Interval::new(to - length, to), Interval::is_negative)?.lower();
        }
        let Some(between) = Interval::new(start, end) else { return Ok(true) };
        let mut past = false;
        let found = subdivide([between], CELLS, |&[cell]| {
            let distance = left(cell).value();
            past |= distance.is_negative();
            if past { Visit::Stop } else { Visit::settled(distance.is_positive()) }
        });
        if past || found.unsettled.is_none() { Ok(!past) } else { Err(Undecided) }
    }

    /// Bounds of the least and the largest output.
    pub(super) fn extremes(&self) -> Option<[Interval; 2]> {
        let [largest, least] = [Interval::ONE, -Interval::ONE].map(|sign| self.largest(Gradient::constant(sign)));
        Some([-least?, largest?])
    }

    /// Bounds of the largest output times `sign`: where the slope keeps its sign it is at an end of the cell; the
    /// remaining cells are halved until the value at a point is nearly as wide as that over the cell.
    fn largest(&self, sign: Gradient<1>) -> Option<Interval> {
        let (mut reached, mut top) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for arc in &self.arcs {
            let over = |cell: Interval| sign * self.over(cell, arc.input_high);
            let mut open = vec![Interval::new(arc.from.lower(), arc.to.upper())?];
            while let Some(cell) = open.pop() {
                let here = over(cell);
                let (value, [slope]) = (here.value(), here.slopes());
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
                let at = over(end.unwrap_or(Interval::point(cell.midpoint()))).value();
                reached = reached.max(at.lower());
                if end.is_some() {
                    top = top.max(at.upper());
                } else if value.width() <= (1.0 + CELL_SHARE) * at.width() + 8.0 * f64::EPSILON * at.magnitude() {
                    top = top.max(value.upper());
                } else if value.upper() > reached {
                    open.extend(<[Interval; 2]>::from(cell.bisect()));
                }
            }
        }
        Interval::new(reached, top.max(reached))
    }
}
