//! The oracle: describing functions by quadrature in 42 decimal digits, from definitions written here.
//!
//! Nothing of the library is used. The angle is substituted by `t = tan(theta/2)`, so that the sinusoid is rational in t:
//! `sin = 2t/(1 + t^2)`, `d theta = 2 dt/(1 + t^2)`. Between kinks the integrand is smooth: Gauss-Legendre with 48 nodes,
//! halved until a panel and its halves agree to 1e-30; where a power law ends a panel, tanh-sinh to 1e-22.

use std::sync::LazyLock;

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

pub(crate) type Big = FBig<HalfEven, 2>;

/// Bits of the arithmetic: 42 decimal digits.
const BITS: usize = 140;
const NODES: usize = 48;

pub(crate) fn big(x: f64) -> Big {
    Big::try_from(x).unwrap().with_precision(BITS).value()
}

fn float(x: &Big) -> f64 {
    x.to_f64().value()
}

fn pi() -> Big {
    static PI: LazyLock<Big> = LazyLock::new(|| big(1.0).atan() * big(4.0));
    PI.clone()
}

/// Nodes and weights on `[-1, 1]`: Newton on Legendre's recurrence.
fn gauss_legendre() -> &'static [(Big, Big)] {
    static RULE: LazyLock<Vec<(Big, Big)>> = LazyLock::new(|| {
        let rule = |k: usize| {
            let mut x = big((std::f64::consts::PI * (k as f64 + 0.75) / (NODES as f64 + 0.5)).cos());
            let mut slope = big(1.0);
            for _ in 0..6 {
                let (mut p, mut before) = (x.clone(), big(1.0));
                for n in 1..NODES {
                    let next = (big(2.0 * n as f64 + 1.0) * &x * &p - big(n as f64) * &before) / big(n as f64 + 1.0);
                    (before, p) = (p, next);
                }
                slope = big(NODES as f64) * (&x * &p - &before) / (&x * &x - big(1.0));
                x = &x - &p / &slope;
            }
            let weight = big(2.0) / ((big(1.0) - &x * &x) * &slope * &slope);
            (x, weight)
        };
        (0..NODES).map(rule).collect()
    });
    &RULE
}

/// Nodes as distances from the left end and from the right end of `[-1, 1]`, weights, and whether the coarser rule has them.
fn tanh_sinh() -> &'static [(Big, Big, bool)] {
    static RULE: LazyLock<Vec<(Big, Big, bool)>> = LazyLock::new(|| {
        let step = 1.0 / 32.0;
        let rule = |k: i32| {
            let tau = big(step * f64::from(k));
            let growth = tau.exp();
            let (sinh, cosh) = ((&growth - big(1.0) / &growth) / big(2.0), (&growth + big(1.0) / &growth) / big(2.0));
            let inner = pi() / big(2.0) * sinh;
            let decay = (big(-2.0) * inner).exp();
            // 1 - tanh(y) = 2/(1 + exp(2y)).
            let from_right = big(2.0) * &decay / (big(1.0) + &decay);
            let sech = big(4.0) * &decay / ((big(1.0) + &decay) * (big(1.0) + &decay));
            (from_right, big(step) * pi() / big(2.0) * cosh * sech, k % 2 == 0)
        };
        (-126..=126).map(rule).collect()
    });
    &RULE
}

/// Mean, sine and cosine coefficient.
pub(crate) type Triple = [Big; 3];

fn add(a: &Triple, b: &Triple) -> Triple {
    std::array::from_fn(|k| &a[k] + &b[k])
}

fn magnitude(a: &Triple) -> f64 {
    a.iter().map(|part| float(part).abs()).fold(0.0, f64::max)
}

/// A characteristic as the oracle knows it: output by input, branch, and the sweep's ends; kinks; behaviour at them.
pub(crate) struct Definition {
    pub(crate) output: Box<dyn Fn(&Big, bool, &(Big, Big)) -> Big + Send + Sync>,
    pub(crate) kinks: Vec<Big>,
    /// The output has an algebraic singularity at its kinks.
    pub(crate) singular: bool,
    /// Rising and falling branch differ.
    pub(crate) memory: bool,
}

/// `F_0`, `P`, `Q`.
pub(crate) fn describing_function(definition: &Definition, bias: &Big, amplitude: &Big) -> Triple {
    let ends = (bias - amplitude, bias + amplitude);
    let mut cuts = vec![big(-1.0), big(1.0)];
    for kink in &definition.kinks {
        let (above, below) = (&ends.1 - kink, kink - &ends.0);
        if above > big(0.0) && below > big(0.0) {
            let u = (kink - bias) / amplitude;
            let cosine = (above * below).sqrt() / amplitude;
            cuts.push(u / (big(1.0) + cosine));
        }
    }
    cuts.sort_by(|a, b| a.partial_cmp(b).unwrap());

    let integrand = |t: &Big| -> Triple {
        let square = big(1.0) + t * t;
        let (sine, cosine) = (big(2.0) * t / &square, (big(2.0) - &square) / &square);
        let x = bias + amplitude * &sine;
        let rising = (definition.output)(&x, true, &ends);
        let falling = if definition.memory { (definition.output)(&x, false, &ends) } else { rising.clone() };
        let weight = big(2.0) / square;
        let both = (&rising + &falling) * &weight;
        [both.clone(), both * sine, (rising - falling) * weight * cosine]
    };
    let mut total = [big(0.0), big(0.0), big(0.0)];
    for panel in cuts.windows(2) {
        if panel[0] < panel[1] {
            let part = if definition.singular {
                double_exponential(&integrand, &panel[0], &panel[1])
            } else {
                let whole = panel_sum(&integrand, &panel[0], &panel[1]);
                adaptive(&integrand, &panel[0], &panel[1], whole, 0.0, 0)
            };
            total = add(&total, &part);
        }
    }
    let [mean, sine, cosine] = total;
    let scale = pi() * amplitude;
    [mean / (pi() * big(2.0)), sine / &scale, cosine / &scale]
}

