"""How often practical intervals hold the inertia, kind by kind, on records of the independent simulator: the table of `spec/trust.md`.

    python3 tests/trust/practical.py target/release/selfosc target/release/selfosc-simulator [records] [first seed] [group ...]

Every record is identified by the command with the delay that its kind tells. Kinds of several records are left out.
Defaults: 20 records of each kind, seeds from 5540000 on, groups inside, family and outside.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path


def identified(command, path, delay_s):
    """`reported` of one log, or None where it was refused."""
    delay = "estimate" if delay_s is None else str(delay_s)
    call = [command, "identify", str(path), "--method", "fit", "--delay", delay, "--json"]
    found = subprocess.run(call, capture_output=True, text=True)
    return json.loads(found.stdout).get("reported") if found.stdout else None


class Score:
    """Trusted answers of one kind or group, and the intervals that miss."""

    def __init__(self):
        self.cases = self.trusted = self.good = self.statistical = self.practical = self.of_good = self.far = 0
        self.half_widths = []

    def count(self, reported, alpha):
        self.cases += 1
        if reported is None or reported["trust"] == "doubtful":
            return
        estimate = reported["alpha"]
        combined = estimate["combined"]
        half = 0.5 * (combined["high"] - combined["low"])
        missed = not combined["low"] <= alpha <= combined["high"]
        self.trusted += 1
        self.good += reported["trust"] == "good"
        self.statistical += not estimate["low"] <= alpha <= estimate["high"]
        self.practical += missed
        self.of_good += missed and reported["trust"] == "good"
        self.far += abs(estimate["value"] - alpha) > 2.0 * half
        self.half_widths.append(100.0 * half / alpha)

    def row(self, name):
        percent = lambda count, of: f"{100.0 * count / of:.1f}" if of else "-"  # noqa: E731
        median = sorted(self.half_widths)[len(self.half_widths) // 2] if self.half_widths else float("nan")
        shares = [percent(self.statistical, self.trusted), percent(self.practical, self.trusted), percent(self.of_good, self.good)]
        return f"| {name} | {self.cases} | {self.trusted} | {' | '.join(shares)} | {percent(self.far, self.trusted)} | {median:.2f} |"


def main():
    command, simulator = (str(Path(path).resolve()) for path in sys.argv[1:3])
    records, first = (int(sys.argv[k]) if len(sys.argv) > k else usual for k, usual in ((3, 20), (4, 5540000)))
    groups = sys.argv[5:] or ["inside", "family", "outside"]
    listed = subprocess.run([simulator, "kinds"], capture_output=True, text=True, check=True).stdout
    kinds = [line.split(maxsplit=1) for line in listed.splitlines()]
    print("| kind | cases | trusted | statistical misses % | practical misses % | of `good` % | beyond 2 H % | H, median % |")
    print("|---|---|---|---|---|---|---|---|")
    for group in groups:
        together = Score()
        for name in (name for of, name in kinds if of == group):
            score = Score()
            with tempfile.TemporaryDirectory() as folder:
                call = [simulator, "write", folder, "--kind", name, "--records", str(records), "--seed", str(first)]
                subprocess.run(call, capture_output=True, check=True)
                for path in sorted(Path(folder).glob("*.json")):
                    case = json.loads(path.read_text())
                    if case["kind"] != name or len(case["files"]) != 1:
                        continue
                    reported = identified(command, Path(folder) / case["files"][0], case["known"]["delay_s"])
                    for one in (score, together):
                        one.count(reported, case["truth"][0]["alpha"])
            print(score.row(name), flush=True)
        print(together.row(f"**{group}**"), flush=True)


if __name__ == "__main__":
    main()
