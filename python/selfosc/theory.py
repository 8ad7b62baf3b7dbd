"""The theory as claims that are checked, and the paper regenerated."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

from . import _arguments, _documents, types
from ._names import nearest
from ._results import Result
from .errors import UsageError

__all__ = ["Reproduction", "Verification", "reproduce", "verify"]


class Verification(Result):
    """What was found of every claim; ``as_stated`` is whether all are as their files say."""

    claims: list[types.Claim]
    summary: types.ClaimSummary

    @property
    def as_stated(self) -> bool:
        """Whether every verdict is the one that the claim's file states."""
        return all(claim["as_stated"] for claim in self.to_dict()["claims"])

    def _rows(self) -> list[dict[str, Any]]:
        names = ("id", "equation", "kind", "as_printed", "as_corrected", "evidence", "as_stated")
        return [{name: claim[name] for name in names} for claim in self.to_dict()["claims"]]

    def __getitem__(self, claim: str) -> types.Claim:
        found = next((one for one in self.claims if one["id"] == claim), None)
        if found is None:
            raise UsageError(f"no claim {claim} was checked; {nearest(claim, (one['id'] for one in self.claims))}")
        return found


class Reproduction(Result):
    """The paper's tables and figures, recomputed, and the audit of every printed number."""

    table4: types.Table4 | None
    figure15: list[types.Counts] | None
    joint: list[types.JointRow] | None
    audit: list[types.AuditItem] | None
    consistency: list[types.PaperConsistency] | None

    def _rows(self) -> list[dict[str, Any]]:
        return self.to_dict()["audit"] or []


@_arguments.named
def verify(*claims: str, cases: int | None = None, seed: int | None = None) -> Verification:
    """Checks claims of the theory, all unless some are named.

    Parameters
    ----------
    *claims : str
        Their ids.
    cases, seed : int, optional
        Cases drawn by each sampled check, and the seed.

    Returns
    -------
    Verification
        ``claims`` with two verdicts each, and ``summary``. Sampling is never called proof.

    Raises
    ------
    SelfoscError
        For an id that no claim has.

    Examples
    --------
    >>> from selfosc import verify
    >>> verify("lemma-1", cases=100)["lemma-1"]["as_printed"]
    'refuted'
    """
    arguments = _documents.flags(claim=list(claims) or None, cases=cases, seed=seed)
    return Verification(_documents.answer("verify", *arguments)[1])


@_arguments.named
def reproduce(only: Sequence[str] = (), out: str | bytes | os.PathLike[str] | None = None) -> Reproduction:
    """Regenerates the paper from its printed data.

    Parameters
    ----------
    only : sequence of str
        Parts to regenerate; all unless given. The others are ``None`` in the result.
    out : path-like, optional
        A folder for Markdown, CSV, LaTeX, SVG and one ``report.html``.

    Returns
    -------
    Reproduction
        ``table4``, ``figure15``, ``joint``, ``audit``.

    Examples
    --------
    >>> from selfosc import reproduce
    >>> sorted(reproduce(["table4"]).table4["mean"])
    ['alpha', 'beta_r', 'beta_rr']
    """
    arguments = _documents.flags(only=_arguments.several(only, str) or None, out=_arguments.optional(_arguments.path, out, "out"))
    return Reproduction(_documents.answer("reproduce", *arguments)[1])
