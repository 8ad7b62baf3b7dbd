//! The statement of a certificate, by its model and its rows alone: the problem anew, the words, and whether the rows are a log's.

use super::super::problem::{Problem, ROUNDING};
use super::super::settings::{BoundedModel, DelayBound, SwitchedWhen};
use super::format::{Certificate, LogRows, Searched};
use super::unproved::{Unproved, malformed};
use crate::experiment::Record;

/// Those that hold, as a list in words.
fn listed(items: &[(bool, &str)]) -> String {
    let held: Vec<&str> = items.iter().filter(|(held, _)| *held).map(|(_, words)| *words).collect();
    match held.split_last() {
        Some((last, [])) => (*last).to_owned(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}

impl Certificate {
    /// The records and the problem that they pose, which must be the file's.
    pub(super) fn problem(&self) -> Result<(Vec<Record>, Problem), Unproved> {
        let record = |rows: &LogRows| Record::new(rows.time_s.clone(), rows.reading.clone(), rows.command.clone());
        let records: Vec<Record> = self
            .records
            .iter()
            .map(|rows| record(rows).map_err(|error| malformed(&format!("a record: {error}"))))
            .collect::<Result<_, _>>()?;
        if self.model.outliers > 0 {
            return Err(Unproved::Outliers { allowed: self.model.outliers });
        }
        let problem = Problem::new(&records.iter().collect::<Vec<_>>(), &self.model);
        let problem = problem.map_err(|error| malformed(&format!("the model and its records: {error}")))?;
        let steps = records.iter().zip(&self.records);
        if steps.into_iter().any(|(record, rows)| rows.quantum != self.model.step(record)) {
            return Err(Unproved::Ranges { what: "step of a sensor" });
        }
        let (found, expected) = (&self.searched, Searched::of(&problem));
        for (same, what) in [
            (found.terms == expected.terms, "equation"),
            (found.middle_speed == expected.middle_speed, "middle speed"),
            (found.least_linear == expected.least_linear, "least linear drag"),
            (found.fastest == expected.fastest, "largest speed"),
            (found.from == expected.from, "search box"),
        ] {
            if !same {
                return Err(Unproved::Ranges { what });
            }
        }
        Ok((records, problem))
    }

    /// The statement that steps of this shape show of these records.
    pub(super) fn words(&self, records: &[&Record]) -> String {
        let left = self.stages.last().and_then(|stage| stage.left.as_ref());
        let words = match (left, &self.witness) {
            (None, _) => "refuted: no parameter in the search box meets every reading",
            (Some(_), None) => "every parameter in the search box that meets every reading lies within the bounds",
            (Some(_), Some(_)) => {
                "consistent: every parameter in the search box that meets every reading lies within the bounds, and the witness \
                 meets every reading"
            }
        };
        let BoundedModel { delay, quantum, error, jitter_s, switching, .. } = &self.model;
        // Differences of readings are rounded.
        let shown =
            |step: f64| records.iter().all(|own| own.quantum().is_some_and(|own| (own / step - 1.0).abs() < ROUNDING));
        let conditions = listed(&[
            (!self.model.usual_reach(), "inertia and drag are within the stated reach, which is not the usual one"),
            (matches!(delay, DelayBound::WithinS(_)), "the delay is within the stated range"),
        ]);
        let given = listed(&[
            (matches!(delay, DelayBound::KnownS(_)), "the delay"),
            (quantum.is_some_and(|step| !shown(step)), "a step of the sensor that the readings do not show"),
            (*error > 0.0, "the error of a reading"),
            (*jitter_s > 0.0, "the error of a stamp"),
            (*switching == SwitchedWhen::Anywhere, "switchings between rows"),
        ]);
        let before = if conditions.is_empty() { conditions } else { format!("on condition that {conditions}: ") };
        let after = if given.is_empty() { given } else { format!(", given {given}") };
        format!("{before}{words}{after}")
    }

    /// Every range on which the words depend, in addition to the search box.
    pub(super) fn ranges(&self, problem: &Problem) -> Vec<String> {
        let BoundedModel { law, either_sign, delay, switching, error, jitter_s, reach, .. } = &self.model;
        let sign = if *either_sign { ", of either sign where it is linear" } else { "" };
        let delay = match delay {
            DelayBound::KnownS(delay_s) => format!("a delay of {delay_s} s"),
            DelayBound::WithinS([low, high]) => format!("a delay from {low} to {high} s"),
            DelayBound::Unknown => "an unknown delay".to_owned(),
        };
        let usual = if self.model.usual_reach() { "the usual" } else { "not the usual" };
        let mut ranges = vec![
            format!("{} drag{sign}, {delay}", law.name()),
            format!("inertia and drag within a factor of {reach} of what the records suggest ({usual})"),
            "outputs in units of the log, angles in rad; times in s; forces in units of the command".to_owned(),
            "no reading may be an outlier".to_owned(),
        ];
        let windows = &problem.unknowns.shooting;
        for (number, rows) in self.records.iter().enumerate() {
            let first = windows.iter().find(|window| window.record == number).map_or(0, |window| window.first);
            let (readings, granted) = (rows.time_s.len(), problem.records[number].error);
            ranges.push(format!(
                "record {}: {readings} rows, followed from row {}; the output within {granted} of a reading (a step of {}, and {error})",
                number + 1,
                first + 1,
                rows.quantum,
            ));
        }
        let when = if *switching == SwitchedWhen::Anywhere { "anywhere between two rows" } else { "with its row" };
        ranges.push(format!("stamps within {jitter_s} s; the command changes {when}"));
        ranges
    }

    /// Whether the rows are those of the logs.
    ///
    /// # Errors
    /// [`Unproved::Logs`], and [`Unproved::Row`] with the first that differs.
    pub fn agrees(&self, logs: &[Record]) -> Result<(), Unproved> {
        if logs.len() != self.records.len() {
            return Err(Unproved::Logs { found: logs.len(), expected: self.records.len() });
        }
        for (number, (log, rows)) in logs.iter().zip(&self.records).enumerate() {
            for (what, found, expected) in [
                ("stamp", log.time_s(), &rows.time_s),
                ("reading", log.output(), &rows.reading),
                ("command", log.input(), &rows.command),
            ] {
                let most = found.len().max(expected.len());
                let differs = (0..most).find(|row| found.get(*row) != expected.get(*row));
                if let Some(row) = differs {
                    let or = |values: &[f64]| values.get(row).map_or("no row".to_owned(), f64::to_string);
                    let (found, expected) = (or(found), or(expected));
                    return Err(Unproved::Row { log: number + 1, row: row + 1, what, found, expected });
                }
            }
        }
        Ok(())
    }
}
