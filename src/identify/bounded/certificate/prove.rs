//! The proof, once the remainder is found: branch and prune again, towards a box with some room around it.

use super::super::branch_and_prune::{KEPT, halves};
use super::super::contraction::{Contractor, HELPED};
use super::super::linear_relaxation::midpoints;
use super::super::problem::Problem;
use super::super::settings::BoundedModel;
use super::super::solve::Solved;
use super::format::{By, Certificate, Cut, ProofStage, Step, Witness, ends, sides};
use super::multipliers::{self, Contraction, ExclusionMargin, seek};
use super::unproved::Unproved;
use crate::experiment::Record;
use crate::identify::IdentifyError;
use crate::numeric::{Interval, Real};

/// The remainder is stated wider by this share of its width on either side: fewer boxes, and room for another program.
const ROOM: f64 = 0.5;
/// Steps of a stage.
const MOST_STEPS: usize = 4000;
/// A contradiction by shooting counts where it exceeds this share of the ranges of the coefficients; the second checker's are wider.
const OF_UNCERTAINTY: f64 = 0.25;
/// A box at most this factor wider than the remainder is divided where it extends beyond.
const NEAR: f64 = 4.0;

impl Certificate {
    /// The proof of a solved problem; two stages where a narrower delay admits more readings.
    ///
    /// # Errors
    /// [`Unproved::NotFound`] where a stage takes too many steps.
    pub(in super::super) fn prove(
        records: &[&Record],
        problem: &Problem,
        settings: &BoundedModel,
        solved: &Solved,
    ) -> Result<Result<Self, Unproved>, IdentifyError> {
        let witness = solved.feasible.as_ref().map(|(point, own)| Witness::of(own, &point.at));
        let mut certificate = Self::of(records, problem, settings, witness);
        let slack = solved.feasible.as_ref().map_or(1.0, |(point, _)| 1.0 - point.misfit);
        let mut setting = problem.clone();
        for hull in &solved.hulls {
            match CertificateProver::new(&setting, hull.as_deref(), slack).stage() {
                Ok(stage) => certificate.stages.push(stage),
                Err(error) => return Ok(Err(error)),
            }
            let left = certificate.stages.last().and_then(|stage| sides(stage.left.as_ref()?));
            let Some(left) = left else { break };
            setting = problem.narrowed(settings, &left)?;
        }
        certificate.statement = certificate.words(records);
        Ok(certificate.check().map(|_| certificate))
    }
}

/// A box at hand.
#[derive(Clone)]
struct Pending {
    at: Vec<Interval>,
    /// Modulating functions help no more.
    modulated: bool,
    /// The number of its horizon.
    level: usize,
}

/// The result of a step.
enum Next {
    Empty,
    Smaller,
    /// To be divided at this unknown.
    Stuck(usize),
}

struct CertificateProver {
    /// By horizon.
    contractors: Vec<Contractor>,
    horizons: Vec<usize>,
    left: Option<Vec<Interval>>,
    /// `1 - misfit` of the feasible point.
    slack: f64,
    steps: Vec<Step>,
}

impl CertificateProver {
    fn new(problem: &Problem, hull: Option<&[Interval]>, slack: f64) -> Self {
        let wider = |(side, from): (&Interval, &Interval)| {
            let room = ROOM * side.width() + f64::EPSILON * side.magnitude();
            side.inflate(room).intersection(*from).unwrap_or(*side)
        };
        let parameters = problem.unknowns.parameters();
        let left = hull.map(|hull| hull.iter().zip(&problem.search).take(parameters).map(wider).collect());
        let horizons = problem.horizons();
        let contractors = horizons.iter().map(|horizon| Contractor::new(problem.until(*horizon))).collect();
        Self { contractors, horizons, left, slack, steps: Vec::new() }
    }

    fn problem(&self) -> &Problem {
        &self.contractors[0].problem
    }

