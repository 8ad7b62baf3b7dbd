//! A number with its uncertainty, as a person prints it.

#[cfg(test)]
#[path = "../../tests/properties/private/uncertain.rs"]
mod tests;

use crate::numeric::significant;

/// A value and half its interval's width, both to the second digit of the half-width: `0.03301 ± 0.00036 (1.1 %)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Uncertain {
    pub(crate) value: String,
    pub(crate) half_width: String,
    /// The half-width relative to the value; `None` where it is no smaller.
    percent: Option<String>,
}

/// Relative half-width below which it is that of rounding.
const ROUNDING: f64 = 1e-12;

impl Uncertain {
    /// A value with four digits where the half-width is zero, rounding alone or not finite.
    pub(crate) fn new(value: f64, half_width: f64) -> Self {
        let half_width = if half_width < ROUNDING * value.abs() { 0.0 } else { half_width };
        if !(half_width > 0.0 && half_width.is_finite() && value.is_finite()) {
            return Self { value: significant(value, 4), half_width: significant(half_width, 2), percent: None };
        }
        let last = exponent(half_width) - 1;
        let largest = exponent(half_width.max(value.abs()));
        let power = if (-4..7).contains(&largest) { 0 } else { largest };
        let percent = 100.0 * half_width / value.abs();
        Self {
            value: rounded(value, last, power),
            half_width: rounded(half_width, last, power),
            percent: (percent < 100.0).then(|| significant(percent, 2)),
        }
    }

    /// Of an interval about the value: its longer side.
    pub(crate) fn between(value: f64, low: f64, high: f64) -> Self {
        Self::new(value, (value - low).max(high - value))
    }
}

impl core::fmt::Display for Uncertain {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { value, half_width, percent } = self;
        write!(f, "{value} \u{b1} {half_width}")?;
        percent.iter().try_for_each(|percent| write!(f, " ({percent} %)"))
    }
}

/// The decade of a number of two digits.
fn exponent(size: f64) -> i32 {
    // Rounding may carry into the next decade.
    format!("{size:.1e}").split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0)
}

/// A number with `10^last` as its last digit, in units of `10^power`; zero has no sign.
fn rounded(value: f64, last: i32, power: i32) -> String {
    let (scaled, last) = (value / 10f64.powi(power), last - power);
    let unit = 10f64.powi(last.max(0));
    let decimals = usize::try_from(-last).unwrap_or(0);
    let shown = if last > 0 { (scaled / unit).round() * unit } else { scaled };
    let shown = format!("{shown:.decimals$}");
    let shown = match shown.strip_prefix('-') {
        Some(size) if !size.contains(|c: char| ('1'..='9').contains(&c)) => size.to_owned(),
        _ => shown,
    };
    if power == 0 { shown } else { format!("{shown}e{power}") }
}
