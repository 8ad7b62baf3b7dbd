//! First crossing of a level by a polynomial on [0, 1], by the convex hull of its Bernstein coefficients: none is missed.

use crate::scalar::Scalar;

/// Where a function that begins positive first becomes negative on [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Crossing<S> {
    /// It stays positive.
    None,
    /// At this place, where it crosses.
    At(S),
    /// It comes so near zero that the arithmetic cannot tell.
    Unclear,
}

/// Halvings of [0, 1] before a place is called unclear.
const DEEPEST: usize = 44;
/// Terms from the end whose sum is below this share of the largest are left out of the search in floats.
const TAIL: f64 = 1e-18;
/// Rounding errors of hull coefficients in units of roundoff times the largest coefficient: 22 additions and their binomials.
const HULL_ERRORS: f64 = 64.0;
/// Halvings that reach 71 digits; Newton needs ten.
const MOST_ITERATIONS: usize = 240;

/// First crossing from above to below zero of a polynomial with ascending coefficients.
///
/// The search runs in floats; where these cannot tell, in the polynomial's own arithmetic.
pub fn first_crossing<S: Scalar>(coefficients: &[S]) -> Crossing<S> {
    let floats = leading(coefficients);
    let rest: f64 = floats[1..].iter().map(|c| c.abs()).sum();
    if floats[0] > rest * (1.0 + 1e-12) {
        return Crossing::None;
    }
    if coefficients[0] < S::ZERO {
        return Crossing::At(S::ZERO);
    }
    let isolated = match isolate(&floats) {
        Isolated::Unclear if S::ROUNDING < f64::ROUNDING => isolate(coefficients),
        other => other,
    };
    match isolated {
        Isolated::None => Crossing::None,
        Isolated::Within(low, high) => Crossing::At(root(coefficients, low, high)),
        Isolated::Unclear => Crossing::Unclear,
    }
}

/// The polynomial in floats, without terms that do not matter to them.
pub fn leading<S: Scalar>(coefficients: &[S]) -> Vec<f64> {
    let mut floats: Vec<f64> = coefficients.iter().map(|c| c.to_f64()).collect();
    let largest = floats.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    let mut tail = 0.0;
    while floats.len() > 2 {
        tail += floats.last().map_or(0.0, |c| c.abs());
        if tail > TAIL * largest {
            break;
        }
        floats.pop();
    }
    floats
}

/// Largest and smallest value of a polynomial on [0, 1], to `1e-14` of its largest coefficient.
pub fn range(coefficients: &[f64]) -> (f64, f64) {
    let scale = coefficients.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    let largest = |sign: f64| {
        let signed: Vec<f64> = coefficients.iter().map(|c| sign * c).collect();
        let mut best = signed[0].max(signed.iter().sum());
        let mut pending = vec![bernstein(&signed)];
        while let Some(hull) = pending.pop() {
            best = best.max(hull[0]).max(*hull.last().unwrap_or(&hull[0]));
            if hull.iter().fold(f64::NEG_INFINITY, |most, &b| most.max(b)) > best + 1e-14 * scale {
                let (left, right) = halves(&hull);
                pending.extend([left, right]);
            }
        }
        sign * best
    };
    (largest(-1.0), largest(1.0))
}

enum Isolated {
    None,
    Within(f64, f64),
    Unclear,
}

fn isolate<S: Scalar>(coefficients: &[S]) -> Isolated {
    let scale = coefficients.iter().fold(S::ZERO, |most, c| if c.abs() > most { c.abs() } else { most });
    let margin = scale * S::from_f64(HULL_ERRORS * S::ROUNDING);
    // Sub-intervals from the left: depth and place.
    let mut pending = vec![(bernstein(coefficients), 0, 0.0)];
    while let Some((hull, depth, low)) = pending.pop() {
        let width = f64::powi(2.0, -(depth as i32));
        let (first, last) = (hull[0], hull[hull.len() - 1]);
        if hull.iter().all(|&b| b > margin) {
            continue;
        }
        if first >= -margin && hull.windows(2).all(|pair| pair[1] >= pair[0]) {
            continue; // it rises from where it was not negative
        }
        if hull.windows(2).all(|pair| pair[1] <= pair[0]) {
            if last < -margin {
                return Isolated::Within(low, low + width);
            }
            if last > margin {
                continue;
            }
            // It ends on the level within the rounding: the next step begins beyond it or short of it, and shows which.
            if low + width == 1.0 {
                return if last < S::ZERO { Isolated::Within(low, 1.0) } else { Isolated::None };
            }
        }
        if depth >= DEEPEST {
            return Isolated::Unclear;
        }
        let (left, right) = halves(&hull);
        pending.push((right, depth + 1, low + 0.5 * width));
        pending.push((left, depth + 1, low));
    }
    Isolated::None
}

