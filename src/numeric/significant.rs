//! Numbers as a person reads them.

/// A number with `digits` significant digits; very large and very small numbers in scientific notation.
pub(crate) fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    // Rounding may have carried into the next decade: the exponent is that of what is shown.
    let exponent = scientific.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    match exponent {
        Some(exponent @ -4..7) => {
            let before = usize::try_from(exponent + 1).unwrap_or(0);
            let after = digits.saturating_sub(before) + usize::try_from(-exponent - 1).unwrap_or(0);
            format!("{value:.after$}")
        }
        _ => scientific,
    }
}

#[cfg(test)]
mod tests {
    use super::significant;

    #[test]
    fn every_number_keeps_its_digits() {
        for (value, shown) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1.00000"),
            (-12.345_678, "-12.3457"),
            (999_999.9, "1000000"),
            (0.000_123_456_78, "0.000123457"),
            (9.999_999e-5, "0.000100000"),
            (3.2e-5, "3.20000e-5"),
            (2.5e9, "2.50000e9"),
        ] {
            assert_eq!(significant(value, 6), shown);
        }
    }
}
