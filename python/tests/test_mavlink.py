"""The MAVLink example over the loopback, against the simulated autopilot, on a good link, a bad one, and one that is cut."""

import json
import os
import random
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

pytest.importorskip("pymavlink")
EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "mavlink"
SELFOSC = os.environ.get("SELFOSC_COMMAND", "selfosc")
ALPHA = 0.05


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class BadLink(threading.Thread):
    """UDP from `port` to `target` and back, with packets lost, late and out of order, until it is cut."""

    def __init__(self, port, target, lost, late_s, seed):
        super().__init__(daemon=True)
        self.front = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.front.bind(("127.0.0.1", port))
        self.back = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.back.bind(("127.0.0.1", 0))
        self.target, self.vehicle = ("127.0.0.1", target), None
        self.lost, self.late_s, self.random, self.cut = lost, late_s, random.Random(seed), threading.Event()

    def run(self):
        waiting = []
        for end in (self.front, self.back):
            end.setblocking(False)
        while not self.cut.is_set():
            now = time.monotonic()
            for end, out in ((self.front, self.back), (self.back, self.front)):
                try:
                    packet, sender = end.recvfrom(4096)
                except BlockingIOError:
                    continue
                if end is self.front:
                    self.vehicle = sender
                if self.random.random() >= self.lost:
                    # One in ten takes longer, and is overtaken.
                    late = self.late_s * (1 if self.random.random() < 0.9 else 1.5)
                    waiting.append((now + late, packet, out))
            due = [one for one in waiting if one[0] <= now]
            waiting = [one for one in waiting if one[0] > now]
            for _, packet, out in due:
                to = self.target if out is self.back else self.vehicle
                if to:
                    out.sendto(packet, to)
            time.sleep(0.001)


def lines(path):
    """Lines that are written so far."""
    return len(path.read_text().splitlines()) if path.exists() else 0


def experiment(folder, *, lost=0.0, late_s=0.0, cut_after=None):
    ground, vehicle = free_port(), free_port()
    link = BadLink(vehicle, ground, lost, late_s, seed=4)
    link.start()
    trace = folder / "trace.txt"
    autopilot = subprocess.Popen(
        [sys.executable, EXAMPLES / "autopilot.py", f"udpout:127.0.0.1:{vehicle}", "--seconds", "60", "--trace", trace]
    )
    try:
        bridge = subprocess.Popen(
            [sys.executable, EXAMPLES / "bridge.py", f"udpin:127.0.0.1:{ground}", "--selfosc", SELFOSC, "--",
             "--relay", "0.1", "--half-width", "0.15", "--interval", "0.05", "--resolution", "0.02", "--attempts", "1",
             "--largest-rate", "3", "--spread", "0.2", "--log", folder / "log.csv", "--json", folder / "model.json"]
        )  # fmt: skip
        cut_at = None
        if cut_after is not None:
            # Counted in samples of the experiment: a busy machine starts its processes late.
            give_up = time.monotonic() + 60
            while lines(folder / "log.csv") < cut_after and time.monotonic() < give_up:
                time.sleep(0.02)
            link.cut.set()
            cut_at = lines(trace)
        status = bridge.wait(timeout=60)
        time.sleep(1.5)
    finally:
        autopilot.kill()
        link.cut.set()
    commands = [float(line.split()[2]) for line in trace.read_text().splitlines() if len(line.split()) == 3]
    return status, json.loads((folder / "model.json").read_text()), commands, cut_at


@pytest.mark.parametrize(("lost", "late_s"), [(0.0, 0.0), (0.05, 0.2)])
def test_a_vehicle_is_identified_over_mavlink(tmp_path, lost, late_s):
    status, document, commands, _ = experiment(tmp_path, lost=lost, late_s=late_s)
    assert status == 0
    assert document["experiment"]["phase"] == "done"
    assert abs(document["reported"]["alpha"]["value"] / ALPHA - 1) < (0.03 if lost == 0 else 0.1)
    assert max(map(abs, commands)) <= 0.1
    assert commands[-1] == 0.0


def test_a_link_that_is_cut_ends_neutral_with_the_log(tmp_path):
    status, document, commands, cut_at = experiment(tmp_path, cut_after=100)
    assert status == 1
    assert document["experiment"]["phase"] in ("failed:gap", "aborted")
    # Neutral within the vehicle's own failsafe, half a second, and one message more.
    assert set(commands[cut_at + 12 :]) == {0.0}
    assert len((tmp_path / "log.csv").read_text().splitlines()) > 60
