//! Golden-section search.

/// `(sqrt(5) - 1)/2`.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Golden-section search: narrows `from` to `to` (ascending) around a minimum of `cost` until it is at most `width` wide or
/// floats end. `None` as soon as `cost` gives none, which is how a caller ends the search.
///
/// With several minima it ends at any of them.
///
/// ```
/// use selfosc::numeric::golden_section;
/// let [from, to] = golden_section(|x| Some((x - 2.0) * (x - 2.0)), 0.0, 5.0, 1e-6).unwrap();
/// assert!(to - from <= 1e-6 && from <= 2.0 && 2.0 <= to);
/// ```
pub fn golden_section(
    mut cost: impl FnMut(f64) -> Option<f64>,
    mut from: f64,
    mut to: f64,
    width: f64,
) -> Option<[f64; 2]> {
    let left = |from: f64, to: f64| to - GOLDEN * (to - from);
    let right = |from: f64, to: f64| from + GOLDEN * (to - from);
    let mut inner = [left(from, to), right(from, to)];
    let mut costs = [cost(inner[0])?, cost(inner[1])?];
    while to - from > width && from < inner[0] && inner[0] < inner[1] && inner[1] < to {
        if costs[0] < costs[1] {
            to = inner[1];
            inner = [left(from, to), inner[0]];
            costs = [cost(inner[0])?, costs[0]];
        } else {
            from = inner[0];
            inner = [inner[1], right(from, to)];
            costs = [costs[1], cost(inner[1])?];
        }
    }
    Some([from, to])
}
