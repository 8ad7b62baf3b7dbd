//! Property tests: what must hold for every input.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

mod architecture;
mod balance;
mod certificate;
mod claims;
mod describing;
mod integration_oracle;
mod interval;
mod motion_drag_axis;
mod oracle;
mod orbit_drag_axis;
mod orbit_linear;
mod identify_exact;
mod identify_joint;
mod tolerance;
mod vehicle;
