//! One table, in several notations.

use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser, Storage, push_mathml};
use serde_json::{Map, Value, json};

use super::ReportError;
use crate::proof::Expression;

/// A page folds a table away that has more rows.
const LONG: usize = 24;

/// A cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A number, shown with so many decimals where people read it and in full where programs do.
    Number {
        /// The number; one that is not finite counts as missing.
        value: f64,
        /// Digits after the point.
        decimals: usize,
    },
    /// A formula.
    Formula(Expression),
    /// Yes or no.
    Flag(bool),
    /// Nothing.
    Missing,
}

impl Cell {
    /// A number with so many decimals.
    #[must_use]
    pub fn number(value: f64, decimals: usize) -> Self {
        if value.is_finite() { Self::Number { value, decimals } } else { Self::Missing }
    }

    /// A whole number.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "nothing that is counted here comes near 2^53")]
    pub fn count(value: usize) -> Self {
        Self::number(value as f64, 0)
    }

    fn is_number(&self) -> bool {
        matches!(self, Self::Number { .. } | Self::Missing)
    }

    /// As people read it, with formulas and words as the notation has them.
    fn shown(&self, words: fn(&str) -> String, formula: fn(Expression) -> String) -> String {
        match self {
            Self::Text(text) => words(text),
            Self::Number { value, decimals } => {
                let text = format!("{value:.decimals$}");
                // Zero has no sign.
                match text.strip_prefix('-') {
                    Some(size) if size.chars().all(|c| c == '0' || c == '.') => size.to_owned(),
                    _ => text,
                }
            }
            Self::Formula(expression) => formula(*expression),
            Self::Flag(flag) => if *flag { "yes" } else { "no" }.to_owned(),
            Self::Missing => String::new(),
        }
    }

    fn plain(&self) -> String {
        self.shown(str::to_owned, |formula| formula.to_string())
    }

    fn json(&self) -> Value {
        match self {
            Self::Number { value, .. } => json!(value),
            Self::Flag(flag) => json!(flag),
            Self::Missing => Value::Null,
            Self::Text(_) | Self::Formula(_) => json!(self.plain()),
        }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<Expression> for Cell {
    fn from(formula: Expression) -> Self {
        Self::Formula(formula)
    }
}

/// A table with named columns.
///
/// ```
/// use selfosc::report::{Cell, Table};
/// let table = Table::new("levels", "Relay levels", &["experiment", "C (N m)"])
///     .row([Cell::count(1), Cell::number(0.021, 4)])
///     .row([Cell::count(2), Cell::Missing]);
/// assert_eq!(table.csv()?, "experiment,C (N m)\n1,0.021\n2,\n");
/// # Ok::<(), selfosc::report::ReportError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Name of its files.
    pub name: &'static str,
    /// Heading.
    pub title: String,
    columns: Vec<String>,
    rows: Vec<Vec<Cell>>,
    notes: Vec<String>,
    folded: bool,
}

impl Table {
    /// A table without rows.
    #[must_use]
    pub fn new(name: &'static str, title: &str, columns: &[&str]) -> Self {
        let columns = columns.iter().map(|column| (*column).to_owned()).collect();
        Self { name, title: title.to_owned(), columns, rows: Vec::new(), notes: Vec::new(), folded: false }
    }

    /// The table with one more row: cells beyond the last column are dropped, cells that lack are missing.
    #[must_use]
    pub fn row(mut self, cells: impl IntoIterator<Item = Cell>) -> Self {
        let cells = cells.into_iter().chain(std::iter::repeat(Cell::Missing));
        self.rows.push(cells.take(self.columns.len()).collect());
        self
    }

    /// The table with a row for each of these.
    #[must_use]
    pub fn rows<R: IntoIterator<Item = Cell>>(self, rows: impl IntoIterator<Item = R>) -> Self {
        rows.into_iter().fold(self, Self::row)
    }

    /// The table with a sentence below it.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// The table folded away on a page, as one of many rows always is.
    #[must_use]
    pub fn folded(self) -> Self {
        Self { folded: true, ..self }
    }

