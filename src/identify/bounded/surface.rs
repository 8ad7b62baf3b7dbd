//! What the readings are over a slanted box, to the second order: a motion is followed once, and parts of the box are contracted by
//! what is known of it, about a centre of their own.

use super::bend::{pairs, product_of};
use super::contract::{Linear, Model, Origin};
use super::frame::Frame;
use crate::numeric::Interval;

#[cfg(test)]
mod tests;

/// With more pairs of unknowns a motion to the second order costs more than it saves.
const MOST_PAIRS: usize = 200;
/// Share of its error up to which a reading is met so well that it tells nothing.
const PRUNED: f64 = 0.9;

/// One reading: what the output is off it, and by how much it may be.
#[derive(Clone, Debug)]
struct Off {
    window: usize,
    sample: usize,
    error: Interval,
    at_centre: Interval,
    slopes: Vec<Interval>,
    /// By each pair of coordinates.
    bends: Vec<Interval>,
    /// Of the third order.
    rest: Interval,
}

/// The readings of one record, and the pairs of coordinates that move it.
#[derive(Clone, Debug)]
struct Sheet {
    pairs: Vec<[usize; 2]>,
    readings: Vec<Off>,
}

/// Readings by the coordinates of a frame: `at_centre + sum slopes_i z_i + sum bends_ij z_i z_j + rest`, of squares the half.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    sheets: Vec<Sheet>,
    /// What the search box says besides.
    sides: Linear,
    /// The largest share of a reading's error that is of the third order.
    pub(super) rest: f64,
}

/// How far from straight the readings are over a box: the largest share of an error that is in doubt of one by itself, and the
/// coordinate most of it is due to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Doubt {
    pub(super) slack: f64,
    pub(super) widest: usize,
}

impl Model<'_> {
    /// Whole records in a frame. `None` where there is no enclosure, or too many unknowns for one of the second order.
    pub(super) fn surface(&self, at: &[Interval], frame: &Frame) -> Option<Surface> {
        let (mut sheets, mut rest) = (Vec::new(), 0.0f64);
        for span in self.whole() {
            let mixes = frame.mixes(self.layout, span.from);
            let pairs = pairs(&mixes);
            if pairs.len() > MOST_PAIRS {
                return None;
            }
            let motion = self.slanted(span, at, frame, &mixes)?;
            let record = self.layout.windows()[span.from].record;
            let (readings, samples) = (&self.records[record], self.samples(span));
            let readings = motion.iter().zip(&samples).enumerate().map(|(offset, (node, &sample))| {
                let error = self.allowed(record, &motion, &samples, offset);
                rest = rest.max((node.rest / error).magnitude());
                Off {
                    window: span.from,
                    sample,
                    error,
                    at_centre: node.at[0] - Interval::point(readings.value[sample]),
                    slopes: node.slopes.iter().map(|slope| slope[0]).collect(),
                    bends: node.bends.iter().flat_map(|bend| bend.intervals()).take(pairs.len()).collect(),
                    rest: node.rest,
                }
            });
            let readings = readings.collect();
            sheets.push(Sheet { pairs, readings });
        }
        Some(Surface { sheets, sides: frame.sides(self, at), rest })
    }
}

impl Surface {
    /// Leaves out readings that are met everywhere in the box, with some room.
    pub(super) fn prune(&mut self, z: &[Interval]) {
        for Sheet { pairs, readings } in &mut self.sheets {
            let products = products(pairs, z);
            readings.retain(|off| {
                let first = Interval::dot(off.slopes.iter().copied().zip(z.iter().copied()));
                let second = Interval::dot(off.bends.iter().copied().zip(products.iter().copied()));
                (off.at_centre + first + second + off.rest).magnitude() > PRUNED * off.error.lower()
            });
        }
    }

    /// The readings as inequalities over a part of the box, about its middle, `active` ones alone or all; `centre` is that of the frame.
    /// Behind the coordinates stand products of two, as unknowns of their own: what bends several readings alike is weighed against
    /// itself.
    pub(super) fn over(&self, z: &[Interval], centre: &[f64], active: bool) -> (Linear, Doubt) {
        let middle: Vec<Interval> = z.iter().map(|side| Interval::point(side.midpoint())).collect();
        let deviations: Vec<Interval> = z.iter().zip(&middle).map(|(side, middle)| *side - *middle).collect();
        let effort = self.sides.effort.clone();
        let mut linear =
            Linear { effort, centre: centre.to_vec(), deviations: deviations.clone(), ..Linear::default() };
        let (mut slack, mut by) = (0.0f64, vec![0.0; z.len()]);
        for Sheet { pairs, readings } in &self.sheets {
            let products = products(pairs, &deviations);
            let behind = linear.deviations.len();
            linear.deviations.extend(&products);
            for off in readings {
                let mut bent = vec![Interval::ZERO; z.len()];
                for ([i, j], bend) in pairs.iter().zip(&off.bends) {
                    bent[*i] += *bend * middle[*j];
                    if i != j {
                        bent[*j] += *bend * middle[*i];
                    }
                }
                let half = Interval::point(0.5);
                let first =
                    off.slopes.iter().zip(&bent).zip(&middle).map(|((slope, bent), z)| (*slope + half * *bent, *z));
                let there = off.at_centre + Interval::dot(first);
                let slopes: Vec<Interval> = off.slopes.iter().zip(&bent).map(|(slope, bent)| *slope + *bent).collect();
                let mut second = Interval::ZERO;
                let error = off.error.lower();
                for (([i, j], bend), product) in pairs.iter().zip(&off.bends).zip(&products) {
                    let part = *bend * *product;
                    second += part;
                    by[*i] += 0.5 * part.magnitude() / error;
                    by[*j] += 0.5 * part.magnitude() / error;
                }
                let unsure =
                    slopes.iter().zip(&deviations).map(|(slope, z)| slope.radius() * z.magnitude()).sum::<f64>();
                slack = slack.max((unsure + second.radius() + off.rest.magnitude()) / error);
                let residual = there + off.rest;
                let first = Interval::dot(slopes.iter().copied().zip(deviations.iter().copied()));
                if active && (residual + first + second).magnitude() <= error {
                    continue;
                }
                let (window, sample) = (off.window, off.sample);
                let bends = off.bends.iter().enumerate().map(|(pair, bend)| (behind + pair, *bend));
                linear.pair(slopes.iter().copied().enumerate().chain(bends), residual, off.error, |above| {
                    Origin::Reading { window, sample, above }
                });
            }
        }
        for ((slopes, limit), origin) in
            self.sides.rows.slopes.iter().zip(&self.sides.rows.limits).zip(&self.sides.origins)
        {
            let there = slopes.iter().fold(Interval::point(*limit), |limit, (j, slope)| limit - *slope * middle[*j]);
            linear.rows.slopes.push(slopes.clone());
            linear.rows.limits.push(there.upper());
            linear.origins.push(*origin);
        }
        let widest = (0..by.len()).max_by(|a, b| by[*a].total_cmp(&by[*b])).unwrap_or(0);
        (linear, Doubt { slack, widest })
    }
}

fn products(pairs: &[[usize; 2]], z: &[Interval]) -> Vec<Interval> {
    pairs.iter().map(|pair| product_of(*pair, z)).collect()
}
