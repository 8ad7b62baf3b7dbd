"""The name that was probably meant."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any


def near(word: str, known: Iterable[str]) -> str | None:
    """The most similar of the names there are, if any is similar at all (ratio above 0.6, the default of difflib)."""
    found = difflib.get_close_matches(str(word), list(known), n=1)
    return found[0] if found else None


def nearest(word: str, known: Iterable[str]) -> str:
    """The remedy for a name that is not known: the nearest that is, or all."""
    known = list(known)
    meant = near(word, known)
    return f"did you mean {meant}?" if meant else f"there are {', '.join(known) or 'none'}"


class Suggesting:
    """Objects that answer an attribute they do not have with the nearest of those that they have."""

    if not TYPE_CHECKING:  # A type checker knows the attributes from each class, and so finds a missing attribute.

        def __getattr__(self, name: str) -> Any:
            # Protocols of Python and of notebooks ask for names with an underscore.
            remedy = "" if name.startswith("_") else f"; {nearest(name, [one for one in dir(self) if not one.startswith('_')])}"
            raise AttributeError(f"{type(self).__name__} has no {name}{remedy}")
