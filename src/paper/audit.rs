//! Every printed number against its recomputation, as intervals.
//!
//! A printed number has an uncertainty of half a unit of its column's last decimal. The recomputation takes such intervals
//! through the formulas and gives the range that the printed inputs allow; the printed number agrees if its own rounding
//! interval intersects that range. Disagreement is a proof that the printed inputs and the formula do not give the printed
//! number; agreement is none that the formula was used.

use serde::Serialize;

use super::PaperError;
use super::figure15::{CRITERIA, Counts, Pairs};
use super::fixtures::{Experiment, Statement, statements};
use super::table4::{PrintedTable, Row, Table4, Yaw, means, oscillation, recomputed, spreads_percent, values};
use crate::identify::iso::Oscillation;
use crate::numeric::{Interval, Real};

/// One printed number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Item {
    /// Quantity and place of the number.
    pub item: String,
    /// As printed.
    pub printed: f64,
    /// As recomputed from the printed inputs.
    pub recomputed: f64,
    /// Lower and upper end of the range that the inputs' last decimals allow.
    pub range: (f64, f64),
    /// Whether the rounding interval of the printed number intersects that range.
    pub agrees: bool,
    /// The assumption, or where it is printed.
    pub note: String,
}

impl Item {
    fn new(item: String, printed: (f64, Interval), recomputed: (f64, Interval), note: &str) -> Self {
        Self {
            item,
            printed: printed.0,
            recomputed: recomputed.0,
            range: recomputed.1.bounds(),
            agrees: printed.1.intersection(recomputed.1).is_some(),
            note: note.to_owned(),
        }
    }
}

/// Printed numbers of a single formula under a single assumption.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Group {
    /// What they are.
    pub name: String,
    /// The outcome in words.
    pub note: String,
    /// Each of them.
    pub items: Vec<Item>,
}

impl Group {
    /// How many agree.
    #[must_use]
    pub fn agreeing(&self) -> usize {
        self.items.iter().filter(|item| item.agrees).count()
    }

    /// The largest distance between printed and recomputed.
    #[must_use]
    pub fn largest_difference(&self) -> f64 {
        self.items.iter().map(|item| (item.printed - item.recomputed).abs()).fold(0.0, f64::max)
    }
}

/// Audits every printed number.
///
/// # Errors
/// [`PaperError`] where a fixture lacks a number that is recomputed, or the method does not take a row.
pub fn audit(table: &PrintedTable, regenerated: &Table4) -> Result<Vec<Group>, PaperError> {
    let offset = regenerated.level_offset;
    let raise = move |o: &mut Oscillation<Interval>| o.relay_level += Interval::point(offset);
    let center = |o: &mut Oscillation<Interval>| o.bias = Interval::ZERO;
    let rows = |name: &str, note: &str, change: InputChange, value: Value, parameter: PickedParameter| {
        RecomputedColumn { table, regenerated, change, value, parameter }.group(name, note)
    };
    let mut groups = vec![
        rows("alpha", "printed over computed depends on the relay level alone", &|_| (), &|row| row.recomputed, ALPHA)?,
        rows(
            "alpha, C raised",
            &format!("by {offset:.3}e-2 N m, fitted; cause unknown"),
            &raise,
            &|row| Yaw { alpha: row.alpha_raised, ..row.recomputed },
            ALPHA,
        )?,
        rows("beta_r", "eqs. 27, 30, 31 and 34 with a delay of 0.2 s", &|_| (), &|row| row.recomputed, BETA_R)?,
        rows("beta_rr", "eqs. 29, 30, 31 and 34 with a delay of 0.2 s", &|_| (), &|row| row.recomputed, BETA_RR)?,
    ];
    let centered = unbiased(table)?;
    for (parameter, name) in [(BETA_R, "beta_r, x_0 = 0"), (BETA_RR, "beta_rr, x_0 = 0")] {
        let value =
            |row: &Row| centered.iter().find(|(number, _)| *number == row.experiment).map_or(row.recomputed, |r| r.1);
        groups.push(rows(name, "not all without the bias: it was used", &center, &value, parameter)?);
    }
    groups.push(amplitudes(table)?);
    groups.extend(stated(table)?);
    Ok(groups)
}

