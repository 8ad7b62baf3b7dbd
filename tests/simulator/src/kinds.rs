//! The catalogue: kinds of records, each with its own distribution of vehicles, sensors and commands.

mod family;
mod inside;
mod outside;
mod several;
mod unshowable;

use serde::Serialize;

use crate::experiment::Run;
use crate::plan::{DelayTold, Plan, Wanted};
use crate::random::Random;
use crate::scenario::Logged;
use crate::truth::{Known, Truth};

/// A name, and how to draw a case.
type Entry = (&'static str, fn(&mut Random) -> Plan);

/// Seeds below this are for development; reports are made with seeds from here on, which nobody looks at before.
pub const FIRST_REPORT_SEED: u64 = 1_000_000;

/// What a kind has to do with the model family of the identification.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Group {
    /// Linear and quadratic drag, constant force, delay; white noise and rounding.
    Inside,
    /// One or more of the family's terms beyond that.
    Family,
    /// A structure that the family has not.
    Outside,
    /// What no record of this kind can show.
    Unshowable,
    /// Several records.
    Several,
}

impl Group {
    /// All groups.
    pub const ALL: [Self; 5] = [Self::Inside, Self::Family, Self::Outside, Self::Unshowable, Self::Several];

    /// A title.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Inside => "Inside the plain model",
            Self::Family => "Terms of the model family",
            Self::Outside => "Structures that are not in the family",
            Self::Unshowable => "What no record of the kind can show",
            Self::Several => "Several records",
        }
    }
}

/// A kind of records.
#[derive(Clone, Copy)]
pub struct Kind {
    /// A short name, unique.
    pub name: &'static str,
    /// Its group.
    pub group: Group,
    draw: fn(&mut Random) -> Plan,
}

impl core::fmt::Debug for Kind {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "Kind({})", self.name)
    }
}

/// No kind has such a name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no kind has `{0}` in its name: list them with `cargo run -p selfosc-simulator -- kinds`")]
pub struct UnknownKind(String);

/// One case: what a tool is given, and the truth.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its kind.
    pub kind: Kind,
    /// Its seed.
    pub seed: u64,
    /// One run for each record.
    pub runs: Vec<Run>,
    /// The truth of each.
    pub truths: Vec<Truth>,
    /// What the tool is told.
    pub known: Known,
}

/// How often a case is drawn anew before it is given up.
const MOST_ATTEMPTS: u64 = 400;
/// The fewest switchings of a record that a relay made.
const FEWEST_SWITCHINGS: usize = 8;

impl Kind {
    /// Every kind, by group.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let groups: [(Group, &[Entry]); 5] = [
            (Group::Inside, inside::KINDS),
            (Group::Family, family::KINDS),
            (Group::Outside, outside::KINDS),
            (Group::Unshowable, unshowable::KINDS),
            (Group::Several, several::KINDS),
        ];
        let kinds = groups.into_iter().flat_map(|(group, kinds)| kinds.iter().map(move |kind| (group, kind)));
        kinds.map(|(group, (name, draw))| Self { name, group, draw: *draw }).collect()
    }

    /// The kind of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|kind| kind.name == name)
    }

    /// The kind of this name, or else every kind whose name contains it.
    ///
    /// # Errors
    /// Says so where there is none.
    pub fn matching(name: &str) -> Result<Vec<Self>, UnknownKind> {
        if let Some(kind) = Self::named(name) {
            return Ok(vec![kind]);
        }
        let found: Vec<Self> = Self::all().into_iter().filter(|kind| kind.name.contains(name)).collect();
        if found.is_empty() { Err(UnknownKind(name.to_owned())) } else { Ok(found) }
    }

    /// The case of a seed. Draws that hardly oscillate (a force that outweighs the thrust) are drawn anew, as are those
    /// without locked cycles where the kind wants them.
    #[must_use]
    pub fn case(&self, seed: u64) -> Case {
        let mut attempt = 0;
        loop {
            let stream = seed.wrapping_add(attempt << 40);
            let mut random = Random::new(stream, self.name);
            let plan = (self.draw)(&mut random);
            let force = random.log_uniform(0.1, 100.0);
            let turns = plan.scenarios.iter().any(|scenario| scenario.sensor.turn > 0.0);
            // Headings stay in radians or degrees, others get any unit.
            let output = if turns || random.chance(0.3) {
                random.pick(&[1.0, 180.0 / core::f64::consts::PI])
            } else {
                random.log_uniform(0.1, 10.0)
            };
            let runs: Vec<Run> = (0u64..)
                .zip(&plan.scenarios)
                .map(|(index, scenario)| scenario.in_units(force, output).run(stream ^ (index << 32)))
                .collect();
            attempt += 1;
            if attempt < MOST_ATTEMPTS && !runs.iter().all(|run| accepted(run, plan.wanted)) {
                continue;
            }
            let truths: Vec<Truth> = runs.iter().map(Truth::of).collect();
            let delay_s = truths[0].delay_s;
            let delay_s = match plan.delay {
                DelayTold::Right => Some(delay_s),
                DelayTold::Nothing => None,
                DelayTold::Wrong(by_s) => Some((delay_s + by_s).max(0.0)),
            };
            let turn = Some(runs[0].scenario.sensor.turn).filter(|turn| *turn > 0.0);
            return Case { kind: *self, seed, runs, truths, known: Known { delay_s, turn } };
        }
    }
}

fn accepted(run: &Run, wanted: Wanted) -> bool {
    let input = &run.record.input;
    let switchings = input.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
    let oscillates = switchings >= FEWEST_SWITCHINGS || run.scenario.logged == Logged::Rudder && switchings >= 4;
    oscillates && (wanted == Wanted::Any || locked_period(&run.record.output).is_some())
}

/// The number of samples after which the second half of a record repeats exactly, four times at least.
#[must_use]
pub fn locked_period(output: &[f64]) -> Option<usize> {
    let half = &output[output.len() / 2..];
    (3..half.len() / 4).find(|period| half.windows(period + 1).all(|window| window[0] == window[*period]))
}
