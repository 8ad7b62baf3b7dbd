//! Reading logs: delimiter-separated text with a header.

use core::f64::consts::TAU;
use std::borrow::Cow;
use std::io::Read;
use std::num::NonZeroUsize;

use super::clinic::{self, TimeUnit};
use super::rows::{Chosen, Rows};
use super::{ExperimentError, Place, Record};
use crate::files::{LONGEST_WORD, cut};

/// Names tried for each column, best first, as a message lists them.
const TIME: &str = "time_s, time, t, timestamp, time_ms, time_us, time_ns, time_min, time_h, timestamp_s, timestamp_ms, timestamp_us, timestamp_ns";
const OUTPUT: &str = "heading_deg, yaw_deg, heading, yaw, depth_m, position_m, position, output, y, depth, temperature";
const INPUT: &str = "command, input, u, pwm, duty";
/// The same where a controller's output is the command.
const PROCESS_OUTPUT: &str = "temperature, temp, pv, process_value, measured, y, output, level, position";
const PROCESS_INPUT: &str = "duty, power, heater, heating, relay, valve, pwm, command, input, u, output";

/// Longest list of names that a message shows.
const LONGEST_LIST: usize = 200;

/// Which columns of a log to read, and how.
///
/// ```
/// use selfosc::experiment::Columns;
/// let text: String = (0..20).map(|i| format!("0.{i:02};{};1\n", (355 + i) % 360)).collect();
/// let log = Columns::default().read(format!("time_s;heading_deg;command\n{text}").as_bytes())?;
/// assert!(log.degrees);
/// assert_eq!(log.unwrapped, 1);
/// assert!((log.record.output()[19] - 374f64.to_radians()).abs() < 1e-12);
/// # Ok::<(), selfosc::experiment::ExperimentError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Columns {
    /// Name of the time column, in upper or lower case; by default the first of `time_s`, `time`, `t`, `timestamp`, `time_ms`,
    /// `time_us`, `time_ns`, `time_min`, `time_h`, `timestamp_s` and so on. Of several columns of one name, `name#2` is the second.
    pub time: Option<String>,
    /// Name of the output column; by default the first of `heading_deg`, `yaw_deg`, `heading`, `yaw`, `depth_m`,
    /// `position_m`, `position`, `output`, `y`, `depth`, `temperature`.
    pub output: Option<String>,
    /// Name of the input column; by default the first of `command`, `input`, `u`, `pwm`, `duty`.
    pub input: Option<String>,
    /// Unit of the times; by default that which the column's name ends in, as `_ms` does, else seconds.
    pub time_unit: Option<TimeUnit>,
    /// The command that does nothing, in units of its column: it is taken off. By default zero.
    pub neutral: Option<f64>,
    /// The command is logged with the opposite sign.
    pub invert: bool,
    /// Only samples from this time on, in s on the log's clock.
    pub from_s: Option<f64>,
    /// Only samples up to this time, in s on the log's clock.
    pub to_s: Option<f64>,
    /// The part to use of a log whose clock starts again, counted from 1.
    pub part: Option<NonZeroUsize>,
    /// The samples were taken at even intervals: the stamps are those of arrival, and the line of least squares through them is used.
    pub even_stamps: bool,
    /// Rows without three numbers, or with a time not after its predecessor, are omitted, up to
    /// [`MOST_SKIPPED`](Self::MOST_SKIPPED) of all.
    pub skip_bad_rows: bool,
    /// A command holds until the next, where its cell is blank or NaN: merged topics are read, each of which fills its own rows. Rows without
    /// output, or before the first command, are no samples. A command counts from the output before it on, so that a delay is that from the
    /// reading to the effect.
    pub hold_command: bool,
    /// The output is in radians, whatever it looks like.
    pub radians: bool,
    /// The output is in degrees. A column whose name ends in `_deg` always is.
    pub degrees: bool,
    /// The output is a temperature or another process value and no angle; columns are looked for by the names of controllers: of
    /// `temperature` and `output` the second is the command.
    pub process: bool,
    /// The output is an angle that jumps by a turn. Columns named after heading or yaw always count as such.
    pub wrap: bool,
}

/// A log that has been read.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Log {
    /// The record, angles in radians.
    pub record: Record,
    /// Whether the output was in degrees.
    pub degrees: bool,
    /// Jumps by whole turns taken out.
    pub unwrapped: usize,
    /// Rows left out because they could not be used.
    #[serde(default)]
    pub skipped: usize,
    /// Names of the columns read: time, output, input.
    pub columns: [String; 3],
}

