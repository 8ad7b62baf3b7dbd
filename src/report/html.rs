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

const STYLE: &str = include_str!("page.css");

/// A click zooms in; where the pointer is, the caption says in the numbers of the axes.
const SCRIPT: &str = include_str!("page.js");

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
