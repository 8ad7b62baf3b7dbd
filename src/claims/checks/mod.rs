//! The claims by topic, each with its checks: sampled cases, proofs, false variants.

use super::distortion::Distortion;
use super::evidence::{ClaimDomain, ClaimPart, ClaimVariable, Evidence, Verdict, Witness};
use super::registry::{Hypothesis, claim, drawn};
use super::sampling::{Case, Draw};
use super::tolerance;

mod algebra;
pub mod band;
pub mod decomposition;
mod family;
mod machine;
pub mod step;
pub mod vehicle_proofs;

pub(super) use algebra::exactly;

pub(super) mod autotune;
pub(super) mod bounded;
pub(super) mod control;
pub(super) mod existence;
pub(super) mod experiment;
pub(super) mod fourier;
pub(super) mod identification;
pub(super) mod kernels;
pub mod method_bias;
pub(super) mod on_board;
pub(super) mod orbit_proofs;
pub(super) mod orbits;
pub mod power_law;
pub(super) mod quantisation;
pub(super) mod relay;
pub(super) mod relay_state;
pub(super) mod sentences;
pub(super) mod smooth;
pub(super) mod symmetry;
pub(super) mod theorems;
pub(super) mod thruster;
pub(super) mod tone;
pub(super) mod vehicle;
