//! Harmonics of the characteristic's output `n(u)` and slope `n'(u)` along a wave.
//!
//! `n(u) = Re sum over odd k of N_k exp(jk theta)`, `n'(u) = sum over even m of D_m exp(jm theta)`, `D_(-m)` conjugate to `D_m`.

use super::characteristic::OddCharacteristic;
use super::error::CannotTell;
use super::wave::{KinkPassages, Wave};
use crate::numeric::{Complex, Interval, Real};

/// Harmonics of output and slope.
#[derive(Clone, Debug)]
pub(super) struct Spectrum<T> {
    /// N_1, N_3, N_5, ...
    pub(super) output: Vec<Complex<T>>,
    /// D_0, D_2, D_4, ...
    pub(super) slope: Vec<Complex<T>>,
}

/// A spectrum enclosed, with the bounds that the proof needs beside it.
#[derive(Clone, Debug)]
pub(super) struct EnclosedSpectrum {
    pub(super) harmonics: Spectrum<Interval>,
    /// Upper bound of `sqrt(1/2 sum abs(N_k)^2)` over the harmonics that are not listed.
    pub(super) rest: Interval,
    /// Upper bound of `sum 2 J^2/(3 pi m)` over the kinks passed in half a turn, slope jump J at speed m: `e = sqrt(that delta^3)`.
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
    /// D_m for even m of either sign.
    pub(super) fn slope_at(&self, m: isize) -> Complex<T> {
        let found = self.slope.get(m.unsigned_abs() / 2).copied().unwrap_or_else(Complex::zero);
        if m < 0 { found.conjugate() } else { found }
    }

    /// By the trapezoid rule: from `samples` phases of a turn, a multiple of four, of which half suffice. What it leaves out are the
    /// harmonics of the orders `k + j samples`.
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
            wave.orders().map(|(k, harmonic)| (k, T::from_f64(harmonic.re), T::from_f64(harmonic.im))).collect();
        let values: Vec<(T, T)> = (0..samples / 2)
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
            sum.scaled(T::from_f64(factor / samples as f64))
        };
        Self {
            output: (1..=output_last).step_by(2).map(|k| sum(k, |value| value.0, 4.0)).collect(),
            slope: (0..=slope_last).step_by(2).map(|m| sum(m, |value| value.1, 2.0)).collect(),
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
            Ok(between_kinks(slopes, wave, &wave.passages(kinks, margin)?))
        }
        None => smooth(characteristic, wave, reach).ok_or(CannotTell::Range { reach, limit: 0.0 }),
    }
}

/// Output harmonics beyond the wave's own that are listed, as a multiple of its highest.
const LISTED: usize = 4;

