//! Exact limit cycles under a relay, for comparison with harmonic balance and for identification.

#[cfg(feature = "std")]
mod certificate;
mod closed_form;
mod drag_axis;
mod error;
mod half_cycle;
#[cfg(feature = "std")]
#[cfg(feature = "std")]
mod two_level;

#[cfg(feature = "std")]
pub use certificate::{Certificate, Starts, certify};
pub use drag_axis::{LimitCycle, Switching, limit_cycle};
pub use error::OrbitError;
#[cfg(feature = "std")]
#[cfg(feature = "std")]
pub use two_level::{ListedOrbit, OrbitCertificate, OrbitClaim, OrbitListing, OrbitRefusal, TwoLevelRelay, orbits};

internal! {
    #[cfg(feature = "std")]
    mod theorem;
}
internal! {
    use closed_form::{
        force_left, linear_amplitude_excess, linear_half_cycle, linear_half_width, quadratic_half_cycle,
        quadratic_period, quadratic_speeds, return_slope,
    };
}
