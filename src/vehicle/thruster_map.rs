//! A thruster identified from dynamometer points (Fig. 9).

use crate::numeric::domain;
use nalgebra::{Matrix2, Vector2};

use super::{ThrustSide, Thruster, VehicleError};

/// One reading of the dynamometer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DynamometerPoint {
    /// Command held during the reading.
    pub command: f64,
    /// Steady thrust, N, with the sign of the pull ahead.
    pub thrust_n: f64,
}

/// Least-squares coefficients of `thrust = quadratic * n^2 + linear * n` for one or both sides, by magnitudes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedSide {
    /// Coefficient of the squared command, N per squared command.
    pub quadratic: f64,
    /// Coefficient of the command, N per command.
    pub linear: f64,
    /// Standard error of `quadratic`, for independent errors of equal size in the thrusts.
    pub quadratic_standard_error: f64,
    /// Standard error of `linear`, likewise.
    pub linear_standard_error: f64,
    /// Root of the residuals' square sum over the degrees of freedom, N: the spread of one reading.
    pub residual_n: f64,
    /// Points of the rotating propeller that were used.
    pub points: usize,
}

/// A thruster with the statistics of its fit.
///
/// ```
/// # use selfosc::vehicle::{DynamometerPoint, ThrusterMap, VehicleError};
/// let points: Vec<_> = (-10..=10)
///     .map(|i| f64::from(i) * 20.0)
///     .map(|command| {
///         let turns = command.abs() >= 30.0;
///         let thrust_n = if turns { 1.5e-4 * command.abs() * command + 0.01 * command } else { 0.0 };
///         DynamometerPoint { command, thrust_n }
///     })
///     .collect();
/// let map = ThrusterMap::affine(&points, 0.05)?;
/// assert!((map.forward.quadratic - 1.5e-4).abs() < 1e-12);
/// assert_eq!(map.thruster.forward().dead_zone(), 20.0); // the last command at which it stood
/// # Ok::<(), VehicleError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThrusterMap {
    /// The thruster, ready to compensate with; its limits are the largest commands measured.
    pub thruster: Thruster<f64>,
    /// Fit of the positive commands.
    pub forward: FittedSide,
    /// Fit of the negative commands; the same as `forward` for [`Self::affine`].
    pub backward: FittedSide,
}

/// The points of one side by magnitudes, and where the propeller starts and how far it was driven.
struct Side {
    turning: Vec<(f64, f64)>,
    dead_zone: f64,
    limit: f64,
}

impl ThrusterMap {
    /// Parameters of one fit.
    const PARAMETERS: usize = 2;

    /// The same coefficients for both directions (eq. 2).
    ///
    /// Points with less thrust than `standing_n` count as a standing propeller: they mark the dead zone (its end is taken at
    /// the last of them; the true dead zone may end up to a step of the commands further) and are excluded from the fit.
    ///
    /// # Errors
    /// [`VehicleError::Count`] with fewer than three points of a turning propeller, or none on one side;
    /// [`VehicleError::ThrustAgainstCommand`]; [`VehicleError::DeadZoneUnclear`]; [`VehicleError::RankDeficient`] when all
    /// commands have one magnitude; [`VehicleError::NotMonotone`] when the fitted thrust falls somewhere in the range.
    pub fn affine(points: &[DynamometerPoint], standing_n: f64) -> Result<Self, VehicleError> {
        let (ahead, astern) = sides(points, standing_n)?;
        for side in [&ahead, &astern] {
            require("points of the propeller turning on one side", side.turning.len(), 1)?;
        }
        let both: Vec<_> = ahead.turning.iter().chain(&astern.turning).copied().collect();
        let fitted = fit(&both)?;
        Self::assemble((ahead, fitted), (astern, fitted))
    }

    /// Coefficients of their own for each direction (eq. 3).
    ///
    /// # Errors
    /// Those of [`Self::affine`], with three points needed on each side.
    pub fn asymmetric(points: &[DynamometerPoint], standing_n: f64) -> Result<Self, VehicleError> {
        let (ahead, astern) = sides(points, standing_n)?;
        let (forward, backward) = (fit(&ahead.turning)?, fit(&astern.turning)?);
        Self::assemble((ahead, forward), (astern, backward))
    }

