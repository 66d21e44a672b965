"""Three examples are there as text and in Python: equal theories, equal NQC, equal traces."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from golc.cli import invoke
from golc.diagnostics import Findings
from golc.embed.modules import read_theory
from golc.loading import load
from golc.syntax.parse import parse_file
from golc.syntax.text import read_source

EXAMPLES = Path(__file__).parents[2] / "examples"
BOTH = ["delivery/delivery", "elevator/elevator", "sorter/sorter"]


@pytest.mark.parametrize("name", BOTH)
def test_the_trees_and_the_theories_are_equal(name: str) -> None:
    text, python = EXAMPLES / f"{name}.gl", EXAMPLES / f"{name}.py"

    assert read_theory(python).file == parse_file(read_source(text), Findings())
    first, second = load(text), load(python)
    assert (first.fluents, first.actions, first.procedures) == (second.fluents, second.actions, second.procedures)
    assert (first.devices, first.types, first.scenarios) == (second.devices, second.types, second.scenarios)


@pytest.mark.parametrize("name", BOTH)
def test_the_nqc_programs_are_equal(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = Path(shutil.copytree((EXAMPLES / name).parent, tmp_path / "example"))
    monkeypatch.chdir(folder)
    stem = Path(name).stem
    programs = []
    for form in ("gl", "py"):
        assert invoke(["gen-nqc", f"{stem}.{form}", "-o", form]) == 0
        (program,) = Path(form).glob("*.nqc")
        programs.append(re.sub(rf"{stem}\.(gl|py)|sealed.*", "", program.read_text(encoding="utf-8")))

    assert programs[0] == programs[1]


@pytest.mark.parametrize("name", BOTH)
def test_the_scenarios_go_alike(name: str, capfd: pytest.CaptureFixture[str]) -> None:
    said = []
    for form in ("gl", "py"):
        assert invoke(["test", str(EXAMPLES / f"{name}.{form}")]) == 0
        said.append(capfd.readouterr().out.replace(f".{form}:", ":"))

    assert said[0] == said[1]
    assert "ok" in said[0]


@pytest.mark.parametrize("name", BOTH)
def test_the_robots_do_the_same(name: str, tmp_path: Path) -> None:
    traces = []
    for form in ("gl", "py"):
        journal = tmp_path / form
        command = ["run", f"{name}.{form}", "--speed", "100", "--stop-when-idle", "40", "--journal", str(journal)]
        subprocess.run([sys.executable, "-m", "golc", *command], cwd=EXAMPLES, stdin=subprocess.DEVNULL, check=True)
        entries = [json.loads(line) for line in journal.read_text(encoding="utf-8").splitlines()]
        happened = [entry for entry in entries if "action" in entry]
        traces.append([(each["event"], each["action"], each.get("args"), each.get("results")) for each in happened])

    assert traces[0] == traces[1]
    assert len(traces[0]) > 10
