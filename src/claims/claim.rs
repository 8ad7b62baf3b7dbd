//! What a claim is.

use super::{Budget, Verdict};

/// A checker: the same budget gives the same verdict.
pub type Checker = fn(Budget) -> Verdict;

/// What sort of statement a claim is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Fixes a meaning; the check is that the code means it.
    Definition,
    /// An equation between two expressions.
    Identity,
    /// A lemma of the paper.
    Lemma,
    /// A theorem, of the paper or of this project.
    Theorem,
    /// Something the paper says in words.
    Statement,
}

impl Kind {
    /// One lower-case word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Definition => "definition",
            Self::Identity => "identity",
            Self::Lemma => "lemma",
            Self::Theorem => "theorem",
            Self::Statement => "statement",
        }
    }
}

/// The statement as the paper has it.
#[derive(Clone, Copy, Debug)]
pub enum Printed {
    /// It holds.
    Holds(Checker),
    /// It does not: the checker finds a witness.
    Refuted(Checker),
    /// The paper does not say it.
    Absent,
}

/// A hypothesis, and whether the statement needs it.
#[derive(Clone, Copy, Debug)]
pub struct Hypothesis {
    /// Short name.
    pub id: &'static str,
    /// Refutes the statement by a case that violates this hypothesis and no other; `None` where no such case is known.
    pub counterexample: Option<Checker>,
}

/// A definition, lemma, theorem or identity with its checkers.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Name: that of its file in `spec/claims`, and of `verify --claim`.
    pub id: &'static str,
    /// Where the paper has it, or whence it comes.
    pub equation: &'static str,
    /// Its sort.
    pub kind: Kind,
    /// The statement that holds, in one line.
    pub statement: &'static str,
    /// As printed.
    pub printed: Printed,
    /// As corrected; `None` where the print needs no correction.
    pub corrected: Option<Checker>,
    /// A statement close to this one and false: its checker must refute it, which shows that checkers can.
    pub falsified: Checker,
    /// What the statement that holds assumes.
    pub hypotheses: &'static [Hypothesis],
    /// Claims it rests on, by id.
    pub depends: &'static [&'static str],
    /// Its file.
    pub spec: &'static str,
}

/// The verdicts on one claim.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// As printed; `None` where the paper does not say it.
    pub printed: Option<Verdict>,
    /// As corrected; `None` where the print needs no correction.
    pub corrected: Option<Verdict>,
    /// Whether each verdict is the expected one.
    pub expected: bool,
}

impl Claim {
    /// Runs the checkers of the statement, printed and corrected, each from its own stream of cases.
    ///
    /// ```
    /// use selfosc::claims::{Budget, Claim};
    /// let finding = Claim::find("lemma-1").ok_or("no such claim")?.check(Budget { cases: 50, seed: 1 });
    /// assert!(finding.printed.is_some_and(|verdict| verdict.is_refuted()));
    /// assert!(finding.corrected.is_some_and(|verdict| verdict.holds()));
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn check(&self, budget: Budget) -> Finding {
        let budget = self.stream(budget);
        let (printed, as_printed) = match self.printed {
            Printed::Holds(checker) => (Some(checker(budget)), true),
            Printed::Refuted(checker) => (Some(checker(budget)), false),
            Printed::Absent => (None, true),
        };
        let corrected = self.corrected.map(|checker| checker(budget));
        let expected = printed.as_ref().is_none_or(|v| if as_printed { v.holds() } else { v.is_refuted() })
            && corrected.as_ref().is_none_or(Verdict::holds);
        Finding { printed, corrected, expected }
    }

    /// The budget with a seed of this claim's own, so that its cases do not depend on what else is run.
    #[must_use]
    pub fn stream(&self, budget: Budget) -> Budget {
        let hash =
            self.id.bytes().fold(budget.seed, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3));
        Budget { seed: hash, ..budget }
    }
}

/// Declares a claim's constant, documented by its file.
macro_rules! claim {
    ($constant:ident = $id:literal $equation:literal $kind:ident $statement:literal { $($field:ident: $value:expr),+ $(,)? }) => {
        #[doc = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/spec/claims/", $id, ".md"))]
        pub const $constant: $crate::claims::Claim = $crate::claims::Claim {
            id: $id,
            equation: $equation,
            kind: $crate::claims::Kind::$kind,
            statement: $statement,
            spec: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/spec/claims/", $id, ".md")),
            $($field: $value),+
        };
    };
}
pub(super) use claim;
