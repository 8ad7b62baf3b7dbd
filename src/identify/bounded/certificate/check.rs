//! The check: what a certificate says of its records, stage by stage. No search, no linear programme.

use super::super::command::Command;
use super::super::contract::Model;
use super::super::effort::Effort;
use super::super::field::Term;
use super::super::problem::{Layout, Readings, Window, swing_s};
use super::walk::{Walk, Work};
use super::{Certificate, FORMAT, Stage, Witness, roughly};
use crate::numeric::Interval;

/// Why a certificate is not accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unproved {
    /// It is no certificate, or one of another format.
    #[error("not a certificate of guaranteed bounds: {text}")]
    Malformed {
        /// What is wrong.
        text: String,
    },
    /// A stage begins elsewhere than the one before ended, or has another delay.
    #[error("stage {stage} does not begin where the one before it ended, or has another delay")]
    Stage {
        /// Its number.
        stage: usize,
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
            Self::Malformed { .. } => "malformed",
            Self::Stage { .. } => "stage",
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
        if self.format != FORMAT {
            return Err(malformed("another format"));
        }
        let readings = self.readings()?;
        let mut work = Work::default();
        for (index, stage) in self.stages.iter().enumerate() {
            let before = index.checked_sub(1).map(|before| &self.stages[before]);
            if before.is_some_and(|before| before.left.as_ref() != Some(&stage.from) || before.delay_s != stage.delay_s)
            {
                return Err(Unproved::Stage { stage: index });
            }
            Walk::of(self, &readings, stage, index)?.go(&mut work)?;
        }
        let (Some(first), Some(last)) = (self.stages.first(), self.stages.last()) else {
            return Err(malformed("no stage"));
        };
        if let Some(witness) = &self.witness {
            self.check_witness(&readings, witness)?;
        }
        let expected = self.words();
        if expected != self.statement {
            return Err(Unproved::Statement { expected });
        }
        let readings = readings.iter().map(|readings| readings.value.len()).sum();
        Ok(Shown {
            statement: expected,
            searched: self.named(first, &first.from),
            left: last.left.as_ref().map_or_else(Vec::new, |left| self.named(last, left)),
            fastest: self.fastest,
            excluded: work.excluded,
            enclosures: work.enclosures,
            readings,
        })
    }

    /// The same of one stage by itself.
    pub(super) fn accepts(&self, stage: &Stage) -> Result<(), Unproved> {
        let readings = self.readings()?;
        Walk::of(self, &readings, stage, self.stages.len())?.go(&mut Work::default())
    }

    /// Ranges of a stage's terms and of its delay, by name.
    fn named(&self, stage: &Stage, ranges: &[[f64; 2]]) -> Vec<(&'static str, [f64; 2])> {
        let names = self.terms.iter().map(|term| term.name()).chain(["delay_s"]);
        let known = stage.delay_s.map(|delay_s| [delay_s; 2]);
        names
            .zip(ranges.iter().take(self.terms.len()).copied().chain(known.or(ranges.get(self.terms.len()).copied())))
            .collect()
    }

    /// What steps of this shape show.
    pub(super) fn words(&self) -> String {
        let left = self.stages.last().and_then(|stage| stage.left.as_ref());
        match (left, &self.witness) {
            (None, _) => "refuted: no parameter in the search box meets every reading",
            (Some(_), None) => "every parameter in the search box that meets every reading lies within the bounds",
            (Some(_), Some(_)) => {
                "consistent: every parameter in the search box that meets every reading lies within the bounds, and the witness \
                 meets every reading from its own first on"
            }
        }
        .to_owned()
    }

    fn readings(&self) -> Result<Vec<Readings>, Unproved> {
        let ordered = self.terms.windows(2).all(|pair| pair[0] < pair[1]);
        let finite = [self.middle_speed, self.least_linear, self.fastest].iter().all(|value| value.is_finite());
        if self.terms.first() != Some(&Term::Gain)
            || !ordered
            || self.terms.contains(&Term::Disturbance)
            || self.records.is_empty()
            || !finite
            // Its share of the quadratic drag is in the linear one's coefficient.
            || self.middle_speed != 0.0 && ![Term::Linear, Term::Quadratic].iter().all(|term| self.terms.contains(term))
        {
            return Err(malformed("the equation or its records"));
        }
        let each = self.records.iter().map(|sensed| {
            let increasing = |times: &[f64]| times.windows(2).all(|pair| pair[0] < pair[1]);
            let all = sensed
                .time_s
                .iter()
                .chain(&sensed.reading)
                .chain(&sensed.levels)
                .chain(sensed.switched_s.iter().flatten());
            let sound = sensed.time_s.len() == sensed.reading.len()
                && increasing(&sensed.time_s)
                && all.copied().all(f64::is_finite)
                && (sensed.error > 0.0
                    && sensed.error.is_finite()
                    && sensed.jitter_s >= 0.0
                    && sensed.jitter_s.is_finite())
                && sensed.levels.len() == sensed.switched_s.len() + 1
                && sensed.switched_s.iter().all(|[first, last]| first <= last)
                && sensed.switched_s.windows(2).all(|pair| pair[0][1] <= pair[1][0]);
            sound.then(|| Readings {
                time_s: sensed.time_s.clone(),
                value: sensed.reading.clone(),
                error: sensed.error,
                jitter_s: sensed.jitter_s,
                command: Command::new(sensed.levels.clone(), sensed.switched_s.iter().map(|[a, b]| (*a, *b)).collect()),
            })
        });
        each.collect::<Option<_>>().ok_or_else(|| malformed("a record"))
    }

    pub(super) fn layout(&self, readings: &[Readings], stage: &Stage) -> Option<Layout> {
        let windows: Vec<Window> =
            stage.windows.iter().map(|&[record, first, last]| Window { record, first, last }).collect();
        // Each record's follow one another, the first from where every command that acts is in the log.
        let delayed = stage.delay_s.is_none();
        let longest = if delayed { stage.from.get(self.terms.len())?[1] } else { stage.delay_s? };
        let mut before: Option<Window> = None;
        for window in &windows {
            let own = readings.get(window.record)?;
            let follows = match before {
                Some(before) if before.record == window.record => before.last == window.first,
                Some(before) => window.record == before.record + 1,
                None => window.record == 0,
            };
            let start = *own.time_s.get(window.first)?;
            let acts = (Interval::point(own.time_s[0]) + Interval::point(longest)).upper() <= start;
            if !(follows && acts && window.first < window.last && window.last < own.time_s.len()) {
                return None;
            }
            before = Some(*window);
        }
        if before?.record + 1 != readings.len() {
            return None;
        }
        let known =
            |readings: &Readings| (0..readings.command.edges()).all(|edge| readings.command.span(edge).is_point());
        let instants = readings.iter().map(|own| if known(own) { 0 } else { own.command.edges() }).collect();
        Some(Layout::new(self.terms.clone(), delayed, instants, windows))
    }

    pub(super) fn model<'a>(&self, readings: &'a [Readings], layout: &'a Layout, stage: &Stage) -> Model<'a> {
        Model {
            records: readings,
            layout,
            middle_speed: self.middle_speed,
            known_delay_s: Interval::point(stage.delay_s.unwrap_or(0.0)),
            least_linear: self.least_linear,
            fastest: self.fastest,
            per_s: roughly(swing_s(readings)),
            effort: Effort::default(),
            reach: usize::MAX,
            heard: None,
        }
    }

    fn check_witness(&self, readings: &[Readings], witness: &Witness) -> Result<(), Unproved> {
        let first = self.stages.first().ok_or_else(|| malformed("no stage"))?;
        let delayed = first.delay_s.is_none();
        let delay_s = if delayed { witness.values.get(self.terms.len()).copied() } else { first.delay_s };
        // As if it were all that is left, with one window for each record.
        let windows = readings.iter().zip(&witness.first).enumerate();
        let stage = Stage {
            delay_s,
            windows: windows.map(|(record, (own, first))| [record, *first, own.time_s.len() - 1]).collect(),
            from: Vec::new(),
            left: None,
            steps: Vec::new(),
        };
        let layout = self.layout(readings, &stage).ok_or_else(|| malformed("the witness"))?;
        let layout = layout.with_delay(delayed);
        let model = Model { per_s: Some(1.0 / swing_s(readings)), ..self.model(readings, &layout, &stage) };
        let at = &witness.values;
        let inside = sides(&first.from).is_some_and(|from| {
            from.len() == layout.parameters() && from.iter().zip(at).all(|(side, value)| side.contains(*value))
        });
        if at.len() != layout.start(readings.len(), 0) || !inside || !at.iter().all(|value| value.is_finite()) {
            return Err(malformed("the witness"));
        }
        let misfits = model.whole().into_iter().map(|span| model.misfit(span, at).unwrap_or(f64::INFINITY));
        let misfit = misfits.fold(0.0, f64::max);
        if misfit <= 1.0 { Ok(()) } else { Err(Unproved::Witness { misfit }) }
    }
}
