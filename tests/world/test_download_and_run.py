"""All of it as with a brick: the real nqc sends the program to one ``golc sim``, and ``golc run`` finds it there."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

DELIVERY = Path(__file__).parents[2] / "examples/delivery"
SPEED = "5"
NEARER = ("[stations.4]\nalong = 1900", "[stations.4]\nalong = 1500")
PATIENCE = 120.0
Start = Callable[..., "subprocess.Popen[str]"]


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Start]:
    """Starts golc in a folder of its own; ends what is still running after the test."""
    running: list[subprocess.Popen[str]] = []

    def golc(*arguments: object) -> subprocess.Popen[str]:
        command = [sys.executable, "-m", "golc", *map(str, arguments)]
        pipe = subprocess.PIPE
        running.append(subprocess.Popen(command, cwd=tmp_path, stdin=pipe, stdout=pipe, stderr=pipe, text=True))
        return running[-1]

    yield golc
    for child in running:
        child.kill()
        child.communicate()


@pytest.mark.parametrize("target", ["rcx", "rcx2"])
def test_a_program_that_nqc_has_sent_drives_for_the_host(start: Start, tmp_path: Path, target: str) -> None:
    text = (DELIVERY / "delivery.toml").read_text()
    assert NEARER[0] in text
    (tmp_path / "room.toml").write_text(text.replace(*NEARER))
    start("gen-nqc", DELIVERY / "delivery.gl", "--target", target, "--compile", "-o", tmp_path).communicate()

    room = ["--world", "room.toml", "--trace", "trace.jsonl", "--picture", "way.svg"]
    brick = start("sim", "--target", target, *room, "--pty", "brick", "--speed", SPEED, "--air-time", 0.1)
    assert brick.stdout is not None
    assert brick.stdout.readline() == "pty brick\n"
    command = ["nqc", "-Sbrick", "-b", "-d", "delivery-rcx.rcx", "-run"]
    sent = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=PATIENCE, check=False)
    assert (sent.returncode, "complete" in sent.stderr) == (0, True)

    host = start("run", DELIVERY / "delivery.gl", "--port", "brick", "--speed", SPEED)
    assert host.stdout is not None
    assert host.stdin is not None
    lines = iter(host.stdout.readline, "")
    next(line for line in lines if "← push_go_button" in line)
    host.stdin.write("!stop\n")
    host.stdin.flush()
    rest = "".join(lines)
    assert host.wait(PATIENCE) == 0
    assert "location = 4" in rest
    assert "holding_delivery_for holds for 6" in rest

    brick.terminate()
    out, _ = brick.communicate(timeout=PATIENCE)
    assert brick.returncode == 0
    assert "the robot is at" in out
    assert (tmp_path / "way.svg").read_text().startswith("<svg")
    kinds = {json.loads(line)["what"] for line in (tmp_path / "trace.jsonl").read_text().splitlines()}
    assert kinds >= {"downloaded", "task", "heard", "sent", "motor", "sensor", "sound", "reaches", "press"}
