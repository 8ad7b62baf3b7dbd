//! Property tests: what must hold for every input.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

mod architecture;
mod balance;
mod certificate;
mod claims;
mod describing;
mod interval;
mod oracle;
mod integration_oracle;
mod orbit_linear;
mod motion_drag_axis;
mod orbit_drag_axis;
mod tolerance;
mod vehicle;
