//! Slanted boxes: parameters that make up for each other fill a thin sheared box, which a box along the axes holds badly.
//!
//! `theta = centre + M z` with M unit lower triangular, so that every theta has its z whatever floats stand below the diagonal, and z
//! follows from theta by substitution in intervals. M is from the readings' information about the centre, and is not trusted.

use nalgebra::{DMatrix, DVector};

use super::contract::{Linear, Model, Origin, Span};
use super::lp::{Multipliers, Outcome, Programme};
use super::mix::Mix;
use super::search::{Empty, Left, Method, Search};
use super::trajectory::Node;
use crate::numeric::Interval;

/// Parameters and states at records' beginnings, in coordinates that hardly depend on each other.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    /// Where each stands in a box.
    places: Vec<usize>,
    centre: Vec<f64>,
    /// Row by row, below the diagonal.
    lower: Vec<Vec<f64>>,
    /// The box in these coordinates.
    pub(super) z: Vec<Interval>,
}

fn dot(weights: &[(usize, f64)], z: &[Interval]) -> Interval {
    Interval::dot(weights.iter().map(|(index, weight)| (Interval::point(*weight), z[*index])))
}

impl Frame {
    /// Along the axes.
    fn straight(places: Vec<usize>, at: &[Interval]) -> Self {
        let centre: Vec<f64> = at.iter().map(|side| side.midpoint()).collect();
        let z = places.iter().map(|place| at[*place] - Interval::point(centre[*place])).collect();
        let lower = (0..places.len()).map(|row| vec![0.0; row]).collect();
        Self { places, centre, lower, z }
    }

    fn weight(&self, row: usize, column: usize) -> f64 {
        if row == column { 1.0 } else { self.lower[row].get(column).copied().unwrap_or(0.0) }
    }

    /// What a place is made of.
    fn row(&self, row: usize) -> Vec<(usize, f64)> {
        (0..=row).map(|column| (column, self.weight(row, column))).filter(|(_, weight)| *weight != 0.0).collect()
    }

