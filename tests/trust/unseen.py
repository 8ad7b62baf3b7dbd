"""Twenty structures outside the plain model, by a simulator of its own: how often practical intervals hold the inertia.

    python3 tests/trust/unseen.py target/release/selfosc [records] [first seed] [first kind] [end]

Vehicles are those of `budget.py` with one structure more each; the alpha that counts is in units of the nominal thrust.
Defaults: 15 records of each kind, seeds from 5560000 on, all kinds.
"""

import math
import random
import sys
import tempfile
from pathlib import Path

from budget import DEGREE, vehicle
from practical import Score, identified

RATE_HZ, DURATION_S, STEPS = 10.0, 60.0, 20

#: Each structure with its numbers; times in s, forces in the relay's level, angles in rad.
KINDS = {
    "hard iron 1 degree": {"iron": 1.0 * DEGREE},
    "hard iron 3 degrees": {"iron": 3.0 * DEGREE},
    "soft iron 1 degree": {"iron": 1.0 * DEGREE, "cycles": 2.0},
    "sensor gain 0.5 %": {"gain": 1.005},
    "stamps 0.25 % fast": {"clock": 1.0025},
    "wash 10 %, 0.3 s": {"wash": 0.1, "wash_s": 0.3},
    "wash -10 %, 1 s": {"wash": -0.1, "wash_s": 1.0},
    "spin-up 0.3 s, spin-down 0.1 s": {"up_s": 0.3, "down_s": 0.1},
    "lags 0.05 s and 0.35 s": {"lags_s": (0.05, 0.35)},
    "thrust falls 10 % at top speed": {"inflow": 0.1},
    "pause of 0.1 s at a reversal": {"pause_s": 0.1},
    "negative restoring force 0.02 C/rad": {"stiffness": -0.02},
    "slack tether, 0.1 C/rad beyond 0.15 rad": {"tether": 0.1, "slack": 0.15},
    "restoring force of the sine of heading, 0.05 C": {"sine": 0.05},
    "force steps by 0.05 C in the middle": {"step": 0.05},
    "force grows by 0.1 C over the record": {"ramp": 0.1},
    "inertia 5 % larger ahead than astern": {"sided": 0.05},
    "drag of power 1.8": {"power": 1.8},
    "sloshing mass of 5 %, 2 rad/s": {"slosh": 0.05, "slosh_rad_s": 2.0},
    "thrust sags by 5 %, fast at first": {"sag": 0.05},
}


def simulate(axis, seed, s):
    """Times, headings and commands of a vehicle with one structure more."""
    draw = random.Random(seed + 7)
    step_s = 1.0 / (RATE_HZ * STEPS)
    late = round(axis["delay_s"] / step_s)
    get = lambda name, usual=0.0: s.get(name, usual)  # noqa: E731
    speed = math.sqrt(2.0 * axis["half_width"] / axis["alpha"])
    x = v = spun = second = swung = swinging = 0.0
    command = acted = 1.0
    since_s, sent, times, headings, commands = 100.0, [], [], [], []

    def pull(x, v, force, elapsed, swung):
        drag = axis["beta"] * v + axis["beta_quadratic"] * abs(v) * v
        if "power" in s:
            scale = axis["beta"] * speed + axis["beta_quadratic"] * speed**2
            drag = math.copysign(scale * (abs(v) / speed) ** s["power"], v)
        taut = max(0.0, abs(x) - get("slack")) * get("tether")
        outside = axis["delta"] + get("step") * (elapsed > 0.5) + get("ramp") * (elapsed - 0.5)
        total = force + outside - drag - get("stiffness") * x - math.copysign(taut, x) - get("sine") * math.sin(x)
        alpha = axis["alpha"] * (1.0 + get("sided") * (0.5 if v > 0.0 else -0.5))
        if "slosh" in s:
            # A mass on a spring in the vehicle; alpha counts both.
            spring = s["slosh"] * alpha * s["slosh_rad_s"] ** 2
            return (total + spring * swung) / (alpha * (1.0 - s["slosh"]))
        return total / alpha

    for k in range(int(DURATION_S * RATE_HZ) * STEPS):
        if k % STEPS == 0:
            seen = get("gain", 1.0) * (x + get("iron") * math.sin(get("cycles", 1.0) * x + axis["phase"]))
            seen += draw.gauss(0.0, 0.3 * DEGREE)
            command = -1.0 if seen > axis["half_width"] else 1.0 if seen < -axis["half_width"] else command
            times.append(get("clock", 1.0) * k * step_s)
            headings.append(seen)
            commands.append(command)
        sent.append(command)
        now = sent[max(0, k - late)]
        since_s = 0.0 if now != acted else since_s + step_s
        acted = now
        force = now
        elapsed = k * step_s / DURATION_S
        if "up_s" in s:
            tau = s["up_s"] if now * spun >= 0.0 and abs(now) > abs(spun) else s["down_s"]
            spun += (now - spun) * -math.expm1(-step_s / tau)
            force = spun
        if "lags_s" in s:
            spun += (now - spun) * -math.expm1(-step_s / s["lags_s"][0])
            second += (spun - second) * -math.expm1(-step_s / s["lags_s"][1])
            force = second
        if since_s < get("pause_s"):
            force = 0.0
        force *= 1.0 + get("wash") * math.exp(-since_s / get("wash_s", 1.0))
        # The mean over the record is the nominal thrust.
        force *= 1.0 - get("sag") * (math.exp(-3.0 * elapsed) - 0.317)
        if "inflow" in s:
            force *= 1.0 - s["inflow"] * max(0.0, v * math.copysign(1.0, force)) / speed
        a1 = pull(x, v, force, elapsed, swung)
        a2 = pull(x + 0.5 * step_s * v, v + 0.5 * step_s * a1, force, elapsed, swung)
        a3 = pull(x + 0.5 * step_s * (v + 0.5 * step_s * a1), v + 0.5 * step_s * a2, force, elapsed, swung)
        a4 = pull(x + step_s * (v + 0.5 * step_s * a2), v + step_s * a3, force, elapsed, swung)
        x += step_s * (v + step_s * (a1 + a2 + a3) / 6.0)
        if "slosh" in s:
            # Of the mass against the vehicle, by the symplectic Euler method.
            swinging -= step_s * (s["slosh_rad_s"] ** 2 * swung + 0.2 * swinging + a2)
            swung += step_s * swinging
        v += step_s * (a1 + 2.0 * a2 + 2.0 * a3 + a4) / 6.0
    return times, headings, commands


def main():
    command = str(Path(sys.argv[1]).resolve())
    records, first, begin, end = (int(sys.argv[k]) if len(sys.argv) > k else usual for k, usual in enumerate((15, 5560000, 0, len(KINDS)), 2))
    together = Score()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "log.csv"
        for name, structure in list(KINDS.items())[begin:end]:
            score = Score()
            for seed in range(first, first + records):
                axis = vehicle(seed)
                rows = [f"{t:.6f},{x:.6f},{u:g}" for t, x, u in zip(*simulate(axis, seed, structure))]
                path.write_text("time_s,heading,input\n" + "\n".join(rows) + "\n")
                reported = identified(command, path, None)
                for one in (score, together):
                    one.count(reported, axis["alpha"])
            print(score.row(name), flush=True)
    print(together.row("**unseen**"), flush=True)


if __name__ == "__main__":
    main()
