//! Table 4: parameters of the yaw axis from 19 experiments, in the table's own units.

use serde::Serialize;

use super::fixtures::{self, Experiment};
use super::{PaperError, Printed};
use crate::identify::iso::Oscillation;
use crate::numeric::{Interval, Real};

/// Delay of the whole loop: a step of 0.1 s each way (eq. 36).
pub const DELAY_S: f64 = 0.2;

/// Parameters of the yaw axis: 1e-4 N m/(deg/s^2), 1e-4 N m/(deg/s), 1e-5 N m/(deg/s)^2; or a spread of each in percent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Yaw<T> {
    /// Inertia.
    pub alpha: T,
    /// Linear drag.
    pub beta_r: T,
    /// Quadratic drag.
    pub beta_rr: T,
}

impl<T> Yaw<T> {
    /// The same of each parameter of several.
    fn of_columns<U>(rows: &[Self], of: impl Fn(Vec<T>) -> U) -> Yaw<U>
    where
        T: Copy,
    {
        Yaw {
            alpha: of(rows.iter().map(|row| row.alpha).collect()),
            beta_r: of(rows.iter().map(|row| row.beta_r).collect()),
            beta_rr: of(rows.iter().map(|row| row.beta_rr).collect()),
        }
    }

    /// The same of each parameter with that of another.
    pub(super) fn with<U, V>(self, other: Yaw<U>, of: impl Fn(T, U) -> V) -> Yaw<V> {
        Yaw {
            alpha: of(self.alpha, other.alpha),
            beta_r: of(self.beta_r, other.beta_r),
            beta_rr: of(self.beta_rr, other.beta_rr),
        }
    }

    /// Name, in Table 4, of each parameter with its value.
    #[must_use]
    pub fn named(self) -> [(&'static str, T); 3] {
        [("alpha", self.alpha), ("beta_r", self.beta_r), ("beta_rr", self.beta_rr)]
    }
}

/// The printed table with the decimals that its columns have.
#[derive(Clone, Debug, PartialEq)]
pub struct PrintedTable {
    experiments: Vec<Experiment>,
}

/// A column of the table.
pub(super) type Column = fn(&Experiment) -> Printed;

impl PrintedTable {
    /// From the compiled-in file.
    ///
    /// # Errors
    /// As [`fixtures::table4`].
    pub fn compiled_in() -> Result<Self, PaperError> {
        Self::new(fixtures::table4()?)
    }

    /// From rows.
    ///
    /// # Errors
    /// [`PaperError::Missing`] for fewer than two experiments, which have no spread.
    pub fn new(experiments: Vec<Experiment>) -> Result<Self, PaperError> {
        if experiments.len() < 2 {
            return Err(PaperError::Missing { fixture: "table4.csv", missing: "two experiments".to_owned() });
        }
        Ok(Self { experiments })
    }

    /// Its rows.
    #[must_use]
    pub fn experiments(&self) -> &[Experiment] {
        &self.experiments
    }

    /// Decimals of a column: the most of any row, as the table omits trailing zeros.
    pub(super) fn decimals(&self, column: Column) -> u32 {
        self.experiments.iter().map(|row| column(row).decimals()).max().unwrap_or(0)
    }

    /// Reads a row's cells as the intervals they stand for.
    pub(super) fn intervals(&self, row: &Experiment) -> impl Fn(Column) -> Interval {
        self.within(row, 1.0)
    }

    /// Reads a row's cells as intervals: `half_units` half units of the last decimal either way.
    pub(super) fn within(&self, row: &Experiment, half_units: f64) -> impl Fn(Column) -> Interval {
        move |column| column(row).within(self.decimals(column), half_units)
    }

    /// The parameters as printed, row by row.
    #[must_use]
    pub fn printed(&self) -> Vec<Yaw<f64>> {
        self.experiments.iter().map(|row| printed(&values(row))).collect()
    }

    /// The parameters as printed, each as the interval it stands for.
    #[must_use]
    pub fn printed_intervals(&self) -> Vec<Yaw<Interval>> {
        self.experiments.iter().map(|row| printed(&self.intervals(row))).collect()
    }
}

/// Reads a row's cells as numbers.
pub(super) fn values(row: &Experiment) -> impl Fn(Column) -> f64 {
    |column| column(row).value()
}

pub(super) fn printed<T>(read: &impl Fn(Column) -> T) -> Yaw<T> {
    Yaw { alpha: read(|row| row.alpha), beta_r: read(|row| row.beta_r), beta_rr: read(|row| row.beta_rr) }
}

/// The oscillation of a row, its cells read by `read`.
pub(super) fn oscillation<T: Real>(read: &impl Fn(Column) -> T) -> Oscillation<T> {
    Oscillation {
        relay_level: read(|row| row.relay_level),
        switch_level: read(|row| row.switch_level),
        amplitude: read(|row| row.amplitude),
        bias: read(|row| row.bias),
        period_s: read(|row| row.period),
        delay_s: T::from_f64(DELAY_S),
    }
}

/// The parameters of an oscillation in the table's units: Table 3 with eq. 34.
///
/// # Errors
/// [`PaperError::Experiment`] where the method does not take the oscillation.
pub(super) fn recomputed<T: Real>(experiment: u32, oscillation: &Oscillation<T>) -> Result<Yaw<T>, PaperError> {
    let parameters = oscillation.identify().map_err(|cause| PaperError::Experiment { experiment, cause })?;
    Ok(Yaw {
        alpha: parameters.alpha * T::from_f64(100.0),
        beta_r: parameters.beta * T::from_f64(100.0),
        beta_rr: parameters.beta_quadratic * T::from_f64(1000.0),
    })
}

/// A row of the regenerated table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Number of the experiment.
    pub experiment: u32,
    /// Recomputed parameters.
    #[serde(flatten)]
    pub recomputed: Yaw<f64>,
    /// Recomputed inertia with the relay level raised by [`Table4::level_offset`].
    pub alpha_raised: f64,
    /// Parameters as printed.
    pub printed: Yaw<f64>,
}

