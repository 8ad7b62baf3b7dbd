//! An answer of `selfosc balance --json` to a loop.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::loops::DescribingLoop;

/// A loop and the answer to it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Line {
    /// The loop.
    #[serde(rename = "loop")]
    pub control_loop: DescribingLoop,
    /// Wall time of the answer in s.
    #[serde(default)]
    pub seconds: Option<f64>,
    /// The document printed; `None` where there is none.
    pub answer: Option<Value>,
    /// What was said instead.
    #[serde(default)]
    pub refused: Option<String>,
}

/// The document.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Balance {
    /// Intersections of the first harmonic.
    pub intersections: Vec<Intersection>,
    /// Boxes in which an oscillation is proved to exist.
    #[serde(default)]
    pub proved: Option<Vec<Existence>>,
}

/// An intersection of the Nyquist curve with `-1/N`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Intersection {
    /// Amplitude.
    pub amplitude: f64,
    /// Frequency in rad/s.
    pub omega_rad_s: f64,
    /// The verdict.
    #[serde(default)]
    pub stable: Option<bool>,
    /// `multipliers` or `loeb`.
    #[serde(default)]
    pub stability_by: Option<String>,
    /// Rigorous describing function.
    #[serde(default)]
    pub existence: Option<Existence>,
}

/// A box, or why there is none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Existence {
    /// Whether an oscillation is proved to exist in the box; a box of `proved` says so by its place.
    #[serde(default)]
    pub shown: Option<bool>,
    /// Bounds of the first harmonic's amplitude.
    #[serde(default)]
    pub amplitude: Option<[f64; 2]>,
    /// Bounds of the frequency in rad/s.
    #[serde(default)]
    pub omega_rad_s: Option<[f64; 2]>,
    /// Why nothing is proved.
    #[serde(default)]
    pub reason: Option<String>,
}

/// Bounds of amplitude and frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Amplitude of the first harmonic.
    pub amplitude: [f64; 2],
    /// Frequency in rad/s.
    pub omega_rad_s: [f64; 2],
}

impl Balance {
    /// All boxes said to hold an oscillation, each once.
    #[must_use]
    pub fn boxes(&self) -> Vec<Bounds> {
        let at_intersections =
            self.intersections.iter().filter_map(|one| one.existence.as_ref()).filter(|one| one.shown == Some(true));
        let at_top = self.proved.iter().flatten().filter(|one| one.shown != Some(false));
        let bounds = |one: &Existence| Some(Bounds { amplitude: one.amplitude?, omega_rad_s: one.omega_rad_s? });
        at_top.chain(at_intersections).filter_map(bounds).fold(Vec::new(), |mut all, one| {
            if !all.contains(&one) {
                all.push(one);
            }
            all
        })
    }

    /// Reasons given for intersections without a box.
    #[must_use]
    pub fn reasons(&self) -> Vec<String> {
        self.intersections.iter().filter_map(|one| one.existence.as_ref()?.reason.clone()).collect()
    }
}

impl Bounds {
    /// Half the width of the amplitude's bounds over their middle.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        let [low, high] = self.amplitude;
        (high - low) / (high + low)
    }

    /// Whether the box holds these, each known to a relative uncertainty.
    #[must_use]
    pub fn holds(&self, amplitude: f64, omega: f64, uncertainty: f64) -> bool {
        let within = |[low, high]: [f64; 2], value: f64| {
            low <= value * (1.0 + uncertainty) && value * (1.0 - uncertainty) <= high
        };
        within(self.amplitude, amplitude) && within(self.omega_rad_s, omega)
    }
}
