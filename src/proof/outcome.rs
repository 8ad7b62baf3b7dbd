//! The result of a proof over a box: one type for identities, inequalities and kernels.

use core::fmt;

use crate::numeric::Interval;

/// A named variable with its range: the domain of a statement is a list of these.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Name in the statement; empty where the statement has fewer variables.
    pub name: &'static str,
    /// Lower end.
    pub lower: f64,
    /// Upper end, possibly infinite: then the statement must come out without subdivision.
    pub upper: f64,
}

impl Extent {
    /// Takes the place of a variable that there is not.
    pub const NONE: Self = Self { name: "", lower: 0.0, upper: 0.0 };

    /// A variable with its range.
    #[must_use]
    pub const fn new(name: &'static str, lower: f64, upper: f64) -> Self {
        Self { name, lower, upper }
    }
}

/// Verdict on a quantity over the whole domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Of an identity: both sides differ by no more than this.
    Residual(f64),
    /// Of an inequality: it holds with at least this to spare.
    Margin(f64),
}

impl Bound {
    /// The number.
    #[must_use]
    pub const fn value(self) -> f64 {
        match self {
            Self::Residual(value) | Self::Margin(value) => value,
        }
    }
}

/// A statement that was proved on a box, with the boxes that the proof divided it into.
#[derive(Clone, Debug, PartialEq)]
pub struct Proved<const N: usize> {
    /// Residual or margin.
    pub bound: Bound,
    /// Where.
    pub domain: [Interval; N],
    /// The boxes that make it up, in the order of the cuts, below before above.
    pub parts: Vec<[Interval; N]>,
    /// Boxes evaluated on the way, those that were divided further included.
    pub boxes: usize,
}

/// Why a statement is not proved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NotProved<const N: usize> {
    /// It is false at `witness`.
    Refuted {
        /// A point of the box.
        witness: [f64; N],
        /// The residual or margin there.
        value: Interval,
        /// Boxes evaluated.
        boxes: usize,
    },
    /// The budget did not suffice, or subdivision does not decide the statement.
    Undecided {
        /// A box that was not decided.
        at: [Interval; N],
        /// Boxes evaluated.
        boxes: usize,
    },
}

impl<const N: usize> fmt::Display for NotProved<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refuted { witness, value, .. } => write!(f, "false at {witness:?}: the value is {value}"),
            Self::Undecided { at, boxes } => {
                write!(f, "undecided after {boxes} boxes, on")?;
                at.iter().try_for_each(|side| write!(f, " {side}"))
            }
        }
    }
}

impl<const N: usize> core::error::Error for NotProved<N> {}
