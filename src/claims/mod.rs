//! The theory as values: every definition, lemma, theorem and identity with a checker that can fail.
//!
//! A claim holds as printed, or is refuted as printed and holds as corrected. It states its domain in parts; a check returns
//! the parts that it established, and the word for its evidence follows from comparing the two: nobody writes it.
//!
//! ```
//! use selfosc::claims::{Budget, Word, verify};
//! let findings = verify(&["lemma-1"], Budget { cases: 50, seed: 1 }).map_err(|id| format!("no claim {id}"))?;
//! assert_eq!(findings[0].word(), Word::Proved);
//! # Ok::<(), String>(())
//! ```

mod certificate;
mod checks;
mod distortion;
mod evidence;
mod formulas;
mod kernel_checked;
mod page;
mod registry;
mod sampling;
#[doc(hidden)]
pub mod tolerance;

pub use certificate::{Certificate, Shown};
pub use evidence::{ClaimDomain, ClaimPart, ClaimVariable, Evidence, Verdict, Witness, Word};
pub use formulas::formulas;
pub use kernel_checked::KernelChecked;
pub use registry::{AsPrinted, Checker, Claim, Finding, Hypothesis, Kind, verify};
pub use sampling::Budget;

#[doc(hidden)]
pub use checks::method_bias;

/// Every claim, each after those that it rests on.
pub const CLAIMS: &[Claim] = &[
    checks::fourier::FOURIER_COEFFICIENTS,
    checks::kernels::KERNEL_STEP,
    checks::kernels::KERNEL_RAMP,
    checks::kernels::KERNEL_SIGN,
    checks::kernels::KERNEL_BAND,
    checks::fourier::DESCRIBING_FUNCTION,
    checks::fourier::POLYNOMIAL,
    checks::power_law::POWER_LAW,
    checks::smooth::SINE,
    checks::smooth::SINH,
    checks::smooth::ARCTAN,
    checks::smooth::TANH,
    checks::fourier::ODD_HARMONICS,
    checks::fourier::ODD_HARMONICS_HYSTERETIC,
    checks::fourier::SINE_ABS_SINE,
    checks::symmetry::LEMMA_1,
    checks::symmetry::LEMMA_2,
    checks::theorems::THEOREM_2,
    checks::theorems::THEOREM_3,
    checks::relay::RELAY_Q,
    checks::relay::RELAY_P,
    checks::relay::RELAY_F0,
    checks::relay::SECOND_QUADRANT,
    checks::relay_state::NOISE,
    checks::relay::SWITCHING_CONDITION,
    checks::relay_state::SAMPLED_LEVEL,
    checks::tone::FIRST_HARMONIC,
    checks::tone::LINEAR_DRAG,
    checks::tone::QUADRATIC_DRAG,
    checks::identification::TABLE_3,
    checks::identification::DELAY_ROTATION,
    checks::quantisation::QUANTISATION_ALPHA,
    checks::quantisation::QUANTISATION_BETA,
    checks::quantisation::QUANTISATION_BETA_XX,
    checks::quantisation::QUANTISATION_ZERO,
    checks::sentences::CONFIDENCE_BOUNDS,
    checks::sentences::DISTURBANCE_AND_DRAG,
    checks::identification::RELATIVE_SPREAD,
    checks::identification::DRAG_DECISION,
    checks::identification::ZIG_ZAG,
    checks::bounded::BOUNDED_DUAL,
    checks::bounded::BOUNDED_MEAN_VALUE,
    checks::bounded::BOUNDED_CHAIN,
    checks::orbits::ORBIT_QUADRATIC,
    checks::orbits::ORBIT_LINEAR,
    checks::orbits::DELTA_FROM_TIMES,
    checks::orbits::METHOD_BIAS,
    checks::orbits::BALANCE_CONVERGES,
    checks::thruster::THRUSTER_BILINEAR,
    checks::thruster::THRUSTER_AFFINE,
    checks::thruster::THRUSTER_ASYMMETRIC,
    checks::thruster::ALLOCATION,
    checks::thruster::COMPENSATION,
    checks::vehicle::KINEMATICS,
    checks::vehicle::SIX_AXES,
    checks::vehicle::UNCOUPLED_AXIS,
    checks::experiment::DELAYS_ADD,
    checks::experiment::HEAVE,
    checks::experiment::SURGE,
    checks::experiment::PROCEDURE,
    checks::experiment::HARMONIC_BALANCE,
    checks::existence::RIGOROUS_DESCRIBING_FUNCTION,
    checks::orbit_proofs::NO_EARLY_SWITCHING,
    checks::orbit_proofs::MULTIPLIER,
    checks::orbit_proofs::QUADRATIC_DISTURBED,
    checks::orbit_proofs::LINEAR_DISTURBED,
    checks::orbit_proofs::AMPLITUDE_MONOTONE_QUADRATIC,
    checks::orbit_proofs::AMPLITUDE_MONOTONE_LINEAR,
    checks::orbit_proofs::BIAS_ALPHA_LINEAR,
    checks::orbit_proofs::BIAS_BETA_LINEAR,
    checks::orbit_proofs::BIAS_ALPHA_QUADRATIC,
    checks::orbit_proofs::BIAS_BETA_QUADRATIC,
    checks::control::POLE_PLACEMENT,
    checks::control::DELAY_MARGIN,
    checks::control::RELAY_ULTIMATE,
    checks::autotune::RELAY_FIRST_ORDER,
    checks::autotune::AMIGO_SENSITIVITY,
    checks::on_board::ON_BOARD_ENDS,
    checks::on_board::ON_BOARD_SWITCHES,
    checks::on_board::ON_BOARD_ABORT,
    checks::on_board::ON_BOARD_LIMITS,
    checks::on_board::ON_BOARD_FAULTS,
    checks::on_board::ON_BOARD_EXCURSION,
    checks::on_board::ON_BOARD_STILL,
];
