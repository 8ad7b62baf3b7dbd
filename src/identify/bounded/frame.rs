//! Slanted boxes: parameters that make up for each other fill a thin sheared box, which a box along the axes holds badly.
//!
//! `theta = centre + M z` with M unit lower triangular, so that every theta has its z whatever floats stand below the diagonal, and z
//! follows from theta by substitution in intervals. M is from the readings' information about the centre, and is not trusted.

use nalgebra::{DMatrix, DVector};

use super::contract::{Linear, Model, Origin};
use super::lp::Multipliers;
use super::mix::Mix;
use super::problem::Layout;
use crate::numeric::Interval;

#[cfg(test)]
mod tests;

/// Parameters and states at records' beginnings, in coordinates that hardly depend on each other.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    /// Where each stands in a box.
    pub(super) places: Vec<usize>,
    pub(super) centre: Vec<f64>,
    /// Row by row, below the diagonal.
    pub(super) lower: Vec<Vec<f64>>,
    /// The box in these coordinates.
    pub(super) z: Vec<Interval>,
}

pub(super) fn dot(weights: &[(usize, f64)], z: &[Interval]) -> Interval {
    Interval::dot(weights.iter().map(|(index, weight)| (Interval::point(*weight), z[*index])))
}

/// A combination of coordinates: `constant + sum weights_j z_j`.
#[derive(Clone, Debug)]
pub(super) struct Affine {
    constant: Interval,
    weights: Vec<Interval>,
}

impl Affine {
    /// Times `sign`, with weights that are floats: what a linear programme is asked.
    pub(super) fn objective(&self, sign: f64) -> Vec<(usize, f64)> {
        self.weights.iter().map(|weight| sign * weight.midpoint()).enumerate().collect()
    }

    /// All that it can be.
    pub(super) fn over(&self, z: &[Interval]) -> Interval {
        self.constant + Interval::dot(self.weights.iter().copied().zip(z.iter().copied()))
    }

    /// An upper bound of it, times `sign`, over a frame's box, of which the rows are inequalities about the middle.
    pub(super) fn most(&self, sign: f64, frame: &Frame, linear: &Linear, multipliers: &Multipliers) -> f64 {
        let (objective, sign) = (self.objective(sign), Interval::point(sign));
        let bound = linear.rows.upper_bound(&objective, multipliers, &linear.deviations);
        let rounded =
            objective.iter().zip(&self.weights).map(|((_, float), weight)| sign * *weight - Interval::point(*float));
        let rounded = Interval::dot(rounded.zip(frame.z.iter().copied()));
        (sign * self.constant + dot(&objective, &frame.middle()) + rounded + Interval::point(bound)).upper()
    }
}

impl Frame {
    /// A frame about a centre, over a box along the axes.
    pub(super) fn about(places: Vec<usize>, centre: Vec<f64>, lower: Vec<Vec<f64>>, at: &[Interval]) -> Self {
        let mut frame = Self { places, centre, lower, z: Vec::new() };
        frame.z = frame.coordinates(|row| at[frame.places[row]] - Interval::point(frame.centre[frame.places[row]]));
        frame
    }

    /// The same axes and centre, over another box along the axes of the unknowns.
    pub(super) fn around(&self, at: &[Interval]) -> Self {
        Self::about(self.places.clone(), self.centre.clone(), self.lower.clone(), at)
    }

    /// What an unknown is by the coordinates.
    pub(super) fn unknown(&self, row: usize) -> Affine {
        let constant = Interval::point(self.centre[self.places[row]]);
        let weights = (0..self.places.len()).map(|column| if column <= row { self.weight(row, column) } else { 0.0 });
        Affine { constant, weights: weights.map(Interval::point).collect() }
    }

    /// What a combination of unknowns is by them; `None` where it has one of no row.
    pub(super) fn combination(&self, parts: &[(usize, f64)]) -> Option<Affine> {
        let mut sum = Affine { constant: Interval::ZERO, weights: vec![Interval::ZERO; self.places.len()] };
        for (place, factor) in parts {
            let own = self.unknown(self.places.iter().position(|own| own == place)?);
            let factor = Interval::point(*factor);
            sum.constant += factor * own.constant;
            sum.weights.iter_mut().zip(own.weights).for_each(|(sum, weight)| *sum += factor * weight);
        }
        Some(sum)
    }

    /// What the coordinates of another frame are by its own.
    pub(super) fn turned(&self, next: &Self) -> Vec<Affine> {
        let centre = |frame: &Self, row: usize| Interval::point(frame.centre[frame.places[row]]);
        let constants = next.coordinates(|row| centre(self, row) - centre(next, row));
        let columns: Vec<Vec<Interval>> = (0..self.places.len())
            .map(|column| {
                next.coordinates(|row| Interval::point(if row < column { 0.0 } else { self.weight(row, column) }))
            })
            .collect();
        let affine = |(row, constant)| Affine { constant, weights: columns.iter().map(|column| column[row]).collect() };
        constants.into_iter().enumerate().map(affine).collect()
    }

