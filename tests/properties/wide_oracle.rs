//! A second oracle: describing functions in 32 digits, fast enough for a million points of each entry.
//!
//! Nothing of the library is used. Pieces of polynomials between kinks are integrated in closed form; arctan by the Fourier series
//! of a complex logarithm; what is smooth and periodic by the trapezoidal rule, whose error falls geometrically.

use std::sync::LazyLock;

use super::wide::{PI, Wide, wide};

/// Points of the trapezoidal rule: for the steepest tanh the error is below 1e-22.
const POINTS: usize = 144;

/// The output up to a value of the input, as coefficients of its powers.
type Piece = (Wide, [Wide; 3]);

const ENDLESS: Wide = wide(f64::INFINITY);

fn constant(c: Wide) -> [Wide; 3] {
    [c, wide(0.0), wide(0.0)]
}

fn line(c: Wide, slope: Wide) -> [Wide; 3] {
    [c, slope, wide(0.0)]
}

/// `F_0`, `P`, `Q` at parameters, bias and amplitude.
pub(crate) fn describing_function(name: &str, values: &[f64], bias: f64, amplitude: f64) -> [Wide; 3] {
    let v: Vec<Wide> = values.iter().copied().map(wide).collect();
    let (b, a) = (wide(bias), wide(amplitude));
    let smooth = |output: &dyn Fn(Wide) -> Wide| trapezoidal(b, a, output);
    match name {
        "polynomial" => smooth(&|x| v.iter().rev().fold(wide(0.0), |sum, c| sum * x + *c)),
        "sine" => smooth(&|x| v[0] * (v[1] * x).sin()),
        "sinh" => smooth(&|x| v[0] * (v[1] * x).sinh()),
        "tanh" => smooth(&|x| {
            let half = v[1] * x;
            let sinh = (half / wide(2.0)).sinh();
            let cosh = (wide(1.0) + sinh.square()).sqrt();
            let (double, square) = (wide(2.0) * sinh * cosh, sinh.square() + cosh.square());
            v[0] * double / square
        }),
        "arctan" => arctan(v[0], v[1], b, a),
        _ => {
            let (rising, falling) = pieces(name, &v, b, a);
            let (up, down) = (integrals(&rising, b, a), integrals(&falling, b, a));
            let scale = PI * a;
            [(up[0] + down[0]) / (wide(2.0) * PI), (up[1] + down[1]) / scale, (up[2] - down[2]) / scale]
        }
    }
}

/// Means over equally spaced angles.
fn trapezoidal(bias: Wide, amplitude: Wide, output: &dyn Fn(Wide) -> Wide) -> [Wide; 3] {
    // A sinusoid takes each value twice: half a turn, its ends counted once.
    static SINES: LazyLock<Vec<Wide>> = LazyLock::new(|| {
        let share = |k: usize| wide(2.0 * k as f64) / wide(POINTS as f64);
        (0..=POINTS / 2).map(|k| (PI * (share(k) - wide(0.5))).sin()).collect()
    });
    let (mut mean, mut sine_part) = (wide(0.0), wide(0.0));
    for (k, sine) in SINES.iter().enumerate() {
        let weight = if k == 0 || 2 * k == POINTS { wide(1.0) } else { wide(2.0) };
        let value = weight * output(bias + amplitude * *sine);
        (mean, sine_part) = (mean + value, sine_part + value * *sine);
    }
    let count = wide(POINTS as f64);
    [mean / count, wide(2.0) * sine_part / (count * amplitude), wide(0.0)]
}

/// With `w = 1 + j k b`: the mean of `ln(w + j k A sin)` is `ln((w + sqrt(w^2 + k^2 A^2))/2)`, its first sine coefficient twice
/// `(w - sqrt(w^2 + k^2 A^2))/(j k A)`.
fn arctan(gain: Wide, steepness: Wide, bias: Wide, amplitude: Wide) -> [Wide; 3] {
    let (one, two) = (wide(1.0), wide(2.0));
    let (y, size) = (steepness * bias, steepness * amplitude);
    // The root of (1 - y^2 + size^2) + 2 y j with a positive real part.
    let (re, im) = (one - y.square() + size.square(), two * y);
    let length = (re.square() + im.square()).sqrt();
    let real = if re.0 >= 0.0 {
        ((length + re) / two).sqrt()
    } else {
        // No cancellation where the square lies to the left.
        let imaginary = ((length - re) / two).sqrt();
        let magnitude = if im.0 < 0.0 { -im } else { im };
        magnitude / (two * imaginary)
    };
    let imaginary = im / (two * real);
    let mean = ((y + imaginary) / (one + real)).atan();
    // Im((1 - real + j (y - imaginary))/(j size)) is -(1 - real)/size.
    let first = (real - one) / size;
    [gain * mean, gain * two * first / amplitude, wide(0.0)]
}

