//! The name that was probably meant.

/// Least similarity (Jaro and Winkler) that is worth a question.
const SIMILAR: f64 = 0.75;

/// The most similar of the names there are, if any is similar at all.
pub(super) fn nearest(given: &str, known: impl Iterator<Item = &'static str>) -> Option<&'static str> {
    let scored = known.map(|name| (strsim::jaro_winkler(given, name), name));
    scored.filter(|(score, _)| *score > SIMILAR).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, name)| name)
}
