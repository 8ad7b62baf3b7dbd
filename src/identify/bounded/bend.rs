//! The second order: how slopes bend over the box.
//!
//! With s the difference of the motions of theta and of the point, and `s' = A(theta) s + sum z_j P_j` its equation, columns follow
//! `J_j' = A J_j + P_j` with the point's own A. What `s` differs by from `sum z_j J_j` is `sum z_i z_j H_ij`, of squares the half, and
//! a rest of the third order. `H_ij' = A H_ij + f_ij`, in which `f_ij` is what A changes by with one unknown times the column by the
//! other. What slopes over a box leave in doubt adds up from switching to switching; H, of either sign, hardly does.

use super::field::{FORCE, Field, POSITION, Term, VELOCITY};
use super::mix::{Bundle, Mix};
use super::series::{Equations, Motions, ORDER, Slopes};
use crate::numeric::{Balls, Interval, Real, Sizes};
use rest::{Course, PARTS};

pub(super) use rest::Rest;

mod rest;
#[cfg(test)]
mod tests;

/// Degree whose coefficient over the whole step is the remainder.
pub(super) const BEND_ORDER: usize = 8;
// A step's powers of time reach as far.
const _: () = assert!(BEND_ORDER <= ORDER);

/// Polynomials of a lower order, the last coefficient over the whole step.
type Short = [Balls; BEND_ORDER + 1];
type ShortSizes = [Sizes; BEND_ORDER + 1];

/// All pairs of unknowns that move anything, each with those before it and itself.
pub(super) fn pairs(mixes: &[Mix]) -> Vec<[usize; 2]> {
    let moving: Vec<usize> = (0..mixes.len()).filter(|place| mixes[*place].moves()).collect();
    moving.iter().enumerate().flat_map(|(rank, i)| moving[..=rank].iter().map(move |j| [*i, *j])).collect()
}

/// What `z_i z_j` can be; of a square the half.
pub(super) fn product_of([i, j]: [usize; 2], z: &[Interval]) -> Interval {
    if i == j { z[i].square() * Interval::point(0.5) } else { z[i] * z[j] }
}

/// Where an unknown stands: in which bundle, and at which place of it.
pub(super) type Seat = (usize, usize);

/// Pairs of unknowns, side by side.
#[derive(Clone, Debug)]
pub(super) struct Pairs {
    /// The first of each pair, and the second.
    pub(super) sides: Vec<[[Seat; Balls::COUNT]; 2]>,
    products: Vec<Balls>,
}

impl Pairs {
    /// Of all unknowns that move anything.
    pub(super) fn of(mixes: &[Mix], deviations: &[Interval]) -> Self {
        let all = pairs(mixes);
        let rows = all.chunks(Balls::COUNT);
        // Places that are left over repeat the first, and count for nothing.
        let seat = |row: &[[usize; 2]], side: usize, lane: usize| {
            let unknown = row.get(lane).unwrap_or(&row[0])[side];
            (unknown / Balls::COUNT, unknown % Balls::COUNT)
        };
        let product = |pair: Option<&[usize; 2]>| pair.map_or(Interval::ZERO, |pair| product_of(*pair, deviations));
        Self {
            sides: rows
                .clone()
                .map(|row| [0, 1].map(|side| core::array::from_fn(|lane| seat(row, side, lane))))
                .collect(),
            products: rows.map(|row| Balls::new(core::array::from_fn(|lane| product(row.get(lane))))).collect(),
        }
    }

    pub(super) fn count(&self) -> usize {
        self.sides.len()
    }

    /// What all of them add.
    pub(super) fn total(&self, bends: &[[Balls; 3]], component: usize) -> Interval {
        Balls::dot(bends.iter().map(|bend| bend[component]).zip(self.products.iter().copied())).total()
    }
}

/// How much of a term each of four unknowns moves.
pub(super) fn weights(bundles: &[Bundle], seats: [Seat; Balls::COUNT], term: Term) -> Balls {
    Balls::points(seats.map(|(bundle, place)| bundles[bundle].weight(term, place)))
}

/// What a motion over a box carries.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carried<'a> {
    pub(super) bundles: &'a [Bundle],
    /// Slopes by the unknowns of each bundle.
    pub(super) columns: &'a [[Balls; 3]],
    /// Pairs of unknowns, and how the slopes bend by each; none where slopes are over the box.
    pub(super) pairs: Option<&'a Pairs>,
    pub(super) bends: &'a [[Balls; 3]],
    /// Of the third order.
    pub(super) rest: [Interval; 3],
}

