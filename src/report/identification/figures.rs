//! A record with its model.

use super::tables::output_label;
use crate::experiment::Record;
use crate::identify::fit::{Between, FittedRecord};
use crate::identify::{ConfidenceInterval, Estimate, Identification, Model, NORMAL_95, Prediction, Source};
use crate::numeric::significant;
use crate::report::{Figure, Mark, Panel};

/// Samples that a figure shows: more than these cannot be told apart on a page.
const SHOWN: usize = 1500;

/// A model beside a record, at the samples that it predicts and that are no outliers.
pub(super) struct Predicted {
    model: String,
    rms: f64,
    fit_percent: f64,
    time_s: Vec<f64>,
    output: Vec<f64>,
    residual: Vec<f64>,
    command: Vec<f64>,
}

impl Predicted {
    /// Of the reported model, or of the likeliest fit where nothing is reported. `None` without either.
    pub(super) fn of(found: &Identification, index: usize) -> Option<Self> {
        let record = &found.sources()[index].log.record;
        let motion = found.reported().and_then(|reported| reported.predicted_motion(record)).map(|motion| {
            let Prediction { rms, fit_percent, .. } = motion.prediction;
            Self::new("reported model".to_owned(), rms, fit_percent, record, motion.first_sample, &motion.output)
        });
        let fit = found.likeliest_fit().map(|fit| {
            let FittedRecord { residual_rms, fit_percent, first_sample, output, .. } = &fit.records()[index];
            let output: Vec<_> = output.iter().copied().map(Some).collect();
            let name = format!("fit with {} drag", fit.law().name());
            Self::new(name, *residual_rms, *fit_percent, record, *first_sample, &output)
        });
        motion.or(fit)
    }

    fn new(model: String, rms: f64, fit_percent: f64, record: &Record, first: usize, output: &[Option<f64>]) -> Self {
        let samples = (first..).zip(output).filter_map(|(sample, output)| Some((sample, (*output)?)));
        let (samples, output): (Vec<usize>, Vec<f64>) = samples.unzip();
        let at = |values: &[f64]| samples.iter().map(|sample| values[*sample]).collect::<Vec<_>>();
        let residual = at(record.output()).iter().zip(&output).map(|(reading, model)| reading - model).collect();
        let (time_s, command) = (at(record.time_s()), at(record.input()));
        Self { model, rms, fit_percent, time_s, output, residual, command }
    }

    pub(super) fn sentence(&self) -> String {
        format!(
            "The {} leaves residuals of rms {} and explains {:.1} % of the output's variation. Of independent residuals, 95 % of the \
             correlations lie within the dashes: those of successive ones here are {:.2}.",
            self.model,
            significant(self.rms, 2),
            self.fit_percent,
            correlation(&self.residual, &self.residual, 1),
        )
    }

    /// From a time on.
    fn shown<'a>(&'a self, values: &'a [f64], from_s: f64) -> (&'a [f64], &'a [f64]) {
        let before = self.time_s.partition_point(|time| *time < from_s);
        (&self.time_s[before..], &values[before..])
    }
}

/// The first sample that a figure shows, and how its title says so.
fn part(source: &Source) -> (usize, String) {
    let samples = source.log.record.samples();
    let from = samples.saturating_sub(SHOWN);
    (from, if from > 0 { format!(", the last {SHOWN} of {samples} samples") } else { String::new() })
}

/// Each parameter by every method, the answer first: a dot with its 95 % interval, where there is one.
#[allow(clippy::cast_precision_loss, reason = "a number of rows")]
pub(super) fn interval_figure(found: &Identification) -> Option<Figure> {
    let reported = found.reported();
    let drag = |has: bool, of: Option<Estimate>| of.filter(|_| has);
    type Of = fn(&Model) -> Option<Estimate>;
    let alpha = (reported.map(|one| one.alpha), (|model| Some(model.alpha)) as Of, "inertia alpha");
    let beta = (
        reported.and_then(|one| drag(one.drag.has_linear(), Some(one.beta))),
        (|model| model.beta) as Of,
        "linear drag beta",
    );
    let quadratic = (
        reported.and_then(|one| drag(one.drag.has_quadratic(), Some(one.beta_quadratic))),
        (|model| model.beta_quadratic) as Of,
        "quadratic drag beta_quadratic",
    );
    let name = |model: &Model| {
        let record = model.record.map_or_else(String::new, |index| format!(", {}", index + 1));
        format!("{}, {}{record}", model.method.name(), model.drag.name())
    };
    let panel = |(answer, of, label): (Option<Estimate>, Of, &str)| {
        let answer = answer.map(|estimate| ("reported".to_owned(), estimate));
        let models = found.models().iter().filter_map(|model| Some((name(model), of(model)?)));
        let rows: Vec<(String, Estimate)> = answer.into_iter().chain(models).collect();
        let named = rows.iter().map(|row| row.0.clone());
        let dots = rows.iter().enumerate().map(|(row, (_, estimate))| (estimate.value, row as f64));
        let panel = Panel::new(label, "").rows(named).with("", Mark::Dots, dots);
        let bars = |of: fn(&Estimate) -> Option<ConfidenceInterval>, mark: Mark| {
            let rows = rows.iter().enumerate();
            rows.filter_map(move |(row, (_, estimate))| Some((row as f64, of(estimate)?, mark))).collect::<Vec<_>>()
        };
        let [exact, practical] = [bars(|one| one.spread, Mark::Line), bars(|one| one.combined, Mark::Thin)];
        (rows.len() > 1).then(|| {
            exact
                .into_iter()
                .chain(practical)
                .fold(panel, |panel, (row, ends, mark)| panel.with("", mark, [(ends.low, row), (ends.high, row)]))
        })
    };
    let panels: Vec<Panel> = [alpha, beta, quadratic].into_iter().filter_map(panel).collect();
    (!panels.is_empty()).then(|| Figure {
        name: "intervals",
        title: "Every method, with 95 % intervals".to_owned(),
        caption: "Dot: value. Bar: interval if the model is exact. Thin line: practical interval. The answer is on top.",
        panels,
    })
}

