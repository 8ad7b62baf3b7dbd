//! Several experiments of one vehicle: Table 4 jointly, recovery of made-up vehicles, what the errors claim.

use proptest::prelude::*;
use selfosc::identify::DragLaw;
use selfosc::identify::IdentifyError;
use selfosc::identify::iso::Oscillation;
use selfosc::identify::joint::{Delay, FeatureRow, Joint, Parameter, fit_rows};
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::limit_cycle;
use selfosc::plant::DragAxis;

use crate::tolerance;

/// The rows of Table 4 in its own units: degrees and 1e-2 N m.
fn table_4() -> Vec<FeatureRow> {
    let mut reader = csv::Reader::from_path(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/table4.csv")).unwrap();
    let columns = ["c_1e-2_n_m", "x_a_star_deg", "x_m_deg", "period_s"];
    let headers = reader.headers().unwrap().clone();
    let places = columns.map(|name| headers.iter().position(|header| header == name).unwrap());
    let row = |record: csv::StringRecord| {
        let [relay_level, switch_level, amplitude, period_s] =
            places.map(|place| record[place].parse::<f64>().unwrap());
        FeatureRow::new(&Oscillation { relay_level, switch_level, amplitude, bias: 0.0, period_s, delay_s: 0.0 })
    };
    reader.records().map(|record| row(record.unwrap()).unwrap()).collect()
}

#[test]
fn show() {
    let rows = table_4();
    for delay in [Delay::KnownS(0.0), Delay::KnownS(0.2), Delay::Estimated] {
        for law in [DragLaw::Linear, DragLaw::Quadratic, DragLaw::Mixed] {
            let now = std::time::Instant::now();
            let joint = fit_rows(&rows, law, delay);
            println!("{:?} {law:?} {delay:?}", now.elapsed());
            match joint {
                Ok(joint) => {
                    println!("  rms {} dof {}", joint.residual_rms() * 100.0, joint.degrees_of_freedom());
                    for p in [Parameter::Alpha, Parameter::LinearDrag, Parameter::QuadraticDrag, Parameter::DelayS] {
                        println!("  {p:?} {:?}", joint.estimate(p));
                    }
                }
                Err(e) => println!("  {e}"),
            }
        }
    }
}
