//! A listing of orbits judged: existence, verdicts, completeness.

use f256::f256;
use serde::Serialize;

use super::answer::{Line, ListedOrbit, Listing};
use super::attraction::{Fate, fate};
use super::orbit::{Absent, Orbit, Path};
use super::reached::{Attraction, Reached, reached};
use super::search::search;
use super::simulation::Simulator;
use crate::scalar::Scalar;

/// What a listing says and the judge denies.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Contradiction {
    /// The document is not a listing.
    #[error("the document is no listing: {0}")]
    Unreadable(String),
    /// A listed orbit does not exist.
    #[error("listed orbit of period {period_s} s does not exist: {why}")]
    Absent {
        /// Its period in s.
        period_s: f64,
        /// Why.
        why: Absent,
    },
    /// A number of a listed orbit is wrong.
    #[error("orbit of period {period_s} s: {field} is {exact}, not {listed}")]
    Value {
        /// Its period in s.
        period_s: f64,
        /// Name of the number.
        field: &'static str,
        /// What is listed.
        listed: f64,
        /// What is right.
        exact: f64,
    },
    /// An enclosure misses the number.
    #[error("orbit of period {period_s} s: {field} {exact} is outside [{low}, {high}]")]
    Enclosure {
        /// Its period in s.
        period_s: f64,
        /// Name of the number.
        field: &'static str,
        /// Lower bound listed.
        low: f64,
        /// Upper bound listed.
        high: f64,
        /// What is right.
        exact: f64,
    },
    /// The verdict on attraction is wrong.
    #[error(
        "orbit of period {period_s} s: attracting {listed}, but a disturbance of 1e-6 {fate:?} (spectral radius {radius:?})"
    )]
    Verdict {
        /// Its period in s.
        period_s: f64,
        /// What is listed.
        listed: bool,
        /// What the simulation does.
        fate: Fate,
        /// Spectral radius of the linearised return map.
        radius: Option<f64>,
    },
    /// The same orbit stands twice.
    #[error("orbit of period {period_s} s is listed twice")]
    Twice {
        /// Its period in s.
        period_s: f64,
    },
    /// An orbit of a covered period is not listed.
    #[error(
        "orbit of times {time_high_s} and {time_low_s} s is not listed; attracting {attracting:?}, reached by {starts} starts"
    )]
    Missing {
        /// Time at the upper level in s.
        time_high_s: f64,
        /// Time at the lower level in s.
        time_low_s: f64,
        /// The judge's verdict.
        attracting: Option<bool>,
        /// Starts of thirty that reach it.
        starts: usize,
    },
}

/// Counts over loops.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    /// Loops.
    pub loops: usize,
    /// Loops with a listing.
    pub answered: usize,
    /// Loops refused.
    pub refused: usize,
    /// Listings called complete.
    pub complete: usize,
    /// Listed orbits.
    pub listed: usize,
    /// Listed orbits that exist.
    pub exist: usize,
    /// Listed orbits called proved.
    pub proved: usize,
    /// Listed orbits without a verdict on attraction.
    pub verdict_open: usize,
    /// Listed verdicts that the judge shares.
    pub verdict_right: usize,
    /// Verdicts that the judge cannot decide either way.
    pub judge_undecided: usize,
    /// Verdicts that only the linearisation decides.
    pub by_linearisation: usize,
    /// Cycles that starts reach.
    pub reached: usize,
    /// Those of them in the ranges called covered.
    pub reached_covered: usize,
    /// Orbits of covered periods that the grid search finds beside them.
    pub searched_covered: usize,
    /// Cycles with several switchings each way, which are no orbits of a listing.
    pub long_cycles: usize,
    /// Loops in which no start ends on a cycle.
    pub no_cycle: usize,
    /// Starts without an end in sight.
    pub wandering: usize,
    /// Simulation and linearisation contradict each other, or floats and 71 digits: faults of the judge.
    pub faults: usize,
}

/// Judgement of one loop.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// Seed of the loop.
    pub seed: u64,
    /// What is wrong.
    pub contradictions: Vec<Contradiction>,
    /// Counts.
    pub counts: Counts,
    /// Wall time of the answer in s.
    pub seconds: Option<f64>,
    /// Order of the plant.
    pub order: usize,
}

/// Largest error of amplitude and bias over the amplitude, and of the largest multiplier over itself (or 1).
const VALUES: f64 = 1e-9;
/// Largest error of the largest multiplier over itself, where it is above [`SMALL_MULTIPLIER`].
const MULTIPLIER: f64 = 1e-6;
/// Below this modulus a spectral radius of the linearisation by differences is not sharp.
const SMALL_MULTIPLIER: f64 = 1e-4;

