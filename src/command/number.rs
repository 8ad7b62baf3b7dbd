//! Numbers as a person types them.

use std::num::NonZeroUsize;

/// A number as typed, whatever it is: the library says what it has to be.
pub(super) fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "write a number, as 0.2 or 1e-3".to_owned())
}

/// A whole number, zero or more.
pub(super) fn whole(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("write a whole number from 0 to {}", u64::MAX))
}

/// How many, one or more.
pub(super) fn count(text: &str) -> Result<NonZeroUsize, String> {
    text.parse().map_err(|_| format!("write a whole number from 1 to {}", usize::MAX))
}

/// A number above zero.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    number(text)
        .ok()
        .filter(|value| value.is_finite() && *value > 0.0)
        .ok_or_else(|| "must be a finite number above 0".to_owned())
}

/// A number, zero or more.
pub(super) fn non_negative(text: &str) -> Result<f64, String> {
    number(text)
        .ok()
        .filter(|value| value.is_finite() && *value >= 0.0)
        .ok_or_else(|| "must be a finite number, 0 or more".to_owned())
}
