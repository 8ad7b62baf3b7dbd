//! A record with its model.

use super::tables::output_label;
use crate::identify::fit::{Between, FittedRecord, RecordFit};
use crate::identify::{Estimate, Identification, Model, NORMAL_95, Source};
use crate::report::{Figure, Mark, Panel};

/// Samples that a figure shows: more than these cannot be told apart on a page.
const SHOWN: usize = 1500;

/// Record with model, residuals and how they are distributed, phase portrait.
pub(super) fn figures(source: &Source, fitted: Option<(&RecordFit, &FittedRecord)>) -> Vec<Figure> {
    let samples = source.log.record.samples();
    let from = samples.saturating_sub(SHOWN);
    let part = if from > 0 { format!(", the last {SHOWN} of {samples} samples") } else { String::new() };
    let mut figures = vec![record_figure(source, fitted, from, &part)];
    if let Some((_, fitted)) = fitted {
        figures.push(residual_figure(source, fitted, from, &part));
        figures.extend(distribution_figure(source, fitted));
    }
    figures.push(phase_figure(source, fitted.map(|(_, fitted)| fitted), from, &part));
    figures
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
        let bars = rows.iter().enumerate().filter_map(|(row, (_, estimate))| Some((row as f64, estimate.spread?)));
        (rows.len() > 1).then(|| {
            bars.fold(panel, |panel, (row, spread)| panel.with("", Mark::Line, [(spread.low, row), (spread.high, row)]))
        })
    };
    let panels: Vec<Panel> = [alpha, beta, quadratic].into_iter().filter_map(panel).collect();
    (!panels.is_empty()).then(|| Figure {
        name: "intervals",
        title: "Every method, with 95 % intervals".to_owned(),
        panels,
    })
}

fn record_figure(source: &Source, fitted: Option<(&RecordFit, &FittedRecord)>, from: usize, part: &str) -> Figure {
    let record = &source.log.record;
    let points = |values: &[f64]| pairs(&record.time_s()[from..], &values[from..]);
    // The model lies on top, where dense readings would hide it.
    let mut output =
        Panel::new("time (s)", output_label(source)).with("readings", Mark::Points, points(record.output()));
    if let Some((_, fitted)) = fitted {
        let (time, model) = shown(source, fitted, &fitted.output, from);
        output = output.with("model", Mark::Line, pairs(time, model));
    }
    let evenly = fitted.is_some_and(|(fit, _)| matches!(fit.between(), Between::Evenly | Between::Bent));
    let command = points(record.input());
    let command = if evenly { command } else { held(&command) };
    let input = Panel::new("time (s)", "command").with("command", Mark::Line, command);
    Figure { name: "record", title: format!("Record and fitted model{part}"), panels: vec![output, input] }
}

/// Residuals over time, with a band of twice their rms over the whole record.
#[allow(clippy::cast_precision_loss, reason = "a count of samples")]
fn residual_figure(source: &Source, fitted: &FittedRecord, from: usize, part: &str) -> Figure {
    let (time, residuals) = shown(source, fitted, &fitted.residuals, from);
    let power: f64 = fitted.residuals.iter().map(|value| value * value).sum();
    let band = 2.0 * (power / fitted.residuals.len().max(1) as f64).sqrt();
    let level = |at: f64| [time.first(), time.last()].into_iter().flatten().map(move |time| (*time, at));
    let panel = Panel::new("time (s)", &format!("residual of {}", output_label(source)))
        .with("readings less model", Mark::Points, pairs(time, residuals))
        .with("twice their rms", Mark::Dashed, level(band))
        .with("", Mark::Dashed, level(-band))
        .with("", Mark::Line, level(0.0));
    Figure { name: "residuals", title: format!("Residuals{part}"), panels: vec![panel] }
}

/// Bars of the histogram of residuals, and lags of their correlation.
const BARS: usize = 31;
const LAGS: usize = 40;

/// How residuals are distributed, and how those some samples apart hang together: within the dashed lines, 95 % of the
/// correlations of independent ones lie.
#[allow(clippy::cast_precision_loss, reason = "counts of samples")]
fn distribution_figure(source: &Source, fitted: &FittedRecord) -> Option<Figure> {
    let residuals = &fitted.residuals;
    let count = residuals.len() as f64;
    let power: f64 = residuals.iter().map(|value| value * value).sum();
    let largest = residuals.iter().fold(0.0f64, |largest, value| largest.max(value.abs()));
    if residuals.len() <= LAGS || !(power > 0.0 && largest.is_finite()) {
        return None;
    }
    let width = 2.0 * largest / BARS as f64;
    let middle = |bar: usize| -largest + (bar as f64 + 0.5) * width;
    let within =
        |bar: usize| residuals.iter().filter(|value| (**value - middle(bar)).abs() <= 0.5 * width).count() as f64;
    let bars = (0..BARS).map(|bar| (middle(bar), within(bar) / count));
    let histogram = Panel::new(&format!("residual of {}", output_label(source)), "share of samples").with(
        "",
        Mark::Line,
        bars.flat_map(|(x, y)| [(x - 0.5 * width, y), (x + 0.5 * width, y)]),
    );
    let correlation = |lag: usize| residuals.iter().zip(&residuals[lag..]).map(|(a, b)| a * b).sum::<f64>() / power;
    let limit = NORMAL_95 / count.sqrt();
    let correlations = Panel::new("lag (samples)", "correlation of residuals")
        .with("residuals", Mark::Dots, (1..=LAGS).map(|lag| (lag as f64, correlation(lag))))
        .with("95 % of independent ones", Mark::Dashed, [(0.0, limit), (LAGS as f64, limit)])
        .with("", Mark::Dashed, [(0.0, -limit), (LAGS as f64, -limit)]);
    Some(Figure {
        name: "distribution",
        title: "Distribution and correlation of residuals".to_owned(),
        panels: vec![histogram, correlations],
    })
}

fn phase_figure(source: &Source, fitted: Option<&FittedRecord>, from: usize, part: &str) -> Figure {
    let record = &source.log.record;
    let rate = if source.log.degrees { "rate of change (rad/s)" } else { "rate of change (output per s)" };
    let reach = reach(source);
    let readings = speeds(&record.time_s()[from..], &record.output()[from..], reach);
    let mut panel = Panel::new(output_label(source), rate).with("readings, by differences", Mark::Points, readings);
    if let Some(fitted) = fitted {
        let (time, model) = shown(source, fitted, &fitted.output, from);
        panel = panel.with("model", Mark::Line, speeds(time, model, 1));
    }
    Figure { name: "phase", title: format!("Phase portrait{part}"), panels: vec![panel] }
}

/// Samples on either side of one over which rounding does not drown its rate: up to a fortieth of the period.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most the number of samples")]
fn reach(source: &Source) -> usize {
    let period_s = source.features.as_ref().map_or(0.0, |found| found.features.period_s.mean);
    (period_s / (40.0 * source.log.record.interval_s())).max(1.0) as usize
}

/// Times and values of the model from sample `from` on.
fn shown<'a>(source: &'a Source, fitted: &FittedRecord, values: &'a [f64], from: usize) -> (&'a [f64], &'a [f64]) {
    let time = &source.log.record.time_s()[fitted.first_sample..];
    let before = from.saturating_sub(fitted.first_sample).min(values.len());
    (&time[before..values.len()], &values[before..])
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