impl Log {
    /// Whether the output is a heading: in degrees, of a column of heading or yaw, or with jumps by a turn.
    #[must_use]
    pub fn is_heading(&self) -> bool {
        self.degrees || self.unwrapped > 0 || is_named_heading(&self.columns[1].to_lowercase())
    }

    /// Whether the output is a length in m: of a column of depth, or whose name ends in `_m`.
    pub(crate) fn is_length(&self) -> bool {
        let column = self.columns[1].to_lowercase();
        column.starts_with("depth") || column.ends_with("_m")
    }
}

/// Whether a column's name in small letters is that of a heading.
fn is_named_heading(column: &str) -> bool {
    column.contains("heading") || column.contains("yaw")
}

/// Samples that were never in a file: the output as it is, columns by their first names.
impl From<Record> for Log {
    fn from(record: Record) -> Self {
        let columns = ["time_s", "output", "input"].map(str::to_owned);
        Self { record, degrees: false, unwrapped: 0, skipped: 0, columns }
    }
}

impl Columns {
    /// Most bytes of a log; hours of a fast sensor have fewer.
    pub const LONGEST: u64 = 256 << 20;
    /// The largest share of rows that may be left out: of the clinic's logs, the one without a sixth of its samples is still
    /// identified to a hundredth.
    pub const MOST_SKIPPED: f64 = 0.2;

    /// Reads a log: a header line, then a line for each sample. The delimiter (comma, semicolon, tabulator, blanks) is seen
    /// from the header; with any but the comma, a decimal comma is understood. Lines that start with `#` are comments. Times may be dates
    /// (RFC 3339, in UTC): they count in s from 1970 on.
    ///
    /// # Errors
    /// [`ExperimentError`] with line and value, of the rows inside of the cut; nothing is repaired but whole turns of an angle.
    pub fn read(&self, source: impl Read) -> Result<Log, ExperimentError> {
        let mut bytes = Vec::new();
        let length = source.take(Self::LONGEST + 1).read_to_end(&mut bytes);
        let length = length.map_err(|error| ExperimentError::Unreadable { line: 0, reason: error.to_string() })?;
        if length as u64 > Self::LONGEST {
            return Err(ExperimentError::TooLong);
        }
        let text = String::from_utf8_lossy(&bytes);
        self.parse(text.trim_start_matches('\u{feff}'))
    }

    fn parse(&self, text: &str) -> Result<Log, ExperimentError> {
        let unprintable = |c: char| (c.is_control() && !matches!(c, '\t' | '\n' | '\r')) || c == '\u{7f}';
        if let Some(at) = text.find(unprintable) {
            let line = 1 + text[..at].matches('\n').count() as u64;
            return Err(ExperimentError::Binary { line, character: text[at..].chars().next().map_or(0, u32::from) });
        }
        let header = text.lines().find(|line| !(line.trim().is_empty() || line.starts_with('#')));
        let Some(header) = header else { return Err(ExperimentError::Empty) };
        let (delimiter, table) = delimiter(header, text);
        let reader = || {
            let mut builder = csv::ReaderBuilder::new();
            builder.delimiter(delimiter).comment(Some(b'#')).trim(csv::Trim::All).flexible(true);
            builder.from_reader(table.as_bytes())
        };
        let mut first = reader();
        let names: Vec<String> = first.headers().map_err(unreadable)?.iter().map(str::to_owned).collect();
        let columns = self.choose(&names)?;
        let unit = self.unit(&names[columns[0]]);
        let cell = |row: &csv::StringRecord, column: usize| {
            let line = row.position().map_or(0, csv::Position::line);
            if row.len() != names.len() {
                return Err(ExperimentError::Ragged { line, cells: row.len(), columns: names.len() });
            }
            let cell = row.get(column).unwrap_or("");
            let other = match cell.to_ascii_lowercase().as_str() {
                _ if column == columns[0] => date_s(cell).map(|time_s| time_s * unit.per_second()),
                "on" if column == columns[2] => Some(1.0),
                "off" if column == columns[2] => Some(0.0),
                _ => None,
            };
            other.map_or_else(|| number(cell, delimiter, line, &names[column]), Ok)
        };
        let mut values: [Vec<f64>; 3] = Default::default();
        let mut lines = Vec::new();
        let mut row = csv::StringRecord::new();
        while first.read_record(&mut row).map_err(unreadable)? {
            for (&column, values) in columns.iter().zip(&mut values) {
                let no_number =
                    |fault| if matches!(fault, ExperimentError::Blank { .. }) { f64::NAN } else { f64::INFINITY };
                values.push(cell(&row, column).unwrap_or_else(no_number));
            }
            lines.push(row.position().map_or(0, csv::Position::line));
        }
        // What is wrong with a row is read again, only where it matters.
        let fault = |row: usize| {
            let row = reader().into_records().nth(row)?.ok()?;
            let blank = |fault: &ExperimentError| matches!(fault, ExperimentError::Blank { .. });
            columns
                .iter()
                .filter_map(|&column| cell(&row, column).err())
                .find(|fault| !(self.hold_command && blank(fault)))
        };
        let rows = Rows { values, place: &|row| Place::Line(lines[row]), fault: &fault };
        self.log(columns.map(|column| names[column].clone()), rows)
    }

