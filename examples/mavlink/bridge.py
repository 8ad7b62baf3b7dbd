"""A relay experiment on the heading of a vehicle that speaks MAVLink: `selfosc run` between ATTITUDE and MANUAL_CONTROL.

python bridge.py udpin:127.0.0.1:14550 -- --relay 0.2 --half-width 0.2 --interval 0.05 --log log.csv --json model.json

Needs pymavlink, and `selfosc` on the path. Arming and the mode are the pilot's: the bridge only steers, in yaw, and only while
the experiment runs. Everything after `--` goes to `selfosc run`; the relay's level is a share of full yaw, from 0 to 1.
"""

import argparse
import subprocess
import sys

from pymavlink import mavutil

FULL = 1000  # MANUAL_CONTROL counts from -1000 to 1000
NEUTRAL_THROTTLE = 500  # of a vehicle that dives: z from 0 to 1000


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("link", help="as pymavlink writes it, such as udpin:0.0.0.0:14550 or /dev/ttyUSB0")
    parser.add_argument("--selfosc", default="selfosc", help="the command")
    parser.add_argument("--silence", type=float, default=0.5, help="s without a message after which the experiment ends")
    own = sys.argv[1 : sys.argv.index("--")] if "--" in sys.argv else sys.argv[1:]
    arguments, of_run = parser.parse_args(own), sys.argv[len(own) + 2 :]

    link = mavutil.mavlink_connection(arguments.link, source_system=255)
    if link.wait_heartbeat(timeout=10) is None:
        print("no heartbeat within 10 s; check the link's address", file=sys.stderr)
        return 2
    command = [arguments.selfosc, "run", "--coordinate", "heading-rad", "--timeout", str(arguments.silence), *of_run]
    experiment = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)

    def steer(command: float) -> None:
        yaw = round(FULL * max(-1.0, min(1.0, command)))
        link.mav.manual_control_send(link.target_system, 0, 0, NEUTRAL_THROTTLE, yaw, 0)

    last_ms, phase = -1, "running"
    try:
        while phase == "running":
            message = link.recv_match(type="ATTITUDE", blocking=True, timeout=arguments.silence)
            if message is None:
                break
            # What comes late or twice says nothing new.
            if message.time_boot_ms <= last_ms:
                continue
            last_ms = message.time_boot_ms
            print(last_ms / 1000, message.yaw, file=experiment.stdin)
            line = experiment.stdout.readline()
            if not line:
                break
            command, phase = line.split()
            steer(float(command))
    finally:
        # The end of its input ends the experiment; the vehicle is told several times, since packets are lost.
        experiment.stdin.close()
        for _ in range(10):
            steer(0.0)
    return experiment.wait()


if __name__ == "__main__":
    sys.exit(main())