    fn stage(mut self) -> Result<ProofStage, Unproved> {
        let mut open = vec![Pending { at: self.problem().search.clone(), modulated: false, level: 0 }];
        while let Some(mut here) = open.pop() {
            loop {
                if self.is_left(&here.at) {
                    self.steps.push(Step::Keep);
                    break;
                }
                if self.steps.len() > MOST_STEPS {
                    return Err(Unproved::NotFound { steps: self.steps.len() });
                }
                match self.step(&mut here) {
                    Next::Empty => break,
                    Next::Smaller => {}
                    Next::Stuck(widest) => {
                        let (unknown, [low, high]) = self.divide(&here.at, widest)?;
                        self.steps.push(Step::Divide { unknown, at: low.upper() });
                        let mut upper = here.clone();
                        (here.at[unknown], upper.at[unknown]) = (low, high);
                        open.push(upper);
                    }
                }
            }
        }
        let shooting = &self.problem().unknowns.shooting;
        let shooting = shooting.iter().map(|own| [own.record, own.first, own.last]).collect();
        Ok(ProofStage { shooting, left: self.left.as_deref().map(ends), steps: self.steps })
    }

    fn is_left(&self, at: &[Interval]) -> bool {
        let left = self.left.as_ref();
        left.is_some_and(|left| at.iter().zip(left).all(|(side, left)| side.is_subset_of(*left)))
    }

    fn target(&self) -> &[Interval] {
        self.left.as_deref().unwrap_or(&[])
    }

    fn step(&mut self, here: &mut Pending) -> Next {
        if !here.modulated
            && let Some(next) = self.modulate(here)
        {
            return next;
        }
        if let Some(widest) = self.contractors[0].too_wide(&here.at) {
            // Modulating functions may help over its parts.
            here.modulated = false;
            return Next::Stuck(widest);
        }
        self.shoot(here)
    }

    /// By modulating functions over the first horizon, and once the box is narrow enough the velocities from the readings; `None` where
    /// they help no more.
    fn modulate(&mut self, here: &mut Pending) -> Option<Next> {
        let by = By::ModulatingFunctions(self.horizons[0]);
        let contractor = &self.contractors[0];
        let (problem, parameters) = (&contractor.problem, contractor.problem.unknowns.parameters());
        let mut known = here.at.clone();
        let Some(weak_form) = contractor.weak_form(&mut known) else {
            self.steps.push(Step::Exclude { by, rows: Vec::new() });
            return Some(Next::Empty);
        };
        let unknowns: Vec<usize> = (0..parameters).collect();
        let mut found = seek(
            problem,
            &weak_form,
            &here.at,
            &unknowns,
            self.target(),
            ExclusionMargin { slack: self.slack, of_uncertainty: 0.0 },
        );
        if let Contraction::Cuts(cuts) = &mut found {
            let mut at = here.at.clone();
            if cuts.iter().all(|cut| cut.shorten(&mut at)) {
                let wide = contractor.too_wide(&at).is_some();
                here.modulated = !wide || contractor.share_left(&here.at, &at) > HELPED;
                for unknown in (parameters..at.len()).filter(|_| !wide) {
                    let known = known[unknown].inflate(multipliers::ROOM * known[unknown].width());
                    if !at[unknown].is_subset_of(known) {
                        let cut = |upper, end| Cut { unknown, upper, end, rows: Vec::new() };
                        cuts.extend([cut(true, known.upper()), cut(false, known.lower())]);
                    }
                }
            }
        }
        if self.take(by, found, here) {
            return Some(Next::Empty);
        }
        (!here.modulated).then_some(Next::Smaller)
    }