    /// The unit of times in a column.
    fn unit(&self, column: &str) -> TimeUnit {
        self.time_unit.or(TimeUnit::of_column(column)).unwrap_or(TimeUnit::Seconds)
    }

    /// Which of these columns are time, output and input, by their places.
    ///
    /// # Errors
    /// [`ExperimentError::NoHeader`] where all names are numbers; [`ExperimentError::UnknownColumn`] with the names there are; [`ExperimentError::DuplicateColumn`];
    /// [`ExperimentError::SameColumn`] where one column is named twice.
    pub fn choose(&self, names: &[String]) -> Result<[usize; 3], ExperimentError> {
        if names.iter().all(|name| name.parse::<f64>().is_ok()) {
            return Err(ExperimentError::NoHeader { first: cut(&names.join(", "), LONGEST_LIST) });
        }
        let (output, input) = if self.process { (PROCESS_OUTPUT, PROCESS_INPUT) } else { (OUTPUT, INPUT) };
        let chosen = [
            column(names, "time", self.time.as_deref(), TIME)?,
            column(names, "output", self.output.as_deref(), output)?,
            column(names, "input", self.input.as_deref(), input)?,
        ];
        for [one, other] in [[0, 1], [0, 2], [1, 2]] {
            if chosen[one] == chosen[other] {
                let (name, roles) = (cut(&names[chosen[one]], LONGEST_WORD), ["time", "output", "input"]);
                return Err(ExperimentError::SameColumn { name, roles: [roles[one], roles[other]] });
            }
        }
        Ok(chosen)
    }

    /// The log of a table in memory: what reading it as text would give. The columns are time, output and input, as
    /// [`choose`](Self::choose) finds them, with their names.
    ///
    /// # Errors
    /// [`ExperimentError`] with sample and value.
    ///
    /// ```
    /// use selfosc::experiment::Columns;
    /// let names = ["time_s", "yaw_deg", "command"].map(str::to_owned);
    /// let time_s: Vec<f64> = (0..20).map(f64::from).collect();
    /// let log = Columns::default().table(names.clone(), [time_s, vec![90.0; 20], vec![1.0; 20]])?;
    /// assert_eq!(log.record.output()[0], core::f64::consts::FRAC_PI_2);
    /// let uneven = Columns::default().table(names, [vec![0.0; 2], vec![90.0; 1], vec![1.0; 2]]);
    /// assert_eq!(uneven.unwrap_err().code(), "unequal-columns");
    /// # Ok::<(), selfosc::experiment::ExperimentError>(())
    /// ```
    pub fn table(&self, names: [String; 3], values: [Vec<f64>; 3]) -> Result<Log, ExperimentError> {
        self.log(names, Rows { values, place: &Place::Sample, fault: &|_| None })
    }

