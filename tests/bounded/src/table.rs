//! Figures of several kinds, as Markdown.

use core::fmt::{Display, Formatter, Result};

use selfosc::identify::bounded::Consistency;

use crate::case::Outcome;

/// One line for each kind.
#[derive(Debug, Default)]
pub(crate) struct Table(Vec<String>);

fn quantile(values: &mut [f64], share: f64) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let last = values.len().checked_sub(1)?;
    values.get((share * last as f64).round() as usize).copied()
}

fn shown(values: &mut [f64], shares: &[f64], digits: usize) -> String {
    let each =
        shares.iter().map(|share| quantile(values, *share).map_or("-".into(), |value| format!("{value:.digits$}")));
    each.collect::<Vec<_>>().join(" / ")
}

impl Table {
    pub(crate) fn add(&mut self, name: &str, outcomes: &[Outcome]) {
        let of = |verdict| outcomes.iter().filter(|outcome| outcome.verdict() == Some(verdict)).count();
        let missed = outcomes.iter().filter(|outcome| !outcome.missed.is_empty()).count();
        let errors = outcomes.iter().filter(|outcome| outcome.found.is_err()).count();
        let consistent = || outcomes.iter().filter(|outcome| outcome.verdict() == Some(Consistency::Consistent));
        let mut ratios: Vec<f64> = consistent().filter_map(|outcome| outcome.ratio).collect();
        let mut widths: Vec<f64> = consistent().filter_map(|outcome| Some(100.0 * outcome.half_width?)).collect();
        let mut seconds: Vec<f64> = outcomes.iter().map(|outcome| outcome.seconds).collect();
        let quartiles = [0.25, 0.5, 0.75];
        self.0.push(format!(
            "| {name} | {} | {} | {} | {} | {missed} | {errors} | {} | {} | {} | {} |",
            outcomes.len(),
            of(Consistency::Consistent),
            of(Consistency::Refuted),
            of(Consistency::Undecided),
            shown(&mut ratios, &quartiles, 2),
            shown(&mut ratios, &[1.0], 1),
            shown(&mut widths, &[0.5], 3),
            shown(&mut seconds, &[0.5, 0.9, 1.0], 2),
        ));
    }
}

impl Display for Table {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        writeln!(
            f,
            "| kind | records | consistent | refuted | undecided | truth outside | refused | width over 95 %, quartiles | worst | alpha, half-width, % | time, s: median / 90 % / most |"
        )?;
        writeln!(f, "|---|---|---|---|---|---|---|---|---|---|---|")?;
        self.0.iter().try_for_each(|line| writeln!(f, "{line}"))
    }
}
