//! Harmonic balance (eqs. 16-20): the oscillations that a describing function predicts for a linear plant in the loop.
//!
//! The loop is that of [`orbit`](crate::orbit): characteristic input `e = r - y`, plant input `N(e) + disturbance`.

mod drag_axis;
mod error;
mod harmonics;
mod intersections;
mod nyquist;
mod nyquist_count;
mod rigorous;

pub use drag_axis::AxisOscillation;
pub use error::BalanceError;
pub use harmonics::MultiHarmonic;
pub use intersections::{Bias, HarmonicBalance, Intersection};
pub use nyquist::{negative_inverse_locus, nyquist_locus};
pub use rigorous::{
    CannotTell, ExistenceError, HarmonicOrders, LipschitzLoop, OddCharacteristic, Oscillations, ProvedOscillation,
    UnprovedOscillation,
};
