//! What a claim is.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::distortion::Distortion;
use super::{Budget, CLAIMS, ClaimDomain, Verdict, Word};
use crate::orbit::theorem::Theorem;

/// A checker: the same budget gives the same verdict.
pub type Checker = fn(Budget) -> Verdict;

/// A proof of a statement, or of a false statement next to it.
pub(crate) type Prover = fn(Distortion) -> Verdict;

/// The sort of a claim's statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Fixes a meaning; the check is that the code means it.
    Definition,
    /// An equation between two expressions.
    Identity,
    /// A lemma of the paper.
    Lemma,
    /// A theorem, of the paper or of this project.
    Theorem,
    /// A sentence of the paper.
    Statement,
}

/// The statement as the paper has it.
#[derive(Clone, Copy, Debug)]
pub enum AsPrinted {
    /// It holds.
    Holds(Checker),
    /// It does not: the checker finds a witness.
    Refuted(Checker),
    /// It is an approximation, under a hypothesis that the paper states: the checker finds a case in which the equation is off.
    Approximate(Checker),
    /// The paper does not say it.
    Absent,
}

/// A hypothesis that the statement needs.
#[derive(Clone, Copy, Debug)]
pub struct Hypothesis {
    /// Short name.
    pub id: &'static str,
    /// Refutes the statement by a case that violates this hypothesis alone.
    pub counterexample: Checker,
}

/// A definition, lemma, theorem or identity with its checkers; its page has the rest.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Name: that of its file in `spec/claims`, and of `verify --claim`.
    pub id: &'static str,
    /// Its sort.
    pub kind: Kind,
    /// The statement that holds, in a single line.
    pub statement: &'static str,
    /// How many of the cases asked for its checks draw: fewer where a case takes long.
    pub(crate) cases: fn(usize) -> usize,
    /// The obstacle to a proof of the whole statement; `None` where it is proved or every state was visited.
    pub not_proved: Option<&'static str>,
    /// As printed.
    pub printed: AsPrinted,
    /// As corrected; `None` where the print needs no correction.
    pub corrected: Option<Checker>,
    /// A false statement close to the claim's: its checker must refute it, which shows that checkers can.
    pub falsified: Checker,
    /// The proof by enclosure that it declares; the statement is undecided where that does not succeed.
    pub(crate) proof: Option<Prover>,
    /// The inequalities that its checker proves.
    pub(crate) theorem: Option<&'static Theorem>,
    /// Assumptions of the statement that holds, those of which a case shows the need; its page has them all.
    pub hypotheses: &'static [Hypothesis],
    /// Text of its page: domain, dependencies, steps by hand.
    pub spec: &'static str,
}

/// The verdicts on a claim, with the expectations they are compared with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Name of the claim.
    pub id: Cow<'static, str>,
    /// The domain of the claim's statement.
    pub domain: ClaimDomain,
    /// Steps of its proof that no program checks.
    pub by_hand: Vec<Cow<'static, str>>,
    /// As printed; `None` where the paper does not say it.
    pub printed: Option<Verdict>,
    /// As corrected; `None` where the print needs no correction.
    pub corrected: Option<Verdict>,
    /// Whether each verdict is as expected, and each declared proof succeeded.
    pub expected: bool,
}

impl Finding {
    /// The verdict on the statement that is to hold: as corrected where there is a correction, else as printed.
    #[must_use]
    pub fn carrying(&self) -> Option<&Verdict> {
        self.corrected.as_ref().or(self.printed.as_ref())
    }

    /// The word for the statement that is to hold.
    #[must_use]
    pub fn word(&self) -> Word {
        self.word_of(self.carrying())
    }

    /// The word for the statement as printed.
    #[must_use]
    pub fn as_printed(&self) -> Word {
        self.word_of(self.printed.as_ref())
    }

    /// The word for the statement as corrected.
    #[must_use]
    pub fn as_corrected(&self) -> Word {
        self.word_of(self.corrected.as_ref())
    }

    fn word_of(&self, verdict: Option<&Verdict>) -> Word {
        verdict.map_or(Word::NotApplicable, |verdict| verdict.word(&self.domain))
    }
}

/// Checks the claims of these ids, or every claim without ids, in the order of the ids.
///
/// # Errors
/// The first id that no claim has.
pub fn verify<'a>(ids: &[&'a str], budget: Budget) -> Result<Vec<Finding>, &'a str> {
    if ids.is_empty() {
        return Ok(CLAIMS.iter().map(|claim| claim.check(budget)).collect());
    }
    let claims = ids.iter().map(|id| Claim::find(id).ok_or(*id)).collect::<Result<Vec<_>, _>>()?;
    Ok(claims.into_iter().map(|claim| claim.check(budget)).collect())
}

impl Claim {
    /// What [`claim!`] leaves out.
    pub(crate) const BLANK: Self = Self {
        id: "",
        kind: Kind::Statement,
        statement: "",
        cases: |all| all,
        not_proved: None,
        printed: AsPrinted::Absent,
        corrected: None,
        falsified: |_| Verdict::Undecided { spent: String::new() },
        proof: None,
        theorem: None,
        hypotheses: &[],
        spec: "",
    };

