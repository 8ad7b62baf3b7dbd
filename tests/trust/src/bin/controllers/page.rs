//! The figures, and the page that shows them.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::judge::Design;

/// A phase margin that is stated larger by more than this counts, rad.
const OVERSTATED_RAD: f64 = 0.05;
/// An offset that is further from the simulated one counts.
const OFFSET_SHARE: f64 = 0.02;

/// What became of a trusted model.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tried {
    pub(crate) bandwidth_rad_s: Option<f64>,
    pub(crate) refusals: Vec<String>,
    stated_phase_rad: Option<f64>,
    stated_offset: f64,
    pub(crate) true_phase_rad: f64,
    pub(crate) simulated_offset: Option<f64>,
}

impl Tried {
    pub(crate) fn accepted(&mut self, bandwidth_rad_s: f64, design: &Design) {
        self.bandwidth_rad_s = Some(bandwidth_rad_s);
        (self.stated_phase_rad, self.stated_offset) = (design.stated_phase_rad, design.stated_offset);
    }

    fn overstated(&self) -> Option<f64> {
        self.stated_phase_rad.map(|stated| stated - self.true_phase_rad)
    }

    fn is_overstated(&self) -> bool {
        self.overstated().is_some_and(|excess| excess > OVERSTATED_RAD)
    }

    fn offset_error(&self) -> Option<f64> {
        let simulated = self.simulated_offset.filter(|offset| *offset != 0.0)?;
        Some((self.stated_offset / simulated - 1.0).abs())
    }

    pub(crate) fn is_remarkable(&self) -> bool {
        let accepted = self.bandwidth_rad_s.is_some();
        let wrong_offset = self.offset_error().is_some_and(|error| error > OFFSET_SHARE);
        !accepted || self.is_overstated() || wrong_offset || self.stated_phase_rad.is_none()
    }
}

/// All that was tried, by kind.
#[derive(Default)]
pub(crate) struct Score {
    kinds: BTreeMap<&'static str, Vec<Tried>>,
}

impl Score {
    pub(crate) fn count(&mut self, kind: &'static str, tried: Tried) {
        self.kinds.entry(kind).or_default().push(tried);
    }

    pub(crate) fn models(&self) -> usize {
        self.kinds.values().map(Vec::len).sum()
    }

    pub(crate) fn page(&self, seed: u64) -> String {
        let all: Vec<&Tried> = self.kinds.values().flatten().collect();
        let mut page = format!(
            "# Controllers from identified models\n\n\
             Each record of the simulator is identified and its model, if trusted, tuned for as a user would: \
             `selfosc identify LOG --json > RESULT.json`,\n`selfosc tune --model RESULT.json --bandwidth 0.8`, a PD. A bandwidth that is \
             refused is replaced by the one that the refusal names. \
             The vehicle that made the record then has its own margins: its transfer function about every speed up to the top speed of \
             the design, by complex arithmetic and the argument\nprinciple. The printed offset is compared with the motion of the model \
             under the gains, by Euler steps. Neither shares anything with the design.\n\n    \
             cargo run --release -p selfosc-trust --bin controllers -- --models {} --seed {seed} --out spec/controller.md\n\n",
            all.len()
        );
        page.push_str(
            "| kind | models | accepted | at 0.8 rad/s | margin not proved | overstated by > 0.05 rad | largest excess / rad | \
             offset off by > 2 % |\n|---|---|---|---|---|---|---|---|\n",
        );
        for (kind, tried) in &self.kinds {
            row(&mut page, kind, &tried.iter().collect::<Vec<_>>());
        }
        row(&mut page, "**all**", &all);
        page
    }
}

fn row(page: &mut String, kind: &str, tried: &[&Tried]) {
    let count = |of: &dyn Fn(&Tried) -> bool| tried.iter().filter(|one| of(one)).count();
    let accepted = count(&|one| one.bandwidth_rad_s.is_some());
    let excess = tried.iter().filter_map(|one| one.overstated()).fold(f64::NEG_INFINITY, f64::max);
    let _ = writeln!(
        page,
        "| {kind} | {} | {accepted} | {} | {} | {} | {excess:.3} | {} |",
        tried.len(),
        count(&|one| one.bandwidth_rad_s.is_some() && one.refusals.is_empty()),
        count(&|one| one.bandwidth_rad_s.is_some() && one.stated_phase_rad.is_none()),
        count(&Tried::is_overstated),
        count(&|one| one.offset_error().is_some_and(|error| error > OFFSET_SHARE)),
    );
}
