"""python-control beside this package: time of one describing function, of a million, and accuracy under bias.

python compare/describing.py
"""

import time

import control as ct
import numpy as np

from selfosc import describing_function, nonlinearity

PIECEWISE = {
    "relay": {}, "relay-hysteresis": {"half_width": 0.5}, "relay-dead-zone": {"dead_zone": 0.4}, "saturation": {"breakpoint": 1.0},
    "saturation-asymmetric": {"lower": -1.0, "upper": 0.5}, "dead-zone": {"half_width": 0.5}, "preload": {"slope": 1.0, "level": 0.5},
    "gain-changing": {"inner_slope": 1.0, "outer_slope": 2.0, "breakpoint": 0.7}, "backlash": {"half_gap": 0.5},
    "dead-zone-saturation": {"half_width": 0.2, "breakpoint": 0.9}, "relay-dead-zone-hysteresis": {"on": 0.5, "off": 0.3},
}  # fmt: skip


def best_s(call, clock, repeats=7):
    spent = []
    for _ in range(repeats):
        begin = clock()
        call()
        spent.append(clock() - begin)
    return min(spent)


def main():
    many = np.linspace(0.6, 5.0, 1_000_000)
    print("a million amplitudes, bias 0.1: ns per element, elapsed and of processor time")
    for name, parameters in PIECEWISE.items():
        entry = nonlinearity(name, **parameters)
        spent = [1e9 / many.size * best_s(lambda e=entry: describing_function(e, many, 0.1), clock)
                 for clock in (time.perf_counter, time.process_time)]  # fmt: skip
        print(f"  {name:28}{spent[0]:8.1f}{spent[1]:8.1f}")

    print("one amplitude: us")
    few = np.linspace(1.1, 5.0, 1000)
    theirs, ours = ct.saturation_nonlinearity(1), nonlinearity("saturation", breakpoint=1)
    for label, call in {
        "python-control, its saturation": lambda: [theirs.describing_function(one) for one in few],
        "python-control, a sum of 100 points": lambda: [ct.describing_function(theirs, one, try_method=False) for one in few[:50]] * 20,
        "selfosc, the object's method": lambda: [ours.describing_function(one) for one in few],
        "selfosc, describing_function": lambda: [describing_function(ours, one) for one in few],
        "python-control over an array, its own": lambda: ct.describing_function(theirs, few),
        "python-control over an array, ours": lambda: ct.describing_function(ours, few),
        "selfosc over an array": lambda: describing_function(ours, few),
    }.items():
        scale = 50 if "sum" in label else 1000
        print(f"  {label:40}{1e6 / scale * best_s(call, time.process_time, 3):10.3f}")

    print("a saturation from -1 to 0.5 under 0.3 + 2 sin: largest error of F0, P, Q against a sum of 10 million points")
    theta = (np.arange(10_000_000) + 0.5) * 2e-7 * np.pi
    y = np.clip(0.3 + 2.0 * np.sin(theta), -1.0, 0.5)
    exact = y.mean(), (y * np.sin(theta)).mean(), (y * np.cos(theta)).mean()
    df = describing_function("saturation-asymmetric", 2.0, 0.3, lower=-1.0, upper=0.5)
    print(f"  selfosc                                 {max(abs(a - b) for a, b in zip(df, exact, strict=True)):10.1e}")
    shifted = complex(np.squeeze(ct.describing_function(lambda x: np.clip(0.3 + x, -1.0, 0.5), 2.0, zero_check=False)))
    error = float(max(abs(shifted.real - exact[1]), abs(shifted.imag - exact[2])))
    print(f"  python-control, bias written into F     {error:10.1e}   (P and Q; it has no F0)")


if __name__ == "__main__":
    main()
