//! Harmonics of the characteristic's output `n(u)` and slope `n'(u)` along a wave.
//!
//! `n(u) = Re sum of N_k exp(jk theta)`, `n'(u) = sum of D_m exp(jm theta)`, `D_(-m)` conjugate to `D_m`; of a wave of odd orders k is
//! odd and m even.

use super::characteristic::OddCharacteristic;
use super::error::CannotTell;
use super::wave::{HarmonicOrders, KinkPassage, Wave, length, natural};
use crate::numeric::{Complex, Interval, Real};

/// Harmonics of output and slope.
#[derive(Clone, Debug)]
pub(super) struct Spectrum<T> {
    /// Those of the wave, and of the output.
    pub(super) orders: HarmonicOrders,
    /// N_k by growing order.
    pub(super) output: Vec<Complex<T>>,
    /// D_m from the mean on, by the same steps of the order.
    pub(super) slope: Vec<Complex<T>>,
}

/// A spectrum enclosed, with further bounds for the proof.
#[derive(Clone, Debug)]
pub(super) struct EnclosedSpectrum {
    pub(super) harmonics: Spectrum<Interval>,
    /// Upper bound of `sqrt(1/2 sum abs(N_k)^2)` over the harmonics that are not listed.
    pub(super) rest: Interval,
    /// Upper bound of `sum J^2/(3 pi m)` over the kinks passed in a turn, slope jump J at speed m: `e = sqrt(that delta^3)`.
    kinks: Interval,
    /// Upper bound of `abs(n'')/2` on the range: `e = that delta^2`.
    half_curvature: Interval,
}

impl EnclosedSpectrum {
    /// Upper bound of the root mean square of `n(u + h) - n(u) - n'(u) h` for `abs(h) <= delta`.
    ///
    /// Where `n` is smooth, Taylor's remainder. A kink of slope jump J adds at most `J (delta - abs(u - kink))`, and only within
    /// delta of it, which a wave of speed m or more passes: `integral of (delta - abs(s))^2 ds/m = 2 delta^3/(3 m)`.
    pub(super) fn remainder(&self, delta: Interval) -> Interval {
        let cube = delta * delta.square();
        (self.kinks * cube).sqrt() + self.half_curvature * delta.square()
    }
}

impl<T: Real> Spectrum<T> {
    /// D_m for m of either sign.
    pub(super) fn slope_at(&self, m: isize) -> Complex<T> {
        let found = self.slope.get(m.unsigned_abs() / self.orders.step()).copied().unwrap_or_else(Complex::zero);
        if m < 0 { found.conjugate() } else { found }
    }

    /// By the trapezoid rule: from `samples` phases of a turn, a multiple of four, of which the span's suffice. Its
    /// error are the harmonics of the orders `k + j samples`.
    pub(super) fn sampled(
        wave: &Wave,
        output_and_slope: impl Fn(T) -> (T, T),
        samples: usize,
        output_last: usize,
        slope_last: usize,
    ) -> Self {
        let step = T::two() * T::pi() / T::from_f64(samples as f64);
        let turns: Vec<Complex<T>> = (0..samples).map(|j| Complex::turn(step * T::from_f64(j as f64))).collect();
        let harmonics: Vec<(usize, Complex<T>)> = wave.terms().collect();
        let orders = wave.orders;
        let input = |j: usize| {
            harmonics.iter().fold(T::zero(), |sum, &(k, harmonic)| {
                let turn = turns[k * j % samples];
                sum + harmonic.re * turn.re - harmonic.im * turn.im
            })
        };
        let values: Vec<(T, T)> = (0..samples / orders.step()).map(|j| output_and_slope(input(j))).collect();
        let sum = |order: usize, of: fn(&(T, T)) -> T, factor: f64| {
            let sum = values.iter().enumerate().fold(Complex::zero(), |sum, (j, value)| {
                sum + turns[order * j % samples].conjugate().scaled(of(value))
            });
            sum.scaled(T::from_f64(factor / values.len() as f64))
        };
        let output = |k| sum(k, |value| value.0, if k == 0 { 1.0 } else { 2.0 });
        Self {
            orders,
            output: (orders.first()..=output_last).step_by(orders.step()).map(output).collect(),
            slope: (0..=slope_last).step_by(orders.step()).map(|m| sum(m, |value| value.1, 1.0)).collect(),
        }
    }
}

