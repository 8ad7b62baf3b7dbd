//! A number with its uncertainty, as a person prints it.

use super::significant;

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

#[cfg(test)]
mod tests {
    use super::Uncertain;

    #[test]
    fn digits_follow_the_uncertainty() {
        for (value, half_width, shown) in [
            (0.033_012, 0.000_358, "0.03301 \u{b1} 0.00036 (1.1 %)"),
            (0.033_012, 0.000_089_6, "0.033012 \u{b1} 0.000090 (0.27 %)"),
            (0.003_2, 0.014_09, "0.003 \u{b1} 0.014"),
            (-0.000_4, 0.099_9, "0.00 \u{b1} 0.10"),
            (12_345.6, 2_310.0, "12300 \u{b1} 2300 (19 %)"),
            (1.234_56e-7, 2.3e-9, "1.235e-7 \u{b1} 0.023e-7 (1.9 %)"),
            (9.87e9, 1.2e8, "9.87e9 \u{b1} 0.12e9 (1.2 %)"),
        ] {
            assert_eq!(Uncertain::new(value, half_width).to_string(), shown);
        }
    }

    #[test]
    fn the_longer_side_counts_and_no_side_leaves_four_digits() {
        assert_eq!(Uncertain::between(1.0, 0.9, 1.3).half_width, "0.30");
        let exact = Uncertain::new(0.2, 0.0);
        assert_eq!((exact.value.as_str(), exact.half_width.as_str()), ("0.2000", "0"));
    }
}
