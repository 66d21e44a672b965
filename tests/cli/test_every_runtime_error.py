"""Every error of the language at run time, as a user gets it: its code, its words and its place.

They are listed in ``runtime_errors.txt``: code, command and message; then the text of a domain, below the declarations
here, with the place between « and ». A single clause is that of an action that ``control`` does; a single line with
``event`` stands in a script of events, one with ``expect`` in a scenario.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from textwrap import dedent
from typing import NamedTuple

import pytest

from golc.cli import invoke
from golc.diagnostics import Code
from golc.situation import worlds

DECLARATIONS = """domain d
type t = 1..3
fluent x: int = 0
fluent y: t = 1
fluent z: t? = none
fluent on(n: t) = false
fluent flag: bool? = none
fluent fuel: real = 0.5
fluent queue: list[t] = []
fluent bag: set[t] = {1}
fluent route: list[t]? = none
fluent hidden: t = unknown
fluent here: bool = unknown
fluent there: bool = unknown
define same(n: t) := n = y
extern half(n: t): int from "half.py"
action go(n: t)
action look:
    senses y
"""
HALF = """def half(n):
    if n > 2:
        raise ValueError(n)
    return n / 2
"""
DEVICES = """
device self:
    go
device host "look.py":
    look
"""


class Entry(NamedTuple):
    """An error: its first line as golc writes it, the command that meets it, and the text with the marked place."""

    head: str
    command: list[str]
    text: str

    def __str__(self) -> str:
        return f"{self.head[6:11]} {self.text}"


def entries() -> Iterator[Entry]:
    for entry in (Path(__file__).parent / "runtime_errors.txt").read_text(encoding="utf-8").split("\n\n"):
        head, _, text = entry.partition("\n")
        what, _, message = head.partition(": ")
        code, *command = what.split()
        yield Entry(f"error[{code}]: {message}", command, dedent(text).strip())


ENTRIES = [*entries()]


@pytest.fixture(autouse=True)
def half(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The file of the Python function, in the folder where commands run."""
    (tmp_path / "half.py").write_text(HALF)
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def limits(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Few cases are too many; the command line leaves the limit of recursion as it was."""
    monkeypatch.setattr(worlds, "MOST_CASES", 11)
    before = sys.getrecursionlimit()
    yield
    sys.setrecursionlimit(before)


def of(command: str) -> list[Entry]:
    return [entry for entry in ENTRIES if entry.command[0] == command]


def written(path: Path, marked: str) -> str:
    """Write a text without its marks; the place between them: ``line:column``, and what stands there."""
    text = marked.replace("«", "").replace("»", "")
    path.write_text(text, encoding="utf-8")
    if "«" not in marked:
        return ""
    start, end = marked.index("«"), marked.index("»") - 1
    return f"{text.count(chr(10), 0, start) + 1}:{start - text.rfind(chr(10), 0, start)} {text[start:end]}"


def told(error: str) -> tuple[str, str]:
    """The first line of an error, and its place: ``line:column``, and what is underlined."""
    head, arrow, _, line, carets, *_ = error.splitlines()
    line, carets = line.partition("| ")[2], carets.partition("| ")[2]
    start = carets.index("^")
    return head, f"{':'.join(arrow.split(':')[-2:])} {line[start : start + carets.count('^')]}"


@pytest.mark.usefixtures("limits")
@pytest.mark.parametrize("entry", of("plan"), ids=str)
def test_plans(tmp_path: Path, capsys: pytest.CaptureFixture[str], entry: Entry) -> None:
    text = entry.text
    if text.startswith(("causes", "cost")):
        text = f"action a:\n    {text}\nproc control:\n    a"
    place = written(tmp_path / "d.gl", f"{DECLARATIONS}{text}\n")
    assert invoke([*entry.command, "-q", "d.gl"]) == 5
    assert told(capsys.readouterr().err) == (entry.head, place)


@pytest.mark.usefixtures("limits")
@pytest.mark.parametrize("entry", of("test"), ids=str)
def test_scenarios(tmp_path: Path, capsys: pytest.CaptureFixture[str], entry: Entry) -> None:
    text = f"proc control:\n    go(1)\nscenario s:\n    run control\n    {entry.text}"
    place = written(tmp_path / "d.gl", f"{DECLARATIONS}{text}\n")
    assert invoke(["test", str(tmp_path / "d.gl")]) == 1
    _, _, error = capsys.readouterr().out.partition("\n")
    assert told(error) == (entry.head, place)


@pytest.mark.parametrize("entry", of("run"), ids=str)
def test_runs(tmp_path: Path, entry: Entry) -> None:
    written(tmp_path / "look.py", "def look():\n    return 3\n")
    text, event = entry.text, "at 0 s: hit(1)" if "hit" in entry.text else "# nothing"
    if text.startswith("event"):
        text, event = "exog hit(n: t)\nproc control:\n    wait", text.removeprefix("event ")
    place = written(tmp_path / "d.gl", f"{DECLARATIONS}{text}{DEVICES}") or written(tmp_path / "events", event)
    written(tmp_path / "events", event)
    command = [sys.executable, "-m", "golc", "run", "d.gl", "--events", "events", "--check-invariants"]
    command += ["-q", "--on-impossible-exog", "stop", "--on-surprising-sensing", "stop"]
    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, stdin=subprocess.DEVNULL, text=True, timeout=60, check=False
    )
    assert done.returncode == (1 if entry.text.startswith("event") else 5)
    assert told(done.stderr) == (entry.head, place)


def test_every_code_of_the_run_time_has_an_entry() -> None:
    listed = {entry.head[6:11] for entry in ENTRIES}
    warning = Code.EVENT_OF_BRICK  # which is never an error
    assert listed == {code.code for code in Code if "GL100" <= code.code < "GL140"} - {warning.code}
