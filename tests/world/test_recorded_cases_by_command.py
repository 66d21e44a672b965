"""The recorded deliveries as ``golc run`` does them: the program drives in a world, and a script asks for deliveries.

The people are slow here, so that a busy computer does not change the order of what happens.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
DELIVERY = ROOT / "examples/delivery"
SPEED = 60
PATIENCE = 300.0
ON_THE_BRICK = ("arrive_at_station", "stop_abnormally", "push_go_button")
PEOPLE = """\
[people]
script = [
    "on sound up after 8 s: press go for 6 s",
"""
LOST = """\
    "on 1st sound up after 13 s: put at 500, 600 facing 90",
    "on sound down after 0 s: put at 160, 1000 facing 100",
"""
"""On the way from 4 to 5 somebody takes the robot off the line, and puts it back as soon as it complains."""
CASES = {
    "delivery-01-initial": "",
    "delivery-02-request-mid-move": "",
    "delivery-03-lost-and-recovered": LOST,
    "delivery-04-request-then-cancel": "",
    "delivery-05-nine-requests": "",
}


def story(trace: list[dict[str, Any]]) -> list[str]:
    """What was done and what happened, in order."""
    told = []
    for entry in trace:
        told += [f"<{text}" for text in entry.get("exogenous", ())]
        if "exogenous" not in entry:
            told.append(entry.get("action", "reposition_robot"))
    return told


def script(trace: list[dict[str, Any]]) -> Iterator[str]:
    """When people asked for something, counted from the action before; a request while the robot waits takes 4 s."""
    done: Counter[str] = Counter()
    for entry in trace:
        if "exogenous" not in entry:
            last = entry.get("action", "reposition_robot")
            done[last] += 1
            continue
        delay = 0 if entry["when"] == "immediate" else 4
        for event in entry["exogenous"]:
            if event not in ON_THE_BRICK:
                yield f"on {done[last]}th {last} after {delay} s: {event}\n"


def called(record: dict[str, Any]) -> str:
    args = ",".join(map(str, record["args"]))
    name: str = record["action"]
    return name + (f"({args})" if args else "")


@pytest.mark.parametrize("case", CASES)
def test_the_command_has_the_robot_do_what_was_recorded(case: str, tmp_path: Path) -> None:
    recorded = json.loads((ROOT / "tests/cases" / f"{case}.json").read_text())
    floor, people, _ = (DELIVERY / "delivery.toml").read_text().partition("[people]\n")
    assert people
    world, events, journal = tmp_path / "world.toml", tmp_path / "people.events", tmp_path / "journal"
    world.write_text(floor + PEOPLE + CASES[case] + "]\n")
    events.write_text("# people\n" + "".join(script(recorded["trace"])))

    arguments = [DELIVERY / "delivery.gl", "--world", world, "--events", events, "--journal", journal]
    arguments += ["--speed", SPEED, "--stop-when-idle", 30]
    command = [sys.executable, "-m", "golc", "run", *map(str, arguments)]
    done = subprocess.run(command, input="\n", capture_output=True, text=True, timeout=PATIENCE, check=False)

    assert (done.returncode, done.stderr) == (0, "")
    records = [json.loads(line) for line in journal.read_text().splitlines()]
    marks = {"begin": "", "exogenous": "<"}
    told = [marks[record["event"]] + called(record) for record in records if record["event"] in marks]
    assert told == story(recorded["trace"])
    final = {fluent: value or 0 for fluent, value in records[-1]["state"].items()}
    assert final == recorded["final_fluents"]
    assert f"the robot is at station {final['location']}" in done.stdout.splitlines()[-1]
