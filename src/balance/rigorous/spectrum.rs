//! Harmonics of the characteristic's output `n(u)` and slope `n'(u)` along a wave.
//!
//! `n(u) = Re sum of N_k exp(jk theta)`, `n'(u) = sum of D_m exp(jm theta)`, `D_(-m)` conjugate to `D_m`; of a wave of odd orders k is
//! odd and m even.

use super::characteristic::OddCharacteristic;
use super::error::CannotTell;
use super::wave::{HarmonicOrders, KinkPassage, KinkPassages, Wave};
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
    curvature: Interval,
}

impl EnclosedSpectrum {
    /// Upper bound of the root mean square of `n(u + h) - n(u) - n'(u) h` for `abs(h) <= delta`.
    ///
    /// Where `n` is smooth, Taylor's remainder. A kink of slope jump J adds at most `J (delta - abs(u - kink))`, and only within
    /// delta of it, which a wave of speed m or more passes: `integral of (delta - abs(s))^2 ds/m = 2 delta^3/(3 m)`.
    pub(super) fn remainder(&self, delta: Interval) -> Interval {
        let cube = delta * delta.square();
        (self.kinks * cube).sqrt() + self.curvature * delta.square()
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
        let harmonics: Vec<(usize, T, T)> =
            wave.terms().map(|(k, harmonic)| (k, T::from_f64(harmonic.re), T::from_f64(harmonic.im))).collect();
        let orders = wave.orders;
        let values: Vec<(T, T)> = (0..samples / orders.step())
            .map(|j| {
                let input = harmonics.iter().fold(T::zero(), |sum, &(k, re, im)| {
                    let turn = turns[k * j % samples];
                    sum + re * turn.re - im * turn.im
                });
                output_and_slope(input)
            })
            .collect();
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
    match characteristic.kinks() {
        Some((kinks, slopes)) => {
            let gap =
                kinks.iter().zip(kinks.iter().skip(1)).map(|(a, b)| b - a).chain(kinks.first().map(|kink| 2.0 * kink));
            if gap.fold(f64::INFINITY, f64::min) <= 2.0 * margin {
                return Err(CannotTell::Grazing { theta_rad: 0.0 });
            }
            Ok(between_kinks(kinks, slopes, wave, &wave.passages(kinks, margin)?))
        }
        None => smooth(characteristic, wave, reach).ok_or(CannotTell::Range { reach, limit: 0.0 }),
    }
}

/// Output harmonics beyond the wave's own that are listed, as a multiple of its highest.
const LISTED: usize = 4;

/// Exact but for the phases of the passages: `n'(u)` is constant between them, and `n(u)' = n'(u) u'`.
fn between_kinks(kinks: &[f64], slopes: &[f64], wave: &Wave, passages: &KinkPassages) -> EnclosedSpectrum {
    let (highest, orders) = (wave.highest(), wave.orders);
    let last = LISTED * highest + 101;
    let per_span = Interval::ONE / orders.span();
    let jump_at = |kink: usize| Interval::point(slopes[kink + 1]) - Interval::point(slopes[kink]);
    let signed = |outwards: bool, jump: Interval| if outwards { jump } else { -jump };
    let jumps: Vec<(Interval, &KinkPassage)> =
        passages.all.iter().map(|one| (signed(one.outwards, jump_at(one.kink)), one)).collect();
    // Over a span P from s on: integral of n' = P n'(s) - sum of jump theta, as n' is the same at both ends.
    let weighted = jumps.iter().fold(Interval::ZERO, |sum, &(jump, at)| sum + jump * at.theta);
    let mean = Interval::point(slopes[passages.piece]) - weighted * per_span;
    let slope_harmonic = |m: usize| {
        if m == 0 {
            return Complex::new(mean, Interval::ZERO);
        }
        let order = Interval::point(m as f64);
        let sum = jumps
            .iter()
            .fold(Complex::zero(), |sum, &(jump, at)| sum + Complex::turn(at.theta * order).conjugate().scaled(jump));
        // Over j m P.
        -sum.times_j().scaled(per_span / order)
    };
    let slope = (0..=last + highest).step_by(orders.step()).map(slope_harmonic).collect();
    let mut harmonics = Spectrum { orders, output: Vec::new(), slope };
    let rates: Vec<(isize, Complex<Interval>)> =
        wave.terms().map(|(l, harmonic)| (l as isize, harmonic.enclosed().scaled(Interval::point(l as f64)))).collect();
    let inside = kinks.iter().enumerate().take(passages.piece);
    let offset = inside.fold(Interval::ZERO, |sum, (kink, &level)| sum - jump_at(kink) * Interval::point(level));
    let offset = signed(!passages.below_zero, offset);
    // k N_k = sum over l of l (D_(k-l) X_l - D_(k+l) conj X_l), but for the mean.
    harmonics.output = (orders.first()..=last)
        .step_by(orders.step())
        .map(|k| {
            if k == 0 {
                return Complex::new(mean_output(offset, mean, wave, &jumps), Interval::ZERO);
            }
            let sum = rates.iter().fold(Complex::zero(), |sum, &(l, rate)| {
                sum + harmonics.slope_at(k as isize - l) * rate - harmonics.slope_at(k as isize + l) * rate.conjugate()
            });
            sum.scaled(Interval::ONE / Interval::point(k as f64))
        })
        .collect();

    // abs(N_k) <= V/(pi k^2) with V the variation of n(u)' over a turn; sum over k > K in steps of s of k^-4 <= 1/(3 s K^3).
    let step = orders.step_enclosed();
    let steepest = slopes.iter().map(|slope| slope.abs()).fold(0.0, f64::max);
    let between = Interval::point(steepest) * wave.root_mean_square(2) * Interval::PI * Interval::point(2.0);
    let variation = jumps.iter().fold(between, |sum, &(jump, at)| sum + (jump * wave.at(at.theta).1).abs() * step);
    let cubes = Interval::point(6.0) * step * Interval::point(last as f64) * Interval::point(last as f64).square();
    let kink_sum = jumps.iter().fold(Interval::ZERO, |sum, &(jump, at)| {
        sum + step * jump.square() / (Interval::point(3.0) * Interval::PI * at.speed)
    });
    EnclosedSpectrum {
        harmonics,
        rest: variation * Interval::INVERSE_PI / cubes.sqrt(),
        kinks: kink_sum,
        curvature: Interval::ZERO,
    }
}

/// Mean of `n(u)` over a turn. Between kinks `n(u) = slope u + offset`; where a level is passed the slope jumps, and the offset by
/// `-jump level`. With U the antiderivative of `u` less its mean, and the offset where the turn begins,
/// `mean n = mean n' mean u + offset + sum of jump (level theta - U(theta))/(2 pi)`.
fn mean_output(offset: Interval, mean_slope: Interval, wave: &Wave, jumps: &[(Interval, &KinkPassage)]) -> Interval {
    let antiderivative = |theta: Interval| {
        wave.terms().skip(1).fold(Interval::ZERO, |sum, (k, harmonic)| {
            let order = Interval::point(k as f64);
            sum + (harmonic.enclosed() * Complex::turn(theta * order)).im / order
        })
    };
    let sum = jumps.iter().fold(Interval::ZERO, |sum, &(jump, at)| {
        sum + jump * (Interval::point(at.level) * at.theta - antiderivative(at.theta))
    });
    mean_slope * Interval::point(wave.harmonics[0].re) + offset + sum * Interval::INVERSE_PI * Interval::point(0.5)
}

/// Samples of a turn, fewest and most.
const SAMPLES: core::ops::RangeInclusive<usize> = 256..=16_384;

/// The trapezoid rule; a strip around the real phases on which output and slope are bounded bounds its error.
fn smooth(characteristic: &OddCharacteristic, wave: &Wave, reach: f64) -> Option<EnclosedSpectrum> {
    let (highest, step) = (wave.highest(), wave.orders.step());
    let mut samples = *SAMPLES.start();
    let (strip, last) = loop {
        // Odd.
        let last = samples / 4 - 1;
        let widths = (0..60).map(|i| 4.0 * 0.85f64.powi(i));
        let strips = widths.filter_map(|width| Strip::new(characteristic, wave, width));
        let strip = strips.min_by(|a, b| a.rest(last, step).upper().total_cmp(&b.rest(last, step).upper()));
        let enough = strip.as_ref().is_some_and(|strip| strip.decay(last) < 1e-17);
        if last > 2 * highest && (enough || 2 * samples > *SAMPLES.end()) {
            break (strip?, last);
        }
        samples *= 2;
    };
    let mut harmonics = Spectrum::sampled(wave, |x| characteristic.smooth(x), samples, last, 2 * highest);
    // The sampled N_k contains also N_(k + j samples), and D_m likewise.
    let missed = |bound: Interval, order: usize| {
        let far = strip.power(samples - order) * Interval::point(2.0) / (Interval::ONE - strip.power(samples));
        Interval::symmetric((bound * far).upper())
    };
    for (index, harmonic) in harmonics.output.iter_mut().enumerate() {
        let missed = missed(strip.output * Interval::point(2.0), wave.orders.at(index));
        *harmonic = *harmonic + Complex::new(missed, missed);
    }
    for (index, harmonic) in harmonics.slope.iter_mut().enumerate() {
        let missed = missed(strip.slope, wave.orders.step() * index);
        *harmonic = *harmonic + Complex::new(missed, missed);
    }
    Some(EnclosedSpectrum {
        harmonics,
        rest: strip.rest(last, step),
        kinks: Interval::ZERO,
        curvature: characteristic.curvature(reach) * Interval::point(0.5),
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
        (-self.width * Interval::point(order as f64)).exp()
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
