//! The command `selfosc`.

use std::process::ExitCode;

fn main() -> ExitCode {
    selfosc::command::run()
}
