//! All experiments of Table 4 together: one vehicle, exact limit cycles in place of first harmonics.

use serde::Serialize;

use super::PaperError;
use super::table4::{DELAY_S, PrintedTable, oscillation, values};
use crate::identify::answer::AxisParameter;
use crate::identify::fit::joint::{FeatureRow, fit_rows};
use crate::identify::{Delay, DragLaw, Estimate};

/// 95 % interval (Student's t).
type Range = Option<[f64; 2]>;

/// A drag law fitted to all experiments at once, in the units of Table 4.
///
/// The intervals take the residuals for independent and the drag law for true; a law that is not shows as a larger
/// residual.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointRow {
    /// linear, quadratic or mixed.
    pub drag: &'static str,
    /// Whether the delay was estimated too; else it is that of eq. 36.
    pub delay_estimated: bool,
    /// Inertia, 1e-4 N m/(deg/s^2).
    pub alpha: f64,
    /// Linear drag, 1e-4 N m/(deg/s); `None` where the law has none.
    pub beta: Option<f64>,
    /// Quadratic drag, 1e-5 N m/(deg/s)^2; `None` where the law has none.
    pub beta_quadratic: Option<f64>,
    /// Delay of the whole loop, s.
    pub delay_s: f64,
    /// Root mean square of the residuals of ln T and ln X_m, over the degrees of freedom.
    pub residual_rms: f64,
    /// Interval of the inertia.
    pub alpha_interval: Range,
    /// Interval of the linear drag.
    pub beta_interval: Range,
    /// Interval of the quadratic drag.
    pub beta_quadratic_interval: Range,
    /// Interval of the delay.
    pub delay_interval_s: Range,
}

/// Each drag law with the paper's delay, then each with the delay estimated.
///
/// # Errors
/// [`PaperError::Identify`] where a fit does not settle.
pub fn joint(table: &PrintedTable) -> Result<Vec<JointRow>, PaperError> {
    let rows = table.experiments().iter().map(|row| FeatureRow::new(&oscillation(&values(row))));
    let rows = rows.collect::<Result<Vec<_>, _>>()?;
    let delays = [Delay::KnownS(DELAY_S), Delay::Estimated];
    let cases = delays.into_iter().flat_map(|delay| DragLaw::ALL.map(|law| (law, delay)));
    cases.map(|(law, delay)| fitted(&rows, law, delay)).collect()
}

fn fitted(rows: &[FeatureRow], law: DragLaw, delay: Delay) -> Result<JointRow, PaperError> {
    let found = fit_rows(rows, law, delay)?;
    let scaled = |parameter, unit: f64| {
        let Estimate { value, spread, .. } = found.estimate(parameter);
        (value * unit, spread.map(|spread| [spread.low * unit, spread.high * unit]))
    };
    // The level is in 1e-2 N m: see Table 4's units.
    let (alpha, alpha_interval) = scaled(AxisParameter::Alpha, 100.0);
    let (beta, beta_interval) = scaled(AxisParameter::LinearDrag, 100.0);
    let (beta_quadratic, beta_quadratic_interval) = scaled(AxisParameter::QuadraticDrag, 1000.0);
    let (delay_s, delay_interval_s) = scaled(AxisParameter::DelayS, 1.0);
    Ok(JointRow {
        drag: law.name(),
        delay_estimated: delay == Delay::Estimated,
        alpha,
        beta: law.has_linear().then_some(beta),
        beta_quadratic: law.has_quadratic().then_some(beta_quadratic),
        delay_s,
        residual_rms: found.residual_rms(),
        alpha_interval,
        beta_interval,
        beta_quadratic_interval,
        delay_interval_s,
    })
}