fn panel_sum(f: &impl Fn(&Big) -> Triple, from: &Big, to: &Big) -> Triple {
    let (centre, half) = ((from + to) / big(2.0), (to - from) / big(2.0));
    let mut sum = [big(0.0), big(0.0), big(0.0)];
    for (node, weight) in gauss_legendre() {
        let value = f(&(&centre + &half * node));
        sum = std::array::from_fn(|k| &sum[k] + &value[k] * weight);
    }
    sum.map(|part| part * &half)
}

fn adaptive(f: &impl Fn(&Big) -> Triple, from: &Big, to: &Big, whole: Triple, scale: f64, depth: u32) -> Triple {
    let middle = (from + to) / big(2.0);
    let (left, right) = (panel_sum(f, from, &middle), panel_sum(f, &middle, to));
    let halves = add(&left, &right);
    let scale = scale.max(magnitude(&halves));
    let difference = (0..3).map(|k| float(&(&halves[k] - &whole[k])).abs()).fold(0.0, f64::max);
    if difference <= 1e-30 * scale {
        return halves;
    }
    assert!(depth < 60, "the oracle does not settle: {difference} of {scale}");
    let left = adaptive(f, from, &middle, left, scale, depth + 1);
    add(&left, &adaptive(f, &middle, to, right, scale, depth + 1))
}

fn double_exponential(f: &impl Fn(&Big) -> Triple, from: &Big, to: &Big) -> Triple {
    let half = (to - from) / big(2.0);
    let (mut fine, mut coarse) = ([big(0.0), big(0.0), big(0.0)], [big(0.0), big(0.0), big(0.0)]);
    for (from_right, weight, shared) in tanh_sinh() {
        let node = to - &half * from_right;
        if &node <= from || &node >= to {
            continue;
        }
        let value = f(&node);
        fine = std::array::from_fn(|k| &fine[k] + &value[k] * weight);
        if *shared {
            coarse = std::array::from_fn(|k| &coarse[k] + &value[k] * weight);
        }
    }
    let difference = (0..3).map(|k| float(&(&fine[k] - &coarse[k] * big(2.0))).abs()).fold(0.0, f64::max);
    // Halving the step squares the error of tanh-sinh.
    assert!(difference <= 1e-11 * magnitude(&fine), "the oracle does not settle: {difference} of {}", magnitude(&fine));
    fine.map(|part| part * &half)
}

fn pick(condition: bool, yes: &Big, no: &Big) -> Big {
    if condition { yes.clone() } else { no.clone() }
}

fn held(x: &Big, low: &Big, high: &Big) -> Big {
    if x < low { low.clone() } else { pick(x > high, high, x) }
}

fn sign(x: &Big, size: &Big) -> Big {
    pick(x > &big(0.0), size, &-size.clone())
}

/// Those whose output depends on the branch.
pub(crate) const MEMORY: [&str; 3] = ["relay-hysteresis", "relay-dead-zone-hysteresis", "backlash"];

