//! The paper's printed numbers, from `fixtures/`: the files are compiled in.

use std::str::FromStr;

use csv::{ReaderBuilder, StringRecord, Trim};

use super::{PaperError, Printed};

const TABLE_4: &str = "table4.csv";
const PRINTED: &str = "printed.csv";

/// A row of Table 4, as printed, in the table's units: 1e-2 N m, degrees, seconds, and 1e-4, 1e-4, 1e-5 times N m per degree
/// and second for the parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Experiment {
    /// Its number.
    pub number: u32,
    /// Relay level C.
    pub relay_level: Printed,
    /// Mean switching level x_a*.
    pub switch_level: Printed,
    /// Mean amplitude X_m.
    pub amplitude: Printed,
    /// Bias x_0.
    pub bias: Printed,
    /// Period T.
    pub period: Printed,
    /// Inertia alpha.
    pub alpha: Printed,
    /// Linear drag beta_r.
    pub beta_r: Printed,
    /// Quadratic drag beta_rr.
    pub beta_rr: Printed,
}

/// A number or a phrase printed elsewhere: every value in `lowest..=highest` agrees with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// Quantity and place of the number.
    pub item: String,
    /// Smallest value that agrees.
    pub lowest: f64,
    /// As printed.
    pub printed: f64,
    /// Largest value that agrees.
    pub highest: f64,
    /// Its unit; empty for a ratio.
    pub unit: String,
    /// Where it is printed.
    pub place: String,
}

/// Table 4.
///
/// # Errors
/// As [`read_table4`].
pub fn table4() -> Result<Vec<Experiment>, PaperError> {
    read_table4(include_str!("../../fixtures/table4.csv"))
}

/// Table 4 from the text of its file.
///
/// # Errors
/// [`PaperError`] with line and column of the first cell, row or column that is not as it should be.
pub fn read_table4(text: &str) -> Result<Vec<Experiment>, PaperError> {
    let decimal = |cell: &str| Printed::parse(cell);
    let positive = |cell: &str| Printed::parse(cell).filter(|number| number.value() > 0.0);
    read(TABLE_4, text, |row| {
        Ok(Experiment {
            number: row.cell("experiment", "a whole number", |cell| u32::from_str(cell).ok())?,
            relay_level: row.cell("c_1e-2_n_m", ABOVE_ZERO, positive)?,
            switch_level: row.cell("x_a_star_deg", ABOVE_ZERO, positive)?,
            amplitude: row.cell("x_m_deg", ABOVE_ZERO, positive)?,
            bias: row.cell("x_0_deg", "a decimal number", decimal)?,
            period: row.cell("period_s", ABOVE_ZERO, positive)?,
            alpha: row.cell("alpha_1e-4", ABOVE_ZERO, positive)?,
            beta_r: row.cell("beta_r_1e-4", ABOVE_ZERO, positive)?,
            beta_rr: row.cell("beta_rr_1e-5", ABOVE_ZERO, positive)?,
        })
    })
}

const ABOVE_ZERO: &str = "a decimal number above 0";

/// The printed numbers outside the tables.
///
/// # Errors
/// As [`read_statements`].
pub fn statements() -> Result<Vec<Statement>, PaperError> {
    read_statements(include_str!("../../fixtures/printed.csv"))
}

/// The printed numbers outside the tables, from the text of their file.
///
/// # Errors
/// [`PaperError`] with line and column of the first cell, row or column that is not as it should be.
pub fn read_statements(text: &str) -> Result<Vec<Statement>, PaperError> {
    let number = |cell: &str| f64::from_str(cell).ok().filter(|number| number.is_finite());
    read(PRINTED, text, |row| {
        let lowest = row.cell("lowest", "a finite number", number)?;
        let printed = row.cell("printed", "a finite number, `lowest` or more", |cell| {
            number(cell).filter(|printed| *printed >= lowest)
        })?;
        Ok(Statement {
            item: row.cell("item", "a text", |cell| (!cell.is_empty()).then(|| cell.to_owned()))?,
            lowest,
            printed,
            highest: row.cell("highest", "a finite number, `printed` or more", |cell| {
                number(cell).filter(|highest| *highest >= printed)
            })?,
            unit: row.cell("unit", "a text", |cell| Some(cell.to_owned()))?,
            place: row.cell("place", "a text", |cell| Some(cell.to_owned()))?,
        })
    })
}

struct CsvRow<'a> {
    fixture: &'static str,
    line: u64,
    headers: &'a StringRecord,
    cells: &'a StringRecord,
}

impl CsvRow<'_> {
    fn cell<T>(
        &self,
        column: &str,
        required: &'static str,
        parse: impl Fn(&str) -> Option<T>,
    ) -> Result<T, PaperError> {
        let place = self.headers.iter().position(|header| header == column);
        let (fixture, line, column) = (self.fixture, self.line, column.to_owned());
        let Some(place) = place else {
            return Err(PaperError::Row { fixture, line: 1, column, reason: "the column is missing".to_owned() });
        };
        let cell = &self.cells[place];
        parse(cell).ok_or_else(|| PaperError::Cell { fixture, line, column, cell: cell.to_owned(), required })
    }
}

fn read<T>(
    fixture: &'static str,
    text: &str,
    row: impl Fn(&CsvRow<'_>) -> Result<T, PaperError>,
) -> Result<Vec<T>, PaperError> {
    // Rows of another length are reported here, with their last column.
    let mut reader = ReaderBuilder::new().trim(Trim::All).flexible(true).from_reader(text.as_bytes());
    let broken =
        |line, column: &str, reason: String| PaperError::Row { fixture, line, column: column.to_owned(), reason };
    let headers = reader.headers().map_err(|error| broken(1, "?", error.to_string()))?.clone();
    let mut rows = Vec::new();
    for record in reader.records() {
        let cells = record.map_err(|error| {
            let line = error.position().map_or(1, csv::Position::line);
            broken(line, "?", error.to_string())
        })?;
        let line = cells.position().map_or(1, csv::Position::line);
        if cells.len() != headers.len() {
            let column = headers.get(cells.len().min(headers.len().saturating_sub(1))).unwrap_or("?");
            return Err(broken(
                line,
                column,
                format!("{} cells where there are {} columns", cells.len(), headers.len()),
            ));
        }
        rows.push(row(&CsvRow { fixture, line, headers: &headers, cells: &cells })?);
    }
    Ok(rows)
}
