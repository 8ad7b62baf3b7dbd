//! The describing function of a relay with hysteresis: closed form, quadrature, and what it refuses.
//!
//! `cargo run --example describing_function`
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use selfosc::describing::{ClosedForm, by_quadrature};
use selfosc::nonlinearity::{RelayHysteresis, Sinusoid};

/// Runs it; an error is a failure.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let relay = RelayHysteresis::new(1.0, 0.3, 0.0)?;
    let sweep = Sinusoid::new(0.1, 1.0)?;
    let closed = relay.describing_function(&sweep)?;
    let integral = by_quadrature(&relay, &sweep)?;
    println!("F_0 = {:.6}, P = {:.6}, Q = {:.6}", closed.f0, closed.p, closed.q);
    assert!((closed.p - integral.p).abs() < 1e-11 && (closed.q - integral.q).abs() < 1e-11);
    // Eq. 30: Q does not depend on the bias.
    assert!((closed.q + 4.0 * 0.3 / std::f64::consts::PI).abs() < 1e-14);

    // Below the switching amplitude there is no oscillation: an answer, not NaN.
    match relay.describing_function(&Sinusoid::new(0.1, 0.35)?) {
        Err(reason) => println!("{reason}"),
        Ok(_) => return Err("an amplitude below switching must be refused".into()),
    }
    Ok(())
}
