//! The catalogue as a page: every characteristic with its graph and its curves of P and Q.

use super::nyquist::direction;
use super::{Document, Figure, Mark, Panel, ReportError, Section};
use crate::describing::{CATALOGUE, CatalogueError, DescribingFunction, Entry, Example, Setting};
use crate::nonlinearity::{Branch, Sinusoid};

/// Amplitudes of a curve and inputs of a branch.
const POINTS: u32 = 240;
/// Least and largest amplitude of a curve, as multiples of the example's.
const AMPLITUDES: (f64, f64) = (0.1, 3.0);

/// Every characteristic of the catalogue: its page's text and its [figure](characteristic).
///
/// # Errors
/// [`ReportError::Catalogue`] where a page has no usable example.
pub fn characteristics() -> Result<Document, ReportError> {
    let sections = CATALOGUE.iter().map(section).collect::<Result<_, CatalogueError>>()?;
    Ok(Document {
        title: "Describing functions".to_owned(),
        answer: Vec::new(),
        sections,
        provenance: vec![concat!("Written by selfosc ", env!("CARGO_PKG_VERSION")).to_owned()],
    })
}

fn section(entry: &Entry) -> Result<Section, CatalogueError> {
    let text = |paragraph: &str| paragraph.replace('*', "").replace('\n', " ");
    Ok(Section {
        title: entry.name.to_owned(),
        paragraphs: entry.page.split("\n\n").filter(|p| !p.starts_with("Sketch:")).map(text).collect(),
        figures: vec![characteristic(entry)?],
        ..Section::default()
    })
}

/// A characteristic for the example on its page: output over input, and beside it `F_0`, `P`, `Q` over amplitude, without bias
/// and with a bias of a quarter of the example's amplitude.
///
/// The SVG file next to the page is this figure; a test compares them.
///
/// # Errors
/// As [`Entry::build`].
pub fn characteristic(entry: &Entry) -> Result<Figure, CatalogueError> {
    let example = entry.example()?;
    let settings = entry.settings(&example.values).into_iter().filter(|(_, value)| *value != Setting::Number(0.0));
    let settings: Vec<_> = settings.map(|(name, value)| format!("{name} = {value}")).collect();
    let title = format!("{} ({})", entry.name, settings.join(", "));
    let caption = "Left, output over input, breakpoints and levels dashed. Right, mean output F_0 and gains P, Q.";
    let panels = vec![graph(entry, &example)?, curves(entry, &example)?.beside()];
    Ok(Figure { name: entry.name, title, caption, panels })
}

/// The output up and down again, with a line through each breakpoint or level that a parameter places.
fn graph(entry: &Entry, example: &Example) -> Result<Panel, CatalogueError> {
    let reach = example.amplitude;
    let near = 1e-9 * reach;
    let characteristic = entry.build(&example.values)?;
    let sweep = Sinusoid::new(0.0, reach)?;
    let output = |x: f64, branch| (x, characteristic.output(x, branch, &sweep));
    let mut kinks = Vec::new();
    characteristic.kinks(&sweep, &mut |kink| kinks.push(kink));
    kinks.retain(|kink| kink.abs() < reach);
    // Both sides of a jump.
    let sides: Vec<f64> = kinks.iter().flat_map(|kink| [kink - near, kink + near]).collect();
    let even = (0..=POINTS).map(|k| (reach - near) * (2.0 * f64::from(k) / f64::from(POINTS) - 1.0));
    let mut inputs: Vec<f64> = even.chain(sides.iter().copied()).collect();
    inputs.sort_by(f64::total_cmp);
    let rising: Vec<_> = inputs.iter().map(|&x| output(x, Branch::Rising)).collect();
    let falling: Vec<_> = inputs.iter().rev().map(|&x| output(x, Branch::Falling)).collect();
    let mut panel = Panel::new("input", "output").with("output", Mark::Line, rising.iter().chain(&falling).copied());
    let memory = rising.iter().rev().ne(&falling);
    if memory {
        let up: Vec<_> = rising.iter().copied().filter(|(x, _)| *x >= 0.0).collect();
        let down: Vec<_> = falling.iter().copied().filter(|(x, _)| *x <= 0.0).collect();
        panel = panel.with("", Mark::Arrow, direction(&up)).with("", Mark::Arrow, direction(&down));
    }

    let highest = rising.iter().chain(&falling).fold(0.0, |highest: f64, (_, y)| highest.max(y.abs()));
    let both = [Branch::Rising, Branch::Falling];
    let levels: Vec<f64> = sides.iter().flat_map(|&x| both.map(|branch| output(x, branch).1)).collect();
    let breaks = |x: f64| {
        let crossing = memory && both.iter().any(|&branch| output(x, branch).1.abs() < near);
        crossing || kinks.iter().any(|kink| (kink - x).abs() < near)
    };
    let level = |y: f64| levels.iter().any(|level| (level - y).abs() < 10.0 * near);
    // A slope, or a factor of the input, is no place on an axis.
    let settings = entry.settings(&example.values).into_iter().zip(entry.parameters);
    for ((name, setting), _) in settings.filter(|(_, parameter)| !parameter.meaning.contains(" per input unit")) {
        let value = match setting {
            Setting::Number(value) => value,
            Setting::Points(points) => {
                panel = panel.with(name, Mark::Dots, points);
                continue;
            }
        };
        let signs = [value, -value].into_iter().filter(|_| value != 0.0);
        let mut lines: Vec<_> = signs.clone().filter(|&x| breaks(x)).map(|x| [(x, -highest), (x, highest)]).collect();
        if lines.is_empty() {
            lines = signs.filter(|&y| level(y)).map(|y| [(-reach, y), (reach, y)]).collect();
        }
        for (place, line) in lines.into_iter().enumerate() {
            let label = if place == 0 { format!("{name} = {value}") } else { String::new() };
            panel = panel.with(&label, Mark::Dashed, line);
        }
    }
    Ok(panel)
}

/// `F_0`, `P`, `Q` over amplitude: a colour each, dashed with the bias.
fn curves(entry: &Entry, example: &Example) -> Result<Panel, CatalogueError> {
    let (from, to) = AMPLITUDES;
    let step = |k: u32| example.amplitude * from * libm::pow(to / from, f64::from(k) / f64::from(POINTS));
    let amplitudes: Vec<f64> = (0..=POINTS).map(step).collect();
    let bias = 0.25 * example.amplitude;
    let curve = |bias| entry.curve(&example.values, bias, &amplitudes);
    let curves = [(Mark::Line, curve(0.0)?), (Mark::Dashed, curve(bias)?)];
    let parts = |df: &DescribingFunction<f64>| [df.p, df.f0, df.q];
    let mut panel = Panel::new(&format!("amplitude X (dashed: bias {bias})"), "F_0 (output); P, Q (output per input)");
    for (part, mut label) in ["P", "F_0", "Q"].into_iter().enumerate() {
        for (mark, curve) in &curves {
            let points =
                curve.iter().filter_map(|(x, df)| Some((*x, parts(df.as_ref().ok()?)[part]))).collect::<Vec<_>>();
            // A part that is zero all along tells nothing.
            if points.iter().any(|(_, value)| value.abs() > 1e-9) {
                panel = panel.with(label, *mark, points);
                label = "";
            }
        }
    }
    Ok(panel)
}
