//! Numbers as a person reads them.

#[cfg(test)]
#[path = "../../tests/properties/private/significant.rs"]
mod tests;

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
