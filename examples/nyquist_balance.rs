//! Harmonic balance of a transfer function with a saturation: where -1/N meets the Nyquist curve.
//!
//! `cargo run --example nyquist_balance`
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use selfosc::balance::{HarmonicBalance, negative_inverse_locus, nyquist_locus};
use selfosc::describing::ClosedForm;
use selfosc::nonlinearity::Saturation;
use selfosc::plant::TransferFunction;

/// Runs it; an error is a failure.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let plant = TransferFunction::new(&[8.0], &[1.0, 2.0, 2.0, 1.0])?;
    let saturation = Saturation::new(1.0, 1.0)?;
    let describing = |sweep: &_| saturation.describing_function(sweep);
    let found = HarmonicBalance::new(&plant, describing)?.intersections()?;
    for one in &found {
        println!("X = {:.6}, w = {:.6} rad/s, stable: {:?}", one.amplitude, one.omega_rad_s, one.stable);
    }
    assert_eq!(found.len(), 1);
    assert!((found[0].amplitude - 3.343_998_730_206).abs() < 1e-9);
    assert!((found[0].omega_rad_s - 2f64.sqrt()).abs() < 1e-9);

    // The two curves, to draw: both pass the point of balance.
    let balance = plant.response(found[0].omega_rad_s)?;
    let curve = nyquist_locus(&plant, 0.1..=10.0)?;
    let inverse = negative_inverse_locus(describing, 0.0, 1.0..=10.0)?;
    let nearest = |points: &[(f64, nalgebra::Complex<f64>)]| {
        points.iter().map(|point| (point.1 - balance).norm()).fold(f64::INFINITY, f64::min)
    };
    println!("{} and {} points", curve.len(), inverse.len());
    assert!(nearest(&curve) < 0.1 * balance.norm() && nearest(&inverse) < 0.1 * balance.norm());
    Ok(())
}
