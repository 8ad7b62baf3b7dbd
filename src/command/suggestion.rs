//! The name that was probably meant.

/// Least similarity (Jaro and Winkler) that is worth a question.
const SIMILAR: f64 = 0.75;

/// The most similar of the names there are, if any is similar at all.
pub(super) fn nearest(given: &str, known: impl Iterator<Item = &'static str>) -> Option<&'static str> {
    let scored = known.map(|name| (strsim::jaro_winkler(given, name), name));
    scored.filter(|(score, _)| *score > SIMILAR).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn slips_of_the_keyboard_are_understood_and_strangers_are_not() {
        let known = ["relay", "relay-hysteresis", "saturation"];
        assert_eq!(nearest("saturatoin", known.into_iter()), Some("saturation"));
        assert_eq!(nearest("relay-hysterisis", known.into_iter()), Some("relay-hysteresis"));
        assert_eq!(nearest("xyz", known.into_iter()), None);
    }
}
