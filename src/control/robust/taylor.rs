//! The excess over an ellipsoid, `|z| <= 1`, by Taylor's form of second order about a point `c`: with `d = x - c` for `x = (z, w)`, `g` the
//! gradient at `c` and `H` the second derivatives over a box, `F(x) >= F(c) + g d + d H d/2`.
//!
//! At `c_z = -g_z/|g_z|` a linear function is least on the ellipsoid, and it grows with the square of the distance `r = |d_z|` from there:
//! `2 c_z z <= |c_z|^2 + 1 - r^2`. With any `a >= 0` and `g_z = -a c_z + q` the bound in `r` is
//! `(a + l) r^2/2 - (|q| + |H_wz| |d_w|) r - a (1 - |c_z|^2)/2`, where `l` bounds the eigenvalues of `H_zz` (Gershgorin's circles).

use super::ProcessIntervals;
use super::exclusion::{EXTRA, OMEGA, Question, VARIABLES, Verdict};
use super::shape::{AXES, length};
use crate::control::Gains;
use crate::numeric::{Gradient, Interval, Real};

/// Coordinates, frequency, and the criterion's own variable.
const COUNT: usize = AXES + 2;
/// Their places among all variables.
const PLACES: [usize; COUNT] = {
    let mut places = [0; COUNT];
    let mut k = 0;
    while k < AXES {
        places[k] = k;
        k += 1;
    }
    (places[AXES], places[AXES + 1]) = (OMEGA, EXTRA);
    places
};

impl ProcessIntervals {
    fn excess_of<T: Real>(&self, question: Question, gains: &Gains<f64>, variables: [T; COUNT]) -> T {
        let mut all = [T::zero(); VARIABLES];
        for (place, variable) in PLACES.into_iter().zip(variables) {
            all[place] = variable;
        }
        self.excess(question, gains, all)
    }

    /// What is known of the excess on a box of variables.
    pub(super) fn on_ellipsoid(&self, question: Question, gains: &Gains<f64>, at: [Interval; VARIABLES]) -> Verdict {
        let sides = PLACES.map(|place| at[place]);
        if self.shape.misses(&sides[..AXES]) || self.excess(question, gains, at).is_positive() {
            return Verdict::Positive;
        }
        let mut centre = sides.map(|side| Interval::point(side.midpoint()));
        let slopes = self.excess_of(question, gains, Gradient::variables(centre)).slopes();
        let (foot, pull) = lowest(&slopes, &sides);
        centre[..AXES].copy_from_slice(&foot.map(Interval::point));
        let about = self.excess_of(question, gains, Gradient::variables(centre));
        if about.value().is_negative() && !self.shape.misses(&centre[..AXES]) {
            return Verdict::Negative;
        }
        let curved = self.excess_of(question, gains, Gradient::variables(Gradient::variables(sides)));
        let (slopes, curvature) = (about.slopes(), curved.slopes().map(|one| one.slopes()));
        let form = TaylorForm { centre, pull, sides, slopes, curvature };
        let [of_axes, of_both] = [false, true].map(|others| form.least(others));
        if (about.value() + of_both).is_positive() {
            return Verdict::Positive;
        }
        // Whichever takes more from the bound is halved.
        let among = if 2.0 * of_axes.lower() >= of_both.lower() { AXES..COUNT } else { 0..AXES };
        Verdict::Open(at, PLACES[form.widest(among)])
    }
}

/// The point `z = -g/a` within the sides and on the ellipsoid at which a linear function is least, and `a`; a corner of the sides, and 0,
/// where that is inside.
fn lowest(slopes: &[Interval; COUNT], sides: &[Interval; COUNT]) -> ([f64; AXES], f64) {
    let at = |a: f64| -> [f64; AXES] {
        core::array::from_fn(|k| {
            let slope = slopes[k].midpoint();
            if slope == 0.0 { sides[k].midpoint() } else { (-slope / a).clamp(sides[k].lower(), sides[k].upper()) }
        })
    };
    let size = |z: [f64; AXES]| z.iter().map(|part| part * part).sum::<f64>();
    if size(at(0.0)) <= 1.0 {
        return (at(0.0), 0.0);
    }
    let (mut low, mut high) = (0.0, length(&slopes[..AXES]));
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if size(at(middle)) > 1.0 { low = middle } else { high = middle }
    }
    (at(high), high)
}

struct TaylorForm {
    centre: [Interval; COUNT],
    pull: f64,
    sides: [Interval; COUNT],
    slopes: [Interval; COUNT],
    curvature: [[Interval; COUNT]; COUNT],
}

impl TaylorForm {
    fn away(&self, k: usize) -> Interval {
        self.sides[k] - self.centre[k]
    }

