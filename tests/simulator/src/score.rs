//! Scores of a tool over kinds of records, as a table in Markdown.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;

use rayon::prelude::*;

use crate::answer::{Answer, Trust};
use crate::kinds::{Case, FIRST_REPORT_SEED, Group, Kind};

/// What to score; the command line of a binding.
#[derive(Clone, Debug, clap::Args)]
pub struct Selection {
    /// Cases of each kind.
    #[arg(long, default_value_t = 20)]
    pub records: u64,
    /// First seed. Seeds from 1000000 on are for reports: never develop on them.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Only kinds with this in their name, in this order; may be given several times.
    #[arg(long)]
    pub kind: Vec<String>,
    /// Only this group: inside, family, outside, unshowable or several.
    #[arg(long)]
    pub group: Option<String>,
    /// Markdown file to write; standard output without it.
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// Threads.
    #[arg(long, default_value_t = 2)]
    pub threads: usize,
    /// Prints every trusted answer that misses, every doubtful and every refused one, with its seed.
    #[arg(long)]
    pub list: bool,
}

/// Figures of one kind, or of several together.
#[derive(Clone, Debug, Default)]
pub struct Score {
    /// Cases.
    pub cases: usize,
    /// Trusted answers.
    pub trusted: usize,
    /// Trusted answers whose interval misses alpha.
    pub missed: usize,
    /// Answers of trust `good` among the trusted.
    pub good: usize,
    /// Doubtful answers.
    pub doubtful: usize,
    /// Refused cases.
    pub refused: usize,
    /// Relative errors of alpha of all answers, doubtful ones too.
    pub errors: Vec<f64>,
    /// Half-widths of trusted intervals over the true alpha.
    pub half_widths: Vec<f64>,
    /// Widths of trusted intervals over those of a fit of the true structure, of records without rounding.
    pub ratios: Vec<f64>,
    /// The same of rounded records, whose rounding the reference takes as white noise.
    pub ratios_rounded: Vec<f64>,
    /// For each parameter, intervals of trusted answers that hold the truth, and all of them.
    pub coverage: BTreeMap<&'static str, (usize, usize)>,
    /// How often each reason was given.
    pub reasons: BTreeMap<String, usize>,
}

/// Half the width of a 95 % interval in standard deviations.
const NORMAL_95: f64 = 1.96;

impl Score {
    /// Counts an answer.
    pub fn count(&mut self, case: &Case, answer: &Answer) {
        self.cases += 1;
        for reason in &answer.reasons {
            *self.reasons.entry(reason.to_string()).or_default() += 1;
        }
        let held = answer.holds_alpha(&case.truths);
        self.errors.extend(answer.alpha.map(|alpha| (alpha.value / case.truths[0].alpha - 1.0).abs()));
        match (answer.trust, answer.alpha, held) {
            (Trust::Doubtful, ..) => self.doubtful += 1,
            (Trust::Good | Trust::Widened, Some(alpha), Some(held)) => {
                self.trusted += 1;
                self.good += usize::from(answer.trust == Trust::Good);
                self.missed += usize::from(!held);
                let truth = case.truths[0].alpha;
                self.half_widths.push(alpha.half_width() / truth);
                if let Some(std) = case.reference_std_alpha() {
                    let rounded = case.runs.iter().any(|run| run.scenario.sensor.quantum > 0.0);
                    let ratios = if rounded { &mut self.ratios_rounded } else { &mut self.ratios };
                    ratios.push(alpha.half_width() / (NORMAL_95 * std));
                }
                for (parameter, held) in answer.coverage(case) {
                    let (hits, all) = self.coverage.entry(parameter).or_default();
                    *hits += usize::from(held);
                    *all += 1;
                }
            }
            _ => self.refused += 1,
        }
    }