    fn log(&self, columns: [String; 3], mut rows: Rows<'_>) -> Result<Log, ExperimentError> {
        let [time, output, input] = rows.values.each_ref().map(Vec::len);
        if (output, input) != (time, time) {
            return Err(ExperimentError::Lengths { time, output, input });
        }
        let (unit, named) = (self.unit(&columns[0]), TimeUnit::of_column(&columns[0]));
        rows.values[0].iter_mut().for_each(|time| *time /= unit.per_second());
        // Tanks and ovens are read by the minute: there a column's name suffices.
        clinic::seconds(&rows.values[0], self.time_unit.is_some() || self.process && named.is_some())?;
        let Chosen { values: [time_s, mut output, mut input], rows: kept, skipped } = rows.chosen(self)?;
        let place = |sample: usize| (rows.place)(kept[sample]);
        let name = &columns[1];
        let lower = name.to_lowercase();
        let in_degrees = !self.radians && (self.degrees || lower.ends_with("_deg"));
        let wrap = self.wrap || is_named_heading(&lower);
        let reach = clinic::radians(name, &output);
        if wrap && !in_degrees && !self.radians && !self.process {
            reach.clone()?;
        }
        let degrees = in_degrees && !self.process;
        if degrees {
            output.iter_mut().for_each(|angle| *angle = angle.to_radians());
        }
        // The output of a process stays in its unit.
        let turn = if self.process && (in_degrees || reach.is_err()) { 360.0 } else { TAU };
        let unwrapped = if wrap { clinic::unwrap(&mut output, turn) } else { 0 };
        if !wrap && !self.process {
            clinic::turns(name, &output, degrees, place)?;
        }
        let neutral = self.neutral.unwrap_or(0.0);
        // That zero is neutral may be said of any command.
        if self.neutral != Some(0.0) {
            clinic::neutral(&columns[2], &input, neutral)?;
        }
        input.iter_mut().for_each(|command| *command -= neutral);
        if self.invert {
            input.iter_mut().for_each(|command| *command = -*command);
        }
        let record = Record::placed(time_s, output, input, place)?;
        Ok(Log { record, degrees, unwrapped, skipped, columns })
    }
}

/// The delimiter of the header, and the text with single delimiters.
fn delimiter<'a>(header: &str, text: &'a str) -> (u8, Cow<'a, str>) {
    for candidate in [b';', b'\t', b','] {
        if header.as_bytes().contains(&candidate) {
            return (candidate, Cow::Borrowed(text));
        }
    }
    let line = |line: &str| line.split_whitespace().collect::<Vec<_>>().join("\t");
    (b'\t', Cow::Owned(text.lines().map(line).collect::<Vec<_>>().join("\n")))
}

/// Index of the column asked for, or of the first default that is there.
fn column(
    names: &[String],
    role: &'static str,
    wanted: Option<&str>,
    defaults: &str,
) -> Result<usize, ExperimentError> {
    let all = |name: &str| -> Vec<usize> {
        let those = |same: fn(&str, &str) -> bool| {
            (0..names.len()).filter(|index| same(&names[*index], name)).collect::<Vec<_>>()
        };
        let exact = those(|candidate, name| candidate == name);
        if exact.is_empty() { those(|candidate, name| candidate.eq_ignore_ascii_case(name)) } else { exact }
    };
    let numbered = |name: &str| {
        let (name, number) = name.rsplit_once('#')?;
        all(name).get(number.parse::<usize>().ok()?.checked_sub(1)?).copied()
    };
    let found = match wanted {
        Some(name) => all(name),
        None => defaults.split(", ").map(&all).find(|found| !found.is_empty()).unwrap_or_default(),
    };
    match (&found[..], wanted.and_then(numbered)) {
        ([only], _) => Ok(*only),
        ([], Some(numbered)) => Ok(numbered),
        ([], None) => Err(ExperimentError::UnknownColumn {
            role,
            wanted: wanted.map_or_else(|| defaults.to_owned(), |name| cut(name, LONGEST_WORD)),
            found: cut(&names.join(", "), LONGEST_LIST),
        }),
        (several, _) => {
            let (name, count) = (cut(&names[several[0]], LONGEST_WORD), several.len());
            Err(ExperimentError::DuplicateColumn { role, name, count })
        }
    }
}

/// Seconds from 1970 to a date with its time of day, in UTC.
fn date_s(cell: &str) -> Option<f64> {
    let date = humantime::parse_rfc3339_weak(cell).ok()?;
    Some(date.duration_since(std::time::UNIX_EPOCH).ok()?.as_secs_f64())
}

/// The number in a cell.
fn number(cell: &str, delimiter: u8, line: u64, column: &str) -> Result<f64, ExperimentError> {
    let column = || cut(column, LONGEST_WORD);
    if cell.is_empty() {
        return Err(ExperimentError::Blank { line, column: column() });
    }
    let point = if delimiter == b',' { Cow::Borrowed(cell) } else { Cow::Owned(cell.replace(',', ".")) };
    point.parse().map_err(|_| ExperimentError::NotANumber { line, column: column(), text: cut(cell, LONGEST_WORD) })
}

fn unreadable(error: csv::Error) -> ExperimentError {
    let line = error.position().map_or(0, csv::Position::line);
    ExperimentError::Unreadable { line, reason: error.to_string() }
}
