//! What is true in the paper: the claims, as printed and as corrected.
//!
//! `cargo run --example true_in_the_paper`
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use selfosc::claims::{Budget, CLAIMS, Claim};

/// Runs it; an error is a failure.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let budget = Budget { cases: 100, seed: 1 };
    let lemma = Claim::find("lemma-1").ok_or("no such claim")?;
    let finding = lemma.check(budget);
    let printed = finding.printed.ok_or("the paper does not say it")?;
    println!("{}: {}\n  as printed: {printed:?}", lemma.id, lemma.statement);
    assert!(printed.is_refuted());

    let corrected = finding.corrected.ok_or("there is no correction")?;
    println!("  as corrected: {corrected:?}");
    assert!(corrected.holds());

    // A checker that could not fail would be worth nothing: each has a false statement that it refutes.
    assert!((lemma.falsified)(budget).is_refuted());
    println!("{} claims in all: `selfosc verify` checks every one", CLAIMS.len());
    Ok(())
}
