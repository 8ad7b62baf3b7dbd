//! Modulating functions (Shinbrot, *Transactions of the ASME* 79, 1957; Preisig and Rippin, *Computers and Chemical Engineering* 17, 1993):
//! the weak form of the equation gives inequalities linear in the terms, over any box.
//!
//! For a hat K, 1 at a sample and falling linearly to zero at a sample on either side,
//! `int K x'' = (x_2 - x_1)/(t_2 - t_1) - (x_1 - x_0)/(t_1 - t_0)`: three readings give it to within their errors. By the equation
//! it is a combination of the terms, whose coefficients `int K` of the command, of velocities and of positions follow from the log.

mod forcing;
#[cfg(test)]
mod tests;
mod weight;

use super::linear_relaxation::{Origin, Relaxation, Support};
use super::problem::Problem;
use super::record::Readings;
use super::vector_field::{FieldTerm, cube, signed_square};
use super::velocity_bounds::Velocities;
use crate::numeric::{Interval, Real};
use forcing::Forcing;
use weight::Hat;

/// Half-widths of the hats in mean half-periods: from a fifth, in which readings tell accelerations, to two, in which drag averages.
const HALF_WIDTHS: [f64; 5] = [0.2, 0.4, 0.8, 1.4, 2.2];
/// Most hats of the same width.
const MOST_HATS: usize = 60;

/// Hats of all widths along a record, the mean half-period given.
pub(super) fn supports(time_s: &[f64], half_period_s: f64) -> Vec<Support> {
    let mut supports = Vec::new();
    let interval = (time_s[time_s.len() - 1] - time_s[0]) / (time_s.len() - 1) as f64;
    let mut before = 0;
    for width in HALF_WIDTHS {
        let half = ((width * half_period_s / interval).round() as usize).max(1);
        if half == before || 2 * half >= time_s.len() {
            continue;
        }
        before = half;
        let room = time_s.len() - 1 - 2 * half;
        let count = (2 * room / half + 1).clamp(1, MOST_HATS);
        for index in 0..count {
            let first = room * index / count.max(2).saturating_sub(1).max(1);
            supports.push([first, first + half, first + 2 * half]);
        }
    }
    supports.dedup();
    supports
}

/// A function of the velocity over a range: `slope v + constant + rest`.
struct Tangent {
    slope: f64,
    constant: Interval,
    rest: Interval,
}

impl Tangent {
    fn identity() -> Self {
        Self { slope: 1.0, constant: Interval::ZERO, rest: Interval::ZERO }
    }

    /// Of `v |v| - 2 m v`, whose second derivative is `2 sign v`.
    fn square(range: Interval, middle: f64) -> Self {
        let point = range.midpoint();
        let slope = 2.0 * (point.abs() - middle);
        let value = signed_square(Interval::point(point)) - Interval::point(2.0 * middle) * Interval::point(point);
        let sign = |possible: bool, sign: f64| Interval::point(if possible { sign } else { 0.0 });
        let signs = sign(range.lower() < 0.0, -1.0).hull(sign(range.upper() > 0.0, 1.0));
        let rest = (range - Interval::point(point)).square() * signs;
        Self { slope, constant: value - Interval::point(slope) * Interval::point(point), rest }
    }

    /// Of `v^3 = p^3 + 3 p^2 (v - p) + (v - p)^2 (v + 2 p)`.
    fn cube(range: Interval) -> Self {
        let point = range.midpoint();
        let slope = 3.0 * point * point;
        let p = Interval::point(point);
        let rest = (range - p).square() * (range + Interval::two() * p);
        Self { slope, constant: cube(p) - Interval::point(slope) * p, rest }
    }
}

/// A hat over the readings of a record.
struct Modulated<'a> {
    readings: &'a Readings,
    velocities: &'a Velocities,
    support: &'a Support,
    hat: Hat,
    /// Largest error of a reading, with that of its stamp.
    error: Interval,
}

