//! Benchmarks of the describing functions.

fn main() {}