    /// For a terminal: columns aligned, numbers to the right.
    #[must_use]
    pub fn text(&self) -> String {
        let cells: Vec<Vec<String>> = self.rows.iter().map(|row| row.iter().map(Cell::plain).collect()).collect();
        let width = |column: usize| {
            let below = cells.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
            below.max(self.columns[column].chars().count())
        };
        let widths: Vec<usize> = (0..self.columns.len()).map(width).collect();
        let line = |cells: &[String]| {
            let aligned = cells.iter().enumerate().map(|(column, cell)| {
                let width = widths[column];
                if self.is_right(column) { format!("{cell:>width$}") } else { format!("{cell:<width$}") }
            });
            format!("{}\n", aligned.collect::<Vec<_>>().join("  ").trim_end())
        };
        let body: String = cells.iter().map(|row| line(row)).collect();
        let notes: String = self.notes.iter().map(|note| format!("{note}\n")).collect();
        format!("{}\n\n{}{body}{notes}", self.title, line(&self.columns))
    }

    /// Markdown with formulas between dollar signs.
    #[must_use]
    pub fn markdown(&self) -> String {
        let words = |text: &str| text.replace('|', r"\|");
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let rule = (0..self.columns.len()).map(|column| if self.is_right(column) { "---:" } else { "---" }.to_owned());
        let body = self.rows.iter().map(|row| {
            line(
                row.iter()
                    .map(|cell| cell.shown(words, |formula| format!("${}$", formula.latex()).replace('|', r"\|")))
                    .collect(),
            )
        });
        let notes: String = self.notes.iter().map(|note| format!("\n{note}\n")).collect();
        let heading = line(self.columns.iter().map(|column| words(column)).collect());
        format!("## {}\n\n{heading}{}{}{notes}", self.title, line(rule.collect()), body.collect::<String>())
    }

    /// Comma-separated values with a header and full precision; formulas as plain text.
    ///
    /// # Errors
    /// [`ReportError::Table`] where the writer refuses.
    pub fn csv(&self) -> Result<String, ReportError> {
        let failed = |reason: String| ReportError::Table { table: self.name, reason };
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&self.columns).map_err(|error| failed(error.to_string()))?;
        for row in &self.rows {
            let cells = row.iter().map(|cell| match cell {
                Cell::Number { value, .. } => value.to_string(),
                other => other.plain(),
            });
            writer.write_record(cells).map_err(|error| failed(error.to_string()))?;
        }
        let bytes = writer.into_inner().map_err(|error| failed(error.to_string()))?;
        String::from_utf8(bytes).map_err(|error| failed(error.to_string()))
    }

    /// A LaTeX `table` with `tabular`; needs no package.
    #[must_use]
    pub fn latex(&self) -> String {
        let alignment: String =
            (0..self.columns.len()).map(|column| if self.is_right(column) { 'r' } else { 'l' }).collect();
        let line = |cells: Vec<String>| format!("{} \\\\\n", cells.join(" & "));
        let heading = line(self.columns.iter().map(|column| escaped_latex(column)).collect());
        let body: String = self
            .rows
            .iter()
            .map(|row| line(row.iter().map(|cell| cell.shown(escaped_latex, |f| format!("${}$", f.latex()))).collect()))
            .collect();
        let notes: String = self.notes.iter().map(|note| format!("\n\n\\small {}\n", escaped_latex(note))).collect();
        format!(
            "\\begin{{table}}\n\\centering\n\\caption{{{}}}\n\\begin{{tabular}}{{{alignment}}}\n\\hline\n{heading}\\hline\n\
             {body}\\hline\n\\end{{tabular}}{notes}\n\\end{{table}}\n",
            escaped_latex(&self.title)
        )
    }

    /// One object for each row, by column name, with full precision; a missing cell is null.
    #[must_use]
    pub fn json(&self) -> Value {
        let row = |row: &Vec<Cell>| {
            let named = self.columns.iter().cloned().zip(row.iter().map(Cell::json));
            Value::Object(named.collect::<Map<_, _>>())
        };
        Value::Array(self.rows.iter().map(row).collect())
    }

