//! Property tests: what must hold for every input.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

mod balance;
mod describing;
mod orbit_linear;
mod tolerance;
