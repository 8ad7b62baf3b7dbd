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

internal! {
    use checks::{band, decomposition, power_law, step, vehicle_proofs};
    use distortion::{Distortion};
}

/// The list of claims from rows of those that stand in a file of `checks`.
macro_rules! registry {
    ($($file:ident: $($claim:ident)+;)+) => {
        /// Every claim, each after those that it rests on.
        pub const CLAIMS: &[Claim] = &[$($(checks::$file::$claim),+),+];
    };
}

registry! {
    fourier: FOURIER_COEFFICIENTS;
    kernels: KERNEL_STEP KERNEL_RAMP KERNEL_SIGN KERNEL_BAND;
    fourier: DESCRIBING_FUNCTION POLYNOMIAL;
    power_law: POWER_LAW;
    smooth: SINE SINH ARCTAN TANH;
    fourier: ODD_HARMONICS ODD_HARMONICS_HYSTERETIC SINE_ABS_SINE;
    symmetry: LEMMA_1 LEMMA_2;
    theorems: THEOREM_2 THEOREM_3;
    relay: RELAY_Q RELAY_P RELAY_F0 SECOND_QUADRANT;
    relay_state: NOISE;
    relay: SWITCHING_CONDITION;
    relay_state: SAMPLED_LEVEL;
    tone: FIRST_HARMONIC LINEAR_DRAG QUADRATIC_DRAG;
    identification: TABLE_3 DELAY_ROTATION;
    quantisation: QUANTISATION_ALPHA QUANTISATION_BETA QUANTISATION_BETA_XX QUANTISATION_ZERO;
    sentences: CONFIDENCE_BOUNDS DISTURBANCE_AND_DRAG;
    identification: RELATIVE_SPREAD DRAG_DECISION ZIG_ZAG;
    bounded: BOUNDED_DUAL BOUNDED_MEAN_VALUE BOUNDED_CHAIN;
    orbits: ORBIT_QUADRATIC ORBIT_LINEAR DELTA_FROM_TIMES METHOD_BIAS BALANCE_CONVERGES;
    thruster: THRUSTER_BILINEAR THRUSTER_AFFINE THRUSTER_ASYMMETRIC ALLOCATION COMPENSATION;
    vehicle: KINEMATICS SIX_AXES UNCOUPLED_AXIS;
    experiment: DELAYS_ADD HEAVE SURGE PROCEDURE HARMONIC_BALANCE;
    existence: RIGOROUS_DESCRIBING_FUNCTION;
    orbit_proofs: NO_EARLY_SWITCHING MULTIPLIER QUADRATIC_DISTURBED LINEAR_DISTURBED AMPLITUDE_MONOTONE_QUADRATIC
        AMPLITUDE_MONOTONE_LINEAR BIAS_ALPHA_LINEAR BIAS_BETA_LINEAR BIAS_ALPHA_QUADRATIC BIAS_BETA_QUADRATIC;
    control: POLE_PLACEMENT DELAY_MARGIN RELAY_ULTIMATE;
    autotune: RELAY_FIRST_ORDER AMIGO_SENSITIVITY;
    on_board: ON_BOARD_ENDS ON_BOARD_SWITCHES ON_BOARD_ABORT ON_BOARD_LIMITS ON_BOARD_FAULTS ON_BOARD_EXCURSION
        ON_BOARD_STILL;
}
