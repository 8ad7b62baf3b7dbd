//! The page of a claim, read by the program: where the paper has it, its domain in parts, its dependencies.

use super::{Claim, ClaimDomain, ClaimPart, ClaimVariable};

impl Claim {
    /// Where the paper has it, or whence it comes.
    #[must_use]
    pub fn equation(&self) -> &'static str {
        self.header("equation").unwrap_or_default()
    }

    /// Claims it rests on, by id.
    pub fn depends(&self) -> impl Iterator<Item = &'static str> {
        self.header("depends").unwrap_or_default().split(", ").filter(|&id| id != "none")
    }

    /// The domain of its statement, in parts.
    ///
    /// ```
    /// use selfosc::claims::Claim;
    /// let domain = Claim::find("kernel-step").ok_or("no such claim")?.domain();
    /// assert_eq!(domain.to_string(), "closed-form: u in [-1, 1]");
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn domain(&self) -> ClaimDomain {
        ClaimDomain { parts: self.items("Domain").filter_map(part).collect() }
    }

    /// Steps of its proof that no program checks.
    pub fn by_hand(&self) -> impl Iterator<Item = &'static str> {
        self.items("Steps by hand")
    }

    /// The case against the statement as printed: the first sentence of its item; `None` where it holds.
    #[must_use]
    pub fn counterexample(&self) -> Option<String> {
        let (subject, case) = self.items("Counterexamples").next()?.split_once(": ")?;
        let case = case.split_once(". ").map_or(case, |(first, _)| first).trim_end_matches([';', '.']);
        subject.starts_with("as printed").then(|| case.replace('`', ""))
    }

    /// The value of a line `key: value` in the header.
    fn header(&self, key: &str) -> Option<&'static str> {
        let header = self.spec.strip_prefix("```text\n")?.split("```").next()?;
        header.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(": "))
    }

    /// The items under a heading.
    fn items(&self, heading: &str) -> impl Iterator<Item = &'static str> {
        let below = self.spec.split_once(&format!("**{heading}**\n\n")).map_or("", |(_, below)| below);
        below.lines().map_while(|line| line.strip_prefix("- "))
    }
}

/// ``` `name`: text; variable, variable ```, or without variables.
fn part(item: &'static str) -> Option<ClaimPart> {
    let (name, all) = item.strip_prefix('`')?.split_once("`: ")?;
    let boxed = all.rsplit_once("; ").and_then(|(text, sides)| Some((text, variables(sides)?)));
    let (text, variables) = boxed.unwrap_or((all, Vec::new()));
    Some(ClaimPart { variables: variables.into(), ..ClaimPart::whole(name, text) })
}

/// `name in [from, to] unit`, as [`ClaimVariable`] is written, one after the other.
fn variables(mut left: &'static str) -> Option<Vec<ClaimVariable>> {
    let mut found = Vec::new();
    while !left.is_empty() {
        let (name, after) = left.split_once(" in [")?;
        let (ends, after) = after.split_once(']')?;
        let (from, to) = ends.split_once(", ")?;
        let (unit, next) = after.split_once(", ").unwrap_or((after, ""));
        let unit = if unit.is_empty() { "1" } else { unit.trim_start() };
        found.push(ClaimVariable::new(name, unit, from.parse().ok()?, to.parse().ok()?));
        left = next;
    }
    Some(found)
}
