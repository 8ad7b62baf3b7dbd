"""Proofs with something changed, of `fixtures/forgeries.json`, which the crate's own checker is held to refuse, too
(`tests/snapshots/forgeries.rs`). Folders as in `test_bounded.py` and `test_check.py`."""

import copy
import json
import os
from pathlib import Path

import pytest

import bounded
import check
import orbits

FORGERIES = json.loads(Path(__file__, "../../../fixtures/forgeries.json").resolve().read_text())
RAW = "as it stands"


def forged(proof, changes):
    """The text of a proof after some changes; places are JSON pointers."""
    whole, raw = [proof], None
    for change in changes:
        *path, last = [int(part) if part.isdigit() else part for part in change["at"].split("/")]
        path, last = ([0, *path[1:]], last) if path else ([], 0)
        parent = whole
        for part in path:
            parent = parent[part]
        match change:
            case {"to": value}:
                parent[last] = value
            case {"drop": _}:
                del parent[last]
            case {"times": factor}:
                parent[last] *= factor
            case {"keep": count}:
                del parent[last][count:]
            case {"repeat": count, "of": value}:
                parent[last] = [value] * count
            case {"copy": other}:
                parent[last].append(copy.deepcopy(parent[last][int(other.split("/")[-1])]))
            case {"nest": depth}:
                parent[last], raw = RAW, "[" * depth + "]" * depth
            case {"raw": text}:
                parent[last], raw = RAW, text
    return json.dumps(whole[0]).replace(f'"{RAW}"', raw or "")


@pytest.mark.parametrize("forgery", FORGERIES, ids=lambda forgery: forgery["name"])
def test_refused(forgery, tmp_path):
    of = forgery["of"]
    theorem = of.startswith("orbit-")
    folder = Path(os.environ["SELFOSC_CERTIFICATES" if theorem else "SELFOSC_BOUNDED"])
    path = tmp_path / f"{of}.json"
    path.write_text(forged(json.loads((folder / f"{of}.json").read_text()), forgery["change"]))
    with pytest.raises(check.Refused) as refused:
        (check if theorem else orbits if of == "heater" else bounded).check_file(path)
    assert len(str(refused.value)) > 10
