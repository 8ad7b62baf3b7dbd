//! The drag laws a model can have.

/// How the drag force depends on speed v.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum DragLaw {
    /// Force proportional to v (the paper's constant drag coefficient).
    Linear,
    /// Force proportional to v |v| (the paper's drag coefficient linear in speed).
    Quadratic,
    /// The sum of both.
    Mixed,
}

impl DragLaw {
    /// All of them, the simplest first.
    pub const ALL: [Self; 3] = [Self::Linear, Self::Quadratic, Self::Mixed];

    /// Name on the command line and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Quadratic => "quadratic",
            Self::Mixed => "mixed",
        }
    }

    /// Whether part of the force is proportional to v.
    #[must_use]
    pub fn has_linear(self) -> bool {
        self != Self::Quadratic
    }

    /// Whether part of the force is proportional to v |v|.
    #[must_use]
    pub fn has_quadratic(self) -> bool {
        self != Self::Linear
    }
}