/// Encloses the spectrum of a characteristic along a wave whose magnitude stays below `reach`; passages of kinks keep `margin`.
pub(super) fn enclose(
    characteristic: &OddCharacteristic,
    wave: &Wave,
    reach: f64,
    margin: f64,
) -> Result<EnclosedSpectrum, CannotTell> {
    let Some((kinks, slopes)) = characteristic.kinks() else {
        return smooth(characteristic, wave, reach).ok_or(CannotTell::Range { reach, limit: 0.0 });
    };
    let gaps = kinks.windows(2).map(|pair| pair[1] - pair[0]).chain(kinks.first().map(|kink| 2.0 * kink));
    if gaps.fold(f64::INFINITY, f64::min) <= 2.0 * margin {
        return Err(CannotTell::Grazing { theta_rad: 0.0 });
    }
    let (passages, start) = wave.passages(kinks, slopes, margin)?;
    Ok(between_kinks(kinks, slopes, wave, &passages, start))
}

/// Output harmonics beyond the wave's own that are listed, as a multiple of its highest.
const LISTED: usize = 4;

/// Exact but for the phases of the passages: `n'(u)` is constant between them, and `n(u)' = n'(u) u'`.
fn between_kinks(
    kinks: &[f64],
    slopes: &[f64],
    wave: &Wave,
    passages: &[KinkPassage],
    start: Interval,
) -> EnclosedSpectrum {
    let (highest, orders) = (wave.highest(), wave.orders);
    let last = LISTED * highest + 101;
    let per_span = Interval::ONE / orders.span();
    let over_passages =
        |of: &dyn Fn(&KinkPassage) -> Interval| passages.iter().fold(Interval::ZERO, |sum, passage| sum + of(passage));
    // Over a span P from s on: integral of n' = P n'(s) - sum of jump theta, as n' is the same at both ends.
    let inside = kinks.iter().filter(|&&kink| start.abs().lower() > kink).count();
    let mean = Interval::point(slopes[inside]) - over_passages(&|at| at.jump * at.theta) * per_span;
    let slope_harmonic = |m: usize| {
        if m == 0 {
            return Complex::new(mean, Interval::ZERO);
        }
        let order = natural(m);
        let sum = passages
            .iter()
            .fold(Complex::zero(), |sum, at| sum + Complex::turn(at.theta * order).conjugate().scaled(at.jump));
        // Over j m P.
        -sum.times_j().scaled(per_span / order)
    };
    let slope = (0..=last + highest).step_by(orders.step()).map(slope_harmonic).collect();
    let mut harmonics = Spectrum { orders, output: Vec::new(), slope };
    let rates: Vec<(isize, Complex<Interval>)> =
        wave.terms().map(|(l, harmonic)| (l as isize, harmonic.scaled(natural(l)))).collect();
    // Mean of n(u) over a turn. Between kinks n(u) = slope u + offset; where a level is passed the slope jumps, and the offset by
    // -jump level. With U the antiderivative of u less its mean, and the offset where the turn begins,
    // mean n = mean n' mean u + offset + sum of jump (level theta - U(theta))/(2 pi).
    let mean_output = || {
        let antiderivative = |theta: Interval| {
            wave.terms().skip(1).fold(Interval::ZERO, |sum, (k, harmonic): (_, Complex<Interval>)| {
                let order = natural(k);
                sum + (harmonic * Complex::turn(theta * order)).im / order
            })
        };
        let jumps = over_passages(&|at| at.jump * (Interval::point(at.level) * at.theta - antiderivative(at.theta)));
        let outwards = kinks.iter().zip(slopes.windows(2)).take(inside).fold(Interval::ZERO, |sum, (&kink, pair)| {
            sum - (Interval::point(pair[1]) - Interval::point(pair[0])) * Interval::point(kink)
        });
        let offset = if start.is_negative() { -outwards } else { outwards };
        mean * Interval::point(wave.harmonics[0][0]) + offset + jumps * Interval::INVERSE_PI * Interval::point(0.5)
    };
    // k N_k = sum over l of l (D_(k-l) X_l - D_(k+l) conj X_l), but for the mean.
    let output_harmonic = |k: usize| {
        if k == 0 {
            return Complex::new(mean_output(), Interval::ZERO);
        }
        let sum = rates.iter().fold(Complex::zero(), |sum, &(l, rate)| {
            sum + harmonics.slope_at(k as isize - l) * rate - harmonics.slope_at(k as isize + l) * rate.conjugate()
        });
        sum.scaled(Interval::ONE / natural(k))
    };
    harmonics.output = (orders.first()..=last).step_by(orders.step()).map(output_harmonic).collect();

    // abs(N_k) <= V/(pi k^2) with V the variation of n(u)' over a turn; sum over k > K in steps of s of k^-4 <= 1/(3 s K^3).
    let step = natural(orders.step());
    let steepest = slopes.iter().map(|slope| slope.abs()).fold(0.0, f64::max);
    let bend = length(wave.terms().map(|(k, harmonic)| harmonic.norm() * natural(k * k))) * Interval::point(0.5).sqrt();
    let between = Interval::point(steepest) * bend * Interval::PI * Interval::point(2.0);
    let variation = between + over_passages(&|at| (at.jump * wave.at(at.theta).1).abs() * step);
    let cubes = Interval::point(6.0) * step * natural(last) * natural(last).square();
    EnclosedSpectrum {
        harmonics,
        rest: variation * Interval::INVERSE_PI / cubes.sqrt(),
        kinks: over_passages(&|at| step * at.jump.square() / (Interval::point(3.0) * Interval::PI * at.speed)),
        half_curvature: Interval::ZERO,
    }
}

