//! Snapshots: what users see, word for word.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

mod arguments;
mod bad_processes;
mod catalogue;
mod clinic;
mod command;
mod files;
mod forgeries;
mod identify;
mod paper;
mod readme;
mod refusals;
mod run;

/// Compares with `golden/<name>.snap`.
macro_rules! golden {
    ($name:literal, $value:expr) => {
        insta::with_settings!({ snapshot_path => "golden", prepend_module_to_snapshot => false, omit_expression => true }, {
            insta::assert_snapshot!($name, $value)
        })
    };
}
pub(crate) use golden;