    /// The first coordinates of a box in another frame, which begins with the same unknowns, or of one along the axes.
    fn first(&self, count: usize, at: &[Interval], other: Option<&Self>) -> Vec<Interval> {
        let straight = || self.coordinates(|row| at[self.places[row]] - Interval::point(self.centre[self.places[row]]));
        let turned =
            |other: &Self| other.turned(self).iter().map(|affine| affine.over(&other.z)).collect::<Vec<Interval>>();
        other.map_or_else(straight, turned).into_iter().take(count).collect()
    }

    /// Around boxes and their frames, where they have some: so many unknowns, the first of theirs and of `places`, in the frame of
    /// theirs that holds them best, and the others along the axes as in the box `at`. `None` where no box has a frame.
    pub(super) fn led_by<'a>(
        count: usize,
        boxes: impl Iterator<Item = (&'a [Interval], Option<&'a Self>)> + Clone,
        places: Vec<usize>,
        at: &[Interval],
    ) -> Option<Self> {
        let around = |own: &'a Self| {
            let z = boxes.clone().map(|(at, frame)| own.first(count, at, frame));
            let z: Vec<Interval> = z.reduce(|hull, z| hull.iter().zip(&z).map(|(a, b)| a.hull(*b)).collect())?;
            let size: f64 = z.iter().map(|z| z.width().max(f64::MIN_POSITIVE).ln()).sum();
            Some((size, own, z))
        };
        let frames = boxes.clone().filter_map(|(_, frame)| frame);
        let (_, own, mut z) = frames.filter_map(around).min_by(|a, b| a.0.total_cmp(&b.0))?;
        let mut centre: Vec<f64> = at.iter().map(|side| side.midpoint()).collect();
        for place in &places[..count] {
            centre[*place] = own.centre[*place];
        }
        z.extend(places[count..].iter().map(|place| at[*place] - Interval::point(centre[*place])));
        let lower = (0..places.len()).map(|row| if row < count { own.lower[row].clone() } else { vec![0.0; row] });
        Some(Self { lower: lower.collect(), places, centre, z: z.clone() }.moved(z))
    }

    /// Along the axes.
    pub(super) fn straight(places: Vec<usize>, at: &[Interval]) -> Self {
        let centre: Vec<f64> = at.iter().map(|side| side.midpoint()).collect();
        let z = places.iter().map(|place| at[*place] - Interval::point(centre[*place])).collect();
        let lower = (0..places.len()).map(|row| vec![0.0; row]).collect();
        Self { places, centre, lower, z }
    }

    pub(super) fn weight(&self, row: usize, column: usize) -> f64 {
        if row == column { 1.0 } else { self.lower[row].get(column).copied().unwrap_or(0.0) }
    }

    /// Of the box.
    pub(super) fn middle(&self) -> Vec<Interval> {
        self.z.iter().map(|side| Interval::point(side.midpoint())).collect()
    }

    /// What a place is made of.
    pub(super) fn row(&self, row: usize) -> Vec<(usize, f64)> {
        (0..=row).map(|column| (column, self.weight(row, column))).filter(|(_, weight)| *weight != 0.0).collect()
    }

    /// Coordinates of a deviation.
    pub(super) fn coordinates(&self, deviation: impl Fn(usize) -> Interval) -> Vec<Interval> {
        let mut z: Vec<Interval> = Vec::with_capacity(self.places.len());
        for (row, lower) in self.lower.iter().enumerate() {
            let known = Interval::dot(lower.iter().map(|weight| Interval::point(*weight)).zip(z.iter().copied()));
            z.push(deviation(row) - known);
        }
        z
    }

    /// What both the sides of a box and the slanted box hold goes into either; `false` where that is nothing.
    pub(super) fn meet(&mut self, at: &mut [Interval]) -> bool {
        let own = self.coordinates(|row| at[self.places[row]] - Interval::point(self.centre[self.places[row]]));
        for (z, own) in self.z.iter_mut().zip(own) {
            let Some(met) = z.intersection(own) else { return false };
            *z = met;
        }
        for (row, place) in self.places.iter().enumerate() {
            let side = Interval::point(self.centre[*place]) + dot(&self.row(row), &self.z);
            let Some(met) = at[*place].intersection(side) else { return false };
            at[*place] = met;
        }
        true
    }

    /// The same slanted further by `lower` and about a new centre, given the coordinates in the slanted frame about the old one.
    pub(super) fn moved(mut self, z: Vec<Interval>) -> Self {
        let middle: Vec<f64> = z.iter().map(|side| side.midpoint()).collect();
        let mut shift = Vec::with_capacity(z.len());
        for (row, place) in self.places.iter().enumerate() {
            let by: f64 = (0..=row).map(|column| self.weight(row, column) * middle[column]).sum();
            let (old, new) = (self.centre[*place], self.centre[*place] + by);
            self.centre[*place] = new;
            shift.push(Interval::point(old) - Interval::point(new));
        }
        let shift = self.coordinates(|row| shift[row]);
        self.z = z.into_iter().zip(shift).map(|(z, shift)| z + shift).collect();
        self
    }

    /// Whether a point is in the slanted box, its first parameter moved by a share of itself.
    #[cfg(test)]
    pub(super) fn holds(&self, point: &[f64], share: f64) -> bool {
        let moved = |row: usize| if row == 0 { 1.0 + share } else { 1.0 };
        let from = |row: usize| Interval::point(self.centre[self.places[row]]);
        let own = self.coordinates(|row| Interval::point(point[self.places[row]] * moved(row)) - from(row));
        self.z.iter().zip(own).all(|(z, own)| z.intersection(own).is_some())
    }

    /// Halves along a coordinate.
    pub(super) fn halves(&self, unknown: usize) -> Option<[Self; 2]> {
        let side = self.z[unknown];
        let middle = side.midpoint();
        let [low, high] = [Interval::new(side.lower(), middle)?, Interval::new(middle, side.upper())?];
        let with = |half| {
            let mut part = self.clone();
            part.z[unknown] = half;
            part
        };
        (side.lower() < middle && middle < side.upper()).then(|| [with(low), with(high)])
    }

    /// Where the readings' slopes, those of the rows, tell least: the frame in which what they tell is uncorrelated.
    pub(super) fn informed(&self, linear: &Linear, error: f64) -> Self {
        let n = self.places.len();
        let radius: Vec<f64> = self.z.iter().map(|z| z.radius().max(f64::MIN_POSITIVE)).collect();
        let mut information = DMatrix::identity(n, n);
        for (row, origin) in linear.rows.slopes.iter().zip(&linear.origins) {
            if !matches!(origin, Origin::Reading { above: true, .. }) {
                continue;
            }
            let mut slopes = DVector::zeros(n);
            let coordinates = row.iter().filter(|(j, _)| *j < n);
            coordinates.for_each(|(j, slope)| slopes[*j] = slope.midpoint() * radius[*j] / error);
            information.ger(1.0, &slopes, &slopes, 1.0);
        }
        let mut frame = self.clone();
        let Some(lower) = slant(information) else { return frame };
        for row in 0..n {
            for column in 0..row {
                let sum: f64 = (column..=row)
                    .map(|k| {
                        self.weight(row, k)
                            * if k == column { 1.0 } else { lower[(k, column)] * radius[k] / radius[column] }
                    })
                    .sum();
                frame.lower[row][column] = if sum.is_finite() { sum } else { 0.0 };
            }
        }
        frame
    }
}

