//! All orbits of a linear plant with dead time under a two-level relay, with proof.
//!
//! A single switching each way in a period. Between switchings the output has a closed form: an orbit is a solution of
//! two equations in its two half-periods. They are solved in interval arithmetic over all periods of a range: an orbit
//! that is not listed does not exist, except in the sub-ranges named. Krawczyk's operator shows that an orbit exists
//! and is alone in its enclosure. The output, enclosed over the period, shows that the relay switches nowhere else.
//! Powers of the return map, with every command under way, show that deviations die out or grow.

mod algebra;
mod attraction;
mod certificate;
mod kernel;
mod modes;
mod path;
mod search;
mod switching;

use core::ops::RangeInclusive;

use nalgebra::Complex;

use super::OrbitError;
use crate::nonlinearity::RelayHysteresis;
use crate::numeric::{Interval, domain};
use crate::plant::TransferFunction;
pub use certificate::{OrbitCertificate, OrbitClaim, OrbitRefusal};
use path::Path;
use search::PeriodRange;
use switching::SwitchedLoop;

/// A relay with two levels: `low` from when the output rises past `reference + half_width`, `high` from when it falls past
/// `reference - half_width`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct TwoLevelRelay {
    /// Upper level, input units.
    pub high: f64,
    /// Lower level, input units.
    pub low: f64,
    /// Half the hysteresis, output units.
    pub half_width: f64,
    /// Middle of the hysteresis, output units.
    pub reference: f64,
}

impl TwoLevelRelay {
    /// A relay about the reference zero.
    ///
    /// # Errors
    /// [`OrbitError::OutOfDomain`] unless all are finite, `low < high` and `half_width >= 0`.
    pub fn new(high: f64, low: f64, half_width: f64) -> Result<Self, OrbitError> {
        domain::finite("upper level", high, "input units")?;
        domain::finite("lower level", low, "input units")?;
        let above = crate::numeric::Limit::Above(low);
        domain::require("upper level", high, "input units", above, "give HIGH,LOW with the larger level first")?;
        domain::non_negative("half-width", half_width, "output units")?;
        Ok(Self { high, low, half_width, reference: 0.0 })
    }

    /// The same about another reference.
    ///
    /// # Errors
    /// [`OrbitError::OutOfDomain`] unless it is finite.
    pub fn with_reference(self, reference: f64) -> Result<Self, OrbitError> {
        Ok(Self { reference: domain::finite("reference", reference, "output units")?, ..self })
    }
}

/// The levels are the offset plus and minus the level; the relay's input is the reference, here zero, less the output.
impl From<RelayHysteresis<f64>> for TwoLevelRelay {
    fn from(relay: RelayHysteresis<f64>) -> Self {
        let (offset, level) = (relay.offset(), relay.level());
        Self { high: offset + level, low: offset - level, half_width: relay.half_width(), reference: 0.0 }
    }
}

/// All orbits with a single switching each way, as far as the search reached.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct OrbitListing {
    /// The orbits, longest period first.
    pub orbits: Vec<ListedOrbit>,
    /// Range of periods searched, s; a missing end is open. It is the range asked for; without a range it begins where the search ended.
    pub range_s: [Option<f64>; 2],
    /// Sub-ranges of that range in which there may be unlisted orbits, s; a missing end is open.
    pub not_covered: Vec<[Option<f64>; 2]>,
}

impl OrbitListing {
    /// Whether every orbit in `range_s` is listed.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.not_covered.is_empty()
    }
}

/// An orbit that is shown to exist, enclosed. The plant's coefficients, dead time and levels count as exactly the numbers given.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct ListedOrbit {
    /// Period, s.
    pub period_s: Interval,
    /// Time per period with the upper level commanded, s.
    pub time_high_s: Interval,
    /// Time per period with the lower level commanded, s.
    pub time_low_s: Interval,
    /// The least output.
    pub minimum: Interval,
    /// The largest output.
    pub maximum: Interval,
    /// Eigenvalues of the return map, largest first, computed, not enclosed, without the zeros; empty where the map is
    /// not decided.
    pub multipliers: Vec<Complex<f64>>,
    /// Whether small deviations die out, where that is shown.
    pub attracting: Option<bool>,
}

impl ListedOrbit {
    /// Half the output's range.
    #[must_use]
    pub fn amplitude(&self) -> Interval {
        (self.maximum - self.minimum) * Interval::point(0.5)
    }
    /// Middle of the output's range.
    #[must_use]
    pub fn bias(&self) -> Interval {
        (self.maximum + self.minimum) * Interval::point(0.5)
    }
}

