//! Property tests: what must hold for every input.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]
#![allow(clippy::print_stdout, reason = "long runs print their figures")]
#![allow(clippy::type_complexity, reason = "oracles are boxed closures")]

mod architecture;
mod autotune;
mod balance;
mod boundary;
mod cases;
mod catalogue;
mod certificate;
mod certified;
mod claims;
mod conformance;
mod control;
mod decompositions;
mod describing;
mod difference;
mod engine;
mod errors;
mod examples;
mod extremes;
mod features;
mod fourier_oracle;
mod fuzz;
mod identify_exact;
mod identify_fit;
mod identify_joint;
mod identify_moved;
mod integration_oracle;
mod interval;
mod laws;
mod libm_single;
mod method_bias;
mod motion_drag_axis;
mod on_board;
mod oracle;
mod orbit_certified;
mod orbit_drag_axis;
mod orbit_linear;
mod paper;
mod power_law;
mod practical;
mod record;
mod relay_certificate;
mod rounding;
mod sampling;
mod serialised;
mod session;
mod special;
mod stamps_off;
mod sweeps;
mod tolerance;
mod trust;
mod vehicle;
mod wide;
mod wide_oracle;