/// A parameter's name and how to pick it.
type PickedParameter = (&'static str, fn(&Yaw<f64>) -> f64, fn(&Yaw<Interval>) -> Interval);
type InputChange<'a> = &'a dyn Fn(&mut Oscillation<Interval>);
type Value<'a> = &'a dyn Fn(&Row) -> Yaw<f64>;

const ALPHA: PickedParameter = ("alpha", |p| p.alpha, |p| p.alpha);
const BETA_R: PickedParameter = ("beta_r", |p| p.beta_r, |p| p.beta_r);
const BETA_RR: PickedParameter = ("beta_rr", |p| p.beta_rr, |p| p.beta_rr);

/// A column of Table 4, recomputed after a change to the oscillation, with its value at the printed inputs.
struct RecomputedColumn<'a> {
    table: &'a PrintedTable,
    regenerated: &'a Table4,
    change: InputChange<'a>,
    value: Value<'a>,
    parameter: PickedParameter,
}

impl RecomputedColumn<'_> {
    fn group(&self, name: &str, note: &str) -> Result<Group, PaperError> {
        let (parameter, value_of, interval_of) = self.parameter;
        let intervals = self.table.printed_intervals();
        let rows = self.table.experiments().iter().zip(&self.regenerated.rows).zip(&intervals);
        let items = rows.map(|((experiment, row), printed)| {
            let mut oscillation = oscillation(&self.table.intervals(experiment));
            (self.change)(&mut oscillation);
            let range = interval_of(&recomputed(experiment.number, &oscillation)?);
            let item = format!("experiment {}: {parameter}", experiment.number);
            let printed = (value_of(&row.printed), interval_of(printed));
            Ok(Item::new(item, printed, (value_of(&(self.value)(row)), range), note))
        });
        Ok(Group { name: name.to_owned(), note: note.to_owned(), items: items.collect::<Result<_, PaperError>>()? })
    }
}

/// The parameters of each experiment without its bias.
fn unbiased(table: &PrintedTable) -> Result<Vec<(u32, Yaw<f64>)>, PaperError> {
    let row = |row: &Experiment| {
        let oscillation = Oscillation { bias: 0.0, ..oscillation(&values(row)) };
        Ok((row.number, recomputed(row.number, &oscillation)?))
    };
    table.experiments().iter().map(row).collect()
}

/// The amplitude that the printed drag parameters imply: `beta_r/beta_rr` is proportional to it, for any relay, bias and delay.
fn amplitudes(table: &PrintedTable) -> Result<Group, PaperError> {
    let note = "implied by beta_r/beta_rr: row 9 is 36.57, not 3657";
    let rows = table.experiments().iter().zip(table.printed_intervals()).zip(table.printed());
    let items = rows.map(|((row, printed), value)| {
        let at = row.amplitude.value();
        let ratio = |yaw: Yaw<f64>| yaw.beta_r / yaw.beta_rr;
        let implied = at * ratio(value) / ratio(recomputed(row.number, &oscillation(&values(row)))?);
        // The amplitude itself cancels, so it may stand for its interval.
        let oscillation = Oscillation { amplitude: Interval::point(at), ..oscillation(&table.intervals(row)) };
        let exact = recomputed(row.number, &oscillation)?;
        let range = Interval::point(at) * (printed.beta_r / printed.beta_rr) / (exact.beta_r / exact.beta_rr);
        let known = row.amplitude.interval(table.decimals(|row| row.amplitude));
        Ok(Item::new(format!("experiment {}: X_m", row.number), (at, known), (implied, range), note))
    });
    Ok(Group { name: "X_m".to_owned(), note: note.to_owned(), items: items.collect::<Result<_, PaperError>>()? })
}

/// A number recomputed for a statement of that name: its value and its range.
type Recomputation = (String, f64, Interval);

