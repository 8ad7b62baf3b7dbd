//! Writes records.
fn main() {}
