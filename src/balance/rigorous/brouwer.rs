//! The proof: a box of frequency and harmonics that is mapped into itself and hence holds an oscillation (Brouwer).
//!
//! Let `x = u + v`, u the harmonics up to K, odd or all, v the rest, and `c`, `r` the middle and half the range of the
//! slopes. Where `rho = inf over k > K of abs(g_k + c)` exceeds `r`, the equations above K are a contraction of ratio
//! `r/rho` in v, so v is unique, continuous in frequency and u, and
//! `norm(v) <= eta = (T_0 + (r/rho) norm(h))/(1 - r/rho)` for `u = u_0 + h` (Mees and Bergen 1975). The equations up to
//! K are `E(u) + [N(u + v) - N(u)]`. A preconditioner B and the mean value form in frequency map the box of radii R
//! into itself if in every row `abs(B E) + abs(1 - B J) R + norm2(B_i) sqrt 2 (r eta + e) <= R`.

use nalgebra::{DMatrix, DVector};

use super::characteristic::OddCharacteristic;
use super::closed_loop::LipschitzLoop;
use super::error::CannotTell;
use super::spectrum::{EnclosedSpectrum, enclose};
use super::wave::{HarmonicOrders, Wave, length, natural};
use crate::numeric::{Interval, Real};

/// Share by which the range of the slopes reaches beyond the centre's own, where they are bounded on the range alone.
const BEYOND: f64 = 1.01;

/// Everything about a centre that does not depend on how the radii are compared.
pub(super) struct LinearisedBalance {
    spectrum: EnclosedSpectrum,
    /// `abs(B E)` and `norm2(B_i) sqrt 2`, row by row, at most.
    error: Vec<Interval>,
    gain: Vec<Interval>,
    /// `abs(1 - B J)` at most, J over all frequencies of the box.
    excess: DMatrix<f64>,
    high: High,
}

/// The harmonics above K.
struct High {
    /// Half the range of the slopes, and `inf abs(g_k + c)`.
    slope_radius: Interval,
    rho: Interval,
    /// `sqrt(1/2 sum abs(N_k)^2/abs(g_k + c)^2)`, and without the divisor.
    first: Interval,
    output: Interval,
    /// `sqrt(sum 1/abs(g_k + c)^2)`.
    gain: Interval,
    /// Where the slopes are bounded on a range alone: the range and the largest `abs(u_0)`.
    range: Option<(f64, Interval)>,
}

fn point(value: f64) -> Interval {
    Interval::point(value)
}

/// Upper bounds of `sup abs(h)` and `norm(h)` over a box of radii of frequency and harmonics.
fn sizes(orders: HarmonicOrders, radii: &DVector<f64>) -> (Interval, Interval) {
    let pairs = orders.pairs(&radii.as_slice()[1..]);
    let each: Vec<Interval> = pairs.into_iter().map(|pair| length(pair.into_iter().map(point))).collect();
    let sum = each.iter().fold(Interval::ZERO, |sum, &one| sum + one);
    // Half the square of an amplitude, but all of a mean's.
    let mean = orders.place(0).map(|place| each[place]);
    (sum, length(each.into_iter().chain(mean)) * point(0.5).sqrt())
}

