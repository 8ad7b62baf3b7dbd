//! Roots of a function of a single variable from samples, each refined by Chandrupatla's method: as fine as the samples, without proof.

use super::golden_section;

/// A function of a single variable that may be undefined in places.
pub type Partial<'a> = &'a mut dyn FnMut(f64) -> Option<f64>;

/// Halvings after which an interval of f64 cannot be halved.
const HALVINGS: usize = 200;

/// Roots of `f` between consecutive `nodes` (ascending), in order.
///
/// Finds every simple root without a second root between the same two nodes; a pair between two nodes where the
/// samples turn back towards zero; a root between a node and the edge of the domain. Poles are not taken for roots.
///
/// ```
/// use selfosc::numeric::scan::roots;
/// let nodes: Vec<f64> = (0..=20).map(|k| f64::from(k) * 0.5).collect();
/// let found = roots(&nodes, &mut |x| Some(x.sin()));
/// assert_eq!(found.len(), 4);
/// assert!((found[1] - core::f64::consts::PI).abs() < 1e-15);
/// assert!(roots(&nodes, &mut |x| Some(1.0 / (x - 1.3))).is_empty());
/// ```
pub fn roots(nodes: &[f64], f: Partial) -> Vec<f64> {
    let mut samples: Vec<(f64, f64)> = Vec::with_capacity(nodes.len());
    let mut found = Vec::new();
    let mut before: Option<(f64, bool)> = None;
    for &node in nodes {
        let value = finite(f, node);
        // Where the domain begins or ends between two nodes, its edge is a node too.
        if let Some((last, defined)) = before
            && defined != value.is_some()
        {
            let edge = if defined { domain_edge(f, last, node) } else { domain_edge(f, node, last) };
            samples.extend(finite(f, edge).map(|value| (edge, value)));
        }
        match value {
            Some(value) => samples.push((node, value)),
            None => in_run(f, &std::mem::take(&mut samples), &mut found),
        }
        before = Some((node, value.is_some()));
    }
    in_run(f, &samples, &mut found);
    found.dedup();
    found
}

/// The root of `f` between two points where it has opposite signs; `None` if it has not, or where that is a pole or
/// undefined.
pub fn bracketed(f: Partial, from: f64, to: f64) -> Option<f64> {
    let (at_from, at_to) = (finite(f, from)?, finite(f, to)?);
    if at_from * at_to < 0.0 { bracket(f, (from, at_from), (to, at_to)) } else { None }
}

fn finite(f: Partial, x: f64) -> Option<f64> {
    f(x).filter(|value| value.is_finite())
}

/// The last point, coming from `inside`, at which `f` is defined; `outside` is not in its domain.
fn domain_edge(f: Partial, mut inside: f64, mut outside: f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (inside + outside);
        if middle == inside || middle == outside {
            break;
        }
        if finite(f, middle).is_some() { inside = middle } else { outside = middle }
    }
    inside
}

/// Roots within a run of samples of a connected domain.
fn in_run(f: Partial, samples: &[(f64, f64)], found: &mut Vec<f64>) {
    for (index, pair) in samples.windows(2).enumerate() {
        let (a, b) = (pair[0], pair[1]);
        if a.1 == 0.0 {
            found.push(a.0);
        } else if (a.1 < 0.0) != (b.1 < 0.0) && b.1 != 0.0 {
            found.extend(bracket(f, a, b));
        }
        // Three samples of equal sign whose middle is nearest to zero: a pair of roots may hide there.
        if let Some(&c) = samples.get(index + 2)
            && a.1 * b.1 > 0.0
            && b.1 * c.1 > 0.0
            && b.1.abs() < a.1.abs()
            && b.1.abs() <= c.1.abs()
            && let Some(turn) = crossing_between(f, a.0, c.0, b.1.signum())
        {
            found.extend(bracket(f, a, turn));
            found.extend(bracket(f, turn, c));
        }
    }
    if let Some(&(last, 0.0)) = samples.last() {
        found.push(last);
    }
}

/// Share of an interval down to which a pair of roots in it is sought.
const PAIR: f64 = 3e-13;

/// A point of the opposite sign, sought by golden sections towards the least of `sign f`.
fn crossing_between(f: Partial, from: f64, to: f64, sign: f64) -> Option<(f64, f64)> {
    let mut crossing = None;
    let positive = |x| {
        let value = finite(f, x)?;
        crossing = (sign * value < 0.0).then_some((x, value));
        crossing.is_none().then_some(sign * value)
    };
    golden_section(positive, from, to, PAIR * (to - from));
    crossing
}

/// Chandrupatla's method: inverse quadratic interpolation where it is safe, else bisection.
fn bracket(f: Partial, from: (f64, f64), to: (f64, f64)) -> Option<f64> {
    let ((mut a, mut at_a), (mut b, mut at_b)) = (to, from);
    let least = at_a.abs().min(at_b.abs());
    let mut part = 0.5;
    for _ in 0..HALVINGS {
        let x = a + part * (b - a);
        let at_x = finite(f, x)?;
        let (c, at_c);
        if (at_x < 0.0) == (at_a < 0.0) {
            (c, at_c) = (a, at_a);
        } else {
            (c, at_c, b, at_b) = (b, at_b, a, at_a);
        }
        (a, at_a) = (x, at_x);
        let (best, at_best) = if at_a.abs() < at_b.abs() { (a, at_a) } else { (b, at_b) };
        let limit = 2.0 * f64::EPSILON * best.abs() + f64::MIN_POSITIVE;
        let tolerance = limit / (b - a).abs();
        if at_best == 0.0 || tolerance >= 0.5 {
            // Towards a pole the values grow instead.
            return (at_best.abs() <= least).then_some(best);
        }
        let (xi, phi) = ((a - b) / (c - b), (at_a - at_b) / (at_c - at_b));
        part = if phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
            at_a / (at_b - at_a) * at_c / (at_b - at_c)
                + (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
        } else {
            0.5
        };
        part = part.clamp(tolerance, 1.0 - tolerance);
    }
    None
}