/// The characteristic of that name, as its page defines it.
pub(crate) fn definition(name: &str, values: &[f64], bias: &Big, amplitude: &Big) -> Definition {
    let v: Vec<Big> = values.iter().copied().map(big).collect();
    let (lowest, highest) = (bias - amplitude, bias + amplitude);
    let zero = || big(0.0);
    let both = |a: &Big| vec![-a.clone(), a.clone()];

    macro_rules! define {
        ($kinks:expr, |$x:ident, $rising:ident, $ends:ident| $output:expr) => {{
            let kinks = $kinks;
            let output = Box::new(move |$x: &Big, $rising: bool, $ends: &(Big, Big)| {
                let _ = ($rising, $ends);
                $output
            });
            Definition { output, kinks, singular: false, memory: MEMORY.contains(&name) }
        }};
    }

    match name {
        "relay" => define!(vec![zero()], |x, _r, _e| sign(x, &v[0])),
        "relay-dead-zone" => define!(both(&v[1]), |x, _r, _e| {
            if x > &v[1] { v[0].clone() } else { pick(*x < -v[1].clone(), &-v[0].clone(), &big(0.0)) }
        }),
        "relay-hysteresis" => define!(both(&v[1]), |x, rising, _e| {
            let threshold = if rising { v[1].clone() } else { -v[1].clone() };
            &v[2] + sign(&(x - threshold), &v[0])
        }),
        "relay-dead-zone-hysteresis" => {
            define!([both(&v[1]), both(&v[2])].concat(), |x, rising, ends| {
                let upper = pick(rising, &v[1], &v[2]);
                let lower = -pick(rising, &v[2], &v[1]);
                let plus = ends.1 > v[1] && x > &upper;
                let minus = ends.0 < -v[1].clone() && x < &lower;
                pick(plus, &v[0], &big(0.0)) - pick(minus, &v[0], &big(0.0))
            })
        }
        "saturation" => define!(both(&v[1]), |x, _r, _e| &v[0] * held(x, &-v[1].clone(), &v[1])),
        "saturation-asymmetric" => define!(vec![v[1].clone(), v[2].clone()], |x, _r, _e| &v[0] * held(x, &v[1], &v[2])),
        "dead-zone" => define!(both(&v[1]), |x, _r, _e| &v[0] * (x - held(x, &-v[1].clone(), &v[1]))),
        "dead-zone-saturation" => define!([both(&v[1]), both(&v[2])].concat(), |x, _r, _e| {
            let x = held(x, &-v[2].clone(), &v[2]);
            &v[0] * (&x - held(&x, &-v[1].clone(), &v[1]))
        }),
        "gain-changing" => define!(both(&v[2]), |x, _r, _e| {
            let inner = held(x, &-v[2].clone(), &v[2]);
            &v[0] * &inner + &v[1] * (x - &inner)
        }),
        "preload" => define!(vec![zero()], |x, _r, _e| &v[0] * x + sign(x, &v[1])),
        "quantizer" => {
            let half = &v[0] / big(2.0);
            let first = (float(&(&lowest / &v[0])) - 2.0).floor() as i64;
            let last = (float(&(&highest / &v[0])) + 2.0).ceil() as i64;
            let kinks = (first..=last).map(|k| big(2.0 * k as f64 + 1.0) * &half).collect();
            define!(kinks, |x, _r, _e| &v[0] * (x / &v[0] + big(0.5)).floor())
        }
        "power" => {
            let whole = values[1].fract() == 0.0;
            let power = define!(vec![zero()], |x, _r, _e| {
                let size = if x < &big(0.0) { -x.clone() } else { x.clone() };
                let grown = if whole {
                    size.powi((float(&v[1]) as i32).into())
                } else if size == big(0.0) {
                    big(0.0)
                } else {
                    (size.ln() * &v[1]).exp()
                };
                sign(x, &(&v[0] * grown))
            });
            Definition { singular: !whole, ..power }
        }
        "polynomial" => define!(vec![], |x, _r, _e| v.iter().rev().fold(big(0.0), |sum, c| sum * x + c)),
        "sine" => define!(vec![], |x, _r, _e| &v[0] * (&v[1] * x).sin()),
        "sinh" => define!(vec![], |x, _r, _e| {
            let growth = (&v[1] * x).exp();
            &v[0] * (&growth - big(1.0) / &growth) / big(2.0)
        }),
        "arctan" => define!(vec![], |x, _r, _e| &v[0] * (&v[1] * x).atan()),
        "tanh" => define!(vec![], |x, _r, _e| {
            let decay = (big(-2.0) * &v[1] * x).exp();
            &v[0] * (big(1.0) - &decay) / (big(1.0) + &decay)
        }),
        "absolute" => define!(vec![zero()], |x, _r, _e| pick(*x < big(0.0), &-x.clone(), x) * &v[0]),
        "piecewise-linear" => {
            let points: Vec<(Big, Big)> = v[2..].chunks(2).map(|point| (point[0].clone(), point[1].clone())).collect();
            define!(points.iter().map(|point| point.0.clone()).collect(), |x, _r, _e| {
                let (first, last) = (&points[0], &points[points.len() - 1]);
                if x <= &first.0 {
                    &first.1 + &v[0] * (x - &first.0)
                } else if x >= &last.0 {
                    &last.1 + &v[1] * (x - &last.0)
                } else {
                    let place = points.iter().position(|point| &point.0 >= x).unwrap();
                    let (a, b) = (&points[place - 1], &points[place]);
                    (&a.1 * (&b.0 - x) + &b.1 * (x - &a.0)) / (&b.0 - &a.0)
                }
            })
        }
        "backlash" => {
            let (gap, twice) = (v[1].clone(), &v[1] * big(2.0));
            define!(vec![lowest + &twice, highest - &twice], |x, rising, ends| {
                // Pushed from the lowest output on, pulled from the highest one on.
                let (pushed, pulled) = (x - &gap, x + &gap);
                let (rest, top) = (&ends.0 + &gap, &ends.1 - &gap);
                &v[0] * if rising { pick(pushed > rest, &pushed, &rest) } else { pick(pulled < top, &pulled, &top) }
            })
        }
        _ => panic!("{name} has no definition of its own in tests/properties/oracle.rs: write it from its page"),
    }
}