    fn assemble(ahead: (Side, FittedSide), astern: (Side, FittedSide)) -> Result<Self, VehicleError> {
        let side =
            |(side, fit): &(Side, FittedSide)| ThrustSide::new(fit.quadratic, fit.linear, side.dead_zone, side.limit);
        let thruster = Thruster::asymmetric(side(&ahead)?, side(&astern)?);
        Ok(Self { thruster, forward: ahead.1, backward: astern.1 })
    }
}

fn require(what: &'static str, count: usize, needed: usize) -> Result<(), VehicleError> {
    if count < needed { Err(VehicleError::Count { what, count, needed }) } else { Ok(()) }
}

/// Points ahead and astern, each checked.
fn sides(points: &[DynamometerPoint], standing_n: f64) -> Result<(Side, Side), VehicleError> {
    domain::non_negative("thrust of a standing propeller", standing_n, "N")?;
    for (index, &DynamometerPoint { command, thrust_n }) in points.iter().enumerate() {
        domain::finite("command of a dynamometer point", command, "command units")?;
        domain::finite("thrust of a dynamometer point", thrust_n, "N")?;
        if thrust_n.abs() > standing_n && thrust_n * command <= 0.0 {
            return Err(VehicleError::ThrustAgainstCommand { index, command, thrust_n });
        }
    }
    Ok((side(points, 1.0, standing_n)?, side(points, -1.0, standing_n)?))
}

fn side(points: &[DynamometerPoint], sign: f64, standing_n: f64) -> Result<Side, VehicleError> {
    let (turning, standing): (Vec<_>, Vec<_>) = points
        .iter()
        .map(|point| (sign * point.command, sign * point.thrust_n))
        .filter(|&(command, _)| command > 0.0)
        .partition(|&(_, thrust)| thrust > standing_n);
    let dead_zone = standing.iter().map(|&(command, _)| command).fold(0.0, f64::max);
    let turned_at = turning.iter().map(|&(command, _)| command).fold(f64::INFINITY, f64::min);
    if turned_at <= dead_zone {
        let (turned_at, stood_at) = (sign * turned_at, sign * dead_zone);
        return Err(VehicleError::DeadZoneUnclear { turned_at, stood_at, threshold_n: standing_n });
    }
    let limit = turning.iter().map(|&(command, _)| command).fold(0.0, f64::max);
    Ok(Side { turning, dead_zone, limit })
}

/// Linear least squares of thrust on `n^2` and `n`, with the covariance `s^2 (A'A)^-1`.
fn fit(points: &[(f64, f64)]) -> Result<FittedSide, VehicleError> {
    let what = "points of a turning propeller";
    require(what, points.len(), ThrusterMap::PARAMETERS + 1)?;
    // Commands as fractions of the largest keep the normal equations of two columns well conditioned.
    let scale = points.iter().fold(0.0, |largest, &(command, _)| command.max(largest));
    let row = |command: f64| Vector2::new((command / scale).powi(2), command / scale);
    let (normal, right) =
        points.iter().fold((Matrix2::zeros(), Vector2::zeros()), |(normal, right), &(command, thrust)| {
            let row = row(command);
            (normal + row * row.transpose(), right + row * thrust)
        });
    let independent = normal.determinant() > 1e-10 * normal.trace().powi(2);
    let inverse = normal.try_inverse().filter(|_| independent).ok_or(VehicleError::RankDeficient {
        what: "the matrix of squared commands and commands",
        rank: 1,
        needed: ThrusterMap::PARAMETERS,
    })?;
    let coefficients = inverse * right;
    let square_sum: f64 =
        points.iter().map(|&(command, thrust)| (thrust - row(command).dot(&coefficients)).powi(2)).sum();
    let variance = square_sum / (points.len() - ThrusterMap::PARAMETERS) as f64;
    let standard_error = |i: usize| (variance * inverse[(i, i)]).sqrt();
    Ok(FittedSide {
        quadratic: coefficients[0] / scale.powi(2),
        linear: coefficients[1] / scale,
        quadratic_standard_error: standard_error(0) / scale.powi(2),
        linear_standard_error: standard_error(1) / scale,
        residual_n: variance.sqrt(),
        points: points.len(),
    })
}
