//! `selfosc reproduce`: the paper from its printed data.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;
use serde_json::{Value, json};

use super::error::Given;
use super::{CommandError, Outcome, files, write_json};
use crate::paper::audit::{Group, Item};
use crate::report::paper::{PARTS, Part, Reproduction};

/// The paper's tables and figures from its printed data, and every printed number against its recomputation.
///
/// Inputs are known to half a unit of the last printed decimal; a printed number agrees where it meets the range that such
/// inputs allow.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc reproduce
  selfosc reproduce --only table3 audit
  selfosc reproduce --out paper
  selfosc reproduce --json")]
pub(super) struct Arguments {
    /// Writes Markdown, CSV, LaTeX, SVG and one report.html into this folder, and makes it if need be
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Only these parts
    #[arg(long, value_name = "NAME", num_args = 1.., value_parser = PossibleValuesParser::new(PARTS.iter().map(|part| part.name)))]
    only: Vec<String>,
    /// Prints one JSON document
    #[arg(long)]
    json: bool,
}

impl Arguments {
    fn asks_for(&self, name: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|only| only == name)
    }
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let reproduction = Reproduction::new()?;
    let parts: Vec<&Part> = PARTS.iter().filter(|part| arguments.asks_for(part.name)).collect();
    let files = match &arguments.out {
        Some(folder) => Some((folder, write_files(&reproduction, &parts, folder)?)),
        None => None,
    };
    if arguments.json {
        write_json(output, &document(&reproduction, arguments))?;
        return Ok(Outcome::Done);
    }
    if arguments.only.is_empty() {
        write!(output, "{}", reproduction.summary())?;
    } else {
        show(&reproduction, &parts, output)?;
    }
    if let Some((folder, count)) = files {
        writeln!(output, "\n{count} files in {}; start with report.html", folder.display())?;
    }
    Ok(Outcome::Done)
}

fn show(reproduction: &Reproduction, parts: &[&Part], output: &mut impl Write) -> Result<(), CommandError> {
    for part in parts {
        let tables = part.tables(reproduction)?;
        if tables.is_empty() {
            writeln!(output, "{} is a figure: --out DIR draws it\n", part.name)?;
        }
        for table in tables {
            writeln!(output, "{}", table.text())?;
        }
    }
    Ok(())
}

/// Every file of these parts; how many there are.
fn write_files(reproduction: &Reproduction, parts: &[&'static Part], folder: &Path) -> Result<usize, CommandError> {
    crate::files::folder(folder).given("--out")?;
    let mut count = 0;
    let mut write = |name: &str, extension: &str, content: &str| {
        let path = folder.join(format!("{name}.{extension}"));
        count += 1;
        files::write(&path, content).given("--out")
    };
    // The outcome first, where the whole is asked for.
    let story = (parts.len() == PARTS.len()).then(|| reproduction.story());
    let mut sections = Vec::from_iter(story);
    for part in parts {
        let section = part.section(reproduction)?;
        for table in &section.tables {
            write(table.name, "md", &table.markdown())?;
            write(table.name, "csv", &table.csv()?)?;
            write(table.name, "tex", &table.latex())?;
        }
        for figure in &section.figures {
            write(figure.name, "svg", &figure.svg()?)?;
        }
        sections.push(section);
    }
    write("report", "html", &Reproduction::document(sections).html()?)?;
    Ok(count)
}

/// What is not asked for is null.
fn document(reproduction: &Reproduction, arguments: &Arguments) -> Value {
    let asked = |name: &str, value: fn(&Reproduction) -> Value| {
        if arguments.asks_for(name) { value(reproduction) } else { Value::Null }
    };
    json!({
        "table4": asked("table4", |reproduction| json!(reproduction.table4)),
        "figure15": asked("fig15", |reproduction| json!(reproduction.figure15)),
        "joint": asked("joint", |reproduction| json!(reproduction.joint)),
        "audit": asked("audit", |reproduction| reproduction.audit.iter().flat_map(items).collect()),
        "consistency": asked("audit", |reproduction| json!(reproduction.consistency())),
    })
}

/// The items of a group, each with the group's name.
fn items(group: &Group) -> impl Iterator<Item = Value> {
    #[derive(serde::Serialize)]
    struct Named<'a> {
        group: &'a str,
        #[serde(flatten)]
        item: &'a Item,
    }
    group.items.iter().map(|item| json!(Named { group: &group.name, item }))
}
