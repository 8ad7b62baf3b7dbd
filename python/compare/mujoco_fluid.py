"""Relay experiments on bodies in MuJoCo's ellipsoid fluid model, identified without a word on the truth.

pip install mujoco
python compare/mujoco_fluid.py [experiments] [first seed]

Ten of yaw, ten of heave, ten of surge. The engine shares nothing with this project: its drag is a viscous and a quadratic one of an ellipsoid with
six degrees of freedom, and the truth is the force over the acceleration that the engine itself gives at rest. Beside the axis of the experiment
those move that it drives: sway and surge under yaw, pitch under heave and surge.
"""

import math
import sys

import mujoco
import numpy as np

import selfosc

BODY = """
<mujoco>
  <option timestep="0.002" integrator="RK4" gravity="0 0 0" density="1000" viscosity="{viscosity}"/>
  <worldbody>
    <body name="hull">
      {joints}
      <inertial pos="0 0 0" mass="{mass}" diaginertia="{inertia}"/>
      <geom type="ellipsoid" size="{size}" pos="{ahead} 0 0" mass="0" fluidshape="ellipsoid" fluidcoef="{blunt} {slender} {angular} 1 1"/>
    </body>
  </worldbody>
</mujoco>
"""
JOINTS = {
    "yaw": '<joint name="axis" type="hinge" axis="0 0 1"/><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>',
    "heave": '<joint name="axis" type="slide" axis="0 0 1"/><joint type="hinge" axis="0 1 0" stiffness="{righting}"/>',
    "surge": '<joint name="axis" type="slide" axis="1 0 0"/><joint type="hinge" axis="0 1 0" stiffness="{righting}"/>',
}
# Half-width of the relay in rad or m, noise and step of the sensor: a compass with a gyroscope, a pressure gauge, an acoustic fix.
SENSOR = {"yaw": (0.25, 0.005, 0.00175), "heave": (0.15, 0.004, 0.001), "surge": (0.3, 0.01, 0.001)}
INTERVAL_S, CYCLES = 0.1, 10


def body(kind, draw):
    length, width, height = draw.uniform(0.25, 0.8), draw.uniform(0.1, 0.25), draw.uniform(0.1, 0.25)
    mass = 1000 * 4 / 3 * math.pi * length * width * height * draw.uniform(0.9, 1.1)
    inertia = [mass / 5 * (a * a + b * b) for a, b in ((width, height), (length, height), (length, width))]
    righting = 9.81 * mass * draw.uniform(0.02, 0.05)
    return BODY.format(
        viscosity=10 ** draw.uniform(-3, 0), joints=JOINTS[kind].format(righting=righting), mass=mass,
        inertia=" ".join(map(str, inertia)), size=f"{length} {width} {height}", ahead=draw.uniform(-0.02, 0.02) * length,
        blunt=draw.uniform(0.3, 0.8), slender=draw.uniform(0.1, 0.4), angular=draw.uniform(0.8, 2.0),
    )  # fmt: skip


def experiment(kind, seed):
    """Time, output, command, and the true inertia."""
    draw = np.random.default_rng(seed)
    model = mujoco.MjModel.from_xml_string(body(kind, draw))
    data = mujoco.MjData(model)
    axis = model.joint("axis").dofadr[0]
    data.qfrc_applied[axis] = 1.0
    mujoco.mj_forward(model, data)
    alpha = 1.0 / data.qacc[axis]

    half_width, noise, step = SENSOR[kind]
    # A period of some eight seconds, if there were no drag: a quarter of it for the half-width and what follows.
    force = alpha * 4 * half_width / draw.uniform(1.5, 2.5) ** 2
    delta, delay_s = draw.uniform(-0.15, 0.15) * force, draw.uniform(0.05, 0.3)
    steps, late = round(INTERVAL_S / model.opt.timestep), round(delay_s / model.opt.timestep)
    waiting, command, switched = [force] * late, force, 0
    time_s, output, given = [], [], []
    while switched <= 2 * CYCLES and data.time < 300.0:
        reading = step * round((data.qpos[model.joint("axis").qposadr[0]] + draw.normal(0.0, noise)) / step)
        if command * reading > 0 and abs(reading) >= half_width:
            command, switched = -command, switched + 1
        time_s.append(data.time), output.append(reading), given.append(command)
        for _ in range(steps):
            waiting.append(command)
            data.qfrc_applied[axis] = waiting.pop(0) + delta
            mujoco.mj_step(model, data)
    return {"time_s": time_s, "output": output, "input": given}, alpha


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 30
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    print("| axis | seed | true inertia | reported | error, % | practical, % | trust | holds: practical, statistical |")
    print("|---|---:|---:|---:|---:|---:|---|---|")
    held, trusted = np.zeros(3, int), 0
    for number in range(count):
        kind, seed = list(JOINTS)[number % 3], first + number
        record, truth = experiment(kind, seed)
        found = selfosc.identify(record)
        alpha, trust = found.reported["alpha"], found.trust
        wide = alpha["combined"]
        holds = [wide["low"] <= truth <= wide["high"], alpha["low"] <= truth <= alpha["high"], wide["low"] <= 1.1 * truth <= wide["high"]]
        value = alpha["value"]
        if trust != "doubtful":
            held, trusted = held + holds, trusted + 1
        print(
            f"| {kind} | {seed} | {truth:.4g} | {value:.4g} | {100 * (value / truth - 1):+.2f} | {50 * (wide['high'] - wide['low']) / value:.2f} | {trust} | "
            f"{', '.join('yes' if one else 'no' for one in holds[:2])} |"
        )
    print(f"\nOf {count}, {trusted} trusted; the practical interval holds {held[0]} of them, the statistical one {held[1]}.")
    print(f"An inertia 10 % above the true one is in {held[2]} practical intervals.")


if __name__ == "__main__":
    main()
