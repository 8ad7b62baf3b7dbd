//! The drag laws a model can have.

/// How the drag force depends on speed v.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DragLaw {
    /// Force proportional to v (the paper's constant drag coefficient).
    Linear,
    /// Force proportional to v |v| (the paper's drag coefficient linear in speed).
    Quadratic,
    /// The sum of both.
    Mixed,
}