/// Bernstein coefficients `b_j = sum_i C(j, i)/C(p, i) c_i`.
fn bernstein<S: Scalar>(coefficients: &[S]) -> Vec<S> {
    let degree = coefficients.len() - 1;
    let mut binomial = S::ONE;
    let mut hull = Vec::with_capacity(degree + 1);
    for (i, &c) in coefficients.iter().enumerate() {
        hull.push(c / binomial);
        binomial = binomial * S::from_count(degree - i) / S::from_count(i + 1);
    }
    for k in 1..=degree {
        for j in (k..=degree).rev() {
            hull[j] = hull[j] + hull[j - 1];
        }
    }
    hull
}

/// De Casteljau's halves.
fn halves<S: Scalar>(hull: &[S]) -> (Vec<S>, Vec<S>) {
    let half = S::from_f64(0.5);
    let mut right = hull.to_vec();
    let mut left = Vec::with_capacity(hull.len());
    for end in (0..hull.len()).rev() {
        left.push(right[0]);
        for j in 0..end {
            right[j] = half * (right[j] + right[j + 1]);
        }
    }
    (left, right)
}

/// The root between places of opposite sign, where the polynomial decreases: Newton, and bisection where Newton leaves the bracket.
fn root<S: Scalar>(coefficients: &[S], low: f64, high: f64) -> S {
    let (mut low, mut high) = (S::from_f64(low), S::from_f64(high));
    let half = S::from_f64(0.5);
    let mut place = half * (low + high);
    for _ in 0..MOST_ITERATIONS {
        let (value, slope) = value_and_slope(coefficients, place);
        if value > S::ZERO {
            low = place
        } else {
            high = place
        }
        let newton = place - value / slope;
        let next = if newton >= low && newton <= high { newton } else { half * (low + high) };
        let moved = (next - place).abs().to_f64();
        place = next;
        if moved <= 2.0 * S::ROUNDING {
            break;
        }
    }
    place
}

fn value_and_slope<S: Scalar>(coefficients: &[S], place: S) -> (S, S) {
    coefficients.iter().rev().fold((S::ZERO, S::ZERO), |(value, slope), &c| (value * place + c, slope * place + value))
}

#[cfg(test)]
mod tests {
    use f256::f256;

    use super::*;

    /// `scale prod (root - t)`: positive at 0 where all roots are.
    fn with_roots(roots: &[f64]) -> Vec<f64> {
        let mut descending = vec![1.0];
        for root in roots {
            descending = crate::plant::multiply(&descending, &[-1.0, *root]);
        }
        descending.reverse();
        descending
    }

    #[test]
    fn the_first_of_two_close_roots_is_found() {
        for gap in [1e-1, 1e-3, 1e-5, 1e-6] {
            let Crossing::At(place) = first_crossing(&with_roots(&[0.7, 0.7 + gap, 3.0])) else {
                panic!("missed at {gap}")
            };
            assert!((place - 0.7).abs() < 1e-14 / gap);
        }
    }

    #[test]
    fn touching_is_no_crossing_and_beyond_floats_digits_decide() {
        // (t - 1/2)^2 + offset
        let touching = |offset: f64| [0.25 + offset, -1.0, 1.0];
        assert_eq!(first_crossing(&touching(1e-6)), Crossing::None);
        assert_eq!(first_crossing(&touching(1e-18)), Crossing::Unclear);
        let exactly = |offset: f64| [f256::from(0.25) + f256::from(offset), f256::from(-1.0), f256::ONE];
        assert_eq!(first_crossing(&exactly(1e-24)), Crossing::None);
        let Crossing::At(place) = first_crossing(&exactly(-1e-24)) else { panic!("missed") };
        assert!((place - f256::from(0.5) + f256::from(1e-24).sqrt()).to_f64().abs() < 1e-55);
    }

    #[test]
    fn a_start_beyond_the_level_crosses_at_once_and_a_start_on_it_may_leave() {
        assert_eq!(first_crossing(&[-1e-17, 1.0]), Crossing::At(0.0));
        assert_eq!(first_crossing(&[0.0, 1.0, 0.3]), Crossing::None);
    }

    #[test]
    fn ranges_of_cubics() {
        // t^3 - t: least at 1/sqrt(3).
        let (low, high) = range(&[0.0, -1.0, 0.0, 1.0]);
        assert!((low + 2.0 / 27.0_f64.sqrt()).abs() < 1e-13 && high.abs() < 1e-15);
    }
}
