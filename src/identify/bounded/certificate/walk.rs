//! The check of a stage: enclosures over the boxes of its tree, and sums.

use std::collections::{BTreeMap, BTreeSet};

use super::super::branch_and_prune::halves;
use super::super::linear_program::Multipliers;
use super::super::linear_relaxation::{Origin, Relaxation, Support, midpoints};
use super::super::problem::Problem;
use super::super::record::Readings;
use super::super::unknowns::{Shooting, Unknowns};
use super::format::{By, Combination, Cut, ProofStage, Step, sides};
use super::unproved::{Unproved, malformed};
use crate::numeric::Interval;

/// Numbers that open boxes may hold together: the memory of the check does not grow with the file.
const MOST_HELD: usize = 1 << 20;

/// Work of a check.
#[derive(Default)]
pub(super) struct Checked {
    pub(super) excluded: usize,
    pub(super) enclosures: usize,
}

/// A stage with the problem over its shooting intervals.
pub(super) struct Walk<'a> {
    stage: &'a ProofStage,
    index: usize,
    problem: Problem,
    left: Option<Vec<Interval>>,
}

/// The inequalities over a box.
struct Enclosed {
    relaxation: Relaxation,
    rows: BTreeMap<Origin, usize>,
    /// The box, cut by the enclosure itself.
    direct: Vec<Interval>,
}

impl Enclosed {
    /// `None` where a multiplier is negative or names no inequality.
    fn multipliers(&self, rows: &Combination) -> Option<Multipliers> {
        let multiplier = |(origin, y): &(Origin, f64)| {
            let valid = *y >= 0.0 && y.is_finite();
            Some((*self.rows.get(origin).filter(|_| valid)?, *y))
        };
        rows.iter().map(multiplier).collect()
    }

    fn excludes(&self, rows: &Combination) -> bool {
        self.multipliers(rows).is_some_and(|multipliers| self.relaxation.upper_bound(&[], &multipliers) < 0.0)
    }

    /// Whether the end of a range follows.
    fn shows(&self, side: Interval, cut: &Cut) -> bool {
        let reached = |side: Interval| if cut.upper { side.upper() <= cut.end } else { side.lower() >= cut.end };
        if cut.rows.is_empty() {
            return reached(self.direct[cut.unknown]);
        }
        let sign = if cut.upper { 1.0 } else { -1.0 };
        let Some(multipliers) = self.multipliers(&cut.rows) else { return false };
        let bound = self.relaxation.upper_bound(&[(cut.unknown, sign)], &multipliers);
        // An empty range is below any end.
        !bound.is_nan() && self.relaxation.cut(side, cut.unknown, sign, bound).is_none_or(reached)
    }

    /// Narrows an unknown after a cut.
    fn learn(&mut self, unknown: usize, side: Interval) {
        let cut = side - Interval::point(self.relaxation.centre[unknown]);
        let known = &mut self.relaxation.deviations[unknown];
        *known = known.intersection(cut).unwrap_or(cut);
    }
}

impl ProofStage {
    /// The unknowns over the stage's shooting intervals: of each record they follow one another, the first after every command that acts is
    /// in the log. `None` where they do not.
    pub(super) fn unknowns(&self, problem: &Problem, delay_s: Interval) -> Option<Unknowns> {
        let shooting: Vec<Shooting> =
            self.shooting.iter().map(|&[record, first, last]| Shooting { record, first, last }).collect();
        let mut before: Option<Shooting> = None;
        for own in &shooting {
            let readings = problem.records.get(own.record)?;
            let follows = match before {
                Some(before) if before.record == own.record => before.last == own.first,
                Some(before) => own.record == before.record + 1,
                None => own.record == 0,
            };
            let acts = readings.acted_s(delay_s) <= *readings.time_s.get(own.first)?;
            if !(follows && acts && own.first < own.last && own.last < readings.time_s.len()) {
                return None;
            }
            before = Some(*own);
        }
        (before?.record + 1 == problem.records.len()).then(|| problem.unknowns.with_shooting(shooting))
    }
}

impl<'a> Walk<'a> {
    /// From a box of parameters.
    pub(super) fn of(
        problem: &Problem,
        from: &[[f64; 2]],
        stage: &'a ProofStage,
        index: usize,
    ) -> Result<Self, Unproved> {
        let malformed = |what: &str| malformed(&format!("{what} of stage {index}"));
        let parameters = problem.unknowns.parameters();
        let inside = |from: &Vec<Interval>| from.len() == parameters && within(from, &problem.search);
        let from = sides(from).filter(inside).ok_or_else(|| malformed("the box"))?;
        let delay_s = problem.unknowns.delay().map_or(problem.known_delay_s, |place| from[place]);
        let unknowns = stage.unknowns(problem, delay_s).ok_or_else(|| malformed("a shooting interval"))?;
        let left = stage.left.as_ref().map(|left| sides(left).filter(|left| left.len() == parameters));
        let left = left.map(|left| left.ok_or_else(|| malformed("what is left"))).transpose()?;
        let problem = Problem { unknowns, ..problem.clone() }.within(&from);
        Ok(Self { stage, index, problem, left })
    }

