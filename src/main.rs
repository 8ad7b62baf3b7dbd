//! The command `selfosc`.

fn main() {}