impl LipschitzLoop<'_> {
    /// Upper bound of the wave's magnitude: at a maximum the derivative vanishes: a sample within `d` of it is below by
    /// at most `bend d^2/2`.
    fn peak(&self, centre: &Wave) -> Interval {
        const SAMPLES: u32 = 1024;
        let step = centre.orders.span() / point(f64::from(SAMPLES));
        let values = (0..SAMPLES).map(|i| centre.at(step * point(f64::from(i))).0.abs());
        let most = values.reduce(Real::max).unwrap_or(Interval::ZERO);
        most + centre.sum_of_magnitudes(2) * step.square() * point(0.125)
    }

    /// The equations at a centre, linearised over the box's frequencies; kinks are passed with the box's margin.
    pub(super) fn linearise(&self, centre: &Wave, radii: &DVector<f64>) -> Result<LinearisedBalance, CannotTell> {
        let omega = point(centre.omega_rad_s) + Interval::symmetric(radii[0]);
        let range = matches!(self.characteristic, OddCharacteristic::Polynomial { .. }).then(|| {
            let peak = self.peak(centre);
            (BEYOND * peak.upper(), peak)
        });
        let reach = range.map_or(f64::INFINITY, |(limit, _)| limit);
        let (margin, _) = sizes(centre.orders, radii);
        let spectrum = enclose(&self.characteristic, centre, reach, margin.upper())?;
        let harmonics = &spectrum.harmonics;
        let error = self.residual(point(centre.omega_rad_s), centre, harmonics);
        let slopes = self.jacobian(omega, centre, harmonics);
        let no_inverse = CannotTell::NoContraction { ratio: f64::INFINITY };
        let preconditioner = slopes.map(Interval::midpoint).try_inverse().ok_or(no_inverse)?;
        let high = self.high(centre, omega, &spectrum, range)?;

        // In columns, for speed.
        let rows = preconditioner.transpose().map(point);
        let size = rows.ncols();
        let times = |i: usize, column: &[Interval]| {
            Interval::dot(rows.column(i).as_slice().iter().copied().zip(column.iter().copied()))
        };
        let excess = DMatrix::from_fn(size, size, |i, j| {
            let one = if i == j { Interval::ONE } else { Interval::ZERO };
            (one - times(i, slopes.column(j).as_slice())).magnitude()
        });
        let gain = rows.column_iter().map(|row| length(row.iter().copied()) * point(2.0).sqrt()).collect();
        let error = (0..size).map(|i| times(i, error.as_slice()).abs()).collect();
        Ok(LinearisedBalance { spectrum, error, gain, excess, high })
    }

    /// Bounds of the harmonics above the wave's, over all frequencies of the box.
    fn high(
        &self,
        centre: &Wave,
        omega: Interval,
        spectrum: &EnclosedSpectrum,
        range: Option<(f64, Interval)>,
    ) -> Result<High, CannotTell> {
        let slopes = self.characteristic.slopes(range.map_or(f64::INFINITY, |(limit, _)| limit));
        let middle = (point(slopes.lower()) + point(slopes.upper())) * point(0.5);
        let slope_radius = (point(slopes.upper()) - point(slopes.lower())) * point(0.5);
        let orders = centre.orders;
        let outputs = &spectrum.harmonics.output;
        let last = orders.at(outputs.len() - 1);
        // Listed harmonics, each by itself.
        let mut rho = f64::INFINITY;
        let (mut first, mut output, mut gain) = (Interval::ZERO, Interval::ZERO, Interval::ZERO);
        for (place, harmonic) in outputs.iter().enumerate().skip(centre.harmonics.len()) {
            let mut distance = self.inverse_response(omega, orders.at(place)).0;
            distance.re += middle;
            let square = distance.square_norm();
            let size = harmonic.square_norm() * point(0.5);
            rho = rho.min(square.sqrt().lower());
            first += size / square;
            output += size;
            gain += Interval::ONE / square;
        }
        // From the next on, abs(g_k + c) >= growth (k w)^q - abs(c) >= tail (k w)^q.
        let degree = self.relative_degree();
        let power = |y: Interval| (0..degree).fold(Interval::ONE, |product, _| product * y);
        let from = omega * natural(last + orders.step());
        let nearest = point(from.lower());
        let tail = self.growth(nearest) - middle.abs() / power(nearest);
        let far = tail * power(nearest);
        rho = rho.min(far.lower());
        // Only if it is positive the bounds below mean anything.
        if !(rho > slope_radius.upper() && tail.is_positive() && omega.is_positive()) {
            return Err(CannotTell::Rho { rho, slope_radius: slope_radius.upper() });
        }
        first += (spectrum.rest / far).square();
        output += spectrum.rest.square();
        // sum over k > M in steps of s of k^(-2 q) <= M^(1 - 2 q)/(s (2 q - 1)).
        let listed = natural(last);
        let sum = listed / (power(listed).square() * natural(2 * degree - 1) * natural(orders.step()));
        gain += sum / (tail * power(point(omega.lower()))).square();
        Ok(High { slope_radius, rho: point(rho), first: first.sqrt(), output: output.sqrt(), gain: gain.sqrt(), range })
    }

    /// Upper bound of the input's magnitude on every oscillation that a box was shown to hold.
    pub(super) fn largest_input(&self, centre: &Wave, radii: &DVector<f64>) -> Result<f64, CannotTell> {
        let linearised = self.linearise(centre, radii)?;
        let (_, eta) = linearised.images(radii);
        Ok(linearised.reach(self.peak(centre), radii, eta))
    }

    /// Whether every frequency and wave of the box is mapped into the box: then an upper bound of the root mean square of the
    /// harmonics above K.
    pub(super) fn holds(&self, centre: &Wave, radii: &DVector<f64>) -> Result<f64, CannotTell> {
        let linearised = self.linearise(centre, radii)?;
        let (images, eta) = linearised.images(radii);
        let ratios = images.iter().zip(radii).map(|(image, radius)| image / radius);
        let ratio = ratios.fold(0.0, |most: f64, one| if one.is_nan() { f64::INFINITY } else { most.max(one) });
        // Strictly: B J, hence B, is invertible and a fixed point solves the equations.
        if !(ratio < 1.0) {
            return Err(CannotTell::NoContraction { ratio });
        }
        if let Some((limit, peak)) = linearised.high.range {
            let reach = linearised.reach(peak, radii, eta);
            if !(reach <= limit) {
                return Err(CannotTell::Range { reach, limit });
            }
        }
        Ok(eta.upper())
    }
}

impl LinearisedBalance {
    /// Upper bound of the input's magnitude: `sup abs(v) <= sum abs(v_k) <= gain sqrt(sum abs(M_k)^2)`, M the output less c x.
    fn reach(&self, peak: Interval, radii: &DVector<f64>, eta: Interval) -> f64 {
        let (delta, norm) = sizes(self.spectrum.harmonics.orders, radii);
        let outputs = self.high.output + self.high.slope_radius * (norm + eta);
        (peak + delta + self.high.gain * outputs * point(2.0).sqrt()).upper()
    }

    /// Radii of the image of a box, at most, and the bound `eta` of the harmonics above.
    pub(super) fn images(&self, radii: &DVector<f64>) -> (Vec<f64>, Interval) {
        let (delta, norm) = sizes(self.spectrum.harmonics.orders, radii);
        let ratio = self.high.slope_radius / self.high.rho;
        let eta = (self.high.first + ratio * norm) / (Interval::ONE - ratio);
        let rest = self.high.slope_radius * eta + self.spectrum.remainder(delta);
        let radii: Vec<Interval> = radii.iter().map(|&radius| point(radius)).collect();
        let image = |i: usize| {
            let excess = self.excess.row(i);
            let linear = Interval::dot(excess.iter().map(|&entry| point(entry)).zip(radii.iter().copied()));
            (self.error[i] + linear + self.gain[i] * rest).upper()
        };
        ((0..radii.len()).map(image).collect(), eta)
    }
}