    /// Adds the figures of another score.
    pub fn add(&mut self, other: &Self) {
        self.cases += other.cases;
        self.trusted += other.trusted;
        self.missed += other.missed;
        self.good += other.good;
        self.doubtful += other.doubtful;
        self.refused += other.refused;
        self.errors.extend(&other.errors);
        self.half_widths.extend(&other.half_widths);
        self.ratios.extend(&other.ratios);
        self.ratios_rounded.extend(&other.ratios_rounded);
        for (parameter, (hits, all)) in &other.coverage {
            let sum = self.coverage.entry(parameter).or_default();
            *sum = (sum.0 + hits, sum.1 + all);
        }
        for (reason, count) in &other.reasons {
            *self.reasons.entry(reason.clone()).or_default() += count;
        }
    }

    /// Share of trusted answers that miss, in percent; `None` without a trusted answer.
    #[must_use]
    pub fn missed_percent(&self) -> Option<f64> {
        percent(self.missed, self.trusted)
    }

    /// Share of cases with an answer that is trusted and right, in percent.
    #[must_use]
    pub fn right_percent(&self) -> Option<f64> {
        percent(self.trusted - self.missed, self.cases)
    }

    fn row(&self, name: &str) -> String {
        let reasons: Vec<(&String, &usize)> = {
            let mut reasons: Vec<_> = self.reasons.iter().collect();
            reasons.sort_by(|a, b| b.1.cmp(a.1).then(a.0.cmp(b.0)));
            reasons.truncate(2);
            reasons
        };
        let reasons: Vec<String> = reasons.iter().map(|(reason, count)| format!("{reason} {count}")).collect();
        format!(
            "| {name} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
            self.cases,
            show(self.right_percent(), 0),
            show(self.missed_percent(), 1),
            show(percent(self.good, self.cases), 0),
            show(percent(self.doubtful, self.cases), 0),
            show(percent(self.refused, self.cases), 0),
            show(median(&self.errors).map(|error| 100.0 * error), 2),
            show(median(&self.half_widths).map(|width| 100.0 * width), 2),
            show(median(&self.ratios), 2),
            show(median(&self.ratios_rounded), 2),
            reasons.join(", "),
        )
    }
}

#[allow(clippy::cast_precision_loss, reason = "counts")]
fn percent(part: usize, whole: usize) -> Option<f64> {
    (whole > 0).then(|| 100.0 * part as f64 / whole as f64)
}

fn show(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.digits$}"))
}

/// The middle value, the mean of the two middle ones of an even number; `None` of nothing.
#[must_use]
pub fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let upper = *sorted.get(sorted.len() / 2)?;
    let lower = sorted[(sorted.len() - 1) / 2];
    Some(0.5 * (lower + upper))
}

/// The scores of the kinds selected.
#[derive(Clone, Debug)]
pub struct Table {
    kinds: Vec<(Kind, Score)>,
    records: u64,
    seed: u64,
}

