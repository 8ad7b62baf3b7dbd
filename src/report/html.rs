//! One HTML file with everything in it.

use super::table::escaped_html;
use super::{Figure, ReportError, Table};

/// Text, tables and figures under one heading.
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
}

const STYLE: &str = "\
body { font: 16px/1.5 sans-serif; color: #222; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
h2 { border-top: 1px solid #ccc; padding-top: 1rem; margin-top: 2.5rem; }
table { border-collapse: collapse; margin: 1rem 0; font-size: 0.9rem; }
caption { text-align: left; font-weight: bold; padding-bottom: 0.4rem; }
th, td { text-align: left; padding: 0.15rem 0.8rem 0.15rem 0; border-bottom: 1px solid #e4e4e4; vertical-align: top; }
.number { text-align: right; font-variant-numeric: tabular-nums; }
svg { max-width: 100%; height: auto; }
figure { margin: 1.5rem 0; }
";

impl Document {
    /// The file's text.
    ///
    /// # Errors
    /// [`ReportError::Figure`] where a figure cannot be drawn.
    pub fn html(&self) -> Result<String, ReportError> {
        let title = escaped_html(&self.title);
        let sections: String = self.sections.iter().map(Section::html).collect::<Result<_, _>>()?;
        Ok(format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n\
             <body>\n<h1>{title}</h1>\n{sections}</body>\n</html>\n"
        ))
    }
}

impl Section {
    fn html(&self) -> Result<String, ReportError> {
        let paragraphs: String =
            self.paragraphs.iter().map(|text| format!("<p>{}</p>\n", escaped_html(text))).collect();
        let tables: String = self.tables.iter().map(Table::html).collect();
        let figures: String = self
            .figures
            .iter()
            .map(|figure| Ok(format!("<figure>\n{}</figure>\n", figure.svg()?)))
            .collect::<Result<_, ReportError>>()?;
        Ok(format!("<h2>{}</h2>\n{paragraphs}{tables}{figures}", escaped_html(&self.title)))
    }
}