    /// Coordinates of a deviation.
    fn coordinates(&self, deviation: impl Fn(usize) -> Interval) -> Vec<Interval> {
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
    fn moved(mut self, z: Vec<Interval>) -> Self {
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
    fn informed(&self, linear: &Linear, error: f64) -> Self {
        let n = self.places.len();
        let radius: Vec<f64> = self.z.iter().map(|z| z.radius().max(f64::MIN_POSITIVE)).collect();
        let mut information = DMatrix::identity(n, n);
        for (row, origin) in linear.rows.slopes.iter().zip(&linear.origins) {
            if !matches!(origin, Origin::Reading { above: true, .. }) {
                continue;
            }
            let mut slopes = DVector::zeros(n);
            row.iter().for_each(|(j, slope)| slopes[*j] = slope.midpoint() * radius[*j] / error);
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

impl Model<'_> {
    /// The motion over a whole record, and how it differs from that of the frame's centre by each coordinate.
    fn slanted(&self, span: Span, at: &[Interval], frame: &Frame) -> Option<Vec<Node>> {
        let (by, places) = self.layout.columns(span.from);
        let mixes: Vec<Mix> = (0..frame.places.len())
            .map(|column| {
                Mix::of(by.iter().zip(&places).filter_map(|(by, place)| {
                    let row = frame.places.iter().position(|own| own == place)?;
                    Some((*by, if row < column { 0.0 } else { frame.weight(row, column) }))
                }))
            })
            .collect();
        self.follow(span, at, &frame.centre, &mixes, &frame.z)
    }

    /// Whole records in a frame. `None` where there is no enclosure.
    fn in_frame(&self, at: &[Interval], frame: &Frame) -> Option<Linear> {
        let mut linear = Linear { centre: frame.centre.clone(), deviations: frame.z.clone(), ..Linear::default() };
        let unknowns: Vec<usize> = (0..frame.places.len()).collect();
        for span in self.whole() {
            let motion = self.slanted(span, at, frame)?;
            self.linearise_by(&unknowns, span, &motion, false, &mut linear);
        }
        let mut own = self.about(at, frame.centre.clone());
        self.bound(&mut own);
        for ((slopes, limit), origin) in own.rows.slopes.iter().zip(&own.rows.limits).zip(&own.origins) {
            let mut turned = vec![Interval::ZERO; unknowns.len()];
            for (place, slope) in slopes {
                let Some(row) = frame.places.iter().position(|own| own == place) else { continue };
                for (column, weight) in frame.row(row) {
                    turned[column] += Interval::point(weight) * *slope;
                }
            }
            linear
                .rows
                .slopes
                .push(turned.into_iter().enumerate().filter(|(_, slope)| *slope != Interval::ZERO).collect());
            linear.rows.limits.push(*limit);
            linear.origins.push(*origin);
        }
        Some(linear)
    }
}

impl Linear {
    /// An upper bound of a combination of the deviations.
    fn most(&self, programme: &Programme, objective: &[(usize, f64)]) -> Result<f64, Multipliers> {
        match programme.maximise(objective) {
            Outcome::Empty { multipliers } if self.rows.upper_bound(&[], &multipliers, &self.deviations) < 0.0 => {
                Err(multipliers)
            }
            Outcome::Empty { .. } => Ok(f64::INFINITY),
            Outcome::Bounded { multipliers, .. } => {
                Ok(self.rows.upper_bound(objective, &multipliers, &self.deviations))
            }
        }
    }

    /// What the rows leave of a combination; with the multipliers that contradict it, of nothing.
    fn range(&self, programme: &Programme, objective: &[(usize, f64)]) -> Result<Interval, Multipliers> {
        let own = dot(objective, &self.deviations);
        let opposite: Vec<(usize, f64)> = objective.iter().map(|(index, weight)| (*index, -weight)).collect();
        let (most, least) = (self.most(programme, objective)?, self.most(programme, &opposite)?);
        let range = Interval::new(-least, most).and_then(|range| range.intersection(own));
        range.ok_or_else(Multipliers::new)
    }
}

impl Search<'_> {
    /// One pass over whole records in a frame, which it slants and moves. None where the slopes' ranges take more than `most` of
    /// the readings' error, or there is no enclosure.
    pub(super) fn slant(
        &mut self,
        at: &mut [Interval],
        frame: &mut Option<Frame>,
        most: f64,
    ) -> Result<Option<Left>, Empty> {
        let mut own = frame.clone().unwrap_or_else(|| Frame::straight(self.of_whole(), at));
        let parted = || Empty { method: Method::Whole, multipliers: Vec::new(), linear: None };
        if !own.meet(at) {
            return Err(parted());
        }
        self.count_pass();
        let found = self.model.in_frame(at, &own);
        let Some(linear) = found else { return Ok(None) };
        let (slack, widest) = self.slack_by(&linear, own.places.len());
        if slack > most {
            return Ok(None);
        }
        let empty = |multipliers, linear: &Linear, at: &[Interval]| {
            let mut linear = linear.clone();
            linear.deviations = at.iter().zip(&linear.centre).map(|(side, c)| *side - Interval::point(*c)).collect();
            Empty { method: Method::Whole, multipliers, linear: Some(linear) }
        };
        let unknowns: Vec<usize> = (0..own.places.len()).collect();
        let programme = Programme::of(&linear.rows, &linear.deviations, &unknowns);
        for (row, place) in own.places.iter().enumerate() {
            let range = linear.range(&programme, &own.row(row)).map_err(|rows| empty(rows, &linear, at))?;
            let side = Interval::point(own.centre[*place]) + range;
            at[*place] = at[*place].intersection(side).ok_or_else(parted)?;
        }
        let error = self.setup.records.iter().fold(f64::INFINITY, |least, readings| least.min(readings.error));
        let next = own.informed(&linear, error);
        // Each new coordinate is a combination of the old ones, known to within rounding.
        let turned: Vec<Vec<Interval>> = unknowns
            .iter()
            .map(|column| {
                next.coordinates(|row| Interval::point(if row < *column { 0.0 } else { own.weight(row, *column) }))
            })
            .collect();
        let mut z = Vec::with_capacity(unknowns.len());
        for &row in &unknowns {
            let objective: Vec<(usize, f64)> =
                (0..=row).map(|column| (column, turned[column][row].midpoint())).collect();
            let range = linear.range(&programme, &objective).map_err(|rows| empty(rows, &linear, at))?;
            let rest = objective
                .iter()
                .map(|(column, weight)| (turned[*column][row] - Interval::point(*weight), own.z[*column]));
            z.push(range + Interval::dot(rest));
        }
        *frame = Some(next.moved(z));
        Ok(Some(Left::Followed { slack, widest }))
    }
}