struct Known {
    orbit: Orbit,
    path: Path,
    attraction: Attraction,
}

/// Judges a line. `searching` also looks for orbits that no start reaches.
#[must_use]
pub fn judge(line: &Line, searching: bool) -> Judgement {
    let mut judgement = Judgement {
        seed: line.seed,
        contradictions: Vec::new(),
        counts: Counts { loops: 1, ..Counts::default() },
        seconds: line.seconds,
        order: line.control_loop.plant.order(),
    };
    let found = reached(&line.control_loop, line.seed);
    judgement.count_starts(&found);
    let Some(document) = &line.answer else {
        judgement.counts.refused = 1;
        return judgement;
    };
    let listing: Listing = match serde_json::from_value(document.clone()) {
        Ok(listing) => listing,
        Err(why) => {
            judgement.contradictions.push(Contradiction::Unreadable(why.to_string()));
            return judgement;
        }
    };
    judgement.counts.answered = 1;
    judgement.counts.complete = usize::from(listing.complete == Some(true));
    let simulator = Simulator::<f256>::new(&line.control_loop);
    let known = judgement.listed(&simulator, &listing);
    judgement.completeness(line, &simulator, &listing, &known, &found, searching);
    judgement
}

/// The judge's verdict on an orbit.
fn attraction(simulator: &Simulator<f256>, orbit: &Orbit, path: &Path) -> Attraction {
    Attraction { fate: fate(simulator, orbit, path), radius: orbit.spectral_radius(simulator, path) }
}

impl Judgement {
    fn count_starts(&mut self, found: &Reached) {
        self.counts.reached = found.cycles.len();
        self.counts.long_cycles = found.long_cycles.len();
        self.counts.no_cycle = usize::from(found.cycles.is_empty() && found.long_cycles.is_empty());
        self.counts.wandering = found.wandering + found.unclear;
        self.counts.faults = found.unconfirmed.len();
    }

    /// Judges each listed orbit; those that exist.
    fn listed(&mut self, simulator: &Simulator<f256>, listing: &Listing) -> Vec<Known> {
        let mut known: Vec<Known> = Vec::new();
        for listed in &listing.orbits {
            self.counts.listed += 1;
            self.counts.proved += usize::from(listed.proved());
            let period_s = listed.period_s;
            let found = Orbit::at(simulator, listed.time_high_s, listed.time_low_s);
            let (orbit, path) = match found.and_then(|orbit| orbit.simulate(simulator).map(|path| (orbit, path))) {
                Ok(found) => found,
                Err(why) => {
                    self.contradictions.push(Contradiction::Absent { period_s, why });
                    continue;
                }
            };
            if known.iter().any(|other| other.orbit.distance(listed.time_high_s, listed.time_low_s) < 1e-9) {
                self.contradictions.push(Contradiction::Twice { period_s });
                continue;
            }
            self.counts.exist += 1;
            let attraction = attraction(simulator, &orbit, &path);
            self.values(listed, &orbit, &path, attraction);
            self.verdict(listed, attraction);
            known.push(Known { orbit, path, attraction });
        }
        known
    }

    fn values(&mut self, listed: &ListedOrbit, orbit: &Orbit, path: &Path, attraction: Attraction) {
        let period_s = listed.period_s;
        let (period, size, bias) = (orbit.period().to_f64(), path.amplitude().to_f64(), path.bias().to_f64());
        let largest = listed.multipliers.iter().map(|one| one.modulus()).reduce(f64::max);
        let radius = attraction.radius.filter(|&radius| radius > SMALL_MULTIPLIER);
        let values = [
            ("period_s", Some(listed.period_s), Some(period), VALUES * period),
            ("amplitude", listed.amplitude, Some(size), VALUES * size),
            ("bias", listed.bias, Some(bias), VALUES * size.max(bias.abs())),
            ("largest multiplier", largest, radius, MULTIPLIER * radius.unwrap_or(0.0)),
        ];
        for (field, listed, exact, tolerance) in values {
            if let (Some(listed), Some(exact)) = (listed, exact)
                && !((listed - exact).abs() <= tolerance)
            {
                self.contradictions.push(Contradiction::Value { period_s, field, listed, exact });
            }
        }
        // The judge's own rounding in the extremes.
        let rounding = 1e-12 * size;
        let exact = [
            ("period_s", orbit.period(), 0.0),
            ("time_high_s", orbit.time_high, 0.0),
            ("time_low_s", orbit.time_low, 0.0),
            ("amplitude", path.amplitude(), rounding),
            ("bias", path.bias(), rounding),
        ];
        for (field, exact, rounding) in exact {
            if let Some([low, high]) = listed.bounds(field)
                && !(f256::from(low - rounding) <= exact && exact <= f256::from(high + rounding))
            {
                let exact = exact.to_f64();
                self.contradictions.push(Contradiction::Enclosure { period_s, field, low, high, exact });
            }
        }
    }

