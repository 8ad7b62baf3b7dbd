//! The part of a claim that the kernel of a proof assistant has checked: read off the tables next to its theories.

use core::fmt;

use super::Claim;

/// The tables of `spec/formal`; its script `check.sh` holds them to the theories.
const TABLES: [&str; 2] =
    [include_str!("../../spec/formal/claims.tsv"), include_str!("../../spec/formal/claims_b.tsv")];

/// A theorem that Coq's kernel accepts, on the axioms of the real numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KernelChecked {
    /// The theory, a file in `spec/formal`.
    pub file: &'static str,
    /// The theorem.
    pub theorem: &'static str,
    /// The part of the claim: `whole`, the `statement` without the page's additions, or `steps` of its proof by number.
    pub covers: &'static str,
}

impl fmt::Display for KernelChecked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "kernel-checked: {}", self.covers)
    }
}

impl Claim {
    /// The parts of the claim that a kernel has checked.
    ///
    /// ```
    /// use selfosc::claims::Claim;
    /// let checked = Claim::find("lemma-1").and_then(Claim::kernel_checked).ok_or("not checked")?;
    /// assert_eq!(checked.to_string(), "kernel-checked: whole");
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn kernel_checked(&self) -> Option<KernelChecked> {
        TABLES.iter().flat_map(|table| table.lines()).find_map(|line| {
            let mut cells = line.split('\t');
            let row = (cells.next()?, cells.next()?, cells.next()?, cells.next()?);
            let (claim, file, theorem, covers) = row;
            (claim == self.id).then_some(KernelChecked { file, theorem, covers })
        })
    }
}