/// Of both branches.
fn pieces(name: &str, v: &[Wide], bias: Wide, amplitude: Wide) -> (Vec<Piece>, Vec<Piece>) {
    let zero = wide(0.0);
    let (lowest, highest) = (bias - amplitude, bias + amplitude);
    // Output `below` up to a threshold and `above` from there on.
    let step = |at: Wide, below: Wide, above: Wide| vec![(at, constant(below)), (ENDLESS, constant(above))];
    let held = |gain: Wide, low: Wide, high: Wide| {
        vec![(low, constant(gain * low)), (high, line(zero, gain)), (ENDLESS, constant(gain * high))]
    };
    let three = |low: Wide, high: Wide, level: Wide| {
        vec![(low, constant(-level)), (high, constant(zero)), (ENDLESS, constant(level))]
    };
    let both = |branch: Vec<Piece>| (branch.clone(), branch);
    match name {
        "relay" => both(step(zero, -v[0], v[0])),
        "relay-dead-zone" => both(three(-v[1], v[1], v[0])),
        "relay-hysteresis" => {
            let (low, high) = (v[2] - v[0], v[2] + v[0]);
            (step(v[1], low, high), step(-v[1], low, high))
        }
        // Where the domain reaches, the sweep passes all four thresholds.
        "relay-dead-zone-hysteresis" => (three(-v[2], v[1], v[0]), three(-v[1], v[2], v[0])),
        "saturation" => both(held(v[0], -v[1], v[1])),
        "saturation-asymmetric" => both(held(v[0], v[1], v[2])),
        "dead-zone" => {
            let (gain, end) = (v[0], v[0] * v[1]);
            both(vec![(-v[1], line(end, gain)), (v[1], constant(zero)), (ENDLESS, line(-end, gain))])
        }
        "dead-zone-saturation" => {
            let (gain, end) = (v[0], v[0] * v[1]);
            let most = gain * (v[2] - v[1]);
            both(vec![
                (-v[2], constant(-most)),
                (-v[1], line(end, gain)),
                (v[1], constant(zero)),
                (v[2], line(-end, gain)),
                (ENDLESS, constant(most)),
            ])
        }
        "gain-changing" => {
            let end = (v[0] - v[1]) * v[2];
            both(vec![(-v[2], line(-end, v[1])), (v[2], line(zero, v[0])), (ENDLESS, line(end, v[1]))])
        }
        "preload" => both(vec![(zero, line(-v[1], v[0])), (ENDLESS, line(v[1], v[0]))]),
        "quantizer" => {
            let level = |k: i32| (wide(f64::from(k) + 0.5) * v[0], constant(wide(f64::from(k)) * v[0]));
            both((-8..9).map(level).collect())
        }
        "power" => {
            assert_eq!(v[1].0, 2.0, "the domain has squares only");
            both(vec![(zero, [zero, zero, -v[0]]), (ENDLESS, [zero, zero, v[0]])])
        }
        "absolute" => both(vec![(zero, line(zero, -v[0])), (ENDLESS, line(zero, v[0]))]),
        "piecewise-linear" => {
            let points: Vec<_> = v[2..].chunks(2).map(|point| (point[0], point[1])).collect();
            let through = |(x, y): (Wide, Wide), slope: Wide| line(y - slope * x, slope);
            let mut branch = vec![(points[0].0, through(points[0], v[0]))];
            for pair in points.windows(2) {
                let slope = (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
                branch.push((pair[1].0, through(pair[0], slope)));
            }
            branch.push((ENDLESS, through(points[points.len() - 1], v[1])));
            both(branch)
        }
        "backlash" => {
            let (gain, gap) = (v[0], v[1]);
            let (rest, top) = (gain * (lowest + gap), gain * (highest - gap));
            let (pushed, pulled) = (line(-(gain * gap), gain), line(gain * gap, gain));
            let twice = gap + gap;
            (
                vec![(lowest + twice, constant(rest)), (ENDLESS, pushed)],
                vec![(highest - twice, pulled), (ENDLESS, constant(top))],
            )
        }
        _ => panic!("{name} has no pieces of its own here: write them from its page"),
    }
}

/// Over half a turn upwards: of the output, of the output times the sine, of the output times the cosine.
fn integrals(branch: &[Piece], b: Wide, a: Wide) -> [Wide; 3] {
    let (one, two, three) = (wide(1.0), wide(2.0), wide(3.0));
    let right = PI / two;
    // Angle, its sine and cosine.
    let mut from = (-right, -one, wide(0.0));
    let mut total = [wide(0.0); 3];
    for (until, [c0, c1, c2]) in branch {
        let u = if until.0.is_finite() { (*until - b) / a } else { wide(2.0) };
        if u.0 <= -1.0 {
            continue;
        }
        let last = u.0 >= 1.0;
        let to = if last { (right, one, wide(0.0)) } else { (u.asin(), u, ((one - u) * (one + u)).sqrt()) };
        // Powers of the sine from the input's: x = b + a sin.
        let (k0, k1, k2) = (*c0 + (*c1 + *c2 * b) * b, (*c1 + two * *c2 * b) * a, *c2 * a.square());
        // Of the sine's powers zero to three over the angle.
        let odd = |cosine: Wide| cosine * cosine.square() / three - cosine;
        let s0 = to.0 - from.0;
        let s1 = from.2 - to.2;
        let s2 = (s0 - (to.1 * to.2 - from.1 * from.2)) / two;
        let s3 = odd(to.2) - odd(from.2);
        // And of the powers times the cosine.
        let t1 = to.1 - from.1;
        let t2 = (to.1.square() - from.1.square()) / two;
        let t3 = (to.1 * to.1.square() - from.1 * from.1.square()) / three;
        total[0] = total[0] + k0 * s0 + k1 * s1 + k2 * s2;
        total[1] = total[1] + k0 * s1 + k1 * s2 + k2 * s3;
        total[2] = total[2] + k0 * t1 + k1 * t2 + k2 * t3;
        from = to;
        if last {
            break;
        }
    }
    total
}
