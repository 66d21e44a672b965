"""Send the delivery robot to the next station and back, by hand: no theory, no planner, only the link."""

import argparse
import sys

from golc.runtime.devices.rcx import Brick, LinkError, open_tower

TURN, SIGNAL, GO = 0, 1, 2  # the numbers that the program on the brick gives its behaviours
ARRIVED, LOST, PUSHED = 3, 4, 5  # and those that it reports by itself


def wait_for(brick: Brick, *expected: int, seconds: float) -> int:
    """Poll until one of the expected events comes; other events are told and forgotten."""
    deadline = brick.tower.now() + seconds
    while brick.tower.now() < deadline:
        event = brick.poll()
        if event in expected:
            return event
        if event is not None:
            print(f"(event {event})")
    raise SystemExit(f"none of the events {expected} came within {seconds:g} s")


def drive(brick: Brick) -> None:
    for leg in ("there", "back"):
        print(f"{leg}: go", flush=True)
        brick.perform(GO)
        if wait_for(brick, ARRIVED, LOST, seconds=120) == LOST:
            raise SystemExit("lost on the way")
        print(f"{leg}: arrived, push the button", flush=True)
        brick.perform(SIGNAL)
        wait_for(brick, PUSHED, seconds=600)
        brick.perform(TURN)
    print(f"home; {brick.statistics.actions} actions, {brick.statistics.resent} messages sent twice")


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("port", help="/dev/ttyUSB0, usb:/dev/usb/legousbtower0, socket://HOST:PORT, a pty")
parser.add_argument("--speed", type=float, default=1.0, help="of a simulated brick")
arguments = parser.parse_args()
try:
    with Brick(open_tower(arguments.port, arguments.speed)) as brick:
        try:
            drive(brick)
        finally:
            brick.abort()  # whatever happened, the robot stops
except LinkError as error:
    sys.exit(f"{error}\n{error.help or ''}")
