"""The journal: what it says, and that it is never torn."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from golc.diagnostics import DeviceError, ProgramError, UserError
from golc.loading import load
from golc.runtime.loop import happenings
from golc.runtime.loop.happenings import Happening
from golc.runtime.loop.inbox import Refusal, Report
from golc.runtime.observers.journal import EVENTS, Journal, fingerprint
from golc.theory.theory import BasicActionTheory

Start = Callable[..., Any]

TRIAL = """
domain trial
const limit = 2
type digit = 0..limit
type colour = {red, green}
fluent x: digit = 0
fluent seen: colour = red
action set_x(n: digit):
    causes x := n
action look:
    senses seen
exog become(n: digit):
    poss n != x
    causes x := n
proc control:
    set_x(1)
    look
    say "x is {x}"
    wait
    test x = 1
"""


def records_of(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text().splitlines()]


def journalled(start: Start, path: Path, text: str = TRIAL, **world: Any) -> tuple[Any, list[dict[str, Any]]]:
    run = start(text, **world)
    journal = Journal(path, run.executive.dynamics, "control", ())
    run.executive.observers.append(journal)
    try:
        run.run()
    except ProgramError:
        pass
    finally:
        journal.close()
    return run, records_of(path)


def test_everything_that_happened_is_there_in_order(start: Start, tmp_path: Path) -> None:
    def perform(action: str, args: object) -> tuple[str, ...]:
        return ("green",) if action == "look" else ()

    batches = [[Refusal("nonsense", "stdin", ()), Report("become", (2,), "tcp")]]
    _, records = journalled(start, tmp_path / "j", batches=batches, perform=perform)

    assert [record["event"] for record in records] == [
        "start", "begin", "done", "begin", "done", "say", "wait", "refused", "exogenous", "blocked", "end",
    ]  # fmt: skip
    begin, done = records[3:5]
    assert (begin["action"], begin["args"], begin["device"], begin["at"]) == ("look", [], "world", "trial.gl:17:5")
    assert (done["results"], done["surprises"]) == (["green"], {"seen": "green"})
    assert records[5]["text"] == "x is 1"
    assert records[8]["source"] == "tcp"
    assert records[8]["args"] == [2]
    assert records[9]["reasons"][0]["values"] == {"x": 2}
    end = records[-1]
    assert (end["reason"], end["state"], end["actions"]) == ("failed", {"x": 2, "seen": "green"}, 2)
    assert {record["time"] for record in records} == {0.0}


def test_it_begins_with_what_was_run(start: Start, tmp_path: Path) -> None:
    run, records = journalled(start, tmp_path / "j")

    first = records[0]
    assert (first["domain"], first["procedure"], first["args"]) == ("trial", "control", [])
    assert first["file"] == str(Path("trial.gl").resolve())
    assert first["fingerprint"] == fingerprint(run.executive.dynamics.theory)
    assert first["state"] == {"x": 0, "seen": "red"}


def test_a_fingerprint_changes_with_a_constant(start: Start) -> None:
    theory = start(TRIAL).executive.dynamics.theory
    other = start(TRIAL.replace("limit = 2", "limit = 3")).executive.dynamics.theory

    assert fingerprint(theory) != fingerprint(other)
    assert fingerprint(theory) == fingerprint(start(TRIAL).executive.dynamics.theory)


def test_a_fingerprint_changes_with_an_imported_file(tmp_path: Path) -> None:
    (tmp_path / "lamp.gl").write_text('domain lamp\nimport "switch.gl"\nfluent lit = false\n')
    prints = set()
    for effect in ("causes on := true", "causes on := not on"):
        (tmp_path / "switch.gl").write_text(f"domain switch\nfluent on = false\naction press:\n    {effect}\n")
        prints.add(fingerprint(load(tmp_path / "lamp.gl")))
    assert len(prints) == 2


def test_each_record_is_on_disk_before_anything_further_happens(start: Start, tmp_path: Path) -> None:
    path = tmp_path / "j"
    seen: list[str] = []

    def perform(action: str, args: object) -> tuple[()]:
        seen.append(json.loads(path.read_bytes().splitlines()[-1])["event"])
        return ()

    journalled(start, path, TRIAL.replace("    look\n", ""), perform=perform)

    assert seen == ["begin"]


def test_an_existing_journal_is_not_overwritten(delivery: BasicActionTheory, start: Start, tmp_path: Path) -> None:
    path = tmp_path / "j"
    path.write_text("precious\n")

    with pytest.raises(FileExistsError):
        Journal(path, start(delivery).executive.dynamics, "control", ())

    assert path.read_text() == "precious\n"


def test_a_folder_that_is_not_there_is_told(delivery: BasicActionTheory, start: Start, tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"cannot write .*: No such file or directory"):
        Journal(tmp_path / "no/j", start(delivery).executive.dynamics, "control", ())


def test_a_full_disk_tears_no_line(start: Start, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    journal = Journal(tmp_path / "j", start(TRIAL).executive.dynamics, "control", ())
    journal.write({"event": "one"})
    write = os.write
    monkeypatch.setattr(os, "write", lambda file, data: write(file, data[:5]))

    with pytest.raises(DeviceError, match="the disk is full"):
        journal.write({"event": "two"})

    journal.close()
    assert (tmp_path / "j").read_text() == '{"event":"one"}\n'


def test_a_device_that_takes_nothing_more_is_told(start: Start) -> None:
    journal = Journal(Path("/dev/full"), start(TRIAL).executive.dynamics, "control", ())

    with pytest.raises(DeviceError, match="cannot write the journal /dev/full: No space left"):
        journal.write({"event": "one"})

    journal.close()


def test_every_happening_has_a_record() -> None:
    declared = {each for each in vars(happenings).values() if isinstance(each, type) and issubclass(each, Happening)}
    assert set(EVENTS) == declared - {Happening}


def test_a_number_too_large_to_write_is_journalled_as_a_text(tmp_path: Path, start: Start) -> None:
    journal = Journal(tmp_path / "j", start(TRIAL).executive.dynamics, "control", ())

    journal.write({"event": "exogenous", "args": [1 << 20_000]})
    journal.close()

    assert records_of(tmp_path / "j") == [{"event": "exogenous", "args": ["0x1000000000… (20001 bits)"]}]
