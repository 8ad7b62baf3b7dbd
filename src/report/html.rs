//! A self-contained HTML file.

use super::table::{escaped_html, prose_html};
use super::{Figure, ReportError, Table};

/// Text, tables and figures under a heading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Heading.
    pub title: String,
    /// Paragraphs above the rest.
    pub paragraphs: Vec<String>,
    /// Tables, in order.
    pub tables: Vec<Table>,
    /// Figures, in order, below the tables.
    pub figures: Vec<Figure>,
}

/// A report: an HTML file that refers to nothing outside itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Heading of the whole.
    pub title: String,
    /// Its parts.
    pub sections: Vec<Section>,
    /// Where it comes from: version, command, inputs, date. A line each, at the end.
    pub provenance: Vec<String>,
}

const STYLE: &str = "\
:root { color-scheme: light dark; --text: #222; --page: #fff; --line: #ccc; --faint: #e4e4e4; }
@media (prefers-color-scheme: dark) { :root { --text: #ddd; --page: #1b1b1d; --line: #555; --faint: #333; } }
body { font: 16px/1.5 sans-serif; color: var(--text); background: var(--page); max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
h2 { border-top: 1px solid var(--line); padding-top: 1rem; margin-top: 2.5rem; }
nav ul { padding-left: 1.2rem; } a { color: inherit; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: 1rem 0; font-size: 0.9rem; }
caption { text-align: left; font-weight: bold; padding-bottom: 0.4rem; }
th, td { text-align: left; padding: 0.15rem 0.8rem 0.15rem 0; border-bottom: 1px solid var(--faint); vertical-align: top; }
.number { text-align: right; font-variant-numeric: tabular-nums; }
figure { margin: 1.5rem 0; overflow-x: auto; }
figure svg { width: 100%; height: auto; background: #fff; border-radius: 4px; }
figure.zoomed svg { width: auto; max-width: none; }
figcaption { font-size: 0.85rem; } figcaption button { font: inherit; }
footer { border-top: 1px solid var(--line); margin-top: 3rem; font-size: 0.85rem; }
@media (max-width: 480px) { body { margin: 1rem auto; padding: 0 0.6rem; } h1 { font-size: 1.5rem; } figure svg { min-width: 34rem; } }
@media print {
  :root { --text: #000; --page: #fff; --line: #999; --faint: #ccc; }
  body { max-width: none; margin: 0; font-size: 10pt; } nav, figcaption { display: none; }
  figure, table { break-inside: avoid; } h2 { break-after: avoid; } figure, .wide { overflow: visible; }
}
";

/// Widens the figures, which then scroll: a look at a few cycles without a network.
const SCRIPT: &str = "\
for (const figure of document.querySelectorAll('figure')) {
  const svg = figure.querySelector('svg'), caption = document.createElement('figcaption');
  let width = 1;
  for (const [sign, factor] of [['wider', 2], ['narrower', 0.5]]) {
    const button = document.createElement('button');
    button.textContent = sign;
    button.onclick = () => {
      width = Math.min(16, Math.max(1, width * factor));
      figure.classList.toggle('zoomed', width > 1);
      svg.style.width = width > 1 ? 100 * width + '%' : '';
      svg.style.height = width > 1 ? svg.viewBox.baseVal.height / 10 + 'px' : '';
      svg.setAttribute('preserveAspectRatio', width > 1 ? 'none' : 'xMidYMid');
    };
    caption.append(button, ' ');
  }
  figure.prepend(caption);
}
";

/// Nothing is loaded, and of scripts only the page's own runs, by the SHA-256 of what stands between its tags.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-5tr46VV6Dzz/FTxdJkueqC4qMdhdJa26ychCIuqfuAc='; base-uri 'none'; form-action 'none'";

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
        let contents: String = (1..).zip(&self.sections).map(entry).collect();
        let provenance: String =
            self.provenance.iter().map(|line| format!("<p>{}</p>\n", escaped_html(line))).collect();
        let footer = if provenance.is_empty() { String::new() } else { format!("<footer>\n{provenance}</footer>\n") };
        Ok(format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n\
             <body>\n<h1>{title}</h1>\n<nav>\n<ul>\n{contents}</ul>\n</nav>\n{sections}{footer}<script>\n{SCRIPT}</script>\n</body>\n</html>\n"
        ))
    }
}

impl Section {
    fn html(&self, place: usize) -> Result<String, ReportError> {
        let paragraphs: String = self.paragraphs.iter().map(|text| format!("<p>{}</p>\n", prose_html(text))).collect();
        let tables: String =
            self.tables.iter().map(|table| format!("<div class=\"wide\">\n{}</div>\n", table.html())).collect();
        let figures: String = self
            .figures
            .iter()
            .map(|figure| Ok(format!("<figure>\n{}</figure>\n", figure.svg()?)))
            .collect::<Result<_, ReportError>>()?;
        Ok(format!("<h2 id=\"part-{place}\">{}</h2>\n{paragraphs}{tables}{figures}", escaped_html(&self.title)))
    }
}