    /// By shooting over the box's horizon: states first, then parameters.
    fn shoot(&mut self, here: &mut Pending) -> Next {
        let by = By::Shooting(self.horizons[here.level]);
        let contractor = &self.contractors[here.level];
        let (problem, unknowns) = (&contractor.problem, &contractor.problem.unknowns);
        let mut relaxation = match problem.shoot(&mut here.at.clone(), midpoints(&here.at)) {
            Err(_) => {
                self.steps.push(Step::Exclude { by, rows: Vec::new() });
                return Next::Empty;
            }
            Ok(None) => return Next::Stuck(contractor.widest(&here.at).1),
            Ok(Some(relaxation)) => relaxation,
        };
        let (before, (uncertainty, widest)) = (here.at.clone(), contractor.uncertainty(&relaxation));
        let states = problem.followed().map(|(interval, _)| (Some(interval), unknowns.refined(interval)));
        let parameters = (None, (0..unknowns.parameters()).collect());
        let margin = ExclusionMargin { slack: self.slack, of_uncertainty: OF_UNCERTAINTY };
        let (mut at, mut all) = (here.at.clone(), Vec::new());
        'groups: for (interval, own) in states.chain([parameters]) {
            let beside = interval.map_or_else(|| relaxation.clone(), |interval| relaxation.beside(interval));
            let known = beside.sides();
            let found = seek(problem, &beside, &known, &own, self.target(), margin);
            if let (Contraction::Contradiction(rows, _), true) = (&found, all.is_empty()) {
                self.steps.push(Step::Exclude { by, rows: rows.clone() });
                return Next::Empty;
            }
            for cut in found.into_cuts(&known) {
                let empty = !cut.shorten(&mut at);
                let side = at[cut.unknown] - Interval::point(relaxation.centre[cut.unknown]);
                let deviation = &mut relaxation.deviations[cut.unknown];
                *deviation = deviation.intersection(side).unwrap_or(side);
                all.push(cut);
                if empty {
                    break 'groups;
                }
            }
        }
        if self.take(by, Contraction::Cuts(all), here) {
            return Next::Empty;
        }
        let helped = self.contractors[here.level].share_left(&before, &here.at) < HELPED;
        if helped {
            return Next::Smaller;
        }
        if uncertainty < KEPT && here.level + 1 < self.horizons.len() {
            here.level += 1;
            return Next::Smaller;
        }
        Next::Stuck(widest)
    }

    /// Notes the result of a contraction, and applies it to the box; whether it is empty.
    fn take(&mut self, by: By, found: Contraction, here: &mut Pending) -> bool {
        match found {
            Contraction::Contradiction(rows, _) => {
                self.steps.push(Step::Exclude { by, rows });
                true
            }
            Contraction::Cuts(cuts) if cuts.is_empty() => false,
            Contraction::Cuts(cuts) => {
                let empty = cuts.iter().any(|cut| !cut.shorten(&mut here.at));
                self.steps.push(Step::Contract { by, cuts });
                empty
            }
        }
    }

    /// The unknown and its halves: where a box near the remainder extends furthest beyond it, else the widest, or the
    /// next that can be divided.
    fn divide(&self, at: &[Interval], widest: usize) -> Result<(usize, [Interval; 2]), Unproved> {
        if let Some((unknown, value)) = self.furthest_beyond(at)
            && let Some(parts) = halves(at[unknown], value)
        {
            return Ok((unknown, parts));
        }
        let relative = |place: &usize| at[*place].width() / self.problem().search[*place].width();
        let mut others: Vec<usize> = (0..self.problem().unknowns.parameters()).collect();
        others.sort_by(|a, b| relative(b).total_cmp(&relative(a)));
        let parts = |place: usize| {
            let [low, high] = self.contractors[0].bisect(at, place)?;
            Some((place, [low[place], high[place]]))
        };
        let found = core::iter::once(widest).chain(others).find_map(parts);
        found.ok_or(Unproved::NotFound { steps: self.steps.len() })
    }

    fn furthest_beyond(&self, at: &[Interval]) -> Option<(usize, f64)> {
        let left = self.left.as_ref()?;
        let near = |(side, left): (&Interval, &Interval)| {
            side.width() <= NEAR * left.width() && side.intersection(*left).is_some()
        };
        if !at.iter().zip(left).all(near) {
            return None;
        }
        let sides = at.iter().zip(left).enumerate().flat_map(|(unknown, (side, left))| {
            let ends = [(side.upper() - left.upper(), left.upper()), (left.lower() - side.lower(), left.lower())];
            ends.map(|(beyond, value)| (beyond / left.width().max(f64::MIN_POSITIVE), unknown, value))
        });
        let furthest = sides.filter(|(beyond, ..)| *beyond > 0.0).max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((furthest.1, furthest.2))
    }
}
