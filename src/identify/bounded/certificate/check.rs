//! The check: what a certificate says of its records, stage by stage. No search, no linear programme.

use super::super::contract::Model;
use super::super::effort::Effort;
use super::super::problem::{Layout, Window};
use super::super::setup::Setup;
use super::walk::{Walk, Work};
use super::{Certificate, Stage, Witness, roughly};
use crate::experiment::Record;
use crate::numeric::Interval;

/// Why a certificate is not accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unproved {
    /// It is no certificate.
    #[error(
        "not a certificate of guaranteed bounds: {text}; write one with `selfosc identify LOG --method bounded --certificate FILE`"
    )]
    Foreign {
        /// What is wrong.
        text: String,
    },
    /// One of another program.
    #[error("format {found}, where this program reads format {expected}; write it anew with `identify --certificate`")]
    Format {
        /// Its own.
        found: u32,
        /// This program's.
        expected: u32,
    },
    /// Its parts do not make up a problem and a proof.
    #[error("{text}")]
    Malformed {
        /// What is wrong.
        text: String,
    },
    /// A range is not the one that the records and the model lead to.
    #[error("the {what} is not the one that the file's records and its model lead to")]
    Ranges {
        /// Of what.
        what: &'static str,
    },
    /// Other logs.
    #[error("{found} logs, where the file has {expected}; give the logs in the order in which they were identified")]
    Logs {
        /// Logs given.
        found: usize,
        /// Records in the file.
        expected: usize,
    },
    /// A row is not the log's.
    #[error("row {row} of log {log}: the {what} is {found} in the log and {expected} in the file")]
    Row {
        /// Number of the log, from one.
        log: usize,
        /// Number of the row among those used, from one.
        row: usize,
        /// Stamp, reading or command.
        what: &'static str,
        /// In the log, or that it has no such row.
        found: String,
        /// In the file.
        expected: String,
    },
    /// The witness leaves out readings.
    #[error("the witness begins at row {first} of record {record}, and has to meet every reading from row {most} on")]
    Late {
        /// Number of the record, from one.
        record: usize,
        /// Its first row, from one.
        first: usize,
        /// The last with which it may begin.
        most: usize,
    },
    /// What a step says does not follow.
    #[error("step {step} of stage {stage}: {what}")]
    Step {
        /// Number of the stage.
        stage: usize,
        /// Number of the step.
        step: usize,
        /// What does not follow.
        what: &'static str,
    },
    /// Boxes are left that no step deals with, or steps without a box.
    #[error("the steps of stage {stage} do not deal with the whole box")]
    Incomplete {
        /// Its number.
        stage: usize,
    },
    /// The witness does not meet a reading.
    #[error("the witness misses a reading by {misfit:.4} times its largest error")]
    Witness {
        /// The largest misfit over its largest error, at most.
        misfit: f64,
    },
    /// What is said is not what the steps show.
    #[error("the statement is not what the steps show: {expected}")]
    Statement {
        /// What they show.
        expected: String,
    },
    /// Readings may be in error by any amount, which no certificate says.
    #[error("no proof is written where {allowed} readings may be in error by any amount; leave them out of the log")]
    Outliers {
        /// So many.
        allowed: usize,
    },
    /// None was found within the budget.
    #[error("no proof was found within {steps} steps; the bounds printed do not depend on one")]
    NotFound {
        /// At most.
        steps: usize,
    },
}

impl Unproved {
    /// Short name for scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Foreign { .. } => "foreign",
            Self::Format { .. } => "format",
            Self::Malformed { .. } => "malformed",
            Self::Ranges { .. } => "ranges",
            Self::Logs { .. } | Self::Row { .. } => "log",
            Self::Late { .. } => "late",
            Self::Step { .. } => "step",
            Self::Incomplete { .. } => "incomplete",
            Self::Witness { .. } => "witness",
            Self::Statement { .. } => "statement",
            Self::Outliers { .. } => "outliers",
            Self::NotFound { .. } => "not-found",
        }
    }
}

