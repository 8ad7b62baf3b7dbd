//! Rows of a log before they are a record: the part and the cut asked for, and what cannot be used.

use super::record::middle;
use super::{Columns, ExperimentError, Place, Record};

/// Time in s, output and input of every row; a cell is NaN where it is blank, infinite where it holds no number.
pub(super) struct Rows<'a> {
    pub(super) values: [Vec<f64>; 3],
    /// Where a row stands.
    pub(super) place: &'a dyn Fn(usize) -> Place,
    /// What its text suffers from.
    pub(super) fault: &'a dyn Fn(usize) -> Option<ExperimentError>,
}

/// Rows that are used.
pub(super) struct Chosen {
    pub(super) values: [Vec<f64>; 3],
    /// Their numbers among all.
    pub(super) rows: Vec<usize>,
    /// Rows inside of the cut that are left out.
    pub(super) skipped: usize,
}

impl Rows<'_> {
    /// The rows of the part and the cut, without those that cannot be used.
    pub(super) fn chosen(&self, how: &Columns) -> Result<Chosen, ExperimentError> {
        let clock = self.clock();
        let mut inside = self.inside(&clock, how)?;
        let [_, output, input] = &self.values;
        let input = if how.hold_command { &self.held(&clock, &inside) } else { input };
        if how.hold_command {
            // A command that is no number stays to be named.
            inside.retain(|row| input[*row].is_infinite() || !output[*row].is_nan() && !input[*row].is_nan());
        }
        let mut time_s = self.values[0].clone();
        if how.even_stamps {
            // The line of least squares through the stamps over the number n of the row: the first and the last stamp alone are each
            // wrong by up to a burst.
            #[allow(clippy::cast_precision_loss, reason = "fewer rows than 2^53")]
            let count = inside.len() as f64;
            let middle = 0.5 * (count - 1.0);
            let mean_s = inside.iter().map(|row| clock[*row]).sum::<f64>() / count;
            let from_middle = || (0..).zip(&inside).map(|(n, row)| (f64::from(n) - middle, *row));
            let product: f64 = from_middle().map(|(n, row)| n * (clock[row] - mean_s)).sum();
            let interval_s = product / (count * (count * count - 1.0) / 12.0);
            from_middle().for_each(|(n, row)| time_s[row] = mean_s + n * interval_s);
        }
        let columns = [&time_s, output, input];
        let mut rows = Vec::with_capacity(inside.len());
        let mut previous_s = f64::NEG_INFINITY;
        for &row in &inside {
            let unusable = columns.iter().any(|column| !(column[row].abs() <= Record::LARGEST));
            if unusable && !how.skip_bad_rows {
                return Err((self.fault)(row).unwrap_or_else(|| Record::unusable((self.place)(row), columns, row)));
            }
            if !unusable && (time_s[row] > previous_s || !how.skip_bad_rows) {
                previous_s = time_s[row];
                rows.push(row);
            }
        }
        let skipped = inside.len() - rows.len();
        #[allow(clippy::cast_precision_loss, reason = "fewer rows than 2^53")]
        if skipped as f64 > Columns::MOST_SKIPPED * inside.len() as f64 {
            return Err(ExperimentError::TooManyBad { bad: skipped, rows: inside.len() });
        }
        let values = columns.map(|column| rows.iter().map(|row| column[*row]).collect());
        Ok(Chosen { values, rows, skipped })
    }

    /// The command that holds at each output. As a controller answers a reading, a command counts from the output before it on.
    fn held(&self, clock: &[f64], inside: &[usize]) -> Vec<f64> {
        let [_, output, input] = &self.values;
        let outputs: Vec<usize> = inside.iter().copied().filter(|row| !output[*row].is_nan()).collect();
        let mut commands = inside.iter().copied().filter(|row| input[*row].is_finite()).peekable();
        let (mut held, mut last) = (input.clone(), f64::NAN);
        for (k, &row) in outputs.iter().enumerate() {
            let next_s = outputs.get(k + 1).map_or(f64::INFINITY, |next| clock[*next]);
            while let Some(command) = commands.next_if(|command| clock[*command] < next_s) {
                last = input[command];
            }
            held[row] = if input[row].is_infinite() { input[row] } else { last };
        }
        held
    }

    /// The time of every row; where it has none, that of the row before.
    fn clock(&self) -> Vec<f64> {
        let usable = |time: &f64| time.abs() <= Record::LARGEST;
        let mut last = self.values[0].iter().copied().find(usable).unwrap_or(0.0);
        let read = |time: &f64| {
            last = if usable(time) { *time } else { last };
            last
        };
        self.values[0].iter().map(read).collect()
    }

    /// Rows of the part and the cut, bad ones among them.
    fn inside(&self, clock: &[f64], how: &Columns) -> Result<Vec<usize>, ExperimentError> {
        let steps: Vec<f64> = clock.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > 0.0).collect();
        let usual = middle(steps).unwrap_or(f64::INFINITY);
        // Less is a stamp out of order.
        let starts_again = |before: usize, row: usize| clock[before] - clock[row] > Record::LONGEST_GAP * usual;
        let begins = (1..clock.len()).filter(|row| starts_again(row - 1, *row));
        let begins: Vec<usize> = [0].into_iter().chain(begins).chain([clock.len()]).collect();
        let parts = begins.len() - 1;
        let (from, to) = match how.part.map(|part| part.get()) {
            Some(part) if part <= parts => (begins[part - 1], begins[part]),
            // Beyond the last part there is nothing.
            Some(_) => (0, 0),
            None => (0, clock.len()),
        };
        let inside = |time: f64| how.from_s.is_none_or(|from| time >= from) && how.to_s.is_none_or(|to| time <= to);
        let rows: Vec<usize> = (from..to).filter(|row| inside(clock[*row])).collect();
        if let Some(pair) = rows.windows(2).find(|pair| starts_again(pair[0], pair[1])) {
            let (place, time_s, previous_s) = ((self.place)(pair[1]), clock[pair[1]], clock[pair[0]]);
            return Err(ExperimentError::Restart { place, time_s, previous_s, parts });
        }
        Ok(rows)
    }
}
