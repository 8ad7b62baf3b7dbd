//! Contraction of a box: by modulating functions while it is wide, then by multiple shooting, until neither helps.

#[cfg(test)]
mod tests;

use super::answer::Contradicting;
use super::linear_program::Multipliers;
use super::linear_relaxation::{Disjoint, Relaxation, Support, midpoints};
use super::modulating_functions::supports;
use super::problem::Problem;
use super::vector_field::FieldTerm;
use crate::numeric::Interval;

/// A contraction is repeated while it shrinks the width of some parameter below this share.
pub(super) const HELPED: f64 = 0.75;
/// A box is too wide for shooting while the range of a parameter changes the force by more than this share of the largest command.
const WIDE: f64 = 0.25;
/// The gain is divided first until its ends are within this factor: the remaining parameters scale with it.
const DECADE: f64 = 4.0;
/// Contractions of a box.
const MOST_CONTRACTIONS: usize = 30;

/// The kind of constraint by which a box was proved empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ConstraintKind {
    ModulatingFunctions,
    Shooting,
}

/// An empty box.
#[derive(Clone, Debug)]
pub(super) struct Empty {
    pub(super) method: ConstraintKind,
    pub(super) multipliers: Multipliers,
    /// The contradictory inequalities; `None` where two enclosures have no value in common.
    pub(super) relaxation: Option<Relaxation>,
}

impl Empty {
    fn disjoint(method: ConstraintKind) -> Self {
        Self { method, multipliers: Multipliers::new(), relaxation: None }
    }
}

/// A contracted box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Contracted {
    /// Too wide for shooting; the widest parameter.
    Wide(usize),
    /// The largest uncertainty of an inequality, in largest errors of a reading, and the parameter with the largest part in it.
    Followed { uncertainty: f64, widest: usize },
}

/// A problem with its modulating functions.
pub(super) struct Contractor {
    pub(super) problem: Problem,
    supports: Vec<Vec<Support>>,
    /// Readings that no monotone velocity satisfies, once found.
    pub(super) contradicting: Vec<Contradicting>,
}

impl Contractor {
    pub(super) fn new(problem: Problem) -> Self {
        let of = |readings: &super::record::Readings| supports(&readings.time_s, problem.half_period_s);
        Self { supports: problem.records.iter().map(of).collect(), problem, contradicting: Vec::new() }
    }

    /// Work so far, in passes.
    pub(super) fn passes(&self) -> usize {
        self.problem.work.passes()
    }

    fn parameters(&self) -> Vec<usize> {
        (0..self.problem.unknowns.parameters()).collect()
    }

    /// The weak form over a box, in which velocities are intersected with those from the readings. `None` where it holds no motion.
    pub(super) fn weak_form(&self, at: &mut [Interval]) -> Option<Relaxation> {
        let samples = self.problem.records.iter().map(|readings| readings.value.len()).sum();
        self.problem.work.weighted(samples);
        self.problem.modulate(&self.supports, at)
    }

    /// Contracts by modulating functions.
    pub(super) fn modulate(&mut self, at: &mut [Interval]) -> Result<(), Empty> {
        let weak_form = self.weak_form(at);
        if weak_form.is_none() && self.contradicting.is_empty() {
            self.contradicting = self.problem.contradiction(at);
        }
        let method = ConstraintKind::ModulatingFunctions;
        let relaxation = weak_form.ok_or(Empty::disjoint(method))?;
        let contracted = relaxation.contract(at, &self.parameters());
        contracted.map_err(|multipliers| Empty { method, multipliers, relaxation: Some(relaxation) })
    }

    /// Refines the states: velocities, and forces behind a lag, at the beginning of each shooting interval by the intervals beside it.
    pub(super) fn refine_states(&self, relaxation: &mut Relaxation, at: &mut [Interval]) -> Result<(), Empty> {
        for (interval, _) in self.problem.followed() {
            let (beside, own) = (relaxation.beside(interval), self.problem.unknowns.refined(interval));
            if let Err(multipliers) = beside.contract(at, &own) {
                return Err(Empty { method: ConstraintKind::Shooting, multipliers, relaxation: Some(beside) });
            }
            for place in own {
                relaxation.deviations[place] = at[place] - Interval::point(relaxation.centre[place]);
            }
        }
        Ok(())
    }

