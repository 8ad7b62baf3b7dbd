//! The experiment: a relay in the loop.

mod relay;

pub use relay::Relay;
