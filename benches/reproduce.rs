//! Speed of `selfosc reproduce` without files. Target: a whole reproduction below 0.2 s.
#![allow(clippy::unwrap_used, reason = "a benchmark may panic")]

use divan::{Bencher, black_box};
use selfosc::report::paper::{PARTS, Reproduction};

fn main() {
    divan::main();
}

#[divan::bench]
fn numbers() -> Reproduction {
    Reproduction::new().unwrap()
}

#[divan::bench]
fn summary(bencher: Bencher<'_, '_>) {
    let reproduction = Reproduction::new().unwrap();
    bencher.bench_local(|| black_box(&reproduction).summary());
}

/// One part with its tables and figures.
#[divan::bench(args = PARTS.iter().map(|part| part.name))]
fn part(bencher: Bencher<'_, '_>, name: &str) {
    let reproduction = Reproduction::new().unwrap();
    let part = PARTS.iter().find(|part| part.name == name).unwrap();
    bencher.bench_local(|| part.section(black_box(&reproduction)).unwrap());
}
