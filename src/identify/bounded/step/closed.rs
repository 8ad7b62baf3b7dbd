//! A step in closed form: under a constant command, with drag that is linear and quadratic, while the velocity has one sign.
//!
//! Then `v' = a - b v - c v^2`. With `z = b^2/4 + a c`, `C = cosh(sqrt(z) t)` and `S = sinh(sqrt(z) t)/sqrt(z)` the velocity from v0 is N/D
//! for `N = v0 C + (a - b v0/2) S` and `D = C + (b/2 + c v0) S`; a change of v0 becomes `1/D^2` of itself, and the way is
//! `(ln D - b t/2)/c`. All of it is entire in z, and regular in c: as series no case is told from another. Only the way's slope by c is
//! divided by it, at the price of digits where it is small, and what that changes by, twice.

use super::super::bend::{Carried, Seat, gathered};
use super::super::field::{FORCE, Field, POSITION, Term, Triple, VELOCITY};
use super::super::mix::Bundle;
use super::Values;
use crate::numeric::{Balls, Interval};

#[cfg(test)]
mod tests;

/// Terms of the series in `z t^2`, and the largest that is put into them.
const SERIES_TERMS: usize = 12;
const MOST_Z: f64 = 2.5;
/// More than `SERIES_TERMS MOST_Z^(SERIES_TERMS - 1)/(2 SERIES_TERMS)!` and all terms behind that.
const LEFT_OUT: f64 = 1e-18;
/// The largest way times c, of which half is the area tangent.
const MOST_WAY: f64 = 1.0;
/// Terms of its series, and the largest square that is put into it: that of the hyperbolic tangent of half of the largest.
const AREA_TERMS: usize = 26;
const MOST_SQUARE: f64 = 0.2136;
/// What the terms left out of it are at most, over the first of them.
const AREA_LEFT: f64 = 1.3;
const _: () = assert!((1.0 - MOST_SQUARE) * AREA_LEFT > 1.0);

/// Of position and velocity.
type Two = [Balls; 2];

/// What motions change by: a, b, c and the velocity at the start.
const A: usize = 0;
const B: usize = 1;
const C: usize = 2;
const V: usize = 3;
/// All pairs of these, and where some are.
const PAIRS: [[usize; 2]; 10] = [[A, A], [A, B], [A, C], [A, V], [B, B], [B, C], [B, V], [C, C], [C, V], [V, V]];
const A_C: usize = 2;
const C_C: usize = 7;
const C_V: usize = 8;

/// A point's equation, and where it starts from, the same in every place.
#[derive(Clone, Debug)]
pub(super) struct Closed {
    a: Balls,
    b: Balls,
    c: Balls,
    /// Position and velocity in the middle of the start, and all velocities of it; the force, which stays.
    middle: Two,
    start: Balls,
    force: Balls,
    /// By how much the unknowns of each bundle move a, b and c; `None` for not at all.
    moved: Vec<Option<[Balls; 3]>>,
    /// By how much each bundle of pairs of unknowns moves the products of these, and of the velocity at the start.
    bent: Vec<[Balls; PAIRS.len()]>,
    quadratic: bool,
}

/// A step at four instants, side by side.
struct Instants {
    /// From the middle of the start.
    state: Two,
    /// What the state changes by: by a, b, c and the velocity at the start.
    by: [Two; 4],
    /// What these change by, by pairs; where they are asked for.
    second: Option<[Two; PAIRS.len()]>,
}

/// `1 + w/d(1) (1 + w/d(2) (1 + ...))` for denominators that grow beyond twice w.
fn nested(w: Balls, denominator: impl Fn(usize) -> usize) -> Balls {
    let left_out = Balls::within((w + w).share(denominator(SERIES_TERMS)).sizes());
    (1..SERIES_TERMS).rev().fold(Balls::ONE + left_out, |sum, k| Balls::ONE + (w * sum).share(denominator(k)))
}

