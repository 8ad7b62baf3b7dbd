"""A simulated vehicle that speaks MAVLink 2 over UDP: ATTITUDE out, MANUAL_CONTROL in, its own failsafe without either.

python autopilot.py udpout:127.0.0.1:14550

It shares nothing with selfosc: yaw by semi-implicit Euler steps of a millisecond, linear and quadratic drag, pymavlink's own messages.
"""

import argparse
import math
import os
import time

os.environ["MAVLINK20"] = "1"
from pymavlink import mavutil  # noqa: E402

ALPHA, BETA, BETA_QUADRATIC, FORCE = 0.05, 0.03, 0.06, 0.004
PERIOD_S, STEP_S, FAILSAFE_S = 0.05, 0.001, 0.5


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("link")
    parser.add_argument("--seconds", type=float, default=120.0)
    parser.add_argument("--trace", help="a file for lines `time yaw command`")
    arguments = parser.parse_args()
    link = mavutil.mavlink_connection(arguments.link, source_system=1)
    trace = open(arguments.trace, "w", encoding="ascii", buffering=1) if arguments.trace else None
    begun = heard = time.monotonic()
    yaw = rate = command = 0.0
    beats = 0
    for sample in range(round(arguments.seconds / PERIOD_S)):
        now = time.monotonic()
        if sample % 10 == 0:
            link.mav.heartbeat_send(mavutil.mavlink.MAV_TYPE_SUBMARINE, mavutil.mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, 0, 0, 0)
            beats += 1
        while (message := link.recv_match(type="MANUAL_CONTROL")) is not None:
            command, heard = message.r / 1000, now
        if now - heard > FAILSAFE_S:
            command = 0.0
        for _ in range(round(PERIOD_S / STEP_S)):
            force = command + FORCE - (BETA + BETA_QUADRATIC * abs(rate)) * rate
            rate += STEP_S * force / ALPHA
            yaw += STEP_S * rate
        wrapped = math.remainder(yaw, math.tau)
        link.mav.attitude_send(round(1000 * sample * PERIOD_S), 0, 0, wrapped, 0, 0, rate)
        if trace:
            print(f"{now - begun:.3f} {yaw:.5f} {command:.4f}", file=trace)
        time.sleep(max(0.0, begun + (sample + 1) * PERIOD_S - time.monotonic()))


if __name__ == "__main__":
    main()
