//! Linear plants with dead time and a static characteristic in negative feedback: `y = G u`, `u = -n(y)`.

pub mod answer;
pub mod characteristic;
pub mod closed_loop;
pub mod counterexamples;
pub mod cycle;
pub mod first_harmonic;
pub mod harmonic_balance;
pub mod judge;
pub mod late_loop;
pub mod loops;
pub mod spectrum;
pub mod truth;
