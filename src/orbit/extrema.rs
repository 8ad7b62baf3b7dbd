//! All extrema of a linear plant's output while its input is constant.

use nalgebra::{DMatrix, DVector, RowDVector};

use super::OrbitError;
use crate::plant::StateSpace;

/// Pieces of one interval beyond which isolation gives up.
const PIECES: usize = 100_000;
/// A change of the output that counts as none, relative to the scale given.
const FLAT: f64 = 1e-13;

/// Isolates the zeros of `y' = c exp(a t) w` on an interval from bounds of the next two derivatives.
///
/// With `m` the logarithmic norm of the matrix, `|exp(a t) w| <= exp(max(m, 0) t) |w|`; so `y'` has no zero on a piece of
/// length h where `|y'(left)| + |y'(right)|` exceeds `h` times the bound of `|y''|`, and exactly one where it changes sign
/// and the same holds of `y''` and `|y'''|`.
pub(super) struct Extrema<'a> {
    plant: &'a StateSpace,
    /// `c a` and the norms of `c a`, `c a a`.
    second: RowDVector<f64>,
    norms: (f64, f64),
    growth: f64,
    scale: f64,
}

#[derive(Clone)]
struct Piece {
    from: f64,
    length: f64,
    level: usize,
    left: DVector<f64>,
    right: DVector<f64>,
}

impl<'a> Extrema<'a> {
    /// `scale`: magnitude of the output against which a change counts as none.
    pub(super) fn new(plant: &'a StateSpace, scale: f64) -> Self {
        let second = plant.c() * plant.a();
        let third = &second * plant.a();
        let symmetric = (plant.a() + plant.a().transpose()) * 0.5;
        let growth = symmetric.symmetric_eigenvalues().max().max(0.0);
        Self { plant, norms: (second.norm(), third.norm()), second, growth, scale }
    }

    /// Times, from the interval's start, of all extrema inside it. A stretch over which the output changes by less than
    /// 1e-13 of the scale may be reported as one.
    pub(super) fn times(&self, start: &DVector<f64>, u: f64, duration: f64) -> Result<Vec<f64>, OrbitError> {
        let mut steps: Vec<DMatrix<f64>> = Vec::new();
        let left = self.plant.rate(start, u);
        let right = self.plant.flow(duration).state * &left;
        let mut stack = vec![Piece { from: 0.0, length: duration, level: 0, left, right }];
        let mut times = Vec::new();
        for _ in 0..PIECES {
            let Some(piece) = stack.pop() else { return Ok(times) };
            match self.zeros(&piece) {
                Zeros::None => continue,
                Zeros::One => times.push(piece.from + self.zero(&piece)),
                Zeros::Flat => times.push(piece.from + 0.5 * piece.length),
                Zeros::Unknown => {
                    let half = 0.5 * piece.length;
                    while steps.len() <= piece.level {
                        let length = duration * 0.5f64.powi(i32::try_from(steps.len()).unwrap_or(i32::MAX) + 1);
                        steps.push(self.plant.flow(length).state);
                    }
                    let middle = &steps[piece.level] * &piece.left;
                    let level = piece.level + 1;
                    let first = Piece { length: half, level, right: middle.clone(), ..piece.clone() };
                    stack.push(Piece { from: piece.from + half, length: half, level, left: middle, ..piece });
                    stack.push(first);
                }
            }
        }
        Err(OrbitError::TooManyPieces { limit: PIECES })
    }

    fn zeros(&self, piece: &Piece) -> Zeros {
        let size = piece.left.norm() * (self.growth * piece.length).exp();
        let (slope, curvature) = (|w: &DVector<f64>| self.plant.output(w), |w: &DVector<f64>| self.second.tr_dot(w));
        let (left, right) = (slope(&piece.left), slope(&piece.right));
        let bound = self.norms.0 * size * piece.length;
        if left * right > 0.0 && left.abs() + right.abs() > bound {
            return Zeros::None;
        }
        let (bend_left, bend_right) = (curvature(&piece.left), curvature(&piece.right));
        let steady =
            bend_left * bend_right > 0.0 && bend_left.abs() + bend_right.abs() > self.norms.1 * size * piece.length;
        if steady && left * right < 0.0 {
            return Zeros::One;
        }
        if steady && left * right > 0.0 {
            return Zeros::None;
        }
        if (left.abs() + bound) * piece.length <= FLAT * self.scale { Zeros::Flat } else { Zeros::Unknown }
    }

    /// The zero of `y'` inside a piece that has exactly one.
    fn zero(&self, piece: &Piece) -> f64 {
        let slope = |time: f64| Some(self.plant.output(&(self.plant.flow(time).state * &piece.left)));
        crate::numeric::scan::bracketed(slope, 0.0, piece.length).unwrap_or(0.5 * piece.length)
    }
}

enum Zeros {
    None,
    One,
    Flat,
    Unknown,
}
