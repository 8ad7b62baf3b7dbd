//! The check of a certificate: its problem, its words, its stages and its witness. No search, no linear programme.

use super::super::answer::Quantity;
use super::super::linear_relaxation::points;
use super::super::problem::{Problem, ROUNDING};
use super::super::vector_field::FieldTerm;
use super::format::{Certificate, ProofStage, Witness};
use super::unproved::{Unproved, malformed};
use super::walk::{Checked, Walk, within};
use crate::experiment::Record;
use crate::numeric::Interval;

/// The result of an accepted certificate, and its work.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// In words.
    pub statement: String,
    /// Its assumptions, in words.
    pub ranges: Vec<String>,
    /// Where parameters were searched: the terms and the delay.
    pub searched: Vec<(String, [f64; 2])>,
    /// The remainder of them; nothing where refuted.
    pub left: Vec<(String, [f64; 2])>,
    /// Speeds were searched up to this, in units of the readings per s.
    pub fastest: f64,
    /// Boxes excluded.
    pub excluded: usize,
    /// Enclosures of the motion.
    pub enclosures: usize,
    /// Readings.
    pub readings: usize,
}

impl Certificate {
    /// The certificate's result on its records.
    ///
    /// # Errors
    /// The first [`Unproved`].
    pub fn check(&self) -> Result<Shown, Unproved> {
        let (records, problem) = self.problem()?;
        let expected = self.words(&records.iter().collect::<Vec<_>>());
        if expected != self.statement {
            return Err(Unproved::Statement { expected });
        }
        let walks =
            (0..self.stages.len()).map(|index| Walk::of(&problem, self.begin(index)?, &self.stages[index], index));
        let walks = walks.collect::<Result<Vec<_>, Unproved>>()?;
        let last = self.stages.last().ok_or_else(|| malformed("no stage"))?;
        if let Some(witness) = &self.witness {
            check_witness(&problem, witness)?;
        }
        let mut work = Checked::default();
        walks.iter().try_for_each(|walk| walk.go(&mut work))?;
        Ok(Shown {
            statement: expected,
            ranges: self.ranges(&problem),
            searched: self.named(&problem, &self.searched.from),
            left: last.left.as_ref().map_or_else(Vec::new, |left| self.named(&problem, left)),
            fastest: self.searched.fastest,
            excluded: work.excluded,
            enclosures: work.enclosures,
            readings: records.iter().map(Record::samples).sum(),
        })
    }

    /// The box with which a stage begins.
    fn begin(&self, index: usize) -> Result<&[[f64; 2]], Unproved> {
        let Some(before) = index.checked_sub(1) else { return Ok(&self.searched.from) };
        let left = self.stages[before].left.as_deref();
        left.ok_or_else(|| malformed(&format!("stage {index} begins where nothing is left")))
    }

    /// Ranges of terms, of the delay and of each record's disturbance, by name.
    fn named(&self, problem: &Problem, ranges: &[[f64; 2]]) -> Vec<(String, [f64; 2])> {
        let unknowns = &problem.unknowns;
        let delay = unknowns.delay().map_or([problem.known_delay_s.midpoint(); 2], |place| ranges[place]);
        let of_terms = self.searched.terms.iter().zip(ranges).map(|(term, range)| {
            let at = if *term == FieldTerm::Linear { ", at the middle speed" } else { "" };
            (format!("{}{at}", term.quantity()), *range)
        });
        let disturbance = |record| (Quantity::DeltaRate(record).to_string(), ranges[unknowns.disturbance(record)]);
        let disturbances = (0..self.records.len()).map(disturbance);
        of_terms.chain([(Quantity::DelayS.to_string(), delay)]).chain(disturbances).collect()
    }
}

/// The witness as if it were the whole remainder, with a single shooting interval for each record.
fn check_witness(problem: &Problem, witness: &Witness) -> Result<(), Unproved> {
    let outside = || malformed("the witness is not in the search box");
    let (at, unknowns) = (&witness.values, &problem.unknowns);
    let own_delay = unknowns.delay().map(|place| at.get(place).copied().unwrap_or(f64::NAN));
    let known_delay_s = own_delay.map_or(problem.known_delay_s, Interval::point);
    let records = problem.records.iter().zip(&witness.first).enumerate();
    let shooting = records.map(|(record, (own, first))| [record, *first, own.time_s.len() - 1]).collect();
    let stage = ProofStage { shooting, left: None, steps: Vec::new() };
    let own = stage.unknowns(problem, known_delay_s).ok_or_else(|| malformed("the witness"))?;
    for (record, first) in witness.first.iter().enumerate() {
        let most = unknowns.shooting[unknowns.first(record)].first;
        if *first > most {
            return Err(Unproved::Late { record: record + 1, first: first + 1, most: most + 1 });
        }
    }
    let count = own.start(problem.records.len(), 0);
    if at.len() != count || !at.iter().all(|value| value.is_finite()) {
        return Err(outside());
    }
    if !within(&points(&at[..own.parameters()]), &problem.search) {
        return Err(outside());
    }
    let own = Problem { unknowns: own, known_delay_s, ..problem.clone() };
    let mut prior = own.about(&[], at.clone());
    own.add_prior(&mut prior);
    let rows = prior.inequalities.coefficients.iter().zip(&prior.inequalities.limits);
    let size = |row: &[(usize, Interval)]| {
        row.iter().map(|(place, own)| (*own * Interval::point(at[*place])).magnitude()).sum::<f64>()
    };
    if rows.into_iter().any(|(row, limit)| *limit < -ROUNDING * size(row)) {
        return Err(outside());
    }
    let misfit = own.misfit(at).unwrap_or(f64::INFINITY);
    if misfit <= 1.0 { Ok(()) } else { Err(Unproved::Witness { misfit }) }
}