/// The numbers printed outside the rows of Table 4.
fn stated(table: &PrintedTable) -> Result<[Group; 4], PaperError> {
    let (printed, intervals) = (table.printed(), table.printed_intervals());
    let column = |name: &str, values: Yaw<f64>, ranges: Yaw<Interval>| -> Vec<Recomputation> {
        let named = values.named().into_iter().zip(ranges.named());
        named.map(|((parameter, value), (_, range))| (format!("{name} of {parameter}"), value, range)).collect()
    };
    let spreads = column("spread", spreads_percent(&printed), spreads_percent(&intervals));
    let text = spreads.iter().filter(|spread| spread.0.ends_with("beta_rr"));
    let text: Vec<Recomputation> =
        text.map(|(name, value, range)| (format!("{name} in the text"), *value, *range)).collect();
    let mut last_rows = column("mean", means(&printed), means(&intervals));
    last_rows.extend(spreads);
    let (bars, words) = figure15(table)?;
    let statements = statements()?;
    let group = |name: &str, note: &str, items: Vec<Recomputation>| -> Result<Group, PaperError> {
        let items = items.into_iter().map(|item| against(&statements, item)).collect::<Result<_, PaperError>>()?;
        Ok(Group { name: name.to_owned(), note: note.to_owned(), items })
    };
    Ok([
        group("last rows of Table 4", "mean, and standard deviation (n - 1) over it", last_rows)?,
        group("spread in the text", "of beta_rr: contradicts the table's own last row", text)?,
        group("Fig. 15", "counted with eq. 41's sqrt(2), from printed rows", bars)?,
        group("words on Fig. 15", "each follows from the counts", words)?,
    ])
}

/// The bars of Fig. 15, and the text's figures of them.
fn figure15(table: &PrintedTable) -> Result<(Vec<Recomputation>, Vec<Recomputation>), PaperError> {
    let levels: Vec<f64> = table.experiments().iter().map(|row| row.relay_level.value()).collect();
    let (pairs, ranges) = (Pairs::new(&levels, &table.printed())?, Pairs::new(&levels, &table.printed_intervals())?);
    #[allow(clippy::cast_precision_loss, reason = "a number of pairs")]
    let total = pairs.len() as f64;
    let (mut bars, mut words) = (vec![("pairs".to_owned(), total, Interval::point(total))], Vec::new());
    for criterion in &CRITERIA {
        let counts = pairs.counts(criterion, crate::identify::fit::select::pairwise::relative_spread_percent);
        let (certain, possible) = ranges.count_ranges(criterion);
        let bar = |of: fn(&Counts) -> u32| {
            let range = Interval::from(f64::from(of(&certain))).hull(Interval::from(f64::from(of(&possible))));
            (f64::from(of(&counts)), range)
        };
        let (correct, wrong, undecided) = (bar(|c| c.correct), bar(|c| c.wrong), bar(|c| c.undecided));
        let name = |what: &str| format!("criterion {} {what}", criterion.number);
        for (what, bar) in [("correct", correct), ("wrong", wrong), ("undecided", undecided)] {
            bars.push((name(what), bar.0, bar.1));
        }
        let percent =
            |bar: (f64, Interval)| (100.0 * bar.0 / total, Interval::point(100.0) * bar.1 / Interval::point(total));
        let mut word = |what: &str, (value, range)| words.push((name(what), value, range));
        match criterion.number {
            1 => word("share correct", percent(correct)),
            2 => word("share undecided", percent(undecided)),
            _ => {}
        }
        word("correct over wrong", (correct.0 / wrong.0, correct.1 / wrong.1));
    }
    Ok((bars, words))
}

fn against(statements: &[Statement], (item, value, range): Recomputation) -> Result<Item, PaperError> {
    let statement = statements.iter().find(|statement| statement.item == item);
    let known = statement.and_then(|s| Some((s, Interval::new(s.lowest, s.highest)?)));
    let Some((statement, known)) = known else {
        return Err(PaperError::Missing { fixture: "printed.csv", missing: format!("item `{item}`") });
    };
    Ok(Item::new(item, (statement.printed, known), (value, range), &statement.place))
}
