#![doc = include_str!("../README.md")]

pub mod command;
pub mod experiment;
pub mod force;
pub mod integrate;
pub mod kinds;
mod plan;
pub mod random;
pub mod scenario;
pub mod sensor;
pub mod truth;
pub mod vehicle;