    /// An HTML table with its heading as caption.
    #[must_use]
    pub fn html(&self) -> String {
        let cell = |tag: &str, column: usize, content: String| {
            let class = if self.is_right(column) { " class=\"number\"" } else { "" };
            format!("<{tag}{class}>{content}</{tag}>")
        };
        let formula = |formula: Expression| math_html(&formula.latex());
        let heading: String =
            self.columns.iter().enumerate().map(|(i, column)| cell("th", i, escaped_html(column))).collect();
        let row = |row: &Vec<Cell>| {
            let shown = |content: &Cell| match content {
                Cell::Number { .. } => content.plain().replace('-', "\u{2212}"),
                other => other.shown(escaped_html, formula),
            };
            let cells = row.iter().enumerate().map(|(i, content)| cell("td", i, shown(content)));
            format!("<tr>{}</tr>\n", cells.collect::<String>())
        };
        let body: String = self.rows.iter().map(row).collect();
        let notes: String = self.notes.iter().map(|note| format!("<p>{}</p>\n", prose_html(note))).collect();
        let title = escaped_html(&self.title);
        let table = format!("<table>\n<caption>{title}</caption>\n<tr>{heading}</tr>\n{body}</table>\n");
        if self.folded || self.rows.len() > LONG {
            format!("<details>\n<summary>{title}: {} rows</summary>\n{table}</details>\n{notes}", self.rows.len())
        } else {
            format!("{table}{notes}")
        }
    }

    /// Whether a column holds numbers only.
    fn is_right(&self, column: usize) -> bool {
        self.rows.iter().all(|row| row[column].is_number())
    }
}

/// LaTeX as MathML, which a browser sets by itself.
pub(super) fn math_html(latex: &str) -> String {
    let (storage, mut math) = (Storage::new(), String::new());
    let config = RenderConfig { display_mode: DisplayMode::Block, ..RenderConfig::default() };
    // A text takes all that is written, and an error stands in the page where it was read.
    let _ = push_mathml(&mut math, Parser::new(latex, &storage), config);
    math
}

/// Text as HTML has it, squares and cubes as superscripts.
pub(super) fn escaped_html(text: &str) -> String {
    let escaped = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;");
    let signs = escaped.replace("^2", "\u{b2}").replace("^3", "\u{b3}");
    // A number stays on the line of its uncertainty and its percent sign.
    signs.replace(" \u{b1} ", "\u{a0}\u{b1}\u{a0}").replace(" %", "\u{a0}%")
}

/// [`escaped_html`] of sentences: `5e-3` with its power of ten, what stands between backticks as code.
pub(super) fn prose_html(text: &str) -> String {
    let mut escaped = escaped_html(text);
    while let Some((before, rest)) = escaped.split_once('`')
        && let Some((code, after)) = rest.split_once('`')
    {
        escaped = format!("{before}<code>{code}</code>{after}");
    }
    let mut parts = escaped.split("e-");
    let mut shown = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let digits = part.find(|c: char| !c.is_ascii_digit()).unwrap_or(part.len());
        if digits > 0 && shown.ends_with(|c: char| c.is_ascii_digit()) {
            let (exponent, rest) = part.split_at(digits);
            shown += &format!("\u{b7}10<sup>\u{2212}{exponent}</sup>{rest}");
        } else {
            shown += &format!("e-{part}");
        }
    }
    shown
}

fn escaped_latex(text: &str) -> String {
    let escape = |c: char| match c {
        '&' | '%' | '$' | '#' | '_' | '{' | '}' => format!("\\{c}"),
        '~' => r"\textasciitilde{}".to_owned(),
        '^' => r"\textasciicircum{}".to_owned(),
        '\\' => r"\textbackslash{}".to_owned(),
        other => other.to_string(),
    };
    text.chars().map(escape).collect()
}

#[cfg(test)]
mod tests {
    use super::{Cell, prose_html};

    #[test]
    fn zero_has_no_sign() {
        let shown = [(-1e-17, "0.000"), (0.0, "0.000"), (-0.0006, "-0.001")];
        for (value, text) in shown {
            assert_eq!(Cell::number(value, 3).plain(), text);
        }
    }

    #[test]
    fn small_numbers_in_sentences_have_powers_of_ten() {
        let shown = prose_html("alpha is 5.69e-4 & the rate-limit of one-1 is at 1e-03.");
        assert_eq!(
            shown,
            "alpha is 5.69\u{b7}10<sup>\u{2212}4</sup> &amp; the rate-limit of one-1 is at 1\u{b7}10<sup>\u{2212}03</sup>."
        );
    }
}
