//! Every example runs to its end.
#![allow(unreachable_pub, reason = "an example's `main` is called from here")]

use std::collections::BTreeSet;
use std::path::Path;

#[path = "../../examples/describing_function.rs"]
mod describing_function;
#[path = "../../examples/limit_cycle.rs"]
mod limit_cycle;
#[path = "../../examples/nyquist_balance.rs"]
mod nyquist_balance;
#[path = "../../examples/true_in_the_paper.rs"]
mod true_in_the_paper;

macro_rules! run {
    ($($name:ident),+ $(,)?) => {
        const LISTED: &[&str] = &[$(stringify!($name)),+];

        mod run {
            $(
                #[test]
                fn $name() {
                    super::$name::main().unwrap();
                }
            )+
        }
    };
}
run!(describing_function, limit_cycle, nyquist_balance, true_in_the_paper);

#[test]
fn none_is_left_out() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let names: BTreeSet<String> = files.map(|path| path.file_stem().unwrap().to_string_lossy().into_owned()).collect();
    assert_eq!(names, LISTED.iter().map(|&name| name.to_owned()).collect());
}