    /// The largest uncertainty of an inequality, in largest errors of a reading, and the parameter with the largest part in all.
    pub(super) fn uncertainty(&self, relaxation: &Relaxation) -> (f64, usize) {
        let mut by = vec![0.0; self.problem.unknowns.parameters()];
        let mut largest = 0.0f64;
        for row in 0..relaxation.origins.len() {
            let mut sum = 0.0;
            for (unknown, part) in relaxation.uncertainty(row) {
                sum += part;
                if let Some(by) = by.get_mut(unknown) {
                    *by += part;
                }
            }
            largest = largest.max(sum / self.problem.least_error());
        }
        let widest = (0..by.len()).max_by(|a, b| by[*a].total_cmp(&by[*b])).unwrap_or(0);
        (largest, widest)
    }

    /// The parameter whose range changes the force most, and the change over the largest command.
    pub(super) fn widest(&self, at: &[Interval]) -> (f64, usize) {
        let (problem, unknowns) = (&self.problem, &self.problem.unknowns);
        if at[0].upper() > DECADE * at[0].lower() {
            return (f64::INFINITY, 0);
        }
        let (force, speed) = (problem.largest_command(), problem.typical_speed);
        let acceleration = at[0].upper() * force;
        let share = |place: usize| -> f64 {
            let width = at[place].width();
            let Some(term) = unknowns.terms.get(place) else {
                let delay = unknowns.delay() == Some(place);
                return if delay { 8.0 * width / problem.half_period_s } else { width / acceleration };
            };
            let unit = match term {
                FieldTerm::Gain => force,
                FieldTerm::Linear => speed,
                FieldTerm::Quadratic if unknowns.place_of(FieldTerm::Linear).is_some() => 0.5 * speed * speed,
                FieldTerm::Quadratic => speed * speed,
                FieldTerm::Cubic => speed * speed * speed,
                FieldTerm::Stiffness => problem.amplitude,
                FieldTerm::LagRate => return width / at[place].upper() / (at[place].lower() * problem.half_period_s),
                FieldTerm::Disturbance => 1.0,
            };
            width * unit / acceleration
        };
        // Instants are not divided.
        let disturbances = (0..unknowns.records()).map(|record| unknowns.disturbance(record));
        let places = (0..unknowns.common()).chain(disturbances);
        places.map(|place| (share(place), place)).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, 0))
    }

    /// The widest parameter of a box that is too wide for shooting.
    pub(super) fn too_wide(&self, at: &[Interval]) -> Option<usize> {
        let (share, widest) = self.widest(at);
        (share > WIDE).then_some(widest)
    }

    /// The least share of a parameter's width after a contraction.
    pub(super) fn share_left(&self, before: &[Interval], after: &[Interval]) -> f64 {
        let widths = before.iter().zip(after).take(self.problem.unknowns.parameters());
        widths.map(|(b, a)| if b.width() > 0.0 { a.width() / b.width() } else { 1.0 }).fold(1.0, f64::min)
    }

    /// Contracts a box until nothing helps; not `modulating`, by shooting alone.
    pub(super) fn contract(&mut self, at: &mut [Interval], mut modulating: bool) -> Result<Contracted, Empty> {
        let mut contracted = Contracted::Wide(0);
        for _ in 0..MOST_CONTRACTIONS {
            let before = at.to_vec();
            if modulating {
                self.modulate(at)?;
                modulating = self.share_left(&before, at) < HELPED;
                if modulating {
                    continue;
                }
            }
            if let Some(widest) = self.too_wide(at) {
                return Ok(Contracted::Wide(widest));
            }
            let before = at.to_vec();
            let shot = self.problem.shoot(at, midpoints(at));
            let shot = shot.map_err(|Disjoint| Empty::disjoint(ConstraintKind::Shooting))?;
            let Some(mut relaxation) = shot else { return Ok(Contracted::Wide(self.widest(at).1)) };
            let (uncertainty, widest) = self.uncertainty(&relaxation);
            contracted = Contracted::Followed { uncertainty, widest };
            self.refine_states(&mut relaxation, at)?;
            if let Err(multipliers) = relaxation.contract(at, &self.parameters()) {
                return Err(Empty { method: ConstraintKind::Shooting, multipliers, relaxation: Some(relaxation) });
            }
            if self.share_left(&before, at) > HELPED {
                break;
            }
        }
        Ok(contracted)
    }
}