/// What the series of C and of S over t change by from `from` to `to`, over that difference.
fn divided(to: Balls, from: Balls) -> Two {
    let (mut power, mut sum) = (Balls::ONE, Balls::ONE);
    let (mut cosine, mut factor) = (Balls::ZERO, Balls::ONE);
    let mut sine = Balls::ZERO;
    for k in 1..SERIES_TERMS {
        // The sum is that of all products of k - 1 factors.
        factor = factor.share((2 * k - 1) * 2 * k);
        let term = factor * sum;
        cosine = cosine + term;
        sine = sine + term.share(2 * k + 1);
        power = power * from;
        sum = to * sum + power;
    }
    let left_out = Balls::splat(Interval::symmetric(LEFT_OUT));
    [cosine + left_out, sine + left_out]
}

/// The area tangent of w over w.
fn area(w: Balls) -> Balls {
    let square = w * w;
    if !square.sizes().at_most(MOST_SQUARE) {
        return Balls::splat(Interval::ENTIRE);
    }
    let left_out = Balls::splat(Interval::symmetric(AREA_LEFT / (2 * AREA_TERMS + 1) as f64));
    (0..AREA_TERMS).rev().fold(left_out, |sum, k| Balls::ONE.share(2 * k + 1) + square * sum)
}

/// By how much each of four unknowns moves a, b, c and the velocity.
fn side(all: &[[Balls; 4]], seats: [Seat; Balls::COUNT]) -> [Balls; 4] {
    core::array::from_fn(|k| gathered(all, seats, |own| &own[k]))
}

/// What four pairs of unknowns move of each of the [`PAIRS`].
fn products([one, other]: [[Balls; 4]; 2]) -> [Balls; PAIRS.len()] {
    PAIRS.map(
        |[p, q]| {
            if p == q { one[p] * other[p] } else { Balls::dot([(one[p], other[q]), (one[q], other[p])].into_iter()) }
        },
    )
}

impl Closed {
    /// Whether an equation has a closed form while the velocity has one sign.
    pub(super) fn exists(field: &Field) -> bool {
        ![Term::Cubic, Term::Stiffness, Term::LagRate].into_iter().any(|term| field.has(term))
            && (!field.has(Term::Quadratic) || field.term(Term::Quadratic).lower() > 0.0)
    }

    /// Of a point's equation, from a start and the middle of it; velocities are all `backwards`, or none is.
    pub(super) fn of(field: &Field, start: [&Triple; 2], u: Interval, backwards: bool, carried: &Carried<'_>) -> Self {
        let [middle, start] = start;
        let along = Interval::point(if backwards { -1.0 } else { 1.0 });
        let quadratic = if field.has(Term::Quadratic) { field.term(Term::Quadratic) } else { Interval::ZERO };
        let moved = |bundle: &Bundle| {
            let by = |times: &dyn Fn(Term) -> Interval| bundle.pushed(|term| Balls::splat(times(term)))[0];
            [
                by(&|term| match term {
                    Term::Gain => u,
                    Term::Disturbance => Interval::ONE,
                    _ => Interval::ZERO,
                }),
                by(&|term| match term {
                    Term::Linear => Interval::ONE,
                    Term::Quadratic => -field.twice_middle(),
                    _ => Interval::ZERO,
                }),
                by(&|term| if term == Term::Quadratic { along } else { Interval::ZERO }),
            ]
        };
        let moved: Vec<_> = carried.bundles.iter().map(|bundle| bundle.pushes().then(|| moved(bundle))).collect();
        let bent = carried.pairs.map_or_else(Vec::new, |pairs| {
            let all = moved.iter().zip(carried.columns).map(|(moved, column)| {
                let [a, b, c] = moved.unwrap_or([Balls::ZERO; 3]);
                [a, b, c, column[VELOCITY]]
            });
            let all: Vec<[Balls; 4]> = all.collect();
            pairs.sides.iter().map(|sides| products(sides.map(|seats| side(&all, seats)))).collect()
        });
        Self {
            a: Balls::splat(field.term(Term::Gain) * u + field.term(Term::Disturbance)),
            b: Balls::splat(field.term(Term::Linear) - field.twice_middle() * quadratic),
            c: Balls::splat(along * quadratic),
            middle: [POSITION, VELOCITY].map(|k| Balls::splat(middle[k])),
            start: Balls::splat(start[VELOCITY]),
            force: Balls::splat(middle[FORCE]),
            moved,
            bent,
            quadratic: field.has(Term::Quadratic),
        }
    }

