//! A self-contained HTML file.

use super::table::{escaped_html, math_html, prose_html};
use super::{Figure, ReportError, Table};

/// Text, tables and figures under a heading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Heading.
    pub title: String,
    /// Paragraphs above the rest.
    pub paragraphs: Vec<String>,
    /// Equations in LaTeX below them.
    pub equations: Vec<&'static str>,
    /// Tables, in order.
    pub tables: Vec<Table>,
    /// Figures, in order, above the tables.
    pub figures: Vec<Figure>,
}

/// A report: an HTML file that refers to nothing outside itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Heading of the whole.
    pub title: String,
    /// The answer, before everything else: a paragraph each, the first in larger letters.
    pub answer: Vec<String>,
    /// Its parts.
    pub sections: Vec<Section>,
    /// Where it comes from: version, command, inputs, date. A line each, at the end.
    pub provenance: Vec<String>,
}

const STYLE: &str = "\
:root { color-scheme: light dark; --text: #222; --page: #fff; --line: #ccc; --faint: #e4e4e4; --first: #0072b2; --shade: #8888; }
@media (prefers-color-scheme: dark) { :root { --text: #ddd; --page: #1b1b1d; --line: #555; --faint: #333; --first: #4aa8e0; } }
body { font: 16px/1.5 sans-serif; color: var(--text); background: var(--page); max-width: 62rem; margin: 2rem auto; padding: 0 1rem; overflow-wrap: anywhere; }
h2 { border-top: 1px solid var(--line); padding-top: 1rem; margin-top: 2.5rem; }
nav ul { padding-left: 1.2rem; } a { color: inherit; }
.answer { border-left: 0.4rem solid var(--first); padding: 0.1rem 0 0.1rem 1rem; }
.answer p { margin: 0.5rem 0; } .answer p:first-child { font-size: 1.4rem; line-height: 1.3; }
.wide { overflow-x: auto; overflow-wrap: normal; background: linear-gradient(90deg, var(--page) 2rem, transparent 4rem) local, linear-gradient(270deg, var(--page) 2rem, transparent 4rem) local,
  linear-gradient(90deg, var(--shade), transparent 1rem, transparent calc(100% - 1rem), var(--shade)) 2px 2px / calc(100% - 4px) calc(100% - 4px) no-repeat; }
math { display: inline math; font-size: 1.1em; }
table { border-collapse: collapse; margin: 1rem 0; font-size: 0.9rem; }
caption { text-align: left; font-weight: bold; padding-bottom: 0.4rem; }
th, td { text-align: left; white-space: nowrap; padding: 0.15rem 0.8rem 0.15rem 0; border-bottom: 1px solid var(--faint); vertical-align: top; }
td { font-variant-numeric: tabular-nums; } td:last-child { white-space: normal; } .number { text-align: right; }
figure { margin: 1.5rem 0; }
figure svg { width: 100%; height: auto; cursor: zoom-in; }
svg [fill='#000000'] { fill: var(--text); } svg [stroke='#000000'] { stroke: var(--text); }
svg [fill='#FFFFFF'] { fill: var(--page); } svg [stroke='#E1E1E1'] { stroke: var(--faint); } svg [stroke='#C8C8C8'] { stroke: var(--line); }
svg [fill='#0072B2'] { fill: var(--first); } svg [stroke='#0072B2'] { stroke: var(--first); }
figcaption { font-size: 0.9rem; } figure p { font-size: 0.8rem; min-height: 1.7em; margin: 0; } figure button { font: inherit; margin-right: 0.6rem; }
footer { border-top: 1px solid var(--line); margin-top: 3rem; font-size: 0.85rem; }
@media (max-width: 480px) { body { margin: 1rem auto; padding: 0 0.6rem; } h1 { font-size: 1.5rem; } .answer p:first-child { font-size: 1.2rem; }
  th, td { white-space: normal; padding-right: 0.5rem; } svg [font-size^='12'], svg [font-size^='13'] { font-size: 175px; }
  svg [font-size^='129'] { font-size: 155px; } svg [font-size^='16'] { font-size: 200px; } }
@media print {
  :root { --text: #000; --page: #fff; --line: #999; --faint: #ccc; --first: #0072b2; }
  body { max-width: none; margin: 0; font-size: 9.5pt; } nav, figure p { display: none; } h2 { margin-top: 1rem; }
  figure, table { break-inside: avoid; margin: 0.6rem 0; } h2, h2 + p, caption { break-after: avoid; } .wide { overflow: visible; background: none; } figure svg { width: 85%; }
}
";

/// A click zooms in; where the pointer is, the caption says in the numbers of the axes.
const SCRIPT: &str = "\
for (const figure of document.querySelectorAll('figure')) {
  const svg = figure.querySelector('svg'), view = svg.viewBox.baseVal, all = svg.getAttribute('viewBox');
  const panels = svg.dataset.axes.split(';').map(panel => panel.split(',').map(Number));
  const [tools, whole, place] = ['p', 'button', 'span'].map(name => document.createElement(name));
  const at = event => new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
  const shown = (from, to, part) => Number((from + (to - from) * part).toPrecision(4));
  whole.textContent = 'whole';
  whole.hidden = true;
  place.textContent = 'Click or tap to zoom in.';
  svg.onpointermove = event => {
    const { x, y } = at(event);
    const panel = panels.find(([left, top, right, bottom]) => left <= x && x <= right && top <= y && y <= bottom);
    if (!panel) return;
    const [left, top, right, bottom, x0, x1, y0, y1] = panel;
    const up = y0 === y1 ? '' : ', up: ' + shown(y0, y1, (bottom - y) / (bottom - top));
    place.textContent = 'across: ' + shown(x0, x1, (x - left) / (right - left)) + up;
  };
  svg.onclick = event => {
    const { x, y } = at(event);
    svg.setAttribute('viewBox', [(view.x + x) / 2, (view.y + y) / 2, view.width / 2, view.height / 2].join(' '));
    whole.hidden = false;
  };
  whole.onclick = () => { svg.setAttribute('viewBox', all); whole.hidden = true; };
  tools.append(whole, place);
  figure.append(tools);
}
";

/// Nothing is loaded, and of scripts only the page's own runs, by the SHA-256 of what stands between its tags.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-SaAGi9um7WTDhPvwOs3sWIo8HM3XAv2mPYLc4DX9FKo='; base-uri 'none'; form-action 'none'";

impl Document {
    /// The document with lines that say where it comes from, after those it has.
    #[must_use]
    pub fn from_where(mut self, lines: impl IntoIterator<Item = String>) -> Self {
        self.provenance.extend(lines);
        self
    }

    /// The file's text.
    ///
    /// # Errors
    /// [`ReportError::Figure`] where a figure cannot be drawn.
    pub fn html(&self) -> Result<String, ReportError> {
        let title = escaped_html(&self.title);
        let sections: String =
            (1..).zip(&self.sections).map(|(place, section)| section.html(place)).collect::<Result<_, _>>()?;
        let entry = |(place, section): (usize, &Section)| {
            format!("<li><a href=\"#part-{place}\">{}</a></li>\n", escaped_html(&section.title))
        };
        let answer: String = self.answer.iter().map(|text| format!("<p>{}</p>\n", prose_html(text))).collect();
        let answer = if answer.is_empty() { answer } else { format!("<div class=\"answer\">\n{answer}</div>\n") };
        let contents: String = (1..).zip(&self.sections).map(entry).collect();
        let provenance: String =
            self.provenance.iter().map(|line| format!("<p>{}</p>\n", escaped_html(line))).collect();
        let footer = if provenance.is_empty() { String::new() } else { format!("<footer>\n{provenance}</footer>\n") };
        Ok(format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n\
             <body>\n<h1>{title}</h1>\n{answer}<nav>\n<ul>\n{contents}</ul>\n</nav>\n{sections}{footer}<script>\n{SCRIPT}</script>\n</body>\n</html>\n"
        ))
    }
}

impl Section {
    fn html(&self, place: usize) -> Result<String, ReportError> {
        let paragraphs: String = self.paragraphs.iter().map(|text| format!("<p>{}</p>\n", prose_html(text))).collect();
        let equations: String =
            self.equations.iter().map(|latex| format!("<div class=\"wide\">{}</div>\n", math_html(latex))).collect();
        let tables: String =
            self.tables.iter().map(|table| format!("<div class=\"wide\">\n{}</div>\n", table.html())).collect();
        let figures: String = self
            .figures
            .iter()
            .map(|figure| {
                Ok(format!(
                    "<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n",
                    figure.svg()?,
                    prose_html(figure.caption)
                ))
            })
            .collect::<Result<_, ReportError>>()?;
        Ok(format!(
            "<h2 id=\"part-{place}\">{}</h2>\n{paragraphs}{equations}{figures}{tables}",
            escaped_html(&self.title)
        ))
    }
}
