"""The gates that may be closed, on a simulated brick: what is sensed decides how the run goes on."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from golc.cli import invoke

GATES = Path(__file__).parents[2] / "examples/gates/gates.gl"


@pytest.mark.parametrize("program", ["control", "think_first"])
def test_the_robot_gets_in_whatever_it_sees(program: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    journal = tmp_path / "journal"
    code = invoke(["run", str(GATES), program, "--speed", "20", "--journal", str(journal)])
    out, err = capfd.readouterr()
    assert (code, err) == (0, "")
    assert "inside = true" in out
    records: list[dict[str, Any]] = [json.loads(line) for line in journal.read_text().splitlines()]
    done = [record for record in records if record["event"] == "done"]
    assert [record["action"] for record in done][-1] == "drive_in"
    # Of the three gates it looks at two at most, and changes the place only when a gate is closed.
    seen = [record["results"] for record in done if record["action"] == "look"]
    moved = [record["args"] for record in done if record["action"] == "change_to"]
    assert seen[:-1] == [["closed"]] * (len(seen) - 1)
    assert len(moved) == seen.count(["closed"]) <= 2