    /// Whether the series suffice for a duration of `h`, in which no velocity is beyond `fastest`.
    pub(super) fn suffices(&self, h: Interval, fastest: f64) -> bool {
        let way = Balls::splat(h * Interval::point(fastest)) * self.c;
        let [_, z_linear, z] = self.arguments(Balls::splat(h));
        way.sizes().at_most(MOST_WAY) && [z_linear, z].iter().all(|z| z.sizes().at_most(MOST_Z))
    }

    /// The square of a time; z times that without what drives, and with it.
    fn arguments(&self, t: Balls) -> [Balls; 3] {
        let (square, half_b) = (t * t, self.b.share(2));
        let linear = half_b * half_b * square;
        [square, linear, linear + self.a * self.c * square]
    }

    /// After times of a step for which the series suffice.
    pub(super) fn values(&self, times: &[Interval]) -> Vec<Values> {
        let four = |times: &[Interval]| {
            let instants = self.at(Balls::new(core::array::from_fn(|k| times[k.min(times.len() - 1)])));
            (0..times.len()).map(move |place| self.place(&instants, place))
        };
        times.chunks(Balls::COUNT).flat_map(four).collect()
    }

    fn at(&self, t: Balls) -> Instants {
        let Self { a, b, c, middle: [x, v], start, .. } = *self;
        let [square, z_linear, z] = self.arguments(t);
        let half_b = b.share(2);
        let cosine = nested(z, |k| (2 * k - 1) * 2 * k);
        let sine = t * nested(z, |k| 2 * k * (2 * k + 1));
        // By z over the square of t.
        let cosine_by = (t * sine).share(2);
        let sine_by = t * (square * nested(z, |k| 2 * k * (2 * k + 3))).share(6);
        let from = |v: Balls| {
            let (alpha, beta) = (a - half_b * v, half_b + c * v);
            let [n, n_by] = [[cosine, sine], [cosine_by, sine_by]].map(|[c, s]| v * c + alpha * s);
            let [d, d_by] = [[cosine, sine], [cosine_by, sine_by]].map(|[c, s]| c + beta * s);
            (n, d, n_by, d_by)
        };
        let (n, d, ..) = from(v);
        let [cosine_over, sine_over] = divided(z, z_linear);
        let over = square * (a * (cosine_over + half_b * t * sine_over)) + v * sine;
        let mean = (d + d - c * over).reciprocal();
        let way = (over + over) * mean * area(c * over * mean);
        let state = [x + way, n * d.reciprocal()];

        let (n, d, n_by, d_by) = from(start);
        let over_d = d.reciprocal();
        let now = n * over_d;
        let half_sine = sine.share(2);
        let n_by_all = [sine + c * n_by, half_b * n_by - half_sine * start, a * n_by];
        let d_by_all = [c * d_by, half_sine + half_b * d_by, start * sine + a * d_by, c * sine];
        let velocity = |k: usize| (n_by_all[k] - now * d_by_all[k]) * over_d;
        let by_start = [sine * over_d, over_d * over_d];
        let by_a = [d_by * over_d, velocity(A)];
        let mut by_c = [Balls::ZERO, velocity(C)];
        if self.quadratic {
            // The way times c is a function of b, a c and c v0 alone.
            let way = way + by_start[0] * (start - v);
            by_c[0] = (a * by_a[0] + start * by_start[0] - way) * c.reciprocal();
        }
        let by = [by_a, [-(n_by * over_d), velocity(B)], by_c, by_start];
        let second = (!self.bent.is_empty()).then(|| {
            let sine_twice = t * (square * square * nested(z, |k| 2 * k * (2 * k + 5))).share(60);
            let cosines = [cosine_by, (t * sine_by).share(2)];
            self.second([now, over_d], &by, &d_by_all, cosines, [sine, sine_by, sine_twice])
        });
        Instants { state, by, second }
    }

