//! Enclosures of describing functions, and proofs of the kernels' closed forms.

use selfosc::describing::{CATALOGUE, ClosedForm, DescribingError, DescribingFunction, Entry, KernelForm, certified};
use selfosc::nonlinearity::{
    Absolute, Backlash, Custom, DeadZone, DeadZoneSaturation, GainChanging, NonlinearityError, Polyline, Preload,
    Quantizer, Relay, RelayDeadZone, RelayDeadZoneHysteresis, RelayHysteresis, Saturation, SaturationAsymmetric,
    Sinusoid,
};
use selfosc::numeric::rigorous_quadrature::CellJet;
use selfosc::numeric::{Interval, Real};

use crate::cases::case;
use crate::fourier_oracle::{big, definition, describing_function};
use crate::tolerance;

fn jet(value: f64) -> CellJet {
    CellJet::from_f64(value)
}

fn parts<T: Copy>(df: DescribingFunction<T>) -> [T; 3] {
    [df.f0, df.p, df.q]
}

/// Moderate parameters of each characteristic.
fn moderate(entry: &Entry) -> Vec<f64> {
    match entry.name {
        "relay" => vec![1.5],
        "relay-hysteresis" => vec![1.2, 0.4, 0.3],
        "relay-dead-zone-hysteresis" => vec![1.0, 0.5, 0.2],
        "saturation-asymmetric" => vec![1.3, -0.4, 0.6],
        "gain-changing" => vec![0.5, 2.0, 0.6],
        "dead-zone-saturation" => vec![1.0, 0.2, 0.7],
        "quantizer" => vec![0.25],
        "power" => vec![1.0, 2.0],
        "polynomial" => vec![0.1, 1.0, 0.3, -0.2, 0.0, 0.05, 0.0, 0.0, 0.0, 0.01],
        "absolute" => vec![1.0],
        "piecewise-linear" => vec![0.1, 0.2, -1.0, -0.8, -0.2, 0.0, 0.1, 0.0, 1.0, 1.2],
        "backlash" => vec![1.0, 0.3],
        _ => vec![1.1, 0.5],
    }
}

/// The high-precision definition lies in the enclosure, and so does the closed form but for its rounding.
#[test]
fn every_member_is_enclosed_within_1e11() {
    for entry in CATALOGUE {
        let values = moderate(entry);
        for (bias, amplitude) in [(0.0, 1.0), (0.15, 1.3)] {
            let jets: Vec<_> = values.iter().map(|&value| jet(value)).collect();
            let sweep = Sinusoid::new(jet(bias), jet(amplitude)).unwrap();
            let found = certified(&*entry.build_output(&jets).unwrap(), &sweep);
            let found = found.unwrap_or_else(|error| panic!("{}: {error}", entry.name));
            let exact_bias = big(bias);
            let exact_amplitude = big(amplitude);
            let exact = describing_function(
                &definition(entry.name, &values, &exact_bias, &exact_amplitude),
                &exact_bias,
                &exact_amplitude,
            );
            for (part, exact) in parts(found.enclosure).into_iter().zip(exact) {
                let name = entry.name;
                assert!(part.width() < tolerance::CERTIFIED_WIDTH, "{name}: {part} is {:e} wide", part.width());
                assert!(big(part.lower()) <= exact && exact <= big(part.upper()), "{name}: {exact} not in {part}");
            }
        }
    }
}