/// Samples of a turn, as powers of two, fewest and most.
const SAMPLES: core::ops::RangeInclusive<u32> = 8..=14;

/// The trapezoid rule; a strip around the real phases on which output and slope are bounded bounds its error.
fn smooth(characteristic: &OddCharacteristic, wave: &Wave, reach: f64) -> Option<EnclosedSpectrum> {
    let (highest, step) = (wave.highest(), wave.orders.step());
    let widths = (0..60).map(|i| 4.0 * 0.85f64.powi(i));
    let strips: Vec<Strip> = widths.filter_map(|width| Strip::new(characteristic, wave, width)).collect();
    let by_rest =
        |last: usize| strips.iter().min_by(|a, b| a.rest(last, step).upper().total_cmp(&b.rest(last, step).upper()));
    // Odd.
    let last_of = |power: u32| (1 << power) / 4 - 1;
    let enough = |power: &u32| {
        let last = last_of(*power);
        last > 2 * highest && by_rest(last).is_some_and(|strip| strip.decay(last) < 1e-17)
    };
    let power = SAMPLES.into_iter().find(enough).unwrap_or(*SAMPLES.end());
    let (samples, last) = (1 << power, last_of(power));
    let strip = by_rest(last)?;
    let mut harmonics = Spectrum::sampled(wave, |x| characteristic.smooth(x), samples, last, 2 * highest);
    // The sampled N_k contains also N_(k + j samples), and D_m likewise.
    let missed = |bound: Interval, order: usize| {
        let far = strip.power(samples - order) * Interval::point(2.0) / (Interval::ONE - strip.power(samples));
        let missed = Interval::symmetric((bound * far).upper());
        Complex::new(missed, missed)
    };
    for (index, harmonic) in harmonics.output.iter_mut().enumerate() {
        *harmonic = *harmonic + missed(strip.output * Interval::point(2.0), wave.orders.at(index));
    }
    for (index, harmonic) in harmonics.slope.iter_mut().enumerate() {
        *harmonic = *harmonic + missed(strip.slope, step * index);
    }
    Some(EnclosedSpectrum {
        harmonics,
        rest: strip.rest(last, step),
        kinks: Interval::ZERO,
        half_curvature: characteristic.half_curvature(reach),
    })
}

/// A strip of phases of imaginary part up to `width` in magnitude: `abs(N_k) <= 2 output exp(-k width)`, `abs(D_m) <= slope
/// exp(-m width)` by a shift of the path of integration.
struct Strip {
    width: Interval,
    output: Interval,
    slope: Interval,
}

impl Strip {
    fn new(characteristic: &OddCharacteristic, wave: &Wave, width: f64) -> Option<Self> {
        let width = Interval::point(width);
        let (imaginary, real) = wave.strip(width);
        let (output, slope) = characteristic.complex_bounds(real, imaginary)?;
        (output.is_bounded() && slope.is_bounded()).then_some(Self { width, output, slope })
    }

    /// `exp(-order width)`.
    fn power(&self, order: usize) -> Interval {
        (-self.width * natural(order)).exp()
    }

    /// Size of a harmonic relative to the whole.
    fn decay(&self, order: usize) -> f64 {
        (self.power(order) * self.output).upper()
    }

    /// `1/2 sum over k > last of (2 output exp(-k width))^2` in steps of k, its root.
    fn rest(&self, last: usize, step: usize) -> Interval {
        let geometric = Interval::ONE - self.power(2 * step);
        self.output * self.power(last + step) * (Interval::point(2.0) / geometric).sqrt()
    }
}
