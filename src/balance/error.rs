//! Why a harmonic balance cannot be computed.

use crate::describing::DescribingError;
use crate::nonlinearity::NonlinearityError;
use crate::numeric::OutOfDomain;
use crate::numeric::domain::{About, Plain};
use crate::plant::PlantError;

/// Why a harmonic balance cannot be computed. That there is no intersection is not an error but an empty answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BalanceError {
    /// The plant is at fault.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// The characteristic has no describing function here.
    #[error(transparent)]
    Describing(#[from] DescribingError),
    /// The characteristic or its input is at fault.
    #[error(transparent)]
    Nonlinearity(#[from] NonlinearityError),
    /// A bias, reference, disturbance or range outside its domain.
    #[error(transparent)]
    OutOfDomain(#[from] OutOfDomain),
    /// A curve with too many turns for its range.
    #[error(
        "the curve over {quantity} from {} to {} needs more than {limit} points; give a range that begins later or ends \
         earlier, or a plant whose times are nearer to each other", Plain(*.from), Plain(*.to)
    )]
    TooManyPoints {
        /// Amplitude or frequency.
        quantity: &'static str,
        /// Lower end.
        from: f64,
        /// Upper end.
        to: f64,
        /// The most there may be.
        limit: usize,
    },
    /// A number of harmonics out of range.
    #[error("{order} harmonics asked for, 1 to {limit} are possible; give a number in that range")]
    Order {
        /// The number asked for.
        order: usize,
        /// The most there may be.
        limit: usize,
    },
    /// Newton's method did not settle with more harmonics.
    #[error(
        "no balance found with {order} harmonics: the residual stays at {} of the amplitude; give another number of harmonics",
        About(*.residual)
    )]
    NotConverged {
        /// Number of harmonics.
        order: usize,
        /// Residual over amplitude.
        residual: f64,
    },
    /// A characteristic with memory whose input turns inside a period where the memory acts.
    #[error(
        "the input turns at {} within the range where the characteristic has memory, so that its output does not follow from the \
         input's range alone; give fewer harmonics, or simulate", About(*.input)
    )]
    TurnsInMemory {
        /// Input value of the turning point.
        input: f64,
    },
    /// No sinusoid balances a drag axis.
    #[error(
        "no sinusoid balances: it needs drag (linear_drag = {}, quadratic_drag = {}), a constant force ({}) below the relay \
         level {}, and a half-width ({}) or a delay above 0; change these",
        Plain(*.linear_drag), Plain(*.quadratic_drag), Plain(*.constant_force), Plain(*.level), Plain(*.half_width)
    )]
    NoAxisBalance {
        /// Linear drag, force per speed.
        linear_drag: f64,
        /// Quadratic drag, force per speed squared.
        quadratic_drag: f64,
        /// Disturbance plus relay offset, in force units.
        constant_force: f64,
        /// Relay level C, in force units.
        level: f64,
        /// Half-width of the hysteresis, in position units.
        half_width: f64,
    },
}

crate::numeric::codes! { pub BalanceError {
    Plant.0, Describing.0, Nonlinearity.0, OutOfDomain.0, TooManyPoints => "too-many-points", Order => "harmonics",
    NotConverged => "no-balance", TurnsInMemory => "turns-in-memory", NoAxisBalance => "no-axis-balance",
} }