impl Carried<'_> {
    /// One point.
    pub(super) const NOTHING: Self =
        Self { bundles: &[], columns: &[], pairs: None, bends: &[], rest: [Interval::ZERO; 3] };

    /// Whether no unknown is off the point.
    pub(super) fn of_point(&self) -> bool {
        self.bundles.iter().all(|bundle| bundle.deviations.sizes().at_most(0.0))
    }
}

/// What bends during a step.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    paths: Vec<[Short; 3]>,
    lagged: bool,
    /// Of the third order.
    pub(super) rest: Rest,
}

impl Curve {
    /// By each bundle of pairs, after a time of the step with these powers.
    pub(super) fn at(&self, powers: &[Balls]) -> Vec<[Balls; 3]> {
        let value = |series: &Short| Balls::dot(series.iter().copied().zip(powers.iter().copied()));
        let components = if self.lagged { 3 } else { 2 };
        let short =
            |path: &[Short; 3]| core::array::from_fn(|k| if k < components { value(&path[k]) } else { Balls::ZERO });
        self.paths.iter().map(short).collect()
    }
}

/// A column of slopes, and what of it bends the others.
struct Column {
    head: [Short; 3],
    within: [ShortSizes; 3],
    /// Bends the damping.
    damps: Short,
    damps_within: ShortSizes,
}

/// Coefficients of what bends the damping: of velocities, and of what its terms multiply.
struct Damping {
    kinks: (Short, ShortSizes),
    terms: [(Short, ShortSizes); 3],
}

impl Damping {
    fn of(ground: &Ground<'_>) -> Self {
        let all = |of: &dyn Fn(usize) -> (Balls, Sizes)| {
            let (mut own, mut within) = (NONE, NO_SIZES);
            for k in 0..BEND_ORDER {
                (own[k], within[k]) = of(k);
            }
            (own, within)
        };
        let term = |term: Term| {
            if ground.at.has(term) { all(&|k| ground.damped_by(term, k)) } else { (NONE, NO_SIZES) }
        };
        Self { kinks: all(&|k| ground.kink(k)), terms: [term(Term::Linear), term(Term::Quadratic), term(Term::Cubic)] }
    }

    fn by(&self, term: Term) -> &(Short, ShortSizes) {
        match term {
            Term::Quadratic => &self.terms[1],
            Term::Cubic => &self.terms[2],
            _ => &self.terms[0],
        }
    }
}

/// The pairs of a product's coefficient.
#[inline]
fn products<'a, T: Copy>(a: &'a [T], b: &'a [T], k: usize) -> impl Iterator<Item = (T, T)> + 'a {
    a[..=k].iter().copied().zip(b[..=k].iter().rev().copied())
}

const NONE: Short = [Balls::ZERO; BEND_ORDER + 1];
const NO_SIZES: ShortSizes = [Sizes::ZERO; BEND_ORDER + 1];

/// Something of each of four unknowns.
#[inline]
pub(super) fn gathered<T>(columns: &[T], [a, b, c, d]: [Seat; Balls::COUNT], of: impl Fn(&T) -> &Balls) -> Balls {
    let from = |(bundle, place): Seat| (of(&columns[bundle]), place);
    Balls::gather([from(a), from(b), from(c), from(d)])
}
#[inline]
fn gathered_within(columns: &[Column], [a, b, c, d]: [Seat; Balls::COUNT], of: impl Fn(&Column) -> &Sizes) -> Sizes {
    let from = |(bundle, place): Seat| (of(&columns[bundle]), place);
    Sizes::gather([from(a), from(b), from(c), from(d)])
}

fn size(value: f64) -> Sizes {
    Sizes::splat(Interval::point(value))
}

/// The equation over the box and at the point, and the point's motion in a step.
pub(super) struct Ground<'a> {
    pub(super) own: &'a Equations,
    pub(super) slopes: &'a Slopes<'a>,
    pub(super) motions: &'a Motions,
    pub(super) over: &'a Field,
    pub(super) at: &'a Field,
    pub(super) backwards: bool,
}