/// The unit lower triangular L of `L D L'` of what the inverse of the information is; none where floats give none.
fn slant(information: DMatrix<f64>) -> Option<DMatrix<f64>> {
    let mut lower = information.cholesky()?.inverse().cholesky()?.unpack();
    for column in 0..lower.ncols() {
        let diagonal = lower[(column, column)];
        lower.column_mut(column).unscale_mut(diagonal);
    }
    Some(lower)
}

impl Frame {
    /// What each coordinate moves in the windows that begin with this one.
    pub(super) fn mixes(&self, layout: &Layout, from: usize) -> Vec<Mix> {
        let (by, places) = layout.columns(from);
        (0..self.places.len())
            .map(|column| {
                Mix::of(by.iter().zip(&places).filter_map(|(by, place)| {
                    let row = self.places.iter().position(|own| own == place)?;
                    Some((*by, if row < column { 0.0 } else { self.weight(row, column) }))
                }))
            })
            .collect()
    }

    /// What the search box says, by the coordinates.
    pub(super) fn sides(&self, model: &Model<'_>, at: &[Interval]) -> Linear {
        let mut own = model.about(at, self.centre.clone());
        model.bound(&mut own);
        for slopes in &mut own.rows.slopes {
            let mut turned = vec![Interval::ZERO; self.places.len()];
            for (place, slope) in slopes.iter() {
                let Some(row) = self.places.iter().position(|own| own == place) else { continue };
                for (column, weight) in self.row(row) {
                    turned[column] += Interval::point(weight) * *slope;
                }
            }
            *slopes = turned.into_iter().enumerate().filter(|(_, slope)| *slope != Interval::ZERO).collect();
        }
        own
    }
}