/// Each source of error by its share, a bar each.
#[allow(clippy::cast_precision_loss, reason = "a number of rows")]
pub(super) fn budget_figure(found: &Identification) -> Option<Figure> {
    let budget = &found.reported()?.budget;
    let named = budget.iter().map(|entry| entry.source.clone().into_owned());
    let panel = Panel::new("half-width of alpha's interval by this source alone (% of alpha)", "").rows(named);
    let bars = budget.iter().enumerate().map(|(row, entry)| [(0.0, row as f64), (entry.share_percent, row as f64)]);
    let panel =
        bars.fold(panel, |panel, bar| panel.with("", Mark::Line, bar).with("", Mark::Dots, bar.into_iter().skip(1)));
    (!budget.is_empty()).then(|| Figure {
        name: "budget",
        title: "Errors that no residual shows".to_owned(),
        caption: "The longest bar is the first to shorten: the table has the remedy, and --assume declares another size.",
        panels: vec![panel],
    })
}

/// Record with the model and the band of 95 % of its readings; the command.
pub(super) fn record(source: &Source, predicted: Option<&Predicted>, between: Option<Between>) -> Figure {
    let record = &source.log.record;
    let (from, part) = part(source);
    let points = |values: &[f64]| pairs(&record.time_s()[from..], &values[from..]);
    // The model lies on top, where dense readings would hide it.
    let mut output =
        Panel::new("time (s)", output_label(source)).with("readings", Mark::Points, points(record.output()));
    if let Some(predicted) = predicted {
        let (time, model) = predicted.shown(&predicted.output, record.time_s()[from]);
        let band = NORMAL_95 * predicted.rms;
        let beside = |by: f64| time.iter().zip(model).map(move |(time, model)| (*time, model + by));
        output = output.with(&predicted.model, Mark::Line, pairs(time, model)).with("", Mark::Thin, beside(band)).with(
            "",
            Mark::Thin,
            beside(-band),
        );
    }
    let evenly = matches!(between, Some(Between::Evenly | Between::Bent));
    let command = points(record.input());
    let command = if evenly { command } else { held(&command) };
    let input = Panel::new("time (s)", "command").strip().with("command", Mark::Line, command);
    let (title, caption) = match predicted {
        Some(_) => (
            "Record and model, with the band of 95 % of readings",
            "Thin lines hold 95 % of the readings; below, the command. Look for swings that the line misses.",
        ),
        None => ("Record", "Above, the readings; below, the command."),
    };
    Figure { name: "record", title: format!("{title}{part}"), caption, panels: vec![output, input] }
}

/// What the model leaves: over time, how it is distributed and hangs together, and the orbit.
pub(super) fn residuals(source: &Source, predicted: &Predicted) -> Vec<Figure> {
    let over_time = residual_figure(source, predicted);
    [over_time]
        .into_iter()
        .chain(distribution_figure(source, predicted))
        .chain([phase_figure(source, predicted)])
        .collect()
}

/// Residuals over time, with a band of twice their rms over the whole record.
fn residual_figure(source: &Source, predicted: &Predicted) -> Figure {
    let (from, part) = part(source);
    let (time, residuals) = predicted.shown(&predicted.residual, source.log.record.time_s()[from]);
    let band = 2.0 * predicted.rms;
    let level = |at: f64| [time.first(), time.last()].into_iter().flatten().map(move |time| (*time, at));
    let panel = Panel::new("time (s)", &format!("residual of {}", output_label(source)))
        .strip()
        .with("readings less model", Mark::Points, pairs(time, residuals))
        .with("twice their rms", Mark::Dashed, level(band))
        .with("", Mark::Dashed, level(-band))
        .with("", Mark::Line, level(0.0));
    let caption = "Noise between the dashes, without a pattern, is good; waves are motion that the model lacks.";
    Figure { name: "residuals", title: format!("Residuals{part}"), caption, panels: vec![panel] }
}

