//! The self-oscillation of a drag axis: exact, and as harmonic balance has it.
//!
//! `cargo run --example limit_cycle`
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use selfosc::balance::AxisOscillation;
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::limit_cycle;
use selfosc::plant::DragAxis;

/// Runs it; an error is a failure.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Yaw in N m and rad, with a constant pull and the delay of the loop.
    let axis = DragAxis::quadratic(0.033, 0.007)?.with_disturbance(0.01)?.with_delay_s(0.2)?;
    let relay = RelayHysteresis::new(0.08, 0.2, 0.0)?;
    let exact = limit_cycle(&axis, &relay)?;
    let approximate = AxisOscillation::predict(&axis, &relay)?;
    println!("exact:            X_m = {:.4} rad, T = {:.4} s", exact.amplitude, exact.period_s);
    println!("harmonic balance: X_m = {:.4} rad, T = {:.4} s", approximate.amplitude, approximate.period_s());
    assert!((approximate.period_s() / exact.period_s - 1.0).abs() < 0.1);
    // Deviations shrink from one period to the next.
    assert!(exact.multiplier > 0.0 && exact.multiplier < 1.0);

    // A pull stronger than the relay leaves no oscillation, and that is said.
    assert!(limit_cycle(&axis.with_disturbance(0.09)?, &relay).is_err());
    Ok(())
}
