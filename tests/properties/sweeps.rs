//! Many sweeps at once are each one alone, to the bit.

use selfosc::describing::{CATALOGUE, CatalogueError, DescribingError, DescribingFunction, Entry};
use selfosc::nonlinearity::Sinusoid;

#[derive(Debug, PartialEq)]
struct Refused(String);

impl From<CatalogueError> for Refused {
    fn from(error: CatalogueError) -> Self {
        Self(error.to_string())
    }
}
impl From<DescribingError> for Refused {
    fn from(error: DescribingError) -> Self {
        Self(error.to_string())
    }
}

const NONE: DescribingFunction<f64> = DescribingFunction { f0: f64::NAN, p: f64::NAN, q: f64::NAN };

/// Biases and amplitudes so mixed that neighbours take different sides of every decision, at every scale of the example; more
/// than a multiple of what is evaluated together.
fn sweeps(amplitude: f64) -> Vec<(f64, f64)> {
    let ratio = |place: u32, step: f64| (f64::from(place) * step).fract();
    let one = |place| {
        let wide = amplitude * 10.0_f64.powf(3.0 * ratio(place, 0.618_033_988_75) - 1.5);
        let bias = match place % 4 {
            0 => 0.0,
            1 => 1e-9 * wide,
            _ => 3.0 * amplitude * (2.0 * ratio(place, 0.754_877_666_25) - 1.0),
        };
        (bias, wide)
    };
    (0..1003).map(one).collect()
}

fn together(entry: &Entry, values: &[f64], sweeps: &[(f64, f64)]) -> Vec<[u64; 3]> {
    let mut columns = [(); 3].map(|()| vec![0.0; sweeps.len()]);
    let undefined = |_| Ok::<_, Refused>(NONE);
    entry
        .over_sweeps(values, |place| sweeps[place], undefined, columns.each_mut().map(|column| &mut column[..]))
        .unwrap();
    (0..sweeps.len()).map(|place| columns.each_ref().map(|column| column[place].to_bits())).collect()
}

fn alone(entry: &Entry, values: &[f64], sweeps: &[(f64, f64)]) -> Vec<[u64; 3]> {
    let characteristic = entry.build(values).unwrap();
    let one = |&(bias, amplitude): &(f64, f64)| {
        let df = characteristic.describing_function(&Sinusoid::new(bias, amplitude).unwrap()).unwrap_or(NONE);
        [df.f0, df.p, df.q].map(f64::to_bits)
    };
    sweeps.iter().map(one).collect()
}

#[test]
fn many_sweeps_are_each_one_alone() {
    for entry in CATALOGUE {
        let example = entry.example().unwrap();
        let sweeps = sweeps(example.amplitude);
        let (together, alone) = (together(entry, &example.values, &sweeps), alone(entry, &example.values, &sweeps));
        let other = (0..sweeps.len()).find(|&place| together[place] != alone[place]);
        assert_eq!(other.map(|place| sweeps[place]), None, "{}", entry.name);
        let defined = alone.iter().filter(|&&[f0, ..]| !f64::from_bits(f0).is_nan()).count();
        assert!(defined > sweeps.len() / 2, "{}: {defined}", entry.name);
        // Amplitudes off by one unit in the last place would be seen.
        let moved: Vec<_> = sweeps.iter().map(|&(bias, amplitude)| (bias, amplitude.next_up())).collect();
        assert_ne!(self::together(entry, &example.values, &moved), alone, "{}", entry.name);
    }
}

#[test]
fn the_first_refusal_is_that_of_its_sweep() {
    let relay = Entry::find("relay-hysteresis").unwrap();
    let values = relay.values(&[("half_width".to_owned(), 0.5)]).unwrap();
    let fill = |sweeps: &[(f64, f64)]| {
        let mut columns = [(); 3].map(|()| vec![0.0; sweeps.len()]);
        let refuse = |error| Err(Refused::from(error));
        relay.over_sweeps(&values, |place| sweeps[place], refuse, columns.each_mut().map(|column| &mut column[..]))
    };
    let mut sweeps = [(0.0, 1.0); 11];
    assert_eq!(fill(&sweeps), Ok(()));
    sweeps[6] = (0.0, 0.25);
    let refused = relay.build(&values).unwrap().describing_function(&Sinusoid::new(0.0, 0.25).unwrap()).unwrap_err();
    assert_eq!(fill(&sweeps), Err(refused.into()));
    sweeps[5] = (f64::NAN, 1.0);
    assert!(fill(&sweeps).unwrap_err().0.starts_with("bias is NaN"));
    sweeps[2] = (0.0, f64::INFINITY);
    assert!(fill(&sweeps).unwrap_err().0.starts_with("amplitude is inf"));
}