impl Modulated<'_> {
    /// `int K f(v)`, f by a tangent in each interval between samples.
    ///
    /// `int K slope v = sum slope_i K_i (x_(i+1) - x_i)` with `K_i` the mean of K: the errors of the readings add up by the differences
    /// of successive weights. K differs from its mean by at most `|K_(i+1) - K_i|/2`, with opposite signs in its two halves.
    fn drag(&self, f: impl Fn(Interval) -> Tangent) -> Interval {
        let (time, value) = (&self.readings.time_s, &self.readings.value);
        let (mut sum, mut errors, mut before) = (Interval::ZERO, Interval::ZERO, Interval::ZERO);
        for sample in self.support[0]..self.support[2] {
            let range = self.velocities.between[sample];
            let Tangent { slope, constant, rest } = f(range);
            let slope = Interval::point(slope);
            let lasted = Interval::point(time[sample + 1]) - Interval::point(time[sample]);
            let (here, next) = (self.hat.height_at(time[sample]), self.hat.height_at(time[sample + 1]));
            let height = Interval::point(0.5) * (here + next);
            let way = Interval::point(value[sample + 1]) - Interval::point(value[sample]);
            let off = Interval::point(0.25) * (here - next).abs() * lasted;
            let weight = slope * height;
            sum += weight * way + slope * off * Interval::symmetric(range.radius());
            sum += height * lasted * (constant + rest);
            sum += off * Interval::symmetric(rest.radius());
            errors += (weight - before).abs();
            before = weight;
        }
        errors += before.abs();
        sum + Interval::symmetric((self.error * errors).upper())
    }

    /// `int K x`: between two samples the output is off the chord by at most half the width of its velocities times the time.
    fn position(&self) -> Interval {
        let (time, value) = (&self.readings.time_s, &self.readings.value);
        let half = Interval::point(0.5);
        let mut sum = Interval::ZERO;
        for sample in self.support[0]..self.support[2] {
            let lasted = Interval::point(time[sample + 1]) - Interval::point(time[sample]);
            let (here, next) = (self.hat.height_at(time[sample]), self.hat.height_at(time[sample + 1]));
            let (a, b) = (Interval::point(value[sample]), Interval::point(value[sample + 1]));
            let bulge = half * Interval::point(self.velocities.between[sample].radius()) * lasted;
            let near = self.error + bulge;
            let off = Interval::point(0.25) * (here - next).abs() * lasted;
            sum += half * (here + next) * lasted * (half * (a + b) + Interval::symmetric(near.upper()));
            sum += off * Interval::symmetric((half * (b - a).abs() + near).upper());
        }
        sum
    }
}

impl Problem {
    /// Adds the inequalities of hats of a record over a box, in which the velocities are enclosed.
    pub(super) fn add_weak_form(
        &self,
        record: usize,
        supports: &[Support],
        at: &[Interval],
        velocities: &Velocities,
        relaxation: &mut Relaxation,
    ) {
        let readings = &self.records[record];
        let delay_s = self.delay_s(at);
        let stray = Interval::point(readings.jitter_s) * Interval::point(velocities.fastest());
        let error = Interval::point(readings.error) + stray;
        let rate = self.unknowns.place_of(FieldTerm::LagRate).map(|place| at[place]);
        // Before the first known velocity a command may act that is not in the log.
        for support in supports.iter().filter(|support| support[0] >= velocities.known) {
            let hat = Hat::of(support.map(|sample| readings.time_s[sample]));
            let modulated = Modulated { readings, velocities, support, hat, error };
            let hat = &modulated.hat;
            let y = support.map(|sample| Interval::point(readings.value[sample]));
            let second = (y[2] - y[1]) / hat.right() - (y[1] - y[0]) / hat.left();
            let share = Interval::ONE / hat.right() + Interval::ONE / hat.left();
            let Forcing { force, by_delay } = match rate {
                Some(rate) => self.lagged_forcing(record, hat, delay_s, rate),
                None => self.forcing(record, hat, delay_s),
            };
            let mut coefficients: Vec<(usize, Interval)> = Vec::new();
            for (unknown, term) in self.unknowns.terms.iter().enumerate() {
                let coefficient = match term {
                    FieldTerm::Gain => force,
                    FieldTerm::Linear => -modulated.drag(|_| Tangent::identity()),
                    FieldTerm::Quadratic => -modulated.drag(|range| Tangent::square(range, self.middle_speed)),
                    FieldTerm::Cubic => -modulated.drag(Tangent::cube),
                    FieldTerm::Stiffness => -modulated.position(),
                    FieldTerm::LagRate | FieldTerm::Disturbance => continue,
                };
                coefficients.push((unknown, coefficient));
            }
            // The force is that at the middle of the delay, hence the centre of the relaxation.
            coefficients.extend(self.unknowns.delay().map(|delay| (delay, at[0] * by_delay)));
            coefficients.push((self.unknowns.disturbance(record), hat.area()));
            let error = Interval::two() * error * share;
            let origin = |above| Origin::Modulated { record, samples: *support, above };
            relaxation.add_pair(coefficients.into_iter(), -second, error, origin);
        }
    }

    /// Velocities from the readings, those at the beginnings of shooting intervals intersected with the box; then the weak form. `None`
    /// where the box holds no motion.
    pub(super) fn modulate(&self, supports: &[Vec<Support>], at: &mut [Interval]) -> Option<Relaxation> {
        let mut centre = vec![0.0; at.len()];
        if let Some(place) = self.unknowns.delay() {
            centre[place] = at[place].midpoint();
        }
        let mut relaxation = self.about(at, centre);
        for (record, supports) in supports.iter().enumerate() {
            let velocities = self.velocities(record, at)?;
            for (index, interval) in self.followed().filter(|(_, own)| own.record == record) {
                let place = self.unknowns.start(index, 1);
                at[place] = at[place].intersection(velocities.at_samples[interval.first])?;
            }
            self.add_weak_form(record, supports, at, &velocities, &mut relaxation);
        }
        self.add_prior(&mut relaxation);
        Some(relaxation)
    }
}