    fn verdict(&mut self, listed: &ListedOrbit, attraction: Attraction) {
        self.counts.faults += usize::from(attraction.contradicts_itself());
        self.counts.by_linearisation +=
            usize::from(attraction.fate == Fate::Undecided && attraction.attracting().is_some());
        match (listed.attracting, attraction.attracting()) {
            (None, _) => self.counts.verdict_open += 1,
            (Some(_), None) => self.counts.judge_undecided += 1,
            (Some(listed), Some(right)) if listed == right => self.counts.verdict_right += 1,
            (Some(verdict), Some(_)) => self.contradictions.push(Contradiction::Verdict {
                period_s: listed.period_s,
                listed: verdict,
                fate: attraction.fate,
                radius: attraction.radius,
            }),
        }
    }

    fn completeness(
        &mut self,
        line: &Line,
        simulator: &Simulator<f256>,
        listing: &Listing,
        known: &[Known],
        found: &Reached,
        searching: bool,
    ) {
        let listed = |orbit: &Orbit| {
            let (time_high, time_low) = (orbit.time_high.to_f64(), orbit.time_low.to_f64());
            known.iter().any(|known| known.orbit.distance(time_high, time_low) < 1e-8)
        };
        let covered = |orbit: &Orbit| listing.covers(orbit.period().to_f64());
        for cycle in &found.cycles {
            self.counts.reached_covered += usize::from(covered(&cycle.orbit));
            if covered(&cycle.orbit) && !listed(&cycle.orbit) {
                self.contradictions.push(missing(&cycle.orbit, Some(true), cycle.starts));
            }
        }
        if !searching {
            return;
        }
        for orbit in search(&line.control_loop).into_iter().filter(covered) {
            let (time_high, time_low) = (orbit.time_high.to_f64(), orbit.time_low.to_f64());
            if found.cycles.iter().any(|cycle| cycle.orbit.distance(time_high, time_low) < 1e-8) {
                continue;
            }
            self.counts.searched_covered += 1;
            if !listed(&orbit) {
                let attracting =
                    orbit.simulate(simulator).ok().and_then(|path| attraction(simulator, &orbit, &path).attracting());
                self.contradictions.push(missing(&orbit, attracting, 0));
            }
        }
    }
}

fn missing(orbit: &Orbit, attracting: Option<bool>, starts: usize) -> Contradiction {
    let (time_high_s, time_low_s) = (orbit.time_high.to_f64(), orbit.time_low.to_f64());
    Contradiction::Missing { time_high_s, time_low_s, attracting, starts }
}

/// A listing of all orbits that the judge knows of a loop, as a right answer would be: for tests of the judge.
#[must_use]
pub fn own_listing(line: &Line) -> Listing {
    let simulator = Simulator::<f256>::new(&line.control_loop);
    let mut orbits: Vec<Orbit> =
        reached(&line.control_loop, line.seed).cycles.into_iter().map(|cycle| cycle.orbit).collect();
    for orbit in search(&line.control_loop) {
        if !orbits.iter().any(|other| other.distance(orbit.time_high.to_f64(), orbit.time_low.to_f64()) < 1e-8) {
            orbits.push(orbit);
        }
    }
    let known = orbits.into_iter().filter_map(|orbit| {
        let path = orbit.simulate(&simulator).ok()?;
        let attraction = attraction(&simulator, &orbit, &path);
        Some(Known { orbit, path, attraction }.listed())
    });
    Listing { orbits: known.collect(), complete: Some(true), ..Listing::default() }
}

impl Known {
    fn listed(&self) -> ListedOrbit {
        ListedOrbit {
            period_s: self.orbit.period().to_f64(),
            time_high_s: self.orbit.time_high.to_f64(),
            time_low_s: self.orbit.time_low.to_f64(),
            amplitude: Some(self.path.amplitude().to_f64()),
            bias: Some(self.path.bias().to_f64()),
            multipliers: self.attraction.radius.map(super::answer::Multiplier::Real).into_iter().collect(),
            attracting: self.attraction.attracting(),
            shown: Some("not proved".to_owned()),
            enclosure: None,
        }
    }
}
