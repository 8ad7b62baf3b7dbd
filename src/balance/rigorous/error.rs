//! Why nothing is asked, or nothing is shown.

/// Why the question cannot be put.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExistenceError {
    /// The characteristic is not odd, jumps, has memory, or its slope is unknown.
    #[error(
        "{name} is no odd characteristic of bounded slope; the proof knows saturation, dead-zone, dead-zone-saturation, gain-changing, \
         tanh and polynomials of odd powers"
    )]
    Characteristic {
        /// Catalogue name.
        name: String,
    },
    /// The plant does not damp high harmonics.
    #[error("the plant's numerator has degree {degree}, as its denominator; the proof needs a strictly proper plant")]
    Feedthrough {
        /// Degree of both.
        degree: usize,
    },
    /// A document that is no box of a loop.
    #[error("no proof of an oscillation: {text}; write it anew with selfosc balance --certificates DIR")]
    Malformed {
        /// Its fault.
        text: String,
    },
    /// The box of a document is not shown to hold an oscillation.
    #[error("the box is not shown to hold an oscillation; {0}")]
    NotShown(#[from] CannotTell),
    /// A document that claims less than its own remainder.
    #[error(
        "the harmonics above the listed ones may have {shown:.3e} as root mean square, the document says {claimed:.3e}"
    )]
    Remainder {
        /// Upper bound that the box shows.
        shown: f64,
        /// The document's.
        claimed: f64,
    },
}

crate::numeric::codes! { pub ExistenceError {
    Characteristic => "no-bounded-slope", Feedthrough => "feedthrough", Malformed => "no-oscillation-proof",
    NotShown => "oscillation-not-shown", Remainder => "remainder",
} }

/// Why no oscillation is shown to exist. None of these excludes an oscillation.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CannotTell {
    /// The plant damps the high harmonics too little: `1/G(jkw)` is nearer to the slopes' middle than half their range.
    #[error(
        "rho: the distance of 1/G from the slopes' middle, {rho:.4}, does not exceed half their range, {slope_radius:.4}"
    )]
    Rho {
        /// Lower bound of the distance over all high harmonics, output units per input unit.
        rho: f64,
        /// Half the range of the slopes, output units per input unit.
        slope_radius: f64,
    },
    /// The input touches a kink, or passes it too slowly.
    #[error("grazing: near phase {theta_rad:.4} rad the input touches a kink or passes it too slowly")]
    Grazing {
        /// Phase, rad.
        theta_rad: f64,
    },
    /// The input may leave the range on which the slopes are bounded.
    #[error("range: the input may reach {reach:.4}, the slopes are bounded up to {limit:.4}")]
    Range {
        /// Largest input that is possible.
        reach: f64,
        /// The range.
        limit: f64,
    },
    /// The box is not mapped into itself.
    #[error("no contraction: a side of the box grows {ratio:.3} times, not below 1")]
    NoContraction {
        /// Largest ratio of an image's side to the side.
        ratio: f64,
    },
    /// Newton's method finds no balance of more harmonics.
    #[error("no balance: Newton's method finds no balance of more harmonics near")]
    NoBalance,
}

crate::numeric::codes! { pub CannotTell {
    Rho => "rho", Grazing => "grazing", Range => "beyond-range", NoContraction => "no-contraction",
    NoBalance => "no-near-balance",
} }
