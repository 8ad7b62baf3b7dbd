//! Certificates: a theorem with its inequalities and their proofs, in a file that needs nothing else to be checked.

use serde::{Deserialize, Serialize};

use super::Claim;
use crate::proof::Expression;
use crate::proof::inequality::{Inequality, Proof, Refusal};
use crate::proof::margin::Form;

/// Changes with the meaning of a field.
const FORMAT: u32 = 1;

/// A theorem's statement with its proofs. A file holds a single certificate as JSON; an unbounded end is null.
///
/// ```
/// use selfosc::claims::{Claim, Certificate};
/// let claim = Claim::find("orbit-multiplier").ok_or("no such claim")?;
/// let certificate = Certificate::of(claim).ok_or("not proved")?;
/// assert!(certificate.check().is_ok());
/// let boast = Certificate { statement: "every loop oscillates".to_owned(), ..certificate };
/// assert!(boast.check().is_err());
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// Of the file.
    pub format: u32,
    /// Of the crate that wrote it.
    pub version: String,
    /// From which that was built, or `unknown`.
    pub commit: String,
    /// Name of the claim.
    pub claim: String,
    /// What it says.
    pub statement: String,
    /// For which parameters.
    pub domain: String,
    /// Steps from the inequalities to the statement that no program checks.
    pub by_hand: Vec<String>,
    /// The inequalities.
    pub inequalities: Vec<Shown>,
}

/// An inequality with its proof.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shown {
    /// The positive quantity, in words.
    pub statement: String,
    /// Names of its variables; an empty name belongs to no variable.
    pub variables: Vec<String>,
    /// How the expression makes the positive quantity.
    pub form: Form,
    /// The formula as the code that is run gives it, constants rounded to doubles; null without a single formula.
    pub expression: Option<String>,
    /// ClaimDomain, bound, boxes.
    #[serde(flatten)]
    pub proof: Proof,
}

impl Shown {
    fn of(inequality: &Inequality, proof: Proof) -> Self {
        let expression = inequality.domain().and_then(|domain| {
            let symbol = |place: usize| {
                let name = inequality.variables[place].name;
                Expression::symbol(name, name, domain[place])
            };
            Some(inequality.margin.expression(core::array::from_fn(symbol))?.to_string())
        });
        Self {
            statement: inequality.statement.to_owned(),
            variables: inequality.variables.map(|side| side.name.to_owned()).into(),
            form: inequality.margin.form(),
            expression,
            proof,
        }
    }
}

impl Certificate {
    /// Of a claim that rests on inequalities, all of which are proved for it; `None` for any other.
    #[must_use]
    pub fn of(claim: &'static Claim) -> Option<Self> {
        let proofs = claim.theorem()?.prove().ok()?;
        Self::with(claim, proofs)
    }

    fn with(claim: &'static Claim, proofs: impl IntoIterator<Item = Proof>) -> Option<Self> {
        let theorem = claim.theorem()?;
        let shown = theorem.inequalities.iter().zip(proofs).map(|(inequality, proof)| Shown::of(inequality, proof));
        Some(Self {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: option_env!("SELFOSC_COMMIT").unwrap_or("unknown").to_owned(),
            claim: claim.id.to_owned(),
            statement: claim.statement.to_owned(),
            domain: theorem.domain.to_owned(),
            by_hand: claim.by_hand().map(str::to_owned).collect(),
            inequalities: shown.collect(),
        })
    }

    /// Whether its statement is the claim's of its name, and its proofs show the statement, by evaluation on the boxes listed.
    ///
    /// # Errors
    /// The first [`Refusal`].
    pub fn check(&self) -> Result<(), Refusal> {
        let claims = super::CLAIMS.iter().filter(|claim| claim.theorem().is_some());
        let claim = claims.into_iter().find(|claim| claim.id == self.claim);
        let proofs: Vec<Proof> = self.inequalities.iter().map(|shown| shown.proof.clone()).collect();
        let known = claim.and_then(|claim| Some((claim, claim.theorem()?, Self::with(claim, proofs.clone())?)));
        let Some((claim, theorem, expected)) = known else {
            return Err(Refusal::Malformed { text: format!("no claim `{}` with inequalities", self.claim) });
        };
        let same = |field: &'static str, found: String, expected: String| {
            if found == expected { Ok(()) } else { Err(Refusal::Statement { claim: claim.id, field, found }) }
        };
        same("format", self.format.to_string(), expected.format.to_string())?;
        same("statement", self.statement.clone(), expected.statement)?;
        same("domain", self.domain.clone(), expected.domain)?;
        same("by_hand", self.by_hand.join("; "), expected.by_hand.join("; "))?;
        same("inequalities", proofs.len().to_string(), theorem.inequalities.len().to_string())?;
        for (found, expected) in self.inequalities.iter().zip(expected.inequalities) {
            same("inequality's statement", found.statement.clone(), expected.statement)?;
            same("variables", found.variables.join(", "), expected.variables.join(", "))?;
            same("form", format!("{:?}", found.form), format!("{:?}", expected.form))?;
            same("expression", format!("{:?}", found.expression), format!("{:?}", expected.expression))?;
        }
        theorem.check(&proofs)
    }
}

crate::proof::document!(Certificate, Refusal, to_string);