    /// The claim of that id.
    #[must_use]
    pub fn find(id: &str) -> Option<&'static Self> {
        CLAIMS.iter().find(|claim| claim.id == id)
    }

    /// Runs the checkers of the statement, printed and corrected, each from its own stream of cases, and the proof of the
    /// statement that is to hold.
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
        let proved = |sampled: Verdict| match self.proof {
            Some(proof) => sampled.backed_by(|| proof(Distortion::None)),
            None => sampled,
        };
        let printed = match self.printed {
            AsPrinted::Holds(checker) if self.corrected.is_none() => Some(proved(checker(budget))),
            AsPrinted::Holds(checker) | AsPrinted::Refuted(checker) => Some(checker(budget)),
            AsPrinted::Approximate(checker) => Some(checker(budget).approximated()),
            AsPrinted::Absent => None,
        };
        let corrected = self.corrected.map(|checker| proved(checker(budget)));
        let domain = self.domain();
        let [printed, corrected] = [printed, corrected].map(|verdict| Some(verdict?.worded(&domain)));
        let as_printed = |verdict: &Verdict| match self.printed {
            AsPrinted::Refuted(_) => verdict.is_refuted(),
            AsPrinted::Approximate(_) => matches!(verdict, Verdict::Approximate(_)),
            AsPrinted::Holds(_) | AsPrinted::Absent => verdict.holds(),
        };
        let expected = printed.as_ref().is_none_or(as_printed) && corrected.as_ref().is_none_or(Verdict::holds);
        Finding {
            id: Cow::Borrowed(self.id),
            domain,
            by_hand: self.by_hand().map(Cow::Borrowed).collect(),
            printed,
            corrected,
            expected,
        }
    }

    /// The declared proof by itself.
    #[must_use]
    pub fn prove(&self) -> Option<Verdict> {
        self.proof.map(|proof| proof(Distortion::None))
    }

    /// The declared proof on false statements next to the claim's, each with its name: the formula off by a factor
    /// everywhere, and by a millionth on a thousandth of the domain. None may succeed.
    pub fn prove_falsehoods(&self) -> impl Iterator<Item = (String, Verdict)> {
        let proof = self.proof;
        Distortion::FALSE.into_iter().filter_map(move |false_one| Some((format!("{false_one:?}"), proof?(false_one))))
    }

    /// The inequalities that the claim rests on.
    #[must_use]
    pub fn theorem(&self) -> Option<&'static Theorem> {
        self.theorem
    }

    /// The budget with a seed of this claim's own, and as many cases as it draws: they do not depend on the claims run before.
    #[must_use]
    pub fn stream(&self, budget: Budget) -> Budget {
        let hash =
            self.id.bytes().fold(budget.seed, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3));
        Budget { cases: (self.cases)(budget.cases), seed: hash }
    }
}

/// Declares a claim's constant, with its file: a missing file fails the build.
///
/// A check in its rows is a function of a drawn case, followed by its further arguments.
///
/// | row | meaning |
/// |---|---|
/// | `cases f` | of n cases asked for, its checks draw `f(n)` |
/// | `printed Holds check` | the check of the statement as printed: it `Holds`, is `Refuted` or `Approximate` |
/// | `corrected check and check` | the checks of the statement as corrected; `backed by` a proof |
/// | `false check` | a false variant, which must be refuted |
/// | `needs "id" check` | a hypothesis: the check refutes the statement without it |
/// | `theorem`, `proof`, `not_proved` | the field of [`Claim`] |
/// | `exactly f on "part" at points` | the proof: f vanishes identically on a part of the domain, in the cases where the points lie |
macro_rules! claim {
    ($constant:ident = $id:literal $kind:ident $statement:literal;
        $(cases $cases:expr;)?
        $(printed $printed:ident $($as_printed:ident($($p:expr),*))and+;)?
        $(corrected $($as_corrected:ident($($c:expr),*))and+ $(backed by $backing:expr)?;)?
        false $falsified:ident($($f:expr),*);
        $(needs $needed:literal $without:ident($($w:expr),*);)*
        $(theorem $theorem:expr;)?
        $(proof $proof:expr;)?
        $(exactly $($functions:ident on $part:literal at $points:expr),+;)?
        $(not_proved $why:expr;)?
    ) => {
        claim! { $constant = $id $kind $statement {
            $(cases: $cases,)?
            $(printed: $crate::claims::AsPrinted::$printed($crate::claims::registry::drawn!($($as_printed($($p),*))and+)),)?
            $(corrected: Some(
                $crate::claims::registry::drawn!($($as_corrected($($c),*))and+ $(, backed by $backing)?)
            ),)?
            falsified: $crate::claims::registry::drawn!($falsified($($f),*)),
            hypotheses: &[
                $($crate::claims::Hypothesis {
                    id: $needed,
                    counterexample: $crate::claims::registry::drawn!($without($($w),*)),
                },)*
            ],
            $(theorem: Some($theorem),)?
            $(proof: Some($proof),)?
            $(proof: Some(|distortion| $crate::claims::Verdict::all([$(
                $crate::claims::checks::exactly($crate::claims::ClaimPart::named($part), distortion, $points, $functions)
            ),+])),)?
            $(not_proved: Some($why),)?
        } }
    };
    ($constant:ident = $id:literal $kind:ident $statement:literal { $($field:ident: $value:expr),+ $(,)? }) => {
        #[doc = $statement]
        pub(in crate::claims) const $constant: $crate::claims::Claim = $crate::claims::Claim {
            id: $id,
            kind: $crate::claims::Kind::$kind,
            statement: $statement,
            spec: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/spec/claims/", $id, ".md")),
            $($field: $value,)+
            ..$crate::claims::Claim::BLANK
        };
    };
}
pub(in crate::claims) use claim;

/// A checker of drawn cases: each of these checks, with its arguments, on cases of its own.
macro_rules! drawn {
    ($($check:ident($($argument:expr),*))and+ $(, backed by $backing:expr)?) => {
        |budget| {
            $crate::claims::Verdict::all([
                $($crate::claims::sampling::sample(budget, |draw| $check(draw $(, $argument)*))),+
            ])$(.backed_by(|| $backing))?
        }
    };
}
pub(in crate::claims) use drawn;
