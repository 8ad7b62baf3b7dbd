//! A decimal as it is printed.

use crate::numeric::Interval;

/// A decimal number with as many digits as are printed: it stands for every number that rounds to it.
///
/// ```
/// use selfosc::paper::Printed;
/// let printed = Printed::parse("5.7").unwrap();
/// assert_eq!((printed.value(), printed.decimals()), (5.7, 1));
/// assert!(printed.interval(1).contains(5.74) && !printed.interval(2).contains(5.74));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Printed {
    digits: i64,
    decimals: u32,
}

impl Printed {
    /// Reads digits with at most a point and a sign, no more than 15 digits in all; else `None`.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
        let digits = format!("{whole}{fraction}");
        let unsigned = digits.strip_prefix('-').unwrap_or(&digits);
        let plain = !unsigned.is_empty() && unsigned.len() <= 15 && unsigned.bytes().all(|byte| byte.is_ascii_digit());
        let decimals = u32::try_from(fraction.len()).ok()?;
        if plain { Some(Self { digits: digits.parse().ok()?, decimals }) } else { None }
    }

    /// The double nearest to it.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "15 digits fit a double, and one division rounds once")]
    pub fn value(self) -> f64 {
        self.digits as f64 / Self::unit(self.decimals)
    }

    /// Digits after the point.
    #[must_use]
    pub fn decimals(self) -> u32 {
        self.decimals
    }

    /// The same digits with the decimal point moved left.
    #[must_use]
    pub fn shifted(self, places: u32) -> Self {
        Self { decimals: self.decimals + places, ..self }
    }

    /// The numbers that round to it at `decimals` decimals, at least the printed ones: half a unit either way.
    #[must_use]
    pub fn interval(self, decimals: u32) -> Interval {
        self.within(decimals, 1.0)
    }

    /// The interval of a printed number: `half_units` half units of its last decimal either way, with at least the printed decimals.
    #[allow(clippy::cast_precision_loss, reason = "15 digits fit a double")]
    pub(super) fn within(self, decimals: u32, half_units: f64) -> Interval {
        let half_unit = Interval::point(0.5) / Interval::point(Self::unit(decimals.max(self.decimals)));
        let value = Interval::point(self.digits as f64) / Interval::point(Self::unit(self.decimals));
        value + half_unit * Interval::symmetric(half_units)
    }

    /// Ten to the power of the decimals: exact, as there are no more than 22 of them.
    fn unit(decimals: u32) -> f64 {
        f64::from(10).powi(decimals.min(22).cast_signed())
    }
}

impl serde::Serialize for Printed {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.value())
    }
}