impl Ground<'_> {
    /// What a term multiplies in the damping, with its sign turned; at the point, and over the step at most.
    fn damped_by(&self, term: Term, k: usize) -> (Balls, Sizes) {
        let [velocity, square] = self.motions.point(k);
        let (own, within) = match term {
            Term::Linear if k == 0 => (Balls::ONE, size(1.0)),
            Term::Quadratic => {
                let twice = velocity.0 + velocity.0;
                let twice = if self.backwards { -twice } else { twice };
                if k == 0 {
                    let middle = self.at.twice_middle();
                    (twice - Balls::splat(middle), velocity.1 + velocity.1 + Sizes::splat(middle))
                } else {
                    (twice, velocity.1 + velocity.1)
                }
            }
            Term::Cubic => {
                let three = Balls::splat(Interval::point(3.0));
                (three * square.0, size(3.0) * square.1)
            }
            _ => (Balls::ZERO, Sizes::ZERO),
        };
        (own, within)
    }

    /// By how much the damping changes with the velocity; the same two.
    fn kink(&self, k: usize) -> (Balls, Sizes) {
        let (mut own, mut within) = (Balls::ZERO, Sizes::ZERO);
        if self.at.has(Term::Quadratic) && k == 0 {
            let quadratic = self.at.term(Term::Quadratic);
            own = Balls::splat(if self.backwards { -quadratic } else { quadratic });
            within = Sizes::splat(quadratic);
        }
        if self.at.has(Term::Cubic) {
            let three = self.at.term(Term::Cubic) * Interval::point(3.0);
            let [velocity, _] = self.motions.point(k);
            own = own + Balls::splat(three) * velocity.0;
            within = within + Sizes::splat(three) * velocity.1;
        }
        (own, within)
    }

    /// Polynomials of a column of slopes from its start, given what pushes velocity and force; and their coefficients over the whole step
    /// at most. `None` where they may grow beyond all bounds.
    fn polynomials(
        &self,
        start: &[Balls; 3],
        push: impl Fn(usize) -> [Balls; 2],
        pushed: impl Fn(usize) -> [Sizes; 2],
    ) -> Option<([Short; 3], [ShortSizes; 3])> {
        let (mut head, mut within) = ([NONE; 3], [NO_SIZES; 3]);
        for (series, start) in head.iter_mut().zip(start) {
            series[0] = *start;
        }
        self.own.head_of(self.slopes, push, &mut head);
        let from = self.own.sizes(self.slopes.damping, pushed(0), start, self.slopes.h)?;
        self.own.within_of(self.slopes, pushed, from, &mut within);
        for (series, within) in head.iter_mut().zip(&within) {
            series[BEND_ORDER] = Balls::within(within[BEND_ORDER]);
        }
        Some((head, within))
    }

    fn column(&self, bundle: &Bundle, start: &[Balls; 3], damping: &Damping) -> Option<Column> {
        let push = |k: usize| self.motions.pushed(bundle, k);
        let pushed = |k: usize| self.motions.pushed_within(bundle, k);
        let (head, within) = self.polynomials(start, push, pushed)?;
        let mut column = Column { head, within, damps: NONE, damps_within: NO_SIZES };
        for k in 0..BEND_ORDER {
            let terms = || bundle.damping_terms().map(|(term, weight)| (weight, damping.by(term)));
            let own = Balls::dot(terms().map(|(weight, (by, _))| (weight, by[k])));
            let within = Sizes::dot(terms().map(|(weight, (_, by))| (weight.sizes(), by[k])));
            let (kinks, kinks_within) = &damping.kinks;
            column.damps[k] = own + Balls::dot(products(kinks, &column.head[VELOCITY], k));
            column.damps_within[k] = within + Sizes::dot(products(kinks_within, &column.within[VELOCITY], k));
        }
        Some(column)
    }

    /// How slopes bend during a step, from where they are. `None` where the rest may grow beyond all bounds.
    pub(super) fn curve(&self, carried: &Carried<'_>, pairs: &Pairs) -> Option<Curve> {
        let damping = Damping::of(self);
        let columns = carried.bundles.iter().zip(carried.columns);
        let columns: Option<Vec<Column>> =
            columns.map(|(bundle, start)| self.column(bundle, start, &damping)).collect();
        let columns = columns?;
        let lagged = self.at.has(Term::LagRate);
        let stiff = self.at.has(Term::Stiffness);
        let course = Course::of(self)?;
        let mut second = [[Sizes::ZERO; 3]; PARTS];
        let mut paths = Vec::with_capacity(pairs.count());
        for ((sides, deviations), start) in pairs.sides.iter().zip(&pairs.products).zip(carried.bends) {
            let weight = |side: usize, term: Term| weights(carried.bundles, sides[side], term);
            let (mut moved, mut filled) = (NONE, NONE);
            let (mut moved_within, mut filled_within) = (NO_SIZES, NO_SIZES);
            let (mut damps, mut v) = ([NONE; 2], [NONE; 2]);
            let (mut damps_within, mut v_within) = ([NO_SIZES; 2], [NO_SIZES; 2]);
            for k in 0..BEND_ORDER {
                for (side, seats) in sides.iter().enumerate() {
                    let other = 1 - side;
                    damps[side][k] = gathered(&columns, *seats, |c| &c.damps[k]);
                    v[other][k] = gathered(&columns, *seats, |c| &c.head[VELOCITY][k]);
                    damps_within[side][k] = gathered_within(&columns, *seats, |c| &c.damps_within[k]);
                    v_within[other][k] = gathered_within(&columns, *seats, |c| &c.within[VELOCITY][k]);
                }
                moved[k] = -Balls::dot(products(&damps[0], &v[0], k).chain(products(&damps[1], &v[1], k)));
                let [first, second] = [0, 1].map(|side| products(&damps_within[side], &v_within[side], k));
                moved_within[k] = Sizes::dot(first.chain(second));
            }
            for side in [0, 1] {
                let other = 1 - side;
                if stiff {
                    let weight = weight(side, Term::Stiffness);
                    for k in 0..BEND_ORDER {
                        moved[k] = moved[k] - weight * gathered(&columns, sides[other], |c| &c.head[POSITION][k]);
                        moved_within[k] = moved_within[k]
                            + weight.sizes() * gathered_within(&columns, sides[other], |c| &c.within[POSITION][k]);
                    }
                }
                if lagged {
                    let (gain, lag) = (weight(side, Term::Gain), weight(side, Term::LagRate));
                    for k in 0..BEND_ORDER {
                        let (f, f_w) = (
                            gathered(&columns, sides[other], |c| &c.head[FORCE][k]),
                            gathered_within(&columns, sides[other], |c| &c.within[FORCE][k]),
                        );
                        moved[k] = moved[k] + gain * f;
                        moved_within[k] = moved_within[k] + gain.sizes() * f_w;
                        filled[k] = filled[k] - lag * f;
                        filled_within[k] = filled_within[k] + lag.sizes() * f_w;
                    }
                }
            }
            let pushed = |k: usize| [moved_within[k], filled_within[k]];
            let (path, _) = self.polynomials(&[Balls::ZERO; 3], |k| [moved[k], filled[k]], pushed)?;
            let all = self.own.sizes(self.slopes.damping, pushed(0), start, self.slopes.h)?;
            let bent = self.own.growth(&self.slopes.rest, pushed, all, 2).map(|series| series[2]);
            course.add_largest(&mut second, deviations.sizes(), &course.carried(start, &path), bent);
            paths.push(path);
        }
        let push = self.push(carried, &columns, &damping, &course, second.map(|part| part.map(Sizes::total)));
        let rest = self.rest(carried.rest, &push, &course)?;
        Some(Curve { paths, lagged, rest })
    }
}

