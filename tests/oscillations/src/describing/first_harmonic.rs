//! First harmonic of a periodic motion given by Taylor polynomials.

use crate::scalar::Scalar;

/// A stretch of the motion.
#[derive(Clone, Debug)]
pub struct Segment<S> {
    /// Duration in s.
    pub duration: S,
    /// Coefficients of the output in powers of the time since its beginning, in s.
    pub output: Vec<S>,
}

/// Coefficients of a polynomial about another place.
#[must_use]
pub fn shifted<S: Scalar>(coefficients: &[S], by: S) -> Vec<S> {
    let mut about = coefficients.to_vec();
    // Horner's scheme, once for every coefficient.
    for from in 0..about.len() {
        for k in (from..about.len() - 1).rev() {
            about[k] = about[k] + by * about[k + 1];
        }
    }
    about
}

/// Cosine and sine parts of the first harmonic over a period, and the mean.
#[derive(Clone, Copy, Debug)]
pub struct FirstHarmonic<S> {
    /// Mean.
    pub mean: S,
    /// Cosine part.
    pub cosine: S,
    /// Sine part.
    pub sine: S,
}

impl<S: Scalar> FirstHarmonic<S> {
    /// Harmonic `number` of segments that fill one period.
    #[must_use]
    pub fn of(segments: &[Segment<S>], number: usize) -> Self {
        let zero = S::ZERO;
        let period = segments.iter().fold(zero, |sum, segment| sum + segment.duration);
        // 2 pi from the functions at hand: the angle whose sine vanishes near.
        let omega = S::from_count(number) * turn::<S>() / period;
        let (mut now, mut mean, mut cosine, mut sine) = (zero, zero, zero, zero);
        for segment in segments {
            // Parts on which the series of the exponential converges as fast as that of the output.
            let parts = (omega.to_f64() * segment.duration.to_f64() / 0.5).ceil().max(1.0);
            let length = segment.duration / S::from_f64(parts);
            let mut output = segment.output.clone();
            for _ in 0..parts as usize {
                let (m, (c, s)) = (integral(&output, length), weighted(&output, omega, length));
                let (sin, cos) = (omega * now).sin_cos();
                mean = mean + m;
                // int y cos(omega (now + t)), int y sin(omega (now + t))
                cosine = cosine + cos * c - sin * s;
                sine = sine + sin * c + cos * s;
                now = now + length;
                output = shifted(&output, length);
            }
        }
        let two = S::ONE + S::ONE;
        Self { mean: mean / period, cosine: two * cosine / period, sine: two * sine / period }
    }

    /// Amplitude.
    #[must_use]
    pub fn amplitude(&self) -> f64 {
        self.cosine.to_f64().hypot(self.sine.to_f64())
    }
}

/// `2 pi`: Newton on the sine from the float.
#[must_use]
pub fn turn<S: Scalar>() -> S {
    let mut angle = S::from_f64(std::f64::consts::TAU);
    for _ in 0..4 {
        let (sin, cos) = angle.sin_cos();
        angle = angle - sin / cos;
    }
    angle
}

fn integral<S: Scalar>(coefficients: &[S], length: S) -> S {
    let term = |(k, &c): (usize, &S)| c / S::from_count(k + 1);
    coefficients.iter().enumerate().map(term).rev().fold(S::ZERO, |sum, c| (sum + c) * length)
}

/// `int y cos(omega t)` and `int y sin(omega t)` from 0 to the length.
fn weighted<S: Scalar>(output: &[S], omega: S, length: S) -> (S, S) {
    let order = output.len();
    let (mut cos, mut sin) = (Vec::with_capacity(order), Vec::with_capacity(order));
    let mut term = S::ONE;
    for k in 0..order {
        let sign = if k % 4 < 2 { term } else { -term };
        cos.push(if k % 2 == 0 { sign } else { S::ZERO });
        sin.push(if k % 2 == 1 { sign } else { S::ZERO });
        term = term * omega / S::from_count(k + 1);
    }
    let product = |wave: &[S]| -> Vec<S> {
        (0..order).map(|k| (0..=k).fold(S::ZERO, |sum, i| sum + output[i] * wave[k - i])).collect()
    };
    (integral(&product(&cos), length), integral(&product(&sin), length))
}

#[cfg(test)]
mod tests {
    use f256::f256;

    use super::*;

    #[test]
    fn harmonics_of_a_parabola_by_parts() {
        // t (T - t) on [0, T], T = 2, in three uneven segments: mean T^2/6, cosine parts -(T/(pi k))^2, no sine.
        let period = f256::TWO;
        let whole = [f256::ZERO, period, -f256::ONE];
        let mut segments = Vec::new();
        let mut now = f256::ZERO;
        for duration in [0.4, 1.1, 0.5] {
            let duration = f256::from(duration);
            let mut output = shifted(&whole, now);
            output.resize(f256::ORDER + 1, f256::ZERO);
            segments.push(Segment { duration, output });
            now += duration;
        }
        let half_turn = turn::<f256>() / f256::TWO;
        for number in 1..4 {
            // 0.4 + 1.1 + 0.5 is 2 up to the floats' rounding of 0.4 and 1.1.
            let found = FirstHarmonic::of(&segments, number);
            let exact = -(period / (half_turn * f256::from_count(number))).square();
            assert!((found.cosine - exact).to_f64().abs() < 1e-15);
            assert!(found.sine.to_f64().abs() < 1e-15 && (found.mean.to_f64() - 2.0 / 3.0).abs() < 1e-15);
        }
        assert!((turn::<f256>() - f256::TWO * ::f256::consts::PI).to_f64().abs() < 1e-70);
    }
}