    /// What slopes change by, from a velocity and one over its denominator, and what that changes by; with C and S by z.
    fn second(
        &self,
        [now, over_d]: Two,
        by: &[Two; 4],
        d_by: &[Balls; 4],
        [cosine_by, cosine_twice]: [Balls; 2],
        [sine, sine_by, sine_twice]: [Balls; 3],
    ) -> [Two; PAIRS.len()] {
        let Self { a, b, c, start: v, .. } = *self;
        let half_b = b.share(2);
        let (alpha, beta) = (a - half_b * v, half_b + c * v);
        let zs = [c, half_b, a, Balls::ZERO];
        let alphas = [Balls::ONE, -v.share(2), Balls::ZERO, -half_b];
        let betas = [Balls::ZERO, Balls::ONE.share(2), v, c];
        // What numerator and denominator change by with z, and what that changes by.
        let [n_z, d_z] = [v * cosine_by + alpha * sine_by, cosine_by + beta * sine_by];
        let [n_zz, d_zz] = [v * cosine_twice + alpha * sine_twice, cosine_twice + beta * sine_twice];
        let sine_of = zs.map(|z| z * sine_by);
        let mut n_z_of: [Balls; 4] = core::array::from_fn(|k| zs[k] * n_zz + alphas[k] * sine_by);
        n_z_of[V] = n_z_of[V] + cosine_by;
        let d_z_of: [Balls; 4] = core::array::from_fn(|k| zs[k] * d_zz + betas[k] * sine_by);
        let mut second = PAIRS.map(|[p, q]| {
            let mut n = alphas[q] * sine_of[p] + zs[q] * n_z_of[p];
            let mut d = betas[q] * sine_of[p] + zs[q] * d_z_of[p];
            match [p, q] {
                [A, C] => (n, d) = (n + n_z, d + d_z),
                [B, B] => (n, d) = (n + n_z.share(2), d + d_z.share(2)),
                [B, V] => n = n - sine.share(2),
                [C, V] => d = d + sine,
                _ => {}
            }
            if q == V {
                n = n + zs[p] * cosine_by;
            }
            let velocity = n - Balls::dot([(by[p][1], d_by[q]), (by[q][1], d_by[p]), (now, d)].into_iter());
            let way = match [p, q] {
                [A, _] => d_z_of[q] - by[A][0] * d_by[q],
                [_, V] => sine_of[p] - by[V][0] * d_by[p],
                [B, _] => -n_z_of[q] - by[B][0] * d_by[q],
                _ => Balls::ZERO,
            };
            [way * over_d, velocity * over_d]
        });
        if self.quadratic {
            let [[a_c, _], [c_v, _]] = [second[A_C], second[C_V]];
            second[C_C][0] = (a * a_c + v * c_v - by[C][0] - by[C][0]) * c.reciprocal();
        }
        second
    }

    /// Without what bends.
    pub(super) fn straighten(&mut self) {
        self.bent.clear();
    }

    /// One of four.
    fn place(&self, instants: &Instants, place: usize) -> Values {
        let Instants { state: [x, v], by, second } = instants;
        let [.., [way, left]] = by;
        let (zero, one) = ((&Balls::ZERO, 0), (&Balls::ONE, 0));
        let by_start = [[one, (way, place), zero, zero], [zero, (left, place), zero, zero], [zero, zero, one, zero]];
        let [by_a, by_b, by_c, _] = by.each_ref().map(|by| by.each_ref().map(|by| by.spread(place)));
        let by_push = self.moved.iter().map(|moved| {
            let Some([a, b, c]) = *moved else { return [Balls::ZERO; 3] };
            let of = |k: usize| Balls::dot([(a, by_a[k]), (b, by_b[k]), (c, by_c[k])].into_iter());
            [of(POSITION), of(VELOCITY), Balls::ZERO]
        });
        let bends = second.as_ref().map_or_else(Vec::new, |second| {
            let second = second.each_ref().map(|by| by.each_ref().map(|by| by.spread(place)));
            let bend = |bent: &[Balls; PAIRS.len()]| {
                let of = |k: usize| Balls::dot(bent.iter().copied().zip(second.iter().map(|by| by[k])));
                [of(POSITION), of(VELOCITY), Balls::ZERO]
            };
            self.bent.iter().map(bend).collect()
        });
        Values {
            state: [x.spread(place), v.spread(place), self.force],
            by_start: by_start.map(Balls::gather),
            by_push: by_push.collect(),
            bends,
        }
    }
}
