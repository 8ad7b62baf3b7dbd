//! Judgements of many loops as one table.

use std::fmt::Write as _;

use super::draw::FIRST_REPORT_SEED;
use super::judge::{Contradiction, Counts, Judgement};

/// A name for each kind of contradiction, in the order of the table.
const KINDS: [&str; 8] = [
    "document unreadable",
    "listed orbit does not exist",
    "number wrong",
    "enclosure misses",
    "verdict wrong",
    "listed twice",
    "stable orbit missing",
    "other orbit missing",
];

fn kind(contradiction: &Contradiction) -> usize {
    match contradiction {
        Contradiction::Unreadable(_) => 0,
        Contradiction::Absent { .. } => 1,
        Contradiction::Value { .. } => 2,
        Contradiction::Enclosure { .. } => 3,
        Contradiction::Verdict { .. } => 4,
        Contradiction::Twice { .. } => 5,
        Contradiction::Missing { starts, .. } if *starts > 0 => 6,
        Contradiction::Missing { .. } => 7,
    }
}

/// Sums of the counts.
#[must_use]
pub fn totals(judgements: &[Judgement]) -> Counts {
    judgements.iter().fold(Counts::default(), |mut sum, judgement| {
        let one = &judgement.counts;
        for (total, count) in [
            (&mut sum.loops, one.loops),
            (&mut sum.answered, one.answered),
            (&mut sum.refused, one.refused),
            (&mut sum.complete, one.complete),
            (&mut sum.listed, one.listed),
            (&mut sum.exist, one.exist),
            (&mut sum.proved, one.proved),
            (&mut sum.verdict_open, one.verdict_open),
            (&mut sum.verdict_right, one.verdict_right),
            (&mut sum.judge_undecided, one.judge_undecided),
            (&mut sum.by_linearisation, one.by_linearisation),
            (&mut sum.reached, one.reached),
            (&mut sum.reached_covered, one.reached_covered),
            (&mut sum.searched_covered, one.searched_covered),
            (&mut sum.long_cycles, one.long_cycles),
            (&mut sum.no_cycle, one.no_cycle),
            (&mut sum.wandering, one.wandering),
            (&mut sum.faults, one.faults),
        ] {
            *total += count;
        }
        sum
    })
}

/// The table in Markdown, and every contradiction with its seed.
#[must_use]
pub fn markdown(judgements: &[Judgement]) -> String {
    let sum = totals(judgements);
    let seeds = || judgements.iter().map(|judgement| judgement.seed);
    let (first, last) = (seeds().min().unwrap_or(0), seeds().max().unwrap_or(0));
    let purpose = if first >= FIRST_REPORT_SEED { "report" } else { "development" };
    let percent = |part: usize, whole: usize| if whole > 0 { 100.0 * part as f64 / whole as f64 } else { 0.0 };
    let mut text =
        format!("# Orbits of relay loops, judged\n\nSeeds {first} to {last} ({purpose}).\n\n| | count |\n|---|---:|\n");
    for (name, count) in [
        ("loops", sum.loops),
        ("answered", sum.answered),
        ("refused", sum.refused),
        ("listings called complete", sum.complete),
        ("orbits listed", sum.listed),
        ("listed orbits that exist to 1e-9", sum.exist),
        ("listed orbits called proved", sum.proved),
        ("verdicts that the disturbed simulation confirms", sum.verdict_right),
        ("of them by the linearised return map alone", sum.by_linearisation),
        ("verdicts left open by the listing", sum.verdict_open),
        ("verdicts left open by the judge", sum.judge_undecided),
        ("cycles reached from 30 starts", sum.reached),
        ("of them of a covered period", sum.reached_covered),
        ("further orbits of a covered period found by search", sum.searched_covered),
        ("cycles with several switchings each way (no orbits of a listing)", sum.long_cycles),
        ("loops in which no start ends on a cycle", sum.no_cycle),
        ("starts without an end in sight", sum.wandering),
        ("faults of the judge", sum.faults),
    ] {
        let _ = writeln!(text, "| {name} | {count} |");
    }
    let _ = writeln!(text, "\nVerdicts left open by the listing: {:.2} %.", percent(sum.verdict_open, sum.exist));
    for order in 1..=3 {
        let mut seconds: Vec<f64> =
            judgements.iter().filter(|one| one.order == order).filter_map(|one| one.seconds).collect();
        seconds.sort_by(f64::total_cmp);
        if let (Some(median), Some(most)) = (seconds.get(seconds.len() / 2), seconds.last()) {
            let _ = writeln!(
                text,
                "Order {order}: median {median:.3} s, most {most:.3} s an answer ({} loops).",
                seconds.len()
            );
        }
    }
    let _ = writeln!(text, "\n| contradiction | count | loops |\n|---|---:|---:|");
    for (index, name) in KINDS.iter().enumerate() {
        let of = |judgement: &Judgement| judgement.contradictions.iter().filter(|one| kind(one) == index).count();
        let count: usize = judgements.iter().map(of).sum();
        let _ = writeln!(text, "| {name} | {count} | {} |", judgements.iter().filter(|one| of(one) > 0).count());
    }
    text.push('\n');
    for judgement in judgements {
        for contradiction in &judgement.contradictions {
            let _ = writeln!(text, "- seed {}: {contradiction}", judgement.seed);
        }
    }
    text
}
