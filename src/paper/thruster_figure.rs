//! Fig. 9 (b): thrust by command, fitted with eq. 2.

use super::PaperError;
use super::relay_figures::Curve;
use crate::vehicle::{DynamometerPoint, Thruster, ThrusterMap, pool_thrusters};

/// Readings of a dynamometer and the curve through them.
#[derive(Clone, Debug, PartialEq)]
pub struct Map9 {
    /// Command and thrust in N.
    pub readings: Curve,
    /// The fitted thruster's thrust in N by command.
    pub fitted: Curve,
    /// The fit.
    pub map: ThrusterMap,
}

/// Regenerates Fig. 9 (b) in kind: the paper prints no coefficients, so readings are those of this project's
/// [pool vehicle](crate::vehicle::pool_vehicle), rounded to 0.1 N as a spring balance has it.
///
/// # Errors
/// None in practice: the readings rise with the command.
pub fn figure9() -> Result<Map9, PaperError> {
    let thruster: Thruster<f64> = *pool_thrusters()?[0].thruster();
    let commands = || (-10..=10).map(|i| 20.0 * f64::from(i));
    let readings: Curve =
        commands().map(|command| (command, (thruster.thrust(command) * 10.0).round() / 10.0)).collect();
    let points: Vec<DynamometerPoint> =
        readings.iter().map(|&(command, thrust_n)| DynamometerPoint { command, thrust_n }).collect();
    let map = ThrusterMap::asymmetric(&points, 0.05)?;
    let fitted = (-400..=400).map(|i| f64::from(i) / 2.0).map(|command| (command, map.thruster.thrust(command)));
    Ok(Map9 { fitted: fitted.collect(), readings, map })
}
