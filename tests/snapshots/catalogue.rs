//! Values of every describing function at the example of its page.

use std::fmt::Write;

use selfosc::describing::{CATALOGUE, over_amplitudes};

use crate::golden;

#[test]
fn values_of_the_catalogue() {
    let mut table = String::new();
    for entry in CATALOGUE {
        let example = entry.example().unwrap();
        let settings: Vec<String> =
            entry.settings(&example.values).iter().map(|(name, setting)| format!("{name} = {setting}")).collect();
        writeln!(table, "{}: {}", entry.name, settings.join("; ")).unwrap();
        let characteristic = entry.build(&example.values).unwrap();
        for bias in [0.0, 0.2 * example.amplitude] {
            let amplitudes = [0.5, 1.0, 2.0].map(|factor| factor * example.amplitude);
            for (amplitude, df) in amplitudes.into_iter().zip(over_amplitudes(&*characteristic, bias, amplitudes)) {
                match df {
                    // Digits that rounding cannot reach; a value that rounding alone keeps from zero is zero.
                    Ok(df) => {
                        let clean = |x: f64| if x.abs() < 1e-14 { 0.0 } else { x };
                        let [f0, p, q] = [df.f0, df.p, df.q].map(clean);
                        writeln!(
                            table,
                            "  B = {bias:<5.3} X = {amplitude:<6.3} F0 = {f0:<+18.10e} P = {p:<+18.10e} Q = {q:+.10e}"
                        )
                    }
                    Err(error) => writeln!(table, "  B = {bias:<5.3} X = {amplitude:<6.3} {error}"),
                }
                .unwrap();
            }
        }
    }
    golden!("catalogue", table);
}
