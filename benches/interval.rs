//! Cost of one rigorous operation, of an enclosed integral, and of a proved root.

use std::hint::black_box;

use divan::Bencher;
use selfosc::numeric::{Interval, Jet, Real};
use selfosc::proof::Gradient;
use selfosc::proof::enclosure::{around, krawczyk, newton};
use selfosc::proof::rigorous_quadrature::{CellJet, Integrand, integrate};

fn main() {
    divan::main();
}

/// Arguments enough that no branch is foreseen.
fn arguments() -> Vec<Interval> {
    (1..=1000).map(|i| Interval::point(f64::from(i * 7919 % 1000) / 1003.0)).collect()
}

fn each(bencher: Bencher, function: impl Fn(Interval) -> Interval + Sync) {
    let arguments = arguments();
    bencher.counter(divan::counter::ItemsCount::new(arguments.len())).bench(|| {
        for &x in &arguments {
            black_box(function(black_box(x)));
        }
    });
}

macro_rules! unary {
    ($($function:ident)+) => {
        $(
            #[divan::bench]
            fn $function(bencher: Bencher) {
                each(bencher, <Interval as Real>::$function);
            }
        )+
    };
}
unary!(sqrt square sin cos tan asin acos atan exp exp_m1 ln ln_1p sinh cosh tanh atanh);

const OTHER: f64 = 0.3;

#[divan::bench]
fn add(bencher: Bencher) {
    each(bencher, |x| x + Interval::point(black_box(OTHER)));
}

#[divan::bench]
fn mul(bencher: Bencher) {
    each(bencher, |x| x * Interval::point(black_box(OTHER)));
}

#[divan::bench]
fn div(bencher: Bencher) {
    each(bencher, |x| x / Interval::point(black_box(OTHER)));
}

/// Saturation of unit slope, driven by a biased sine: mean, in phase, in quadrature.
struct Saturation;

fn saturated<T: Real>(t: T) -> [T; 3] {
    let sine = t.sin();
    let output = (T::from_f64(0.2) + T::from_f64(1.7) * sine).clamp_unit();
    [output, output * sine, output * t.cos()]
}

impl Integrand<3> for Saturation {
    fn range(&self, t: Interval) -> [Interval; 3] {
        saturated(t)
    }
    fn jet(&self, t: CellJet) -> Option<[CellJet; 3]> {
        Some(saturated(t))
    }
}

/// Ideal relay driven by the same input.
struct Relay;

impl Integrand<3> for Relay {
    fn range(&self, t: Interval) -> [Interval; 3] {
        let input = Interval::point(0.2) + Interval::point(1.7) * t.sin();
        let output =
            if input.contains_zero() { Interval::UNIT } else { Interval::point(1_f64.copysign(input.lower())) };
        [output, output * t.sin(), output * t.cos()]
    }
    fn jet(&self, t: CellJet) -> Option<[CellJet; 3]> {
        let input = Interval::point(0.2) + Interval::point(1.7) * t.value().sin();
        if input.contains_zero() {
            return None;
        }
        let output: CellJet = Jet::from_f64(1_f64.copysign(input.lower()));
        Some([output, output * t.sin(), output * t.cos()])
    }
}

#[divan::bench]
fn integral_of_saturation(bencher: Bencher) {
    bencher.bench(|| integrate(black_box(&Saturation), -Interval::PI, Interval::PI, 1e-11, 10_000));
}

#[divan::bench]
fn integral_of_relay(bencher: Bencher) {
    bencher.bench(|| integrate(black_box(&Relay), -Interval::PI, Interval::PI, 1e-11, 10_000));
}

#[divan::bench]
fn root_by_newton(bencher: Bencher) {
    let [start] = around([1.4], 0.3);
    bencher.bench(|| newton(|x| x.exp() - Gradient::from_f64(4.0), black_box(start), 20));
}

#[divan::bench]
fn root_by_krawczyk(bencher: Bencher) {
    let equations =
        |[x, y]: [Gradient<2>; 2]| [x.square() + y.square() - Gradient::from_f64(4.0), x.exp() + y - Gradient::one()];
    bencher.bench(|| krawczyk(equations, black_box(around([1.004_168, -1.729_637], 1e-3)), 20));
}
