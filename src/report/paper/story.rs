//! What the regenerated numbers say, in sentences, for who does not want the rows.

use super::Reproduction;
use crate::paper::audit::Group;
use crate::report::{Cell, Section};

impl Reproduction {
    /// The outcome in a few paragraphs, every number in them taken from the tables that follow.
    #[must_use]
    pub fn story(&self) -> Section {
        let agreeing: usize = self.audit.iter().map(Group::agreeing).sum();
        let printed: usize = self.audit.iter().map(|group| group.items.len()).sum();
        let (mean, recomputed) = (self.table4.mean.alpha, self.table4.recomputed_mean.alpha);
        let paragraphs = vec![
            format!(
                "The paper prints numbers that follow from others that it prints. {printed} comparisons were made, in intervals: \
                 an input is known to half a unit of its last decimal, and a number agrees where it meets the range that such \
                 inputs allow. {agreeing} agree."
            ),
            format!(
                "The drag can be had from the printed inputs: linear drag in {} experiments, quadratic drag in {}, with the \
                 printed bias and a delay of 0.2 s. Without the bias it is {} and {}, so that the bias was used.",
                self.tally("beta_r"),
                self.tally("beta_rr"),
                self.tally("beta_r, x_0 = 0"),
                self.tally("beta_rr, x_0 = 0"),
            ),
            format!(
                "The inertia cannot: {} experiments agree. What is printed exceeds what is computed by a factor that depends on \
                 the relay level alone; with {:.3}e-2 N m added to each level, {} agree. The cause is not known. The mean over \
                 the experiments is {mean:.2}e-4 as printed and {recomputed:.2}e-4 as recomputed.",
                self.tally("alpha"),
                self.table4.level_offset,
                self.tally("alpha, C raised"),
            ),
            self.drag_law(),
        ];
        let open = |group: &&Group| group.agreeing() < group.items.len();
        let table =
            super::Table::new("disagreements", "Where print and computation part", &["quantity", "agree", "why"]);
        let table = self.audit.iter().filter(open).fold(table, |table, group| {
            table.row([group.name.as_str(), &self.tally(&group.name), &group.note].map(Cell::from))
        });
        Section { title: "What was found".to_owned(), paragraphs, tables: vec![table], ..Section::default() }
    }

    /// How many of a group agree; nothing of a group that is not there.
    fn tally(&self, name: &str) -> String {
        let group = self.audit.iter().find(|group| group.name == name);
        group.map_or_else(String::new, |group| format!("{} of {}", group.agreeing(), group.items.len()))
    }

    fn drag_law(&self) -> String {
        let pairs = self.figure15.first().map_or_else(String::new, |counts| {
            let pairs = counts.correct + counts.wrong + counts.undecided;
            format!(
                "Of {pairs} pairs of experiments with different relay levels, the paper's rule takes quadratic drag in {} and \
                 linear drag in {}. ",
                counts.correct, counts.wrong
            )
        });
        let estimated = self.joint.iter().filter(|row| row.delay_interval_s.is_some());
        let fits: Vec<String> = estimated
            .map(|row| {
                format!("{} drag {:.1} % with a delay of {:.2} s", row.drag, 100.0 * row.residual_rms, row.delay_s)
            })
            .collect();
        format!(
            "{pairs}All experiments together, by exact limit cycles and with the delay estimated too, leave residuals of: {}.",
            fits.join(", ")
        )
    }
}
