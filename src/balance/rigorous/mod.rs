//! A rigorous describing function: oscillations of a plant with an odd characteristic of bounded slope, proved to exist in a box.
//!
//! Bergen and Franks (1971), Mees and Bergen (1975): the first harmonic's error is bounded by the plant's damping of
//! the rest. Here the harmonics up to K are unknowns, which makes the bound small, and the box is of frequency and
//! harmonics: the odd alone, or the mean and all.

mod brouwer;
mod characteristic;
mod closed_loop;
mod error;
mod oscillation;
mod refine;
mod spectrum;
mod starts;
mod wave;

pub use characteristic::OddCharacteristic;
pub use closed_loop::LipschitzLoop;
pub use error::{CannotTell, ExistenceError};
pub use oscillation::{Oscillations, ProvedOscillation, UnprovedOscillation};
pub use wave::HarmonicOrders;
