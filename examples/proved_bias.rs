//! Prints a proof that an odd characteristic with an integrating plant oscillates with a bias.
//!
//! `cargo run --example proved_bias > oscillation.json`; then `selfosc verify --check oscillation.json`.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use selfosc::balance::{LipschitzLoop, OddCharacteristic};
use selfosc::plant::TransferFunction;

/// The loop, the proof, and its document on standard output.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Slopes -1 up to 0.5, 2 up to 2 and 0 beyond; the same below zero.
    let characteristic = OddCharacteristic::PiecewiseLinear { kinks: vec![0.5, 2.0], slopes: vec![-1.0, 2.0, 0.0] };
    let plant = TransferFunction::new(&[1.2], &[1.0, 2.0, 1.0, 0.0])?;
    let proved = LipschitzLoop::new(&plant, characteristic)?.prove_biased_near(0.7, 0.3, 1.0)?;
    println!("{proved}");
    Ok(())
}
