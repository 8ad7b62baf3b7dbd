//! Self-oscillations under a relay: describing functions, exact limit cycles, identification of vehicles from them, and
//! the theory behind it as executable claims.
//!
//! Data flows one way, and the modules stand below in that order.
#![cfg_attr(not(feature = "std"), no_std)]

pub mod numeric;

pub mod proof;

pub mod nonlinearity;

pub mod describing;

pub mod plant;

#[cfg(feature = "std")]
pub mod balance;
pub mod orbit;

pub mod experiment;

pub mod features;

pub mod identify;

pub mod on_board;

pub mod vehicle;

pub mod control;

#[cfg(feature = "std")]
pub mod claims;
#[cfg(feature = "std")]
pub mod paper;

#[cfg(feature = "command")]
pub mod command;
#[cfg(feature = "report")]
pub mod report;

#[cfg(feature = "std")]
mod error;
#[cfg(feature = "std")]
pub use error::Error;

/// The Rust blocks of the README, compiled and run as tests.
#[cfg(all(doctest, feature = "std"))]
#[doc = include_str!("../README.md")]
struct Readme;
