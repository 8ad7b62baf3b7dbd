//! Speed of the describing functions: closed form, quadrature, many amplitudes.
#![allow(clippy::unwrap_used, reason = "a benchmark may panic")]

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use selfosc::describing::{CATALOGUE, ClosedForm, Entry, by_quadrature, over_amplitudes};
use selfosc::nonlinearity::{
    DeadZone, DeadZoneSaturation, GainChanging, Power, Preload, Relay, RelayDeadZone, RelayHysteresis, Saturation,
    Sinusoid, Tanh,
};

fn main() {
    divan::main();
}

fn names() -> impl Iterator<Item = &'static str> {
    CATALOGUE.iter().map(|entry| entry.name)
}

/// The example of each page, at a bias of a fifth of its amplitude.
fn example(name: &str) -> (selfosc::describing::Boxed<f64>, Sinusoid<f64>) {
    let entry = Entry::find(name).unwrap();
    let example = entry.example().unwrap();
    (entry.build(&example.values).unwrap(), Sinusoid::new(0.2 * example.amplitude, example.amplitude).unwrap())
}

#[divan::bench(args = names())]
fn closed_form(bencher: Bencher, name: &str) {
    let (characteristic, sweep) = example(name);
    bencher.bench_local(|| characteristic.describing_function(black_box(&sweep)));
}

#[divan::bench(args = names())]
fn quadrature(bencher: Bencher, name: &str) {
    let (characteristic, sweep) = example(name);
    bencher.bench_local(|| by_quadrature(&*characteristic, black_box(&sweep)));
}

/// A thousand amplitudes, one after the other.
#[divan::bench(args = names(), sample_count = 20)]
fn array(bencher: Bencher, name: &str) {
    let (characteristic, sweep) = example(name);
    let amplitude = |k: i32| sweep.amplitude() * (1.0 + f64::from(k) / 250.0);
    let sum = || {
        let amplitudes = (0..1000).map(amplitude);
        over_amplitudes(&*characteristic, sweep.bias(), amplitudes).map(|df| df.map_or(0.0, |df| df.p)).sum::<f64>()
    };
    bencher.counter(ItemsCount::new(1000u32)).bench_local(sum);
}

/// The statically known type: what a program that names its characteristic pays.
#[divan::bench_group]
mod typed {
    use super::*;

    macro_rules! bench {
        ($($name:ident = $characteristic:expr),+ $(,)?) => {$(
            #[divan::bench]
            fn $name(bencher: Bencher) {
                let characteristic = $characteristic.unwrap();
                let sweep = Sinusoid::new(0.2, 1.0).unwrap();
                bencher.bench_local(|| black_box(&characteristic).describing_function(black_box(&sweep)));
            }
        )+};
    }

    bench!(
        relay = Relay::new(1.0),
        relay_dead_zone = RelayDeadZone::new(1.0, 0.3),
        relay_hysteresis = RelayHysteresis::new(1.0, 0.3, 0.0),
        saturation = Saturation::new(1.0, 0.5),
        dead_zone = DeadZone::new(1.0, 0.3),
        dead_zone_saturation = DeadZoneSaturation::new(1.0, 0.2, 0.7),
        gain_changing = GainChanging::new(1.0, 0.5, 0.5),
        preload = Preload::new(1.0, 0.5),
        tanh = Tanh::new(1.0, 3.0),
    );

    #[divan::bench]
    fn power_unbiased(bencher: Bencher) {
        let (drag, sweep) = (Power::new(1.0, 2.0).unwrap(), Sinusoid::new(0.0, 1.3).unwrap());
        bencher.bench_local(|| black_box(&drag).describing_function(black_box(&sweep)));
    }

    #[divan::bench(args = [0.2, 0.59, 0.61, 0.8, 0.999, 1.0, 1.001, 1.3, 1.51, 4.0])]
    fn power_biased(bencher: Bencher, bias: f64) {
        let (drag, sweep) = (Power::new(1.0, 1.7).unwrap(), Sinusoid::new(bias, 1.0).unwrap());
        bencher.bench_local(|| black_box(&drag).describing_function(black_box(&sweep)));
    }
}
