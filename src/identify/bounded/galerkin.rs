//! Modulating functions that fit the record: the multipliers of the linearised record's linear programme, taken back through the adjoint.
//!
//! The weak form with hats between neighbouring samples is a finite-element scheme. Solved forwards it linearises the outputs about a centre;
//! the multipliers of the few readings that bound a parameter there, solved backwards, are the K whose inequality says the
//! same over a whole box. Nothing here is trusted: an inequality holds whatever its K.

use super::contract::{Linear, Model};
use super::field::Term;
use super::lp::{Multipliers, Outcome, Programme, Rows};
use super::modulate::{Motion, Weight};
use crate::numeric::Interval;

/// The scheme of one record: samples from `first` to `last`.
struct Scheme {
    record: usize,
    first: usize,
    /// Coefficients of the sample before, the sample, and the one after, of every inner sample.
    bands: Vec<[f64; 3]>,
    /// Outputs at the centre, less the readings.
    residual: Vec<f64>,
    /// Of the outputs by each unknown.
    slopes: Vec<(usize, Vec<f64>)>,
}

impl Scheme {
    fn of(model: &Model<'_>, record: usize, span: [usize; 2], motion: &Motion, centre: &[f64], starts: usize) -> Self {
        let readings = &model.records[record];
        let (layout, [first, last]) = (model.layout, span);
        let (time, value) = (&readings.time_s[first..=last], &readings.value[first..=last]);
        let count = time.len();
        let lasted: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let drags: Vec<usize> = (0..layout.terms().len())
            .filter(|unknown| !matches!(layout.terms()[*unknown], Term::Gain | Term::LagRate))
            .collect();
        // Half of the drag per way and a quarter of the stiffness per place, between samples.
        let mut by_way = vec![0.0; count - 1];
        let mut by_place = vec![0.0; count - 1];
        for &unknown in &drags {
            for interval in 0..count - 1 {
                let (way, place) = motion.slope(unknown, first + interval);
                by_way[interval] += 0.5 * centre[unknown] * way;
                by_place[interval] += 0.25 * centre[unknown] * place;
            }
        }
        let bands: Vec<[f64; 3]> = (1..count - 1)
            .map(|k| {
                let (before, after) = (1.0 / lasted[k - 1], 1.0 / lasted[k]);
                [
                    before - by_way[k - 1] + by_place[k - 1],
                    -before - after + by_way[k - 1] - by_way[k] + by_place[k - 1] + by_place[k],
                    after + by_way[k] + by_place[k],
                ]
            })
            .collect();
        let forwards = |start: [f64; 2], load: &dyn Fn(usize) -> f64| {
            let mut x = vec![0.0; count];
            [x[0], x[1]] = start;
            for k in 1..count - 1 {
                let [a, b, c] = bands[k - 1];
                x[k + 1] = (load(k) - a * x[k - 1] - b * x[k]) / c;
            }
            x
        };
        let area = |k: usize| 0.5 * (lasted[k - 1] + lasted[k]);
        // The command weighed with every hat, and by how much a later one adds.
        let delay_s = model.layout.delay().map_or(model.known_delay_s.midpoint(), |place| centre[place]);
        let [pushes, laters] = loads(model, record, time, delay_s);
        let gain = centre[0];
        let disturbance = layout.disturbance(record);
        let term = |unknown: usize, k: usize| {
            let half = |interval: usize| {
                let (way, place) = motion.slope(unknown, first + interval);
                let moved = value[interval + 1] - value[interval];
                0.5 * (motion.whole(unknown, first + interval)
                    + way * moved
                    + 0.5 * place * (value[interval + 1] + value[interval]))
            };
            half(k - 1) + half(k)
        };
        let constant = |unknown: usize, k: usize| {
            0.5 * (motion.whole(unknown, first + k - 1) + motion.whole(unknown, first + k))
        };
        let base = forwards([value[0], value[1]], &|k| {
            let drag: f64 = drags.iter().map(|unknown| centre[*unknown] * constant(*unknown, k)).sum();
            gain * pushes[k] + centre[disturbance] * area(k) - drag
        });
        let residual = base.iter().zip(value).map(|(x, y)| x - y).collect();
        let mut slopes = vec![
            (0, forwards([0.0; 2], &|k| pushes[k])),
            (disturbance, forwards([0.0; 2], &area)),
            (starts, forwards([1.0, 0.0], &|_| 0.0)),
            (starts + 1, forwards([0.0, 1.0], &|_| 0.0)),
        ];
        slopes.extend(drags.iter().map(|unknown| (*unknown, forwards([0.0; 2], &|k| -term(*unknown, k)))));
        slopes.extend(layout.delay().map(|delay| (delay, forwards([0.0; 2], &|k| gain * laters[k]))));
        Self { record, first, bands, residual, slopes }
    }

