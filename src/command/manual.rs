//! `selfosc completions` and `selfosc man`: the command's interface for shells and `man`.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use super::{Command, CommandError, Outcome, files};

/// A script by which a shell completes subcommands and flags.
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  selfosc completions bash > ~/.local/share/bash-completion/completions/selfosc")]
pub(super) struct Completions {
    /// Whose script
    #[arg(value_enum)]
    shell: Shell,
}

/// Manual pages, one for the command and one for each subcommand.
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  selfosc man man1 && man ./man1/selfosc-identify.1")]
pub(super) struct Manual {
    /// Folder to write them to
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

pub(super) fn completions(arguments: &Completions, output: &mut impl Write) -> Result<Outcome, CommandError> {
    // The generator panics where a reader has seen enough.
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Command::command(), "selfosc", &mut script);
    output.write_all(&script)?;
    Ok(Outcome::Done)
}

pub(super) fn manual(arguments: &Manual) -> Result<Outcome, CommandError> {
    crate::files::folder(&arguments.folder)?;
    let command = Command::command();
    let page = |command: clap::Command, name: &str| {
        let mut text = Vec::new();
        clap_mangen::Man::new(command).title(name.to_owned()).render(&mut text)?;
        let path = arguments.folder.join(format!("{name}.1"));
        Ok::<_, CommandError>(files::write(&path, &String::from_utf8_lossy(&text))?)
    };
    for subcommand in command.get_subcommands() {
        let name = format!("selfosc-{}", subcommand.get_name());
        page(subcommand.clone().bin_name(name.replacen('-', " ", 1)), &name)?;
    }
    page(command, "selfosc")?;
    Ok(Outcome::Done)
}
