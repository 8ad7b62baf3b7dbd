//! Property tests: what must hold for every input.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

mod architecture;
mod claims;
mod describing;
mod identify_exact;
mod identify_joint;
mod tolerance;