/// Bars of the histogram of residuals, and lags of their correlation.
const BARS: usize = 31;
const LAGS: usize = 40;

/// Correlation of values with others `lag` samples before.
fn correlation(values: &[f64], before: &[f64], lag: usize) -> f64 {
    let square = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>();
    let products = values.iter().skip(lag).zip(before).map(|(value, before)| value * before).sum::<f64>();
    products / (square(values) * square(before)).sqrt()
}

/// How residuals are distributed, and how they hang together with those before and with the command before: within the dashed
/// lines, 95 % of the correlations of independent residuals lie.
#[allow(clippy::cast_precision_loss, reason = "counts of samples")]
fn distribution_figure(source: &Source, predicted: &Predicted) -> Option<Figure> {
    let residuals = &predicted.residual;
    let count = residuals.len() as f64;
    let largest = residuals.iter().fold(0.0f64, |largest, value| largest.max(value.abs()));
    let mean = predicted.command.iter().sum::<f64>() / count;
    let command: Vec<f64> = predicted.command.iter().map(|value| value - mean).collect();
    if residuals.len() <= LAGS || !(largest > 0.0 && largest.is_finite()) || command.iter().all(|value| *value == 0.0) {
        return None;
    }
    let width = 2.0 * largest / BARS as f64;
    let middle = |bar: usize| -largest + (bar as f64 + 0.5) * width;
    let within =
        |bar: usize| residuals.iter().filter(|value| (**value - middle(bar)).abs() <= 0.5 * width).count() as f64;
    let bars: Vec<(f64, f64)> = (0..BARS).map(|bar| (middle(bar), within(bar) / count)).collect();
    let tallest = bars.iter().fold(0.0f64, |tallest, bar| tallest.max(bar.1));
    let outline = bars.iter().flat_map(|(x, y)| [(x - 0.5 * width, *y), (x + 0.5 * width, *y)]);
    let histogram = Panel::new(&format!("residual of {}", output_label(source)), "share of samples")
        .strip()
        .y_limits(0.0, 1.1 * tallest)
        .with("", Mark::Line, [(-largest, 0.0)].into_iter().chain(outline).chain([(largest, 0.0)]));
    let limit = NORMAL_95 / count.sqrt();
    let correlations = |with: &str, before: &[f64], first: usize| {
        let dots = (first..=LAGS).map(|lag| (lag as f64, correlation(residuals, before, lag)));
        Panel::new("lag (samples)", &format!("correlation with {with}"))
            .strip()
            .with("", Mark::Dots, dots)
            .with("", Mark::Dashed, [(0.0, limit), (LAGS as f64, limit)])
            .with("", Mark::Dashed, [(0.0, -limit), (LAGS as f64, -limit)])
    };
    Some(Figure {
        name: "distribution",
        title: "Residuals: distribution, correlation with residuals and commands before".to_owned(),
        caption: "Above, samples by residual. Below, dots beyond the dashes show motion that the model lacks.",
        panels: vec![histogram, correlations("residuals", residuals, 1), correlations("commands", &command, 0)],
    })
}

fn phase_figure(source: &Source, predicted: &Predicted) -> Figure {
    let record = &source.log.record;
    let (from, part) = part(source);
    let rate = if source.log.degrees { "rate of change (rad/s)" } else { "rate of change (output per s)" };
    let readings = speeds(&record.time_s()[from..], &record.output()[from..], reach(source));
    let (time, model) = predicted.shown(&predicted.output, record.time_s()[from]);
    let panel = Panel::new(output_label(source), rate).with("readings, by differences", Mark::Points, readings).with(
        &predicted.model,
        Mark::Line,
        speeds(time, model, 1),
    );
    let caption = "A steady oscillation is a closed curve. Where dots and line part, the model moves otherwise.";
    Figure { name: "phase", title: format!("Phase portrait{part}"), caption, panels: vec![panel] }
}

/// Samples on either side of one over which rounding does not drown its rate: up to a fortieth of the period.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most the number of samples")]
fn reach(source: &Source) -> usize {
    let period_s = source.features.as_ref().map_or(0.0, |found| found.features.period_s.mean);
    (period_s / (40.0 * source.log.record.interval_s())).max(1.0) as usize
}

fn pairs(x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
    x.iter().copied().zip(y.iter().copied()).collect()
}

/// Each value until the next.
fn held(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    points.windows(2).flat_map(|pair| [pair[0], (pair[1].0, pair[0].1)]).chain(points.last().copied()).collect()
}

/// Positions with central differences over `reach` samples either way.
fn speeds(time: &[f64], position: &[f64], reach: usize) -> Vec<(f64, f64)> {
    let spans = time.windows(2 * reach + 1).zip(position.windows(2 * reach + 1));
    // Samples can be too near to each other for a rate.
    let rate = |(t, x): (&[f64], &[f64])| (x[reach], (x[2 * reach] - x[0]) / (t[2 * reach] - t[0]));
    spans.map(rate).filter(|(_, rate)| rate.is_finite()).collect()
}
