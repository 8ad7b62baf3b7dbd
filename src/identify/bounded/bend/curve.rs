//! How slopes bend during a step, as polynomials in time.

use super::super::field::{FORCE, POSITION, Term, VELOCITY};
use super::super::series::{Equations, Slopes, powers};
use super::column::{BEND_ORDER, Column, Number, Short, products, pushed};
use super::ground::{Ground, Largest};
use super::{Carried, Pairs};
use crate::numeric::{Balls, Interval, Sizes};

/// Polynomials of position, velocity and force; the coefficient of the highest degree is over the whole step.
type Path = [Short<Balls>; 3];

/// What is added in a step, by each bundle of pairs.
#[derive(Clone, Debug, Default)]
pub(in super::super) struct Curve {
    paths: Vec<Path>,
    lagged: bool,
}

impl Curve {
    /// After a time of the step.
    pub(in super::super) fn at(&self, time: Interval) -> Vec<[Balls; 3]> {
        if self.paths.is_empty() {
            return Vec::new();
        }
        let powers = powers(time, BEND_ORDER);
        let value = |series: &Short<Balls>| Balls::dot(series.iter().copied().zip(powers.iter().copied()));
        let components = if self.lagged { 3 } else { 2 };
        let values = |path: &Path| core::array::from_fn(|k| if k < components { value(&path[k]) } else { Balls::ZERO });
        self.paths.iter().map(values).collect()
    }
}

impl Ground<'_> {
    /// How slopes bend, given how large all is. `None` where that may grow beyond all bounds.
    pub(in super::super) fn curve(&self, carried: &Carried<'_>, pairs: &Pairs, largest: &Largest) -> Option<Curve> {
        let damping = self.damping(BEND_ORDER, |(own, _)| own);
        let starts = carried.bundles.iter().zip(carried.columns).zip(&largest.columns);
        let columns: Vec<Column<Balls>> = starts
            .map(|((bundle, start), within)| {
                let path = self.path(start, |k| self.slopes.motions.pushed(bundle, k), &within.path);
                Column::of(path, bundle, &damping, BEND_ORDER)
            })
            .collect();
        let path = |(sides, within): (_, &[Short<Sizes>; 2])| {
            let [moved, filled] = pushed(&columns, carried.bundles, sides, self.terms(), BEND_ORDER);
            let within = self.grown(|k| [within[0][k], within[1][k]], &[Balls::ZERO; 3], BEND_ORDER)?;
            Some(self.path(&[Balls::ZERO; 3], |k| [moved[k], filled[k]], &within))
        };
        let paths: Option<Vec<Path>> = pairs.sides.iter().zip(&largest.pushed).map(path).collect();
        Some(Curve { paths: paths?, lagged: self.at.has(Term::LagRate) })
    }

    /// A column from its start, given what pushes velocity and force.
    fn path(&self, start: &[Balls; 3], push: impl Fn(usize) -> [Balls; 2], within: &[Short<Sizes>; 3]) -> Path {
        let mut path = [Balls::NONE; 3];
        for (series, start) in path.iter_mut().zip(start) {
            series[0] = *start;
        }
        self.own.head_of(&self.slopes, push, &mut path);
        for (series, within) in path.iter_mut().zip(within) {
            series[BEND_ORDER] = Balls::within(within[BEND_ORDER]);
        }
        path
    }
}

impl Equations {
    /// Coefficients of a column of slopes, from those at its start, but the last.
    fn head_of(&self, slopes: &Slopes, push: impl Fn(usize) -> [Balls; 2], path: &mut Path) {
        let components = if self.has(Term::LagRate) { 3 } else { 2 };
        for k in 0..BEND_ORDER - 1 {
            let own = [path[POSITION][k], path[VELOCITY][k], path[FORCE][k]];
            let rates = self.rates(Balls::dot(products(&slopes.head, &path[VELOCITY], k)), own, push(k));
            for (series, rate) in path.iter_mut().zip(rates).take(components) {
                series[k + 1] = rate.share(k + 1);
            }
        }
    }
}
