//! Gains from a relay record, as a page: what to type first, then the record, the loop and its answer to a load.

use super::{Cell, Document, Figure, Mark, Panel, Section, Table, Uncertain};
use crate::autotune::{LoopCurves, ProcessRecord, ProvedGains, Ruled};
use crate::experiment::Log;
use crate::identify::NORMAL_95;
use crate::numeric::significant;

/// Readings that a figure shows, the last of them.
const SHOWN: usize = 1500;
/// Part of the plane that the open loop's figure shows, about -1.
const PLANE: f64 = 2.5;

/// What a page is made of.
#[derive(Clone, Copy, Debug)]
pub struct ProcessPage<'a> {
    /// Name of the record.
    pub name: &'a str,
    /// The record.
    pub log: &'a Log,
    /// The processes that it leaves.
    pub found: &'a ProcessRecord,
    /// The gains, where there are some.
    pub proved: Option<&'a ProvedGains>,
    /// Their curves.
    pub curves: Option<&'a LoopCurves>,
    /// Lines to type, in the form asked for.
    pub lines: Option<&'a str>,
    /// Trust, and the reasons for less than full trust.
    pub trust: (&'a str, &'a [String]),
    /// Rules of thumb.
    pub rules: &'a [Ruled],
}

impl ProcessPage<'_> {
    /// The page, with the lines to type at its top.
    #[must_use]
    pub fn document(&self) -> Document {
        let sections = [self.lines_to_type(), self.record(), self.control_loop(), self.process()];
        Document {
            title: format!("Gains from {}", self.name),
            answer: self.answer(),
            sections: sections.into_iter().flatten().collect(),
            provenance: vec![format!("selfosc {} autotune", env!("CARGO_PKG_VERSION"))],
        }
    }

    fn lines_to_type(&self) -> Option<Section> {
        let rows = self.lines?.lines().map(|line| [line.into()]);
        let table = Table::new("lines", "Type into the controller", &["line"]).rows(rows);
        Some(Section { title: "Gains".to_owned(), tables: vec![table], ..Section::default() })
    }

    /// The gains, how good they are, how sure that is.
    fn answer(&self) -> Vec<String> {
        let (trust, reasons) = self.trust;
        let gains =
            self.lines.map_or_else(|| "No gains.".to_owned(), |lines| lines.lines().collect::<Vec<_>>().join("; "));
        let sure = self.proved.map(|proved| {
            format!(
                "Proved: whichever process of the confidence set is yours, the largest sensitivity is at most {}. At 1.4 a disturbance settles \
                 without ringing; above 2 it rings.",
                significant(proved.sensitivity, 4)
            )
        });
        let words = match trust {
            "good" => "How sure: the record and the model agree.",
            "widened" => "How sure: usable, with wider intervals for these reasons.",
            _ => "How sure: do not use these numbers, for these reasons.",
        };
        [gains].into_iter().chain(sure).chain([words.to_owned()]).chain(reasons.iter().cloned()).collect()
    }

    fn record(&self) -> Option<Section> {
        let record = &self.log.record;
        let (time, output, input) = (record.time_s(), record.output(), record.input());
        let from = time.len().saturating_sub(SHOWN);
        let first = time.len().checked_sub(self.found.residuals.len())?;
        let pairs = |values: &[f64]| -> Vec<(f64, f64)> {
            time.iter().copied().zip(values.iter().copied()).skip(from).collect()
        };
        let model: Vec<(f64, f64)> = (first..time.len())
            .filter(|k| *k >= from)
            .map(|k| (time[k], output[k] - self.found.residuals[k - first]))
            .collect();
        let spread = NORMAL_95 * self.found.residual;
        let band = |sign: f64| model.iter().map(|(t, y)| (*t, y + sign * spread)).collect::<Vec<_>>();
        let [_, output_name, input_name] = &self.log.columns;
        let readings = Panel::new("time (s)", output_name)
            .strip()
            .with("readings", Mark::Points, pairs(output))
            .with("model", Mark::Line, model.clone())
            .with("95 % of the readings", Mark::Dashed, band(1.0))
            .with("", Mark::Dashed, band(-1.0));
        let command: Vec<(f64, f64)> =
            pairs(input).windows(2).flat_map(|pair| [pair[0], (pair[1].0, pair[0].1)]).collect();
        let command = Panel::new("time (s)", input_name).strip().with("command", Mark::Line, command);
        let title = "Record and model".to_owned();
        let caption = "Above, each reading and its prediction by the likeliest process from the readings before; below, the command.";
        let figure = Figure { name: "record", title, caption, panels: vec![readings, command] };
        Some(Section { title: "Record".to_owned(), figures: vec![figure], ..Section::default() })
    }

    fn control_loop(&self) -> Option<Section> {
        let (curves, proved) = (self.curves?, self.proved?);
        let near = |points: &[[f64; 2]]| -> Vec<(f64, f64)> {
            points.iter().map(|[re, im]| (*re, *im)).filter(|(re, im)| libm::hypot(re + 1.0, *im) <= PLANE).collect()
        };
        let circle = (0..=180).map(|k| {
            let angle = f64::from(k) * core::f64::consts::TAU / 180.0;
            (-1.0 + libm::cos(angle) / proved.sensitivity, libm::sin(angle) / proved.sensitivity)
        });
        let all: Vec<(f64, f64)> = curves.open_loops.iter().flat_map(|one| near(one)).collect();
        let plane = Panel::new("real part", "imaginary part")
            .equal_axes()
            .with("ends of the confidence set", Mark::Points, all)
            .with("likeliest process", Mark::Line, near(&curves.open_loop))
            .with("no process enters: the sensitivity's limit", Mark::Dashed, circle)
            .with("critical point", Mark::Dots, [(-1.0, 0.0)]);
        let pairs =
            |values: &mut dyn Iterator<Item = f64>| curves.time_s.iter().copied().zip(values).collect::<Vec<_>>();
        let answer = Panel::new("time (s)", "deviation of the output")
            .strip()
            .with("likeliest process", Mark::Line, pairs(&mut curves.load_step.iter().copied()))
            .with(
                "least and largest at the ends of the confidence set",
                Mark::Dashed,
                pairs(&mut curves.load_step_range.iter().map(|r| r[0])),
            )
            .with("", Mark::Dashed, pairs(&mut curves.load_step_range.iter().map(|r| r[1])));
        let figure =
            |name, title: &str, caption, panel| Figure { name, title: title.to_owned(), caption, panels: vec![panel] };
        let margin = "No curve enters the dashed circle about the critical point: its radius is the proved margin.";
        let load = "Output after a step of the load. The lower the peak and the sooner it is over, the better.";
        let figures = vec![
            figure("nyquist", "Open loop", margin, plane),
            figure("load", "Answer to a load of one command unit", load, answer),
        ];
        Some(Section { title: "Loop".to_owned(), figures, ..Section::default() })
    }

    fn process(&self) -> Option<Section> {
        let columns = ["structure", "evidence %", "parameter", "value \u{b1} 95 %"];
        let mut parameters = Table::new("process", "Processes that the record leaves", &columns);
        for model in &self.found.models {
            for (name, part) in model.family.parameters().iter().zip(&model.parameters) {
                parameters = parameters.row([
                    Cell::Text(model.family.name().to_owned()),
                    Cell::number(100.0 * model.weight, 1),
                    Cell::Text(name.replace("_s", " (s)").replace('_', " ")),
                    Cell::Text(Uncertain::between(part.value, part.low, part.high).to_string()),
                ]);
            }
        }
        let columns = ["rule", "proportional Kp", "integral Ki (1/s)", "derivative Kd (s)", "largest sensitivity"];
        let mut rules = Table::new("rules", "Rules of thumb on the likeliest process", &columns);
        let sign = if self.found.reverse { -1.0 } else { 1.0 };
        for rule in self.rules {
            let [p, i, d] = [rule.gains.proportional(), rule.gains.integral(), rule.gains.derivative()]
                .map(|gain| Cell::Text(significant(sign * gain, 4)));
            let peak = rule.sensitivity.map_or_else(|| "not stable".to_owned(), |peak| significant(peak, 3));
            rules = rules.row([Cell::Text(rule.name.to_owned()), p, i, d, Cell::Text(peak)]);
        }
        Some(Section { title: "Process".to_owned(), tables: vec![parameters, rules], ..Section::default() })
    }
}
