//! A listing of orbits as `selfosc predict --num ... --json` prints it, one line of JSON for each loop asked.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::control_loop::RelayLoop;

/// A loop and the answer to it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Line {
    /// Seed of the loop; of its starts where the loop was not drawn.
    pub seed: u64,
    /// The loop.
    #[serde(rename = "loop")]
    pub control_loop: RelayLoop,
    /// Wall time of the answer in s.
    #[serde(default)]
    pub seconds: Option<f64>,
    /// The document printed; `None` where there is none.
    pub answer: Option<Value>,
    /// What was said instead.
    #[serde(default)]
    pub refused: Option<String>,
}

/// The listing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Listing {
    /// Orbits with one switching each way.
    pub orbits: Vec<ListedOrbit>,
    /// Whether all orbits in the range of periods are listed.
    #[serde(default)]
    pub complete: Option<bool>,
    /// Ranges of periods in s that are not covered; a missing end is open.
    #[serde(default)]
    pub not_covered: Vec<[Option<f64>; 2]>,
    /// Range of periods in s that was asked for; all periods without it.
    #[serde(default)]
    pub range_s: Option<[Option<f64>; 2]>,
}

/// One orbit of a listing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ListedOrbit {
    /// Period in s.
    pub period_s: f64,
    /// Time at the upper level in s.
    pub time_high_s: f64,
    /// Time at the lower level in s.
    pub time_low_s: f64,
    /// Half the peak-to-peak output.
    #[serde(default)]
    pub amplitude: Option<f64>,
    /// Middle of the output's extremes.
    #[serde(default)]
    pub bias: Option<f64>,
    /// Multipliers of the return map over a period: numbers, or pairs of real and imaginary part.
    #[serde(default)]
    pub multipliers: Vec<Multiplier>,
    /// The verdict.
    #[serde(default)]
    pub attracting: Option<bool>,
    /// `proved` or `not proved`.
    #[serde(default)]
    pub shown: Option<String>,
    /// Bounds by field.
    #[serde(default)]
    pub enclosure: Option<BTreeMap<String, Value>>,
}

/// A multiplier as printed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Multiplier {
    /// A real one.
    Real(f64),
    /// Real and imaginary part.
    Pair([f64; 2]),
    /// The same by name.
    Named {
        /// Real part.
        re: f64,
        /// Imaginary part.
        im: f64,
    },
}

impl Multiplier {
    /// Modulus.
    #[must_use]
    pub fn modulus(self) -> f64 {
        match self {
            Self::Real(real) => real.abs(),
            Self::Pair([re, im]) | Self::Named { re, im } => re.hypot(im),
        }
    }
}

fn holds(range: &[Option<f64>; 2], value: f64) -> bool {
    range[0].is_none_or(|low| low <= value) && range[1].is_none_or(|high| value <= high)
}

impl Listing {
    /// Whether the listing says that all orbits of about this period are in it.
    #[must_use]
    pub fn covers(&self, period_s: f64) -> bool {
        let says = self.complete == Some(true) || !self.not_covered.is_empty();
        let asked = self.range_s.as_ref().is_none_or(|range| holds(range, period_s));
        says && asked && !self.not_covered.iter().any(|range| holds(range, period_s))
    }
}

impl ListedOrbit {
    /// Bounds of a field, where the enclosure has them.
    #[must_use]
    pub fn bounds(&self, field: &str) -> Option<[f64; 2]> {
        let bounds = self.enclosure.as_ref()?.get(field)?.as_array()?;
        match bounds.as_slice() {
            [low, high] => Some([low.as_f64()?, high.as_f64()?]),
            _ => None,
        }
    }

    /// Whether it is said to be proved.
    #[must_use]
    pub fn proved(&self) -> bool {
        self.shown.as_deref() == Some("proved")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_document_of_the_contract_is_read() {
        let text = r#"{"orbits":[{"period_s":4.0,"time_high_s":2.0,"time_low_s":2.0,"amplitude":1.0,"bias":0.0,
            "multipliers":[-0.25,[0.3,0.4]],"attracting":true,"shown":"proved","enclosure":{"period_s":[3.9,4.1]}}],
            "complete":false,"not_covered":[[0.0,0.5],[90,null]]}"#;
        let listing: Listing = serde_json::from_str(text).unwrap();
        assert!(listing.covers(4.0) && !listing.covers(0.3) && !listing.covers(100.0));
        let orbit = &listing.orbits[0];
        assert_eq!(orbit.bounds("period_s"), Some([3.9, 4.1]));
        assert_eq!(orbit.multipliers.iter().map(|one| one.modulus()).fold(0.0, f64::max), 0.5);
        assert!(!Listing::default().covers(1.0), "a listing that says nothing covers nothing");
    }
}
