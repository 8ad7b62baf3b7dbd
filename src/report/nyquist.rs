//! The Nyquist plot of a harmonic balance: the plant's curve and -1/N of the characteristic.

use nalgebra::Complex;

use super::{Figure, Mark, Panel};
use crate::balance::{BalanceError, Intersection, negative_inverse_locus, nyquist_locus};
use crate::describing::{DescribingError, DescribingFunction};
use crate::nonlinearity::Sinusoid;
use crate::numeric::significant;
use crate::plant::TransferFunction;

/// How far beyond the intersections (or beyond -1 without any) the plot reaches.
const REACH: f64 = 2.5;
/// Intersections that the legend has room for.
const LABELLED: usize = 4;

/// `G(jw)` over `omega_rad_s`, `-1/N` over amplitudes from 1e-3 to 1e3 at one bias, and the `found` intersections, as far from
/// the origin as two and a half times the farthest of them. The four slowest are labelled with period, amplitude and verdict.
///
/// # Errors
/// [`BalanceError`] where a curve cannot be followed.
pub fn nyquist(
    plant: &TransferFunction,
    omega_rad_s: core::ops::RangeInclusive<f64>,
    describing: impl Fn(&Sinusoid<f64>) -> Result<DescribingFunction<f64>, DescribingError>,
    bias: f64,
    found: &[Intersection],
) -> Result<Figure, BalanceError> {
    let mut marks: Vec<(&Intersection, Complex<f64>)> =
        found.iter().filter_map(|one| Some((one, plant.response(one.omega_rad_s).ok()?))).collect();
    let reach = REACH * marks.iter().map(|(_, point)| point.norm()).fold(0.0, f64::max);
    let reach = if reach > 0.0 { reach } else { REACH };
    let curve = |points: Vec<(f64, Complex<f64>)>| {
        points
            .into_iter()
            .map(|(_, z)| (z.re, z.im))
            .filter(move |(re, im)| libm::hypot(*re, *im) <= reach)
            .collect::<Vec<_>>()
    };
    let response = curve(nyquist_locus(plant, omega_rad_s)?);
    let inverse = curve(negative_inverse_locus(describing, bias, 1e-3..=1e3)?);
    let (growing, rising) = (direction(&inverse), direction(&response));
    let axes = Panel::new("real part", "imaginary part")
        .equal_axes()
        .with("G(jw), arrow towards higher w", Mark::Line, response)
        .with("", Mark::Arrow, rising);
    let axes = if inverse.is_empty() {
        axes
    } else {
        axes.with("-1/N(X), arrow towards larger X", Mark::Dashed, inverse).with("", Mark::Arrow, growing)
    };
    marks.sort_by(|(a, _), (b, _)| a.omega_rad_s.total_cmp(&b.omega_rad_s));
    let (slow, fast) = marks.split_at(marks.len().min(LABELLED));
    let panel = slow.iter().fold(axes, |panel, (one, point)| {
        let stable = one.stable.map_or("not decided", |stable| if stable { "stable" } else { "unstable" });
        let period_s = core::f64::consts::TAU / one.omega_rad_s;
        let label = format!("T = {} s, X = {}, {stable}", significant(period_s, 4), significant(one.amplitude, 4));
        panel.with(&label, Mark::Dots, [(point.re, point.im)])
    });
    let panel = match fast.len() {
        0 => panel,
        more => panel.with(&format!("{more} faster"), Mark::Points, fast.iter().map(|(_, point)| (point.re, point.im))),
    };
    let caption =
        "Where the curves cross, an oscillation is predicted: its frequency from G(jw), its amplitude X from -1/N(X).";
    Ok(Figure { name: "nyquist", title: "Harmonic balance: G(jw) = -1/N(X)".to_owned(), caption, panels: vec![panel] })
}

/// Two points near the middle of a curve's length, in its direction; none of a curve without length.
pub(super) fn direction(curve: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let step = |pair: &[(f64, f64)]| libm::hypot(pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
    let half = 0.5 * curve.windows(2).map(step).sum::<f64>();
    let mut length = 0.0;
    let middle = curve.windows(2).find(|pair| {
        length += step(pair);
        length >= half && step(pair) > 0.0
    });
    middle.map_or_else(Vec::new, <[_]>::to_vec)
}
