//! The command `selfosc`, as it is: arguments, files and output are those that the page gives to the module.

mod libc;

use std::process::ExitCode;

fn main() -> ExitCode {
    selfosc::command::run()
}
