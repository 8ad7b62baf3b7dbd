//! Covariance of the estimates.
//!
//! With Gaussian noise it is the inverse of the information. A rounding sensor is another matter: on a steady cycle its
//! errors repeat from cycle to cycle, and do not average out. There the errors are drawn: the model's own readings on
//! motions within about a step of the fitted motion, mapped by the same linear equations.

use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

use super::condensing::{CondensedChain, OWN, solve_shared};
use super::gauss_newton::{GaussNewton, LinearisedTrajectory, ShotTrajectory, stack};
use super::noise::{ReadingNoise, ScoreTable};
use super::sensitivity::{OutputSensitivity, SHARED};
use crate::identify::answer::IdentifyError;

/// Draws of the rounding errors: enough for standard deviations within a tenth.
const DRAWS: usize = 72;

/// Covariances of the errors.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Covariance {
    /// Of the common unknowns; zero where fixed.
    pub(super) shared: [[f64; SHARED]; SHARED],
    /// Variance of each record's disturbance.
    pub(super) disturbance: Vec<f64>,
}

impl Covariance {
    pub(super) fn of(search: &GaussNewton<'_>, linearised: &[LinearisedTrajectory]) -> Result<Self, IdentifyError> {
        let mut fixed = search.fixed();
        for (fixed, value) in fixed.iter_mut().zip(search.shared) {
            if value == 0.0 {
                *fixed = Some(0.0);
            }
        }
        let rounded = search.motions.iter().any(|motion| motion.noise.quantum > 0.0);
        let errors = if rounded { drawn(search, linearised, &fixed)? } else { unit(search, linearised, &fixed)? };
        let mean = |sum: f64| if rounded { sum / DRAWS as f64 } else { sum };
        let mut shared = [[0.0; SHARED]; SHARED];
        for (i, row) in shared.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value = mean(errors.iter().map(|(common, _)| common[i] * common[j]).sum());
            }
        }
        let disturbance =
            (0..search.motions.len()).map(|k| mean(errors.iter().map(|(_, own)| own[k] * own[k]).sum())).collect();
        Ok(Self { shared, disturbance })
    }
}

/// One error: of the common unknowns, and of each record's disturbance.
type Errors = Vec<([f64; SHARED], Vec<f64>)>;

/// Errors whose squares add up to the inverse of the information: an error vector for each independent direction.
fn unit(
    search: &GaussNewton<'_>,
    linearised: &[LinearisedTrajectory],
    fixed: &[Option<f64>; SHARED],
) -> Result<Errors, IdentifyError> {
    let chains: Vec<CondensedChain> = search
        .motions
        .iter()
        .zip(linearised)
        .map(|(motion, rows)| CondensedChain::new(&motion.links(rows, 0, |_, _| Vec::new(), Vec::new)))
        .collect();
    let stacked = stack(chains.iter());
    let (_, triangle) = solve_shared(&stacked, fixed)?;
    let free: Vec<usize> = (0..SHARED).filter(|k| fixed[*k].is_none()).collect();
    let mut errors = Errors::new();
    // Columns of the inverse triangle, each carried on to the disturbances.
    for column in 0..free.len() {
        let mut common = [0.0; SHARED];
        for row in (0..=column).rev() {
            let known: f64 = (row + 1..=column).map(|k| triangle[(row, k)] * common[free[k]]).sum();
            let unit = if row == column { 1.0 } else { 0.0 };
            common[free[row]] = (unit - known) / triangle[(row, row)];
        }
        let own = chains.iter().map(|chain| -> f64 {
            // The disturbance is the last of the record's own: its row has it and the common unknowns only.
            let rows = chain.own_triangle();
            let sum: f64 = (0..SHARED).map(|k| rows[(OWN - 1, OWN + k)] * common[k]).sum();
            -sum / rows[(OWN - 1, OWN - 1)]
        });
        errors.push((common, own.collect()));
    }
    for (index, chain) in chains.iter().enumerate() {
        let mut own = vec![0.0; chains.len()];
        own[index] = 1.0 / chain.own_triangle()[(OWN - 1, OWN - 1)];
        errors.push(([0.0; SHARED], own));
    }
    Ok(errors)
}

/// Errors sampled from readings of motions near the fitted motion.
fn drawn(
    search: &GaussNewton<'_>,
    linearised: &[LinearisedTrajectory],
    fixed: &[Option<f64>; SHARED],
) -> Result<Errors, IdentifyError> {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let mut chains = Vec::with_capacity(linearised.len());
    for (motion, rows) in search.motions.iter().zip(linearised) {
        let values = || rows.rows.iter().flatten().map(|(_, model)| model.value);
        let range = values().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let shifts: Vec<Shift> = (0..DRAWS).map(|_| Shift::draw(motion, range, &mut random)).collect();
        let mut noise_source = Pcg64Mcg::seed_from_u64(2);
        let mut prior_source = Pcg64Mcg::seed_from_u64(3);
        let noise = ReadingNoise { std: motion.real_noise(rows), quantum: motion.noise.quantum };
        let scores = ScoreTable::new(motion.noise);
        let side = |model: &OutputSensitivity, weight: f64| {
            shifts
                .iter()
                .map(|shift| {
                    let disturbed: f64 = StandardNormal.sample(&mut noise_source);
                    let residual = noise.reading_error(shift.of(model.value), disturbed);
                    scores.at(residual) / weight
                })
                .collect()
        };
        let prior = || {
            let root = 3f64.sqrt();
            (0..DRAWS).map(|_| prior_source.random_range(-root..root)).collect()
        };
        chains.push(CondensedChain::new(&motion.links(rows, DRAWS, side, prior)));
    }
    let stacked = stack(chains.iter());
    let (solutions, _) = solve_shared(&stacked, fixed)?;
    let mut errors = Errors::new();
    for (side, common) in solutions.into_iter().enumerate().skip(1) {
        let mut own = Vec::with_capacity(chains.len());
        for chain in &chains {
            own.push(chain.own(&common, side)?[OWN - 1]);
        }
        errors.push((common, own));
    }
    Ok(errors)
}

/// A change of the motion by up to half a step, in its middle and in its size.
struct Shift {
    offset: f64,
    growth: f64,
    middle: f64,
}

impl Shift {
    fn draw(motion: &ShotTrajectory<'_>, (low, high): (f64, f64), random: &mut Pcg64Mcg) -> Self {
        let mut part = || motion.noise.quantum * random.random_range(-0.5..0.5);
        let half = (0.5 * (high - low)).max(f64::MIN_POSITIVE);
        Self { offset: part(), growth: part() / half, middle: f64::midpoint(low, high) }
    }

    fn of(&self, output: f64) -> f64 {
        output + self.offset + self.growth * (output - self.middle)
    }
}
