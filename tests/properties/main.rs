//! Property tests: what must hold for every input.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

mod cases;
mod catalogue;
mod describing;
mod laws;
mod oracle;
mod tolerance;