/// Exact but for the phases of the passages: `n'(u)` is constant between them, and `n(u)' = n'(u) u'`.
fn between_kinks(slopes: &[f64], wave: &Wave, passages: &KinkPassages) -> EnclosedSpectrum {
    let highest = wave.highest();
    let last = LISTED * highest + 101;
    let jumps: Vec<(Interval, Interval)> = passages
        .all
        .iter()
        .map(|one| {
            let jump = Interval::point(slopes[one.kink + 1]) - Interval::point(slopes[one.kink]);
            (if one.outwards { jump } else { -jump }, one.theta)
        })
        .collect();
    // Over half a turn from s to s + pi: integral of n' = pi n'(s) - sum of jump theta, as n' is the same at both ends.
    let weighted = jumps.iter().fold(Interval::ZERO, |sum, &(jump, theta)| sum + jump * theta);
    let mean = Interval::point(slopes[passages.piece]) - weighted * Interval::INVERSE_PI;
    let slope_harmonic = |m: usize| {
        if m == 0 {
            return Complex::new(mean, Interval::ZERO);
        }
        let order = Interval::point(m as f64);
        let sum = jumps
            .iter()
            .fold(Complex::zero(), |sum, &(jump, theta)| sum + Complex::turn(theta * order).conjugate().scaled(jump));
        // Over j m pi.
        -sum.times_j().scaled(Interval::INVERSE_PI / order)
    };
    let mut harmonics =
        Spectrum { output: Vec::new(), slope: (0..=last + highest).step_by(2).map(slope_harmonic).collect() };
    let rates: Vec<(isize, Complex<Interval>)> = wave
        .orders()
        .map(|(l, harmonic)| (l as isize, harmonic.enclosed().scaled(Interval::point(l as f64))))
        .collect();
    // k N_k = sum over l of l (D_(k-l) X_l - D_(k+l) conj X_l).
    harmonics.output = (1..=last)
        .step_by(2)
        .map(|k| {
            let sum = rates.iter().fold(Complex::zero(), |sum, &(l, rate)| {
                sum + harmonics.slope_at(k as isize - l) * rate - harmonics.slope_at(k as isize + l) * rate.conjugate()
            });
            sum.scaled(Interval::ONE / Interval::point(k as f64))
        })
        .collect();

    // abs(N_k) <= V/(pi k^2) with V the variation of n(u)'; sum over odd k > K of k^-4 <= 1/(6 K^3).
    let steepest = slopes.iter().map(|slope| slope.abs()).fold(0.0, f64::max);
    let between = Interval::point(steepest) * wave.root_mean_square(2) * Interval::PI * Interval::point(2.0);
    let variation =
        jumps.iter().fold(between, |sum, &(jump, theta)| sum + (jump * wave.at(theta).1).abs() * Interval::point(2.0));
    let cubes = Interval::point(12.0) * Interval::point(last as f64) * Interval::point(last as f64).square();
    let kink_sum = passages.all.iter().zip(&jumps).fold(Interval::ZERO, |sum, (one, &(jump, _))| {
        sum + jump.square() / (Interval::point(1.5) * Interval::PI * one.speed)
    });
    EnclosedSpectrum {
        harmonics,
        rest: variation * Interval::INVERSE_PI / cubes.sqrt(),
        kinks: kink_sum,
        curvature: Interval::ZERO,
    }
}

/// Samples of a turn, fewest and most.
const SAMPLES: core::ops::RangeInclusive<usize> = 256..=16_384;

/// The trapezoid rule; a strip around the real phases on which output and slope are bounded bounds what it leaves out.
fn smooth(characteristic: &OddCharacteristic, wave: &Wave, reach: f64) -> Option<EnclosedSpectrum> {
    let highest = wave.highest();
    let mut samples = *SAMPLES.start();
    let (strip, last) = loop {
        let last = samples / 4 - 1;
        let widths = (0..60).map(|i| 4.0 * 0.85f64.powi(i));
        let strips = widths.filter_map(|width| Strip::new(characteristic, wave, width));
        let strip = strips.min_by(|a, b| a.rest(last).upper().total_cmp(&b.rest(last).upper()));
        let enough = strip.as_ref().is_some_and(|strip| strip.decay(last) < 1e-17);
        if last > 2 * highest && (enough || 2 * samples > *SAMPLES.end()) {
            break (strip?, last);
        }
        samples *= 2;
    };
    let mut harmonics = Spectrum::sampled(wave, |x| characteristic.smooth(x), samples, last, 2 * highest);
    // What stands for N_k holds also N_(k + j samples), and D_m likewise.
    let missed = |bound: Interval, order: usize| {
        let far = strip.power(samples - order) * Interval::point(2.0) / (Interval::ONE - strip.power(samples));
        Interval::symmetric((bound * far).upper())
    };
    for (index, harmonic) in harmonics.output.iter_mut().enumerate() {
        let missed = missed(strip.output * Interval::point(2.0), 2 * index + 1);
        *harmonic = *harmonic + Complex::new(missed, missed);
    }
    for (index, harmonic) in harmonics.slope.iter_mut().enumerate() {
        let missed = missed(strip.slope, 2 * index);
        *harmonic = *harmonic + Complex::new(missed, missed);
    }
    Some(EnclosedSpectrum {
        harmonics,
        rest: strip.rest(last),
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

    /// Size of a harmonic beside the whole.
    fn decay(&self, order: usize) -> f64 {
        (self.power(order) * self.output).upper()
    }

    /// `1/2 sum over odd k > last of (2 output exp(-k width))^2`, its root.
    fn rest(&self, last: usize) -> Interval {
        let geometric = Interval::ONE - self.power(4);
        self.output * self.power(last + 2) * (Interval::point(2.0) / geometric).sqrt()
    }
}
