//! Domains as data, and whether a domain covers another.

use std::borrow::Cow;
use std::fmt;

use serde::{Deserialize, Deserializer, Serialize};

/// A variable of a box, between two ends. In a claim an end may be open or infinite; the domain of a proof is closed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClaimVariable {
    /// Name, a quotient where only a quotient matters.
    pub name: Cow<'static, str>,
    /// Unit; 1 for a pure number.
    pub unit: Cow<'static, str>,
    /// Lower end; in JSON null stands for minus infinity.
    #[serde(deserialize_with = "lower_end")]
    pub from: f64,
    /// Upper end; in JSON null stands for infinity.
    #[serde(deserialize_with = "upper_end")]
    pub to: f64,
}

fn lower_end<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::NEG_INFINITY))
}

fn upper_end<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::INFINITY))
}

impl ClaimVariable {
    /// A pure number between two ends.
    #[must_use]
    pub const fn number(name: &'static str, from: f64, to: f64) -> Self {
        Self::new(name, "1", from, to)
    }

    /// A quantity between two ends.
    #[must_use]
    pub const fn new(name: &'static str, unit: &'static str, from: f64, to: f64) -> Self {
        Self { name: Cow::Borrowed(name), unit: Cow::Borrowed(unit), from, to }
    }
}

impl fmt::Display for ClaimVariable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, unit, from, to } = self;
        let unit = if unit == "1" { "" } else { unit };
        let space = if unit.is_empty() { "" } else { " " };
        if from == to {
            write!(f, "{name} = {from}{space}{unit}")
        } else {
            write!(f, "{name} in [{from}, {to}]{space}{unit}")
        }
    }
}

/// A part of a domain: with variables a box of them, without variables the whole of its text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClaimPart {
    /// Short name: a claim's part and the proof of it have the same.
    pub name: Cow<'static, str>,
    /// Its text, in a single line.
    pub text: Cow<'static, str>,
    /// Sides of the box; empty where the part is covered whole or not at all.
    pub variables: Cow<'static, [ClaimVariable]>,
}

impl ClaimPart {
    /// A part that is covered whole or not at all.
    #[must_use]
    pub const fn whole(name: &'static str, text: &'static str) -> Self {
        Self::over(name, text, &[])
    }

    /// The whole of a claim in a single part.
    pub(crate) const WHOLE: Self = Self::named("whole");

    /// The part of that name, to be proved of a claim: its page has the text.
    pub(crate) const fn named(name: &'static str) -> Self {
        Self::whole(name, "")
    }

    /// A box.
    #[must_use]
    pub const fn over(name: &'static str, text: &'static str, variables: &'static [ClaimVariable]) -> Self {
        Self { name: Cow::Borrowed(name), text: Cow::Borrowed(text), variables: Cow::Borrowed(variables) }
    }

    /// Whether the union of `boxes` contains this part. The variables are matched by name and unit; a box with a variable that
    /// this part does not have is a restriction and covers nothing.
    #[must_use]
    pub fn is_covered_by(&self, boxes: &[Self]) -> bool {
        let mut sides = Vec::new();
        for other in boxes.iter().filter(|other| other.name == self.name) {
            if other.variables.iter().all(|side| self.place(side).is_some()) {
                sides.push(other.sides_for(self));
            }
        }
        let whole = self.variables.iter().map(|side| [side.from, side.to]).collect();
        covered(whole, &sides)
    }

    fn place(&self, side: &ClaimVariable) -> Option<usize> {
        self.variables.iter().position(|mine| mine.name == side.name && mine.unit == side.unit)
    }

    /// The ends of the variables of `claimed`; all values of a variable that this part does not have.
    fn sides_for(&self, claimed: &Self) -> Vec<[f64; 2]> {
        let mut sides = vec![[f64::NEG_INFINITY, f64::INFINITY]; claimed.variables.len()];
        for side in self.variables.iter() {
            if let Some(place) = claimed.place(side) {
                sides[place] = [side.from, side.to];
            }
        }
        sides
    }
}

/// Whether closed boxes cover a box: the remainder on each side of the first box must be covered by the rest. The
/// remainder is taken open; closed boxes that cover it cover its closure.
fn covered(whole: Vec<[f64; 2]>, boxes: &[Vec<[f64; 2]>]) -> bool {
    let Some((first, rest)) = boxes.split_first() else { return false };
    let meets = whole.iter().zip(first).all(
        |([a, b], [from, to])| {
            if a == b { from <= a && b <= to } else { a.max(*from) < b.min(*to) }
        },
    );
    if !meets {
        return covered(whole, rest);
    }
    let mut left = whole;
    for (index, &[from, to]) in first.iter().enumerate() {
        let [a, b] = left[index];
        for [lower, upper] in [[a, from], [to, b]] {
            if lower < upper && lower >= a && upper <= b {
                let mut outside = left.clone();
                outside[index] = [lower, upper];
                if !covered(outside, rest) {
                    return false;
                }
            }
        }
        left[index] = [a.max(from), b.min(to)];
    }
    true
}

/// `text`, then the sides.
impl fmt::Display for ClaimPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name)?;
        for (place, side) in self.variables.iter().enumerate() {
            write!(f, "{}{side}", if place == 0 { ": " } else { ", " })?;
        }
        Ok(())
    }
}

/// The parts of a statement's domain, or those of them that are established.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ClaimDomain {
    /// The parts.
    pub parts: Cow<'static, [ClaimPart]>,
}

impl ClaimDomain {
    /// Of parts given when the program is built.
    #[must_use]
    pub const fn new(parts: &'static [ClaimPart]) -> Self {
        Self { parts: Cow::Borrowed(parts) }
    }

    /// The names of this domain's parts that `established` covers.
    #[must_use]
    pub fn covered_by(&self, established: &Self) -> Vec<&str> {
        let covered = self.parts.iter().filter(|part| part.is_covered_by(&established.parts));
        covered.map(|part| part.name.as_ref()).collect()
    }

    /// Both domains' parts, each once.
    pub(crate) fn union(mut self, other: Self) -> Self {
        for part in other.parts.iter() {
            if !self.parts.contains(part) {
                self.parts.to_mut().push(part.clone());
            }
        }
        self
    }
}

impl From<ClaimPart> for ClaimDomain {
    fn from(part: ClaimPart) -> Self {
        Self { parts: Cow::Owned(vec![part]) }
    }
}

impl fmt::Display for ClaimDomain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, part) in self.parts.iter().enumerate() {
            write!(f, "{}{part}", if place == 0 { "" } else { "; " })?;
        }
        Ok(())
    }
}