/// Table 4 regenerated.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Table4 {
    /// A row for each experiment.
    pub rows: Vec<Row>,
    /// Means of the printed rows.
    pub mean: Yaw<f64>,
    /// Sample standard deviations (n - 1) of the printed rows over their means, in percent.
    pub std_percent: Yaw<f64>,
    /// Means of the recomputed rows.
    pub recomputed_mean: Yaw<f64>,
    /// Sample standard deviations (n - 1) of the recomputed rows over their means, in percent.
    pub recomputed_std_percent: Yaw<f64>,
    /// The constant, in 1e-2 N m, that added to the relay level makes the recomputed inertia fit the printed inertia best.
    pub level_offset: f64,
    /// Root mean square of the fit's residuals, relative to the printed inertia, in percent (n - 1).
    pub level_offset_residual_percent: f64,
}

/// Regenerates Table 4.
///
/// # Errors
/// [`PaperError::Experiment`] where the method does not take a row.
pub fn table4(table: &PrintedTable) -> Result<Table4, PaperError> {
    let experiments = table.experiments();
    let identify = |row: &Experiment, offset: f64| {
        let mut oscillation = oscillation(&values(row));
        oscillation.relay_level += offset;
        recomputed(row.number, &oscillation)
    };
    let fit = level_offset(experiments, |row| identify(row, 0.0))?;
    let rows = experiments
        .iter()
        .map(|row| {
            Ok(Row {
                experiment: row.number,
                recomputed: identify(row, 0.0)?,
                alpha_raised: identify(row, fit)?.alpha,
                printed: printed(&values(row)),
            })
        })
        .collect::<Result<Vec<Row>, PaperError>>()?;
    let printed: Vec<_> = rows.iter().map(|row| row.printed).collect();
    let recomputed: Vec<_> = rows.iter().map(|row| row.recomputed).collect();
    let square_sum: f64 = rows.iter().map(|row| (row.alpha_raised / row.printed.alpha - 1.0).powi(2)).sum();
    Ok(Table4 {
        mean: means(&printed),
        std_percent: spreads_percent(&printed),
        recomputed_mean: means(&recomputed),
        recomputed_std_percent: spreads_percent(&recomputed),
        level_offset: fit,
        level_offset_residual_percent: 100.0 * (square_sum / count::<f64>(rows.len() - 1)).sqrt(),
        rows,
    })
}

/// The constant `c` for which `alpha (C + c)/C` fits the printed alpha best, by least squares of the relative residuals: alpha
/// is proportional to C.
fn level_offset(
    experiments: &[Experiment],
    recomputed: impl Fn(&Experiment) -> Result<Yaw<f64>, PaperError>,
) -> Result<f64, PaperError> {
    let (mut normal, mut right) = (0.0, 0.0);
    for row in experiments {
        let (ratio, level) = (recomputed(row)?.alpha / row.alpha.value(), row.relay_level.value());
        normal += (ratio / level).powi(2);
        right += (1.0 - ratio) * ratio / level;
    }
    Ok(right / normal)
}

/// The mean of each parameter.
pub(super) fn means<T: Real>(rows: &[Yaw<T>]) -> Yaw<T> {
    Yaw::of_columns(rows, |column| mean(&column))
}

/// The sample standard deviation (n - 1) of each parameter over its mean, in percent.
pub(super) fn spreads_percent<T: Real>(rows: &[Yaw<T>]) -> Yaw<T> {
    Yaw::of_columns(rows, |column| {
        let mean = mean(&column);
        let square_sum = column.iter().fold(T::zero(), |sum, &value| sum + (value - mean).square());
        (square_sum / count(column.len() - 1)).sqrt() / mean * T::from_f64(100.0)
    })
}

fn mean<T: Real>(values: &[T]) -> T {
    values.iter().fold(T::zero(), |sum, &value| sum + value) / count(values.len())
}

#[allow(clippy::cast_precision_loss, reason = "a number of rows")]
fn count<T: Real>(rows: usize) -> T {
    T::from_f64(rows as f64)
}
