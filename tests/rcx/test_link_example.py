"""The example without a theory, with a small brick and with none."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

EXAMPLE = Path(__file__).parents[2] / "examples" / "remote" / "drive.py"


def drive(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, EXAMPLE, *arguments], capture_output=True, text=True, timeout=60)


def test_the_robot_goes_there_and_back(small_brick: Callable[..., Any]) -> None:
    answers = {
        "34": [[64]],
        "33": [[64]],
        "32": [[64]],
        "81": [[]],
        "83": [[84], [35], [84], [37], [35], [37], [84]],
    }
    far = small_brick("pty", answers)
    done = drive(far.port)
    assert done.stderr == ""
    assert done.stdout == (
        "there: go\nthere: arrived, push the button\nback: go\nback: arrived, push the button\n"
        "home; 6 actions, 0 messages sent twice\n"
    )
    assert done.returncode == 0
    heard = far.heard()
    assert [number for number in heard if number != 83] == [34, 33, 32, 34, 33, 32, 81, 81, 81]


def test_a_lost_robot_is_stopped(small_brick: Callable[..., Any]) -> None:
    far = small_brick("pty", {"34": [[64]], "81": [[]], "83": [[36], [84]]})
    done = drive(far.port)
    assert (done.returncode, done.stderr) == (1, "lost on the way\n")
    assert 81 in far.heard()


def test_a_missing_port_is_told() -> None:
    done = drive("/dev/no-such-tower")
    assert done.returncode == 1
    assert done.stderr.startswith("the port /dev/no-such-tower does not exist\nis the tower plugged in?")
