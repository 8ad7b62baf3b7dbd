#![doc = include_str!("../README.md")]

pub mod answer;
pub mod command;
pub mod experiment;
pub mod force;
pub mod information;
pub mod integrate;
pub mod kinds;
mod plan;
pub mod random;
pub mod scenario;
pub mod score;
pub mod sensor;
pub mod truth;
pub mod vehicle;
