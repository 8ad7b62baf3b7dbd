"""The same records fitted by this package, by a scipy output-error fit and by CasADi multiple shooting: accuracy and time.

    python compare/fits.py [records]

Records are of one axis with quadratic drag in a relay loop, sampled at 10 Hz with noise; the delay is known to all three. The
others fit the same model, ``alpha x'' + beta |x'| x' = u + delta`` with the initial state, and begin where a first guess by hand
would: a factor of two off.
"""

import sys
import time

import casadi
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares

import selfosc

TRUTH = {"alpha": 0.03, "beta_quadratic": 0.02}
LOOP = {"relay": 0.08, "half_width": 0.3, "hold": True, "cycles": 8, "noise": 0.01}
START = np.array([0.06, 0.01, 0.0, 0.0, 0.0])


def by_selfosc(record):
    answer = selfosc.identify(record, method="fit", drag="quadratic", delay=0.0).estimates[-1]
    return answer["alpha"]["value"], answer["beta_quadratic"]["value"]


def by_scipy(record):
    """Output error: the whole record simulated from its initial state, interval by interval of the held command."""
    t, y, u = (np.asarray(column) for column in record.values())

    def residuals(theta):
        alpha, beta, delta, x0, v0 = theta
        x, v, model = x0, v0, np.empty_like(y)
        for index in range(len(t)):
            model[index] = x
            if index + 1 < len(t):
                force = u[index] + delta
                motion = solve_ivp(
                    lambda _, s, force=force: [s[1], (force - beta * abs(s[1]) * s[1]) / alpha],
                    (t[index], t[index + 1]), [x, v], rtol=1e-8, atol=1e-10,
                )  # fmt: skip
                x, v = motion.y[:, -1]
        return model - y

    found = least_squares(residuals, START, bounds=([1e-4, 0, -1, -1, -1], 1.0), x_scale=[0.03, 0.02, 0.01, 0.1, 0.1])
    return found.x[0], found.x[1]


def by_casadi(record):
    """Multiple shooting: a state at every sample, one Runge-Kutta step of the motion between, ipopt."""
    t, y, u = (np.asarray(column) for column in record.values())
    parameters, states = casadi.MX.sym("p", 3), casadi.MX.sym("s", 2, len(t))
    s, p, force, h = casadi.MX.sym("s", 2), casadi.MX.sym("p", 3), casadi.MX.sym("u"), casadi.MX.sym("h")

    def motion(s):
        return casadi.vertcat(s[1], (force + p[2] - p[1] * casadi.fabs(s[1]) * s[1]) / p[0])

    k1 = motion(s)
    k2 = motion(s + h / 2 * k1)
    k3 = motion(s + h / 2 * k2)
    k4 = motion(s + h * k3)
    step = casadi.Function("step", [s, p, force, h], [s + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)]).map(len(t) - 1)
    ends = step(states[:, :-1], casadi.repmat(parameters, 1, len(t) - 1), u[:-1].reshape(1, -1), np.diff(t).reshape(1, -1))
    problem = {
        "x": casadi.vertcat(parameters, casadi.vec(states)),
        "f": casadi.sumsqr(states[0, :].T - y),
        "g": casadi.vec(ends - states[:, 1:]),
    }
    solver = casadi.nlpsol("fit", "ipopt", problem, {"ipopt.print_level": 0, "print_time": 0, "ipopt.sb": "yes"})
    start = np.concatenate([START[:3], np.column_stack([y, np.gradient(y, t)]).ravel()])
    lower = np.concatenate([[1e-4, 0.0, -1.0], np.full(2 * len(t), -np.inf)])
    found = solver(x0=start, lbx=lower, lbg=0, ubg=0)["x"].full().ravel()
    return found[0], found[1]


def main(count):
    records = [selfosc.simulate(**TRUTH, **LOOP, seed=seed) for seed in range(100, 100 + count)]
    print(f"{count} records of {len(records[0]['time_s'])} samples, noise {LOOP['noise']} rad\n")
    print(f"| {'':30} | alpha, rms error % | beta_quadratic, rms error % | s per record |")
    print(f"|{'-' * 32}|---:|---:|---:|")
    ways = {"selfosc 0.1": by_selfosc, "scipy, output error": by_scipy, "CasADi, multiple shooting": by_casadi}
    for name, fit in ways.items():
        begin = time.process_time()
        found = np.array([fit(record) for record in records])
        spent = (time.process_time() - begin) / count
        error = 100.0 * np.sqrt(np.mean((found / list(TRUTH.values()) - 1.0) ** 2, axis=0))
        print(f"| {name:30} | {error[0]:.3f} | {error[1]:.3f} | {spent:.3g} |")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 20)
