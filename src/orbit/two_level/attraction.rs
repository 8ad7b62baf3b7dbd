//! The return map of the loop, linearised with every command under way, over intervals.

use std::collections::VecDeque;

use nalgebra::{Complex, DMatrix, DVector, RowDVector, Schur};

use super::modes::Mode;
use super::path::Path;
use super::switching::SwitchedLoop;
use crate::numeric::Interval;
use crate::plant::eigenvalues;
use crate::proof::interval_matrix::{norm, solve};

/// Squarings of the return map, which has to shrink or to grow within `2^SQUARINGS` periods.
const SQUARINGS: u32 = 16;
/// The most commands under way that are followed: the map has as many dimensions more.
const UNDER_WAY: usize = 60;
/// Multipliers below this are rounding of zero.
const NONE: f64 = 1e-9;

type IntervalMatrix = DMatrix<Interval>;

#[derive(Clone, Copy)]
enum LoopEvent {
    Command { slope: Interval },
    Input { jump: Interval },
}

fn order(modes: &[Mode]) -> usize {
    modes.iter().map(|mode| mode.algebra.degree).sum()
}

/// Places of the groups' states among all.
fn places(modes: &[Mode]) -> impl Iterator<Item = (usize, &Mode)> {
    modes.iter().scan(0, |place, mode| Some((core::mem::replace(place, *place + mode.algebra.degree), mode)))
}

fn flow(modes: &[Mode], time: Interval) -> IntervalMatrix {
    let mut matrix = DMatrix::zeros(order(modes), order(modes));
    for (place, Mode { algebra, .. }) in places(modes) {
        let group = algebra.matrix(&algebra.exponential(time));
        matrix.view_mut((place, place), group.shape()).copy_from(&group);
    }
    matrix
}

/// The whole number below every time of an interval over the period.
fn whole(time: Interval, period: Interval) -> Option<f64> {
    if time.upper() == 0.0 {
        return Some(0.0);
    }
    let turns = time / period;
    let (low, high) = (libm::floor(turns.lower()), libm::floor(turns.upper()));
    (low >= high && high < 1e6).then_some(low)
}

impl SwitchedLoop {
    /// The return map from a passage of the lower level to the next: the deviation of the plant's state and of the
    /// instants of the commands under way. `None` where events cannot be put in order, or too many commands are under way.
    fn return_map(&self, path: &Path<'_>) -> Option<IntervalMatrix> {
        let [high, period] = [path.times.high, path.times.period].map(|time| time.value());
        let [falling, rising] = path.slopes();
        if !falling.is_negative() || !rising.is_positive() {
            return None;
        }
        let jump = self.high - self.low;
        let (first, second) = (whole(self.delay, period)?, whole(self.delay + high, period)?);
        let under_way = (first + second) as usize;
        if under_way > UNDER_WAY {
            return None;
        }
        let order = order(&self.modes);
        let size = order + under_way;
        let at = |turns: f64, time: Interval| time - Interval::point(turns) * period;
        // A command comes before an input at the same time.
        let mut events = [
            (Interval::ZERO, LoopEvent::Command { slope: falling }),
            (high, LoopEvent::Command { slope: rising }),
            (at(first, self.delay), LoopEvent::Input { jump }),
            (at(second, self.delay + high), LoopEvent::Input { jump: -jump }),
        ];
        events.sort_by(|a, b| a.0.midpoint().total_cmp(&b.0.midpoint()));
        let undelayed = self.delay.upper() == 0.0;
        if !undelayed && events.windows(2).any(|pair| !pair[0].0.precedes(pair[1].0)) {
            return None;
        }
        let output = self.modes.iter().flat_map(Mode::output_row).copied();
        let output = RowDVector::from_iterator(order, output);
        let identity = IntervalMatrix::identity(size, size);
        let mut state = identity.rows(0, order).into_owned();
        let mut queue: VecDeque<RowDVector<Interval>> =
            (order..size).map(|row| identity.row(row).into_owned()).collect();
        let mut now = Interval::ZERO;
        for (time, event) in events {
            if time.midpoint() > now.midpoint() {
                state = flow(&self.modes, time - now) * state;
            }
            now = time;
            match event {
                LoopEvent::Command { slope } => queue.push_back((&output * &state) * (-Interval::ONE / slope)),
                LoopEvent::Input { jump } => {
                    if let Some(late) = queue.pop_front() {
                        // A unit of input raises the first coordinate of every group.
                        let late = late * jump;
                        for (place, _) in places(&self.modes) {
                            let mut moved = state.row_mut(place);
                            moved -= &late;
                        }
                    }
                }
            }
        }
        state = flow(&self.modes, period - now) * state;
        let mut map = IntervalMatrix::zeros(size, size);
        map.rows_mut(0, order).copy_from(&state);
        for (row, late) in queue.iter().take(under_way).enumerate() {
            map.row_mut(order + row).copy_from(late);
        }
        // Deviations along the orbit are none: the passages of the level are compared.
        let along = DVector::from_vec(path.rates()).resize_vertically(size, -Interval::ONE);
        let passed = output.map(|entry| entry / falling) * state;
        Some(map - along * passed)
    }

    /// Eigenvalues of the return map, largest first, computed, without the zeros; and whether all are shown to be inside the
    /// unit circle, or at least 1 outside.
    pub(super) fn attraction(&self, path: &Path<'_>) -> (Vec<Complex<f64>>, Option<bool>) {
        let Some(map) = self.return_map(path).filter(|map| norm(map).is_finite()) else { return (Vec::new(), None) };
        // Printed only: the proof rests on the powers of the map.
        let mut multipliers = eigenvalues(&map.map(Interval::midpoint)).unwrap_or_default();
        multipliers.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
        let largest = multipliers.first().map_or(0.0, |one| one.norm());
        multipliers.retain(|one| one.norm() > NONE * largest.max(1.0));
        (multipliers, shrinks(&map))
    }
}

/// A power of the map shrinks every vector in the norm of the largest component: true. Its trace exceeds its size,
/// hence an eigenvalue exceeds 1 in magnitude: false.
fn shrinks(map: &IntervalMatrix) -> Option<bool> {
    // The same map in the basis of computed Schur vectors, in which its powers stay narrow.
    let vectors =
        Schur::try_new(map.map(Interval::midpoint), f64::EPSILON, 100 * map.nrows()).map(|schur| schur.unpack().0);
    let turned = vectors.and_then(|vectors| {
        let vectors = vectors.map(Interval::point);
        solve(vectors.clone(), map * vectors)
    });
    let mut power = turned.unwrap_or_else(|| map.clone());
    for _ in 0..=SQUARINGS {
        if norm(&power) < 1.0 {
            return Some(true);
        }
        let trace = power.diagonal().iter().fold(Interval::ZERO, |sum, &entry| sum + entry);
        if trace.lower() > power.nrows() as f64 || trace.upper() < -(power.nrows() as f64) {
            return Some(false);
        }
        power = &power * &power;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_shrinks_grows_or_is_open() {
        let of = |entries: [f64; 4]| IntervalMatrix::from_row_slice(2, 2, &entries.map(Interval::point));
        assert_eq!(shrinks(&of([0.9, 5.0, 0.0, 0.9])), Some(true));
        assert_eq!(shrinks(&of([0.8, 0.8, -0.8, 0.8])), Some(false));
        assert_eq!(shrinks(&of([1.0, 0.0, 0.0, 0.5])), None);
    }
}
