#![doc = include_str!("../README.md")]

pub mod ask;
pub mod crossing;
pub mod describing;
pub mod linear;
pub mod plant;
pub mod random;
pub mod relay;
pub mod scalar;
