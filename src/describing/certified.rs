//! Enclosures of describing functions by rigorous quadrature (Taylor models) of the output: no antiderivative, no closed form.

use super::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Branch, Characteristic, Sinusoid};
use crate::numeric::{Interval, Jet, Real};
use crate::proof::rigorous_quadrature::{CellJet, Integrand, integrate};

/// Width of each Fourier integral, relative to the largest output: what the result promises away from turning points.
const WIDTH: f64 = 4e-12;
/// What a kink at the angle t adds to it, over `cos t`: the input near it is known to a rounding, its angle to that over `cos t`.
const ROUNDINGS: f64 = 16.0 * f64::EPSILON;
/// Cells of one piece between two kinks; a smooth piece takes a handful, a kink not reported about a hundred.
const CELLS: usize = 4000;
/// Half the length of the cell that a kink at the angle t is trapped in, in radians, times `cos t`: a few roundings of the input.
const TRAP: f64 = 4e-15;

/// Enclosures of `F_0`, `P`, `Q`, with the work they took.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct Certified {
    /// Contains the exact values.
    pub enclosure: DescribingFunction<Interval>,
    /// Cells that the branches were divided into.
    pub cells: usize,
}

/// Encloses `F_0`, `P`, `Q` of any characteristic (eqs. 10, 13-15).
///
/// Sound whatever [`kinks`](Characteristic::kinks) reports: the angles of kinks only steer the division. The characteristic
/// is evaluated in Taylor jets over intervals, so parameters, bias and amplitude may be intervals themselves
/// ([`Jet::constant`]).
///
/// # Errors
/// [`DescribingError::Nonlinearity`] below the switching amplitude, [`DescribingError::NotFinite`] where the output may be
/// unbounded, [`DescribingError::Quadrature`] where an integral stays wider than 4e-12 of the largest output, and by 4e-15 over
/// its distance in radians for each kink near a turning point: parameters given as wide intervals.
///
/// ```
/// use selfosc::describing::certified;
/// use selfosc::nonlinearity::{Saturation, Sinusoid};
/// use selfosc::{numeric::Real, proof::rigorous_quadrature::CellJet};
/// let number = CellJet::from_f64;
/// let saturation = Saturation::new(number(2.0), number(0.7))?;
/// let found = certified(&saturation, &Sinusoid::new(number(0.3), number(1.5))?)?;
/// assert!(found.enclosure.p.width() < 1e-11 && found.enclosure.q.contains(0.0));
/// # Ok::<(), selfosc::describing::DescribingError>(())
/// ```
pub fn certified(
    characteristic: &(impl Characteristic<Number = CellJet> + ?Sized),
    sweep: &Sinusoid<CellJet>,
) -> Result<Certified, DescribingError> {
    characteristic.admits(sweep)?;
    let branches = BranchIntegrand { characteristic, sweep };
    let quarter = Interval::PI / Interval::two();
    let outputs = branches.outputs(Jet::constant(Interval::UNIT)).map(|output| output.value());
    if let Some(output) = outputs.into_iter().find(|output| !output.is_bounded()) {
        return Err(DescribingError::NotFinite { input: sweep.maximum().bounds().1, output: output.upper() });
    }
    let (ends, roundings) = branches.pieces(quarter);
    let wanted = (WIDTH + roundings) * outputs[0].magnitude().max(outputs[1].magnitude());
    let share = wanted / (2.0 * ends.len() as f64);
    let (mut integrals, mut cells) = ([Interval::ZERO; 3], 0);
    for pair in ends.windows(2) {
        let piece = integrate(&branches, pair[0], pair[1], share, CELLS);
        cells += piece.cells;
        for (sum, integral) in integrals.iter_mut().zip(piece.integrals) {
            *sum += integral;
        }
    }
    let estimate = integrals.iter().map(|integral| integral.width()).fold(0.0, f64::max);
    if estimate > wanted {
        return Err(DescribingError::Quadrature { estimate, tolerance: wanted, cells });
    }
    let [mean, sine, cosine] = integrals;
    let gain = Interval::PI * sweep.amplitude().value();
    let f0 = mean / (Interval::two() * Interval::PI);
    Ok(Certified { enclosure: DescribingFunction { f0, p: sine / gain, q: cosine / gain }, cells })
}

/// Output on the rising branch, at the angle t, and on the falling one, at `pi - t`; t from `-pi/2` to `pi/2`.
struct BranchIntegrand<'a, C: ?Sized> {
    characteristic: &'a C,
    sweep: &'a Sinusoid<CellJet>,
}

impl<C: Characteristic<Number = CellJet> + ?Sized> BranchIntegrand<'_, C> {
    fn outputs(&self, sine: CellJet) -> [CellJet; 2] {
        let x = self.sweep.bias() + self.sweep.amplitude() * sine;
        let output = |branch| self.characteristic.output(x, branch, self.sweep);
        let rising = output(Branch::Rising);
        [rising, if self.characteristic.has_memory() { output(Branch::Falling) } else { rising }]
    }

    /// The output weighted with 1, sine and cosine of its angle, both branches together.
    fn weighted(&self, t: CellJet) -> [CellJet; 3] {
        let (sine, cosine) = t.sin_cos();
        let [rising, falling] = self.outputs(sine);
        let sum = rising + falling;
        let turned = if self.characteristic.has_memory() { (rising - falling) * cosine } else { Jet::zero() };
        [sum, sum * sine, turned]
    }

    /// Ends of the pieces into which the traps of the reported kinks divide the branch, and what the kinks add to the width.
    fn pieces(&self, quarter: Interval) -> (Vec<Interval>, f64) {
        let number = |jet: CellJet| jet.value().midpoint();
        let (bias, maximum, minimum) =
            (number(self.sweep.bias()), number(self.sweep.maximum()), number(self.sweep.minimum()));
        let mut angles = Vec::new();
        self.characteristic.kinks(self.sweep, &mut |kink| {
            let x = number(kink);
            let (above, below) = (maximum - x, x - minimum);
            if above > 0.0 && below > 0.0 {
                let half_chord = (above * below).sqrt();
                angles.push((libm::atan2(x - bias, half_chord), 2.0 * half_chord / (maximum - minimum)));
            }
        });
        angles.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut ends = vec![-quarter];
        let mut last = (-quarter).upper();
        let mut roundings = 0.0;
        for (angle, cosine) in angles {
            roundings += ROUNDINGS / cosine;
            let (from, to) = (angle - TRAP / cosine, angle + TRAP / cosine);
            if from > last && to < quarter.lower() {
                ends.extend([from, to].map(Interval::point));
                last = to;
            }
        }
        ends.push(quarter);
        (ends, roundings)
    }
}

impl<C: Characteristic<Number = CellJet> + ?Sized> Integrand<3> for BranchIntegrand<'_, C> {
    fn range(&self, t: Interval) -> [Interval; 3] {
        self.weighted(Jet::constant(t)).map(|jet| jet.value())
    }
    fn jet(&self, t: CellJet) -> Option<[CellJet; 3]> {
        Some(self.weighted(t))
    }
}
