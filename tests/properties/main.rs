//! Property tests: what must hold for every input.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

mod architecture;
mod balance;
mod cases;
mod catalogue;
mod certificate;
mod claims;
mod describing;
mod fourier_oracle;
mod integration_oracle;
mod interval;
mod laws;
mod motion_drag_axis;
mod oracle;
mod orbit_certified;
mod orbit_drag_axis;
mod orbit_linear;
mod paper;
mod tolerance;
mod vehicle;