/// All orbits of `plant` under `relay` with a single switching each way in a period, from the slowest down; within a
/// range of periods in s, or all.
///
/// A dead time and a relay without hysteresis have infinitely many orbits, and a narrow hysteresis has very many: the search ends after
/// the five slowest. Then `range_s` of a search for all begins at the fifth; of a range asked for, the rest is not covered. An orbit
/// with several switchings each way is none of these.
///
/// ```
/// use selfosc::orbit::{TwoLevelRelay, orbits};
/// use selfosc::plant::TransferFunction;
/// let plant = TransferFunction::new(&[1.0], &[1.0, 1.0])?.with_delay(1.0)?;
/// let found = orbits(&plant, &TwoLevelRelay::new(1.0, -1.0, 0.0)?, None)?;
/// let slowest = &found.orbits[0];
/// assert!(slowest.period_s.contains(2.0 * (2.0 * 1f64.exp() - 1.0).ln()) && slowest.period_s.width() < 1e-13);
/// assert_eq!(slowest.attracting, Some(true));
/// assert!(found.orbits[1..].iter().all(|faster| faster.attracting == Some(false)));
/// assert!(found.is_complete() && found.range_s[0] > Some(0.2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`OrbitError::Plant`] for a plant that is not strictly proper; [`OrbitError::CrowdedPoles`];
/// [`OrbitError::NoHysteresis`] with neither hysteresis nor dead time and a relative degree below three; [`OrbitError::OutOfDomain`] for a range.
pub fn orbits(
    plant: &TransferFunction,
    relay: &TwoLevelRelay,
    period_s: Option<RangeInclusive<f64>>,
) -> Result<OrbitListing, OrbitError> {
    if let Some(range) = &period_s {
        domain::ascending(["shortest period", "longest period"], range, "s")?;
    }
    let range_s = period_s.as_ref().map_or([None; 2], |range| [Some(*range.start()), Some(*range.end())]);
    let mut listing = OrbitListing { orbits: Vec::new(), range_s, not_covered: Vec::new() };
    let Some(problem) = SwitchedLoop::new(plant, relay)? else { return Ok(listing) };
    let range = problem.range(period_s.as_ref());
    let mut open: Vec<Interval> = Vec::new();
    let found = problem.solutions(&range, |at| match problem.orbit(at) {
        Ok(orbit) => {
            listing.orbits.extend(orbit.clone());
            orbit.is_some()
        }
        Err(Undecided) => {
            open.push(at[0] + at[1]);
            false
        }
    });
    open.extend(found.not_covered);
    if let Some(from) = found.searched_from {
        if period_s.is_some() || from == f64::INFINITY {
            open.extend(Interval::new(range.shortest, from));
        } else {
            listing.range_s[0] = Some(from);
            open.retain(|periods| periods.upper() >= from);
        }
    }
    listing.orbits.sort_by(|a, b| b.period_s.midpoint().total_cmp(&a.period_s.midpoint()));
    listing.not_covered = merged(open);
    Ok(listing)
}

/// A solution that may be an orbit and may not.
struct Undecided;

impl SwitchedLoop {
    /// `None` where the output drifts, because the mean of an integrator's input cannot vanish.
    fn new(plant: &TransferFunction, relay: &TwoLevelRelay) -> Result<Option<Self>, OrbitError> {
        let TwoLevelRelay { high, low, half_width, reference } = *relay;
        // With a relative degree of 1 or 2 the ideal relay slides, or switches ever faster.
        let relative_degree = plant.denominator().len().saturating_sub(plant.numerator().len());
        if half_width == 0.0 && plant.delay_s() == 0.0 && relative_degree < 3 {
            return Err(OrbitError::NoHysteresis);
        }
        let modes = modes::modes(plant)?;
        let [high, low, half_width, reference, delay] =
            [high, low, half_width, reference, plant.delay_s()].map(Interval::point);
        let integrates = plant.is_integrating();
        if integrates && !(low.is_negative() && high.is_positive()) {
            return Ok(None);
        }
        let share = integrates.then(|| -low / (high - low));
        // With a pole at zero the output's constant is free.
        let (middle, shift) = if integrates { (Interval::ZERO, reference) } else { (reference, Interval::ZERO) };
        let (upper, lower) = (middle + half_width, middle - half_width);
        Ok(Some(Self { modes, delay, high, low, upper, lower, share, shift }))
    }

    /// The orbit of a solution of the switching conditions, if it is an orbit.
    fn orbit(&self, at: &search::HalfPeriods) -> Result<Option<ListedOrbit>, Undecided> {
        let path = Path::new(self, at)?;
        if !path.genuine()? {
            return Ok(None);
        }
        let [minimum, maximum] = path.extremes().ok_or(Undecided)?.map(|extreme| extreme + self.shift);
        let (multipliers, attracting) = self.attraction(&path);
        let [time_high_s, time_low_s] = *at;
        let period_s = time_high_s + time_low_s;
        Ok(Some(ListedOrbit { period_s, time_high_s, time_low_s, minimum, maximum, multipliers, attracting }))
    }

    /// The range of periods searched: from where a period is too short for the output to pass both levels.
    fn range(&self, period_s: Option<&RangeInclusive<f64>>) -> PeriodRange {
        // How long a group takes to decay, or an undamped group to turn a hundred times.
        let moving = self.modes.iter().filter(|mode| mode.inverse.is_some()).map(|mode| &mode.algebra);
        let times = moving.map(|group| 1.0 / group.shift.magnitude().max(0.01 * group.size()));
        let slowest = times.fold(self.delay.upper(), f64::max);
        // Double integrators without delay have no time but that of their hysteresis.
        let unit = if slowest > 0.0 { slowest } else { 1.0 };
        let (shortest, longest) = period_s.map_or((0.0, f64::INFINITY), |range| (*range.start(), *range.end()));
        PeriodRange { shortest: self.shortest_period().max(shortest), longest, unit }
    }
}

/// Ranges that touch joined, in order.
fn merged(mut ranges: Vec<Interval>) -> Vec<[Option<f64>; 2]> {
    ranges.sort_by(|a, b| a.lower().total_cmp(&b.lower()));
    let mut kept: Vec<Interval> = Vec::new();
    for range in ranges {
        match kept.last_mut() {
            Some(last) if range.lower() <= last.upper() => *last = last.hull(range),
            _ => kept.push(range),
        }
    }
    kept.into_iter().map(Into::into).collect()
}