    /// A lower bound of `g d + d H d/2`, with the other variables or at their centre.
    fn least(&self, others: bool) -> Interval {
        let half = Interval::point(0.5);
        let others = if others { AXES..COUNT } else { 0..0 };
        // |H_wz| |d_w|, along each axis.
        let mixed = core::array::from_fn(|k| {
            others.clone().fold(Interval::ZERO, |sum, w| sum + self.curvature[w][k].abs() * self.away(w).abs())
        });
        others.clone().fold(self.least_of_axes(mixed), |sum, k| {
            let square = half * self.curvature[k][k] * self.away(k).square();
            let mixed = ((k + 1)..COUNT).map(|j| self.curvature[k][j] * self.away(k) * self.away(j));
            mixed.fold(sum + self.slopes[k] * self.away(k) + square, |sum, part| sum + part)
        })
    }

    /// That of the parts with `d_z`: as a parabola in `|d_z|`, or side by side, which says more of a small box.
    fn least_of_axes(&self, mixed: [Interval; AXES]) -> Interval {
        let (half, pull) = (Interval::point(0.5), Interval::point(self.pull));
        let away: [Interval; AXES] = core::array::from_fn(|k| self.away(k));
        // What pulls towards a side at which the point stands takes nothing.
        let across: [Interval; AXES] = core::array::from_fn(|k| {
            let slope = self.slopes[k] + pull * self.centre[k];
            if (slope * away[k]).lower() >= 0.0 { Interval::ZERO } else { slope }
        });
        let inside = self.centre[..AXES].iter().fold(Interval::ONE, |sum, c| sum - c.square());
        let (size, sum) = (|parts: &[Interval]| Interval::point(length(parts)), |a: Interval, b: Interval| a + b);
        let rises = size(&across) + size(&mixed);
        let least = (0..AXES).filter(|k| !away[*k].is_point()).map(|k| {
            let others = (0..AXES).filter(|j| *j != k).map(|j| self.curvature[k][j].abs());
            (self.curvature[k][k] - others.fold(Interval::ZERO, sum)).lower()
        });
        let bowl = Interval::point((pull + Interval::point(least.fold(f64::INFINITY, f64::min))).lower());
        // `bowl r^2/2 - rises r` is least at its vertex, or at the farthest point where it falls up to there.
        let farthest = size(&away);
        let parabola = if bowl.is_positive() && !(bowl * farthest - rises).is_negative() {
            -half * rises.square() / bowl
        } else {
            half * bowl * farthest.square() - rises * farthest
        };
        let side_by_side = (0..AXES).fold(Interval::ZERO, |all, k| {
            let bends = (0..k).map(|j| self.curvature[k][j] * away[k] * away[j]).fold(Interval::ZERO, sum);
            let square = half * self.curvature[k][k] * away[k].square();
            all + across[k] * away[k] - mixed[k] * away[k].abs() + bends + square
        });
        Interval::point(parabola.lower().max(side_by_side.lower())) - half * pull * inside
    }