    /// The K whose inequality weighs the readings with these factors.
    fn backwards(&self, factors: &[f64]) -> Weight {
        let count = factors.len();
        let mut nodes = vec![0.0; count];
        for k in (1..count - 1).rev() {
            // The equation of sample k + 1: what K at its later neighbours leaves.
            let mut left = factors[k + 1];
            if k + 2 < count {
                left -= self.bands[k][1] * nodes[k + 1];
            }
            if k + 3 < count {
                left -= self.bands[k + 1][0] * nodes[k + 2];
            }
            nodes[k] = left / self.bands[k - 1][2];
        }
        Weight { record: self.record, first: self.first, nodes }
    }
}

/// `int hat u` and its slope by the delay, for the hats between neighbouring samples.
fn loads(model: &Model<'_>, record: usize, time: &[f64], delay_s: f64) -> [Vec<f64>; 2] {
    let command = &model.records[record].command;
    let count = time.len();
    let (mut pushes, mut laters) = (vec![0.0; count], vec![0.0; count]);
    let instants: Vec<f64> = (0..command.edges()).map(|edge| command.span(edge).midpoint() + delay_s).collect();
    let mut edge = 0;
    for k in 0..count - 1 {
        let (from, to) = (time[k], time[k + 1]);
        while edge < instants.len() && instants[edge] <= from {
            edge += 1;
        }
        let (mut at, mut level) = (from, edge);
        loop {
            let next = instants.get(level).copied().filter(|instant| *instant < to).unwrap_or(to);
            let (middle, part) = (0.5 * (at + next), next - at);
            let share = (middle - from) / (to - from);
            pushes[k] += command.levels()[level] * part * (1.0 - share);
            pushes[k + 1] += command.levels()[level] * part * share;
            if next >= to {
                break;
            }
            let (share, drop) = ((next - from) / (to - from), command.levels()[level] - command.levels()[level + 1]);
            laters[k] += drop * (1.0 - share);
            laters[k + 1] += drop * share;
            (at, level) = (next, level + 1);
        }
    }
    [pushes, laters]
}

impl Model<'_> {
    /// Modulating functions for a box: of each of the `unknowns`, up and down, the one that bounds it best about the centre; or
    /// the one that excludes the box, if a linear programme does.
    pub(super) fn fitted(&self, motions: &[Motion], at: &[Interval], unknowns: &[usize]) -> Vec<Vec<Weight>> {
        let centre: Vec<f64> = at.iter().map(|side| side.midpoint()).collect();
        let parameters = self.layout.parameters();
        let records = self.records.len();
        let mut rows = Rows::default();
        let mut deviations: Vec<Interval> =
            (0..parameters).map(|place| at[place] - Interval::point(centre[place])).collect();
        let mut owners: Vec<(usize, usize, f64)> = Vec::new();
        let schemes: Vec<Scheme> = (0..records)
            .map(|record| {
                let windows = self.layout.windows().iter().filter(|window| window.record == record);
                let span = windows.fold([usize::MAX, 0], |[first, last], window| {
                    [first.min(window.first), last.max(window.last)]
                });
                Scheme::of(self, record, span, &motions[record], &centre, parameters + 2 * record)
            })
            .collect();
        for (number, scheme) in schemes.iter().enumerate() {
            let error = self.records[scheme.record].error;
            deviations.extend([Interval::symmetric(4.0 * error); 2]);
            for (k, residual) in scheme.residual.iter().enumerate() {
                for sign in [1.0, -1.0] {
                    let slopes = scheme.slopes.iter();
                    rows.slopes.push(slopes.map(|(place, own)| (*place, Interval::point(sign * own[k]))).collect());
                    rows.limits.push(error - sign * residual);
                    owners.push((number, k, sign));
                }
            }
        }
        let places: Vec<usize> = (0..deviations.len()).collect();
        let programme = Programme::of(&rows, &deviations, &places);
        let weights = |multipliers: &Multipliers| -> Vec<Weight> {
            let mut factors: Vec<Vec<f64>> =
                schemes.iter().map(|scheme| vec![0.0; scheme.residual.len()]).collect();
            for (row, y) in multipliers {
                let (number, k, sign) = owners[*row];
                factors[number][k] += sign * y;
            }
            let used = schemes.iter().zip(&factors).filter(|(_, factors)| factors.iter().any(|factor| *factor != 0.0));
            used.map(|(scheme, factors)| scheme.backwards(factors)).collect()
        };
        let mut fitted = Vec::new();
        for unknown in unknowns {
            for sign in [1.0, -1.0] {
                match programme.maximise(&[(*unknown, sign)]) {
                    Outcome::Empty { multipliers } => return vec![weights(&multipliers)],
                    Outcome::Bounded { multipliers, .. } => fitted.push(weights(&multipliers)),
                }
            }
        }
        fitted
    }

    /// The inequalities of modulating functions over a box, each set by itself, about the middle of the box.
    pub(super) fn modulated(&self, sets: &[Vec<Weight>], motions: &[Motion], at: &[Interval]) -> Linear {
        let centre = at.iter().map(|side| side.midpoint()).collect();
        let mut linear = self.about(at, centre);
        for (index, weight) in sets.iter().flatten().enumerate() {
            self.modulate(weight, index, at, &motions[weight.record], &mut linear);
        }
        self.bound(&mut linear);
        linear
    }
}