    pub(super) fn go(&self, work: &mut Checked) -> Result<(), Unproved> {
        let incomplete = Unproved::Incomplete { stage: self.index };
        let mut open = vec![self.problem.search.clone()];
        for (step, what) in self.stage.steps.iter().enumerate() {
            let here = open.pop().ok_or(incomplete.clone())?;
            let refused = |what| Unproved::Step { stage: self.index, step, what };
            let held = 2 * here.len();
            open.extend(self.step(here, what, work).map_err(refused)?);
            if held * open.len() > MOST_HELD {
                return Err(refused("too many boxes are left to deal with"));
            }
        }
        if open.is_empty() { Ok(()) } else { Err(incomplete) }
    }

    /// The boxes after a step, the next last; or why it is refused.
    fn step(
        &self,
        mut here: Vec<Interval>,
        what: &Step,
        work: &mut Checked,
    ) -> Result<Vec<Vec<Interval>>, &'static str> {
        match what {
            Step::Keep => {
                let kept = self.left.as_ref().is_some_and(|left| within(&here[..left.len()], left));
                if kept { Ok(Vec::new()) } else { Err("the box is not within what is left") }
            }
            Step::Divide { unknown, at } => {
                let parts = here.get(*unknown).and_then(|side| halves(*side, *at));
                let [low, high] = parts.ok_or("the division is not within the box")?;
                let mut upper = here.clone();
                (here[*unknown], upper[*unknown]) = (low, high);
                Ok(vec![upper, here])
            }
            Step::Exclude { by, rows } => {
                let enclosed = self.enclose(*by, &here, [rows], work)?;
                if enclosed.is_some_and(|enclosed| !enclosed.excludes(rows)) {
                    return Err("the box is not excluded");
                }
                work.excluded += 1;
                Ok(Vec::new())
            }
            Step::Contract { by, cuts } => {
                let enclosed = self.enclose(*by, &here, cuts.iter().map(|cut| &cut.rows), work)?;
                let Some(mut enclosed) = enclosed else { return Ok(Vec::new()) };
                for cut in cuts {
                    let side = here.get(cut.unknown).copied();
                    if !side.is_some_and(|side| enclosed.shows(side, cut)) {
                        return Err("the range is not that short");
                    }
                    if !cut.shorten(&mut here) {
                        work.excluded += 1;
                        return Ok(Vec::new());
                    }
                    enclosed.learn(cut.unknown, here[cut.unknown]);
                }
                Ok(vec![here])
            }
        }
    }

    /// The inequalities over a box, of modulating functions those in the `combinations`; `Some(None)` where it is empty.
    fn enclose<'r>(
        &self,
        by: By,
        here: &[Interval],
        combinations: impl IntoIterator<Item = &'r Combination>,
        work: &mut Checked,
    ) -> Result<Option<Enclosed>, &'static str> {
        let none = "there is no enclosure";
        let origins: Vec<Origin> = combinations.into_iter().flatten().map(|(origin, _)| *origin).collect();
        let mut direct = here.to_vec();
        let relaxation = match by {
            By::ModulatingFunctions(0) | By::Shooting(0) => return Err(none),
            By::ModulatingFunctions(horizon) => {
                let problem = self.problem.until(horizon);
                let supports = supports(&origins, &problem.records).ok_or(none)?;
                problem.modulate(&supports, &mut direct)
            }
            By::Shooting(horizon) => {
                let problem = Problem { horizon, ..self.problem.clone() };
                match problem.shoot(&mut direct, midpoints(here)) {
                    Ok(relaxation) => Some(relaxation.ok_or(none)?),
                    Err(_) => None,
                }
            }
        };
        work.enclosures += 1;
        Ok(relaxation.map(|relaxation| {
            let rows = relaxation.origins.iter().enumerate().map(|(row, origin)| (*origin, row)).collect();
            Enclosed { relaxation, rows, direct }
        }))
    }
}

/// The supports among the origins, by record; `None` where one is not within its record.
fn supports(origins: &[Origin], records: &[Readings]) -> Option<Vec<Vec<Support>>> {
    let mut supports: Vec<BTreeSet<Support>> = vec![BTreeSet::new(); records.len()];
    for origin in origins {
        if let Origin::Modulated { record, samples: [l, m, r], .. } = *origin {
            (l < m && m < r && r < records.get(record)?.time_s.len()).then_some(())?;
            supports[record].insert([l, m, r]);
        }
    }
    Some(supports.into_iter().map(|own| own.into_iter().collect()).collect())
}

pub(super) fn within(inner: &[Interval], outer: &[Interval]) -> bool {
    inner.iter().zip(outer).all(|(inner, outer)| inner.is_subset_of(*outer))
}