impl Table {
    /// Asks a tool about every case selected.
    ///
    /// # Errors
    /// A name or group that no kind has, or no thread to work with.
    pub fn of(
        selection: &Selection,
        identify: impl Fn(&Case) -> Answer + Sync,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let group = |kind: &Kind| format!("{:?}", kind.group).to_lowercase();
        let mut kinds: Vec<Kind> = Vec::new();
        if selection.kind.is_empty() {
            kinds = Kind::all();
        }
        for name in &selection.kind {
            for kind in Kind::matching(name)? {
                if !kinds.iter().any(|other| other.name == kind.name) {
                    kinds.push(kind);
                }
            }
        }
        kinds.retain(|kind| selection.group.as_ref().is_none_or(|wanted| *wanted == group(kind)));
        if kinds.is_empty() {
            return Err("no kind is of this group: inside, family, outside, unshowable, several".into());
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(selection.threads).build()?;
        let seeds = selection.seed..selection.seed + selection.records;
        let of_kind = |kind: Kind| {
            let cases: Vec<(Case, Answer)> = seeds
                .clone()
                .into_par_iter()
                .map(|seed| {
                    let case = kind.case(seed);
                    let answer = identify(&case);
                    (case, answer)
                })
                .collect();
            let mut score = Score::default();
            for (case, answer) in &cases {
                score.count(case, answer);
                let missed = answer.holds_alpha(&case.truths) == Some(false);
                if selection.list && (missed || !answer.trust.is_trusted()) {
                    println!(
                        "{} seed {}: {:?} {:?}, alpha {} answered {:?}",
                        kind.name, case.seed, answer.trust, answer.reasons, case.truths[0].alpha, answer.alpha
                    );
                }
            }
            eprint!("{}", score.row(kind.name));
            (kind, score)
        };
        let mut table = Self { kinds: Vec::new(), records: selection.records, seed: selection.seed };
        for kind in kinds {
            table.kinds.push(pool.install(|| of_kind(kind)));
            // A long run that is ended leaves a table of the kinds it got through.
            if let Some(path) = &selection.out {
                std::fs::write(path, table.markdown())?;
            }
        }
        Ok(table)
    }

    /// The score of a kind.
    #[must_use]
    pub fn kind(&self, name: &str) -> Option<&Score> {
        self.kinds.iter().find(|(kind, _)| kind.name == name).map(|(_, score)| score)
    }

    /// The figures of a group together.
    #[must_use]
    pub fn group(&self, group: Group) -> Score {
        self.pooled(|kind| kind.group == group)
    }

    fn pooled(&self, wanted: impl Fn(&Kind) -> bool) -> Score {
        let mut all = Score::default();
        self.kinds.iter().filter(|(kind, _)| wanted(kind)).for_each(|(_, score)| all.add(score));
        all
    }

    /// The table in Markdown.
    #[must_use]
    pub fn markdown(&self) -> String {
        const HEAD: &str = "| kind | cases | right % | missed % | good % | doubtful % | refused % | error % | half-width % | \
                            width | width, rounded | reasons |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
        let last = self.seed + self.records - 1;
        let purpose = if self.seed >= FIRST_REPORT_SEED { "report" } else { "development" };
        let mut text = format!(
            "Seeds {} to {last} ({purpose}). *Right*: share of all cases with a trusted answer (`good` or `widened`) whose 95 % \
             interval holds alpha. *Missed*: share of the trusted answers that do not. *Error*: median over all answers, \
             doubtful ones too; *half-width*: median over trusted ones. *Width*: median of the interval's width over that of a fit that knows the true structure \
             (Cramér-Rao); on rounded records the reference takes the rounding as white noise, which a fit that uses the \
             rounding itself betters.\n\n## Groups\n\n{HEAD}",
            self.seed
        );
        for group in Group::ALL {
            let score = self.group(group);
            if score.cases > 0 {
                text += &Score { reasons: BTreeMap::new(), ..score }.row(group.title());
            }
        }
        let showable = self.pooled(|kind| kind.group != Group::Unshowable);
        text += &Score { reasons: BTreeMap::new(), ..showable }.row("All that a record can show");
        for group in Group::ALL {
            let kinds: Vec<_> = self.kinds.iter().filter(|(kind, _)| kind.group == group).collect();
            if kinds.is_empty() {
                continue;
            }
            let _ = write!(text, "\n## {}\n\n{HEAD}", group.title());
            for (kind, score) in kinds {
                text += &score.row(kind.name);
            }
        }
        text += "\n## Coverage of every parameter\n\nShare of trusted intervals that hold the truth, in percent (intervals).\n\n";
        let groups = [Group::Inside, Group::Family, Group::Outside, Group::Several];
        text += "| parameter | inside | family | outside | several |\n|---|---|---|---|---|\n";
        let scores = groups.map(|group| self.group(group));
        let parameters: std::collections::BTreeSet<_> = scores.iter().flat_map(|score| score.coverage.keys()).collect();
        for parameter in parameters {
            let cells: Vec<String> = scores
                .iter()
                .map(|score| {
                    let (hits, all) = score.coverage.get(parameter).copied().unwrap_or_default();
                    percent(hits, all).map_or_else(|| "-".to_owned(), |share| format!("{share:.1} ({all})"))
                })
                .collect();
            let _ = writeln!(text, "| {parameter} | {} |", cells.join(" | "));
        }
        text
    }

    /// Writes the table where the selection says.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn publish(&self, selection: &Selection) -> std::io::Result<()> {
        match &selection.out {
            Some(path) => std::fs::write(path, self.markdown()),
            None => {
                println!("{}", self.markdown());
                Ok(())
            }
        }
    }
}
