"""Records, the command beside the package, and log files in the field's formats."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import matplotlib
import pytest

import selfosc

matplotlib.use("Agg")

ROOT = Path(__file__).resolve().parents[2]
CORPUS = ROOT / "fixtures" / "corpus"
YAW = {"alpha": 0.03, "beta_quadratic": 0.02, "relay": 0.08, "half_width": 0.3, "delay": 0.2}


def _command() -> str | None:
    """The command built from the same sources: SELFOSC_COMMAND, or the newest of the usual places."""
    if given := os.environ.get("SELFOSC_COMMAND"):
        return given
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    built = [path for kind in ("release", "debug") if (path := target / kind / "selfosc").exists()]
    return str(max(built, key=lambda path: path.stat().st_mtime)) if built else shutil.which("selfosc")


@pytest.fixture(scope="session")
def command():
    """Runs the command and gives its exit status and standard output."""
    binary = _command()
    if binary is None:
        pytest.skip("the command is not built; cargo build --release first")

    def run(*arguments: object) -> tuple[int, str]:
        done = subprocess.run([binary, *map(str, arguments)], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout

    return run


@pytest.fixture(scope="session")
def record():
    """A heading record in degrees, rounded to one."""
    return selfosc.simulate(**YAW, hold=True, quantum=0.0175, degrees=True, cycles=12)


@pytest.fixture(scope="session")
def record_path(record, tmp_path_factory):
    path = tmp_path_factory.mktemp("logs") / "log.csv"
    rows = zip(*record.values(), strict=True)
    path.write_text(",".join(record) + "\n" + "".join(f"{t!r},{y!r},{u!r}\n" for t, y, u in rows))
    return path
