//! Numbers as a person types them: an error names the domain and the notation.

use std::num::NonZeroUsize;
use std::str::FromStr;

use crate::experiment::TimeUnit;
use crate::numeric::Limit;

/// Any number as typed: the library checks the domain.
pub(super) fn number(text: &str) -> Result<f64, String> {
    let value: f64 = text.trim().parse().map_err(|_| written(Limit::Finite))?;
    if value.is_finite() && value != 0.0 && !(SMALLEST..=LARGEST).contains(&value.abs()) {
        let remedy = "choose units in which it is nearer to 1";
        return Err(format!("must be 0 or from {SMALLEST:e} to {LARGEST:e} in magnitude; {remedy}"));
    }
    Ok(value)
}

/// Magnitudes of numbers: beyond, squares and products overflow or underflow.
const SMALLEST: f64 = 1e-50;
const LARGEST: f64 = 1e50;

/// A finite number.
pub(super) fn finite(text: &str) -> Result<f64, String> {
    within(text, Limit::Finite)
}

/// A number above zero.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    within(text, Limit::Positive)
}

/// A number, zero or more.
pub(super) fn non_negative(text: &str) -> Result<f64, String> {
    within(text, Limit::NonNegative)
}

/// The unit of a log's times.
pub(super) fn time_unit(text: &str) -> Result<TimeUnit, String> {
    TimeUnit::ALL
        .into_iter()
        .find(|unit| unit.name() == text)
        .ok_or_else(|| "must be h, min, s, ms, us or ns; name the unit of the log's times".to_owned())
}

fn within(text: &str, limit: Limit) -> Result<f64, String> {
    number(text).and_then(|value| if limit.holds(value) { Ok(value) } else { Err(written(limit)) })
}

fn written(limit: Limit) -> String {
    format!("must be {limit}; write it as 0.2 or 1e-3")
}

/// A whole number, zero or more.
pub(super) fn whole<T: FromStr>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("must be a whole number from 0 to {}; write it in digits", u64::MAX))
}

/// A count, at least 1.
pub(super) fn count(text: &str) -> Result<NonZeroUsize, String> {
    text.parse().map_err(|_| format!("must be a whole number from 1 to {}; write it in digits", usize::MAX))
}

/// A count of a single byte, at least 1.
pub(super) fn small_count(text: &str) -> Result<u8, String> {
    let counted = text.parse().ok().filter(|count| *count > 0);
    counted.ok_or_else(|| format!("must be a whole number from 1 to {}; write it in digits", u8::MAX))
}
