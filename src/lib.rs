//! Self-oscillations under a relay: describing functions, exact limit cycles, identification of vehicles from them, and
//! the theory behind it as executable claims.
//!
//! | job | start with |
//! |---|---|
//! | describe a characteristic | [`nonlinearity`], [`describing::ClosedForm`] |
//! | predict an oscillation | [`orbit::limit_cycle`], [`orbit::orbits`], [`balance::HarmonicBalance`] |
//! | identify a vehicle from logs | `identify::Session` (with the feature `std`) |
//! | tune a controller for it | [`control::Tuning`] |
//! | tune any process from a relay record | [`autotune::ProcessReadings`], `autotune::ProcessRecord` (with the feature `std`) |
//! | verify the theory | `claims::verify` (with the feature `std`) |
//!
//! The page `guide` works through a log, an orbit and a claim, lists units, and compares other tools.
//!
//! [`prelude`] has the names that these jobs need. Without the feature `std` the library neither allocates nor panics on
//! input; [`on_board`] runs the whole experiment there. What can refuse gives finite numbers in the domain that its page states,
//! or refuses; a plain formula, such as a motion over a time, gives what the arithmetic gives, an infinity included.
//!
//! Data flows one way, and the modules stand below in that order.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `std` | records and logs, fits, certificates, claims, the paper |
//! | `report` | figures and pages |
//! | `command` (default) | the command `selfosc` |
//! | `theory` (default) | its subcommands `reproduce` and `verify` |
//! | `internals` | what the tests of this package reach into: no promise, nothing documented |
#![cfg_attr(not(feature = "std"), no_std)]
// Numbers do not depend on the machine's elementary functions: clippy.toml. Tests judge by those.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// What only tests reach is public with the feature `internals` and is checked there.
#![cfg_attr(not(feature = "internals"), allow(dead_code, unreachable_pub, unused_imports))]
// Public pages may name what stands behind them.
#![allow(rustdoc::private_intra_doc_links)]

/// Declares what only this crate and its tests use: public with the feature `internals`, which promises nothing.
macro_rules! internal {
    ($($(#[$attribute:meta])* mod $name:ident;)+) => { $(
        $(#[$attribute])*
        #[cfg(feature = "internals")]
        #[doc(hidden)]
        pub mod $name;
        $(#[$attribute])*
        #[cfg(not(feature = "internals"))]
        pub(crate) mod $name;
    )+ };
    ($($(#[$attribute:meta])* use $module:ident::{$($name:ident),+ $(,)?};)+) => { $(
        $(#[$attribute])*
        #[cfg(feature = "internals")]
        #[doc(hidden)]
        pub use $module::{$($name),+};
        $(#[$attribute])*
        #[cfg(not(feature = "internals"))]
        pub(crate) use $module::{$($name),+};
    )+ };
}

pub mod numeric;

#[cfg(feature = "std")]
pub mod files;

internal! { mod proof; }

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

pub mod autotune;

#[cfg(feature = "std")]
pub mod claims;
#[cfg(feature = "std")]
pub mod paper;

#[cfg(feature = "command")]
#[doc(hidden)]
pub mod command;
#[cfg(feature = "report")]
pub mod report;

pub mod prelude;

#[cfg(feature = "std")]
mod error;
#[cfg(feature = "std")]
pub use error::Error;

/// A guide: worked pages, units, other tools.
#[cfg(all(feature = "std", any(doc, doctest)))]
#[doc = include_str!("../spec/guide.md")]
pub mod guide {}

/// The Rust blocks of the README, compiled and run as tests.
#[cfg(all(doctest, feature = "std"))]
#[doc = include_str!("../README.md")]
struct Readme;
