//! Orbits as a file: the loop, the enclosures and the statements on each, checked without a search.

use serde::{Deserialize, Serialize};

use super::{OrbitListing, SwitchedLoop, TwoLevelRelay};
use crate::numeric::Interval;
use crate::orbit::OrbitError;
use crate::plant::TransferFunction;

const FORMAT: u32 = 1;
/// Orbits of a loop with their proofs: a reader needs their enclosures only, and no search. The plant's coefficients,
/// dead time and levels count as exactly the numbers given. It does not exclude orbits that are not listed.
///
/// ```
/// use selfosc::orbit::{OrbitCertificate, TwoLevelRelay, orbits};
/// use selfosc::plant::TransferFunction;
/// let plant = TransferFunction::new(&[2.0], &[30.0, 1.0])?.with_delay(4.0)?;
/// let relay = TwoLevelRelay::new(1.0, 0.0, 0.1)?.with_reference(1.2)?;
/// let listing = orbits(&plant, &relay, None)?;
/// let text = OrbitCertificate::new(&plant, &relay, &listing).to_string();
/// assert_eq!(text.parse::<OrbitCertificate>()?.check()?, listing.orbits.len());
/// let forged = text.replacen("30.0", "30.03", 1).parse::<OrbitCertificate>()?;
/// assert!(forged.check().is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OrbitCertificate {
    certificate: String,
    format: u32,
    statement: String,
    #[serde(rename = "loop")]
    numbers: LoopNumbers,
    orbits: Vec<OrbitBounds>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LoopNumbers {
    num: Vec<f64>,
    den: Vec<f64>,
    delay_s: f64,
    high: f64,
    low: f64,
    half_width: f64,
    reference: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct OrbitBounds {
    time_high_s: Interval,
    time_low_s: Interval,
    minimum: Interval,
    maximum: Interval,
    attracting: Option<bool>,
}

/// Why a certificate of orbits is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OrbitRefusal {
    /// The text is no certificate of orbits.
    #[error("{text}")]
    Malformed {
        /// Where and why reading failed.
        text: String,
    },
    /// The kind, the format or the statement is another.
    #[error("another {field} than of this version")]
    Foreign {
        /// Which of them.
        field: &'static str,
    },
    /// No loop has these numbers.
    #[error("the loop: {0}")]
    Loop(#[from] OrbitError),
    /// A statement on an orbit is not shown.
    #[error("orbit {number}: not shown that {claim}")]
    NotShown {
        /// Place in the file, from 1.
        number: usize,
        /// The statement.
        claim: OrbitClaim,
    },
}

/// A statement of a certificate on an orbit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OrbitClaim {
    /// The box of half-periods holds those of an orbit.
    #[error("its box holds half-periods at whose ends the output passes the levels")]
    Existence,
    /// The relay switches at the ends of the half-periods and nowhere else.
    #[error("the relay switches nowhere else")]
    Switchings,
    /// The least and the largest output are within their bounds.
    #[error("its extremes are within their bounds")]
    Extremes,
    /// Small deviations die out, or grow.
    #[error("small deviations do what is said")]
    Attraction,
}

crate::numeric::codes! { pub OrbitClaim {
    Existence => "existence", Switchings => "switchings", Extremes => "extremes", Attraction => "attraction",
} }

crate::numeric::codes! { pub OrbitRefusal {
    Malformed => "malformed", Foreign => "foreign", Loop.0, NotShown.claim,
} }

impl OrbitCertificate {
    /// Name of this kind of certificate, in its field `certificate`.
    pub const KIND: &str = "two-level-orbits";
    /// The statement on each orbit.
    pub const STATEMENT: &str = "Each box of half-periods holds those of an orbit with one switching each way; its extremes are within their \
         bounds; small deviations from it die out (true), grow (false) or are not decided (null)";

    /// Of orbits that [`orbits`](super::orbits) lists. Enclosures are three times as wide as listed: rounding of another arithmetic
    /// fits.
    #[must_use]
    pub fn new(plant: &TransferFunction, relay: &TwoLevelRelay, listing: &OrbitListing) -> Self {
        let wider = |enclosure: Interval| enclosure + Interval::symmetric(enclosure.width());
        let TwoLevelRelay { high, low, half_width, reference } = *relay;
        let (num, den) = (plant.numerator().to_vec(), plant.denominator().to_vec());
        let bounds = listing.orbits.iter().map(|orbit| OrbitBounds {
            time_high_s: wider(orbit.time_high_s),
            time_low_s: wider(orbit.time_low_s),
            minimum: wider(orbit.minimum),
            maximum: wider(orbit.maximum),
            attracting: orbit.attracting,
        });
        Self {
            certificate: Self::KIND.to_owned(),
            format: FORMAT,
            statement: Self::STATEMENT.to_owned(),
            numbers: LoopNumbers { num, den, delay_s: plant.delay_s(), high, low, half_width, reference },
            orbits: bounds.collect(),
        }
    }

    /// The number of orbits, all shown anew: existence by Krawczyk's operator on the box, extremes and return map by enclosure.
    ///
    /// # Errors
    /// [`OrbitRefusal`] with the first statement that is not shown.
    pub fn check(&self) -> Result<usize, OrbitRefusal> {
        let own = [
            ("kind of certificate", self.certificate == Self::KIND),
            ("format", self.format == FORMAT),
            ("statement", self.statement == Self::STATEMENT),
        ];
        if let Some((field, _)) = own.into_iter().find(|(_, same)| !same) {
            return Err(OrbitRefusal::Foreign { field });
        }
        let LoopNumbers { num, den, delay_s, high, low, half_width, reference } = &self.numbers;
        let plant =
            TransferFunction::new(num, den).and_then(|plant| plant.with_delay(*delay_s)).map_err(OrbitError::from)?;
        let relay = TwoLevelRelay::new(*high, *low, *half_width)?.with_reference(*reference)?;
        let problem = SwitchedLoop::new(&plant, &relay)?;
        for (bounds, number) in self.orbits.iter().zip(1..) {
            let shown = problem.as_ref().ok_or(OrbitClaim::Existence).and_then(|problem| problem.shows(bounds));
            shown.map_err(|claim| OrbitRefusal::NotShown { number, claim })?;
        }
        Ok(self.orbits.len())
    }
}

crate::proof::document!(OrbitCertificate, OrbitRefusal, to_string_pretty);

impl SwitchedLoop {
    /// Shows the statements on an orbit, or names the first that is not shown.
    fn shows(&self, bounds: &OrbitBounds) -> Result<(), OrbitClaim> {
        let box_s = [bounds.time_high_s, bounds.time_low_s];
        let positive = box_s.iter().all(|side| side.is_positive() && side.is_bounded());
        let at = positive.then(|| self.solution_in(&box_s)).flatten().ok_or(OrbitClaim::Existence)?;
        let Ok(Some(orbit)) = self.orbit(&at) else { return Err(OrbitClaim::Switchings) };
        let within = at.iter().zip(&box_s).all(|(side, bound)| side.is_subset_of(*bound));
        let extremes = orbit.minimum.is_subset_of(bounds.minimum) && orbit.maximum.is_subset_of(bounds.maximum);
        let attracting = bounds.attracting.is_none() || bounds.attracting == orbit.attracting;
        let claims =
            [(within, OrbitClaim::Existence), (extremes, OrbitClaim::Extremes), (attracting, OrbitClaim::Attraction)];
        claims.into_iter().find(|(shown, _)| !shown).map_or(Ok(()), |(_, claim)| Err(claim))
    }
}
