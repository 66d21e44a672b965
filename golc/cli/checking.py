"""How ``golc check`` goes through the files: what it finds, fixes and writes."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from golc.api.report import Report, report_of
from golc.api.theory import Theory
from golc.cli.console import Console
from golc.cli.fixing import show, tell, write
from golc.diagnostics import Code, Diagnostic, Severity, counted
from golc.fixing.rounds import Looked, Outcome, fix
from golc.fixing.texts import Texts
from golc.loading import examine
from golc.rendering import render, to_json
from golc.reporting import sarif
from golc.reporting.github import annotation
from golc.reporting.selection import Selection

LINES = ("text", "github")
"""The formats that need not wait for the last file."""


@dataclass(frozen=True)
class Seen(Looked):
    """What is found in a file, with the report about it."""

    report: Report


@dataclass(frozen=True)
class Checking:
    """What is to be done with which files; the fields are the options of ``golc check``."""

    files: tuple[str, ...]
    constants: Mapping[str, str]
    console: Console
    selection: Selection
    form: str
    strict: bool
    proofs: bool
    reachable: bool
    trust: bool
    fixing: bool
    diff: bool

    def run(self) -> int:
        """Check all files; the exit code."""
        texts, total, written = Texts(), _Total(), True
        for file in self.files:
            first = self.look(file, texts)
            outcome = self.outcome(file, texts, first)
            total.add(file, first if self.diff else outcome.looked, len(outcome.fixed))
            if self.fixing and not self.diff:
                written &= write(self.console, texts.take())
            self.say(file, outcome.looked)
        if self.diff:
            show(texts.take())
        elif self.form not in LINES:
            _write_whole(self.console, total, self.form, self.reachable)
        self.console.note(total.summary(len(self.files), self.fixing, self.diff))
        return int(not written or total.errors > 0 or (self.strict and total.warnings > 0))

    def look(self, file: str, texts: Texts) -> Seen:
        """What is found in a file."""
        examined = examine(file, self.constants, trust=self.trust, read=texts.read)
        report = report_of(examined, None if examined.theory is None else Theory(examined), self.proofs, self.reachable)
        wanted = (finding for finding in report.findings if self.selection.wants(finding.code))
        return Seen(examined.findings, tuple(wanted), report)

    def outcome(self, file: str, texts: Texts, first: Seen) -> Outcome[Seen]:
        """What is found when all is fixed that is to be."""
        if not self.fixing and not self.diff:
            return Outcome(first)
        outcome = fix(texts, first, lambda: self.look(file, texts))
        tell(self.console, outcome, self.diff)
        return outcome

    def say(self, file: str, seen: Seen) -> None:
        """What is written of a file before the next one."""
        if self.form in LINES and not self.diff:
            _write(self.console, seen.wanted, self.form)
        if seen.report.scope is not None:
            self.console.note(f"{file}: {seen.report.scope}")
        if self.console.verbosity > 0:
            theory = seen.report.theory
            contents = "not a theory" if theory is None else f"domain {theory.name} with {theory.counts()}"
            self.console.err(f"{file}: {contents}")


class _Total:
    """What was found in all files."""

    def __init__(self) -> None:
        self.findings: list[Diagnostic] = []
        self.scopes: list[dict[str, Any]] = []
        self.asked = self.undecided = self.fixed = 0

    def add(self, file: str, seen: Seen, fixed: int) -> None:
        if seen.report.scope is not None:
            self.scopes.append({"file": file, **asdict(seen.report.scope)})
        self.findings += seen.wanted
        self.asked += seen.report.asked
        self.undecided += seen.report.undecided
        self.fixed += fixed

    @property
    def errors(self) -> int:
        return self.count(Severity.ERROR)

    @property
    def warnings(self) -> int:
        return self.count(Severity.WARNING)

    def count(self, severity: Severity) -> int:
        """How many findings there are, but for the questions that are open, which have a number of their own."""
        return sum(each.severity is severity and each.code is not Code.NOT_DECIDED for each in self.findings)

    def counts(self) -> dict[str, Any]:
        """The numbers that stand beside the findings in JSON and SARIF."""
        asked = {"questions": self.asked, "undecided": self.undecided}
        return {"errors": self.errors, "warnings": self.warnings, "fixed": self.fixed, **asked}

    def summary(self, files: int, fixing: bool, diff: bool) -> str:
        kinds = ((self.errors, "error"), (self.warnings, "warning"), (self.count(Severity.NOTE), "note"))
        found = ", ".join(counted(number, what) for number, what in kinds if number)
        done = f"{counted(self.fixed, 'finding')} fixed, " if self.fixed and not diff else ""
        parts = [f"checked {counted(files, 'file')}: {done}{found or ('nothing left' if done else 'nothing found')}"]
        if self.undecided:
            parts.append(f"{counted(self.undecided, 'question')} not decided")
        able = self.fixed if diff else sum(finding.fix is not None for finding in self.findings)
        if able and (diff or not fixing):
            parts.append(f"--fix would fix {able}" + (" of them" if not diff else ""))
        return "; ".join(parts)


def _write(console: Console, findings: Iterable[Diagnostic], form: str) -> None:
    for finding in findings:
        console.out(annotation(finding) if form == "github" else render(finding, console.colored(sys.stdout)) + "\n")


def _write_whole(console: Console, total: _Total, form: str, reachable: bool) -> None:
    counts = total.counts() | ({"reachable": total.scopes} if reachable else {})
    json_ = {"findings": [to_json(finding) for finding in total.findings], **counts}
    console.out(json.dumps(sarif.log(total.findings, counts) if form == "sarif" else json_, indent=2))
