//! The theory as values: every definition, lemma, theorem and identity with a checker that can fail.
//!
//! A claim holds as printed, or is refuted as printed and holds as corrected. Sampling is evidence and is called
//! sampling; a proof is an enclosure over a stated domain.

mod claim;
mod sampling;
mod single;
mod verdict;

mod family;
pub mod tolerance;

pub mod control;
pub mod experiment;
pub mod fourier;
pub mod identification;
pub mod kernels;
mod machine;
pub mod method_bias;
pub mod on_board;
pub mod orbit_proofs;
pub mod orbits;
pub mod power_law;
pub mod proof;
pub mod relay;
pub mod smooth;
pub mod symmetry;
pub mod theorems;
pub mod thruster;
pub mod vehicle;

pub use claim::{Checker, Claim, Finding, Hypothesis, Kind, Printed};
pub use sampling::{Budget, Case, Draw, sample};
pub use verdict::{Evidence, Verdict, Witness};

/// Hands the module and constant of every claim to a macro: the one list that the registry and the tests are made from.
#[macro_export]
macro_rules! for_each_claim {
    ($callback:ident) => {
        $callback! {
            fourier::FOURIER_COEFFICIENTS,
            kernels::KERNEL_STEP,
            kernels::KERNEL_RAMP,
            kernels::KERNEL_SIGN,
            kernels::KERNEL_BAND,
            fourier::DESCRIBING_FUNCTION,
            fourier::POLYNOMIAL,
            power_law::POWER_LAW,
            smooth::SINE,
            smooth::SINH,
            smooth::ARCTAN,
            smooth::TANH,
            fourier::ODD_HARMONICS,
            fourier::ODD_HARMONICS_HYSTERETIC,
            fourier::SINE_ABS_SINE,
            symmetry::LEMMA_1,
            symmetry::LEMMA_2,
            theorems::THEOREM_2,
            theorems::THEOREM_3,
            relay::RELAY_Q,
            relay::RELAY_P,
            relay::RELAY_F0,
            relay::SECOND_QUADRANT,
            relay::NOISE,
            relay::SWITCHING_CONDITION,
            relay::SAMPLED_LEVEL,
            identification::FIRST_HARMONIC,
            identification::LINEAR_DRAG,
            identification::QUADRATIC_DRAG,
            identification::TABLE_3,
            identification::DELAY_ROTATION,
            identification::QUANTISATION_ALPHA,
            identification::QUANTISATION_BETA,
            identification::QUANTISATION_BETA_XX,
            identification::QUANTISATION_ZERO,
            identification::RELATIVE_SPREAD,
            identification::DRAG_DECISION,
            identification::ZIG_ZAG,
            orbits::ORBIT_QUADRATIC,
            orbits::ORBIT_LINEAR,
            orbits::DELTA_FROM_TIMES,
            orbits::METHOD_BIAS,
            orbits::BALANCE_CONVERGES,
            thruster::THRUSTER_BILINEAR,
            thruster::THRUSTER_AFFINE,
            thruster::THRUSTER_ASYMMETRIC,
            thruster::ALLOCATION,
            thruster::COMPENSATION,
            vehicle::KINEMATICS,
            vehicle::SIX_AXES,
            vehicle::UNCOUPLED_AXIS,
            experiment::DELAYS_ADD,
            experiment::HEAVE,
            experiment::SURGE,
            experiment::PROCEDURE,
            experiment::HARMONIC_BALANCE,
            orbit_proofs::NO_EARLY_SWITCHING,
            orbit_proofs::MULTIPLIER,
            orbit_proofs::QUADRATIC_DISTURBED,
            orbit_proofs::LINEAR_DISTURBED,
            orbit_proofs::AMPLITUDE_MONOTONE_QUADRATIC,
            orbit_proofs::AMPLITUDE_MONOTONE_LINEAR,
            orbit_proofs::BIAS_ALPHA_LINEAR,
            orbit_proofs::BIAS_BETA_LINEAR,
            orbit_proofs::BIAS_ALPHA_QUADRATIC,
            orbit_proofs::BIAS_BETA_QUADRATIC,
            control::POLE_PLACEMENT,
            control::DELAY_MARGIN,
            control::RELAY_ULTIMATE,
            on_board::ON_BOARD_ENDS,
            on_board::ON_BOARD_SWITCHES,
            on_board::ON_BOARD_ABORT,
            on_board::ON_BOARD_LIMITS,
            on_board::ON_BOARD_FAULTS,
        }
    };
}

macro_rules! registry {
    ($($module:ident::$constant:ident),+ $(,)?) => {
        /// Every claim.
        pub const CLAIMS: &[Claim] = &[$($module::$constant),+];
    };
}
for_each_claim!(registry);

impl Claim {
    /// The claim of that id.
    #[must_use]
    pub fn find(id: &str) -> Option<&'static Self> {
        CLAIMS.iter().find(|claim| claim.id == id)
    }
}