    /// The side along which the excess bends most; of frequency and the criterion's variable, changes most.
    fn widest(&self, among: core::ops::Range<usize>) -> usize {
        let size = |k: &usize| {
            let curved: f64 = (0..COUNT).map(|j| self.curvature[*k][j].magnitude() * self.sides[j].width()).sum();
            (curved + if *k < AXES { 0.0 } else { self.slopes[*k].magnitude() }) * self.sides[*k].width()
        };
        among.max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(AXES)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between -1 and 1.
    fn numbers() -> impl FnMut() -> f64 {
        let mut k = 0.0_f64;
        move || {
            k += 1.0;
            2.0 * (k * k * 0.618_033_988_749_895).fract() - 1.0
        }
    }

    /// The least of `b x + x A x/2` that a local search finds within the sides and the ball.
    fn least_met(of: impl Fn(&[f64; COUNT]) -> f64, sides: &[Interval; COUNT], start: [f64; COUNT]) -> f64 {
        let (mut number, mut point, mut reach) = (numbers(), start, 1.0);
        let mut least = of(&point);
        for _ in 0..6000 {
            let mut other: [f64; COUNT] =
                core::array::from_fn(|k| (point[k] + reach * number()).clamp(sides[k].lower(), sides[k].upper()));
            let size = other[..AXES].iter().map(|z| z * z).sum::<f64>().sqrt().max(1.0);
            other[..AXES].iter_mut().for_each(|z| *z /= size);
            if (0..COUNT).all(|k| sides[k].contains(other[k])) && of(&other) < least {
                (least, point) = (of(&other), other);
            } else {
                reach = f64::max(0.997 * reach, 1e-6);
            }
        }
        least
    }

    /// The bound of `b x + x A x/2` over the sides and the ball, and the least that is met.
    fn bound_and_met(slopes: [f64; COUNT], curved: [[f64; COUNT]; COUNT], sides: [Interval; COUNT]) -> [f64; 2] {
        let points = |x: [f64; COUNT]| x.map(Interval::point);
        let row = |k: usize, x: &[f64; COUNT]| (0..COUNT).map(|j| curved[k][j] * x[j]).sum::<f64>();
        let of = |x: &[f64; COUNT]| (0..COUNT).map(|k| x[k] * (slopes[k] + 0.5 * row(k, x))).sum::<f64>();
        let slope_at = |x: [f64; COUNT]| points(core::array::from_fn(|k| slopes[k] + row(k, &x)));
        let mut centre = sides.map(|side| side.midpoint());
        let (foot, pull) = lowest(&slope_at(centre), &sides);
        centre[..AXES].copy_from_slice(&foot);
        let curvature = curved.map(points);
        let form = TaylorForm { centre: points(centre), pull, sides, slopes: slope_at(centre), curvature };
        [of(&centre) + form.least(true).lower(), least_met(of, &sides, centre)]
    }

    fn symmetric(parts: &[(usize, usize, f64)]) -> [[f64; COUNT]; COUNT] {
        let mut all = [[0.0; COUNT]; COUNT];
        for (k, j, part) in parts {
            (all[*k][*j], all[*j][*k]) = (*part, *part);
        }
        all
    }

    /// Each term by itself: of these functions it decides.
    #[test]
    fn each_term_of_the_bound_is_needed() {
        let (w, mut falls) = (AXES, [0.0; COUNT]);
        falls[0] = 1.0;
        let (ball, small) = (Interval::symmetric(1.0), Interval::symmetric(0.1));
        let of = |side: Interval, wide: &[usize]| {
            core::array::from_fn(|k| if wide.contains(&k) { side } else { Interval::ZERO })
        };
        for (slopes, bends, sides, least) in [
            // z_0 falls on the ball, and frequency mixes with z_1: -sqrt(1 + 0.3^2).
            (falls, vec![(1, w, 0.3)], of(ball, &[0, 1, w]), -1.0440),
            // It bends down along z_1, or between z_1 and z_2, by k = 2: -(k + 1/k)/2.
            (falls, vec![(1, 1, -2.0)], of(ball, &[0, 1]), -1.25),
            (falls, vec![(1, 2, 2.0)], of(ball, &[0, 1, 2]), -1.25),
            // On a small box about the middle: squares, products, products with the frequency, its own square and slope.
            ([0.0; COUNT], vec![(0, 0, -2.0)], of(small, &[0]), -0.01),
            ([0.0; COUNT], vec![(0, 1, 2.0)], of(small, &[0, 1]), -0.02),
            ([0.0; COUNT], vec![(0, w, 2.0)], of(small, &[0, w]), -0.02),
            ([0.0; COUNT], vec![(w, w, -2.0)], of(small, &[0, w]), -0.01),
            (core::array::from_fn(|k| if k == w { 1.0 } else { 0.0 }), vec![], of(small, &[0, w]), -0.1),
        ] {
            let [bound, met] = bound_and_met(slopes, symmetric(&bends), sides);
            assert!((met - least).abs() < 1e-3 && bound <= met && bound > met - 2.0, "{bends:?}: {bound} {met}");
        }
    }

    /// Of any quadratic functions the bound is below all that is met, of linear ones near: on the whole ball, on boxes within and across.
    #[test]
    fn the_bound_is_below_all_that_is_met() {
        let mut number = numbers();
        for trial in 0..60_i32 {
            let slopes = core::array::from_fn(|_| number());
            let bend = 0.1 * f64::from(trial % 4);
            let places: Vec<(usize, usize)> = (0..COUNT).flat_map(|k| (0..=k).map(move |j| (k, j))).collect();
            let bends: Vec<_> = places.into_iter().map(|(k, j)| (k, j, bend * number())).collect();
            let sides = core::array::from_fn(|k| {
                let (middle, radius) = (0.3 * number(), 0.1 + 0.2 * number().abs());
                match k {
                    _ if k < AXES && trial % 3 == 0 => Interval::symmetric(1.0),
                    _ if k < AXES => Interval::new(middle - radius, middle + radius).unwrap(),
                    _ => Interval::symmetric(0.3 * radius),
                }
            });
            let [bound, met] = bound_and_met(slopes, symmetric(&bends), sides);
            assert!(bound <= met + 1e-9 && (bend > 0.0 || bound >= met - 0.02), "{trial}: {bound} {met}");
        }
    }
}
