//! The catalogue as a page: every characteristic with its curves of P and Q.

use super::{Document, Figure, Mark, Panel, ReportError, Section};
use crate::describing::{CATALOGUE, CatalogueError, Entry};

/// Amplitudes of a curve, as multiples of the example's, on a logarithmic scale.
const POINTS: u32 = 240;

/// Every characteristic of the catalogue: its page's text, and `F_0`, `P`, `Q` over amplitude for its example, without bias and
/// with a bias of a quarter of the example's amplitude.
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
    let example = entry.example()?;
    let step = |k: u32| example.amplitude * 10f64.powf(f64::from(k) / f64::from(POINTS) * 2.0 - 1.0);
    let amplitudes: Vec<f64> = (0..=POINTS).map(step).collect();
    let bias = 0.25 * example.amplitude;
    let mut panel = Panel::new("amplitude X (input units)", "F_0, P, Q (output units, output per input unit)");
    for (mark, bias, suffix) in [(Mark::Line, 0.0, String::new()), (Mark::Dashed, bias, format!(", bias {bias}"))] {
        let curve = entry.curve(&example.values, bias, &amplitudes)?;
        let points = |part: fn((f64, f64, f64)) -> f64| {
            let curve = curve.iter().filter_map(|(x, df)| df.as_ref().ok().map(|df| (*x, part((df.f0, df.p, df.q)))));
            curve.collect::<Vec<_>>()
        };
        let curves = [("F_0", points(|df| df.0)), ("P", points(|df| df.1)), ("Q", points(|df| df.2))];
        for (name, points) in curves {
            // A part that is zero all along tells nothing.
            if points.iter().any(|(_, value)| value.abs() > 1e-9) {
                panel = panel.with(&format!("{name}{suffix}"), mark, points);
            }
        }
    }
    let settings = entry.settings(&example.values).into_iter().map(|(name, value)| format!("{name} = {value}"));
    let title = format!("{} ({})", entry.name, settings.collect::<Vec<_>>().join(", "));
    let text = |paragraph: &str| paragraph.replace("**", "").replace('`', "").replace('\n', " ");
    Ok(Section {
        title: entry.name.to_owned(),
        paragraphs: entry.page.split("\n\n").filter(|p| !p.starts_with("Sketch:")).map(text).collect(),
        tables: Vec::new(),
        figures: vec![Figure { name: entry.name, title, panels: vec![panel] }],
    })
}
