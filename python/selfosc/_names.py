"""The name that was probably meant."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


def near(word: str, known: Iterable[str]) -> str | None:
    """The most similar of the names there are, if any is similar at all (ratio above 0.6, the default of difflib)."""
    found = difflib.get_close_matches(word, list(known), n=1)
    return found[0] if found else None


def nearest(word: str, known: Iterable[str]) -> str:
    """The remedy for a name that is not known: the nearest that is, or all."""
    known = list(known)
    meant = near(word, known)
    return f"did you mean {meant}?" if meant else f"there are {', '.join(known) or 'none'}"