/// The magnitude.
pub(super) fn most(value: Interval) -> Interval {
    Interval::point(value.magnitude())
}

impl Equations {
    /// Coefficients of a column of slopes, from those at its start, but the last.
    fn head_of(&self, slopes: &Slopes<'_>, push: impl Fn(usize) -> [Balls; 2], path: &mut [Short; 3]) {
        let components = if self.has(Term::LagRate) { 3 } else { 2 };
        for k in 0..BEND_ORDER - 1 {
            let own = [path[POSITION][k], path[VELOCITY][k], path[FORCE][k]];
            let rates = self.rates(Balls::dot(products(&slopes.head, &path[VELOCITY], k)), own, push(k));
            for (series, rate) in path.iter_mut().zip(rates).take(components) {
                series[k + 1] = rate.share(k + 1);
            }
        }
    }

    /// The same over the whole step at most, from its size there.
    fn within_of(
        &self,
        slopes: &Slopes<'_>,
        push: impl Fn(usize) -> [Sizes; 2],
        from: [Sizes; 3],
        path: &mut [ShortSizes; 3],
    ) {
        let series = self.growth(&slopes.rest, push, from, BEND_ORDER);
        for (path, series) in path.iter_mut().zip(series) {
            path.copy_from_slice(&series[..=BEND_ORDER]);
        }
    }
}
