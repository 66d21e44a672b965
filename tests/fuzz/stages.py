"""What is done with each input; whatever raises, ends as a bug or takes too long is a fault of golc."""

from __future__ import annotations

import contextlib
import io
import itertools
import json
import random
import re
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from golc.cli import invoke
from golc.diagnostics import Diagnostic, Findings, Severity, Source, UserError
from golc.loading import Examined, examine
from golc.rendering import render, to_json
from golc.reporting import sarif
from golc.reporting.github import annotation
from golc.reporting.ignores import heed
from golc.syntax.format import formatted
from golc.syntax.text import read_source

FORMATS = ("text", "json", "sarif", "github")
FORMATS_OF_PAGES = ("text", "latex")
WAYS: tuple[list[str], ...] = ([], ["--no-proofs"], ["--reachable"], ["--strict", "--color", "always"])
BUG = 70
"""How a command ends that failed in a way nobody thought of."""


class FaultError(Exception):
    """Something that golc must not do, though it raised nothing."""


class Clock:
    """Says which stage begins, and how many seconds of processor time each has taken."""

    def __init__(self, say: Callable[[str], None]) -> None:
        self.times: dict[str, float] = {}
        self._say = say

    @contextlib.contextmanager
    def stage(self, name: str) -> Iterator[None]:
        self._say(name)
        began = time.process_time()
        try:
            yield
        except Exception as error:
            error.add_note(f"stage {name}")
            raise
        finally:
            self.times[name] = max(self.times.get(name, 0), time.process_time() - began)


def every_stage(path: Path, rng: random.Random, clock: Clock) -> Examined:
    """Examine, show, lay out and, if it is a theory, explain, plan, test and compile a file."""
    with clock.stage("examine"):
        examined = examine(path, proofs=True)
    with clock.stage("show"):
        show(examined)
    with clock.stage("fmt"):
        _lay_out(path)
    with clock.stage("fix"):
        _run(["check", "--diff", "--no-proofs", str(path)])
    if rng.random() < 0.05:
        with clock.stage("check"):
            _run(["check", "--format", rng.choice(FORMATS), *rng.choice(WAYS), str(path)])
    if examined.theory is not None:
        for command in _commands(path, examined, rng):
            with clock.stage(command[0]):
                _run(command)
    return examined


def show(examined: Examined) -> None:
    """Show every finding in every form; there is an error if there is no theory, and each stands at its place."""
    if (examined.theory is None) != any(finding.severity is Severity.ERROR for finding in examined.findings):
        raise FaultError("no theory, and no error that says why, or a theory with an error")
    found = heed(examined, True)
    for findings, source in itertools.product((examined.findings, found), examined.sources):
        starts = [finding.span.start for finding in findings if finding.span.source is source]
        if starts != sorted(starts):
            raise FaultError(f"not in the order of the places: {findings}")
    for finding in found:
        _check_place(finding)
        for color in (False, True):
            render(finding, color)
        annotation(finding)
        json.dumps(to_json(finding))
    json.dumps(sarif.log(found, {"errors": 0, "warnings": 0, "questions": 0, "undecided": 0}))


def _check_place(finding: Diagnostic) -> None:
    """The line and the column that are shown are those of the offset, counted here anew."""
    text, place = finding.span.source.text, to_json(finding)["span"]
    before, shown = text[: finding.span.start], render(finding)
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    if not 0 <= finding.span.start <= finding.span.end <= len(text) or (place["line"], place["column"]) != (
        line,
        column,
    ):
        raise FaultError(f"no place: {finding}")
    if text and f"{place['file']}:{line}:{column}" not in shown:
        raise FaultError(f"not shown at its place: {shown}")
    if not finding.message or (finding.message.isprintable() and finding.message not in shown):
        raise FaultError(f"no message: {shown}")


def _lay_out(path: Path) -> None:
    findings = Findings()
    try:
        text = formatted(read_source(path), findings)
    except UserError:
        return
    if text is None:
        return
    again = formatted(Source("laid out", text), findings)
    if again != text:
        raise FaultError("the canonical layout is laid out differently")


def _commands(path: Path, examined: Examined, rng: random.Random) -> Iterator[list[str]]:
    """Command lines for a theory, with goals and programs of it and small limits."""
    theory = examined.theory
    assert theory is not None
    names = [*theory.fluents, *theory.actions, *theory.procedures, *theory.definitions, *theory.statics, *theory.types]
    for form in FORMATS_OF_PAGES:
        for name in rng.sample(names, min(2, len(names))):
            yield ["explain", str(path), name, "--format", form]
    limits = ["--nodes", "150", "--time", "2", "--steps", "6"]
    goals = [
        *theory.goals,
        "false",
        *re.findall(r"(?:poss|when|if|while|until|where|test) (.*)", examined.sources[0].text),
    ]
    yield ["plan", str(path), "--goal", rng.choice(goals), *limits]
    for name in rng.sample([*theory.procedures], min(2, len(theory.procedures))):
        way = rng.choice((["--all", "5"], ["--first"], ["--shortest"], ["--cheapest"], ["--all", "5", "--conformant"]))
        yield ["plan", str(path), name, *way, *limits, "--format", rng.choice(("text", "json", "dot"))]
    yield ["convert", str(path), "-"]
    yield ["test", str(path)]
    if theory.devices:
        yield ["gen-nqc", str(path), "-o", str(path.parent / "build"), "--target", rng.choice(("rcx", "rcx2"))]


def _run(arguments: list[str]) -> None:
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = invoke(arguments)
    if code == BUG or "Traceback" in err.getvalue():
        raise FaultError(f"golc {' '.join(arguments)}\n{err.getvalue()}")