/// What an accepted certificate shows, and by how much work.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// In words.
    pub statement: String,
    /// What it depends on, in words.
    pub ranges: Vec<String>,
    /// Where parameters were searched: the terms and the delay.
    pub searched: Vec<(&'static str, [f64; 2])>,
    /// What is left of them; nothing where refuted.
    pub left: Vec<(&'static str, [f64; 2])>,
    /// Speeds were searched up to this, in units of the readings per s.
    pub fastest: f64,
    /// Boxes excluded.
    pub excluded: usize,
    /// Enclosures of the motion.
    pub enclosures: usize,
    /// Readings.
    pub readings: usize,
}

pub(super) fn malformed(text: &str) -> Unproved {
    Unproved::Malformed { text: text.to_owned() }
}

pub(super) fn sides(ends: &[[f64; 2]]) -> Option<Vec<Interval>> {
    ends.iter().map(|[low, high]| Interval::new(*low, *high).filter(|side| side.is_bounded())).collect()
}

pub(super) fn within(inner: &[Interval], outer: &[Interval]) -> bool {
    inner.iter().zip(outer).all(|(inner, outer)| inner.is_subset_of(*outer))
}

impl Certificate {
    /// What it shows of its records.
    ///
    /// # Errors
    /// The first [`Unproved`].
    pub fn check(&self) -> Result<Shown, Unproved> {
        let (records, setup) = self.problem()?;
        let expected = self.words(&records.iter().collect::<Vec<_>>());
        if expected != self.statement {
            return Err(Unproved::Statement { expected });
        }
        let walks =
            (0..self.stages.len()).map(|index| Walk::of(&setup, self.begin(index)?, &self.stages[index], index));
        let walks = walks.collect::<Result<Vec<_>, Unproved>>()?;
        let last = self.stages.last().ok_or_else(|| malformed("no stage"))?;
        if let Some(witness) = &self.witness {
            self.check_witness(&setup, witness)?;
        }
        let mut work = Work::default();
        walks.iter().try_for_each(|walk| walk.go(&mut work))?;
        Ok(Shown {
            statement: expected,
            ranges: self.ranges(&setup),
            searched: self.named(&setup, &self.searched.from),
            left: last.left.as_ref().map_or_else(Vec::new, |left| self.named(&setup, left)),
            fastest: self.searched.fastest,
            excluded: work.excluded,
            enclosures: work.enclosures,
            readings: records.iter().map(Record::samples).sum(),
        })
    }

    /// Where a stage begins.
    fn begin(&self, index: usize) -> Result<&[[f64; 2]], Unproved> {
        let Some(before) = index.checked_sub(1) else { return Ok(&self.searched.from) };
        let left = self.stages[before].left.as_deref();
        left.ok_or_else(|| malformed(&format!("stage {index} begins where nothing is left")))
    }

    /// The same of one stage by itself.
    pub(super) fn accepts(&self, wide: &Setup, stage: &Stage) -> Result<(), Unproved> {
        let from = match self.stages.last() {
            Some(before) => before.left.as_deref().ok_or_else(|| malformed("a stage too many"))?,
            None => &self.searched.from,
        };
        Walk::of(wide, from, stage, self.stages.len())?.go(&mut Work::default())
    }

    /// Ranges of terms, of the delay and of each record's disturbance, by name.
    fn named(&self, setup: &Setup, ranges: &[[f64; 2]]) -> Vec<(&'static str, [f64; 2])> {
        let terms = &self.searched.terms;
        let delay =
            if setup.layout.delay().is_some() { ranges[terms.len()] } else { [setup.known_delay_s.midpoint(); 2] };
        let of_terms = terms.iter().map(|term| term.name()).zip(ranges.iter().copied());
        let disturbances = (0..self.records.len()).map(|record| ranges[setup.layout.disturbance(record)]);
        of_terms.chain([("delay_s", delay)]).chain(disturbances.map(|range| ("delta/alpha", range))).collect()
    }

    fn check_witness(&self, setup: &Setup, witness: &Witness) -> Result<(), Unproved> {
        let own = setup.layout.delay().map(|place| witness.values.get(place).copied().unwrap_or(f64::NAN));
        let delay_s = own.map_or(setup.known_delay_s, Interval::point);
        // As if it were all that is left, with one window for each record.
        let records = setup.records.iter().zip(&witness.first).enumerate();
        let windows = records.map(|(record, (own, first))| [record, *first, own.time_s.len() - 1]).collect();
        let stage = Stage { windows, left: None, steps: Vec::new() };
        let layout = stage.layout(setup, delay_s).ok_or_else(|| malformed("the witness"))?;
        for (record, first) in witness.first.iter().enumerate() {
            let most = setup.layout.windows().iter().find(|window| window.record == record).map_or(0, |own| own.first);
            if *first > most {
                return Err(Unproved::Late { record: record + 1, first: first + 1, most: most + 1 });
            }
        }
        let model = Model { per_s: Some(1.0 / setup.swing_s), known_delay_s: delay_s, ..model(setup, &layout) };
        let at = &witness.values;
        let inside = at.iter().zip(&setup.search).take(layout.parameters()).all(|(value, side)| side.contains(*value));
        if at.len() != layout.start(setup.records.len(), 0) || !inside || !at.iter().all(|value| value.is_finite()) {
            return Err(malformed("the witness is not in the search box"));
        }
        // What the search box says beside its sides, to within a rounding of the terms.
        let mut beside = model.about(&[], at.clone());
        model.bound(&mut beside);
        let rounding = |slopes: &[(usize, Interval)]| {
            slopes.iter().map(|(place, slope)| (*slope * Interval::point(at[*place])).magnitude()).sum::<f64>()
        };
        let rows = beside.rows.slopes.iter().zip(&beside.rows.limits);
        if rows.into_iter().any(|(slopes, limit)| *limit < -1e-12 * rounding(slopes)) {
            return Err(malformed("the witness is not in the search box"));
        }
        let misfits = model.whole().into_iter().map(|span| model.misfit(span, at).unwrap_or(f64::INFINITY));
        let misfit = misfits.fold(0.0, f64::max);
        if misfit <= 1.0 { Ok(()) } else { Err(Unproved::Witness { misfit }) }
    }
}

impl Stage {
    /// Each record's windows follow one another, the first from where every command that acts is in the log; `None` where they do not.
    pub(super) fn layout(&self, setup: &Setup, delay_s: Interval) -> Option<Layout> {
        let windows: Vec<Window> =
            self.windows.iter().map(|&[record, first, last]| Window { record, first, last }).collect();
        let mut before: Option<Window> = None;
        for window in &windows {
            let own = setup.records.get(window.record)?;
            let follows = match before {
                Some(before) if before.record == window.record => before.last == window.first,
                Some(before) => window.record == before.record + 1,
                None => window.record == 0,
            };
            let acts = own.acted_s(delay_s) <= *own.time_s.get(window.first)?;
            if !(follows && acts && window.first < window.last && window.last < own.time_s.len()) {
                return None;
            }
            before = Some(*window);
        }
        (before?.record + 1 == setup.records.len()).then(|| setup.layout.clone().with_windows(windows))
    }
}

/// The problem over a stage's windows.
pub(super) fn model<'a>(setup: &'a Setup, layout: &'a Layout) -> Model<'a> {
    Model {
        records: &setup.records,
        layout,
        middle_speed: setup.middle_speed,
        known_delay_s: setup.known_delay_s,
        least_linear: setup.least_linear,
        fastest: setup.fastest,
        per_s: roughly(setup.swing_s),
        effort: Effort::default(),
        reach: usize::MAX,
        heard: None,
    }
}
